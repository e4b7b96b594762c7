"""A survey from a file: the poses at which a robot looked around, as text, as a NumPy array or as TUM text (thesis 4.5.2)."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import check_poses, check_positive
from priorlab.interchange.trajectories import read_tum

_NUMPY = b"\x93NUMPY"
"""How a .npy file begins."""

_TURNS = 4 * np.pi
"""A heading beyond two turns (radians) is one in degrees."""


def read_poses(path: str | os.PathLike[str], metres_per_pixel: float | None = None) -> NDArray[np.float64]:
    """Read poses for `explore`; the file's content decides what it is, not its suffix.

    A text file holds x, y, theta a line, apart by commas, semicolons or blanks; a first line of names and lines that begin
    with # are passed over. A NumPy file (.npy) holds an (N, 3) array. TUM text holds eight numbers a line, always in metres.
    x runs to the right and y UP from the lower left corner of the drawing, theta is in radians, counter-clockwise from +x.

    Parameters
    ----------
    path : the file
    metres_per_pixel : scale of the drawing when the file is in metres; None when it is in pixels

    Returns
    -------
    (N, 3) x, y, theta; pixels

    Raises
    ------
    FileNotFoundError
        When there is no file.
    ValueError
        When a line does not hold three finite numbers, headings are in degrees, the file holds no pose, or TUM text comes
        without a scale. Whether the poses lie in free space is for `explore` to say.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = Path(folder, "survey.csv").write_text("x, y, theta\\n1.5, 2, 0\\n3, 2, 1.57\\n")
    ...     read_poses(f"{folder}/survey.csv").tolist(), read_poses(f"{folder}/survey.csv", metres_per_pixel=0.5).tolist()
    ([[1.5, 2.0, 0.0], [3.0, 2.0, 1.57]], [[3.0, 4.0, 0.0], [6.0, 4.0, 1.57]])
    """
    path = Path(path)
    if metres_per_pixel is not None:
        metres_per_pixel = check_positive("metres_per_pixel", metres_per_pixel)
    if not path.is_file():
        raise FileNotFoundError(f"the poses must be a file, found none at {path}")
    with path.open("rb") as file:
        is_numpy = file.read(len(_NUMPY)) == _NUMPY
    poses = _read_array(path) if is_numpy else _read_text(path, metres_per_pixel)
    if not len(poses):
        raise ValueError(f"the file must hold at least one pose x, y, theta, got none in {path}")
    poses = check_poses("poses", poses)
    beyond = np.flatnonzero(np.abs(poses[:, 2]) > _TURNS)
    if beyond.size:
        raise ValueError(f"theta must be in radians, got {poses[beyond[0], 2]:g} in pose {beyond[0]}: that looks like degrees")
    return poses if metres_per_pixel is None else poses / [metres_per_pixel, metres_per_pixel, 1.0]


def _read_array(path: Path) -> NDArray[np.float64]:
    """The array of a NumPy file."""
    try:
        array = np.load(path, allow_pickle=False)
    except (ValueError, EOFError):
        raise ValueError(f"a NumPy file of poses must hold one array of numbers, got something else in {path}") from None
    if array.dtype.kind not in "fiu":
        raise ValueError(f"a NumPy file of poses must hold numbers, got {array.dtype} in {path}")
    return check_poses("poses", array)


def _read_text(path: Path, metres_per_pixel: float | None) -> NDArray[np.float64]:
    """x, y, theta of every line, or of TUM text when lines hold eight numbers."""
    try:
        lines = path.read_text(encoding="utf-8-sig").splitlines()
    except UnicodeDecodeError:
        raise ValueError(f"the poses must be text or a NumPy array, got something else in {path}") from None
    rows = [(number, _words(line)) for number, line in enumerate(lines, 1)]
    rows = [(number, words) for number, words in rows if words and not words[0].startswith("#")]
    if rows and _numbers(rows[0][1]) is None:
        rows = rows[1:]  # the names of the columns
    if rows and len(rows[0][1]) == 8:
        if metres_per_pixel is None:
            raise ValueError(f"metres_per_pixel must be given to read TUM text, which is in metres, got None for {path}")
        return read_tum(path)[1]
    poses = []
    for number, words in rows:
        pose = _numbers(words)
        if pose is None or len(pose) != 3 or not np.isfinite(pose).all():
            raise ValueError(f"a line must hold three finite numbers x, y, theta, got {' '.join(words)[:60]!r} in line {number}")
        poses.append(pose)
    return np.array(poses, dtype=np.float64).reshape(-1, 3)


def _words(line: str) -> list[str]:
    """The words of a line, whatever they are set apart by."""
    return line.replace(";", " ").replace(",", " ").split()


def _numbers(words: list[str]) -> list[float] | None:
    """The words as numbers; None when one is none."""
    try:
        return [float(word) for word in words]
    except ValueError:
        return None
