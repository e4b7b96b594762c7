"""What the wheels report: true steps with the noise of algorithm 6.3."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import check_poses, check_record, check_rng
from priorlab.core.pose import wrap_angle
from priorlab.core.sensor import Odometry

STANDING_M = 1e-3
"""A step shorter than this is a turn on the spot: the direction of such a translation means nothing."""


def split_step(before: NDArray[np.float64], after: NDArray[np.float64]) -> tuple[NDArray, NDArray, NDArray]:
    """A step as a turn, a straight way and a second turn (algorithm 6.3): rot1, trans, rot2; poses (..., 3), metres.

    >>> turn, way, turn_again = split_step(np.array([0.0, 0.0, 0.0]), np.array([0.0, 2.0, np.pi]))
    >>> [round(float(v / np.pi), 3) for v in (turn, turn_again)], float(way)
    ([0.5, 0.5], 2.0)
    """
    dx, dy = after[..., 0] - before[..., 0], after[..., 1] - before[..., 1]
    trans = np.hypot(dx, dy)  # the root of the sum; the thesis prints a comma
    rot1 = np.where(trans < STANDING_M, 0.0, wrap_angle(np.arctan2(dy, dx) - before[..., 2]))
    return rot1, trans, wrap_angle(after[..., 2] - before[..., 2] - rot1)


def report_odometry(truth: NDArray[np.float64], odometry: Odometry, rng: np.random.Generator) -> NDArray[np.float64]:
    """The path that wheels report for a true path: each step with noise of the variances of algorithm 6.3, added up.

    Parameters
    ----------
    truth : (T, 3) true poses, metres
    odometry : alpha_1 to alpha_4, variances per squared metre or radian of a step
    rng : draws three numbers per step

    Returns
    -------
    (T, 3) poses, metres; they begin at the first true pose and drift from there

    >>> path = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
    >>> report_odometry(path, Odometry(alphas=(0, 0, 0, 0)), np.random.default_rng(0)).tolist()
    [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]
    """
    truth = check_poses("truth", truth)
    if len(truth) == 0:
        raise ValueError("truth must hold at least one pose, got none")
    check_record("odometry", odometry, Odometry)
    rng = check_rng(rng)
    rot1, trans, rot2 = split_step(truth[:-1], truth[1:])
    turn1, turn2 = _size_of_turn(rot1), _size_of_turn(rot2)
    a1, a2, a3, a4 = odometry.alphas
    spread = np.sqrt(
        [
            a1 * turn1**2 + a2 * trans**2,
            a3 * trans**2 + a4 * (turn1**2 + turn2**2),
            a1 * turn2**2 + a2 * trans**2,
        ]
    )
    rot1, trans, rot2 = np.stack([rot1, trans, rot2]) - spread * rng.standard_normal(spread.T.shape).T
    heading = np.concatenate([[0.0], np.cumsum(rot1 + rot2)]) + truth[0, 2]
    direction = heading[:-1] + rot1
    x = truth[0, 0] + np.concatenate([[0.0], np.cumsum(trans * np.cos(direction))])
    y = truth[0, 1] + np.concatenate([[0.0], np.cumsum(trans * np.sin(direction))])
    return np.column_stack([x, y, wrap_angle(heading)])


def _size_of_turn(rotation: NDArray[np.float64]) -> NDArray[np.float64]:
    """How far a turn is for the noise: driving backwards is no half turn."""
    return np.minimum(np.abs(rotation), np.pi - np.abs(rotation))
