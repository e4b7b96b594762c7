"""Shapes of cells: how large each white area between lines is, where it lies, how it slants, which one lies beyond a stroke."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class CellShapes:
    """Area, spread and extent of K numbered cells; number 0 is what is no cell.

    Parameters
    ----------
    area : (K,) pixels
    x, y : (K,) their middles
    xx, yy, xy : (K,) variances of the pixels' places along x and y (y down) and their covariance, square pixels
    low, high : (2, K) first and last row, first and last column
    """

    area: NDArray[np.float64]
    x: NDArray[np.float64]
    y: NDArray[np.float64]
    xx: NDArray[np.float64]
    yy: NDArray[np.float64]
    xy: NDArray[np.float64]
    low: NDArray[np.int64]
    high: NDArray[np.int64]

    @property
    def fullness(self) -> NDArray[np.float64]:
        """Area over that of the parallelogram with the same spread, 12 sqrt(det): 1 of every parallelogram, .87 of a triangle."""
        spread = 12 * np.sqrt(np.maximum((self.xx + 1 / 12) * (self.yy + 1 / 12) - self.xy**2, 1e-9))  # pixels are squares
        return self.area / spread

    def drift(self, axis: int) -> NDArray[np.float64]:
        """How far the middle of a cell moves along an axis per pixel across it: its slant there, the cotangent or the tangent."""
        across = self.yy if axis == 1 else self.xx
        return self.xy / np.maximum(across, 1e-9)

    def breadth(self, axis: int) -> NDArray[np.float64]:
        """Width along an axis of the rectangle that is as widely spread, pixels."""
        return np.sqrt(12 * (self.xx if axis == 1 else self.yy) + 1)


def cell_shapes(cells: NDArray[np.int32]) -> CellShapes:
    """Shapes of numbered cells.

    >>> cells = np.zeros((6, 12), dtype=np.int32)
    >>> for row in range(4): cells[1 + row, 2 + row : 6 + row] = 1
    >>> shapes = cell_shapes(cells); shapes.area[1], shapes.drift(axis=1)[1], shapes.low[:, 1].tolist()
    (np.float64(16.0), np.float64(1.0), [1, 2])
    """
    n_cells = int(cells.max(initial=0)) + 1
    rows, cols = np.nonzero(cells)
    labels = cells[rows, cols]
    area = np.bincount(labels, minlength=n_cells).astype(np.float64)
    some = np.maximum(area, 1)
    x, y = (np.bincount(labels, where, n_cells) / some for where in (cols, rows))
    dx, dy = cols - x[labels], rows - y[labels]
    xx, yy, xy = (np.bincount(labels, product, n_cells) / some for product in (dx * dx, dy * dy, dx * dy))
    low, high = np.full((2, n_cells), max(cells.shape)), np.full((2, n_cells), -1)
    for k, where in enumerate((rows, cols)):
        np.minimum.at(low[k], labels, where)
        np.maximum.at(high[k], labels, where)
    return CellShapes(area, x, y, xx, yy, xy, low, high)


def across_strokes(cells: NDArray[np.int32], ink: NDArray[np.bool_], reach: float, axis: int) -> NDArray[np.int64]:
    """(N, 3) pairs of cells with one stroke between them: their numbers, and the pixels of ink between them along an axis.

    A pair stands there once for every line of pixels in which they meet.

    >>> cells = np.array([[1, 1, 0, 0, 2, 0, 3]], dtype=np.int32)
    >>> across_strokes(cells, cells == 0, 2, axis=1).tolist()
    [[1, 2, 2], [2, 3, 1]]
    """
    longest = max(1, int(reach))
    lines, stroke = (cells, ink) if axis == 1 else (cells.T, ink.T)
    room = np.zeros((lines.shape[0], lines.shape[1] + longest + 1), dtype=np.int32)  # so that no pair goes on in the next row
    room[:, : lines.shape[1]] = np.where(stroke, 0, np.where(lines > 0, lines, -1))  # wide areas end a stroke, too
    flat = room.ravel()
    at = np.flatnonzero(flat)
    gap = np.diff(at) - 1
    near = np.flatnonzero((gap >= 1) & (gap <= longest))
    first, second = flat[at[near]], flat[at[near + 1]]
    pair = (first > 0) & (second > 0) & (first != second)
    return np.column_stack([first, second, gap[near]])[pair].astype(np.int64)
