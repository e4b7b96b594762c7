"""Kitchen and bathroom as an architect draws them: one function per kind, each in the piece's own frame (back at +y)."""

from __future__ import annotations

import numpy as np

from priorlab.buildings.pen import Pen


def draw_bath(pen: Pen) -> None:
    """A tub with a round foot and its drain; the taps are at the right."""
    w, d = pen.width, pen.depth
    pen.outline()
    pen.box(-w / 2 + 0.07, -d / 2 + 0.07, w / 2 - 0.07, d / 2 - 0.07, round_by=0.24)
    pen.oval(w / 2 - 0.28, 0, 0.04)
    pen.line((w / 2 - 0.07, -0.06), (w / 2 - 0.07, 0.06))


def draw_shower(pen: Pen) -> None:
    """A tray, crossed to its drain."""
    w, d = pen.width, pen.depth
    pen.outline()
    pen.line((-w / 2, -d / 2), (w / 2, d / 2))
    pen.line((-w / 2, d / 2), (w / 2, -d / 2))
    pen.oval(0, 0, 0.06)


def draw_wc(pen: Pen) -> None:
    """A cistern at the back and the bowl before it."""
    w, d = pen.width, pen.depth
    cistern = 0.18
    pen.oval(0, -cistern / 2, w / 2 - 0.02, (d - cistern) / 2)
    pen.oval(0, -cistern / 2 - 0.02, w / 2 - 0.08, (d - cistern) / 2 - 0.07)
    pen.box(-w / 2, d / 2 - cistern, w / 2, d / 2, round_by=0.04)


def draw_basin(pen: Pen) -> None:
    """A bowl with a tap."""
    w, d = pen.width, pen.depth
    pen.outline(round_by=0.06)
    pen.oval(0, -0.04, w / 2 - 0.08, d / 2 - 0.09)
    pen.oval(0, -0.04, 0.025)
    pen.line((0, d / 2 - 0.02), (0, d / 2 - 0.14))


def draw_counter(pen: Pen) -> None:
    """A worktop."""
    pen.outline()


def draw_hob(pen: Pen) -> None:
    """Four rings."""
    w, d = pen.width, pen.depth
    pen.box(-w / 2 + 0.04, -d / 2 + 0.05, w / 2 - 0.04, d / 2 - 0.05)
    for x, y, radius in ((-1, -1, 0.09), (1, -1, 0.07), (-1, 1, 0.07), (1, 1, 0.09)):
        pen.oval(x * 0.13, y * 0.12, radius)


def draw_sink(pen: Pen) -> None:
    """A bowl at the left, a drainer at the right."""
    w, d = pen.width, pen.depth
    pen.box(-w / 2 + 0.04, -d / 2 + 0.06, w / 2 - 0.04, d / 2 - 0.06, round_by=0.05)
    pen.box(-w / 2 + 0.09, -d / 2 + 0.1, -0.02, d / 2 - 0.12, round_by=0.06)
    pen.oval((-w / 2 + 0.07) / 2, 0, 0.03)
    for y in np.linspace(-d / 2 + 0.14, d / 2 - 0.14, 4):
        pen.line((0.06, y), (w / 2 - 0.1, y))


def draw_fridge(pen: Pen) -> None:
    """A closed appliance: crossed, with its door."""
    w, d = pen.width, pen.depth
    pen.outline()
    pen.line((-w / 2, -d / 2 + 0.06), (w / 2, -d / 2 + 0.06))
    pen.line((-w / 2, d / 2), (w / 2, -d / 2 + 0.06))


def draw_washer(pen: Pen) -> None:
    """A drum in a box."""
    pen.outline()
    pen.oval(0, 0, 0.35 * min(pen.width, pen.depth))
    pen.line((-pen.width / 2, pen.depth / 2 - 0.08), (pen.width / 2, pen.depth / 2 - 0.08))
