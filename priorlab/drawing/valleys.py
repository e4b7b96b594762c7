"""The light between two strokes that stand close together: blur and a threshold would make one heavy stroke of them."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.drawing.runs import gaps_between, run_lengths

WIDEST = 4
"""Widest gap that blur can bring above the threshold of ink, pixels."""

DEPTH = 0.3
"""A valley is lighter than the strokes on both its sides by this share of their darkness; paper grain and JPEG are not."""


FLAT = 12
"""The bottom of a valley is flat to so many grey levels; its slopes are the soft edges of the strokes."""

LENGTH = 2 * WIDEST
"""A valley runs on for so many pixels between its strokes; a line drawn askew only breaks for a step."""


def valleys(darkness: NDArray[np.uint8]) -> NDArray[np.bool_]:
    """Where the darkness has a narrow gap along an axis: a table's edge two pixels off a wall is not the wall's.

    D < (1 - DEPTH) closing(D), closed over `WIDEST` pixels along x or along y, for `LENGTH` pixels along the other axis; only the
    bottom of the valley is taken, as its slopes are the strokes' own.

    Parameters
    ----------
    darkness : (height, width) uint8, distance from the colour of the paper

    >>> darkness = np.tile(np.array([0, 0, 0, 250, 250, 120, 200, 0, 0, 0], dtype=np.uint8), (9, 1))
    >>> valleys(darkness).all(axis=0).astype(int).tolist(), bool(valleys(darkness[:5]).any())
    ([0, 0, 0, 0, 0, 1, 0, 0, 0, 0], False)
    """
    found = np.zeros(darkness.shape, dtype=bool)
    for axis, shape in ((0, (WIDEST + 1, 1)), (1, (1, WIDEST + 1))):
        closed = cv2.morphologyEx(darkness, cv2.MORPH_CLOSE, np.ones(shape, np.uint8))
        lowest = cv2.erode(darkness, np.ones((1, 3) if axis else (3, 1), np.uint8))
        bottom = darkness <= lowest.astype(np.int16) + FLAT
        found |= run_lengths(bottom & (darkness < (1 - DEPTH) * closed), 1 - axis) >= LENGTH
    return found


def narrow_gaps(walls: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Gaps as wide as a valley between two parts of walls: ink there is wall again, as between the lines of a window.

    >>> narrow_gaps(np.array([[1, 0, 0, 1, 0, 0, 0, 0, 0, 1]], dtype=bool)).astype(int).tolist()
    [[0, 1, 1, 0, 0, 0, 0, 0, 0, 0]]
    """
    return gaps_between(walls, WIDEST, 0) | gaps_between(walls, WIDEST, 1)
