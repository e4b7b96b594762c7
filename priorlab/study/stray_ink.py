"""Furniture that no family of symbols has, strewn over a drawing: rings, hatched boxes, railings, treads, grids, dark blocks."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.core.building import Truth
from priorlab.core.drawing import Drawing

FINE = 4
"""Stray ink is drawn so many times larger, for soft edges."""

Paper = NDArray[np.uint8]
Size = tuple[float, float]


def with_stray_ink(drawing: Drawing, truth: Truth, line: float, rng: np.random.Generator, most: int = 14) -> Drawing:
    """A drawing with up to `most` pieces more, beside whatever stands there, on white paper away from walls and doors.

    Parameters
    ----------
    drawing, truth : not yet degraded; the truth stays as it is
    line : weight of thin lines, pixels
    """
    height, width = drawing.shape
    grey = drawing.grey
    taken = truth.walls | truth.ignore | (cv2.GaussianBlur(grey, (5, 5), 0) < 200)
    for door in truth.doors:
        reach = 1.1 * door.width
        (x, y), _ = door.points.mean(axis=0), None
        taken[max(0, int(y - reach)) : int(y + reach), max(0, int(x - reach)) : int(x + reach)] = True
    unit = float(np.median([door.width for door in truth.doors])) if truth.doors else max(width, height) / 15
    darkness = np.zeros((height, width))
    for _ in range(int(rng.integers(3, most + 1))):
        draw, (low, high), slim = PIECES[rng.integers(len(PIECES))]
        along = rng.uniform(low, high) * unit
        across = along * rng.uniform(*slim)
        w, h = (along, across) if rng.random() < 0.5 else (across, along)
        gap = int(rng.integers(2, 7))
        place = _free_place(taken, int(w) + 2 * gap, int(h) + 2 * gap, rng)
        if place is None or min(w, h) < 4 * line:
            continue
        x, y = place[0] + gap, place[1] + gap
        fine = np.zeros((int(h + 1) * FINE, int(w + 1) * FINE), np.uint8)
        draw(fine, line * FINE, rng)
        piece = cv2.resize(fine, (int(w + 1), int(h + 1)), interpolation=cv2.INTER_AREA) / 255
        window = np.s_[y : y + piece.shape[0], x : x + piece.shape[1]]
        darkness[window] = np.maximum(darkness[window], piece[: height - y, : width - x])
        taken[window] = True
    paper = 1 - darkness
    grey = np.round(grey * paper).astype(np.uint8)
    colour = None if drawing.colour is None else np.round(drawing.colour * paper[..., None]).astype(np.uint8)
    return replace(drawing, grey=grey, colour=colour)


def _free_place(taken: NDArray[np.bool_], width: int, height: int, rng: np.random.Generator) -> tuple[int, int] | None:
    """Upper left corner of a free rectangle, or None."""
    if height >= taken.shape[0] or width >= taken.shape[1]:
        return None
    total = np.pad(np.cumsum(np.cumsum(taken, axis=0, dtype=np.int64), axis=1), ((1, 0), (1, 0)))
    inside = total[height:, width:] - total[:-height, width:] - total[height:, :-width] + total[:-height, :-width]
    free = np.argwhere(inside == 0)
    if not len(free):
        return None
    y, x = free[rng.integers(len(free))]
    return int(x), int(y)


def _box(paper: Paper, pen: float, inset: float = 0.0) -> None:
    """A rectangle's outline, so far inside the piece."""
    at, thick = round(inset), max(1, round(pen))
    h, w = paper.shape
    if w - 2 * at > 2 * thick and h - 2 * at > 2 * thick:
        cv2.rectangle(paper, (at, at), (w - at - 1, h - at - 1), 255, -1)
        cv2.rectangle(paper, (at + thick, at + thick), (w - at - thick - 1, h - at - thick - 1), 0, -1)


def draw_ring(paper: Paper, pen: float, rng: np.random.Generator) -> None:
    """A table or a bed: one rectangle in another."""
    _box(paper, pen)
    _box(paper, pen, rng.uniform(0.06, 0.3) * min(paper.shape))


def draw_hatched(paper: Paper, pen: float, rng: np.random.Generator) -> None:
    """A cupboard, hatched."""
    step, slope = rng.uniform(5, 12) * FINE, int(rng.choice([-1, 1]))
    h, w = paper.shape
    for start in np.arange(-h, w + h, step):
        x = int(start)
        cv2.line(paper, (x, 0 if slope > 0 else h), (x + h, h if slope > 0 else 0), 255, max(1, round(0.7 * pen)), cv2.LINE_AA)
    inside = paper.copy()
    _box(paper, pen)
    paper[:] = np.maximum(paper, inside)


def draw_railing(paper: Paper, pen: float, rng: np.random.Generator) -> None:
    """Two parallel lines, their ends open or closed."""
    _box(paper, pen)
    if rng.random() < 0.5:
        edge = max(1, round(pen))
        if paper.shape[1] > paper.shape[0]:
            paper[edge:-edge, :edge] = paper[edge:-edge, -edge:] = 0
        else:
            paper[:edge, edge:-edge] = paper[-edge:, edge:-edge] = 0


def draw_treads(paper: Paper, pen: float, rng: np.random.Generator) -> None:
    """Steps: lines across."""
    _box(paper, pen)
    h, w = paper.shape
    step, thick = rng.uniform(7, 14) * FINE, max(1, round(pen))
    for at in np.arange(step, max(h, w), step).astype(int):
        if w > h:
            paper[:, at : at + thick] = 255
        else:
            paper[at : at + thick] = 255


def draw_grid(paper: Paper, pen: float, rng: np.random.Generator) -> None:
    """A table of a title block: a frame, rows, a column."""
    _box(paper, pen * float(rng.choice([1.0, 1.6])))
    h, w = paper.shape
    thick = max(1, round(pen))
    for row in range(1, int(rng.integers(2, 5))):
        at = row * h // 5
        paper[at : at + thick] = 255
    at = int(rng.uniform(0.2, 0.6) * w)
    paper[:, at : at + thick] = 255


def draw_block(paper: Paper, pen: float, rng: np.random.Generator) -> None:
    """A stove: filled, grey or black."""
    paper[:] = int(rng.choice([110, 160, 255]))


def draw_cross(paper: Paper, pen: float, rng: np.random.Generator) -> None:
    """A shaft or a wardrobe: a rectangle with both diagonals."""
    _box(paper, pen)
    h, w = paper.shape
    for y0, y1 in ((0, h - 1), (h - 1, 0)):
        cv2.line(paper, (0, y0), (w - 1, y1), 255, max(1, round(pen)), cv2.LINE_AA)


PIECES: tuple[tuple[Callable[[Paper, float, np.random.Generator], None], Size, Size], ...] = (
    (draw_ring, (0.6, 2.2), (0.35, 1.0)),
    (draw_hatched, (0.7, 2.0), (0.2, 0.6)),
    (draw_railing, (1.2, 4.0), (0.08, 0.2)),
    (draw_treads, (1.2, 3.0), (0.3, 0.6)),
    (draw_grid, (1.5, 3.5), (0.3, 0.6)),
    (draw_block, (0.3, 0.7), (0.5, 1.0)),
    (draw_cross, (0.5, 1.6), (0.4, 1.0)),
)
"""Who draws what, its length in door widths, and its depth as a share of that."""
