"""The lines of a CARMEN log: scans (FLASER, ROBOTLASER1), odometry (ODOM) and settings (PARAM), each checked on its own.

    FLASER n [n ranges] x y theta odom_x odom_y odom_theta stamp host logger_stamp
    ROBOTLASER1 type start_angle field_of_view step max_range accuracy remission_mode n [n ranges] m [m remissions]
        laser_x laser_y laser_theta robot_x robot_y robot_theta tv rv forward_distance side_distance turn_axis
        stamp host logger_stamp
    ODOM x y theta tv rv acceleration stamp host logger_stamp
    PARAM name value

Metres, radians, seconds. Other messages are passed over.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

HALF_CIRCLE = (180, 181, 360, 361)
"""Numbers of readings for which FLASER, which tells no angles, means the half circle in front."""


def half_circle(n: int) -> NDArray[np.float64]:
    """(n,) bearings of FLASER: -pi/2 + i pi / n of 180 or 360, and n - 1 for n when the last beam closes the half circle.

    >>> np.degrees(half_circle(180)[[0, -1]]).round(6).tolist(), np.degrees(half_circle(361)[[0, -1]]).round(6).tolist()
    ([-90.0, 89.0], [-90.0, 90.0])
    """
    return np.linspace(-np.pi / 2, np.pi / 2, n, endpoint=n % 2 == 1)


@dataclass(frozen=True, eq=False)
class CarmenScan:
    """One scan as its line tells it.

    Parameters
    ----------
    line : number of the line, from 1
    kind : "FLASER" or "ROBOTLASER1"
    ranges : (B,) metres, as written
    pose : (3,) the first pose of the line: the laser's, or the one that a mapper has corrected
    wheels : (3,) the second one: the robot's by its odometry
    stamp : seconds; 0 when it has none
    start_angle, step : radians; bearing of the first beam and from beam to beam; None when the line does not tell
    max_range_m, accuracy_m : of the laser; None when the line does not tell
    """

    line: int
    kind: str
    ranges: NDArray[np.float64]
    pose: NDArray[np.float64]
    wheels: NDArray[np.float64]
    stamp: float
    start_angle: float | None = None
    step: float | None = None
    max_range_m: float | None = None
    accuracy_m: float | None = None

    @property
    def bearings(self) -> NDArray[np.float64]:
        """(B,) radians to the heading."""
        n = len(self.ranges)
        if self.start_angle is None or self.step is None:
            return half_circle(n)
        return np.linspace(self.start_angle, self.start_angle + self.step * (n - 1), n)


def parse_scan(words: list[str], line: int) -> CarmenScan:
    """A line of FLASER or ROBOTLASER1 as a scan.

    Raises
    ------
    ValueError
        When the line does not hold what it promises, or a number that cannot be; the sentence names the line.

    >>> words = "ROBOTLASER1 0 -0.1 0.2 0.1 8 0.01 0 3 1 2.5 8 0 5 6 0.5 5 6 0.5 0 0 0 0 0 7.25 host 7.25".split()
    >>> scan = parse_scan(words, line=4)
    >>> scan.ranges.tolist(), scan.bearings.round(3).tolist(), scan.pose.tolist(), scan.stamp
    ([1.0, 2.5, 8.0], [-0.1, 0.0, 0.1], [5.0, 6.0, 0.5], 7.25)
    """
    kind = words[0]
    counted_at = 1 if kind == "FLASER" else 8
    n = _count(words, counted_at, "readings", line)
    after = counted_at + 1 + n
    if kind == "FLASER":
        if n not in HALF_CIRCLE:
            raise ValueError(f"FLASER must hold 180, 181, 360 or 361 readings, as it tells no angles, got {n} in line {line}")
        _check_length(words, after + 9, line)
        ranges, poses, stamp = _ranges(words[2:after], line), _poses(words[after : after + 6], line), words[after + 6 :]
        return CarmenScan(line, kind, ranges, poses[0], poses[1], _stamp(stamp, line))
    n_remissions = _count(words, after, "remissions", line)
    after_remissions = after + 1 + n_remissions
    _check_length(words, after_remissions + 14, line)
    start_angle, _, step, max_range, accuracy = _numbers(words[2:7], "the laser's settings", line)
    for name, value in (("step between beams", step), ("maximum range", max_range)):
        if value <= 0:
            raise ValueError(f"the laser's {name} must be above 0, got {value:g} in line {line}")
    poses = _poses(words[after_remissions : after_remissions + 6], line)
    ranges, stamp = _ranges(words[9:after], line), words[after_remissions + 11 :]
    return CarmenScan(line, kind, ranges, poses[0], poses[1], _stamp(stamp, line), start_angle, step, max_range, abs(accuracy))


def parse_odometry(words: list[str], line: int) -> NDArray[np.float64]:
    """(4,) stamp, x, y, theta of a line of ODOM."""
    _check_length(words, 10, line)
    return np.array([_stamp(words[7:], line), *_numbers(words[1:4], "a pose", line)])


def _count(words: list[str], place: int, what: str, line: int) -> int:
    """How many readings or remissions the line promises."""
    if place >= len(words):
        raise ValueError(f"{words[0]} must tell its number of {what}, got a line cut off after {len(words)} words in line {line}")
    if not words[place].isdecimal() or (what == "readings" and int(words[place]) == 0):
        raise ValueError(f"{words[0]}'s number of {what} must be a whole number, got {words[place][:20]!r} in line {line}")
    return int(words[place])


def _check_length(words: list[str], expected: int, line: int) -> None:
    """Say when a line is longer or shorter than what it promises."""
    if len(words) != expected:
        raise ValueError(f"{words[0]} must hold the {expected} words that it promises, got {len(words)} in line {line}")


def _numbers(words: list[str], what: str, line: int) -> list[float]:
    """Finite numbers."""
    try:
        values = [float(word) for word in words]
    except ValueError:
        values = [math.nan]
    if not all(map(math.isfinite, values)):
        raise ValueError(f"{what} must be finite numbers, got {' '.join(words)[:60]!r} in line {line}")
    return values


def _ranges(words: list[str], line: int) -> NDArray[np.float64]:
    """Readings; inf is allowed, some lasers say so that nothing came back."""
    try:
        ranges = np.array([float(word) for word in words])
    except ValueError:
        ranges = np.array([np.nan])
    if np.isnan(ranges).any():
        wrong = next(word for word in words if not _is_reading(word))
        raise ValueError(f"a range must be a number, got {wrong[:20]!r} in line {line}")
    if (ranges < 0).any():
        raise ValueError(f"a range must not be negative, got {ranges.min():g} in line {line}")
    return ranges


def _is_reading(word: str) -> bool:
    """Whether a word is a number, and not nan."""
    try:
        return not math.isnan(float(word))
    except ValueError:
        return False


def _poses(words: list[str], line: int) -> NDArray[np.float64]:
    """(2, 3) the two poses of a scan."""
    return np.array(_numbers(words, "the poses of a scan", line)).reshape(2, 3)


def _stamp(words: list[str], line: int) -> float:
    """When it was measured; when that is 0, when it was logged."""
    measured, logged = _numbers([words[0], words[2]], "the stamps", line)
    return measured or logged
