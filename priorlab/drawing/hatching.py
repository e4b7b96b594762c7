"""Hatched walls: chains of white cells with one stroke between each and the next, filled up to their faces."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.drawing.cell_shapes import CellShapes, across_strokes, cell_shapes
from priorlab.drawing.faces import covered_cells
from priorlab.drawing.hatch_families import HatchFamily, hatch_families, small_enough
from priorlab.drawing.runs import run_lengths
from priorlab.drawing.wall_sizes import WallSizes

FLAT = 4
"""Cells of fewer pixels from face to face are too flat to slant."""

ROUNDS = 3
"""So many cells follow each other where chains meet."""

NEXT = (0.3, 1.5)
"""The middle of a cell at the end of a chain lies so many spacings beyond that of the last one: it may be a triangle."""


def hatched_walls(ink: NDArray[np.bool_], cells: NDArray[np.int32], sizes: WallSizes) -> tuple[NDArray[np.bool_], int]:
    """What hatching fills, up to its faces' outer edges, and how thick these faces are; nothing, and 0, where nothing is hatched.

    Parameters
    ----------
    ink : (height, width) bool, all ink that may be wall
    cells : (height, width) the thin cells between it
    sizes : of walls on this sheet

    Returns
    -------
    (height, width) bool, and pixels
    """
    shapes = cell_shapes(cells)
    pairs = tuple(np.unique(across_strokes(cells, ink, sizes.thickness / 2, axis)[:, :2], axis=0) for axis in (0, 1))
    families = hatch_families(shapes, np.unique(np.vstack(pairs), axis=0), sizes.thickness)
    small = small_enough(shapes, sizes.thickness)
    along = [np.zeros(len(small), dtype=bool), np.zeros(len(small), dtype=bool)]
    for family in families:
        for axis, mine in enumerate(along):
            mine |= _chained(shapes, family, small, pairs[axis], axis)
    chosen = along[0] | along[1]
    for _ in range(ROUNDS):
        chosen |= _next_cells(shapes, families, chosen, pairs)
    for family in families:
        chosen |= small & family.narrow(shapes) & _amid(shapes, family, chosen, np.vstack(pairs))
    chosen[0] = False
    if not chosen.any():
        return np.zeros_like(ink), 0
    face = _face_weight(ink, cells, shapes, along)
    return _filled(ink, cells, chosen, face), face


def _chained(
    shapes: CellShapes, family: HatchFamily, small: NDArray[np.bool_], pairs: NDArray[np.int64], axis: int
) -> NDArray[np.bool_]:
    """Cells along an axis that slant as a hatching does, one spacing from the next; rows of cells too flat to slant, too."""
    slants = small & family.slanting(shapes, axis)
    flat = shapes.high[1 - axis] - shapes.low[1 - axis] + 1 < FLAT
    one, other = pairs.T
    inner, outer = _between_same(shapes, one, other, axis), _between_same(shapes, other, one, axis)
    near = family.neighbours(shapes, pairs)
    found = np.zeros_like(small)
    found[pairs[near & slants[one] & slants[other] & (inner | outer)].ravel()] = True
    row = pairs[near & flat[one] & flat[other] & inner & outer]
    in_row = np.bincount(row.ravel(), minlength=len(small)) >= 2
    found[row[in_row[row].any(axis=1)].ravel()] = True  # three at least
    narrow = family.narrow(shapes)
    for a, b in (pairs.T, pairs[:, ::-1].T):
        end = (
            slants[a]
            & narrow[a]
            & narrow[b]
            & _between_same(shapes, a, b, axis)
            & (np.abs(family.steps(shapes, pairs)) <= NEXT[1])
        )
        found[a[end]] = True
    return found


def _next_cells(
    shapes: CellShapes, families: tuple[HatchFamily, ...], chosen: NDArray[np.bool_], pairs: Sequence[NDArray[np.int64]]
) -> NDArray[np.bool_]:
    """Cells of any shape beyond a stroke, as narrow as the chosen ones: at the ends of chains and where walls meet.

    What lies there is no face but a stroke when the next cell lies between the same faces, or when lines of pixels along both
    axes lead across it from cell to cell.
    """
    found = np.zeros_like(chosen)
    either, often = np.unique(np.vstack(pairs), axis=0, return_counts=True)
    slanted = either[often == 2]
    for family in families:
        narrow = family.narrow(shapes)
        for axis, some in ((None, slanted), *enumerate(pairs)):
            steps = np.abs(family.steps(shapes, some))
            follows = (steps >= NEXT[0]) & (steps <= NEXT[1])
            for one, other in (some.T, some[:, ::-1].T):
                fits = chosen[one] & narrow[other] & follows
                fits &= axis is None or _between_same(shapes, one, other, axis)
                found[other[fits]] = True
    return found


def _amid(shapes: CellShapes, family: HatchFamily, chosen: NDArray[np.bool_], pairs: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Cells with a chosen one a spacing away on either side: those that go round the corner of two walls."""
    pairs = pairs[family.neighbours(shapes, pairs)]
    forward = family.steps(shapes, pairs) > 0
    before, after = np.zeros_like(chosen), np.zeros_like(chosen)
    for one, other, ahead in ((*pairs.T, forward), (*pairs[:, ::-1].T, ~forward)):
        before[other[chosen[one] & ahead]] = True
        after[other[chosen[one] & ~ahead]] = True
    return before & after


def _between_same(shapes: CellShapes, one: NDArray[np.int64], other: NDArray[np.int64], axis: int) -> NDArray[np.bool_]:
    """Where the other cell lies between the faces of the one."""
    low, high = shapes.low[1 - axis], shapes.high[1 - axis]
    return np.asarray((low[other] >= low[one] - 1) & (high[other] <= high[one] + 1))


def _filled(ink: NDArray[np.bool_], cells: NDArray[np.int32], chosen: NDArray[np.bool_], face: int) -> NDArray[np.bool_]:
    """The chosen cells, the strokes between them and the faces round them."""
    inside = chosen[cells]
    square, rim = np.ones((2 * face + 3, 2 * face + 3), np.uint8), 2 * face + 3
    closed = cv2.morphologyEx(np.pad(inside, rim).astype(np.uint8), cv2.MORPH_CLOSE, square)[rim:-rim, rim:-rim].astype(bool)
    inside |= covered_cells(closed, cells)
    near = cv2.dilate(inside.astype(np.uint8), np.ones((2 * face + 1, 2 * face + 1), np.uint8)).astype(bool)
    return inside | (ink & (closed | near))


def _face_weight(ink: NDArray[np.bool_], cells: NDArray[np.int32], shapes: CellShapes, along: list[NDArray[np.bool_]]) -> int:
    """Thickness of the faces: of the ink right above the first row of cells along x, beside the first column of those along y."""
    found = []
    for axis, mine in enumerate(along):
        run = run_lengths(ink, 1 - axis)
        rows, cols = np.nonzero(mine[cells] & (cells > 0))
        place = rows if axis == 1 else cols
        first = (place == shapes.low[1 - axis, cells[rows, cols]]) & (place > 0)
        before = (rows[first] - 1, cols[first]) if axis == 1 else (rows[first], cols[first] - 1)
        found.append(run[before][ink[before]])
    return max(1, int(np.percentile(np.concatenate(found), 70)))
