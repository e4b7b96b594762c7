"""Walls between faces: the gap between two long strokes that run side by side is the inside of a wall.

That makes one thing of filled, hollow and hatched walls.
"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.drawing.preprocessing import large_components
from priorlab.drawing.runs import gaps_between, grow_along, run_lengths
from priorlab.drawing.strokes import opened, thinner_run
from priorlab.drawing.wall_sizes import WallSizes

SOLID_SHARE = 0.75
"""Walls are drawn solid when heavy strokes alone make up so much of them; then gaps are closets and windows, no walls."""

PAIRED = 0.25
"""Walls are drawn solid, too, when the gaps between their strokes are no larger than this share of the strokes."""

CELL_COVERED = 0.4
"""A thin cell is wall when so much of it is."""

LONE_DISTANCE = 0.06
"""A bar stands alone when nothing else does within this share of M: about a door's width."""

LONE_SHARE = 0.1
"""A lone bar holds no more than this share of all walls."""

BESIDE_GAPS = 0.25
"""A hole is the corner of hollow walls when so much of its outline lies beside their gaps."""

MOST_HAIR = 5
"""Lines of this many pixels and more may be walls by themselves."""


def thin_cells(ink: NDArray[np.bool_], sizes: WallSizes) -> NDArray[np.int32]:
    """Number the white areas, enclosed by ink, that are nowhere wider than a wall; 0 elsewhere.

    Insides of hollow walls and of hatching are such cells, and so are treads and panes.
    """
    n_cells, labels = cv2.connectedComponents((~ink).astype(np.uint8), connectivity=4)
    inside = cv2.distanceTransform(np.pad(~ink, 1, constant_values=False).astype(np.uint8), cv2.DIST_C, 3)[1:-1, 1:-1]
    wide = np.zeros(n_cells, dtype=bool)
    wide[labels[inside > sizes.thickness / 2 + 0.5]] = True
    wide[0] = True
    return np.where(wide[labels], 0, labels).astype(np.int32)


def walls_between(
    faces: NDArray[np.bool_], ink: NDArray[np.bool_], cells: NDArray[np.int32], sizes: WallSizes
) -> tuple[NDArray[np.bool_], bool]:
    """Walls from the ink of their faces: the strokes themselves where they are solid, else the strokes and what lies between.

    Parameters
    ----------
    faces : (height, width) bool, ink taken for the faces (of a filled wall: all of it)
    ink : (height, width) bool, ink along which a face may go on
    cells : (height, width) thin cells
    sizes : how thick and long walls are on this sheet

    Returns
    -------
    (height, width) bool, and whether they are drawn solid
    """
    length, thickness = sizes.face_length, sizes.thickness
    face_width = int(np.median(thinner_run(faces)[faces])) if faces.any() else 0
    strokes, between, apart = np.zeros_like(faces), np.zeros_like(faces), np.zeros_like(faces)
    for axis in (0, 1):
        face = long_runs(faces, length, axis)
        strokes |= face
        apart |= long_runs(gaps_between(face, thickness, 1 - axis), length, axis)
        face = grow_along(face, long_runs(ink, length, axis), axis)
        between |= face | long_runs(gaps_between(face, thickness, 1 - axis), length, axis)
    solid = tidy(strokes, sizes, within=ink)
    whole = between | covered_cells(between, cells)
    hair = face_width + 1  # a face without a partner is a line, not a wall
    hollow = tidy(fill_corners(whole, whole & ~ink, thickness), sizes, hair)
    lone = apart.sum() <= PAIRED * strokes.sum()  # no partners: what lies between is windows and closets
    is_solid = bool(solid.any() and (lone or solid.sum() >= SOLID_SHARE * hollow.sum()))
    return (solid if is_solid else hollow), is_solid


def covered_cells(walls: NDArray[np.bool_], cells: NDArray[np.int32]) -> NDArray[np.bool_]:
    """Thin cells of which walls cover at least `CELL_COVERED`, whole."""
    area = np.bincount(cells.ravel())
    covered = np.bincount(cells[walls], minlength=len(area))
    take = covered >= CELL_COVERED * np.maximum(area, 1)
    take[0] = False
    return take[cells]


def fill_corners(walls: NDArray[np.bool_], gaps: NDArray[np.bool_], thickness: float) -> NDArray[np.bool_]:
    """Walls with the small holes filled that lie beside gaps: where two hollow walls meet, neither gap reaches the corner.

    >>> walls = np.ones((9, 9), dtype=bool); walls[3:6, 3:6] = False
    >>> gaps = np.zeros_like(walls); gaps[3:6, 6:] = gaps[6:, 3:6] = True
    >>> fill_corners(walls, gaps, 4).all(), fill_corners(walls, walls & False, 4).all()
    (np.True_, np.False_)
    """
    n_holes, labels, stats, _ = cv2.connectedComponentsWithStats((~walls).astype(np.uint8), connectivity=4)
    beside = np.zeros(n_holes)
    for shift, axis in ((1, 0), (-1, 0), (1, 1), (-1, 1)):
        beside += np.bincount(labels[np.roll(gaps, shift, axis)], minlength=n_holes)
    around = 2 * (stats[:, cv2.CC_STAT_WIDTH] + stats[:, cv2.CC_STAT_HEIGHT])
    corner = np.maximum(stats[:, cv2.CC_STAT_WIDTH], stats[:, cv2.CC_STAT_HEIGHT]) <= 1.25 * thickness
    corner &= beside >= BESIDE_GAPS * around
    corner[0] = False
    return walls | corner[labels]


def long_runs(mask: NDArray[np.bool_], length: float, axis: int) -> NDArray[np.bool_]:
    """Pixels in runs of at least `length` along an axis."""
    return run_lengths(mask, axis) >= max(length, 1)


def without_lone_bars(walls: NDArray[np.bool_], sizes: WallSizes) -> NDArray[np.bool_]:
    """Walls without straight bars that stand alone, such as scale bars and frames' edges: they enclose nothing."""
    reach = max(3, round(LONE_DISTANCE * sizes.long_side)) | 1
    near = cv2.dilate(walls.astype(np.uint8), np.ones((reach, reach), np.uint8))
    n_groups, labels, stats, _ = cv2.connectedComponentsWithStats(near, connectivity=8)
    area = np.bincount(labels[walls], minlength=n_groups)
    narrow = np.minimum(stats[:, cv2.CC_STAT_WIDTH], stats[:, cv2.CC_STAT_HEIGHT]) - reach + 1 <= sizes.thickness
    drop = narrow & (area <= LONE_SHARE * area.sum())
    return walls & ~drop[labels]


def tidy(walls: NDArray[np.bool_], sizes: WallSizes, hair: int = 3, within: NDArray[np.bool_] | None = None) -> NDArray[np.bool_]:
    """Close cracks of a few pixels, open away what is thinner than `hair`, drop pieces shorter than the shortest.

    Solid walls are closed `within` ink only: a table's edge stays apart from the wall behind it.
    """
    closed = cv2.morphologyEx(walls.astype(np.uint8), cv2.MORPH_CLOSE, np.ones((5, 5), np.uint8)).astype(bool)
    clean = opened(closed if within is None else walls | (closed & within), min(max(hair, 3), MOST_HAIR))
    return large_components(clean, sizes.piece_length)
