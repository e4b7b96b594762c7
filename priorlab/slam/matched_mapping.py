"""Map a building without any plan, from wheels that cannot be believed: every scan is matched to the map of those before it.

The wheels say roughly where the robot went; the match says where it stands on the map that it has made so far; from there the
scan goes into the map. What has once been written is not moved any more: there is no pose graph. An error made on the way stays
until the robot sees a place again, and is then taken back only when it is smaller than the window that is searched.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import check_not_negative, check_positive, check_record
from priorlab.core.grid_map import GridMap
from priorlab.core.pose import compose, relative
from priorlab.core.readings import RobotLog
from priorlab.slam.connected_scan import connect_beams
from priorlab.slam.growing_map import GrowingMap
from priorlab.slam.parameters import LEAST, MOST, Parameters
from priorlab.slam.scan import choose_beams
from priorlab.slam.scan_matching import MATCHING, Window, match_scan
from priorlab.slam.trajectory_error import absolute_trajectory_error_m, heading_errors, true_poses


@dataclass(frozen=True)
class Slip:
    """How far the wheels may be off after a step: standard deviations that grow with it.

    Parameters
    ----------
    least_m, per_m : of the position: metres, and metres per metre
    least_turn, turn_per_m, turn_share : of the heading: radians, radians per metre, and per radian
    """

    least_m: float = 0.05
    per_m: float = 0.1
    least_turn: float = math.radians(1.0)
    turn_per_m: float = math.radians(1.5)
    turn_share: float = 0.1

    def __post_init__(self) -> None:
        for name in ("least_m", "least_turn"):
            check_positive(name, getattr(self, name))
        for name in ("per_m", "turn_per_m", "turn_share"):
            check_not_negative(name, getattr(self, name))

    def window(self, step: NDArray[np.float64]) -> Window:
        """Where to look after the wheels reported a step (3,) in the robot's frame.

        >>> round(Slip().window(np.array([1.0, 0.0, 0.0])).spread_m, 2)
        0.15
        """
        length, turn = math.hypot(step[0], step[1]), abs(step[2])
        return Window(self.least_m + self.per_m * length, self.least_turn + self.turn_per_m * length + self.turn_share * turn)


@dataclass(frozen=True, eq=False)
class MatchedDrive:
    """A drive mapped by matching; all in the frame of the map, whose lower left corner is 0, 0.

    Parameters
    ----------
    log : the drive, its start and truth moved into the frame of the map
    map : what the scans make of it
    trajectory : (T, 3) poses x, y, theta; metres
    low : (2,) where the corner of the map lies in the frame of the log that was given
    explained : (T,) share of the beams that end near an obstacle of the map so far; nan for the first scan
    trusted : (T,) whether the scan alone told the pose; where not, the wheels had their say
    """

    log: RobotLog
    map: GridMap
    trajectory: NDArray[np.float64]
    low: NDArray[np.float64]
    explained: NDArray[np.float64]
    trusted: NDArray[np.bool_]

    def __len__(self) -> int:
        return len(self.trajectory)

    @property
    def matched_log(self) -> RobotLog:
        """The log with the matched poses as its odometry: better wheels for whatever comes next."""
        return replace(self.log, odometry=self.trajectory)

    def ate_m(self) -> float:
        """Root of the mean squared distance to the true position, metres, without alignment."""
        return absolute_trajectory_error_m(self.trajectory, true_poses(self.log))

    def heading_error_deg(self) -> float:
        """Median size of the heading's error, degrees."""
        return float(np.degrees(np.median(np.abs(heading_errors(self.trajectory, true_poses(self.log))))))

    def __repr__(self) -> str:
        rows, cols = self.map.grid.shape
        cell_m = self.map.grid.cell_size_m
        error = "" if self.log.truth is None else f", ATE {self.ate_m():.2f} m"
        share = 100 * self.trusted.mean()
        return f"MatchedDrive({len(self)} scans, {cols * cell_m:.1f} x {rows * cell_m:.1f} m, {share:.0f} % trusted{error})"


def map_by_matching(
    log: RobotLog,
    parameters: Parameters = MATCHING,
    slip: Slip | None = None,
    cell_m: float = 0.05,
    insert_after_m: float = 0.2,
    insert_after_turn: float = math.radians(5.0),
    progress: Callable[[int, int], None] | None = None,
) -> MatchedDrive:
    """Map a drive without a plan: match every scan to the map of those before it, then put it there.

    Parameters
    ----------
    log : odometry and scans; the robot starts at `log.start`
    parameters : of the scans, the field and the map update
    slip : how far the wheels may be off; `Slip()` by default
    cell_m : side of a cell of the map, metres
    insert_after_m, insert_after_turn : a scan goes into the map when the robot has moved so far since the last one that did;
        more scans of one place would only say again what it looks like
    progress : called with the steps done and the steps to do

    Raises
    ------
    ValueError
        When the log is empty.
    """
    slip = Slip() if slip is None else slip
    for name, value, kind in (("log", log, RobotLog), ("parameters", parameters, Parameters), ("slip", slip, Slip)):
        check_record(name, value, kind)
    if len(log) == 0:
        raise ValueError("the log must hold at least one scan, got 0")
    if not LEAST <= check_positive("cell_m", cell_m) <= MOST:
        raise ValueError(f"cell_m must lie between {LEAST:g} and {MOST:g}, got {cell_m:g}")
    check_not_negative("insert_after_m", insert_after_m)
    check_not_negative("insert_after_turn", insert_after_turn)
    all_beams = replace(parameters, n_beams=len(log.bearings))
    growing = GrowingMap(parameters, cell_m, log.start[:2])
    steps = relative(log.odometry[:-1], log.odometry[1:])
    poses, inserted_at = [log.start], log.start
    explained, trusted = [math.nan], [True]
    growing.insert(log.start, connect_beams(choose_beams(log, 0, all_beams), cell_m))
    for k in range(1, len(log)):
        guess = growing.into(compose(poses[-1], steps[k - 1]))
        match = match_scan(choose_beams(log, k, parameters), growing.field, guess, slip.window(steps[k - 1]))
        pose = match.pose + [*growing.low, 0.0]
        moved = relative(inserted_at, pose)
        if math.hypot(moved[0], moved[1]) >= insert_after_m or abs(moved[2]) >= insert_after_turn:
            growing.insert(pose, connect_beams(choose_beams(log, k, all_beams), cell_m))
            inserted_at = pose
        poses.append(pose)
        explained.append(match.explained)
        trusted.append(match.trusted)
        if progress:
            progress(k + 1, len(log))
    return _finish(log, growing, np.array(poses), np.array(explained), np.array(trusted))


def _finish(
    log: RobotLog, growing: GrowingMap, poses: NDArray[np.float64], explained: NDArray[np.float64], trusted: NDArray[np.bool_]
) -> MatchedDrive:
    """All in the frame of the map, which has its corner only now."""
    growing.trim()
    truth = None if log.truth is None else growing.into(log.truth)
    moved = replace(log, start=growing.into(log.start), truth=truth)
    return MatchedDrive(moved, growing.map, growing.into(poses), growing.low, explained, trusted)
