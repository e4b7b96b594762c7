"""Flights of stairs: four hands, each in the flight's own frame (up is +y)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from priorlab.buildings.pen import Pen


def draw_plain(pen: Pen, treads: int) -> None:
    """Treads and the arrow that leads up."""
    w, d = pen.width, pen.depth
    pen.outline()
    _treads(pen, -w / 2, w / 2, -d / 2, d / 2, treads)
    tip, size = d / 2 - 0.12, min(0.16, w / 5)
    pen.line((0, -d / 2 + 0.1), (0, tip))
    pen.line((-size, tip - 1.4 * size), (0, tip), (size, tip - 1.4 * size))
    pen.oval(0, -d / 2 + 0.1, 0.05)


def draw_cut(pen: Pen, treads: int) -> None:
    """Treads, cut by a slanting double line where the storey ends."""
    w, d = pen.width, pen.depth
    pen.outline()
    _treads(pen, -w / 2, w / 2, -d / 2, d / 2, treads)
    for shift in (0.0, 0.12):
        pen.line((-w / 2, shift - 0.25 * w), (-0.1, shift - 0.05), (0.1, shift + 0.05), (w / 2, shift + 0.25 * w))
    pen.line((0, -d / 2 + 0.1), (0, -0.2))


def draw_winder(pen: Pen, treads: int) -> None:
    """Straight treads below, above them a fan round the left corner."""
    w, d = pen.width, pen.depth
    pen.outline()
    landing = d / 2 - w
    n_fan = 4
    _treads(pen, -w / 2, w / 2, -d / 2, landing, max(2, treads - n_fan))
    for angle in np.linspace(0, 90, n_fan + 1)[:-1]:
        x, y = np.cos(np.radians(angle)), np.sin(np.radians(angle))
        reach = w / max(x, y)
        pen.line((-w / 2, landing), (-w / 2 + reach * x, landing + reach * y))
    pen.bow(-w / 2, landing, w / 2, w / 2, 0, 80)
    pen.line((0, -d / 2 + 0.1), (0, landing))


def draw_dogleg(pen: Pen, treads: int) -> None:
    """Two flights side by side, a landing at the top, the line of walking round it."""
    w, d = pen.width, pen.depth
    pen.outline()
    landing, well = d / 2 - min(0.45 * w, 0.35 * d), 0.06
    for left, right in ((-w / 2, -well), (well, w / 2)):
        _treads(pen, left, right, -d / 2, landing, max(2, treads // 2))
        pen.line((left, landing), (right, landing))
    pen.box(-well, -d / 2, well, landing)
    middle = (landing + d / 2) / 2
    pen.line((w / 4, -d / 2 + 0.1), (w / 4, middle), (-w / 4, middle), (-w / 4, -d / 2 + 0.2))
    pen.line((-w / 4 - 0.08, -d / 2 + 0.36), (-w / 4, -d / 2 + 0.2), (-w / 4 + 0.08, -d / 2 + 0.36))


def _treads(pen: Pen, left: float, right: float, low: float, high: float, number: int) -> None:
    """The lines between treads."""
    for y in np.linspace(low, high, number + 1)[1:-1]:
        pen.line((left, float(y)), (right, float(y)))


STAIRS: dict[str, Callable[[Pen, int], None]] = {
    "plain": draw_plain,
    "cut": draw_cut,
    "winder": draw_winder,
    "dogleg": draw_dogleg,
}
"""Who draws stairs in which hand."""
