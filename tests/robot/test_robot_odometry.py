"""Algorithm 6.3's noise: its parts by hand, its variances by counting."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from priorlab.core.sensor import Odometry
from priorlab.robot.odometry import report_odometry, split_step

poses = st.tuples(st.floats(-5, 5), st.floats(-5, 5), st.floats(-3, 3)).map(np.array)


@given(poses, poses)
def test_split_step_leads_from_start_to_end(before, after):
    rot1, trans, rot2 = split_step(before, after)
    heading = before[2] + rot1
    if trans >= 1e-3:
        np.testing.assert_allclose(before[:2] + trans * np.array([math.cos(heading), math.sin(heading)]), after[:2], atol=1e-9)
    assert math.cos(heading + rot2 - after[2]) == pytest.approx(1.0)


def test_split_step_turns_once_on_the_spot():
    rot1, _, rot2 = split_step(np.array([0, 0, 0.0]), np.array([1e-4, 1e-4, 0.5]))
    assert rot1 == 0.0 and rot2 == pytest.approx(0.5)


def test_perfect_wheels_report_the_truth():
    rng = np.random.default_rng(2)
    truth = np.column_stack([rng.uniform(-3, 3, (40, 2)), rng.uniform(-3.1, 3.1, 40)])
    np.testing.assert_allclose(report_odometry(truth, Odometry((0, 0, 0, 0)), rng), truth, atol=1e-9)


def errors_of_one_step(alphas, step, n=4000):
    """Deviations of way and heading over many times the same step, each from the origin."""
    rng = np.random.default_rng(0)
    ends = [report_odometry(np.array([[0.0, 0.0, 0.0], step]), Odometry(alphas), rng)[1] for _ in range(n)]
    ends = np.array(ends)
    return np.hypot(ends[:, 0], ends[:, 1]).std(), ends[:, 2].std()


@pytest.mark.parametrize(
    ("alphas", "step", "way", "heading"),
    [
        ((0, 0, 0.01, 0), [1.0, 0, 0], 0.1, 0.0),  # translation from translation: sqrt(a3) m
        ((0, 0.01, 0, 0), [1.0, 0, 0], 0.0, 0.1 * math.sqrt(2)),  # rotation from translation, before and after the way
        ((0.01, 0, 0, 0), [0.0, 0, 1.0], 0.0, 0.1),  # rotation from rotation
        (Odometry().alphas, [1.0, 0, 0], math.sqrt(0.002), math.sqrt(0.004)),  # 0.002 is a variance: 4.5 cm a metre's step
    ],
)
def test_alphas_are_variances(alphas, step, way, heading):
    found_way, found_heading = errors_of_one_step(alphas, step)
    assert found_way == pytest.approx(way, rel=0.06, abs=1e-9)
    assert found_heading == pytest.approx(heading, rel=0.06, abs=1e-9)


def test_translation_from_rotation_moves_a_turning_robot():
    rng = np.random.default_rng(0)
    turn = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    x = np.array([report_odometry(turn, Odometry((0, 0, 0, 0.01)), rng)[1, 0] for _ in range(4000)])
    assert x.std() == pytest.approx(0.1, rel=0.06)


def test_driving_backwards_is_no_half_turn():
    """rot1 and rot2 are about pi; a noise of alpha pi^2 would be 0.3 rad here."""
    _, heading = errors_of_one_step((0.01, 0, 0, 0), [-1.0, 0.0, 0.0], n=500)
    assert heading < 1e-6


def test_odometry_begins_at_the_truth_and_drifts():
    truth = np.column_stack([np.linspace(1, 21, 201), np.full(201, 2.0), np.zeros(201)])
    reported = report_odometry(truth, Odometry(), np.random.default_rng(3))
    assert (reported[0] == truth[0]).all()
    assert 0.01 < np.hypot(*(reported - truth)[-1, :2]) < 5
