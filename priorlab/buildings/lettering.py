"""Letters as polygons: the outlines of the fonts that Matplotlib carries, so that text is the same everywhere."""

from __future__ import annotations

import functools
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from priorlab.buildings.stroke_letters import text_strokes

FONTS = {
    "sans": "DejaVuSans.ttf",
    "mono": "DejaVuSansMono.ttf",
    "oblique": "DejaVuSans-Oblique.ttf",
    "serif": "DejaVuSerif.ttf",
    "stix": "STIXGeneral.ttf",
}
"""Names of outline fonts and their files; "stroke" has no outlines (stroke_letters.py)."""

_POINTS = 100


def text_polygons(text: str, font: str = "sans") -> list[NDArray[np.float64]]:
    """(N, 2) polygons of a line of text: x right, y up, base line at 0, capital letters 1 high.

    Holes are polygons too: fill them together, by the even-odd rule.
    """
    polygons, pen = [], 0.0
    for letter in text:
        outlines, advance = _letter(letter, font)
        polygons += [outline + (pen, 0.0) for outline in outlines]
        pen += advance
    return polygons


def text_width(text: str, font: str = "sans") -> float:
    """Width of a line of text, in heights of a capital letter; 0 of nothing.

    >>> text_width("HH") > text_width("HI") > text_width("H") > 0
    True
    """
    curves = text_strokes(text) if font == "stroke" else text_polygons(text, font)
    if not curves:
        return 0.0
    return max(float(curve[:, 0].max()) for curve in curves) - min(float(curve[:, 0].min()) for curve in curves)


@functools.lru_cache(maxsize=1024)
def _letter(letter: str, name: str) -> tuple[tuple[NDArray[np.float64], ...], float]:
    """The outlines of one letter and how far the pen moves on."""
    font, capital = _font(name)
    glyph = font.load_char(ord(letter), flags=_no_hinting())
    points, codes = font.get_path()
    outlines = tuple(outline / capital for outline in _flattened(np.asarray(points), np.asarray(codes)))
    return outlines, glyph.linearHoriAdvance / 65536 / capital


@functools.lru_cache(maxsize=8)
def _font(name: str) -> tuple[Any, float]:
    """The font and the height of its capitals, in its own units. Matplotlib's font search is slow and is not asked."""
    import matplotlib
    from matplotlib.ft2font import FT2Font

    font = FT2Font(str(Path(matplotlib.get_data_path()) / "fonts" / "ttf" / FONTS[name]))
    font.set_size(_POINTS, 72)
    font.load_char(ord("H"), flags=_no_hinting())
    points, _ = font.get_path()
    return font, float(np.asarray(points)[:, 1].max())


def _no_hinting() -> Any:
    """FreeType's flag for outlines as they were designed."""
    from matplotlib.ft2font import LoadFlags

    return LoadFlags.NO_HINTING


def _flattened(points: NDArray[np.float64], codes: NDArray[np.uint8]) -> list[NDArray[np.float64]]:
    """A path of straight and curved pieces (1 move, 2 line, 3 quadratic, 4 cubic, 79 close) as polygons."""
    polygons: list[NDArray[np.float64]] = []
    corner: list[NDArray[np.float64]] = []
    share = np.linspace(0.25, 1.0, 4)[:, None]
    at = 0
    while at < len(codes):
        code = int(codes[at])
        if code in (1, 79):
            if len(corner) > 2:
                polygons.append(np.array(corner))
            corner = [points[at]] if code == 1 else []
            at += 1
        elif code == 2:
            corner.append(points[at])
            at += 1
        elif code == 3:
            start, (control, end) = corner[-1], points[at : at + 2]
            corner += list((1 - share) ** 2 * start + 2 * share * (1 - share) * control + share**2 * end)
            at += 2
        else:
            start, (one, two, end) = corner[-1], points[at : at + 3]
            corner += list(
                (1 - share) ** 3 * start + 3 * share * (1 - share) ** 2 * one + 3 * share**2 * (1 - share) * two + share**3 * end
            )
            at += 3
    if len(corner) > 2:
        polygons.append(np.array(corner))
    return polygons
