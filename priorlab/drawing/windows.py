"""Windows: ink of theirs is wall, the space between their lines is none, nor is a lone line across an opening.

Two or more white rectangles of the same length, side by side between the same ends, are panes (or treads): a wall's inside is
one cell, or goes on round a corner.
"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.drawing.runs import gaps_between, run_lengths
from priorlab.drawing.strokes import bridge_windows, common_thickness, thinner_run
from priorlab.drawing.wall_sizes import WallSizes

RECTANGLE = 0.8
"""A pane covers so much of the box round it."""

SAME_ENDS = 0.06
"""Panes of one window end together: so far apart at most, as a share of their length."""

PANE_LENGTH = 2.0
"""A pane is so many times longer than wide."""

FRAME = 0.006
"""Thickest line between two panes, share of M."""

ROOMY = 8
"""Walls thinner than so many pixels leave no room to tell two lines apart."""

ACROSS = 0.4
"""The outermost lines of a window lie so much of a wall's thickness apart."""

THICKEST, AS_WIDE = 90, 1.6
"""A window is no thicker than 1.6 times what 90 % of the walls' area is; a flight of stairs between two walls is."""


def window_panes(cells: NDArray[np.int32], sizes: WallSizes) -> NDArray[np.bool_]:
    """Thin cells that are panes: rectangles side by side between the same ends.

    >>> cells = np.zeros((9, 20), dtype=np.int32); cells[1:3, 2:18] = 1; cells[4:6, 2:18] = 2; cells[7, 2:9] = 3
    >>> np.unique(cells[window_panes(cells, WallSizes(500, 10))]).tolist()
    [1, 2]
    """
    rows, cols = np.nonzero(cells)
    if not rows.size:
        return np.zeros(cells.shape, dtype=bool)
    labels, n_cells = cells[rows, cols], int(cells.max()) + 1
    low, high = np.full((2, n_cells), max(cells.shape)), np.full((2, n_cells), -1)
    for k, where in enumerate((cols, rows)):
        np.minimum.at(low[k], labels, where)
        np.maximum.at(high[k], labels, where)
    size = high - low + 1
    area = np.bincount(labels, minlength=n_cells)
    found = np.zeros(n_cells, dtype=bool)
    gap = max(3.0, FRAME * sizes.long_side)
    for along, across in ((0, 1), (1, 0)):
        pane = (area > 0) & (area >= RECTANGLE * size[0] * size[1]) & (size[along] >= PANE_LENGTH * size[across])
        pane &= size[along] >= sizes.thickness / 2
        index = np.flatnonzero(pane)
        index = index[np.argsort(low[across, index], kind="stable")]
        for i, one in enumerate(index):
            slack = max(2.0, SAME_ENDS * size[along, one])
            rest = index[i + 1 :]
            rest = rest[low[across, rest] <= high[across, one] + 1 + gap]
            beside = rest[low[across, rest] > high[across, one]]
            same = np.abs(low[along, beside] - low[along, one]) <= slack
            same &= np.abs(high[along, beside] - high[along, one]) <= slack
            found[beside[same]] = True
            found[one] |= bool(same.any())
    return found[cells]


def window_bridges(walls: NDArray[np.bool_], ink: NDArray[np.bool_], longest: float) -> NDArray[np.bool_]:
    """Ink of windows that join two pieces of wall: `bridge_windows`, without lone lines, and without treads.

    A window has two lines or more, and is as thick as a wall.

    Parameters
    ----------
    walls : (height, width) bool
    ink : (height, width) bool, all ink
    longest : pixels
    """
    bridges = bridge_windows(walls, ink, longest)
    thickness = common_thickness(walls)
    apart = ACROSS * thickness if thickness >= ROOMY else 0.0
    wide = max(2.0 * ROOMY, AS_WIDE * float(np.percentile(thinner_run(walls)[walls], THICKEST))) if walls.any() else 0.0
    kept = np.zeros_like(walls)
    for axis in (0, 1):
        lines = bridges & (run_lengths(bridges, axis) > run_lengths(bridges, 1 - axis))
        band = lines | gaps_between(lines, thickness, 1 - axis)
        across = run_lengths(band, 1 - axis)
        kept |= lines & (across >= apart) & (across <= wide)
    near = cv2.dilate(kept.astype(np.uint8), np.ones((3, 3), np.uint8)).astype(bool)
    return kept | (bridges & near)
