"""Surveys drawn from a dense one: where the robot starts, where it stops and which way it looks first is left to a seed."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.checks import check_poses, check_rng


def lanes_of(survey: ArrayLike) -> list[NDArray[np.float64]]:
    """The straight lanes of a survey made by `look_around`, in order.

    A lane is a run of poses along one axis at equal steps; on a horizontal one the robot looks up and down, on a vertical one
    right and left (eq. 5.3, 5.4).

    >>> poses = [[0, 0, 1.5708], [2, 0, -1.5708], [4, 0, 1.5708], [9, 5, 0], [9, 7, 3.1416]]
    >>> [len(lane) for lane in lanes_of(poses)]
    [3, 2]
    """
    poses = check_poses("survey", survey)
    upright = np.abs(np.cos(poses[:, 2])) > 0.5
    step = np.diff(poses[:, :2], axis=0)
    along = np.where(upright[1:], step[:, 1], step[:, 0])
    across = np.where(upright[1:], step[:, 0], step[:, 1])
    usual = np.median(along[(along > 0) & (np.abs(across) < 1e-6)]) if len(along) else 0.0
    goes_on = (upright[1:] == upright[:-1]) & (np.abs(across) < 1e-6) & (np.abs(along - usual) < 1e-6)
    return np.split(poses, np.flatnonzero(~goes_on) + 1)


def thinned(survey: ArrayLike, every: int, rng: np.random.Generator) -> NDArray[np.float64]:
    """A quicker survey on the same lanes: every so-manyth pose, from a random one on, looking to both sides by turns.

    Parameters
    ----------
    survey : (N, 3) x, y, theta, a dense one
    every : 1 keeps all poses, 12 keeps about a twelfth
    rng : draws the lane that comes first, and for each lane its first pose and the side it looks to first

    Returns
    -------
    (M, 3) poses; no two seeds give the same, and on average all give as many
    """
    if every < 1 or every != int(every):
        raise ValueError(f"every must be a whole number of at least 1, got {every}")
    lanes, rng = lanes_of(survey), check_rng(rng)
    first = int(rng.integers(len(lanes)))
    kept = []
    for lane in lanes[first:] + lanes[:first]:
        poses = lane[int(rng.integers(every)) :: int(every)].copy()
        side = int(rng.integers(2))
        poses[:, 2] = lane[0, 2] + np.pi * ((np.arange(len(poses)) + side) % 2)
        kept.append(poses)
    return np.concatenate(kept)


def part_of(survey: ArrayLike, share: float, rng: np.random.Generator) -> NDArray[np.float64]:
    """An incomplete exploration: the share of a survey's poses that lies nearest to a random one of them, in their order.

    >>> part_of([[0, 0, 0], [10, 0, 0], [20, 0, 0], [90, 0, 0]], 0.5, np.random.default_rng(0))[:, 0].tolist()
    [20.0, 90.0]
    """
    if not 0 < share <= 1:
        raise ValueError(f"share must lie in (0, 1], got {share:g}")
    poses, rng = check_poses("survey", survey), check_rng(rng)
    middle = poses[int(rng.integers(len(poses))), :2]
    nearest = np.argsort(np.hypot(*(poses[:, :2] - middle).T), kind="stable")[: max(1, round(share * len(poses)))]
    return poses[np.sort(nearest)]
