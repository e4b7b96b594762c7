"""The geometry test against angles and sides known beforehand."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from priorlab.drawing.geometry import angles_deg, equal_sides, passes_geometry, side_lengths
from priorlab.drawing.method import ROBUST, THESIS

QUARTER_DOOR = [(0, 0), (40, 0), (0, 40)]


def test_side_lengths_3_4_5():
    assert side_lengths([(0, 0), (3, 0), (3, 4)]).tolist() == [3, 4, 5]


@given(st.lists(st.tuples(st.integers(0, 200), st.integers(0, 200)), min_size=3, max_size=3, unique=True))
def test_angles_deg_sum_to_180_unless_collinear(points):
    (ax, ay), (bx, by), (cx, cy) = points
    doubled_area = abs((bx - ax) * (cy - ay) - (cx - ax) * (by - ay))
    total = angles_deg(side_lengths(points)).sum()
    if doubled_area:
        assert total == pytest.approx(180, abs=1e-3)


def test_angles_deg_by_arctangent():
    assert angles_deg(side_lengths([(0, 0), (10, 0), (10, 5)]))[0] == pytest.approx(math.degrees(math.atan2(5, 10)))


@pytest.mark.parametrize(
    ("sides", "rounding", "expected"),
    [
        ((10.0, 10.0, 4.0), False, True),
        ((10.0, 9.1, 4.0), False, True),  # 0.91
        ((10.0, 8.9, 4.0), False, False),  # 0.89
        ((5.1, 5.9, 3.0), True, True),  # both round up to 6
        ((5.1, 5.9, 3.0), False, False),  # 0.86
        ((4.0, 10.0, 9.5), False, True),  # the pair need not come first
    ],
)
def test_equal_sides_eq_3_4_and_3_5(sides, rounding, expected):
    assert bool(equal_sides(sides, 0.9, rounding)) is expected


@pytest.mark.parametrize("method", [THESIS, ROBUST])
def test_passes_geometry_takes_a_quarter_door(method):
    assert passes_geometry(QUARTER_DOOR, method)


@pytest.mark.parametrize(
    "triangle",
    [
        [(0, 0), (40, 0), (80, 1)],  # nearly collinear: the largest angle is about 180
        [(0, 0), (40, 0), (40, 60)],  # right angle, but no two sides alike
        [(5, 5), (5, 5), (9, 9)],  # two vertices are one point
    ],
)
def test_passes_geometry_rejects(triangle):
    assert not passes_geometry(triangle, THESIS)


def test_passes_geometry_needle_passes_the_text_and_fails_the_smallest_angle():
    needle = [(0, 0), (60, 0), (60, 8)]  # angles 7.6, 90, 82.4
    assert passes_geometry(needle, THESIS)
    assert not passes_geometry(needle, ROBUST)


def test_passes_geometry_many_at_once():
    both = np.array([QUARTER_DOOR, [(0, 0), (40, 0), (80, 1)]])
    assert passes_geometry(both).tolist() == [True, False]
