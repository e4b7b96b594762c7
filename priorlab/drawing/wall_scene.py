"""What the search for walls looks at: the drawing's ink, with and without what hides walls, and the measure of a wall."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from priorlab.core.drawing import Door
from priorlab.drawing.door_ink import door_ink
from priorlab.drawing.method import Method
from priorlab.drawing.preprocessing import large_components
from priorlab.drawing.sheet import Sheet
from priorlab.drawing.valleys import valleys
from priorlab.drawing.wall_sizes import WallSizes, wall_sizes

FEWEST_FOR_A_SCALE = 3
"""Doors that are needed to tell how thick a wall can be."""

OUTLINES = 0.02
"""Components shorter than this share of M bound no inside of a wall."""


@dataclass(frozen=True, eq=False)
class WallScene:
    """All in working pixels.

    Parameters
    ----------
    sheet : the drawing; with `ROBUST`, strokes that blur joins are parted in its `walls`
    drawn : (height, width) bool, the ink as it was drawn
    ink : (height, width) bool, large components of the sheet's ink
    symbols : (height, width) bool, ink of the doors
    doors : the doors
    """

    sheet: Sheet
    drawn: NDArray[np.bool_]
    ink: NDArray[np.bool_]
    symbols: NDArray[np.bool_]
    doors: tuple[Door, ...]

    @property
    def without_doors(self) -> NDArray[np.bool_]:
        """(height, width) bool, the ink without the doors' symbols."""
        return self.ink & ~self.symbols

    @property
    def door_width(self) -> float:
        """The median door's width, pixels; nan without doors."""
        return float(np.median([door.width for door in self.doors])) if self.doors else float("nan")

    @property
    def sizes(self) -> WallSizes:
        """How thick and long walls are, by the doors when there are enough."""
        enough = len(self.doors) >= FEWEST_FOR_A_SCALE
        return wall_sizes(self.sheet.long_side, self.door_width if enough else None)

    def outlines(self) -> NDArray[np.bool_]:
        """(height, width) bool, drawn ink that may bound the inside of a wall."""
        return large_components(self.drawn, OUTLINES * self.sheet.long_side)

    def lines(self) -> NDArray[np.bool_]:
        """(height, width) bool, all ink but text, faint lines too."""
        return large_components(self.sheet.lines, OUTLINES * self.sheet.long_side)


def scene_of(sheet: Sheet, doors: Sequence[Door], method: Method) -> WallScene:
    """The scene of a sheet; `doors` in the drawing's own pixels."""
    scaled, drawn = tuple(sheet.doors_to_work(doors)), sheet.walls
    if method.sources == "both":
        sheet = replace(sheet, walls=drawn & ~valleys(sheet.darkness))
    share = method.component_share
    ink = large_components(sheet.walls, share * sheet.long_side) if share > 0 else sheet.walls
    symbols = door_ink(sheet, scaled) if method.sources == "both" else np.zeros_like(ink)
    return WallScene(sheet, drawn, ink, symbols, scaled)
