"""Outer walls: the ink along the lines through the extreme corners (thesis eq. 3.11-3.14)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray


def extreme_corners(corners: ArrayLike) -> tuple[float, float, float, float]:
    """x_min, x_max, y_min, y_max of the corners, eq. 3.11.

    >>> extreme_corners([(3, 9), (7, 2)])
    (3.0, 7.0, 2.0, 9.0)
    """
    x, y = np.asarray(corners, dtype=np.float64).reshape(-1, 2).T
    return float(x.min()), float(x.max()), float(y.min()), float(y.max())


def outer_walls(ink: ArrayLike, corners: ArrayLike, tolerance: float = 2.0) -> NDArray[np.bool_]:
    """Ink on the four lines through the extreme corners, and on lines up to `tolerance` pixels beside them.

    Parameters
    ----------
    ink : (height, width) bool
    corners : (N, 2) x, y pixels; no corners, no outer walls
    tolerance : pixels; corners are seldom exactly on the wall

    Returns
    -------
    (height, width) bool, W_out

    >>> room = np.ones((7, 7), dtype=bool); room[1:-1, 1:-1] = False
    >>> outer_walls(room, [(0, 0), (6, 6), (3, 3)], tolerance=0).sum()
    np.int64(24)
    """
    ink = np.asarray(ink, dtype=bool)
    points = np.asarray(corners, dtype=np.float64).reshape(-1, 2)
    found = np.zeros_like(ink)
    if not len(points):
        return found
    x_min, x_max, y_min, y_max = extreme_corners(points)
    rows, cols = np.arange(ink.shape[0]), np.arange(ink.shape[1])
    across = (cols >= x_min - tolerance) & (cols <= x_max + tolerance)
    down = (rows >= y_min - tolerance) & (rows <= y_max + tolerance)
    on_row = (np.abs(rows - y_min) <= tolerance) | (np.abs(rows - y_max) <= tolerance)
    on_col = (np.abs(cols - x_min) <= tolerance) | (np.abs(cols - x_max) <= tolerance)
    found |= on_row[:, None] & across[None, :]  # H_points, eq. 3.13
    found |= down[:, None] & on_col[None, :]  # V_points, eq. 3.14
    return found & ink  # eq. 3.12
