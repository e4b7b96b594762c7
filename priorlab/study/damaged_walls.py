"""Walls as a bad extraction, an old plan or a rebuilt house would give them (thesis 5.2.3, fig. 5.10)."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import check_rng
from priorlab.core.drawing import EMPTY, WALL, Walls

PATCH = (0.08, 0.25)
"""Side of a missing part, as shares of the smaller side of what the walls enclose."""

MISSING, STRAY, SHIFT = 0.35, 0.15, 2
"""Poor walls: share of the wall pixels that is missing, share added as stray strokes, and pixels that pieces are off."""

TRIES = 500
"""Places tried for a wall too many."""


def without_parts(walls: Walls, share: float, rng: np.random.Generator) -> Walls:
    """Walls of which whole parts are missing: squares at random places are wiped out until a share of the pixels is gone.

    Parameters
    ----------
    walls : any
    share : of the wall pixels to lose, in [0, 1]; met to the pixel
    rng : draws the places and sizes

    >>> strip = Walls(np.ones((2, 50), dtype=np.uint8))
    >>> int(without_parts(strip, 0.3, np.random.default_rng(0)).mask.sum())
    70
    """
    if not 0 <= share <= 1:
        raise ValueError(f"share must lie in [0, 1], got {share:g}")
    rng = check_rng(rng)
    mask = walls.mask.copy()
    to_lose = round(share * int(mask.sum()))
    low, high = (max(1.0, part * _smaller_side(mask)) for part in PATCH)
    while to_lose > 0:
        rows, cols = np.nonzero(mask)
        middle = rng.integers(len(rows))
        distance = np.maximum(np.abs(rows - rows[middle]), np.abs(cols - cols[middle]))
        inside = np.flatnonzero(distance <= rng.uniform(low, high) / 2)
        lost = inside[np.argsort(distance[inside], kind="stable")][:to_lose]  # the last square is cut to size
        mask[rows[lost], cols[lost]] = False
        to_lose -= len(lost)
    return _like(walls, mask, f"{100 * share:g} % missing")


def poor(walls: Walls, rng: np.random.Generator) -> Walls:
    """Walls as a bad extraction leaves them: parts missing, pieces beside their place, strokes that are no walls.

    Parameters
    ----------
    walls : any
    rng : draws what is missing, how far each piece of the plan is off, and the strokes
    """
    missing = without_parts(walls, MISSING, rng).mask
    side = max(4, round(PATCH[1] * _smaller_side(walls.mask)))
    mask = np.zeros_like(missing)
    for top in range(0, mask.shape[0], side):
        for left in range(0, mask.shape[1], side):
            rows, cols = np.nonzero(missing[top : top + side, left : left + side])
            row, col = rng.integers(-SHIFT, SHIFT + 1, 2)
            mask[np.clip(rows + top + row, 0, mask.shape[0] - 1), np.clip(cols + left + col, 0, mask.shape[1] - 1)] = True
    stray = int(STRAY * walls.mask.sum())
    thickness = typical_thickness(walls.mask)
    top, left, bottom, right = _box(walls.mask)
    while stray > 0:
        length = int(rng.integers(3, 9)) * thickness
        height, width = (thickness, length) if rng.random() < 0.5 else (length, thickness)
        row, col = int(rng.integers(top, bottom)), int(rng.integers(left, right))
        mask[row : row + height, col : col + width] = True
        stray -= height * width
    return _like(walls, mask, "poor")


def with_extra_wall(walls: Walls, rng: np.random.Generator) -> Walls:
    """Walls with one too many: straight across a room, from wall to wall, as thick as the others (fig. 5.10 e).

    Parameters
    ----------
    walls : any
    rng : draws the place and the direction

    Raises
    ------
    ValueError
        When no room is wide enough for a wall in it.
    """
    rng = check_rng(rng)
    thickness = typical_thickness(walls.mask)
    free = cv2.distanceTransform(np.pad(~walls.mask, 1).view(np.uint8), cv2.DIST_C, cv2.DIST_MASK_PRECISE)[1:-1, 1:-1]
    for _ in range(TRIES):
        upright = bool(rng.random() < 0.5)
        mask = walls.mask.T.copy() if upright else walls.mask.copy()
        top, left, bottom, right = _box(mask)
        row, col = int(rng.integers(top, bottom)), int(rng.integers(left, right))
        room = free.T if upright else free
        if room[row, col] <= 3 * thickness:
            continue
        strip = mask[row : row + thickness]
        hits = np.flatnonzero(strip.any(axis=0))
        before, after = hits[hits < col], hits[hits > col]
        if not (before.size and after.size) or after[0] - before[-1] < 0.15 * _smaller_side(mask):
            continue
        strip[:, before[-1] : after[0] + 1] = True
        return _like(walls, mask.T if upright else mask, "a wall too many")
    raise ValueError(f"walls must leave a room of at least {6 * thickness} px for a wall too many, found none in {TRIES} tries")


def typical_thickness(mask: NDArray[np.bool_]) -> int:
    """How thick walls are, pixels: across a strip t thick the distance to its nearest side is (t + 2) / 4 on average.

    Strips of 1 and 2 pixels look alike; both count as 2.

    >>> strip = np.zeros((20, 60), dtype=bool)
    >>> strip[8:12] = True
    >>> typical_thickness(strip)
    4
    """
    if not mask.any():
        raise ValueError("walls must hold at least one wall pixel, got none")
    depth = cv2.distanceTransform(np.pad(mask, 1).view(np.uint8), cv2.DIST_C, cv2.DIST_MASK_PRECISE)[1:-1, 1:-1]
    return max(1, round(4 * float(depth[mask].mean()) - 2))


def _like(walls: Walls, mask: NDArray[np.bool_], how: str) -> Walls:
    """A mask with the scale and the name of the walls it was made of."""
    labels = np.where(mask, WALL, EMPTY).astype(np.uint8)
    return Walls(np.ascontiguousarray(labels), walls.metres_per_pixel, f"{walls.name}, {how}")


def _box(mask: NDArray[np.bool_]) -> tuple[int, int, int, int]:
    """First and last (exclusive) row and column that hold wall: top, left, bottom, right."""
    if not mask.any():
        raise ValueError("walls must hold at least one wall pixel, got none")
    rows, cols = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    return int(rows[0]), int(cols[0]), int(rows[-1]) + 1, int(cols[-1]) + 1


def _smaller_side(mask: NDArray[np.bool_]) -> int:
    """The smaller side of what the walls enclose, pixels."""
    top, left, bottom, right = _box(mask)
    return min(bottom - top, right - left)
