"""Flats as centre lines: the text files of the Raster-to-Vector set (FloorplanTransformation).

One thing a line, separated by tabs: x1 y1 x2 y2 kind and two whole numbers; pixels, x right, y DOWN. Of a `wall` and a `door` (an
opening, door or window alike) the points are the ends of its centre line, of rooms and fixtures two corners of a box.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from priorlab.interchange.text_lines import numbered_lines

Box = tuple[float, float, float, float]

_RAIL = "2"
"""First number behind a wall that is a balcony's parapet."""


@dataclass(frozen=True, eq=False)
class LineFlat:
    """A flat as lines; pixels, x right, y down.

    Parameters
    ----------
    name : the file's name
    walls : (N, 4) centre lines x1, y1, x2, y2
    rails : (R, 4) the same of walls round balconies
    openings : (M, 4) the same of doors and windows, which are not told apart
    things : kind and box of every room label and fixture
    """

    name: str
    walls: NDArray[np.float64]
    rails: NDArray[np.float64]
    openings: NDArray[np.float64]
    things: tuple[tuple[str, Box], ...] = ()

    def __repr__(self) -> str:
        parts = f"{len(self.walls) + len(self.rails)} walls, {len(self.openings)} openings, {len(self.things)} rooms and fixtures"
        return f"LineFlat({self.name}: {parts})"


def read_r2v(path: str | Path) -> LineFlat:
    """Read one flat.

    Raises
    ------
    FileNotFoundError
        When there is no such file.
    ValueError
        When it is no text, a line is not as the format has it (with its number), or no wall is in the file.
    """
    path = Path(path)
    lines: dict[str, list[Box]] = {"walls": [], "rails": [], "openings": []}
    things = []
    for number, text in numbered_lines(path, "a flat"):
        kind, kind_number, box = _parsed(text, f"{path.name}, line {number}")
        if kind == "wall":
            lines["rails" if kind_number == _RAIL else "walls"].append(box)
        elif kind == "door":
            lines["openings"].append(box)
        else:
            things.append((kind, box))
    if not lines["walls"]:
        raise ValueError(f"{path.name}: a flat must have at least one wall, got none")
    walls, rails, openings = (np.array(lines[key], dtype=np.float64).reshape(-1, 4) for key in ("walls", "rails", "openings"))
    return LineFlat(path.stem, walls, rails, openings, tuple(things))


def _parsed(text: str, where: str) -> tuple[str, str, Box]:
    """Kind, its first number and the four coordinates of a line."""
    fields = text.rstrip().split("\t")
    if len(fields) < 6:
        raise ValueError(f"{where}: it must hold x1 y1 x2 y2 kind and a number, separated by tabs, got {text!r}")
    try:
        x1, y1, x2, y2 = (float(field) for field in fields[:4])
    except ValueError:
        raise ValueError(f"{where}: coordinates must be numbers, got {fields[:4]}") from None
    if not all(math.isfinite(value) for value in (x1, y1, x2, y2)):
        raise ValueError(f"{where}: coordinates must be finite, got {fields[:4]}")
    return fields[4], fields[5], (x1, y1, x2, y2)
