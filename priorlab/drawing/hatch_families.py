"""The hatching of a sheet: in which direction its strokes run, and how far apart. Both come from the white cells between them.

A cell between two faces and two strokes is a parallelogram. It slants as its strokes do, whatever the wall's direction and
thickness, and the middles of neighbours lie one spacing apart, measured across the strokes. Treads, panes and closets are
upright; pieces of furniture may slant, but not many of them alike and evenly.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from priorlab.drawing.cell_shapes import CellShapes

UPRIGHT = 18
"""Within so many degrees of an axis a cell does not slant."""

SPREAD = 12
"""Cells between the strokes of one hatching slant alike within so many degrees."""

FEWEST = 8
"""Fewer pairs of neighbours make no hatching."""

FURTHER = 0.1
"""A further hatching has so many pairs, as a share of the first one's."""

MOST = 3
"""At most so many are looked for: outer and inner walls, and the other diagonal."""

FULL = 0.88
"""A parallelogram fills so much of the one with its spread; a triangle, half a crossed box, does not."""

SLACK, AT_LEAST = 0.3, 0.5
"""The two ends of a cell lie apart, along the wall, as its slant says: within this share, and so many pixels."""

EVEN = 0.25
"""Neighbours are one spacing apart within this share, and a pixel."""


@dataclass(frozen=True)
class HatchFamily:
    """Parallel strokes.

    Parameters
    ----------
    degrees : their direction, from x towards y (down)
    spacing : from the middle of one white strip between them to that of the next, across the strokes, pixels
    """

    degrees: int
    spacing: float

    def slope(self, axis: int) -> float:
        """How far a stroke moves along an axis per pixel across it."""
        tangent = float(np.tan(np.radians(self.degrees)))
        return tangent if axis == 0 else 1 / tangent

    def slanting(self, shapes: CellShapes, axis: int) -> NDArray[np.bool_]:
        """(K,) parallelograms that slant as cells of walls along an axis do, their ends where they should be."""
        height, slope = shapes.breadth(1 - axis), self.slope(axis)
        alike = np.abs(shapes.drift(axis) - slope) * height <= SLACK * abs(slope) * height + AT_LEAST
        return alike & (shapes.fullness >= FULL)

    def narrow(self, shapes: CellShapes) -> NDArray[np.bool_]:
        """(K,) cells of any shape that fit between two strokes."""
        sine, cosine = np.sin(np.radians(self.degrees)), np.cos(np.radians(self.degrees))
        across = shapes.xx * sine**2 - 2 * shapes.xy * sine * cosine + shapes.yy * cosine**2
        return np.asarray(12 * across <= (self.spacing * (1 + EVEN) + 1) ** 2)

    def steps(self, shapes: CellShapes, pairs: NDArray[np.int64]) -> NDArray[np.float64]:
        """(N,) how far the middle of each pair's second cell lies beyond that of the first across the strokes, in spacings."""
        return _beyond(shapes, pairs, self.degrees) / self.spacing

    def neighbours(self, shapes: CellShapes, pairs: NDArray[np.int64]) -> NDArray[np.bool_]:
        """(N,) pairs that are one spacing apart."""
        return np.abs(np.abs(self.steps(shapes, pairs)) - 1) <= max(EVEN, 1 / self.spacing)


def hatch_families(shapes: CellShapes, pairs: NDArray[np.int64], thickness: float) -> tuple[HatchFamily, ...]:
    """The hatchings of a sheet, the commonest first; none where no cells slant alike.

    The slant of a cell between two horizontal faces is the drift of its rows, between vertical ones that of its columns; which it
    is need not be known: the right one agrees from cell to cell.

    Parameters
    ----------
    shapes : of K cells
    pairs : (N, 2) numbers of cells with a stroke between them
    thickness : of the thickest wall, pixels
    """
    left = small_enough(shapes, thickness) & (shapes.fullness >= FULL)
    slants = [np.degrees(np.arctan2(1.0, shapes.drift(1))) % 180, np.degrees(np.arctan(shapes.drift(0))) % 180]
    found: list[HatchFamily] = []
    first = 0
    while len(found) < MOST:
        votes = np.zeros(180)
        for slant in slants:
            votes += np.bincount(slant[left].astype(int) % 180, np.sqrt(shapes.area[left]), 180)
        likely = np.where(_upright(np.arange(180)), 0, np.convolve(votes, np.bartlett(SPREAD + 1), mode="same"))
        degrees = int(likely.argmax())
        alike = left & np.logical_or.reduce([np.abs(slant - degrees) <= SPREAD for slant in slants])
        beside = pairs[alike[pairs].all(axis=1)]
        if _upright(np.array(degrees)) or len(beside) < FEWEST:
            break
        family = HatchFamily(degrees, max(1.0, float(np.median(np.abs(_beyond(shapes, beside, degrees))))))
        even = int(family.neighbours(shapes, beside).sum())
        if even < max(FEWEST, FURTHER * first, len(beside) / 2):
            break
        found.append(family)
        first = first or even
        left &= ~alike
    return tuple(found)


def small_enough(shapes: CellShapes, thickness: float) -> NDArray[np.bool_]:
    """(K,) cells that can lie in a wall, and are large enough to have a slant."""
    return (shapes.area >= 4) & (shapes.area <= 4 * thickness**2) & (np.minimum(shapes.xx, shapes.yy) > 0.2)


def _upright(degrees: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Directions near an axis."""
    return np.minimum(degrees % 90, 90 - degrees % 90) < UPRIGHT


def _beyond(shapes: CellShapes, pairs: NDArray[np.int64], degrees: float) -> NDArray[np.float64]:
    """(N,) how far the middle of the second cell of each pair lies beyond that of the first one, across a direction."""
    one, other = pairs.T
    dx, dy = shapes.x[other] - shapes.x[one], shapes.y[other] - shapes.y[one]
    return np.asarray(dx * np.sin(np.radians(degrees)) - dy * np.cos(np.radians(degrees)))
