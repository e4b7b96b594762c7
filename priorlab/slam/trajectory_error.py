"""How far an estimated trajectory is from the true one.

Nothing is aligned first: the estimate and the truth are both in the frame of the map, and being right in the map is what a
prior is for. (Tools such as evo align by default, which forgives a constant offset; ask them not to.)
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.checks import as_float, check_poses, check_record
from priorlab.core.pose import compose, relative, wrap_angle
from priorlab.core.readings import RobotLog


def true_poses(log: RobotLog) -> NDArray[np.float64]:
    """(T, 3) true poses of a log; a sentence when nobody knows them."""
    check_record("log", log, RobotLog)
    if log.truth is None:
        raise ValueError("the log must hold true poses to measure an error, got none: only simulated or surveyed drives do")
    return log.truth


def position_errors_m(estimated: ArrayLike, truth: ArrayLike) -> NDArray[np.float64]:
    """(T,) distance between the estimated and the true position, metres.

    >>> position_errors_m([[0, 0, 0], [3, 4, 0]], [[0, 0, 1], [0, 0, 1]]).tolist()
    [0.0, 5.0]
    """
    estimated, truth = _paired(estimated, truth)
    return np.hypot(*(estimated - truth)[:, :2].T)


def absolute_trajectory_error_m(estimated: ArrayLike, truth: ArrayLike) -> float:
    """ATE = sqrt(mean(distance^2)), metres, without alignment.

    >>> absolute_trajectory_error_m([[0, 0, 0], [3, 4, 0]], [[0, 0, 0], [0, 0, 0]])
    3.5355339059327378
    """
    return float(np.sqrt(np.mean(np.square(position_errors_m(estimated, truth)))))


def heading_errors(estimated: ArrayLike, truth: ArrayLike) -> NDArray[np.float64]:
    """(T,) signed difference of heading, estimated - true, radians in [-pi, pi)."""
    estimated, truth = _paired(estimated, truth)
    return wrap_angle(estimated[:, 2] - truth[:, 2])


def relative_pose_error_m(estimated: ArrayLike, truth: ArrayLike, delta: int = 1) -> float:
    """RPE = sqrt(mean(|translation of the error of every motion over `delta` steps|^2)), metres: drift, not position.

    >>> still = np.zeros((3, 3))
    >>> relative_pose_error_m(still, still + [7, 0, 0])              # a constant offset is no drift
    0.0
    """
    error = _errors_of_motion(estimated, truth, delta)
    return float(np.sqrt(np.mean(np.square(error[:, :2]).sum(axis=1))))


def relative_heading_error(estimated: ArrayLike, truth: ArrayLike, delta: int = 1) -> float:
    """The other half of the RPE: sqrt(mean(rotation of the error of every motion over `delta` steps^2)), radians.

    >>> turning = np.array([[0, 0, 0], [0, 0, 1.0], [0, 0, 2.0]])
    >>> round(relative_heading_error(turning * 1.25, turning), 9)     # a quarter too much at every step
    0.25
    """
    return float(np.sqrt(np.mean(np.square(_errors_of_motion(estimated, truth, delta)[:, 2]))))


def _errors_of_motion(estimated: ArrayLike, truth: ArrayLike, delta: int) -> NDArray[np.float64]:
    """(T - delta, 3) what is left of every estimated motion when the true one is taken off: x, y, theta."""
    estimated, truth = _paired(estimated, truth)
    if not 1 <= as_float("delta", delta) < len(truth) or delta != int(delta):
        raise ValueError(f"delta must be at least 1 and below the {len(truth)} poses, got {delta}")
    moved, truly_moved = (relative(poses[: -int(delta)], poses[int(delta) :]) for poses in (estimated, truth))
    return relative(truly_moved, moved)


def dead_reckoning(log: RobotLog) -> NDArray[np.float64]:
    """(T, 3) where the robot would be by its wheels alone, from `log.start`: the baseline of every localization."""
    check_record("log", log, RobotLog)
    return compose(log.start, relative(log.odometry[0], log.odometry))


def _paired(estimated: ArrayLike, truth: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Both as (T, 3) poses of one length, T at least 1."""
    estimated, truth = check_poses("estimated", estimated), check_poses("truth", truth)
    if len(estimated) != len(truth) or len(truth) == 0:
        raise ValueError(f"estimated and truth must hold the same poses, at least one, got {len(estimated)} and {len(truth)}")
    return estimated, truth
