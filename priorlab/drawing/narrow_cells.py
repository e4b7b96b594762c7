"""Narrow cells: hatching, window panes and the insides of walls are no places where a door ends, but full of corners."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray


def with_narrow_cells(ink: NDArray[np.bool_], diameter: float) -> NDArray[np.bool_]:
    """Ink, and the white that lines enclose where a disc has no room: a hatched wall becomes solid, a pane a bar.

    What is filled keeps its outline, so the corners of a wall and of a leaf stay; those inside are gone.

    Parameters
    ----------
    ink : (height, width) bool
    diameter : of the disc, pixels

    >>> ink = np.zeros((7, 22), dtype=bool)
    >>> ink[1, 1:21] = ink[5, 1:21] = ink[1:6, [1, 5, 20]] = True  # a cell 3 pixels wide and a cell 14 pixels long, both 3 high
    >>> with_narrow_cells(ink, 5)[3].sum(), with_narrow_cells(ink, 3)[3].sum()
    (np.int64(20), np.int64(3))
    """
    white = np.pad(~ink, 1, constant_values=True).astype(np.uint8)  # what touches the rim of the sheet is not enclosed
    _, cells = cv2.connectedComponents(white, connectivity=4)
    depth = cv2.distanceTransform(white, cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
    wide = np.zeros(int(cells.max()) + 1, dtype=bool)
    wide[cells[(depth > diameter / 2) & (white > 0)]] = True
    wide[cells[0, 0]] = True
    return ~wide[cells][1:-1, 1:-1] | ink
