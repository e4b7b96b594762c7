"""Poses that look around, by hand."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from priorlab.core.survey import look_around

QUARTER = np.pi / 2


def test_look_around_alternates_up_and_down_on_a_horizontal_segment():
    poses = look_around([((1, 5), (7, 5))], spacing=3)
    np.testing.assert_allclose(poses, [[1, 5, QUARTER], [4, 5, 3 * QUARTER], [7, 5, QUARTER]])


def test_look_around_alternates_right_and_left_on_a_vertical_segment():
    poses = look_around([((2, 9), (2, 3))], spacing=3)
    np.testing.assert_allclose(poses, [[2, 9, 0], [2, 6, np.pi], [2, 3, 0]])


def test_look_around_counts_anew_on_each_segment():
    poses = look_around([((0, 0), (3, 0)), ((3, 0), (6, 0))], spacing=3)
    np.testing.assert_allclose(poses[:, 2], [QUARTER, 3 * QUARTER, QUARTER, 3 * QUARTER])


def test_look_around_of_a_point_is_one_pose():
    assert look_around([((4, 4), (4, 4))], spacing=2).shape == (1, 3)


def test_look_around_of_nothing_is_nothing():
    assert look_around([], spacing=1).shape == (0, 3)


@given(st.floats(1, 100), st.floats(0.5, 20))
def test_look_around_keeps_its_spacing_and_its_segment(length, spacing):
    x = look_around([((10, 0), (10 + length, 0))], spacing)[:, 0]
    np.testing.assert_allclose(np.diff(x), spacing)
    assert x[0] == 10 and 10 + length - spacing < x[-1] + 1e-6 and x[-1] <= 10 + length + 1e-6


@pytest.mark.parametrize(
    ("segments", "spacing", "sentence"),
    [
        ([((0, 0), (3, 4))], 1, "a survey segment must be horizontal or vertical"),
        ([((0, 0), (3, 0))], 0, "spacing must be a finite number above 0, got 0"),
    ],
)
def test_look_around_says_what_is_wrong(segments, spacing, sentence):
    with pytest.raises(ValueError, match=sentence):
        look_around(segments, spacing)
