"""What clutter is drawn round: the grown building, its page, and what has been gathered so far."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from priorlab.buildings.cells import Box
from priorlab.buildings.parts import Dimension, Furniture, Line, Mark, Note, Room, Sheet
from priorlab.buildings.recipe import Recipe
from priorlab.buildings.shell import Shell

STAMP = 1.9
"""Room that a stamp takes above a label, in heights of small letters."""

BASE = 0.7
"""Margin of a bare sheet, metres."""

ROOM: dict[str, Box] = {
    "axes": (0.9, 0.0, 0.0, 0.9),
    "block": (0.0, 2.6, 0.0, 0.0),
    "border": (0.7, 0.7, 0.7, 0.7),
    "cars": (0.0, 0.0, 6.0, 0.0),
    "cloud": (0.0, 0.0, 0.0, 0.0),
    "compass": (0.0, 0.0, 2.0, 0.0),
    "decking": (0.0, 2.7, 0.0, 0.0),
    "dimensions": (1.5, 0.0, 0.0, 1.5),
    "frame": (0.6, 0.6, 0.6, 0.6),
    "furniture": (0.0, 0.0, 0.0, 0.0),
    "hedge": (0.0, 0.0, 2.4, 0.0),
    "legend": (0.0, 0.0, 4.4, 0.0),
    "levels": (0.0, 0.0, 0.0, 0.0),
    "north_arrow": (0.0, 1.4, 0.0, 0.0),
    "notes": (0.0, 1.9, 0.0, 0.0),
    "parking": (0.0, 0.0, 6.0, 0.0),
    "paving": (0.0, 2.7, 0.0, 0.0),
    "ruler": (0.0, 1.2, 0.0, 0.0),
    "scale_bar": (0.0, 1.2, 0.0, 0.0),
    "section": (1.0, 0.0, 1.0, 0.0),
    "stamps": (0.0, 0.0, 0.0, 0.0),
    "strip": (0.0, 0.0, 3.4, 0.0),
    "trees": (0.0, 0.0, 2.4, 0.0),
}
"""What each kind of clutter needs beside the building: left, bottom, right, top, metres; they stand side by side on the right."""


@dataclass
class Surroundings:
    """Parts that are gathered round a building."""

    furniture: list[Furniture] = field(default_factory=list)
    lines: list[Line] = field(default_factory=list)
    marks: list[Mark] = field(default_factory=list)
    notes: list[Note] = field(default_factory=list)
    dimensions: list[Dimension] = field(default_factory=list)
    sheet: Sheet = field(default_factory=Sheet)


@dataclass(frozen=True)
class Site:
    """What the clutter is drawn round.

    Parameters
    ----------
    recipe, shell, rooms : what was grown
    bounds, page : of the building and of the whole sheet: left, bottom, right, top, metres
    text : height of small letters, metres
    rng : for what is left to chance
    """

    recipe: Recipe
    shell: Shell
    rooms: tuple[Room, ...]
    bounds: Box
    page: Box
    text: float
    rng: np.random.Generator


def margins_of(recipe: Recipe) -> Box:
    """Left, bottom, right, top: on the left and above things lie over one another, on the right and below side by side."""
    frames = sum(max(ROOM[kind]) for kind in recipe.clutter if kind in ("frame", "border"))
    plain = np.array([ROOM[kind] for kind in recipe.clutter if kind not in ("frame", "border")] or [(0.0, 0.0, 0.0, 0.0)])
    left, bottom, right, top = (plain[:, 0].sum(), plain[:, 1].max(), plain[:, 2].sum(), plain[:, 3].sum())
    return tuple(float(BASE + side + frames) for side in (left, bottom, right, top))  # type: ignore[return-value]
