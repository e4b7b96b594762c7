"""Rays against boxes that are intersected one by one, and against walls that must not leak."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from priorlab.robot.rays import cast_rays

seeds = st.integers(0, 2**32 - 1)


def cast_one(obstacles, x, y, angle, max_range=100):
    return cast_rays(obstacles, [[x, y]], [angle], max_range).item()


@given(seeds)
def test_cast_rays_equals_boxes(speckled, ray_oracle, seed):
    obstacles, poses = speckled(seed, n_places=8)
    expected = [ray_oracle(obstacles, *pose, 9.0) for pose in poses]
    np.testing.assert_allclose(cast_rays(obstacles, poses[:, :2], poses[:, 2], 9.0), expected, atol=1e-9)


@given(seeds, st.sampled_from([0, math.pi / 2, math.pi, 3 * math.pi / 2]))
def test_cast_rays_along_the_axes_equals_boxes(speckled, ray_oracle, seed, angle):
    obstacles, poses = speckled(seed)
    expected = [ray_oracle(obstacles, x, y, angle, 50) for x, y, _ in poses]
    np.testing.assert_allclose(cast_rays(obstacles, poses[:, :2], np.full(len(poses), angle), 50), expected, atol=1e-9)


@given(seeds)
def test_cast_rays_of_the_mirrored_map_are_the_same(speckled, seed):
    obstacles, (poses) = speckled(seed)
    height, width = obstacles.shape
    straight = cast_rays(obstacles, poses[:, :2], poses[:, 2], 50)
    flipped = cast_rays(obstacles[::-1], poses[:, :2] * [1, -1] + [0, height], -poses[:, 2], 50)
    turned = cast_rays(np.rot90(obstacles), np.column_stack([height - poses[:, 1], poses[:, 0]]), poses[:, 2] + math.pi / 2, 50)
    np.testing.assert_allclose(flipped, straight, atol=1e-9)
    np.testing.assert_allclose(turned, straight, atol=1e-9)


@pytest.mark.parametrize("turned", [False, True])
def test_thin_diagonals_do_not_leak(turned):
    """Rays from every lattice point on one side to the other: many go exactly through the corners."""
    size = 24
    wall = np.eye(size, dtype=bool)
    wall = wall[:, ::-1] if turned else wall
    side = np.add.outer(np.arange(size + 1), -np.arange(size + 1) if turned else np.arange(size + 1))
    y, x = np.nonzero(side > 1 if turned else side > size + 1)
    origins = np.column_stack([x, y]).astype(float)
    origins = origins[(origins < size).all(axis=1)]
    for step in range(4):
        target = np.array([size - step, step] if turned else [step, step], dtype=float)
        way = target - origins
        distance = np.hypot(*way.T)
        met = cast_rays(wall, origins, np.arctan2(way[:, 1], way[:, 0]), 100)
        assert (met < distance).all()


@pytest.mark.parametrize(("dx", "dy"), [(1, 1), (1, -1), (-1, 1), (-1, -1)])
def test_a_ray_through_the_corner_of_two_obstacles_ends_there(dx, dy):
    obstacles = np.zeros((4, 4), dtype=bool)
    obstacles[1, 1 if dx * dy > 0 else 2] = obstacles[2, 2 if dx * dy > 0 else 1] = True
    x, y = 2 - 1.5 * dx, 2 - 1.5 * dy
    assert cast_one(obstacles, x, y, math.atan2(dy, dx)) == pytest.approx(1.5 * math.sqrt(2))


def test_a_ray_through_the_corner_of_one_obstacle_goes_on():
    obstacles = np.zeros((4, 4), dtype=bool)
    obstacles[1, 1] = True
    assert cast_one(obstacles, 0.5, 0.5, math.pi / 4) == math.inf


def test_a_ray_starts_in_an_obstacle_with_nothing():
    assert cast_one(np.ones((3, 3)), 1.5, 1.5, 1.0) == 0.0


def test_a_ray_from_a_border_knows_its_side():
    obstacles = np.array([[True, False, True]])
    assert cast_one(obstacles, 1.0, 0.5, math.pi) == 0.0
    assert cast_one(obstacles, 1.0, 0.5, 0.0) == 1.0


def test_max_range_is_a_range_too():
    obstacles = np.array([[False, False, False, True]])
    assert cast_one(obstacles, 0.5, 0.5, 0.0, max_range=2.5) == 2.5
    assert cast_one(obstacles, 0.5, 0.5, 0.0, max_range=2.4999) == math.inf


def test_no_rays_have_no_ranges():
    assert cast_rays(np.zeros((3, 3)), np.empty((0, 2)), [], 5).shape == (0,)


@pytest.mark.parametrize(
    ("origins", "angles", "max_range", "sentence"),
    [
        ([[3.0, 1.0]], [0.0], 5, "a ray must start on the map of 3 x 2 pixels, got x, y = 3, 1"),
        ([[math.nan, 1.0]], [0.0], 5, "got x, y = nan, 1"),
        ([[1.0, 1.0]], [math.inf], 5, "angles must be finite numbers, got inf"),
        ([[1.0, 1.0]], [0.0, 1.0], 5, r"origins_xy must have shape \(2, 2\), one per angle, got \(1, 2\)"),
        ([[1.0, 1.0]], [0.0], 0, "max_range must be a finite number above 0, got 0"),
    ],
)
def test_cast_rays_says_what_is_wrong(origins, angles, max_range, sentence):
    with pytest.raises(ValueError, match=sentence):
        cast_rays(np.zeros((2, 3)), origins, angles, max_range)
