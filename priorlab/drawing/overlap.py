"""Two doors do not share a place: the dark share and the overlap of triangles (thesis 3.3.1, false positives)."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray


def triangle_pixels(triangle: ArrayLike, erode: bool = False) -> tuple[NDArray[np.uint8], int, int]:
    """A triangle drawn into the smallest image that holds it, and that image's left column and top row."""
    points = np.rint(np.asarray(triangle, dtype=np.float64)).astype(np.int32)
    left, top = points.min(axis=0) - 1
    right, bottom = points.max(axis=0) + 2
    image = np.zeros((bottom - top, right - left), dtype=np.uint8)
    cv2.fillConvexPoly(image, points - [left, top], 1)
    if erode:
        image = np.asarray(cv2.erode(image, np.ones((3, 3), np.uint8)), dtype=np.uint8)
    return image, int(left), int(top)


def dark_share(ink: ArrayLike, triangle: ArrayLike) -> float:
    """Share of ink inside a triangle without its rim of one pixel; 0 when nothing is left of it.

    Parameters
    ----------
    ink : (height, width) bool
    triangle : (3, 2) x, y

    >>> dark_share(np.ones((20, 20), dtype=bool), [(2, 2), (15, 2), (2, 15)])
    1.0
    """
    ink = np.asarray(ink, dtype=bool)
    inside, left, top = triangle_pixels(triangle, erode=True)
    rows, cols = np.nonzero(inside)
    rows, cols = rows + top, cols + left
    kept = (rows >= 0) & (cols >= 0) & (rows < ink.shape[0]) & (cols < ink.shape[1])
    return float(ink[rows[kept], cols[kept]].mean()) if kept.any() else 0.0


def shared_area(one: ArrayLike, other: ArrayLike) -> float:
    """Area that two triangles have in common, as a share of the smaller one.

    >>> shared_area([(0, 0), (10, 0), (0, 10)], [(0, 0), (10, 0), (0, 10)])
    1.0
    >>> shared_area([(0, 0), (10, 0), (0, 10)], [(50, 50), (60, 50), (50, 60)])
    0.0
    """
    first = np.asarray(one, dtype=np.float32)
    second = np.asarray(other, dtype=np.float32)
    smaller = min(cv2.contourArea(first), cv2.contourArea(second))
    common, _ = cv2.intersectConvexConvex(first, second)
    return float(common / smaller) if smaller > 0 else 0.0


def overlap_with_kept(triangles: NDArray[np.float64], max_overlap: float) -> NDArray[np.float64]:
    """Largest area that each triangle shares with one kept before it, in the order given: (K,) shares of the smaller one.

    A triangle is kept when this is at most `max_overlap`.
    """
    shared = np.zeros(len(triangles))
    low, high = triangles.min(axis=1), triangles.max(axis=1)
    for index in range(len(triangles)):
        kept = np.flatnonzero(shared[:index] <= max_overlap)
        boxes_meet = (low[kept] < high[index]).all(axis=1) & (high[kept] > low[index]).all(axis=1)
        for other in kept[boxes_meet]:
            shared[index] = max(shared[index], shared_area(triangles[index], triangles[other]))
            if shared[index] > max_overlap:
                break
    return shared
