"""The "atelier" hand: furniture and fixtures with double contours and texture, each in its own frame (back at +y)."""

from __future__ import annotations

import numpy as np

from priorlab.buildings.pen import Pen


def framed(pen: Pen, rim: float, round_by: float = 0.0) -> None:
    """The piece's rectangle and a second one inside it."""
    w, d = pen.width, pen.depth
    pen.outline(round_by)
    pen.box(-w / 2 + rim, -d / 2 + rim, w / 2 - rim, d / 2 - rim, max(0.0, round_by - rim))


def draw_bed(pen: Pen) -> None:
    """A frame, a bolster across, two seams."""
    w, d = pen.width, pen.depth
    framed(pen, 0.07)
    pen.box(-w / 2 + 0.12, d / 2 - 0.42, w / 2 - 0.12, d / 2 - 0.14, round_by=0.14)
    for x in (-w / 6, w / 6):
        pen.line((x, d / 2 - 0.5), (x, -d / 2 + 0.07))


def draw_sofa(pen: Pen) -> None:
    """Cushions with buttons before a thick back."""
    w, d = pen.width, pen.depth
    pen.box(-w / 2, d / 2 - 0.2, w / 2, d / 2, round_by=0.1)
    n_cushions = max(1, round(w / 0.75))
    each = w / n_cushions
    for x in (np.arange(n_cushions) + 0.5) * each - w / 2:
        pen.box(float(x) - each / 2, -d / 2, float(x) + each / 2, d / 2 - 0.2, round_by=0.08)
        pen.oval(float(x), -0.1, 0.03)


def draw_chair(pen: Pen) -> None:
    """A frame with a cushion."""
    framed(pen, 0.06)


def draw_table(pen: Pen) -> None:
    """A top with two boards' joints."""
    w, d = pen.width, pen.depth
    pen.outline()
    for y in (-d / 6, d / 6):
        pen.line((-w / 2, y), (w / 2, y))


def draw_round_table(pen: Pen) -> None:
    """A top and its rim."""
    pen.oval(0, 0, pen.width / 2, pen.depth / 2)
    pen.oval(0, 0, pen.width / 2 - 0.08, pen.depth / 2 - 0.08)


def draw_desk(pen: Pen) -> None:
    """A drawing board, a lamp on it."""
    w, d = pen.width, pen.depth
    framed(pen, 0.06)
    pen.oval(w / 2 - 0.22, d / 2 - 0.22, 0.09)
    pen.line((w / 2 - 0.28, d / 2 - 0.28), (0.1, -0.02))


def draw_cupboard(pen: Pen) -> None:
    """A wardrobe: its doors ajar as slim bars, hangers as short strokes."""
    w = pen.width
    framed(pen, 0.05)
    for x in np.arange(-w / 2 + 0.18, w / 2 - 0.1, 0.2):
        pen.line((float(x), -0.14), (float(x) + 0.05, 0.14))


def draw_shelf(pen: Pen) -> None:
    """A zigzag of brackets."""
    w, d = pen.width, pen.depth
    pen.outline()
    xs = np.linspace(-w / 2, w / 2, 2 * max(2, round(w / 0.6)) + 1)
    pen.line(*[(float(x), (d / 2 if i % 2 else -d / 2)) for i, x in enumerate(xs)])


def draw_cabinet(pen: Pen) -> None:
    """A top with a vase."""
    framed(pen, 0.05)
    pen.oval(0, 0, 0.1)


def draw_box(pen: Pen) -> None:
    """A double contour."""
    framed(pen, 0.06)


def draw_plant(pen: Pen) -> None:
    """A double pot and long leaves."""
    r = min(pen.width, pen.depth) / 2
    pen.oval(0, 0, 0.55 * r)
    pen.oval(0, 0, 0.45 * r)
    for angle in np.arange(0.0, 360.0, 72.0).tolist():
        x, y = np.cos(np.radians(angle)), np.sin(np.radians(angle))
        pen.bow(0.5 * r * x, 0.5 * r * y, 0.5 * r, 0.5 * r, angle - 60, angle + 60)


def draw_bath(pen: Pen) -> None:
    """A tub with a round head and its overflow."""
    w, d = pen.width, pen.depth
    framed(pen, 0.05)
    pen.box(-w / 2 + 0.12, -d / 2 + 0.1, w / 2 - 0.12, d / 2 - 0.1, round_by=0.12)
    pen.oval(-w / 2 + 0.3, 0, 0.035)
    pen.line((0, -d / 2 + 0.05), (0, -d / 2 + 0.1))


def draw_shower(pen: Pen) -> None:
    """A tray of slats."""
    w, d = pen.width, pen.depth
    framed(pen, 0.06)
    for y in np.linspace(-d / 2 + 0.06, d / 2 - 0.06, 7)[1:-1]:
        pen.line((-w / 2 + 0.06, float(y)), (w / 2 - 0.06, float(y)))


def draw_wc(pen: Pen) -> None:
    """A narrow cistern and a round bowl with its seat."""
    w, d = pen.width, pen.depth
    pen.box(-0.16, d / 2 - 0.14, 0.16, d / 2)
    pen.box(-w / 2 + 0.02, -d / 2, w / 2 - 0.02, d / 2 - 0.14, round_by=0.19)
    pen.box(-w / 2 + 0.08, -d / 2 + 0.06, w / 2 - 0.08, d / 2 - 0.24, round_by=0.13)
    pen.line((-w / 2 + 0.06, d / 2 - 0.19), (w / 2 - 0.06, d / 2 - 0.19))


def draw_basin(pen: Pen) -> None:
    """A double bowl in a slab, two taps."""
    w, d = pen.width, pen.depth
    pen.outline()
    pen.box(-w / 2 + 0.06, -d / 2 + 0.05, w / 2 - 0.06, d / 2 - 0.12, round_by=0.1)
    for x in (-0.07, 0.07):
        pen.oval(x, d / 2 - 0.06, 0.025)


def draw_counter(pen: Pen) -> None:
    """A worktop of cupboards."""
    w, d = pen.width, pen.depth
    pen.outline()
    for x in np.linspace(-w / 2, w / 2, max(2, round(w / 0.6)) + 1)[1:-1]:
        pen.line((float(x), -d / 2), (float(x), -d / 2 + 0.06))


def draw_hob(pen: Pen) -> None:
    """Four squares and a row of knobs."""
    w, d = pen.width, pen.depth
    pen.box(-w / 2 + 0.03, -d / 2 + 0.04, w / 2 - 0.03, d / 2 - 0.04)
    for x in (-0.13, 0.13):
        for y in (-0.05, 0.16):
            pen.box(x - 0.08, y - 0.08, x + 0.08, y + 0.08)
    for x in np.linspace(-0.18, 0.18, 4):
        pen.oval(float(x), -d / 2 + 0.09, 0.02)


def draw_sink(pen: Pen) -> None:
    """One wide bowl with a swivel tap."""
    w, d = pen.width, pen.depth
    pen.box(-w / 2 + 0.06, -d / 2 + 0.07, w / 2 - 0.06, d / 2 - 0.15, round_by=0.05)
    pen.oval(0, d / 2 - 0.09, 0.03)
    pen.line((0, d / 2 - 0.09), (0.12, 0))


def draw_fridge(pen: Pen) -> None:
    """A double contour with its handle."""
    w, d = pen.width, pen.depth
    framed(pen, 0.05)
    pen.line((w / 2 - 0.2, -d / 2 + 0.1), (w / 2 - 0.1, -d / 2 + 0.1))


def draw_washer(pen: Pen) -> None:
    """A box, its drum off the middle, a drawer."""
    w, d = pen.width, pen.depth
    framed(pen, 0.04)
    pen.oval(0.04, -0.05, 0.17)
    pen.box(-w / 2 + 0.08, d / 2 - 0.16, -0.02, d / 2 - 0.08)


def draw_car(pen: Pen) -> None:
    """A van: a long box, its cab, two mirrors."""
    w, d = pen.width, pen.depth
    half = w / 2 - 0.12
    pen.box(-half, -d / 2, half, d / 2, round_by=0.2)
    pen.line((-half, d / 2 - 0.35 * d), (half, d / 2 - 0.35 * d))
    pen.box(-half + 0.12, d / 2 - 0.31 * d, half - 0.12, d / 2 - 0.2 * d, round_by=0.12)
    for x in (-w / 2, w / 2 - 0.1):
        pen.box(x, d / 2 - 0.3 * d, x + 0.1, d / 2 - 0.26 * d)


def draw_tree(pen: Pen) -> None:
    """Three loose rings."""
    r = min(pen.width, pen.depth) / 2
    pen.oval(0, 0, r)
    pen.bow(0.08 * r, 0.05 * r, 0.7 * r, 0.66 * r, 20, 330)
    pen.bow(-0.05 * r, 0.08 * r, 0.36 * r, 0.34 * r, 100, 400)
