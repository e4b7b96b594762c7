"""How much of the ink that is as heavy as the walls was taken for walls: a result that left most of it out says so."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from priorlab.drawing.strokes import common_thickness, opened

AS_THICK = 0.75
"""Ink so much as thick as the walls is as heavy as they are."""

LEAST_KEPT = 0.5
"""When less of it was taken, a reader is told."""


def share_kept(walls: NDArray[np.bool_], ink: NDArray[np.bool_]) -> float:
    """Share that the walls are of themselves and of all ink that is as heavy; 1 when none else is as heavy, nan without walls.

    >>> ink = np.zeros((40, 60), dtype=bool); ink[4:10] = ink[20:26] = ink[30] = True
    >>> walls = ink.copy(); walls[15:] = False
    >>> share_kept(walls, ink), share_kept(ink, ink), share_kept(ink & False, ink)
    (0.5, 1.0, nan)
    """
    if not walls.any():
        return float("nan")
    heavy = opened(ink, max(2, round(AS_THICK * common_thickness(walls))))
    return float(np.count_nonzero(walls) / np.count_nonzero(walls | heavy))
