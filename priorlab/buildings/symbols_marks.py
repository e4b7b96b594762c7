"""Signs on a sheet that are no wall: axis bubbles, heights, section arrows, room stamps, a compass, a ruler, a revision cloud."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from priorlab.buildings.geometry import turned
from priorlab.buildings.paper import Paper, ellipse
from priorlab.buildings.parts import Mark, Sheet

Points = NDArray[np.float64]


def draw_mark(paper: Paper, mark: Mark, sheet: Sheet) -> None:
    """A mark in the sheet's line weight and ink."""
    MARKS[mark.kind](paper, mark, sheet)


def _draw_bubble(paper: Paper, mark: Mark, sheet: Sheet) -> None:
    """The name of an axis in a circle."""
    paper.circle(mark.at, mark.size / 2, sheet.line, sheet.ink, sheet.paper)
    paper.text(mark.text, mark.at, 0.42 * mark.size, ink=sheet.ink)


def _draw_level(paper: Paper, mark: Mark, sheet: Sheet) -> None:
    """A height above its triangle, half of it filled."""
    half, height = 0.2 * mark.size, 0.3 * mark.size
    foot = np.array(mark.at)
    paper.shape([foot, foot + (-half, height), foot + (half, height)], sheet.line, sheet.ink, sheet.paper)
    paper.area([foot, foot + (half, height), foot + (0, height)], sheet.ink)
    paper.line([foot + (-half, height), foot + (mark.size, height)], sheet.line, sheet.ink)
    paper.text(mark.text, foot + (-half, height + 0.2 * mark.size), 0.22 * mark.size, ink=sheet.ink, align="left")


def _draw_section(paper: Paper, mark: Mark, sheet: Sheet) -> None:
    """A filled arrow that looks along the section, with its letter."""
    arrow = np.array([[-0.3, 0.0], [0.3, 0.0], [0.0, 0.45]]) * mark.size
    paper.area(_at(mark, arrow), sheet.ink)
    paper.text(mark.text, _at(mark, np.array([0.0, -0.35 * mark.size])), 0.4 * mark.size, ink=sheet.ink)


def _draw_stamp(paper: Paper, mark: Mark, sheet: Sheet) -> None:
    """A room's number in a flat ellipse."""
    paper.shape(ellipse(mark.at, mark.size / 2, 0.26 * mark.size), sheet.line, sheet.ink, sheet.paper)
    paper.text(mark.text, mark.at, 0.24 * mark.size, ink=sheet.ink)


def _draw_compass(paper: Paper, mark: Mark, sheet: Sheet) -> None:
    """A star of four points, one half of each filled, and an N."""
    for quarter in range(4):
        long = turned(np.array([0.0, mark.size / 2]), mark.turn + 90 * quarter)
        for side, fill in ((45, sheet.ink), (-45, sheet.paper)):
            short = turned(np.array([0.0, 0.14 * mark.size]), mark.turn + 90 * quarter + side)
            paper.shape(np.array(mark.at) + [np.zeros(2), long, short], sheet.line, sheet.ink, fill)
    paper.text("N", _at(mark, np.array([0.0, 0.68 * mark.size])), 0.24 * mark.size, ink=sheet.ink)


def _draw_ruler(paper: Paper, mark: Mark, sheet: Sheet) -> None:
    """Metres as ticks on a line: 0 to 5; `at` is its left end."""
    left = np.array(mark.at)
    paper.line([left, left + (5.0, 0.0)], sheet.line, sheet.ink)
    for step in range(11):
        paper.line([left + (step / 2, 0.0), left + (step / 2, 0.22 if step % 2 == 0 else 0.12)], sheet.line, sheet.ink)
    for number in (0, 1, 5):
        paper.text(f"{number}", left + (number, 0.42), 0.2, ink=sheet.ink)


def _draw_cloud(paper: Paper, mark: Mark, sheet: Sheet) -> None:
    """Bows round what was changed; the revision's letter beside it."""
    a, b = mark.size / 2, 0.3 * mark.size
    n_bows = max(8, round(np.pi * (a + b) / 0.35))
    corners = ellipse(mark.at, a, b)[:: max(1, 72 // n_bows)]
    for start, end in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        chord = end - start
        if np.linalg.norm(chord) > 1e-6:
            direction = float(np.degrees(np.arctan2(chord[1], chord[0])))
            paper.arc((start + end) / 2, float(np.linalg.norm(chord)) / 2, direction - 180, direction, sheet.line, sheet.ink)
    paper.text(mark.text, np.array(mark.at) + (a + 0.3, b), 0.2, ink=sheet.ink)


def _at(mark: Mark, local: Points) -> Points:
    """Points of the mark's own frame on the sheet."""
    return np.array(mark.at) + turned(local, mark.turn)


MARKS: dict[str, Callable[[Paper, Mark, Sheet], None]] = {
    "bubble": _draw_bubble,
    "cloud": _draw_cloud,
    "compass": _draw_compass,
    "level": _draw_level,
    "ruler": _draw_ruler,
    "section": _draw_section,
    "stamp": _draw_stamp,
}
"""Who draws which mark."""
