"""Bodies of hollow walls: white cells that end where doors begin, and those that go on in line with them.

A hollow wall is drawn by its outline, so its inside is one white cell from opening to opening, junctions and all. No single cell
shows that it is wall: shelves, closets and shafts are as long and as narrow. But a wall's body ends at an opening, with a cap
across it at the jamb, and beyond the opening or window a body with the same two faces goes on. So bodies are told by their ends:
first those at the jambs of doors, then all that face an end of theirs in line. A piece of furniture does neither.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.core.drawing import Door
from priorlab.drawing.arms import SAME, Arms, arms_of
from priorlab.drawing.faces import thin_cells
from priorlab.drawing.strokes import thinner_run
from priorlab.drawing.wall_sizes import WallSizes
from priorlab.drawing.weight import Hypothesis, judged, with_openings

BODIES = "bodies of hollow walls"
"""Name of the hypothesis."""

AT_JAMB = 0.15
"""A body ends at a jamb within so many door widths of it, along the opening and across it."""

SLANT = 0.2
"""Openings run along an axis when they leave it by no more than this."""

WIDEST_DOORS = 2.2
"""Longest opening between two bodies in line, in door widths."""

WIDEST_WINDOW = 0.3
"""Longest window between them, share of M."""

AT_FACE, GLAZED = 0.3, 0.8
"""A window's lines run within this share of the thickness from either face, for so much of its length."""

EVEN = 0.6
"""So much of a body lies in straight arms of the thicknesses that walls have."""

SLENDER = 2.0
"""The thickness of an arm is that of a wall when it is so many times longer."""

KNOWN = 0.5
"""A cell is known for a wall when so much of it is."""

TOO_FEW = 3
"""So few ends at jambs leave it open which thicknesses are common."""


def hollow_walls(
    ink: NDArray[np.bool_], doors: Sequence[Door], sizes: WallSizes, known: NDArray[np.bool_] | None = None
) -> Hypothesis:
    """The bodies of hollow walls with the lines round them; judged with their openings walled up, as solid ones are.

    Parameters
    ----------
    ink : (height, width) bool, the lines of the drawing, doors' too: they close the insides of walls at the jambs
    doors : in the same pixels
    sizes : of walls on this sheet
    known : (height, width) bool, cells that are walls in any case
    """
    cells = thin_cells(ink, sizes)
    walls = wall_bodies(cells, ink, doors, sizes, known)[cells]
    rim = ink & _widened(walls)
    weight = round(float(np.median(thinner_run(ink)[rim]))) if rim.any() else 0
    for _ in range(weight + 1):  # step by step, or lines of furniture beside it were taken as well
        walls = walls | (ink & _widened(walls))
    return replace(judged(BODIES, with_openings(walls, sizes), sizes), walls=walls)


def wall_bodies(
    cells: NDArray[np.int32],
    ink: NDArray[np.bool_],
    doors: Sequence[Door],
    sizes: WallSizes,
    known: NDArray[np.bool_] | None = None,
) -> NDArray[np.bool_]:
    """For every number of a thin cell: is it the body of a hollow wall?

    Parameters
    ----------
    cells : (height, width) as `thin_cells` numbers them
    ink, doors, sizes, known : as for `hollow_walls`
    """
    n_cells = int(cells.max(initial=0)) + 1
    arms = [arms_of(cells, axis) for axis in (0, 1)]
    capped = [own.only(some) for own, some in zip(arms, ends_at_jambs(arms, doors), strict=True)]
    thick = _common(np.concatenate([own.thickness for own in capped]))
    caps = sum((np.bincount(own.cell[_like(own, thick)], minlength=n_cells) for own in capped), np.zeros(n_cells, dtype=int))
    area = np.bincount(cells.ravel(), minlength=n_cells)
    body = (caps >= 2) | ((caps == 1) & (_share_of(arms, area) >= EVEN))  # two ends outweigh a wing at an angle
    if known is not None:
        body |= (area > 0) & (np.bincount(cells[known], minlength=n_cells) >= KNOWN * area)
        body[0] = False
    slender = [own.thickness[body[own.cell] & (own.length >= SLENDER * own.thickness)] for own in arms]
    fitting = _share_of(arms, area, np.concatenate([thick, *slender])) >= EVEN
    widest = WIDEST_DOORS * float(np.median([door.width for door in doors])) if doors else 0.0
    new = body
    while new.any():
        reached = np.zeros_like(body)
        for own in arms:
            lines = ink if own.axis == 1 else ink.T
            reached[_reached(own, new, fitting & ~body, lines, widest, WIDEST_WINDOW * sizes.long_side)] = True
        new = reached & ~body
        body = body | new
    return body


def ends_at_jambs(arms: Sequence[Arms], doors: Sequence[Door]) -> list[NDArray[np.int64]]:
    """Which arms end at the jambs of doors: two on either side that lie in line, else the nearest end at each jamb."""
    found: list[set[int]] = [set() for _ in arms]
    for door in doors:
        way = np.abs(np.subtract(door.strike, door.hinge))
        for some, own in zip(found, arms, strict=True):
            if not len(own.cell) or way[own.axis] > SLANT * way[1 - own.axis]:
                continue
            jambs = ((door.hinge, door.strike), (door.strike, door.hinge))
            ends = [_distance(own, jamb, other, AT_JAMB * door.width + 1) for jamb, other in jambs]
            one, two = (np.flatnonzero(np.isfinite(end)) for end in ends)
            pairs = [(float(ends[0][i] + ends[1][k]), i, int(k)) for i in one.tolist() for k in two[own.in_line(i, two)]]
            nearest = [int(np.argmin(end)) for end in ends if np.isfinite(end).any()]
            some.update(min(pairs)[1:] if pairs else nearest)
    return [np.array(sorted(some), dtype=np.int64) for some in found]


def _distance(arms: Arms, jamb: tuple[float, float], other: tuple[float, float], reach: float) -> NDArray[np.float64]:
    """(K,) how far from a jamb each arm ends that leaves it, away from the other jamb; inf beyond reach."""
    x, y = 1 - arms.axis, arms.axis
    near = 0 if jamb[x] > other[x] else 1
    off = np.abs(arms.along[:, near] - jamb[x])
    aside = np.maximum(arms.across[:, 0] - jamb[y], jamb[y] - arms.across[:, 1]).clip(min=0)
    return np.where(arms.dead[:, near] & (off <= reach) & (aside <= reach), off + aside, np.inf)


def _reached(
    arms: Arms,
    new: NDArray[np.bool_],
    free: NDArray[np.bool_],
    lines: NDArray[np.bool_],
    widest: float,
    longest: float,
) -> NDArray[np.int64]:
    """Cells among the free ones that face an end of a new one in line, across an opening or along a window's lines."""
    found = []
    for k in np.flatnonzero(new[arms.cell]).tolist():
        for side in np.flatnonzero(arms.dead[k]).tolist():
            gap = (arms.along[:, 1 - side] - arms.along[k, side]) * (1 if side else -1)
            some = np.flatnonzero(arms.dead[:, 1 - side] & free[arms.cell] & (gap > 0) & (gap <= max(longest, widest)))
            for other in some[arms.in_line(k, some)].tolist():
                if gap[other] <= widest or (gap[other] <= longest and _glazed(lines, arms, k, other)):
                    found.append(arms.cell[other])
    return np.array(found, dtype=np.int64)


def _glazed(lines: NDArray[np.bool_], arms: Arms, one: int, other: int) -> bool:
    """Do lines of a window run from one arm to another, near either face?"""
    left, right = sorted((one, other), key=lambda k: arms.along[k, 0])
    between = np.s_[int(arms.along[left, 1]) + 1 : int(arms.along[right, 0])]
    low, high = arms.across[one].astype(int)
    near = round(AT_FACE * (high - low + 1))
    faces = (np.s_[max(low - near - 1, 0) : low + near + 1], np.s_[max(high - near, 0) : high + near + 2])
    return all(lines[face, between].any(axis=0).mean() >= GLAZED for face in faces)


def _common(thickness: NDArray[np.float64]) -> NDArray[np.float64]:
    """Thicknesses that occur twice or more; all of them when there are few."""
    if len(thickness) <= TOO_FEW:
        return thickness
    same = np.abs(thickness[:, None] - thickness) <= np.maximum(1.0, SAME * thickness)
    return thickness[same.sum(axis=1) >= 2]


def _like(arms: Arms, known: NDArray[np.float64]) -> NDArray[np.bool_]:
    """(K,) where an arm is as thick as one of the known thicknesses."""
    slack = np.maximum(1.0, SAME * known)
    return np.asarray((np.abs(arms.thickness[:, None] - known) <= slack).any(axis=1))


def _share_of(arms: Sequence[Arms], area: NDArray[np.int64], known: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
    """For every number of a cell: share of its area in straight arms, or in those of known thicknesses."""
    covered = np.zeros(len(area))
    for own in arms:
        some = own if known is None else own.only(_like(own, np.unique(known)))
        covered += np.bincount(some.cell, weights=some.length * some.thickness, minlength=len(area))
    return covered / np.maximum(area, 1)


def _widened(mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The mask and the pixels round it."""
    return np.asarray(cv2.dilate(mask.astype(np.uint8), np.ones((3, 3), np.uint8)), dtype=bool)
