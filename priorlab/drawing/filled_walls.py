"""Drawings on which some walls are filled and others are hatched: each finds the others.

Filled walls among hatched ones are strokes of ink thicker than faces, from one wall to another. Hatched walls among filled ones
are those round the building; hatched furniture is nowhere as large.
"""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.core.drawing import Door
from priorlab.drawing.faces import long_runs
from priorlab.drawing.joined import jambs_at
from priorlab.drawing.strokes import opened
from priorlab.drawing.wall_sizes import WallSizes

THICKER = 1.5
"""Filled walls are more than so many times as thick as the faces of hatched ones."""

CONTACTS = 2
"""A filled wall meets others, or holds the jambs of doors, at so many places: a leaf or a stove does at one."""

ROUNDS = 3
"""So many filled walls may hang on each other."""

ROUND = 0.8
"""Walls round a building are so much as wide and as high as all walls are."""

REACH = 3
"""Pixels from a wall to one that it meets."""


def with_filled(
    walls: NDArray[np.bool_], face: float, ink: NDArray[np.bool_], doors: Sequence[Door], sizes: WallSizes
) -> NDArray[np.bool_]:
    """Hatched walls and the filled ones among them.

    Parameters
    ----------
    walls : (height, width) bool, hatched walls
    face : thickness of their faces, pixels
    ink : (height, width) bool, ink without doors
    doors : in the same pixels
    sizes : of walls on this sheet

    >>> walls, ink = np.zeros((2, 60, 100), dtype=bool); walls[:, :10] = walls[:, 90:] = True
    >>> ink[20:25] = True; ink[40:45, 40:] = True; ink[50] = True
    >>> found = with_filled(walls, 1, ink, (), WallSizes(100, 10)); found[[22, 42, 50], 50].tolist()
    [True, False, False]
    """
    thick = opened(ink & ~walls, int(THICKER * face) + 1)
    strokes = long_runs(thick, sizes.face_length, 0) | long_runs(thick, sizes.face_length, 1)
    n_parts, parts, stats, _ = cv2.connectedComponentsWithStats(strokes.astype(np.uint8), connectivity=8)
    square = np.ones((2 * REACH + 1, 2 * REACH + 1), np.uint8)
    found, left = walls.copy(), list(range(1, n_parts))
    for _ in range(ROUNDS):
        before = found.copy()
        for k in left.copy():
            x, y, width, height = stats[k, :4]
            top, start = max(0, y - REACH), max(0, x - REACH)
            window = np.s_[top : y + height + REACH, start : x + width + REACH]
            part = parts[window] == k
            met = cv2.dilate(part.astype(np.uint8), square).astype(bool) & before[window]
            contacts = cv2.connectedComponents(met.astype(np.uint8), connectivity=8)[0] - 1
            if contacts + jambs_at(part, (start, top), doors) >= CONTACTS:
                found[window] |= part
                left.remove(k)
    return found


def walls_round(others: NDArray[np.bool_], walls: NDArray[np.bool_], ink: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Walls of another kind that hang together by ink round all others; nothing where none do.

    >>> walls, others = np.zeros((2, 40, 60), dtype=bool); others[5:35, 5:55] = True; others[9:31, 9:51] = False
    >>> walls[20:22, 9:51] = True; ink = others | walls
    >>> int((walls_round(others, walls, ink) ^ others).sum()), bool(walls_round(others[::-1] & walls, walls, ink).any())
    (0, False)
    """
    if not others.any():
        return others
    n_nets, nets = cv2.connectedComponents((others | ink).astype(np.uint8), connectivity=8)
    largest = int(np.bincount(nets[others], minlength=n_nets).argmax())
    found = others & (nets == largest)
    size, all_walls = (cv2.boundingRect(mask.astype(np.uint8))[2:] for mask in (found, found | walls))
    goes_round = all(np.greater_equal(size, np.multiply(ROUND, all_walls)))
    return found if goes_round else np.zeros_like(found)
