"""Relations between poses of a log, checked by hand (Kuemmerle et al. 2009): t1 t2 dx dy dz roll pitch yaw, one a line."""

from __future__ import annotations

import os
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import check_poses
from priorlab.interchange.text_lines import numbered_lines

_TILT = 1e-3
"""Rolling or pitching by more (radians), or climbing by more (metres), leaves the plane."""


@dataclass(frozen=True, eq=False)
class Relations:
    """True steps between two moments each.

    Parameters
    ----------
    stamps : (R, 2) seconds, the two moments
    steps : (R, 3) where the robot stood at the second moment, in its own frame of the first: x, y (metres), theta (radians)
    """

    stamps: NDArray[np.float64]
    steps: NDArray[np.float64]

    def __post_init__(self) -> None:
        steps = check_poses("steps", self.steps)
        stamps = np.asarray(self.stamps, dtype=np.float64)
        if stamps.shape != (len(steps), 2) or not np.isfinite(stamps).all():
            raise ValueError(f"stamps must be {len(steps)} pairs of finite numbers, one per step, got shape {stamps.shape}")
        object.__setattr__(self, "stamps", stamps)
        object.__setattr__(self, "steps", steps)

    def __len__(self) -> int:
        return len(self.steps)

    def __repr__(self) -> str:
        return f"Relations({len(self)} steps)"


def read_relations(path: str | os.PathLike[str]) -> Relations:
    """Read a file of relations. Lines that begin with # are passed over.

    Raises
    ------
    FileNotFoundError
        When there is no file.
    ValueError
        When it is no text or holds no relation, when a line does not hold eight finite numbers, or when it leaves the plane.

    >>> import tempfile
    >>> from pathlib import Path
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = Path(folder, "a.relations").write_text("10.5 12.0  0.4 0.1 0  0 0 1.57\\n")
    ...     relations = read_relations(f"{folder}/a.relations")
    >>> relations.stamps.tolist(), relations.steps.tolist()
    ([[10.5, 12.0]], [[0.4, 0.1, 1.57]])
    """
    rows = [_row(line, number) for number, line in numbered_lines(path, "the relations")]
    if not rows:
        raise ValueError(f"the file must hold at least one relation, got none in {path}")
    table = np.array(rows)
    return Relations(table[:, :2], table[:, [2, 3, 7]])


def _row(line: str, number: int) -> list[float]:
    """The eight numbers of a line, checked."""
    try:
        values = [float(word) for word in line.split()]
    except ValueError:
        values = []
    if len(values) != 8 or not np.isfinite(values).all():
        raise ValueError(f"a relation must be eight finite numbers, got {line.strip()[:60]!r} in line {number}")
    if max(map(abs, values[4:7])) > _TILT:
        raise ValueError(f"a relation must stay in the plane (dz = roll = pitch = 0), got {values[4:7]} in line {number}")
    return values
