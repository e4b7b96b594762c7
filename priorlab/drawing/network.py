"""What belongs to the building: its walls hang together across doors and windows, and hold the doors.

A frame goes round the building and has no door; neither have title blocks and scale bars beside it. A stove or a column is a
block that no other ink touches; a pier has a window's lines or a door at it.
"""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.core.drawing import Door
from priorlab.drawing.deskew import turn_by
from priorlab.drawing.strokes import common_thickness, thinner_run
from priorlab.drawing.wall_sizes import WallSizes
from priorlab.drawing.weight import with_openings
from priorlab.drawing.window_search import wing_angles

ALONE = 0.05
"""A piece of the building that stands alone holds so much of all walls."""

DOORLESS = 0.3
"""Where another piece holds the doors, one without any stays when it is so large beside it and does not surround it."""

AT_JAMB = 0.15
"""A jamb stands at a piece within so many door widths."""

BLOCK = 3.0
"""A block is at most so many wall thicknesses long."""

AS_THICK = 0.5
"""Pieces to which lines lead are so much as thick as walls are."""

FREE = 0.9
"""So much of the ink that hangs together with a block, at least, is the block itself."""


CLEAR = 0.02
"""A frame is so far from a building all round, and a mark beside it, as a share of M."""

FRAME_SPAN = 0.85
"""A frame is at least so wide and high, as shares of the sheet."""

MARK = 0.1
"""The box round a mark is no larger than this share of the building's."""


def of_network(
    walls: NDArray[np.bool_],
    doors: Sequence[Door],
    sizes: WallSizes,
    ink: NDArray[np.bool_] | None = None,
    lines: NDArray[np.bool_] | None = None,
) -> NDArray[np.bool_]:
    """Walls that hang together, across doors and windows: no frame, no title block, no furniture that stands alone.

    A piece stays when a door's jamb stands at it. Another one stays when it holds `ALONE` of all walls and, where a piece with
    doors is there, `DOORLESS` of that one and does not go round it. Where ink is given, it must lead from piece to piece, as the
    lines of a window do; else any gap as long as an opening will do. A piece about as thick as walls stays, too, when `lines`
    lead to it from those that stay.
    """
    if ink is None:
        whole = cv2.dilate(walled_up(walls, sizes).astype(np.uint8), np.ones((5, 5), np.uint8))
    else:
        whole = (walls | ink).astype(np.uint8)
    for door in doors:
        start, end = (tuple(round(c) for c in jamb) for jamb in (door.hinge, door.strike))
        cv2.line(whole, start, end, 1, max(3, round(2 * AT_JAMB * door.width)))
    nets, low, high, _ = _boxes(whole.astype(bool))
    area = np.bincount(nets[walls], minlength=len(low))
    held = np.zeros(len(low), dtype=bool)
    for door in doors:
        for x, y in np.rint([door.hinge, door.strike]).astype(int):
            held[nets[np.clip(y, 0, len(nets) - 1), np.clip(x, 0, nets.shape[1] - 1)]] = True
    held[0] = False
    keep = area >= ALONE * area.sum()
    main = int(np.argmax(np.where(held, area, 0)))
    if held[main] and area[main] >= DOORLESS * area.max():  # else a false door may hang on a cupboard
        round_it = ((low < low[main]) & (high > high[main])).all(axis=1)
        keep &= (area >= DOORLESS * area[main]) & ~round_it
    found = walls & (keep | held)[nets]
    return found if lines is None else found | _led_to(walls & ~found, found, lines)


def _led_to(pieces: NDArray[np.bool_], walls: NDArray[np.bool_], lines: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Pieces that are linked with walls by lines, and about as thick."""
    if not pieces.any() or not walls.any():
        return np.zeros_like(walls)
    _, parts = cv2.connectedComponents((walls | pieces | lines).astype(np.uint8), connectivity=8)
    linked = np.zeros(int(parts.max()) + 1, dtype=bool)
    linked[np.unique(parts[walls])] = True
    n_pieces, number = cv2.connectedComponents((pieces & linked[parts]).astype(np.uint8), connectivity=8)
    across, least = thinner_run(pieces), AS_THICK * common_thickness(walls)
    thick = [k for k in range(1, n_pieces) if np.median(across[number == k]) >= least]
    return np.isin(number, thick)


def walled_up(walls: NDArray[np.bool_], sizes: WallSizes) -> NDArray[np.bool_]:
    """Walls with their openings closed, along the axes and along the walls of wings."""
    whole = with_openings(walls, sizes)
    for angle in wing_angles(walls):
        turn = turn_by(-angle, walls.shape)
        turned = turn.image(255 * (1 - walls.astype(np.uint8))) < 128
        whole |= turn.mask_back(with_openings(turned, sizes))
    return whole


def without_blocks(walls: NDArray[np.bool_], ink: NDArray[np.bool_], doors: Sequence[Door]) -> NDArray[np.bool_]:
    """Walls without compact blocks that no other ink touches and no door stands at.

    >>> walls = np.zeros((40, 60), dtype=bool); walls[5:11, 5:55] = True; walls[25:33, 20:30] = True
    >>> line = walls.copy(); line[29, 30:55] = True
    >>> without_blocks(walls, walls, ())[28, 25], without_blocks(walls, line, ())[28, 25]
    (np.False_, np.True_)
    """
    n_parts, parts, stats, _ = cv2.connectedComponentsWithStats((walls | ink).astype(np.uint8), connectivity=8)
    own = np.bincount(parts[walls], minlength=n_parts)
    longest = stats[:, cv2.CC_STAT_WIDTH : cv2.CC_STAT_HEIGHT + 1].max(axis=1)
    block = (longest <= BLOCK * common_thickness(walls)) & (own >= FREE * stats[:, cv2.CC_STAT_AREA])
    block[0] = False
    for door in doors:
        reach = max(3, round(AT_JAMB * door.width))
        for x, y in np.rint([door.hinge, door.strike]).astype(int):
            block[np.unique(parts[max(y - reach, 0) : y + reach + 1, max(x - reach, 0) : x + reach + 1])] = False
    return walls & ~block[parts]


def without_marks(walls: NDArray[np.bool_], sizes: WallSizes) -> NDArray[np.bool_]:
    """Walls without a closed frame that goes clear round the others, and without what lies small and clear beside these in it.

    On a sheet with a frame these are title blocks, north arrows and scale bars; without one, piers and parapets of the building.

    >>> walls = np.zeros((100, 120), dtype=bool); walls[[15, 84], 20:100] = walls[15:85, [20, 99]] = True
    >>> marks = np.zeros_like(walls); marks[[2, 97], 2:118] = marks[2:98, [2, 117]] = True  # a frame
    >>> marks[92:95, 108:114] = True  # a block beside the building
    >>> bool((without_marks(walls | marks, WallSizes(120, 4)) == walls).all())
    True
    """
    framed, far = walls, CLEAR * max(walls.shape)
    walls = _without_frame(framed)
    if walls is framed:
        return walls
    whole = cv2.dilate(walled_up(walls, sizes).astype(np.uint8), np.ones((5, 5), np.uint8))
    nets, low, high, extent = _boxes(whole.astype(bool))
    main = int(extent.argmax())
    beside = ((low - far > high[main]) | (high + far < low[main])).any(axis=1) & (extent < MARK * extent[main])
    return walls & ~beside[nets]


def _without_frame(walls: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Walls without a closed ring as large as the sheet that goes clear round all others."""
    parts, low, high, extent = _boxes(walls)
    ring = int(extent.argmax())
    others = extent > 0
    others[ring] = False
    if not others.any() or (high[ring] - low[ring] < FRAME_SPAN * np.array(walls.shape[::-1])).any():
        return walls
    first, last, far = low[others].min(axis=0), high[others].max(axis=0), CLEAR * max(walls.shape)
    clear = (first - low[ring] > far).all() and (high[ring] - last > far).all()
    if not clear or (last - first).prod() < DOORLESS * extent[ring]:
        return walls
    white = np.pad(parts != ring, 1, constant_values=True).astype(np.uint8)
    rooms = cv2.connectedComponents(white, connectivity=4)[1]
    is_open = (rooms[1:-1, 1:-1][others[parts]] == rooms[0, 0]).any()
    return walls if is_open else walls & (parts != ring)


def _boxes(mask: NDArray[np.bool_]) -> tuple[NDArray[np.int32], NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """Labels of 8-connected pieces, the corners x, y of the boxes round them, and the area of each box; 0 of what is no piece."""
    n_parts, parts, stats, _ = cv2.connectedComponentsWithStats(mask.astype(np.uint8), connectivity=8)
    low = stats[:, :2].astype(np.int64)
    size = stats[:, 2:4].astype(np.int64)
    return np.asarray(parts, dtype=np.int32), low, low + size, size.prod(axis=1) * (np.arange(n_parts) > 0)
