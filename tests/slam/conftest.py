"""A small floor and a drive through it, made without any code of priorlab.robot: the ray caster is a naive march."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.readings import RobotLog
from priorlab.core.sensor import Scanner

PIXEL_M = 0.05


def march(obstacles: NDArray, pose: NDArray, bearings: NDArray, max_range_m: float, pixel_m: float = PIXEL_M) -> NDArray:
    """(B,) ranges by walking along every ray in steps of a tenth of a pixel; inf when nothing is met."""
    along = np.arange(0.0, max_range_m, pixel_m / 10)
    angles = pose[2] + bearings[:, None]
    cols = np.floor((pose[0] + along * np.cos(angles)) / pixel_m).astype(int)
    rows = obstacles.shape[0] - 1 - np.floor((pose[1] + along * np.sin(angles)) / pixel_m).astype(int)
    inside = (rows >= 0) & (rows < obstacles.shape[0]) & (cols >= 0) & (cols < obstacles.shape[1])
    hit = inside & obstacles[rows.clip(0, obstacles.shape[0] - 1), cols.clip(0, obstacles.shape[1] - 1)]
    return np.where(hit.any(axis=1), along[hit.argmax(axis=1)], np.inf)


def draw_floor() -> tuple[NDArray, NDArray]:
    """A corridor with three rooms on each side, 14 x 8 m: the plan's walls, and the world with furniture on top."""
    walls = np.zeros((160, 280), dtype=bool)  # row 0 is the top; y up in metres is (160 - row) * 0.05
    walls[:4], walls[-4:], walls[:, :4], walls[:, -4:] = True, True, True, True
    walls[62:66], walls[94:98] = True, True  # the corridor, 1.4 m wide, y from 3.3 to 4.7 m
    for col in (90, 186):
        walls[:62, col : col + 4] = True
        walls[98:, col : col + 4] = True
    for col in (40, 130, 230):  # six doors, 0.9 m
        walls[62:66, col : col + 18] = False
        walls[94:98, col : col + 18] = False
    world = walls.copy()
    world[4:14, 60:84] = True  # a bookcase, a desk, a box in the corridor: nothing that the plan shows
    world[120:134, 100:112] = True
    world[66:72, 196:206] = True
    world[140:156, 240:270] = True
    return walls, world


TOUR = [
    (1.0, 4.0),
    (2.45, 4.0),
    (2.45, 6.2),
    (2.45, 4.0),
    (6.95, 4.0),
    (6.95, 1.6),
    (6.95, 4.0),
    (11.95, 4.0),
    (11.95, 6.2),
    (11.95, 2.0),
]


def drive_floor(seed: int, step_m: float = 0.15, turn: float = np.radians(12), alpha: float = 0.002) -> RobotLog:
    """Turn to the next corner of the tour, drive there, turn again; wheels and scanner err with the given seed."""
    rng = np.random.default_rng(seed)
    _, world = draw_floor()
    scanner = Scanner()
    x, y, theta = *TOUR[0], 0.0
    poses = [(x, y, theta)]
    for goal in TOUR[1:]:
        heading = np.arctan2(goal[1] - y, goal[0] - x)
        difference = (heading - theta + np.pi) % (2 * np.pi) - np.pi
        for share in np.linspace(0, 1, int(abs(difference) / turn) + 2)[1:]:
            poses.append((x, y, theta + share * difference))
        theta = heading
        length = np.hypot(goal[0] - x, goal[1] - y)
        for share in np.linspace(0, 1, int(length / step_m) + 2)[1:]:
            poses.append((x + share * (goal[0] - x), y + share * (goal[1] - y), theta))
        x, y = goal
    truth = np.array(poses)
    odometry = [np.array([3.0, -2.0, 0.7])]  # the wheels know nothing of the map's frame
    for before, after in zip(truth[:-1], truth[1:], strict=True):
        length = np.hypot(*(after - before)[:2])
        rotation = (after[2] - before[2] + np.pi) % (2 * np.pi) - np.pi
        length += rng.normal(0, np.sqrt(alpha * (length**2 + rotation**2)))
        ox, oy, otheta = odometry[-1]
        turned = rotation + rng.normal(0, np.sqrt(alpha * (length**2 + rotation**2)))
        odometry.append(np.array([ox + length * np.cos(otheta), oy + length * np.sin(otheta), otheta + turned]))
    ranges = np.array([march(world, pose, scanner.bearings, scanner.max_range_m) for pose in truth])
    ranges = np.where(np.isfinite(ranges), ranges + rng.normal(0, scanner.range_noise_m, ranges.shape), np.inf)
    ranges[ranges < scanner.min_range_m] = np.nan
    return RobotLog(np.array(odometry), ranges, scanner.bearings, scanner, truth[0], truth)


def prior_of(walls: NDArray, prior: Prior, cell_size: float = 1) -> GridMap:
    """A prior map by hand: a cell is wall when one of its pixels is (cells of whole pixels that divide the image)."""
    grid = Grid(walls.shape, cell_size, PIXEL_M)
    side = int(cell_size)
    blocks = walls.reshape(walls.shape[0] // side, side, walls.shape[1] // side, side).any(axis=(1, 3))
    p = np.where(blocks, prior.effective_p_wall, prior.effective_p_space)
    return GridMap(np.log(p / (1 - p)), grid, prior)


@pytest.fixture(scope="session")
def floor() -> tuple[NDArray, NDArray]:
    return draw_floor()


@pytest.fixture(scope="session", name="prior_of")
def prior_of_fixture() -> Callable[..., GridMap]:
    return prior_of


@pytest.fixture(scope="session", name="drive_floor")
def drive_floor_fixture() -> Callable[..., RobotLog]:
    return drive_floor


@pytest.fixture(scope="session")
def slam_prior(floor: tuple[NDArray, NDArray]) -> GridMap:
    return prior_of(floor[0], Prior(0.3, 0.8))


@pytest.fixture(scope="session")
def drive_log() -> RobotLog:
    return drive_floor(seed=1)
