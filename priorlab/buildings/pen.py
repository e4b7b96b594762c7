"""A pen that draws in the own frame of a piece of furniture: metres from its middle, +y towards its back."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from priorlab.buildings.layout import Placed
from priorlab.buildings.paper import Paper, ellipse


class Pen:
    """Lines, boxes and ellipses at a placed piece, in one weight and colour."""

    def __init__(self, paper: Paper, placed: Placed, weight: float = 1.2, ink: str = "#000000") -> None:
        self._paper, self._placed, self._weight, self._ink = paper, placed, weight, ink
        self.width, self.depth = placed.width, placed.depth

    def line(self, *points: tuple[float, float]) -> None:
        """A line through points."""
        self._paper.line(self._placed.at(np.array(points)), self._weight, self._ink)

    def box(self, left: float, bottom: float, right: float, top: float, round_by: float = 0.0, fill: bool = True) -> None:
        """A rectangle, its corners rounded."""
        self._shape(_rounded(left, bottom, right, top, round_by), fill)

    def outline(self, round_by: float = 0.0) -> None:
        """The piece's own rectangle."""
        self.box(-self.width / 2, -self.depth / 2, self.width / 2, self.depth / 2, round_by)

    def patch(self, *points: tuple[float, float], fill: bool = True) -> None:
        """A closed outline through points."""
        self._shape(np.array(points), fill)

    def oval(self, x: float, y: float, a: float, b: float | None = None, fill: bool = True) -> None:
        """An ellipse with half axes a, b."""
        self._shape(ellipse((x, y), a, a if b is None else b), fill)

    def bow(self, x: float, y: float, a: float, b: float, start: float, end: float) -> None:
        """A piece of an ellipse between two directions, degrees."""
        self._paper.line(self._placed.at(ellipse((x, y), a, b, start, end)), self._weight, self._ink)

    def _shape(self, points: ArrayLike, fill: bool) -> None:
        """A closed outline at the piece."""
        self._paper.shape(self._placed.at(np.asarray(points)), self._weight, self._ink, "#ffffff" if fill else None)


def _rounded(left: float, bottom: float, right: float, top: float, radius: float) -> np.ndarray:
    """(N, 2) outline of a rectangle with round corners."""
    if radius <= 0:
        return np.array([[left, bottom], [right, bottom], [right, top], [left, top]])
    r = min(radius, (right - left) / 2, (top - bottom) / 2)
    corners = [(right - r, top - r, 0), (left + r, top - r, 90), (left + r, bottom + r, 180), (right - r, bottom + r, 270)]
    return np.concatenate([ellipse((x, y), r, r, start, start + 90) for x, y, start in corners])
