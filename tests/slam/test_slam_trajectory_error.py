"""Errors of trajectories by hand."""

import math

import numpy as np
import pytest

from priorlab.core.readings import RobotLog
from priorlab.core.sensor import Scanner
from priorlab.slam.trajectory_error import (
    absolute_trajectory_error_m,
    dead_reckoning,
    heading_errors,
    position_errors_m,
    relative_heading_error,
    relative_pose_error_m,
    true_poses,
)


def test_absolute_trajectory_error_does_not_align():
    truth = np.column_stack([np.arange(10.0), np.zeros(10), np.zeros(10)])
    assert absolute_trajectory_error_m(truth + [0, 2, 0], truth) == pytest.approx(2.0)
    assert position_errors_m(truth + [3, 4, 0], truth).tolist() == [5.0] * 10


def test_heading_errors_go_round():
    error = heading_errors([[0, 0, math.radians(179)]], [[0, 0, math.radians(-179)]])
    assert np.degrees(error) == pytest.approx([-2.0])


def test_relative_pose_error_sees_drift_in_the_robots_frame():
    truth = np.column_stack([np.arange(10.0), np.zeros(10), np.zeros(10)])
    turned = np.column_stack([np.zeros(10), np.arange(10.0), np.full(10, math.pi / 2)])
    assert relative_pose_error_m(turned, truth) == pytest.approx(0.0, abs=1e-12)
    assert relative_pose_error_m(truth * [1.1, 1, 1], truth, delta=3) == pytest.approx(0.3)


def matrix(pose):
    """A planar pose as a homogeneous matrix."""
    x, y, theta = pose
    return np.array([[math.cos(theta), -math.sin(theta), x], [math.sin(theta), math.cos(theta), y], [0, 0, 1]])


@pytest.mark.parametrize("delta", [1, 7])
def test_relative_pose_error_by_matrices(delta):
    """The definition of Sturm et al.: E_i = (Q_i^-1 Q_(i+d))^-1 (P_i^-1 P_(i+d)), root mean square of its two parts."""
    rng = np.random.default_rng(delta)
    truth = np.cumsum(rng.normal(0, [0.2, 0.2, 0.8], (40, 3)), axis=0)
    estimated = truth + rng.normal(0, [0.05, 0.05, 0.1], truth.shape)
    ways, turns = [], []
    for i in range(40 - delta):
        true_motion = np.linalg.inv(matrix(truth[i])) @ matrix(truth[i + delta])
        motion = np.linalg.inv(matrix(estimated[i])) @ matrix(estimated[i + delta])
        error = np.linalg.inv(true_motion) @ motion
        ways.append(math.hypot(error[0, 2], error[1, 2]))
        turns.append(math.atan2(error[1, 0], error[0, 0]))
    assert relative_pose_error_m(estimated, truth, delta) == pytest.approx(math.sqrt(np.mean(np.square(ways))))
    assert relative_heading_error(estimated, truth, delta) == pytest.approx(math.sqrt(np.mean(np.square(turns))))
    ate = math.sqrt(sum(math.dist(a[:2], b[:2]) ** 2 for a, b in zip(estimated, truth, strict=True)) / 40)
    assert absolute_trajectory_error_m(estimated, truth) == pytest.approx(ate)


def test_errors_say_what_is_wrong():
    with pytest.raises(ValueError, match="must hold the same poses, at least one, got 2 and 3"):
        absolute_trajectory_error_m(np.zeros((2, 3)), np.zeros((3, 3)))
    with pytest.raises(ValueError, match="delta must be at least 1 and below the 3 poses, got 3"):
        relative_pose_error_m(np.zeros((3, 3)), np.zeros((3, 3)), delta=3)
    scanner = Scanner(n_beams=1)
    blind = RobotLog(np.zeros((2, 3)), np.ones((2, 1)), scanner.bearings, scanner, np.zeros(3))
    with pytest.raises(ValueError, match="the log must hold true poses to measure an error, got none"):
        true_poses(blind)


def test_dead_reckoning_puts_the_wheels_path_at_the_start():
    scanner = Scanner(n_beams=1)
    odometry = [[5, 5, math.pi / 2], [5, 7, math.pi / 2], [4, 7, math.pi]]  # 2 m ahead, then 1 m to the left
    log = RobotLog(np.array(odometry), np.ones((3, 1)), scanner.bearings, scanner, np.array([1.0, 1.0, 0.0]))
    assert dead_reckoning(log) == pytest.approx(np.array([[1, 1, 0], [3, 1, 0], [3, 2, math.pi / 2]]))
