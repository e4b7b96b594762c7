"""Drawings on which heavy strokes are walls, all of them and nothing else, as programs render them.

On most drawings something else is heavy, too: letters, frames, title blocks, solid furniture. A rendering has hairlines, if any,
and walls. Then no wall needs a door, a neighbour or a certain size to be believed: piers, parapets and lone partitions stay.
"""

from __future__ import annotations

from collections.abc import Iterable

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.drawing.joined import inside_of
from priorlab.drawing.preprocessing import large_components
from priorlab.drawing.runs import run_lengths
from priorlab.drawing.strokes import HALF, half_covered, opened, thinner_run

ALL_HEAVY = "all heavy strokes"
"""Name of the hypothesis that takes them."""

LEAST, MOST = 3, 6
"""Strokes that may be heavy, pixels: the first width at which what is left looks like walls is taken."""

CORE = 0.75
"""Heavy strokes hold squares of pixels this share as dark as the darkest beside them; crossings of thin lines do not."""

STRAIGHT, RUN = 0.88, 0.04
"""So much of heavy strokes, by length, lies in straight runs of at least this share of M: letters and arcs do not."""

AS_THICK = 0.8
"""A small piece of wall is so many times as thick as the thinnest partitions."""

CRUMBS, CRUMB = 0.05, 0.02
"""No more of them, by length, lies in pieces shorter than this share of M: letters and dots."""

LIGHT, OUTSIDE = 0.3, 0.2
"""No more of all ink is light, and no more is light and lies outside the building: dimensions, notes, frames."""

THINNEST, PARTITION = 0.1, 0.25
"""So much of all walls, by length, is no thicker than the thinnest partitions, and than partitions are."""

TRACE, CONTRAST = 0.01, 1.5
"""Where more of the ink than a trace is light, the thinnest partitions are so many times as thick as it."""

FURNISHED = 0.1
"""More of the ink of furnished drawings than this is light."""

ARC = 0.2
"""The arc is so much of a door's ink, at least."""

BESIDE = 5
"""Ink within half so many pixels of a heavy stroke is its rim."""


def heavy_strokes(darkness: NDArray[np.uint8], ink: NDArray[np.bool_]) -> NDArray[np.bool_] | None:
    """The heavy strokes of a drawing on which nothing but walls is heavy; None of any other drawing.

    Parameters
    ----------
    darkness : (height, width) uint8, distance of every pixel from the paper
    ink : (height, width) bool

    >>> ink = np.zeros((200, 200), dtype=bool)
    >>> ink[20:180, 20:26] = ink[20:180, 174:180] = ink[20:26, 20:180] = True  # walls
    >>> ink[80, 60:120] = ink[80:120, 60] = True  # a table in hairlines
    >>> walls = heavy_strokes(np.uint8(255) * ink, ink); walls[22, 100], walls[80, 100]
    (np.True_, np.False_)
    """
    tone = np.asarray(cv2.dilate(darkness, np.ones((BESIDE, BESIDE), np.uint8)), dtype=np.uint8)
    drawn = half_covered(tone, ink)
    dark = drawn & (darkness >= HALF * tone)
    core = opened(drawn & (darkness >= CORE * tone), LEAST - 1)
    for side in range(LEAST, MOST + 1):
        heavy = opened(dark, side) & _near(core)
        if not heavy.any():
            return None
        if _are_walls(heavy, dark):
            return _without_crumbs(heavy)
    return None


def without_leaves(heavy: NDArray[np.bool_], symbols: Iterable[NDArray[np.bool_]]) -> NDArray[np.bool_]:
    """Heavy strokes without the leaves of doors: symbols of which a part, the arc, is light.

    >>> heavy, door, wall = np.zeros((3, 40, 60), dtype=bool); heavy[:5] = heavy[5:25, 10:13] = wall[5:25, 10:13] = True
    >>> door |= wall; door[24, 13:40] = True
    >>> without_leaves(heavy, [wall])[20, 11], without_leaves(heavy, [door])[20, 11], without_leaves(heavy, [door])[2, 11]
    (np.True_, np.False_, np.True_)
    """
    near, found = _near(heavy), heavy.copy()
    for symbol in symbols:
        if np.count_nonzero(symbol & ~near) >= ARC * np.count_nonzero(symbol):
            found &= ~symbol
    return _without_crumbs(found)


def is_furnished(heavy: NDArray[np.bool_], ink: NDArray[np.bool_]) -> bool:
    """Is so much drawn in light lines that solid blocks standing alone may be furniture, too?"""
    return bool(np.count_nonzero(ink & ~_near(heavy)) > FURNISHED * np.count_nonzero(ink))


def _near(mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """A mask and its rim."""
    return cv2.dilate(mask.astype(np.uint8), np.ones((BESIDE, BESIDE), np.uint8)).astype(bool)


def _without_crumbs(heavy: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Heavy strokes without small pieces that are shorter than partitions are thick, or thinner: crossings, letters."""
    large = large_components(heavy, RUN * max(heavy.shape))
    if not large.any():
        return heavy
    thinnest, partition = (_thickness_of(large, share) for share in (THINNEST, PARTITION))
    rest = large_components(heavy & ~large, partition)
    n_parts, parts = cv2.connectedComponents(rest.astype(np.uint8), connectivity=8)
    area = np.bincount(parts[rest], minlength=n_parts)
    thick = np.bincount(parts[rest], weights=thinner_run(rest)[rest] >= AS_THICK * thinnest, minlength=n_parts)
    return large | (rest & (thick >= area / 2)[parts])


def _thickness_of(ink: NDArray[np.bool_], share: float) -> float:
    """So thick at most is this share of some ink, by length."""
    thickness = np.sort(thinner_run(ink)[ink])
    length = np.cumsum(1.0 / thickness)
    return float(thickness[np.searchsorted(length, share * length[-1])])


def _are_walls(heavy: NDArray[np.bool_], ink: NDArray[np.bool_]) -> bool:
    """Are heavy strokes straight and in large pieces, with little light ink and hardly any outside them?"""
    long_side = max(ink.shape)
    light, total = ink & ~_near(heavy), np.count_nonzero(ink)
    if light.sum() > LIGHT * total or (light & ~inside_of(heavy)).sum() > OUTSIDE * total:
        return False
    if light.sum() > TRACE * total and _thickness_of(heavy, THINNEST) < CONTRAST * _thickness_of(light, 0.5):
        return False
    length = np.where(heavy, 1.0 / np.maximum(thinner_run(heavy), 1), 0.0)
    longest = np.maximum(run_lengths(heavy, 0), run_lengths(heavy, 1))
    if length[longest >= RUN * long_side].sum() < STRAIGHT * length.sum():
        return False
    n_parts, parts, stats, _ = cv2.connectedComponentsWithStats(heavy.astype(np.uint8), connectivity=8)
    by_part = np.bincount(parts.ravel(), weights=length.ravel(), minlength=n_parts)
    crumb = stats[:, cv2.CC_STAT_WIDTH : cv2.CC_STAT_HEIGHT + 1].max(axis=1) < CRUMB * long_side
    return bool(by_part[crumb].sum() <= CRUMBS * length.sum())
