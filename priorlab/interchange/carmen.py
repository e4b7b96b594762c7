"""Logs of real robots: CARMEN text, plain or gzip, as the Radish collection and many robotics groups publish it."""

from __future__ import annotations

import gzip
import os
import zlib
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import check_flag, check_positive, check_whole
from priorlab.core.pose import relative, wrap_angle
from priorlab.core.readings import RobotLog
from priorlab.core.sensor import Scanner
from priorlab.interchange.carmen_lines import CarmenScan, parse_odometry, parse_scan

FAULT_M = 81.8
"""The SICK lasers of these logs say 81.83 to 81.91 m when nothing usable came back."""

PILED_UP = 10
"""The farthest range of a log that tells no limit is one when so many readings have it: 50 m in the log of ACES."""

MOUNTED_M, MOUNTED_TURN = 0.01, 0.01
"""The laser's pose and the robot's tell one path when the step between them never changes by more (metres, radians)."""

DRIFT_M = 0.5
"""ODOM lines tell another path than the scans when they part by more: the robot drives no such way between two messages."""

ACCURACY_M = 0.01
"""Noise of a range where the log does not tell it: the laser's data sheet."""

FOLLOWS_S = 60.0
"""A clock that begins at 0 says the next scan's time within so many seconds; a date would be far from it."""

STAMPED = "priorlab_has_stamps"
"""Setting in the logs that `write_carmen` writes from a drive with stamps: there 0 is a moment."""

TRUE_POSES = "priorlab_first_pose_is_true"
"""Setting in the logs that `write_carmen` writes from a drive whose truth is known."""


def read_carmen(
    path: str | os.PathLike[str], max_range_m: float | None = None, corrected: bool | None = None, first: int | None = None
) -> RobotLog:
    """Read the scans of a CARMEN log.

    A reading at the laser's limit says nothing: no obstacle, but no free space either, since sunlight, glass and black cloth
    give it as well. It becomes nan, "no reading", as does a range of 0. The limit is `max_range_m`; without it what the log
    tells (ROBOTLASER1, or PARAM robot_front_laser_max), and 81.8 m at most; without that the farthest range, when ten readings
    have it.

    The scans are ordered by their stamps. Loggers write 0 for "no stamp": when all are 0, or a few in the midst of others, the
    scans stay in the order of the file and `stamps` is None, since nobody knows when those few were taken. A simulator's clock
    begins at 0: a 0 is a moment when it stands in line with the others, or when the lines are shuffled and one alone has it,
    and another scan follows within a minute; and always in a log that `write_carmen` wrote with stamps.

    Parameters
    ----------
    path : the file; gzip is known by its content
    max_range_m : readings from here on are no return
    corrected : whether the poses of the scans were corrected by a mapper, which makes them the truth. None: yes when the log
        comes from such a mapper (NEFF lines), when the two poses of the scans tell different paths, or when ODOM lines do
    first : read only so many scans

    Returns
    -------
    RobotLog in metres, its poses those of the laser. `truth` are corrected poses, or None. `odometry` is what the wheels said;
    a corrected log often keeps nothing of that, then it equals the truth, and noise has to be simulated. `start` is the first
    pose of the truth, or of the odometry.

    Raises
    ------
    FileNotFoundError
        When there is no file.
    ValueError
        When it holds no scan, is cut off, mixes lasers, or holds a number that cannot be. The sentence names the line.

    >>> import tempfile
    >>> scan = "FLASER 180 " + "2.5 " * 179 + "81.91  1 2 0  1 2 0  12.5 robot 12.5"
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = Path(folder, "a.log").write_text(scan)
    ...     log = read_carmen(f"{folder}/a.log")
    >>> log.ranges[0, -2:].tolist(), log.start.tolist()
    ([2.5, nan], [1.0, 2.0, 0.0])
    """
    if max_range_m is not None:
        max_range_m = check_positive("max_range_m", max_range_m)
    if first is not None:
        first = check_whole("first", first)
    if corrected is not None:
        check_flag("corrected", corrected)
    scans: list[CarmenScan] = []
    wheels: list[NDArray[np.float64]] = []
    settings: dict[str, str] = {}
    from_mapper = False
    for line, words in _lines(Path(path)):
        if words[0] in ("FLASER", "ROBOTLASER1"):
            if first is not None and len(scans) == first:
                break
            scans.append(parse_scan(words, line))
            _check_same_laser(scans[0], scans[-1])
        elif words[0] == "ODOM":
            wheels.append(parse_odometry(words, line))
        elif words[0] == "PARAM" and len(words) > 2:
            settings[words[1]] = words[2]
        elif words[0] == "NEFF":
            from_mapper = True
    if not scans:
        raise ValueError(f"a CARMEN log must hold scans (FLASER or ROBOTLASER1), got none in {path}")

    stamps = None
    if STAMPED in settings or _are_moments(np.array([scan.stamp for scan in scans])):
        scans.sort(key=lambda scan: scan.stamp)
        stamps = np.array([scan.stamp for scan in scans])
    poses, odometry = np.array([scan.pose for scan in scans]), np.array([scan.wheels for scan in scans])
    by_odom_lines = _between(np.array(wheels), stamps) if wheels and stamps is not None else None
    if not (apart := _tell_different_paths(poses, odometry)):
        odometry = poses  # the same path; this one is the laser's
        if by_odom_lines is not None and np.hypot(*(by_odom_lines - poses)[:, :2].T).max() > DRIFT_M:
            odometry, apart = by_odom_lines, True
    is_true = (apart or from_mapper or TRUE_POSES in settings) if corrected is None else corrected
    ranges = np.array([scan.ranges for scan in scans])
    limit = max_range_m or _limit(scans[0], ranges, settings)
    ranges = np.where((ranges >= limit) | (ranges == 0), np.nan, ranges)
    return RobotLog(odometry, ranges, scans[0].bearings, _scanner(scans[0], limit), poses[0], poses if is_true else None, stamps)


def _lines(path: Path) -> Iterator[tuple[int, list[str]]]:
    """Number and words of every line that says something; gzip is unpacked."""
    if not path.is_file():
        raise FileNotFoundError(f"the log must be a file, found none at {path}")
    with path.open("rb") as file:
        is_gzip = file.read(2) == b"\x1f\x8b"
    number = 0
    try:
        with gzip.open(path, "rb") if is_gzip else path.open("rb") as file:
            for number, raw in enumerate(file, 1):
                words = raw.decode("ascii").split()
                if words and not words[0].startswith("#"):
                    yield number, words
    except UnicodeDecodeError:
        raise ValueError(f"a CARMEN log must be text, got something else in line {number} of {path}") from None
    except (EOFError, zlib.error, gzip.BadGzipFile) as broken:
        raise ValueError(f"a gzip file must be whole, got one that breaks off after line {number}: {path}") from broken


def _check_same_laser(one: CarmenScan, other: CarmenScan) -> None:
    """Say when a log holds the scans of two lasers."""
    if one.kind != other.kind:
        raise ValueError(f"a log must hold one kind of scan, got {one.kind} and, in line {other.line}, {other.kind}")
    if len(one.ranges) != len(other.ranges):
        raise ValueError(
            f"all scans of a log must have {len(one.ranges)} readings, as the first, got {len(other.ranges)} in line {other.line}"
        )
    if np.abs(one.bearings - other.bearings).max() > 1e-3:
        raise ValueError(f"all scans of a log must have the angles of the first, got others in line {other.line}")


def _are_moments(stamps: NDArray[np.float64]) -> bool:
    """Whether all stamps say when; a 0 may also say that there is none."""
    told = stamps[stamps != 0]
    if len(told) in (0, len(stamps)):
        return len(told) > 0
    is_in_line = (np.diff(stamps) >= 0).all()
    is_shuffled = (np.diff(told) < 0).any() and len(stamps) == len(told) + 1
    return bool((is_in_line or is_shuffled) and np.abs(told).min() <= FOLLOWS_S)


def _tell_different_paths(poses: NDArray[np.float64], wheels: NDArray[np.float64]) -> bool:
    """Whether two rows of poses are not those of two points of one body."""
    mounting = relative(wheels, poses)
    moved = np.abs(mounting - mounting[0])
    return bool((moved[:, :2] > MOUNTED_M).any() or (np.abs(wrap_angle(moved[:, 2])) > MOUNTED_TURN).any())


def _between(wheels: NDArray[np.float64], stamps: NDArray[np.float64]) -> NDArray[np.float64] | None:
    """(T, 3) ODOM lines at the stamps of the scans; None when they do not span them, to a second, or some have no stamp."""
    has_stamps = _are_moments(wheels[:, 0])
    wheels = wheels[np.argsort(wheels[:, 0], kind="stable")]
    if not has_stamps or wheels[0, 0] > stamps[0] + 1 or wheels[-1, 0] < stamps[-1] - 1:
        return None
    x, y, theta = (np.interp(stamps, wheels[:, 0], column) for column in (wheels[:, 1], wheels[:, 2], np.unwrap(wheels[:, 3])))
    return np.column_stack([x, y, wrap_angle(theta)])


def _limit(scan: CarmenScan, ranges: NDArray[np.float64], settings: dict[str, str]) -> float:
    """From which range on a reading says nothing."""
    told = settings.get("robot_front_laser_max") if scan.max_range_m is None else str(scan.max_range_m)
    if told is not None:
        try:
            return min(check_positive("robot_front_laser_max", float(told)), FAULT_M)
        except ValueError:
            raise ValueError(f"robot_front_laser_max must be a number above 0, got {told[:20]!r}") from None
    farthest = float(ranges.max())
    return min(farthest, FAULT_M) if np.count_nonzero(ranges == farthest) >= PILED_UP else FAULT_M


def _scanner(scan: CarmenScan, limit: float) -> Scanner:
    """The laser as a record."""
    bearings = scan.bearings
    field_of_view = float(bearings[-1] - bearings[0]) if len(bearings) > 1 else 2 * np.pi / 360
    noise = ACCURACY_M if scan.accuracy_m is None else scan.accuracy_m
    return Scanner(len(bearings), field_of_view, 0.0, limit, noise, outlier_rate=0.0, dropout_rate=0.0)
