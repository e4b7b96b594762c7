"""The walk of algorithm 3.1, and the vectorized walk against it."""

import itertools

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from priorlab.drawing.connectivity import connect, forward_neighbours, snap_to_ink, walk, walk_all


def _ink(seed: int, size: int = 24) -> np.ndarray:
    """A random tangle of thin lines and dots."""
    rng = np.random.default_rng(seed)
    image = np.zeros((size, size), dtype=np.uint8)
    for _ in range(6):
        a, b = rng.integers(0, size, (2, 2))
        cv2.line(image, tuple(int(v) for v in a), tuple(int(v) for v in b), 1, int(rng.integers(1, 3)))
    return (image > 0) | (rng.random((size, size)) < 0.05)


@pytest.mark.parametrize(
    ("goal", "expected"),
    [
        ((9, 1), {(1, 0), (0, -1), (1, -1)}),  # right and up, eq. 3.6
        ((1, 1), {(-1, 0), (0, -1), (-1, -1)}),  # left and up, eq. 3.7
        ((9, 9), {(1, 0), (0, 1), (1, 1)}),  # right and down, eq. 3.8
        ((1, 9), {(-1, 0), (0, 1), (-1, 1)}),  # left and down, eq. 3.9
        ((9, 5), {(1, 0), (1, -1), (1, 1)}),  # one row: the three ahead
        ((5, 1), {(0, -1), (-1, -1), (1, -1)}),
    ],
)
def test_forward_neighbours_of_each_quadrant(goal, expected):
    assert set(forward_neighbours((5, 5), goal)) == expected


def test_walk_follows_a_quarter_arc():
    image = np.zeros((60, 60), dtype=np.uint8)
    cv2.ellipse(image, (5, 5), (45, 45), 0, 0, 90, 1, 1)
    found = walk(image > 0, (50, 5), (5, 50))
    assert found.reached
    assert all(image[y, x] for x, y in found.path)
    steps = np.abs(np.diff(found.path, axis=0)).max(axis=1)
    assert (steps == 1).all()


def test_walk_stops_at_a_gap():
    line = np.zeros((5, 30), dtype=bool)
    line[2] = True
    line[2, 15:18] = False
    found = walk(line, (0, 2), (29, 2))
    assert not found.reached
    assert found.path[-1] == (14, 2)


def test_walk_never_turns_back():
    corner = np.zeros((20, 20), dtype=bool)
    corner[10, 5:] = corner[:, 19] = True  # goes right, then up beside the goal's row: a detour to the left is needed
    assert not walk(corner, (5, 10), (2, 0)).reached


def test_walk_off_the_ink_goes_nowhere():
    assert not walk(np.zeros((9, 9), dtype=bool), (1, 1), (7, 7)).reached


def test_walk_on_one_pixel():
    assert walk(np.ones((1, 1), dtype=bool), (0, 0), (0, 0)).reached


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 10_000), st.integers(1, 3))
def test_walk_all_equals_the_scalar_walk(seed, reach):
    ink = _ink(seed)
    rng = np.random.default_rng(seed + 1)
    origins, goals = rng.integers(0, 24, (2, 40, 2))
    one_by_one = [walk(ink, tuple(map(int, o)), tuple(map(int, g)), reach).reached for o, g in zip(origins, goals, strict=True)]
    assert walk_all(ink, origins, goals, reach).tolist() == one_by_one


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 10_000))
def test_connect_is_a_walk_in_one_of_two_directions(seed):
    ink = _ink(seed)
    corners = np.random.default_rng(seed).integers(0, 24, (8, 2)).astype(float)
    found = connect(ink, corners)
    on_ink = [tuple(map(int, p)) for p in snap_to_ink(ink, corners)]
    for i, j in itertools.combinations(range(8), 2):
        apart = np.hypot(*(corners[i] - corners[j])) >= 1
        either = walk(ink, on_ink[i], on_ink[j]).reached or walk(ink, on_ink[j], on_ink[i]).reached
        assert found[i, j] == found[j, i] == (apart and either)


def test_connect_ignores_pairs_that_are_too_far():
    line = np.zeros((5, 50), dtype=bool)
    line[2] = True
    corners = [(0, 2), (20, 2), (49, 2)]
    assert connect(line, corners, max_length=25).sum() == 2
    assert connect(line, corners).sum() == 6
