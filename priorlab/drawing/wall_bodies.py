"""Bodies of hollow walls: white cells that end where doors begin, and those that go on in line with them.

A hollow wall is drawn by its outline, so its inside is one white cell from opening to opening, junctions and all. No single cell
shows that it is wall: shelves, closets and shafts are as long and as narrow. But a wall's body ends at an opening, with a cap
across it at the jamb, and beyond the opening (or window) a body of the same two faces goes on. So bodies are told from ends to
ends: first those at the jambs of doors, then all that face an end of theirs in line. A piece of furniture does neither.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.core.drawing import Door
from priorlab.drawing.faces import thin_cells
from priorlab.drawing.runs import run_lengths
from priorlab.drawing.strokes import thinner_run
from priorlab.drawing.wall_sizes import WallSizes

AT_JAMB = 0.15
"""A body ends at a jamb within so many door widths of it, along the opening and across it."""

STRAIGHT = 0.15
"""The faces of an arm wander by no more than this share of its thickness, or a pixel."""

IN_LINE = 0.12
"""Two ends face each other when both their faces agree to this share of their thickness, or a pixel."""

WIDEST_DOORS = 2.2
"""Longest opening between two bodies in line, in door widths."""

WIDEST_WINDOW = 0.3
"""Longest window between them, share of M."""

AT_FACE, GLAZED = 0.3, 0.8
"""A window's lines run within this share of the thickness from either face, for so much of its length."""

EVEN = 0.6
"""So much of a body lies in straight arms of the thicknesses that walls have."""

TOO_FEW = 3
"""So few ends at jambs leave it open which thicknesses are common."""

MOSTLY, FEW = 0.7, 0.2
"""Most cross-sections of an arm lie within its faces; few pixels beyond a dead end belong to its cell."""

BOX, PIER = 0.85, 5.0
"""A pier fills so much of the box round it, and is so many times thicker than long at most."""

SLANT = 0.2
"""Openings run along an axis when they leave it by no more than this."""


@dataclass(frozen=True, eq=False)
class Arms:
    """Straight stretches of thin cells along one axis; K of them.

    Parameters
    ----------
    axis : 1 when they run along x, 0 along y
    cell : (K,) number of the cell that each belongs to
    along : (K, 2) first and last pixel along the axis
    across : (K, 2) first and last pixel of white across it
    dead : (K, 2) bool, does the cell end there, before and after?
    """

    axis: int
    cell: NDArray[np.int64]
    along: NDArray[np.float64]
    across: NDArray[np.float64]
    dead: NDArray[np.bool_]

    @property
    def thickness(self) -> NDArray[np.float64]:
        """(K,) pixels of white across."""
        return self.across[:, 1] - self.across[:, 0] + 1

    @property
    def length(self) -> NDArray[np.float64]:
        """(K,) pixels along the axis."""
        return self.along[:, 1] - self.along[:, 0] + 1

    def only(self, keep: NDArray[np.int64] | NDArray[np.bool_]) -> Arms:
        """Some of them."""
        return Arms(self.axis, self.cell[keep], self.along[keep], self.across[keep], self.dead[keep])


def arms_of(cells: NDArray[np.int32], axis: int) -> Arms:
    """The arms of thin cells along an axis: where they are at least as long as thick, and cells that are a box altogether.

    >>> cells = np.zeros((9, 20), dtype=np.int32); cells[2:5, 3:18] = 1; cells[5:9, 3:6] = 1
    >>> arms = arms_of(cells, 1); arms.along.tolist(), arms.across.tolist(), arms.dead.tolist()
    ([[6.0, 17.0]], [[2.0, 4.0]], [[False, True]])
    """
    if axis == 0:
        turned = arms_of(np.ascontiguousarray(cells.T), 1)
        return Arms(0, turned.cell, turned.along, turned.across, turned.dead)
    white = cells > 0
    level = white & (run_lengths(white, 0) <= run_lengths(white, 1))
    _, parts = cv2.connectedComponents(level.astype(np.uint8), connectivity=4)
    boxes = _stubby(cells)
    parts = np.where(boxes[cells], cells + int(parts.max()), parts)
    cols, rows = np.nonzero(parts.T)
    if not cols.size:
        return Arms(1, np.zeros(0, np.int64), *(np.zeros((0, 2)) for _ in range(2)), np.zeros((0, 2), dtype=bool))
    which = parts[rows, cols]
    key = which.astype(np.int64) * cells.shape[1] + cols
    order = np.argsort(key, kind="stable")
    first = np.flatnonzero(np.diff(key[order], prepend=-1))
    last = np.append(first[1:], len(order)) - 1
    column, top, bottom = cols[order[first]], rows[order[first]], rows[order[last]]
    part = which[order[first]]
    starts = np.flatnonzero(np.diff(part, prepend=-1))
    found = []
    for start, stop in zip(starts, np.append(starts[1:], len(part)), strict=True):
        low, high = np.median(top[start:stop]), np.median(bottom[start:stop])
        slack = max(1.0, STRAIGHT * (high - low))
        straight = (np.abs(top[start:stop] - low) <= slack) & (np.abs(bottom[start:stop] - high) <= slack)
        if high - low < 1 or straight.mean() < MOSTLY:
            continue
        x0, x1 = int(column[start]), int(column[stop - 1])
        cell = int(cells[top[start], x0])
        band = cells[int(low) : int(high) + 1]
        dead = [x < 0 or x >= cells.shape[1] or (band[:, x] == cell).mean() < FEW for x in (x0 - 1, x1 + 1)]
        found.append((cell, (x0, x1), (low, high), dead))
    cell, along, across, dead = ([arm[i] for arm in found] for i in range(4))
    return Arms(
        1,
        np.array(cell, dtype=np.int64),
        np.array(along, dtype=np.float64).reshape(-1, 2),
        np.array(across, dtype=np.float64).reshape(-1, 2),
        np.array(dead, dtype=bool).reshape(-1, 2),
    )


def _stubby(cells: NDArray[np.int32]) -> NDArray[np.bool_]:
    """For every number of a cell: is it a box higher than wide? Then it is an arm along x, too, such as a pier."""
    n = int(cells.max()) + 1
    rows, cols = np.nonzero(cells)
    labels = cells[rows, cols]
    low, high = np.full((2, n), max(cells.shape)), np.full((2, n), -1)
    for k, where in enumerate((cols, rows)):
        np.minimum.at(low[k], labels, where)
        np.maximum.at(high[k], labels, where)
    width, height = high - low + 1
    box = (width < height) & (height <= PIER * width) & (np.bincount(labels, minlength=n) >= BOX * width * height)
    box[0] = False
    return box


def at_jambs(arms: Sequence[Arms], doors: Sequence[Door]) -> list[NDArray[np.int64]]:
    """Which arms end at the jambs of doors: an arm on either side that go on in line, else the nearest end at each jamb."""
    found: list[list[int]] = [[] for _ in arms]
    for door in doors:
        way = np.abs(np.subtract(door.strike, door.hinge))
        for which, own in enumerate(arms):
            x, y = (0, 1) if own.axis == 1 else (1, 0)
            if way[y] > SLANT * way[x] or not len(own.cell):
                continue
            near = AT_JAMB * door.width + 1
            ends = []
            for jamb, other in ((door.hinge, door.strike), (door.strike, door.hinge)):
                before = 0 if jamb[x] > other[x] else 1  # the wall lies beyond: its near end is the first, or the last
                off = np.abs(own.along[:, before] - jamb[x])
                aside = np.maximum(own.across[:, 0] - jamb[y], jamb[y] - own.across[:, 1])
                ends.append(np.where(own.dead[:, before] & (off <= near) & (aside <= near), off + np.maximum(aside, 0), np.inf))
            one, two = (np.flatnonzero(np.isfinite(end)) for end in ends)
            pairs = [(ends[0][i] + ends[1][j], i, j) for i in one for j in two if in_line(own, i, np.array([j]))[0]]
            if pairs:
                found[which] += min(pairs)[1:]
            else:
                found[which] += [int(np.argmin(end)) for end in ends if np.isfinite(end).any()]
    return [np.unique(np.array(some, dtype=np.int64)) for some in found]


def in_line(arms: Arms, one: int, others: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Do the faces of other arms lie where those of one do?"""
    slack = max(1.0, IN_LINE * arms.thickness[one])
    return (np.abs(arms.across[others] - arms.across[one]) <= slack).all(axis=1)


def wall_bodies(
    cells: NDArray[np.int32], ink: NDArray[np.bool_], doors: Sequence[Door], sizes: WallSizes
) -> NDArray[np.bool_]:
    """For every number of a cell: is it the body of a hollow wall?"""
    arms = [arms_of(cells, axis) for axis in (0, 1)]
    area = np.bincount(cells.ravel())
    capped = [own.only(some) for own, some in zip(arms, at_jambs(arms, doors), strict=True)]
    thick = common(np.concatenate([own.thickness for own in capped]))
    body = np.zeros(len(area), dtype=bool)
    for own in capped:
        body[own.cell[like(own.thickness, thick)]] = True
    body &= even_share(arms, area, None) >= EVEN
    of_bodies = [own.only(body[own.cell] & (own.length >= 2 * own.thickness)) for own in arms]
    thick = np.concatenate([thick, *(own.thickness for own in of_bodies)])
    fitting = even_share(arms, area, thick) >= EVEN
    widest = WIDEST_DOORS * float(np.median([door.width for door in doors])) if doors else 0.0
    new = body.copy()
    while new.any():
        reached = np.zeros_like(body)
        for own in arms:
            drawn = ink if own.axis == 1 else ink.T
            for k in np.flatnonzero(new[own.cell]):
                for side in np.flatnonzero(own.dead[k]):
                    facing = own.dead[:, 1 - side] & ~body[own.cell] & fitting[own.cell]
                    gap = (own.along[:, 1 - side] - own.along[k, side]) * (1 if side else -1)
                    some = np.flatnonzero(facing & (gap > 0) & (gap <= WIDEST_WINDOW * sizes.long_side))
                    for other in some[in_line(own, k, some)]:
                        if gap[other] <= widest or _glazed(drawn, own, k, other):
                            reached[own.cell[other]] = True
        new = reached & ~body
        body |= new
    return body


def common(thickness: NDArray[np.float64]) -> NDArray[np.float64]:
    """Thicknesses that occur twice or more; all of them when there are few."""
    if len(thickness) <= TOO_FEW:
        return thickness
    apart = np.abs(thickness[:, None] - thickness)
    return thickness[(apart <= np.maximum(1.0, IN_LINE * thickness)).sum(axis=1) >= 2]


def like(thickness: NDArray[np.float64], known: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Which thicknesses are among the known ones?"""
    if not len(known):
        return np.zeros(len(thickness), dtype=bool)
    known = np.unique(known)
    return (np.abs(thickness[:, None] - known) <= np.maximum(1.0, IN_LINE * known)).any(axis=1)


def even_share(arms: Sequence[Arms], area: NDArray[np.int64], known: NDArray[np.float64] | None) -> NDArray[np.float64]:
    """For every number of a cell: share of its area in straight arms, or in those of known thicknesses."""
    covered = np.zeros(len(area))
    for own in arms:
        take = np.ones(len(own.cell), dtype=bool) if known is None else like(own.thickness, known)
        covered += np.bincount(own.cell[take], weights=(own.length * own.thickness)[take], minlength=len(area))
    return covered / np.maximum(area, 1)


def _glazed(ink: NDArray[np.bool_], arms: Arms, one: int, other: int) -> bool:
    """Do lines of a window run from one arm to another, near either face?"""
    first, last = sorted((one, other), key=lambda k: arms.along[k, 0])
    x0, x1 = int(arms.along[first, 1]) + 1, int(arms.along[last, 0])
    low, high = arms.across[one].astype(int)
    near = round(AT_FACE * (high - low + 1))
    rows = [slice(max(low - near - 1, 0), low + near + 1), slice(max(high - near, 0), high + near + 2)]
    return all(ink[row, x0:x1].any(axis=0).mean() >= GLAZED for row in rows)


def hollow_walls(ink: NDArray[np.bool_], doors: Sequence[Door], sizes: WallSizes) -> NDArray[np.bool_]:
    """Bodies of hollow walls and the lines round them."""
    cells = thin_cells(ink, sizes)
    inside = wall_bodies(cells, ink, doors, sizes)[cells]
    rim = ink & cv2.dilate(inside.astype(np.uint8), np.ones((3, 3), np.uint8)).astype(bool)
    if not rim.any():
        return inside
    reach = 2 * (round(float(np.median(thinner_run(ink)[rim]))) + 1) + 1
    return inside | (ink & cv2.dilate(inside.astype(np.uint8), np.ones((reach, reach), np.uint8)).astype(bool))
