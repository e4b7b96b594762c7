"""Paper to draw on: lines, areas, circles and text in the description's metres, four times finer than the drawing's pixels."""

from __future__ import annotations

import math
from collections.abc import Iterable

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.buildings.frame import Frame
from priorlab.buildings.lettering import text_polygons
from priorlab.buildings.stroke_letters import PEN, text_strokes

FINER = 4
"""Fine pixels per pixel and axis: an average over 4 x 4 makes 17 greys, as an anti-aliased export has them."""

_SHIFT = 6  # binary digits of a fine pixel that OpenCV is told


class Paper:
    """A sheet that is drawn on; `picture()` is what it looks like in the drawing's pixels.

    Colours are "#rrggbb"; a sheet without `colour` shows their brightness. Weights of lines are in pixels, everything else is
    in the description's metres.
    """

    def __init__(self, frame: Frame, paper: str = "#ffffff", colour: bool = False, font: str = "sans") -> None:
        self.frame, self._colour, self._font = frame, colour, font
        shape = (frame.shape[0] * FINER, frame.shape[1] * FINER)
        self._fine = np.full((*shape, 3) if colour else shape, self._value(paper), dtype=np.uint8)

    def line(self, points_m: ArrayLike, weight: float = 1.2, ink: str = "#000000", closed: bool = False) -> None:
        """A line through (N, 2) points."""
        thickness = max(1, round(weight * FINER))
        cv2.polylines(self._fine, [self._fixed(points_m)], closed, self._value(ink), thickness, cv2.LINE_8, _SHIFT)

    def dashes(
        self, points_m: ArrayLike, weight: float = 1.2, ink: str = "#000000", dash: float = 0.15, gap: float = 0.1
    ) -> None:
        """A dashed line through (N, 2) points; every straight piece starts with a dash."""
        points = np.asarray(points_m, dtype=np.float64)
        for start, end in zip(points, points[1:], strict=False):
            length = float(np.linalg.norm(end - start))
            along = (end - start) / max(length, 1e-9)
            for at in np.arange(0.0, length, dash + gap):
                self.line([start + at * along, start + min(at + dash, length) * along], weight, ink)

    def area(self, points_m: ArrayLike, ink: str = "#000000") -> None:
        """A filled polygon."""
        cv2.fillPoly(self._fine, [self._fixed(points_m)], self._value(ink), cv2.LINE_8, _SHIFT)

    def shape(self, points_m: ArrayLike, weight: float = 1.2, ink: str = "#000000", fill: str | None = "#ffffff") -> None:
        """A closed outline, filled so that it covers what lies below it."""
        if fill is not None:
            self.area(points_m, fill)
        self.line(points_m, weight, ink, closed=True)

    def arc(self, centre: ArrayLike, radius: float, start: float, end: float, weight: float = 1.2, ink: str = "#000000") -> None:
        """A piece of a circle between two directions, degrees."""
        self.line(ellipse(centre, radius, radius, start, end), weight, ink)

    def circle(
        self, centre: ArrayLike, radius: float, weight: float = 1.2, ink: str = "#000000", fill: str | None = "#ffffff"
    ) -> None:
        """A circle, filled so that it covers what lies below it."""
        self.shape(ellipse(centre, radius, radius), weight, ink, fill)

    def text(
        self, text: str, middle: ArrayLike, size: float, turn: float = 0.0, ink: str = "#000000", align: str = "centre"
    ) -> None:
        """Text whose capital letters are `size` metres high; `middle` is its centre, or its left end for align="left"."""
        as_strokes = self._font == "stroke"
        curves = text_strokes(text) if as_strokes else text_polygons(text, self._font)
        if not curves:
            return
        low = min(float(p[:, 0].min()) for p in curves)
        high = max(float(p[:, 0].max()) for p in curves)
        shift = np.array([low if align == "left" else (low + high) / 2, 0.5])
        cos, sin = math.cos(math.radians(turn)), math.sin(math.radians(turn))
        rotation = np.array([[cos, sin], [-sin, cos]])
        placed = [np.asarray(middle) + size * (curve - shift) @ rotation for curve in curves]
        if as_strokes:
            for stroke in placed:
                self.line(stroke, PEN * size / self.frame.metres_per_pixel, ink)
        else:
            cv2.fillPoly(self._fine, [self._fixed(polygon) for polygon in placed], self._value(ink), cv2.LINE_8, _SHIFT)

    def stain(self, fine_mask: NDArray[np.bool_], ink: str) -> None:
        """Every fine pixel of a mask takes a colour."""
        np.copyto(self._fine, np.array(self._value(ink), np.uint8), where=fine_mask[..., None] if self._colour else fine_mask)

    def picture(self) -> NDArray[np.uint8]:
        """(height, width) grey or (height, width, 3) RGB in the drawing's pixels."""
        height, width = self.frame.shape
        return np.asarray(cv2.resize(self._fine, (width, height), interpolation=cv2.INTER_AREA), dtype=np.uint8)

    def _value(self, ink: str) -> tuple[int, ...]:
        """A colour as the sheet stores it."""
        red, green, blue = rgb(ink)
        return (red, green, blue) if self._colour else (round(0.299 * red + 0.587 * green + 0.114 * blue),)

    def _fixed(self, points_m: ArrayLike) -> NDArray[np.int32]:
        """Points as OpenCV wants them: fine pixels whose centres are whole numbers, with binary digits."""
        fine = self.frame.to_image(points_m) * FINER - 0.5
        return np.round(fine * (1 << _SHIFT)).astype(np.int32)


def ellipse(centre: ArrayLike, a: float, b: float, start: float = 0.0, end: float = 360.0) -> NDArray[np.float64]:
    """(N, 2) points of an ellipse with half axes a, b from one direction to another, degrees."""
    n_points = max(8, math.ceil(abs(end - start) / 5)) + 1
    angle = np.radians(np.linspace(start, end, n_points))
    return np.asarray(centre, dtype=np.float64) + np.column_stack([a * np.cos(angle), b * np.sin(angle)])


def fine_mask(frame: Frame, polygons: Iterable[ArrayLike]) -> NDArray[np.bool_]:
    """(4 height, 4 width) True inside convex polygons (metres): a fine pixel belongs to every polygon that holds its centre.

    Exact, unlike OpenCV's polygons, which include their rim: two walls that share a mitre leave no seam.
    """
    mask = np.zeros((frame.shape[0] * FINER, frame.shape[1] * FINER), dtype=bool)
    for polygon in polygons:
        corners = frame.to_image(polygon) * FINER
        left, top = np.maximum(np.floor(corners.min(axis=0)).astype(int), 0)
        right, bottom = np.maximum(np.ceil(corners.max(axis=0)).astype(int), 0)
        part = mask[top:bottom, left:right]
        y, x = np.ogrid[top : top + part.shape[0], left : left + part.shape[1]]
        inside = np.ones(part.shape, dtype=bool)
        following = np.roll(corners, -1, axis=0)
        turn = np.sign(np.sum(corners[:, 0] * following[:, 1] - following[:, 0] * corners[:, 1]))
        for (x0, y0), (x1, y1) in zip(corners, following, strict=True):
            inside &= turn * ((x1 - x0) * (y + 0.5 - y0) - (y1 - y0) * (x + 0.5 - x0)) >= -1e-6
        part |= inside
    return mask


def coverage(mask: NDArray[np.bool_]) -> NDArray[np.float64]:
    """(height, width) share of each pixel that a fine mask covers."""
    size = (mask.shape[1] // FINER, mask.shape[0] // FINER)
    each = np.uint8(240 // FINER**2 * FINER**2)  # the average of 16 pixels is a whole number, so nothing is rounded
    shares = cv2.resize(mask.view(np.uint8) * each, size, interpolation=cv2.INTER_AREA)
    return np.asarray(shares, dtype=np.float64) / float(each)


def rgb(colour: str) -> tuple[int, int, int]:
    """Red, green, blue of "#rrggbb".

    >>> rgb("#0080ff")
    (0, 128, 255)
    """
    if len(colour) == 7 and colour[0] == "#" and set(colour[1:].lower()) <= set("0123456789abcdef"):
        return int(colour[1:3], 16), int(colour[3:5], 16), int(colour[5:], 16)
    raise ValueError(f"a colour must be written #rrggbb, got {colour!r}")
