"""Insides of walls that are drawn in one weight: white cells, long and narrow all along, between two lines.

Where walls, doors and furniture are drawn with one pen, no weight tells them apart; but hardly a piece of furniture is eight
times longer than it is wide, as narrow as a wall, and straight or as large as a room.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.drawing.faces import long_runs, thin_cells
from priorlab.drawing.strokes import thinner_run
from priorlab.drawing.wall_sizes import WallSizes

ELONGATED = 8.0
"""Length of such a cell, in widths."""

STRAIGHT = 1.6
"""A straight cell lies in a box so many times wider than itself."""

SPANS = 0.1
"""A cell that is not straight spans so much of M, like the walls round a room."""

STRAIGHTNESS = (0, 2, 3)
"""Lines that may bound a cell: runs of at least so many line widths along an axis; 0 takes all ink."""

OUTLINE = 3
"""Ink within so many pixels of a cell is its outline."""


def long_cells(ink: NDArray[np.bool_], sizes: WallSizes) -> tuple[LongCells, ...]:
    """The long cells of a drawing, three times: between all its ink, and between its straight lines alone.

    Leaving out what is shorter than two or three line widths opens what furniture closes, and hatching falls away; the ends of
    walls stay, as they are as long as a wall is thick.
    """
    weight = float(np.median(thinner_run(ink)[ink])) if ink.any() else 1.0
    found = []
    for widths in STRAIGHTNESS:
        lines = long_runs(ink, widths * weight, 0) | long_runs(ink, widths * weight, 1) if widths else ink
        cells = thin_cells(lines, sizes)
        found.append(LongCells(np.where(_elongated(cells, sizes)[cells], cells, 0), lines))
    return tuple(found)


@dataclass(frozen=True, eq=False)
class LongCells:
    """Long cells by number (height, width), 0 elsewhere, and the ink between which they lie."""

    labels: NDArray[np.int32]
    ink: NDArray[np.bool_]

    def walls(self, faces: NDArray[np.bool_] | None = None) -> NDArray[np.bool_]:
        """The cells with the ink round them; of faces: only those at least half of whose outline they make."""
        inside = self.labels > 0
        if faces is not None and inside.any():
            square = np.ones((2 * OUTLINE + 1, 2 * OUTLINE + 1), np.uint8)
            nearest = cv2.dilate(self.labels.astype(np.float32), square).astype(np.int32)
            n_cells = int(self.labels.max()) + 1
            around = np.bincount(nearest[self.ink], minlength=n_cells)
            faced = np.bincount(nearest[self.ink & faces], minlength=n_cells)
            take = faced >= 0.5 * np.maximum(around, 1)
            take[0] = False
            inside = take[self.labels]
        near = cv2.dilate(inside.astype(np.uint8), np.ones((2 * OUTLINE + 1, 2 * OUTLINE + 1), np.uint8)).astype(bool)
        return inside | (self.ink & near)


def _elongated(cells: NDArray[np.int32], sizes: WallSizes) -> NDArray[np.bool_]:
    """For every number of a cell: is it long enough?"""
    n_cells = int(cells.max()) + 1
    rows, cols = np.nonzero(cells)
    labels = cells[rows, cols]
    depth = cv2.distanceTransform((cells > 0).astype(np.uint8), cv2.DIST_C, 3)[rows, cols]
    deepest, low, high = np.zeros(n_cells), np.full((2, n_cells), np.inf), np.full((2, n_cells), -np.inf)
    np.maximum.at(deepest, labels, depth)
    for k, where in enumerate((rows, cols)):
        np.minimum.at(low[k], labels, where)
        np.maximum.at(high[k], labels, where)
    width = np.maximum(2 * deepest - 1, 1)
    length = np.bincount(labels, minlength=n_cells) / width
    shorter, longer = np.sort(high - low + 1, axis=0)
    shaped = (shorter <= STRAIGHT * width + 1) | (longer >= SPANS * sizes.long_side)
    take = (length >= ELONGATED * width) & (length >= sizes.piece_length) & (width >= 2) & shaped
    take[0] = False
    return take
