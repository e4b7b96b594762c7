"""One scan as the filter uses it: the beams that returned, thinned to the number that weighs; and which scans weigh."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import check_record
from priorlab.core.pose import wrap_angle
from priorlab.core.readings import RobotLog
from priorlab.slam.parameters import Parameters


@dataclass(frozen=True, eq=False)
class Scan:
    """The returns of one scan, metres and radians in the robot's frame.

    Parameters
    ----------
    ranges, bearings : (B,) beams that met something
    open_bearings : (C,) beams that met nothing within the range; they never weigh
    offset : x, y of the scanner in the robot's frame
    """

    ranges: NDArray[np.float64]
    bearings: NDArray[np.float64]
    open_bearings: NDArray[np.float64]
    offset: tuple[float, float] = (0.0, 0.0)

    def __len__(self) -> int:
        return len(self.ranges)

    @property
    def points(self) -> NDArray[np.float64]:
        """(B, 2) ends of the beams in the robot's frame."""
        x, y = self.offset
        return np.column_stack([x + self.ranges * np.cos(self.bearings), y + self.ranges * np.sin(self.bearings)])


def choose_beams(log: RobotLog, step: int, parameters: Parameters) -> Scan:
    """The beams of `log`'s scan number `step` that count.

    nan is no reading; too near, too far and inf are no return (the test z != z_max of algorithm 6.4, with the sensor's range
    for z_max). What is left is thinned evenly to `parameters.n_beams`: thinning first would leave too few.
    """
    check_record("log", log, RobotLog)
    check_record("parameters", parameters, Parameters)
    if not isinstance(step, int | np.integer) or not -len(log) <= step < len(log):
        raise ValueError(f"step must be a whole number below the {len(log)} scans of the log, got {step!r}")
    ranges, bearings = log.ranges[step], log.bearings
    farthest = min(parameters.max_range_m, log.scanner.max_range_m)
    returned = np.flatnonzero((ranges >= log.scanner.min_range_m) & (ranges < farthest) & (ranges > 0))  # False for nan
    open_beams = np.flatnonzero(ranges >= farthest)
    return Scan(
        ranges[_spread(returned, parameters.n_beams)],
        bearings[_spread(returned, parameters.n_beams)],
        bearings[_spread(open_beams, parameters.n_beams)],
        parameters.sensor_offset_m,
    )


def weighing_steps(log: RobotLog, parameters: Parameters) -> NDArray[np.bool_]:
    """(T,) True for the steps whose scan weighs: it has a return, and the wheels say that the robot has driven `weigh_every_m` or
    turned `weigh_every_theta` since the last scan that weighed.

    A robot that stands sees one thing again and again. Readings of one thing share their error, above all furniture that the
    plan lacks, and counted as independent they would outvote everything seen before.
    """
    weighs = np.zeros(len(log), dtype=bool)
    last = None
    for k, pose in enumerate(log.odometry):
        if last is not None:
            driven, turned = np.hypot(*(pose - last)[:2]), abs(wrap_angle(pose[2] - last[2]))
            if driven < parameters.weigh_every_m and turned < parameters.weigh_every_theta:
                continue
        if len(choose_beams(log, k, parameters)):
            weighs[k], last = True, pose
    return weighs


def _spread(indices: NDArray[np.int64], at_most: int) -> NDArray[np.int64]:
    """At most `at_most` of the indices, evenly spread, the first and the last among them."""
    if len(indices) <= at_most:
        return indices
    return indices[np.rint(np.linspace(0, len(indices) - 1, at_most)).astype(np.int64)]
