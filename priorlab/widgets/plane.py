"""Two axes as a small line drawing (SVG): a colour map, lines and points on them. Sharp text, about 1 ms, no Matplotlib."""

from __future__ import annotations

import base64
import copy
from collections.abc import Sequence
from html import escape
from typing import Any

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.picture import encode_png

LEFT, TOP, BOTTOM = 52, 24, 40
UNKNOWN = (205, 205, 205)
"""Grey of a value that is nan: nothing was detected, there is no precision."""


class Plane:
    """Axes to draw on; `svg()` is the picture.

    Parameters
    ----------
    x, y : lowest and highest value of the axes
    labels : of the x axis and of the y axis
    title : above the axes
    size : width and height on the screen, CSS pixels
    right : room to the right of the axes, CSS pixels
    x_ticks, y_ticks : values that are written at the axes
    x_names : what is written at the x ticks when it is not their value
    logarithmic : whether x is spread by its logarithm

    >>> plane = Plane((0, 1), (0, 1), ("recall", "precision"), "front")
    >>> plane.line([0.2, 0.8], [0.9, 0.5], "stroke='#000'")
    >>> plane.svg().startswith("<svg") and "polyline" in plane.svg()
    True
    """

    def __init__(
        self,
        x: tuple[float, float],
        y: tuple[float, float],
        labels: tuple[str, str],
        title: str = "",
        size: tuple[int, int] = (330, 300),
        right: int = 16,
        x_ticks: Sequence[float] = (0, 0.2, 0.4, 0.6, 0.8, 1),
        y_ticks: Sequence[float] = (0, 0.2, 0.4, 0.6, 0.8, 1),
        x_names: Sequence[str] = (),
        logarithmic: bool = False,
    ) -> None:
        self._x, self._y, self._log = x, y, logarithmic
        self._width, self._height = size
        self.right, self.floor = self._width - right, self._height - BOTTOM
        self._parts: list[str] = []
        self._above = [
            f"<rect x='{LEFT}' y='{TOP}' width='{self.right - LEFT}' height='{self.floor - TOP}' fill='none' stroke='#777'/>",
            _text(LEFT, TOP - 9, title, "start", "font-weight='bold'"),
            _text((LEFT + self.right) / 2, self._height - 8, labels[0], "middle"),
            f"<g transform='rotate(-90 13 {(TOP + self.floor) / 2:.1f})'>"
            f"{_text(13, (TOP + self.floor) / 2, labels[1], 'middle')}</g>",
        ]
        for tick, name in zip(x_ticks, x_names or [f"{tick:g}" for tick in x_ticks], strict=True):
            self._above.append(_text(self.at_x(tick), self.floor + 15, name, "middle"))
            self._above.append(f"<path d='M{self.at_x(tick):.1f} {self.floor}v4' stroke='#777'/>")
        for tick in y_ticks:
            self._above.append(_text(LEFT - 6, self.at_y(tick) + 4, f"{tick:g}", "end"))
            self._above.append(f"<path d='M{LEFT} {self.at_y(tick):.1f}h-4' stroke='#777'/>")

    def at_x(self, value: Any) -> Any:
        """Values of the x axis on the paper; those beyond its ends lie on them."""
        (low, high), value = self._x, np.clip(value, *self._x)
        share = np.log(value / low) / np.log(high / low) if self._log else (value - low) / (high - low)
        return LEFT + share * (self.right - LEFT)

    def at_y(self, value: Any) -> Any:
        """Values of the y axis on the paper; those beyond its ends lie on them."""
        low, high = self._y
        return self.floor - (np.clip(value, low, high) - low) / (high - low) * (self.floor - TOP)

    def colours(self, values: ArrayLike, low: float = 0.0, high: float = 1.0) -> None:
        """A table of values, (values of x, values of y), each over its share of the plane; its scale stands at the right edge."""
        png = encode_png(cividis(np.asarray(values).T[::-1], low, high))
        self._image(png, LEFT, TOP, self.right - LEFT, self.floor - TOP)
        bar, at, height = cividis(np.linspace(high, low, 64)[:, None], low, high), self.right + 8, self.floor - TOP
        self._image(encode_png(bar), at, TOP, 10, height)
        for share in (0.0, 0.5, 1.0):
            value = low + share * (high - low)
            self._above.append(_text(at + 14, self.floor - share * height + 4, f"{value:g}", "start"))

    def band(self, x: tuple[float, float] | None = None, y: tuple[float, float] | None = None, fill: str = "#e8e8e8") -> None:
        """A shaded strip between two values of an axis."""
        x0, x1 = (self.at_x(value) for value in (x or self._x))
        y0, y1 = (self.at_y(value) for value in (y or self._y))
        self._parts.append(f"<rect x='{x0:.1f}' y='{y1:.1f}' width='{x1 - x0:.1f}' height='{y0 - y1:.1f}' fill='{fill}'/>")

    def line(self, x: ArrayLike, y: ArrayLike, style: str) -> None:
        """A line through points; nan ends it."""
        xs, ys = np.broadcast_arrays(np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64))
        known = np.isfinite(ys) & np.isfinite(xs)
        at = zip(self.at_x(xs[known]).tolist(), self.at_y(ys[known]).tolist(), strict=True)
        points = " ".join(f"{a:.1f},{b:.1f}" for a, b in at)
        self._parts.append(f"<polyline points='{points}' fill='none' {style}/>")

    def strokes(self, starts: ArrayLike, ends: ArrayLike, style: str) -> None:
        """Many short lines at once, from (N, 2) points to (N, 2) points; a round line cap makes dots of those without length."""
        (x0, y0), (x1, y1) = (np.asarray(points, dtype=np.float64).reshape(-1, 2).T for points in (starts, ends))
        at = np.column_stack([self.at_x(x0), self.at_y(y0), self.at_x(x1), self.at_y(y1)]).tolist()
        path = "".join(f"M{a:.1f} {b:.1f}L{c:.1f} {d:.1f}" for a, b, c, d in at)
        self._parts.append(f"<path d='{path}' fill='none' {style}/>")

    def points(self, x: ArrayLike, y: ArrayLike, marker: str, colour: str, size: float = 4) -> None:
        """Markers: "ring", "square", "dot" or "cross"."""
        xs, ys = np.ravel(np.asarray(x, dtype=np.float64)), np.ravel(np.asarray(y, dtype=np.float64))
        known = np.isfinite(xs) & np.isfinite(ys)
        at = zip(self.at_x(xs[known]).tolist(), self.at_y(ys[known]).tolist(), strict=True)
        self._parts += [_marker(a, b, marker, colour, size) for a, b in at]

    def words(self, x: float, y: float, words: str, anchor: str = "start", style: str = "") -> None:
        """Text at a point."""
        self._parts.append(_text(self.at_x(x), self.at_y(y), words, anchor, style))

    def copy(self) -> Plane:
        """The same once more, to draw on: what does not move is drawn once."""
        other = copy.copy(self)
        other._parts = list(self._parts)
        return other

    def svg(self) -> str:
        """The picture."""
        size = f"width='{self._width}' height='{self._height}' viewBox='0 0 {self._width} {self._height}'"
        paper = f"<rect width='{self._width}' height='{self._height}' fill='#fff'/>"
        inside = f"{paper}{''.join(self._parts)}{''.join(self._above)}"
        return f"<svg xmlns='http://www.w3.org/2000/svg' {size} font-family='sans-serif' font-size='12'>{inside}</svg>"

    def _image(self, png: bytes, x: float, y: float, width: float, height: float) -> None:
        """Pixels stretched over a rectangle, sharp."""
        data = base64.b64encode(png).decode()
        self._parts.append(
            f"<image x='{x:.1f}' y='{y:.1f}' width='{width:.1f}' height='{height:.1f}' preserveAspectRatio='none' "
            f"style='image-rendering:pixelated' href='data:image/png;base64,{data}'/>"
        )


def cividis(values: ArrayLike, low: float = 0.0, high: float = 1.0) -> NDArray[np.uint8]:
    """(height, width, 3) colours from dark blue (low) to yellow (high), safe for colour-blind readers; nan is grey.

    >>> cividis([[0.0, 1.0, np.nan]]).shape
    (1, 3, 3)
    """
    values = np.asarray(values, dtype=np.float64)
    unknown = ~np.isfinite(values)
    level = np.rint(255 * np.clip((np.where(unknown, low, values) - low) / (high - low), 0, 1)).astype(np.uint8)
    colours = np.ascontiguousarray(cv2.applyColorMap(level, cv2.COLORMAP_CIVIDIS)[..., ::-1])
    colours[unknown] = UNKNOWN
    return colours.astype(np.uint8)


def _text(x: float, y: float, words: str, anchor: str, style: str = "") -> str:
    """A label."""
    return f"<text x='{x:.1f}' y='{y:.1f}' text-anchor='{anchor}' {style}>{escape(words, quote=False)}</text>"


def _marker(x: float, y: float, marker: str, colour: str, r: float) -> str:
    """One point."""
    if marker == "cross":  # white below, so that it shows on every colour
        path = f"M{x - r:.1f} {y - r:.1f}l{2 * r} {2 * r}m0 {-2 * r}l{-2 * r} {2 * r}"
        return f"<path d='{path}' stroke='#fff' stroke-width='6'/><path d='{path}' stroke='{colour}' stroke-width='3'/>"
    if marker == "square":
        return f"<rect x='{x - r:.1f}' y='{y - r:.1f}' width='{2 * r}' height='{2 * r}' fill='{colour}'/>"
    fill = "none" if marker == "ring" else colour
    return f"<circle cx='{x:.1f}' cy='{y:.1f}' r='{r}' fill='{fill}' stroke='{colour}' stroke-width='1.5'/>"
