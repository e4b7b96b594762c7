"""Small rooms, and slow oracles in plain Python that share nothing with the code they check."""

import math

import numpy as np
import pytest


def ray_by_boxes(obstacles, x, y, angle, max_range):
    """Where a ray enters the nearest obstacle pixel: every pixel is a box, its near and far sides are intersected."""
    height = len(obstacles)
    best = math.inf
    for row, col in np.argwhere(obstacles):
        enter, leave = 0.0, math.inf
        for start, speed, low in ((x, math.cos(angle), col), (y, math.sin(angle), height - 1 - row)):
            if abs(speed) < 1e-12:
                if not low <= start < low + 1:
                    leave = -1.0
                continue
            near, far = sorted(((low - start) / speed, (low + 1 - start) / speed))
            enter, leave = max(enter, near), min(leave, far)
        if enter < leave - 1e-9 and enter <= max_range:
            best = min(best, enter)
    return best


def cone_by_loops(pose, ranges, bearings, sensor, image_shape, cell_size):
    """{(row, col): P(empty)} of the cells that one reading sees: decisions 7 to 10 of the method page, cell by cell.

    A range of None is no reading: nothing is known along that bearing.
    """
    height, width = image_shape
    rows, cols = math.ceil(height / cell_size - 1e-9), math.ceil(width / cell_size - 1e-9)
    x, y, theta = pose

    def look(px, py):
        distance = math.hypot(px - x, py - y)
        bearing = (math.atan2(py - y, px - x) - theta + math.pi) % (2 * math.pi) - math.pi
        return distance, bearing, ranges[int(np.argmin(np.abs(bearings - bearing)))]

    hits = set()
    for bearing, measured in zip(bearings, ranges, strict=True):
        if measured is not None and measured <= sensor.max_range:
            hx = x + (measured + 1e-6) * math.cos(theta + bearing)
            hy = y + (measured + 1e-6) * math.sin(theta + bearing)
            hits.add((rows - 1 - math.floor(hy / cell_size), math.floor(hx / cell_size)))
    seen = {}
    for row in range(rows):
        for col in range(cols):
            distance, bearing, measured = look((col + 0.5) * cell_size, (rows - row - 0.5) * cell_size)
            if distance > sensor.max_range + 1e-9 or abs(bearing) > sensor.half_angle + 1e-9 or measured is None:
                continue
            behind = {
                "all": True,
                "thickness": distance <= measured + max(sensor.wall_thickness, cell_size / 2) + 1e-9,
                "hit_cell": distance < measured or (row, col) in hits,
            }
            if not behind[sensor.beyond]:
                continue
            front = pixels = 0
            for up in range(height):
                for right in range(width):
                    in_row = math.floor((up + 0.5) / cell_size) == rows - 1 - row
                    if in_row and math.floor((right + 0.5) / cell_size) == col:
                        d, _, z = look(right + 0.5, up + 0.5)
                        if z is not None:
                            front, pixels = front + (d < z), pixels + 1
            share = front / pixels if pixels else float(distance < measured)
            seen[row, col] = min(max(share, sensor.p_occupied), sensor.p_free)
    return seen


@pytest.fixture(scope="session")
def ray_oracle():
    return ray_by_boxes


@pytest.fixture(scope="session")
def cone_oracle():
    return cone_by_loops


@pytest.fixture(scope="session")
def speckled():
    """A map of scattered obstacle pixels, and places in its free pixels, by seed."""

    def make(seed, n_places=5, shape=(14, 17), density=0.08):
        rng = np.random.default_rng(seed)
        obstacles = rng.random(shape) < density
        free = np.argwhere(~obstacles)
        chosen = free[rng.integers(0, len(free), n_places)]
        xy = np.column_stack([chosen[:, 1], shape[0] - 1 - chosen[:, 0]]) + rng.uniform(0.01, 0.99, (n_places, 2))
        return obstacles, np.column_stack([xy, rng.uniform(-math.pi, math.pi, n_places)])

    return make
