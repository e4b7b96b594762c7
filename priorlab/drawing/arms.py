"""Arms of thin cells: the straight stretches of a hollow wall's inside, and whether the cell ends there."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.drawing.runs import run_lengths

STRAIGHT, MOSTLY = 0.15, 0.7
"""The faces of an arm wander by this share of its thickness, or by a pixel, in most of its cross-sections."""

FEW = 0.2
"""Beyond a dead end no more of the cross-section than this belongs to the cell."""

BOX, SHORT = 0.85, 4.0
"""A pier fills so much of the box round it; arms are so many times thicker than long at most, and two pixels long at least."""

SAME = 0.12
"""Faces and thicknesses are the same within this share of the thickness, or a pixel."""


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

    def in_line(self, one: int, others: NDArray[np.int64]) -> NDArray[np.bool_]:
        """Do both faces of other arms lie where those of one do?"""
        slack = max(1.0, SAME * self.thickness[one])
        return np.asarray((np.abs(self.across[others] - self.across[one]) <= slack).all(axis=1))


def arms_of(cells: NDArray[np.int32], axis: int) -> Arms:
    """The arms of thin cells along an axis: where they are at least as long as thick, and piers, which are boxes.

    Parameters
    ----------
    cells : (height, width) number of the cell that each pixel belongs to, 0 elsewhere
    axis : 1 for arms along x, 0 along y

    >>> cells = np.zeros((30, 20), dtype=np.int32); cells[2:5, 3:18] = cells[5:29, 3:6] = 1  # an angle: it goes on downwards
    >>> arms = arms_of(cells, 1); arms.along.tolist(), arms.across.tolist(), arms.dead.tolist()
    ([[6.0, 17.0]], [[2.0, 4.0]], [[False, True]])
    """
    if axis == 0:
        turned = arms_of(np.ascontiguousarray(cells.T), 1)
        return Arms(0, turned.cell, turned.along, turned.across, turned.dead)
    part, column, top, bottom = _cross_sections(_parts(cells))
    starts = np.flatnonzero(np.diff(part, prepend=-1))
    cell, along, across, dead = [], [], [], []
    for start, stop in zip(starts, np.append(starts, len(part))[1:], strict=True):
        section = slice(start, stop)
        low, high = float(np.median(top[section])), float(np.median(bottom[section]))
        first, last = int(column[start]), int(column[stop - 1])
        slack = max(1.0, STRAIGHT * (high - low))
        straight = (np.abs(top[section] - low) <= slack) & (np.abs(bottom[section] - high) <= slack)
        ragged = last - first + 1 < max(2.0, (high - low + 1) / SHORT)
        if high - low < 1 or ragged or straight.mean() < MOSTLY:
            continue
        own = cells[int(low) : int(high) + 1] == cells[top[start], first]
        cell.append(cells[top[start], first])
        along.append((first, last))
        across.append((low, high))
        dead.append([not 0 <= x < cells.shape[1] or own[:, x].mean() < FEW for x in (first - 1, last + 1)])
    spans, faces, ends = (np.array(pairs).reshape(-1, 2) for pairs in (along, across, dead))
    return Arms(1, np.array(cell, dtype=np.int64), spans.astype(float), faces.astype(float), ends.astype(bool))


def _parts(cells: NDArray[np.int32]) -> NDArray[np.int32]:
    """Number what may be arms along x: pixels of cells in longer runs along x than along y, and boxes higher than wide."""
    white = cells > 0
    level = white & (run_lengths(white, 0) <= run_lengths(white, 1))
    n_parts, parts = cv2.connectedComponents(level.astype(np.uint8), connectivity=4)
    return np.where(_is_pier(cells)[cells], cells + n_parts, parts).astype(np.int32)


def _cross_sections(parts: NDArray[np.int32]) -> tuple[NDArray[np.integer], ...]:
    """Part, column, first and last row of every part in each of its columns, part by part from left to right."""
    cols, rows = np.nonzero(parts.T)
    which = parts[rows, cols]
    key = which.astype(np.int64) * parts.shape[1] + cols
    order = np.argsort(key, kind="stable")
    first = np.flatnonzero(np.diff(key[order], prepend=-1))
    last = np.append(first[1:], len(order)) - 1 if first.size else first
    return which[order[first]], cols[order[first]], rows[order[first]], rows[order[last]]


def _is_pier(cells: NDArray[np.int32]) -> NDArray[np.bool_]:
    """For every number of a cell: is it a box higher than wide, such as a pier between two windows?"""
    n_cells = int(cells.max(initial=0)) + 1
    rows, cols = np.nonzero(cells)
    labels = cells[rows, cols]
    low, high = np.full((2, n_cells), max(cells.shape)), np.full((2, n_cells), -1)
    for k, where in enumerate((cols, rows)):
        np.minimum.at(low[k], labels, where)
        np.maximum.at(high[k], labels, where)
    width, height = high - low + 1
    pier = (width < height) & (height <= SHORT * width) & (np.bincount(labels, minlength=n_cells) >= BOX * width * height)
    pier[0] = False
    return pier
