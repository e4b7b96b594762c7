"""Loose furniture as an architect draws it: one function per kind, each in the piece's own frame (back at +y)."""

from __future__ import annotations

import numpy as np

from priorlab.buildings.pen import Pen


def draw_bed(pen: Pen) -> None:
    """Mattress, one or two pillows at the back, the blanket turned down."""
    w, d = pen.width, pen.depth
    pen.outline()
    n_pillows = 2 if w > 1.3 else 1
    each = w / n_pillows
    for number in range(n_pillows):
        left = -w / 2 + number * each
        pen.box(left + 0.1, d / 2 - 0.5, left + each - 0.1, d / 2 - 0.12, round_by=0.08)
    fold = d / 2 - 0.62
    pen.line((-w / 2, fold), (w / 2, fold))
    pen.line((w / 2 - 0.55, fold), (w / 2, fold - 0.45))


def draw_sofa(pen: Pen) -> None:
    """Back, two arms, and as many cushions as fit; an armchair is a short sofa."""
    w, d = pen.width, pen.depth
    pen.outline(round_by=0.06)
    arm, back = 0.16, 0.22
    pen.box(-w / 2 + arm, -d / 2, w / 2 - arm, d / 2 - back)
    n_cushions = max(1, round((w - 2 * arm) / 0.7))
    for x in np.linspace(-w / 2 + arm, w / 2 - arm, n_cushions + 1)[1:-1]:
        pen.line((x, -d / 2), (x, d / 2 - back))


def draw_chair(pen: Pen) -> None:
    """A seat and its back rest."""
    w, d = pen.width, pen.depth
    pen.box(-w / 2 + 0.02, -d / 2, w / 2 - 0.02, d / 2 - 0.04, round_by=0.08)
    pen.box(-w / 2, d / 2 - 0.07, w / 2, d / 2, round_by=0.03)


def draw_table(pen: Pen) -> None:
    """A top."""
    pen.outline()


def draw_round_table(pen: Pen) -> None:
    """A round top."""
    pen.oval(0, 0, pen.width / 2, pen.depth / 2)


def draw_desk(pen: Pen) -> None:
    """A top with a screen and a keyboard."""
    d = pen.depth
    pen.outline()
    pen.box(-0.28, d / 2 - 0.2, 0.28, d / 2 - 0.13)
    pen.box(-0.22, d / 2 - 0.55, 0.22, d / 2 - 0.38)


def draw_cupboard(pen: Pen) -> None:
    """A wardrobe: its rail with hangers."""
    w, d = pen.width, pen.depth
    pen.outline()
    pen.line((-w / 2, 0.0), (w / 2, 0.0))
    for x in np.arange(-w / 2 + 0.15, w / 2 - 0.1, 0.16):
        pen.line((x - 0.03, -d / 2 + 0.1), (x + 0.03, d / 2 - 0.1))


def draw_shelf(pen: Pen) -> None:
    """Boards with uprights."""
    w, d = pen.width, pen.depth
    pen.outline()
    for x in np.linspace(-w / 2, w / 2, max(2, round(w / 0.5)) + 1)[1:-1]:
        pen.line((x, -d / 2), (x, d / 2))


def draw_cabinet(pen: Pen) -> None:
    """A closed piece: crossed."""
    w, d = pen.width, pen.depth
    pen.outline()
    pen.line((-w / 2, -d / 2), (w / 2, d / 2))


def draw_box(pen: Pen) -> None:
    """Something that is only known to take room."""
    pen.outline()


def draw_plant(pen: Pen) -> None:
    """A pot with leaves."""
    r = min(pen.width, pen.depth) / 2
    pen.oval(0, 0, 0.35 * r)
    for angle in np.radians(np.arange(0, 360, 45)):
        x, y = np.cos(angle), np.sin(angle)
        pen.line((0.35 * r * x, 0.35 * r * y), (r * x, r * y))
        for side in (-0.3, 0.3):
            tip = (r * np.cos(angle + side) * 0.8, r * np.sin(angle + side) * 0.8)
            pen.line(tip, (0.6 * r * x, 0.6 * r * y))


def draw_car(pen: Pen) -> None:
    """A body, bonnet and windscreens."""
    w, d = pen.width, pen.depth
    pen.outline(round_by=0.3)
    pen.box(-0.43 * w, -0.38 * d, 0.43 * w, 0.22 * d, round_by=0.25)
    for y in (0.09, -0.28):
        pen.line((-0.43 * w, y * d), (0.43 * w, y * d))


def draw_tree(pen: Pen) -> None:
    """A crown with its branches."""
    r = min(pen.width, pen.depth) / 2
    pen.oval(0, 0, r)
    for angle in np.radians(np.arange(0, 360, 30)):
        pen.line((0.15 * r * np.cos(angle), 0.15 * r * np.sin(angle)), (0.85 * r * np.cos(angle), 0.85 * r * np.sin(angle)))
