"""The "soft" hand: furniture and fixtures with round corners, each in its own frame (back at +y)."""

from __future__ import annotations

import numpy as np

from priorlab.buildings.pen import Pen


def draw_bed(pen: Pen) -> None:
    """A headboard, one or two round pillows, a cover with a soft edge."""
    w, d = pen.width, pen.depth
    pen.outline(round_by=0.12)
    n_pillows = 2 if w > 1.3 else 1
    for x in (np.arange(n_pillows) + 0.5) * w / n_pillows - w / 2:
        pen.oval(float(x), d / 2 - 0.3, 0.4 * w / n_pillows, 0.15)
    pen.box(-w / 2, -d / 2, w / 2, d / 2 - 0.55, round_by=0.12)


def draw_sofa(pen: Pen) -> None:
    """A round seat within its arms."""
    w, d = pen.width, pen.depth
    pen.outline(round_by=0.25)
    pen.box(-w / 2 + 0.14, -d / 2, w / 2 - 0.14, d / 2 - 0.2, round_by=0.15)


def draw_chair(pen: Pen) -> None:
    """A round seat and a bow behind it."""
    r = min(pen.width, pen.depth) / 2
    pen.oval(0, -0.02, 0.85 * r)
    pen.bow(0, -0.02, r, r, 30, 150)


def draw_table(pen: Pen) -> None:
    """A top with round corners."""
    pen.outline(round_by=0.18)


def draw_round_table(pen: Pen) -> None:
    """A round top and its foot."""
    pen.oval(0, 0, pen.width / 2, pen.depth / 2)
    pen.oval(0, 0, 0.06)


def draw_desk(pen: Pen) -> None:
    """A top with a bent front and a screen."""
    w, d = pen.width, pen.depth
    pen.outline(round_by=0.1)
    pen.bow(0, d / 2 - 0.12, 0.3, 0.06, 180, 360)
    pen.line((-0.3, d / 2 - 0.12), (0.3, d / 2 - 0.12))
    pen.bow(0, -d / 2, 0.3 * w, 0.12, 0, 180)


def draw_cupboard(pen: Pen) -> None:
    """A wardrobe: coats as slim ovals."""
    w, d = pen.width, pen.depth
    pen.outline()
    for x in np.arange(-w / 2 + 0.2, w / 2 - 0.15, 0.24):
        pen.oval(float(x), 0, 0.05, d / 2 - 0.1)


def draw_shelf(pen: Pen) -> None:
    """A double line at the back."""
    w, d = pen.width, pen.depth
    pen.outline()
    pen.line((-w / 2, d / 2 - 0.06), (w / 2, d / 2 - 0.06))


def draw_cabinet(pen: Pen) -> None:
    """Two doors with knobs."""
    d = pen.depth
    pen.outline(round_by=0.04)
    pen.line((0, -d / 2), (0, d / 2))
    for x in (-0.07, 0.07):
        pen.oval(x, -d / 2 + 0.07, 0.025)


def draw_box(pen: Pen) -> None:
    """A bedside table with its lamp."""
    pen.outline(round_by=0.05)
    pen.oval(0, 0, 0.3 * min(pen.width, pen.depth))


def draw_plant(pen: Pen) -> None:
    """Petals round a pot."""
    r = min(pen.width, pen.depth) / 2
    for angle in np.radians(np.arange(0, 360, 60)):
        pen.oval(0.6 * r * np.cos(angle), 0.6 * r * np.sin(angle), 0.4 * r)
    pen.oval(0, 0, 0.3 * r)


def draw_bath(pen: Pen) -> None:
    """An oval tub in its frame."""
    w, d = pen.width, pen.depth
    pen.outline(round_by=0.05)
    pen.oval(0, 0, w / 2 - 0.08, d / 2 - 0.07)
    pen.oval(0, 0, 0.04)


def draw_shower(pen: Pen) -> None:
    """A quarter-round tray."""
    w, d = pen.width, pen.depth
    pen.outline(round_by=0.3)
    pen.oval(0, 0, 0.3 * w, 0.3 * d)
    pen.oval(0, 0, 0.04)


def draw_wc(pen: Pen) -> None:
    """A bowl alone, hung on the wall."""
    w, d = pen.width, pen.depth
    pen.box(-w / 2 + 0.04, -d / 2, w / 2 - 0.04, d / 2, round_by=0.45 * w)
    pen.oval(0, -0.06, 0.28 * w, 0.3 * d)


def draw_basin(pen: Pen) -> None:
    """A half-round bowl."""
    w, d = pen.width, pen.depth
    pen.box(-w / 2, -d / 2, w / 2, d / 2, round_by=0.4 * d)
    pen.oval(0, -0.03, 0.33 * w, 0.3 * d)


def draw_counter(pen: Pen) -> None:
    """A worktop with the plinth's line."""
    w, d = pen.width, pen.depth
    pen.outline()
    pen.line((-w / 2, -d / 2 + 0.05), (w / 2, -d / 2 + 0.05))


def draw_hob(pen: Pen) -> None:
    """Two rings on a round plate."""
    pen.outline(round_by=0.12)
    for x in (-0.13, 0.13):
        pen.oval(x, 0, 0.09)
        pen.oval(x, 0, 0.04)


def draw_sink(pen: Pen) -> None:
    """Two round bowls."""
    w, d = pen.width, pen.depth
    pen.box(-w / 2 + 0.04, -d / 2 + 0.06, w / 2 - 0.04, d / 2 - 0.06, round_by=0.12)
    for x in (-w / 4 + 0.01, w / 4 - 0.01):
        pen.oval(x, 0, w / 4 - 0.07, d / 2 - 0.13)


def draw_fridge(pen: Pen) -> None:
    """A box with a snow star."""
    pen.outline(round_by=0.05)
    for angle in np.radians((0, 60, 120)):
        x, y = 0.16 * np.cos(angle), 0.16 * np.sin(angle)
        pen.line((-x, -y), (x, y))


def draw_washer(pen: Pen) -> None:
    """A drum and its window."""
    r = min(pen.width, pen.depth)
    pen.outline(round_by=0.06)
    pen.oval(0, -0.03, 0.36 * r)
    pen.oval(0, -0.03, 0.24 * r)


def draw_car(pen: Pen) -> None:
    """A round body and its glasshouse."""
    w, d = pen.width, pen.depth
    pen.outline(round_by=0.55)
    pen.box(-0.4 * w, -0.31 * d, 0.4 * w, 0.2 * d, round_by=0.35)


def draw_tree(pen: Pen) -> None:
    """A crown of bows round a trunk."""
    r = min(pen.width, pen.depth) / 2
    for angle in np.arange(0.0, 360.0, 45.0).tolist():
        x, y = 0.72 * r * np.cos(np.radians(angle)), 0.72 * r * np.sin(np.radians(angle))
        pen.bow(x, y, 0.3 * r, 0.3 * r, angle - 100, angle + 100)
    pen.oval(0, 0, 0.08 * r)
