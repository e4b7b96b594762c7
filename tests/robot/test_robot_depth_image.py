"""Synthetic depth images against walls computed by hand and against a slow walk along every pixel's ray."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from priorlab.robot.depth_camera import DepthCamera
from priorlab.robot.depth_image import depth_image, exact_depth
from priorlab.robot.depth_noise import DepthNoise
from priorlab.robot.relief import Relief, raise_walls
from priorlab.robot.strip import strip_ranges

SMALL = DepthCamera(rows=24, columns=17, strip_rows=4, height_m=0.31, min_depth_m=0.0)
SCALE = 0.05


def wall_ahead(at=60, shape=(200, 120), height=2.4):
    """A wall square to a camera that looks along +x; 20 pixels of 5 cm from x = 20 are 1 m."""
    heights = np.zeros(shape)
    heights[:, at:] = height
    return Relief(heights, SCALE)


def slow_depth(relief, pose, camera, steps_per_pixel=400):
    """Walk along every pixel's ray in tiny steps until it is in a block, under the floor, over the ceiling, or too far."""
    x, y, theta = pose
    rows, columns = relief.shape
    image = np.full(camera.shape, np.inf)
    for row in range(camera.rows):
        for column in range(camera.columns):
            u = (column + 0.5 - camera.columns / 2) / (camera.columns / 2) * math.tan(camera.field_of_view / 2)
            v = (row + 0.5 - camera.rows / 2) / (camera.columns / 2) * math.tan(camera.field_of_view / 2)
            dx = math.cos(theta) + u * math.sin(theta)  # forward, and u to the right
            dy = math.sin(theta) - u * math.cos(theta)
            depth, step = 0.0, relief.metres_per_pixel / steps_per_pixel
            while depth <= camera.max_depth_m:
                z = camera.height_m - v * depth
                px, py = x + dx * depth / relief.metres_per_pixel, y + dy * depth / relief.metres_per_pixel
                inside = 0 <= px < columns and 0 <= py < rows
                block = relief.heights_m[rows - 1 - int(py), int(px)] if inside else 0.0
                if z <= 0 or z <= block or (relief.ceiling_m is not None and z >= relief.ceiling_m):
                    image[row, column] = depth
                    break
                depth += step
    return image


def test_a_wall_two_metres_ahead_has_one_depth_and_many_ranges():
    camera = DepthCamera()
    image = depth_image(wall_ahead(), [20.0, 100.0, 0.0], camera)
    assert (image[:260] == 2000).all()  # above the floor: 240 + 577.3 * 0.3 / 2 = row 326
    ranges, valid = strip_ranges(image, camera)
    assert valid.all()
    assert ranges == pytest.approx(2 / np.cos(camera.bearings), abs=1e-9)
    assert ranges[0] == pytest.approx(2 / math.cos(math.radians(29)), abs=0.003)  # 2.287 m at the edge


def test_the_floor_begins_where_the_wall_stands():
    """A row v below the horizon meets the floor at height * focal length / v: 0.3 * 577.3 / 86.6 = 2 m."""
    image = depth_image(wall_ahead(), [20.0, 100.0, 0.0])
    column = image[:, 320].astype(int)
    assert (column[:326] == 2000).all() and (column[327:] < 2000).all() and (np.diff(column[326:]) < 0).all()
    assert column[479] == round(1000 * 0.3 * 577.2965 / 239.5)


def test_a_wall_ends_at_its_height():
    """0.6 m high, the lens at 0.3 m, 2 m away: 86.6 rows above the horizon."""
    image = depth_image(wall_ahead(height=0.6), [20.0, 100.0, 0.0])
    assert (image[:153] == 0).all() and (image[154:326] == 2000).all()


def test_the_ceiling_is_seen_over_the_wall():
    low = Relief(wall_ahead(height=0.6).heights_m, SCALE, ceiling_m=0.9)
    column = depth_image(low, [20.0, 100.0, 0.0])[:, 320]
    row = 60
    assert column[row] == round(1000 * 0.6 * 577.2965 / (239.5 - row)) and column[160] == 2000


def test_left_of_the_image_is_left_of_the_robot():
    heights = np.zeros((80, 80))
    heights[:20, 40:] = 2.0  # the upper (north) part: left of a robot that looks east
    image = depth_image(Relief(heights, SCALE), [20.5, 40.5, 0.0])
    assert (image[200, 1:130] > 0).all() and (image[200, 320:] == 0).all()


@pytest.mark.parametrize(("distance", "seen"), [(7, False), (7.99, False), (8, True), (60, True), (60.02, False)])
def test_blind_zone_and_far_end_are_zeros(distance, seen):
    """8 pixels are 0.4 m, 60 are 3 m."""
    image = depth_image(wall_ahead(at=100), [100 - distance, 100.0, 0.0])
    assert (image[230:250] > 0).all() == seen and (image[230:250] > 0).any() == seen


def test_a_camera_sees_over_low_furniture_and_on_top_of_it():
    heights = np.zeros((80, 120))
    heights[:, 40:50] = 0.2  # 1 m ahead, half a metre deep
    heights[:, 80:] = 0.6  # the wall, 3 m ahead
    column = depth_image(Relief(heights, SCALE), [20.0, 40.0, 0.0])[:, 320].astype(int)
    assert (column[230:278] == 3000).all()  # over the box: its rear edge at 1.5 m lies 0.1 * 577.3 / 1.5 = 38.5 rows down
    top = column[280:297]
    assert (top == np.rint(1000 * 0.1 * 577.2965 / (np.arange(280, 297) + 0.5 - 240))).all()  # its top
    assert (column[299:412] == 1000).all()  # its front


@settings(max_examples=10, deadline=None)
@given(st.integers(0, 10_000))
def test_exact_depth_equals_a_slow_walk(seed):
    rng = np.random.default_rng(seed)
    heights = np.where(rng.random((14, 16)) < 0.12, rng.choice([0.1, 0.2, 0.31, 0.5, 0.9], (14, 16)), 0.0)
    free = np.argwhere(heights == 0)
    row, col = free[rng.integers(len(free))]
    pose = (col + rng.uniform(0.1, 0.9), 13 - row + rng.uniform(0.1, 0.9), rng.uniform(-math.pi, math.pi))
    relief = Relief(heights, SCALE, ceiling_m=rng.choice([None, 0.95]))
    camera = DepthCamera(rows=10, columns=7, strip_rows=2, height_m=0.3102, min_depth_m=0.0, max_depth_m=0.9)

    def seen(turn=0.0, lift=0.0):
        depth = exact_depth(relief, (*pose[:2], pose[2] + turn), replace(camera, height_m=camera.height_m + lift))
        return np.where(depth <= camera.max_depth_m, depth, 9.0)

    slow = np.nan_to_num(slow_depth(relief, pose, camera, steps_per_pixel=200), posinf=9.0)
    # where a hair to the side or above there is something else, the ray grazes an edge that tiny steps may miss
    steady = np.ptp([seen(), seen(0.003), seen(-0.003), seen(0, 2e-4), seen(0, -2e-4)], axis=0) < 0.02
    assert steady.mean() > 0.4
    np.testing.assert_allclose(seen()[steady], slow[steady], atol=1.5 * SCALE / 200)


@given(st.integers(0, 10_000), st.sampled_from([math.pi / 2, math.pi, 3 * math.pi / 2]))
@settings(max_examples=10, deadline=None)
def test_a_turned_world_gives_the_same_image(seed, turn):
    rng = np.random.default_rng(seed)
    heights = np.where(rng.random((20, 20)) < 0.1, 0.5, 0.0)
    heights[8:12, 8:12] = 0.0
    turned = np.rot90(heights, round(turn / (math.pi / 2)))
    x, y = 0.3, -0.2
    c, s = math.cos(turn), math.sin(turn)
    first = exact_depth(Relief(heights, SCALE), [10 + x, 10 + y, 0.1], SMALL)
    second = exact_depth(Relief(turned, SCALE), [10 + c * x - s * y, 10 + s * x + c * y, 0.1 + turn], SMALL)
    np.testing.assert_allclose(first, second, atol=1e-6)


def test_the_same_seed_gives_the_same_image():
    images = [depth_image(wall_ahead(), [20.0, 100.0, 0.0], rng=np.random.default_rng(7), noise=DepthNoise()) for _ in range(2)]
    assert np.array_equal(*images) and images[0].dtype == np.uint16
    assert not np.array_equal(images[0], depth_image(wall_ahead(), [20.0, 100.0, 0.0]))


@pytest.mark.parametrize(
    ("relief", "pose", "sentence"),
    [
        (wall_ahead(), [-1.0, 5.0, 0.0], "pose must lie on the plan of 120 x 200 pixels, got x, y = -1, 5"),
        (wall_ahead(), [70.0, 5.0, 0.0], "pose must leave the lens at 0.3 m free, got x, y = 70, 5 in 2.4 m of wall"),
        (wall_ahead(), [1.0, 5.0], r"pose must have shape \(N, 3\)"),
        (Relief(np.zeros((9, 9)), 0.1, ceiling_m=0.2), [1.0, 5.0, 0.0], "must lie under the ceiling at 0.2 m, got 0.3"),
    ],
)
def test_depth_image_says_what_is_wrong(relief, pose, sentence):
    with pytest.raises(ValueError, match=sentence):
        depth_image(relief, pose)


def test_depth_image_wants_a_generator_for_faults():
    with pytest.raises(ValueError, match="rng must be a numpy Generator"):
        depth_image(wall_ahead(), [20.0, 100.0, 0.0], noise=DepthNoise())


def test_raise_walls_keeps_the_higher_of_wall_and_furniture():
    relief = raise_walls([[True, True, False, False]], 0.1, 0.6, [[False, True, True, False]], 0.9)
    assert relief.heights_m.tolist() == [[0.6, 0.9, 0.9, 0.0]] and relief.levels_m == [0.6, 0.9]


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: Relief(np.array([[-1.0]]), 0.1), "heights_m must be finite numbers of at least 0, got -1"),
        (lambda: Relief(np.array([[2.0]]), 0.1, 1.0), "ceiling_m must not be below what stands under it, 2 m, got 1"),
        (lambda: raise_walls([[True]], 0.1, 0), "wall_height_m must be a finite number above 0"),
        (lambda: raise_walls([[True]], 0.1, furniture=[[True, True]]), "must have one shape"),
    ],
)
def test_relief_says_what_is_wrong(make, sentence):
    with pytest.raises(ValueError, match=sentence):
        make()
