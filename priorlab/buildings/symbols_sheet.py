"""What stands round the building on its sheet: dimension chains, title, north arrow, scale bar, frame."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from priorlab.buildings.paper import Paper
from priorlab.buildings.parts import Dimension, Sheet

Points = NDArray[np.float64]

BLOCK_WIDTH = 4.6
"""Width of the title block, metres."""


def draw_dimension(paper: Paper, chain: Dimension, bounds: Points, sheet: Sheet) -> None:
    """A chain: its line, a slanted tick and an extension line at every point, the measures in metres above the line.

    `bounds` : (2, 2) lower left and upper right corner of the building
    """
    upright = chain.side in ("east", "west")
    low = chain.side in ("south", "west")
    across = 0 if upright else 1
    edge = bounds[0 if low else 1, across]
    outwards = -1 if low else 1
    level = edge + outwards * chain.distance if chain.level is None else chain.level

    def at(along: float, offset: float) -> Points:
        return np.array([level + offset, along]) if upright else np.array([along, level + offset])

    reach = 0.12
    paper.line([at(chain.points[0] - reach, 0), at(chain.points[-1] + reach, 0)], sheet.line * 0.85)
    for point in chain.points:
        inner = -outwards * (reach if chain.level is not None else min(chain.distance - 0.2, 0.35))
        paper.line([at(point, outwards * reach), at(point, inner)], sheet.line * 0.85)
        _draw_end(paper, at(point, 0), at(point + 1, 0) - at(point, 0), sheet)
    above = chain.size * 0.85 + 0.02
    for start, end in zip(chain.points, chain.points[1:], strict=False):
        text = measure(end - start, sheet)
        paper.text(text, at((start + end) / 2, -above if upright else above), chain.size, 90.0 if upright else 0.0)


def measure(length_m: float, sheet: Sheet) -> str:
    """A length as the sheet writes it.

    >>> measure(1.25, Sheet()), measure(1.25, Sheet(unit="mm"))
    ('1.25', '1250')
    """
    if sheet.unit == "m":
        return f"{length_m:.2f}".replace(".", sheet.decimal)
    return f"{length_m * (100 if sheet.unit == 'cm' else 1000):.0f}"


def _draw_end(paper: Paper, point: Points, along: Points, sheet: Sheet) -> None:
    """What marks a measured point on the line of a chain."""
    if sheet.dimension_mark == "tick":
        paper.line([point - 0.09, point + 0.09], sheet.line * 1.4)
    elif sheet.dimension_mark == "arrow":
        across = np.array([-along[1], along[0]])
        for side in (-1, 1):
            paper.area([point, point + side * 0.16 * along + 0.045 * across, point + side * 0.16 * along - 0.045 * across])
    else:
        paper.circle(point, 0.06, sheet.line, fill="#000000" if sheet.dimension_mark == "dot" else "#ffffff")


def draw_title(paper: Paper, sheet: Sheet, corner: Points) -> None:
    """Title and subtitle, left-aligned above the lower left `corner`."""
    if sheet.title:
        paper.text(sheet.title, corner + (0.0, 0.62), 0.36, align="left")
    if sheet.subtitle:
        paper.text(sheet.subtitle, corner + (0.0, 0.12), 0.2, align="left")


def draw_title_block(paper: Paper, sheet: Sheet, corner: Points) -> None:
    """A box of lines of text; `corner` is its lower right one. The first line is the larger."""
    row = 0.42
    height = row * len(sheet.block)
    left = corner - (BLOCK_WIDTH, 0.0)
    box = np.array([[0.0, 0.0], [BLOCK_WIDTH, 0.0], [BLOCK_WIDTH, height], [0.0, height]])
    paper.shape(left + box, 1.6 * sheet.line, sheet.ink, sheet.paper)
    for number, text in enumerate(sheet.block):
        level = height - row * (number + 0.5)
        paper.text(text, left + (0.16, level), 0.22 if number == 0 else 0.17, ink=sheet.ink, align="left")
        if number:
            paper.line(left + np.array([[0.0, level + row / 2], [BLOCK_WIDTH, level + row / 2]]), 0.8 * sheet.line, sheet.ink)


def draw_north_arrow(paper: Paper, middle: Points, weight: float) -> None:
    """A circle with a half-filled needle and an N."""
    radius = 0.36
    paper.circle(middle, radius, weight)
    needle = np.array([[0.0, 0.9], [0.35, -0.75], [0.0, -0.45], [-0.35, -0.75]]) * radius
    paper.line(middle + needle, weight, closed=True)
    paper.area(middle + needle[[0, 2, 3]])
    paper.text("N", middle + (0.0, radius + 0.22), 0.22)


def draw_scale_bar(paper: Paper, right: Points, weight: float) -> None:
    """0, 1, 2, 5 metres, black and white by turns; `right` is its lower right end."""
    left, height = right - (5.0, 0.0), 0.13
    for start, end, black in ((0, 1, True), (1, 2, False), (2, 5, True)):
        box = np.array([[start, 0], [end, 0], [end, height], [start, height]]) + left
        paper.shape(box, weight, fill="#000000" if black else "#ffffff")
    for number in (0, 1, 2, 5):
        paper.text(f"{number} m" if number == 5 else f"{number}", left + (number, height + 0.22), 0.2)


def draw_frame(paper: Paper, low: Points, high: Points, weight: float) -> None:
    """Two lines round the sheet."""
    for inset, share in ((0.12, 1.0), (0.22, 1.8)):
        corners = np.array(
            [[low[0] + inset, low[1] + inset], [high[0] - inset, low[1] + inset], high - inset, [low[0] + inset, high[1] - inset]]
        )
        paper.line(corners, weight * share, closed=True)
