"""What a robot's own log says of how well it was followed: which errors mean something, and whether the robot got lost."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from priorlab.core.pose import compose
from priorlab.core.readings import RobotLog
from priorlab.report.own_log import OwnLog, told_of_walls
from priorlab.slam.lost import LOST_M
from priorlab.slam.recording import Run
from priorlab.slam.trajectory_error import dead_reckoning, position_errors_m

LOST_DEGREES = 20.0
"""A median error of the heading above this: the log was followed in a map that is another building's, or turned."""

FEW_EXPLAINED = 0.4
"""Below this share of explained beams (median) something is wrong: 0.90 to 0.98 in the right map, 0.13 to 0.35 in another's."""

NO_ERROR_M = 0.001
"""Wheels that stay this close to the corrected way over a whole log are no wheels, but the corrected poses once more."""


@dataclass(frozen=True, eq=False)
class Verdict:
    """What is to be thought of a run.

    Parameters
    ----------
    corrected : the log with the poses that errors are measured against: laid on an exact start, else aligned with the estimate
    lost : a sentence when the robot got lost, or None
    explained : median share of a scan's beams that end at a wall of the plan, or None when no scan had enough beams
    wheels_without_error : the log's odometry is its corrected way
    notes : sentences for the user
    """

    corrected: RobotLog | None
    lost: str | None
    explained: float | None
    wheels_without_error: bool
    notes: tuple[str, ...]


def judge(run: Run, own: OwnLog) -> Verdict:
    """Hold a run against the log's corrected poses, where it has them, and against the plan's walls.

    A start that the user called uncertain is no place to lay the corrected way on: a filter that finds itself would be scored as
    wrong by what the start was off. Then the way is aligned with the estimate first (turned and moved, least squares).
    """
    corrected = own.corrected
    if corrected is not None and corrected.truth is not None and not own.has_exact_start:
        corrected = replace(corrected, truth=aligned(corrected.truth, run.trajectory))
    no_error = corrected is not None and has_wheels_without_error(own.corrected)
    lost = run.lost_because or (None if corrected is None else _off_the_way(run, corrected, own.has_exact_start))
    explained = float(np.nanmedian(run.explained)) if np.isfinite(run.explained).any() else None
    return Verdict(corrected, lost, explained, no_error, tuple(_notes(own, lost, no_error, explained)))


def has_wheels_without_error(log: RobotLog | None) -> bool:
    """True when dead reckoning is the true way: published logs often keep the corrected poses only, as odometry too."""
    if log is None or log.truth is None or len(log) < 2:
        return False
    wheels = compose(log.truth[0], dead_reckoning(replace(log, start=np.zeros(3))))
    return bool(position_errors_m(wheels, log.truth).max() < NO_ERROR_M)


def aligned(way: NDArray[np.float64], estimate: NDArray[np.float64]) -> NDArray[np.float64]:
    """A way, turned and moved as a whole until it lies on another, by least squares.

    Every pose counts as two points, its position and the one a metre ahead: so a robot that hardly moved has a direction too.

    >>> way = np.array([[0, 0, 0], [2, 0, 0], [2, 1, 1.5]])
    >>> bool(np.allclose(aligned(way, compose([5, -3, 0.7], way)), compose([5, -3, 0.7], way)))
    True
    """
    points, wished = (_and_a_metre_ahead(poses) for poses in (way, estimate))
    here, there = points - points.mean(axis=0), wished - wished.mean(axis=0)
    turn = np.arctan2((here[:, 0] * there[:, 1] - here[:, 1] * there[:, 0]).sum(), (here * there).sum())
    turned = compose([0.0, 0.0, turn], way)
    turned[:, :2] += wished.mean(axis=0) - _and_a_metre_ahead(turned).mean(axis=0)
    return turned


def _and_a_metre_ahead(poses: NDArray[np.float64]) -> NDArray[np.float64]:
    """(2 T, 2) the positions, and the points a metre ahead of them."""
    return np.concatenate([poses[:, :2], compose(poses, [1.0, 0.0, 0.0])[:, :2]])


def _off_the_way(run: Run, corrected: RobotLog, exact_start: bool) -> str | None:
    """A sentence when the estimate is not the log's corrected way; from a start that is not exact it may begin elsewhere."""
    assert corrected.truth is not None
    worst_m = float(position_errors_m(run.trajectory, corrected.truth).max())
    degrees = run.heading_error_deg(corrected)
    if (worst_m if exact_start else run.ate_m(corrected)) <= LOST_M and degrees <= LOST_DEGREES:
        return None
    return (
        "the robot did not follow the log's corrected way: the start or the map is wrong; "
        f"at worst {worst_m:.1f} m off, and {degrees:.0f} degrees in the median"
    )


def _notes(own: OwnLog, lost: str | None, no_error: bool, explained: float | None) -> list[str]:
    """What the user should know of these numbers."""
    notes = [told] if (told := told_of_walls(own)) else []
    if own.corrected is not None:
        laid = "laid on the start" if own.has_exact_start else "aligned with the estimate, as the start is not exact"
        cannot = "" if lost else ": they cannot tell a wrong start"
        notes.append(f"the errors are against the log's corrected poses, {laid}{cannot}")
    if no_error:
        notes.append(
            "the log keeps only corrected poses, its wheels have no error: the errors say nothing about those of your robot"
        )
    if explained is not None:
        notes.append(f"the plan's walls explain {100 * explained:.0f} % of a scan's beams (median)")
        if explained < FEW_EXPLAINED:
            notes.append(
                f"WARNING: below {100 * FEW_EXPLAINED:.0f} % the start or the map is most likely wrong (the right one explains "
                "90 % and more, a plan without the furniture less): look at map.png"
            )
    return notes
