"""Poses against rotation matrices."""

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from priorlab.core.pose import compose, relative, wrap_angle

coordinates = st.floats(-50, 50)
angles = st.floats(-20, 20)
poses = st.tuples(coordinates, coordinates, angles)


def matrix(pose):
    """A pose as a 3 x 3 homogeneous matrix."""
    x, y, theta = pose
    return np.array([[math.cos(theta), -math.sin(theta), x], [math.sin(theta), math.cos(theta), y], [0, 0, 1]])


@given(angles)
def test_wrap_angle_is_the_same_direction_in_half_open_bounds(angle):
    wrapped = float(wrap_angle(angle))
    assert -math.pi <= wrapped < math.pi
    assert math.isclose(math.cos(wrapped), math.cos(angle), abs_tol=1e-9)
    assert math.isclose(math.sin(wrapped), math.sin(angle), abs_tol=1e-9)


@given(poses, poses)
def test_compose_is_the_product_of_matrices(pose, step):
    np.testing.assert_allclose(matrix(compose(pose, step)), matrix(pose) @ matrix(step), atol=1e-9)


@given(poses, poses)
def test_relative_is_the_step_between(start, end):
    np.testing.assert_allclose(matrix(relative(start, end)), np.linalg.inv(matrix(start)) @ matrix(end), atol=1e-8)


@given(poses, poses)
def test_compose_undoes_relative(start, end):
    np.testing.assert_allclose(matrix(compose(start, relative(start, end))), matrix(end), atol=1e-8)


def test_compose_takes_many_poses_at_once():
    many = np.array([[0, 0, 0], [1, 1, np.pi / 2]], dtype=float)
    np.testing.assert_allclose(compose(many, [2, 0, 0])[:, :2], [[2, 0], [1, 3]], atol=1e-12)


def test_a_quarter_turn_to_the_left_looks_up():
    x, y, theta = compose([0, 0, 0], [1, 0, np.pi / 2])
    np.testing.assert_allclose(compose([x, y, theta], [1, 0, 0])[:2], [1, 1], atol=1e-12)
