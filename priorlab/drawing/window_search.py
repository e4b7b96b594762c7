"""Windows among the walls: stretches where parallel thin lines run from one wall end to the other, as thick as the wall.

A wall is ink all through, or two faces, or hatching between them. Across a window lie three lines or more with white between
them, all along it; or two that are lighter than walls are drawn.
"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.drawing.deskew import turn_by, wing_angles
from priorlab.drawing.faces import long_runs
from priorlab.drawing.runs import gaps_between, label_runs, run_lengths
from priorlab.drawing.wall_sizes import WallSizes

Box = tuple[int, int, int, int]

NARROWEST = 5
"""Fewer pixels across leave no room for lines with white between."""

THIN = 0.45
"""A line of a window is no thicker than this share of the window."""

INKED = 0.8
"""So much of a cross-section is ink at most."""

AT_FACE = 0.3
"""The outermost lines lie within this share of the thickness from the faces of the wall."""

OTHER_INK = 0.25
"""In so many of a window's cross-sections, at most, is ink that is no line along it: posts, and what a scan leaves."""

SPECK = 0.2
"""Smaller ink, as a share of the thickness in pixels, is dirt."""

SLENDER, LONGEST = 1.1, 12.0
"""A window is so many times longer than thick: at least, and at most, about 4 m in a wall of 35 cm."""

POST = 0.5
"""A post across a window is no wider than this share of the thickest wall."""

FILLS = 0.8
"""The cross-sections of a window fill so much of the box round it."""

MOST = 0.5
"""Rows that fewer of its columns have do not belong to it: furniture stands before it."""

ALREADY = 0.4
"""A window whose lines were not all found has no more wall in its box than this."""

BEYOND, GOES_ON, SO_FAR = 1.2, 0.7, 0.3
"""Within 1.2 thicknesses beyond each end stands wall across 70 % of the thickness, for at least 30 % of it along the window."""

SAME_THICKNESS = 0.35
"""A wall in line with a window is not thicker than it by more than this share to one side; one that passes its end is."""

REACHES = (1.0, 0.5)
"""Lines belong together across so many times the thickest wall: furniture may stand nearer to a thin one."""


def find_windows(
    walls: NDArray[np.bool_], ink: NDArray[np.bool_], sizes: WallSizes, weight: float = 0.0, fewest: int = 2
) -> NDArray[np.bool_]:
    """The windows of walls, from face to face, along both axes and along the walls of wings.

    Parameters
    ----------
    walls : (height, width) bool, what was found, with the lines of windows or without
    ink : (height, width) bool, all ink that may belong to a window
    sizes : of walls on this sheet
    weight : least weight of the lines that walls are drawn with, pixels; 0 where weight does not tell
    fewest : so many lines make a window when they are lighter than this; else three

    Returns
    -------
    (height, width) bool, True on the boxes of windows, white between their lines too

    >>> walls, ink = np.zeros((2, 24, 120), dtype=bool)
    >>> walls[8:16, :40] = walls[8:16, 80:] = True
    >>> ink[[8, 11, 15], 40:80] = True
    >>> found = find_windows(walls | ink, walls | ink, WallSizes(400, 10))
    >>> found[8:16, 40:80].all(), found[:, :38].any(), find_windows(walls, walls, WallSizes(400, 10)).any()
    (np.True_, np.False_, np.False_)
    """
    found = _along_axes(walls, ink, sizes, weight, fewest)
    for angle in wing_angles(walls):
        turn = turn_by(-angle, walls.shape)
        turned, turned_ink = (turn.image(255 * (1 - mask.astype(np.uint8))) < 128 for mask in (walls, ink))
        found |= turn.mask_back(_along_axes(turned, turned_ink, sizes, weight, fewest))
    return found


def _along_axes(
    walls: NDArray[np.bool_], ink: NDArray[np.bool_], sizes: WallSizes, weight: float, fewest: int
) -> NDArray[np.bool_]:
    """Windows of walls that run along x, and along y."""
    return _along_x(walls, ink, sizes, weight, fewest) | _along_x(walls.T, ink.T, sizes, weight, fewest).T


def _along_x(walls: NDArray[np.bool_], ink: NDArray[np.bool_], sizes: WallSizes, weight: float, fewest: int) -> NDArray[np.bool_]:
    """Windows of walls that run along x: among what was found, and where lines of the drawing go on between two walls."""
    found = np.zeros_like(walls)
    with_lines = walls | long_runs(ink, sizes.face_length, 1)
    for reach in REACHES:
        solid = walls | gaps_between(walls, reach * sizes.thickness, 0)
        for is_new, body in ((False, solid), (True, with_lines | gaps_between(with_lines, reach * sizes.thickness, 0))):
            drawn = ink & body
            lines, glazed = _cross_sections(body, drawn, weight, fewest)
            joined = glazed | (gaps_between(glazed, max(NARROWEST, round(POST * sizes.thickness)), 1) & body)
            across, plain = run_lengths(lines, 0), []
            wall = solid.copy()
            for x, y, width, height in {*_boxes(glazed), *_boxes(joined)}:
                box = np.s_[y : y + height, x : x + width]
                if _crossed(drawn[box], lines[box]) <= OTHER_INK and not (is_new and walls[box].mean() > ALREADY):
                    plain.append((x, y, width, height))
                    wall[box] = False
            for x, y, width, height in plain:
                box = np.s_[y : y + height, x : x + width]
                if _goes_on(wall, (x, y, width, height), in_line=across[box].max() >= weight):
                    found[box] = True
    return found


def _cross_sections(
    body: NDArray[np.bool_], drawn: NDArray[np.bool_], weight: float, fewest: int
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Thin lines along x in a body, and those of its columns that are lines with white between, from face to face."""
    sections = label_runs(body, 0)
    n = int(sections.max()) + 1
    size = np.bincount(sections.ravel(), minlength=n)
    size[0] = 0
    lines = drawn & (run_lengths(drawn, 1) >= np.maximum(size, NARROWEST)[sections])
    across = run_lengths(lines, 0)
    lines &= across <= np.maximum(2, THIN * size)[sections]
    starts = lines.copy()
    starts[1:] &= ~lines[:-1]
    count = np.bincount(sections[starts], minlength=n)
    inked = np.bincount(sections[drawn], minlength=n)
    top, low = np.full((2, n), body.shape[0])
    high, heaviest = np.full(n, -1), np.zeros(n, dtype=np.int32)
    rows, cols = np.nonzero(lines)
    which = sections[rows, cols]
    np.minimum.at(low, which, rows)
    np.maximum.at(high, which, rows)
    np.maximum.at(heaviest, which, across[rows, cols])
    rows, cols = np.nonzero(body)
    np.minimum.at(top, sections[rows, cols], rows)
    near = np.maximum(1, AT_FACE * size)
    take = (count >= np.where(heaviest < weight, fewest, 3)) & (inked <= INKED * size)
    take &= (low - top <= near) & (top + size - 1 - high <= near) & (size >= NARROWEST)
    take[0] = False
    return lines, take[sections]


def _boxes(glazed: NDArray[np.bool_]) -> list[Box]:
    """x, y, width, height of the pieces that have the shape of a window along x: the rows that most of their columns have."""
    _, parts, stats, _ = cv2.connectedComponentsWithStats(glazed.astype(np.uint8), connectivity=4)
    found = []
    for k, (x, y, width, height, area) in enumerate(stats.tolist()):
        if k and height >= NARROWEST and width <= LONGEST * height and area >= FILLS * width * height:
            rows = np.flatnonzero((parts[y : y + height, x : x + width] == k).mean(axis=1) >= MOST)
            y, height = y + int(rows[0]), int(rows[-1] - rows[0] + 1)
            if height >= NARROWEST and SLENDER * height <= width <= LONGEST * height:
                found.append((x, y, width, height))
    return found


def _crossed(drawn: NDArray[np.bool_], lines: NDArray[np.bool_]) -> float:
    """Share of the columns with ink that belongs to no line along x; rough edges and specks aside."""
    near = cv2.dilate(lines.astype(np.uint8), np.ones((3, 1), np.uint8)).astype(bool)
    _, parts, stats, _ = cv2.connectedComponentsWithStats((drawn & ~near).astype(np.uint8), connectivity=8)
    large = stats[:, cv2.CC_STAT_AREA] >= max(3, SPECK * len(drawn))
    large[0] = False
    return float(large[parts].any(axis=0).mean())


def _goes_on(wall: NDArray[np.bool_], box: Box, in_line: bool) -> bool:
    """Does wall stand beyond both ends of a box? Asked in line: is it at one end at least as thick as the box, or thinner?"""
    x, y, width, height = box
    reach = max(6, round(BEYOND * height))
    enough, slack = max(2, SO_FAR * height), round(SAME_THICKNESS * height) + 1
    above, below = max(y - slack, 0), y + height + slack
    ends, in_lines = [], []
    for side in (np.s_[max(x - reach, 0) : x], np.s_[x + width : x + width + reach]):
        stands = wall[y : y + height, side].sum(axis=0) >= GOES_ON * height
        higher = wall[above:y, side].all(axis=0) | wall[y + height : below, side].all(axis=0)
        ends.append(stands.sum() >= enough)
        in_lines.append((stands & ~higher).sum() >= enough)
    return all(ends) and (any(in_lines) or not in_line)
