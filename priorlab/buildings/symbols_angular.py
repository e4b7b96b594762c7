"""The "angular" hand: furniture and fixtures of straight lines and chamfers, each in its own frame (back at +y)."""

from __future__ import annotations

import numpy as np

from priorlab.buildings.pen import Pen


def chamfered(pen: Pen, left: float, bottom: float, right: float, top: float, cut: float) -> None:
    """A rectangle with its corners cut off."""
    pen.patch(
        (left + cut, bottom),
        (right - cut, bottom),
        (right, bottom + cut),
        (right, top - cut),
        (right - cut, top),
        (left + cut, top),
        (left, top - cut),
        (left, bottom + cut),
    )


def draw_bed(pen: Pen) -> None:
    """A square pillow each, and a diagonal over the cover."""
    w, d = pen.width, pen.depth
    pen.outline()
    n_pillows = 2 if w > 1.3 else 1
    for x in (np.arange(n_pillows) + 0.5) * w / n_pillows - w / 2:
        pen.box(float(x) - 0.3, d / 2 - 0.48, float(x) + 0.3, d / 2 - 0.08)
    pen.line((-w / 2, d / 2 - 0.6), (w / 2, -d / 2))
    pen.line((-w / 2, d / 2 - 0.6), (w / 2, d / 2 - 0.6))


def draw_sofa(pen: Pen) -> None:
    """Back and arms as one bent strip."""
    w, d = pen.width, pen.depth
    pen.outline()
    pen.line((-w / 2 + 0.2, -d / 2), (-w / 2 + 0.2, d / 2 - 0.25), (w / 2 - 0.2, d / 2 - 0.25), (w / 2 - 0.2, -d / 2))
    pen.line((-w / 2, d / 2), (-w / 2 + 0.2, d / 2 - 0.25))
    pen.line((w / 2, d / 2), (w / 2 - 0.2, d / 2 - 0.25))


def draw_chair(pen: Pen) -> None:
    """A seat that narrows to the back."""
    w, d = pen.width, pen.depth
    pen.patch((-w / 2, -d / 2), (w / 2, -d / 2), (w / 2 - 0.07, d / 2), (-w / 2 + 0.07, d / 2))
    pen.line((-w / 2 + 0.06, d / 2 - 0.08), (w / 2 - 0.06, d / 2 - 0.08))


def draw_table(pen: Pen) -> None:
    """A top with its chamfered edge."""
    w, d = pen.width, pen.depth
    chamfered(pen, -w / 2, -d / 2, w / 2, d / 2, 0.12)


def draw_round_table(pen: Pen) -> None:
    """A top with eight sides."""
    w, d = pen.width, pen.depth
    chamfered(pen, -w / 2, -d / 2, w / 2, d / 2, 0.29 * min(w, d))


def draw_desk(pen: Pen) -> None:
    """A top, drawers at one side, a sheet of paper."""
    w, d = pen.width, pen.depth
    pen.outline()
    pen.line((w / 2 - 0.4, -d / 2), (w / 2 - 0.4, d / 2))
    pen.patch((-0.3, -0.12), (0.06, -0.2), (0.12, 0.08), (-0.24, 0.16))


def draw_cupboard(pen: Pen) -> None:
    """A wardrobe: crossed, as in working drawings."""
    w, d = pen.width, pen.depth
    pen.outline()
    pen.line((-w / 2, -d / 2), (w / 2, d / 2))
    pen.line((-w / 2, d / 2), (w / 2, -d / 2))


def draw_shelf(pen: Pen) -> None:
    """Books that lean."""
    w, d = pen.width, pen.depth
    pen.outline()
    for x in np.arange(-w / 2 + 0.2, w / 2 - 0.15, 0.35):
        pen.line((float(x), -d / 2), (float(x) + 0.1, d / 2))


def draw_cabinet(pen: Pen) -> None:
    """A front line and three drawers."""
    w, d = pen.width, pen.depth
    pen.outline()
    pen.line((-w / 2, -d / 2 + 0.08), (w / 2, -d / 2 + 0.08))
    for x in (-w / 6, w / 6):
        pen.line((x, -d / 2), (x, -d / 2 + 0.08))


def draw_box(pen: Pen) -> None:
    """A corner marked."""
    w, d = pen.width, pen.depth
    pen.outline()
    pen.line((-w / 2, d / 2 - 0.15), (-w / 2 + 0.15, d / 2))


def draw_plant(pen: Pen) -> None:
    """A star in a square pot."""
    r = min(pen.width, pen.depth) / 2
    pen.box(-r, -r, r, r)
    angles = np.radians(np.arange(0, 360, 36))
    radii = np.where(np.arange(10) % 2, 0.35, 0.9) * r
    pen.patch(*zip((radii * np.cos(angles)).tolist(), (radii * np.sin(angles)).tolist(), strict=True))


def draw_bath(pen: Pen) -> None:
    """A tub that narrows to its foot."""
    w, d = pen.width, pen.depth
    pen.outline()
    pen.patch(
        (-w / 2 + 0.1, -d / 2 + 0.16), (w / 2 - 0.1, -d / 2 + 0.08), (w / 2 - 0.1, d / 2 - 0.08), (-w / 2 + 0.1, d / 2 - 0.16)
    )
    pen.line((w / 2 - 0.25, 0), (w / 2 - 0.1, 0))


def draw_shower(pen: Pen) -> None:
    """A tray with a cut corner and its slope."""
    w, d = pen.width, pen.depth
    pen.patch((-w / 2, -d / 2), (w / 2 - 0.3, -d / 2), (w / 2, -d / 2 + 0.3), (w / 2, d / 2), (-w / 2, d / 2))
    pen.line((-w / 2, d / 2), (w / 2 - 0.15, -d / 2 + 0.15))


def draw_wc(pen: Pen) -> None:
    """A cistern and a bowl with six sides."""
    w, d = pen.width, pen.depth
    pen.box(-w / 2, d / 2 - 0.15, w / 2, d / 2)
    pen.patch(
        (-w / 2 + 0.05, d / 2 - 0.15),
        (-w / 2 + 0.03, -d / 2 + 0.18),
        (-0.09, -d / 2),
        (0.09, -d / 2),
        (w / 2 - 0.03, -d / 2 + 0.18),
        (w / 2 - 0.05, d / 2 - 0.15),
    )


def draw_basin(pen: Pen) -> None:
    """A square bowl and its tap."""
    w, d = pen.width, pen.depth
    pen.outline()
    chamfered(pen, -w / 2 + 0.07, -d / 2 + 0.06, w / 2 - 0.07, d / 2 - 0.13, 0.06)
    pen.line((0, d / 2), (0, d / 2 - 0.18))


def draw_counter(pen: Pen) -> None:
    """A worktop with the wall cupboards' edge behind."""
    w, d = pen.width, pen.depth
    pen.outline()
    pen.line((-w / 2, d / 2 - 0.33), (w / 2, d / 2 - 0.33))


def draw_hob(pen: Pen) -> None:
    """Four crosses."""
    w, d = pen.width, pen.depth
    pen.box(-w / 2 + 0.05, -d / 2 + 0.07, w / 2 - 0.05, d / 2 - 0.07)
    for x in (-0.13, 0.13):
        for y in (-0.1, 0.1):
            pen.line((x - 0.06, y), (x + 0.06, y))
            pen.line((x, y - 0.06), (x, y + 0.06))


def draw_sink(pen: Pen) -> None:
    """A square bowl and a ribbed side."""
    w, d = pen.width, pen.depth
    pen.box(-w / 2 + 0.05, -d / 2 + 0.08, w / 2 - 0.05, d / 2 - 0.08)
    pen.box(0.02, -d / 2 + 0.13, w / 2 - 0.1, d / 2 - 0.13)
    for x in np.linspace(-w / 2 + 0.12, -0.06, 4):
        pen.line((float(x), -d / 2 + 0.14), (float(x), d / 2 - 0.14))


def draw_fridge(pen: Pen) -> None:
    """Two doors, one over the other."""
    w, d = pen.width, pen.depth
    pen.outline()
    pen.patch((-w / 2 + 0.06, -d / 2), (w / 2, -d / 2), (w / 2, d / 2 - 0.06), fill=False)


def draw_washer(pen: Pen) -> None:
    """A box with its eight-sided drum."""
    r = 0.36 * min(pen.width, pen.depth)
    pen.outline()
    chamfered(pen, -r, -r, r, r, 0.55 * r)


def draw_car(pen: Pen) -> None:
    """A body with cut corners, screens front and rear."""
    w, d = pen.width, pen.depth
    chamfered(pen, -w / 2, -d / 2, w / 2, d / 2, 0.2 * w)
    for wide, narrow in ((0.21, 0.08), (-0.38, -0.28)):
        pen.patch((-0.43 * w, wide * d), (0.43 * w, wide * d), (0.33 * w, narrow * d), (-0.33 * w, narrow * d))


def draw_tree(pen: Pen) -> None:
    """A ring of spikes."""
    r = min(pen.width, pen.depth) / 2
    angles = np.radians(np.arange(0, 360, 15))
    radii = np.where(np.arange(24) % 2, 0.78, 1.0) * r
    pen.patch(*zip((radii * np.cos(angles)).tolist(), (radii * np.sin(angles)).tolist(), strict=True))
    pen.line((-0.1 * r, 0), (0.1 * r, 0))
    pen.line((0, -0.1 * r), (0, 0.1 * r))
