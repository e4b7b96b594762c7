"""Trajectories as TUM text, which evo and others read: stamp tx ty tz qx qy qz qw, one pose a line."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.checks import as_numbers, check_poses
from priorlab.core.files import check_free, write_file
from priorlab.core.pose import wrap_angle
from priorlab.interchange.text_lines import numbered_lines

_TILT = 1e-3
"""A quaternion with more in qx or qy leaves the plane."""


def write_tum(path: str | os.PathLike[str], poses: ArrayLike, stamps: ArrayLike | None = None, force: bool = False) -> Path:
    """Write planar poses as TUM text; the yaw theta is the quaternion (0, 0, sin theta/2, cos theta/2).

    Parameters
    ----------
    path : the file
    poses : (T, 3) x, y (metres), theta (radians)
    stamps : (T,) seconds; 0, 1, 2, ... when not given
    force : replace what stands there

    Raises
    ------
    FileExistsError
        When the file is there already.
    ValueError
        When poses or stamps are not finite numbers of matching length.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     print(write_tum(f"{folder}/path.tum", [[1.0, 2.0, np.pi / 2]]).read_text())
    # stamp tx ty tz qx qy qz qw
    0.000000 1.000000000 2.000000000 0 0 0 0.707106781187 0.707106781187
    <BLANKLINE>
    """
    path = Path(path)
    poses = check_poses("poses", poses)
    stamps = np.arange(len(poses), dtype=np.float64) if stamps is None else as_numbers("stamps", stamps)
    if stamps.shape != (len(poses),) or not np.isfinite(stamps).all():
        raise ValueError(f"stamps must be {len(poses)} finite numbers, one per pose, got shape {stamps.shape}")
    check_free(path, force)
    lines = ["# stamp tx ty tz qx qy qz qw"]
    for stamp, (x, y, theta) in zip(stamps, poses, strict=True):
        lines.append(f"{stamp:.6f} {x:.9f} {y:.9f} 0 0 0 {np.sin(theta / 2):.12f} {np.cos(theta / 2):.12f}")
    write_file(path, "\n".join(lines) + "\n")
    return path


def read_tum(path: str | os.PathLike[str]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Read TUM text: (T,) stamps in seconds and (T, 3) poses x, y, theta in the plane. The height tz is left out.

    Raises
    ------
    FileNotFoundError
        When there is no file.
    ValueError
        When a line does not hold eight finite numbers, the quaternion is 0, or it tilts out of the plane.
    """
    rows = [_row(line, number) for number, line in numbered_lines(path, "the trajectory")]
    table = np.array(rows, dtype=np.float64).reshape(-1, 8)
    qz, qw = table[:, 6], table[:, 7]
    theta = wrap_angle(2 * np.arctan2(qz, qw))
    return table[:, 0], np.column_stack([table[:, 1:3], theta])


def _row(line: str, number: int) -> list[float]:
    """The eight numbers of a line, checked."""
    try:
        values = [float(word) for word in line.split()]
    except ValueError:
        values = []
    if len(values) != 8 or not np.isfinite(values).all():
        raise ValueError(f"a TUM line must hold eight finite numbers, got {line.strip()[:60]!r} in line {number}")
    length = float(np.linalg.norm(values[4:]))
    if length < 1e-6 or max(abs(values[4]), abs(values[5])) > _TILT * length:
        raise ValueError(f"a pose must be a turn in the plane (qx = qy = 0), got quaternion {values[4:]} in line {number}")
    return values
