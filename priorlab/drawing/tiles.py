"""Divide and conquer (thesis 3.4.2): corners are looked for in every tile, so that no part of a drawing takes all of the budget.

The doors are then searched among the corners of all tiles together. That finds what a search in each tile finds, and the doors
on the seams; the graph of connected corners keeps it quick.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

RIM = 8
"""Pixels beyond its tile that the corner detector sees: a seam is no edge."""

Box = tuple[int, int, int, int]
"""left, top, right, bottom in pixels; right and bottom are one past the last."""


def tile_boxes(shape: tuple[int, int], n: int) -> tuple[Box, ...]:
    """n x n tiles that cover an image once, row by row, as equal as whole pixels allow.

    Parameters
    ----------
    shape : (height, width)
    n : tiles along each side

    Raises
    ------
    ValueError
        When n is below 1.

    >>> tile_boxes((10, 21), 2)
    ((0, 0, 10, 5), (10, 0, 21, 5), (0, 5, 10, 10), (10, 5, 21, 10))
    """
    if n < 1:
        raise ValueError(f"tiles must be at least 1, got {n}")
    height, width = shape
    downs = [height * k // n for k in range(n + 1)]
    acrosses = [width * k // n for k in range(n + 1)]
    return tuple(
        (left, top, right, bottom)
        for top, bottom in zip(downs, downs[1:], strict=False)
        for left, right in zip(acrosses, acrosses[1:], strict=False)
        if right > left and bottom > top
    )


def in_tiles(
    image: NDArray[np.uint8],
    where: NDArray[np.uint8] | None,
    n: int,
    find: Callable[[NDArray[np.uint8], NDArray[np.uint8] | None], NDArray[np.float64]],
) -> NDArray[np.float64]:
    """Corners of every tile, in pixels of the image.

    Parameters
    ----------
    image : (height, width) uint8
    where : (height, width) uint8, not 0 where corners may lie; None for everywhere
    n : tiles along each side
    find : finds the corners of a part, (N, 2) x, y, given the part and where to look
    """
    found = [np.empty((0, 2))]
    height, width = image.shape
    for left, top, right, bottom in tile_boxes(image.shape, n):
        x0, y0 = max(left - RIM, 0), max(top - RIM, 0)
        part = (slice(y0, min(bottom + RIM, height)), slice(x0, min(right + RIM, width)))
        inside = np.zeros(image[part].shape, dtype=np.uint8)
        inside[top - y0 : bottom - y0, left - x0 : right - x0] = 1
        if where is not None:
            inside &= (where[part] > 0).astype(np.uint8)
        found.append(find(np.ascontiguousarray(image[part]), inside) + (x0, y0))
    return np.concatenate(found)
