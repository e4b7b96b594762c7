"""Writing CARMEN logs, so that a simulated drive can be given to other people's mappers."""

from __future__ import annotations

import gzip
import os
from pathlib import Path

import numpy as np

from priorlab.core.checks import check_record
from priorlab.core.files import check_free, write_file
from priorlab.core.readings import RobotLog
from priorlab.interchange.carmen import STAMPED, TRUE_POSES
from priorlab.interchange.carmen_lines import HALF_CIRCLE, half_circle

_HEADER = "# CARMEN log, written by priorlab: message [contents] stamp host logger_stamp; metres, radians, seconds"


def write_carmen(path: str | os.PathLike[str], log: RobotLog, force: bool = False) -> Path:
    """Write a drive as a CARMEN log: an ODOM line and a scan for every step.

    The scan is FLASER when the beams are those that FLASER means (180, 181, 360 or 361 on the half circle in front), otherwise
    ROBOTLASER1. Its first pose is the truth when it is known, the second the odometry. Beams without a return are written as
    the scanner's maximum range: CARMEN knows no difference between "nothing there" and "no reading". Without stamps they are 0.

    Parameters
    ----------
    path : the file; packed by gzip when it ends in .gz
    log : the drive
    force : replace what stands there

    Raises
    ------
    FileExistsError
        When the file is there already.
    ValueError
        When the log is empty or its beams are not spread evenly from right to left, which the format cannot tell.

    >>> import tempfile
    >>> from priorlab.core.sensor import Scanner
    >>> bearings = np.array([-0.5, 0.0, 0.5])
    >>> log = RobotLog([[1, 2, 0]], [[0.5, np.inf, 1.5]], bearings, Scanner(3, 1.0), start=[1, 2, 0])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     print(write_carmen(f"{folder}/a.log", log).read_text().splitlines()[-1])
    ROBOTLASER1 0 -0.5 1 0.5 3 0.02 0 3 0.5 3 1.5 0 1 2 0 1 2 0 0 0 0 0 0 0 priorlab 0
    """
    path = Path(path)
    check_record("log", log, RobotLog)
    if len(log) == 0:
        raise ValueError("the log must hold at least one scan, got 0")
    before_ranges = _before_ranges(log)
    before_poses = " " if before_ranges.startswith("FLASER") else " 0 "  # no remissions
    after_poses = "" if before_ranges.startswith("FLASER") else " 0 0 0 0 0"  # speeds and safety distances
    check_free(path, force)
    limit = log.scanner.max_range_m
    lines = [_HEADER, f"PARAM robot_front_laser_max {_text(limit)} priorlab 0"]
    if log.truth is not None:
        lines.append(f"PARAM {TRUE_POSES} on priorlab 0")
    if log.stamps is not None:
        lines.append(f"PARAM {STAMPED} on priorlab 0")
    poses = log.odometry if log.truth is None else log.truth
    stamps = np.zeros(len(log)) if log.stamps is None else log.stamps
    for ranges, pose, wheels, stamp in zip(log.ranges, poses, log.odometry, stamps, strict=True):
        end = f"{_text(stamp)} priorlab {_text(stamp)}"
        readings = " ".join(map(_text, np.where(np.isfinite(ranges), ranges, limit)))
        wheels_text = " ".join(map(_text, wheels))
        lines.append(f"ODOM {wheels_text} 0 0 0 {end}")
        lines.append(f"{before_ranges} {readings}{before_poses}{' '.join(map(_text, pose))} {wheels_text}{after_poses} {end}")
    text = "\n".join(lines) + "\n"
    write_file(path, gzip.compress(text.encode(), mtime=0) if path.suffix == ".gz" else text)
    return path


def _before_ranges(log: RobotLog) -> str:
    """The scan's line up to its readings."""
    n, bearings = len(log.bearings), log.bearings
    if n in HALF_CIRCLE and np.allclose(bearings, half_circle(n), rtol=0, atol=1e-9):
        return f"FLASER {n}"
    steps = np.diff(bearings)
    if n < 2 or steps.min() <= 0 or np.ptp(steps) > 1e-6:
        raise ValueError(f"bearings must rise evenly for a CARMEN log, got {n} with steps of {steps.tolist()[:4]}")
    step = (bearings[-1] - bearings[0]) / (n - 1)
    settings = (bearings[0], bearings[-1] - bearings[0], step, log.scanner.max_range_m, log.scanner.range_noise_m)
    return f"ROBOTLASER1 0 {' '.join(map(_text, settings))} 0 {n}"


def _text(value: float) -> str:
    """A number that reads back as the same float, without a needless tail.

    >>> _text(2.0), _text(0.1), _text(1000000.0)
    ('2', '0.1', '1000000')
    """
    return str(int(value)) if float(value).is_integer() and abs(value) < 1e15 else repr(float(value))
