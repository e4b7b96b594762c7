"""A piece of a drawing, magnified, to paint on: whole pixels, triangles, crosses. Image pixels, y DOWN."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray

Colour = tuple[int, int, int]

BLUE, ORANGE, RED, GREEN, PINK, SKY = (0, 114, 178), (230, 159, 0), (213, 94, 0), (0, 158, 115), (204, 0, 120), (86, 180, 233)
"""Colours that colour-blind readers tell apart."""


class Canvas:
    """A window of a drawing, each pixel `zoom` times as large; faint, so that what is painted stands out.

    Parameters
    ----------
    grey : (height, width) uint8
    zoom : screen pixels per pixel of the drawing
    window : left, top, width, height, pixels of the drawing; all of it by default
    faint : share of its blackness that the ink loses

    >>> canvas = Canvas(np.zeros((4, 6), np.uint8), zoom=2, faint=0.0)
    >>> canvas.fill([(1, 0)], RED)
    >>> canvas.picture.shape, canvas.picture[0, 2].tolist(), canvas.picture[0, 4].tolist()
    ((8, 12, 3), [213, 94, 0], [0, 0, 0])
    """

    def __init__(
        self, grey: NDArray[np.uint8], zoom: int = 1, window: tuple[int, int, int, int] | None = None, faint: float = 0.55
    ) -> None:
        left, top, width, height = window or (0, 0, grey.shape[1], grey.shape[0])
        self.zoom, self.left, self.top, self.size = zoom, left, top, (width, height)
        cut = np.full((height, width), 255, dtype=np.uint8)
        rows, cols = slice(max(top, 0), max(top + height, 0)), slice(max(left, 0), max(left + width, 0))
        inside = grey[rows, cols]
        below, beside = rows.start - top, cols.start - left
        paler = 255 - (1 - faint) * (255 - np.arange(256, dtype=np.float32))
        cut[below : below + inside.shape[0], beside : beside + inside.shape[1]] = paler.astype(np.uint8)[inside]
        self.picture = np.asarray(cv2.cvtColor(self._large(cut), cv2.COLOR_GRAY2RGB), dtype=np.uint8)

    def fill(self, points: ArrayLike, colour: Colour, strength: float = 1.0) -> None:
        """Colour whole pixels, (P, 2) x and y; what lies outside the window is left out."""
        xy = np.rint(np.asarray(points, dtype=np.float64).reshape(-1, 2)).astype(int) - [self.left, self.top]
        mask = np.zeros(self.size[::-1], dtype=bool)
        xy = xy[((xy >= 0) & (xy < self.size)).all(axis=1)]
        mask[xy[:, 1], xy[:, 0]] = True
        self.tint(mask, colour, strength)

    def tint(self, mask: NDArray[np.bool_], colour: Colour, strength: float = 1.0) -> None:
        """Colour the pixels of a mask as large as the window."""
        rows, cols = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
        if not rows.size:
            return
        (top, bottom), (left, right) = (rows[0], rows[-1] + 1), (cols[0], cols[-1] + 1)
        part = self.picture[top * self.zoom : bottom * self.zoom, left * self.zoom : right * self.zoom]
        _mix(part, self._large(mask[top:bottom, left:right].astype(np.uint8)) > 0, colour, strength)

    def triangle(self, vertices: ArrayLike, colour: Colour, width: int = 2, strength: float = 0.0) -> None:
        """Draw a triangle through three points x, y, and tint its inside."""
        corners = self._at(vertices)
        if strength:
            (left, top), (right, bottom) = corners.min(axis=0).clip(0).tolist(), (corners.max(axis=0) + 1).clip(0).tolist()
            part = self.picture[top:bottom, left:right]
            inside = np.zeros(part.shape[:2], np.uint8)
            if inside.size:
                cv2.fillPoly(inside, [corners - [left, top]], 1)
                _mix(part, inside > 0, colour, strength)
        cv2.polylines(self.picture, [corners], True, colour, width, cv2.LINE_AA)

    def line(self, points: ArrayLike, colour: Colour, width: int = 2) -> None:
        """Draw a line through points x, y."""
        cv2.polylines(self.picture, [self._at(points)], False, colour, width, cv2.LINE_AA)

    def dot(self, point: ArrayLike, colour: Colour, radius: int = 5) -> None:
        """Draw a dot with a white rim."""
        x, y = self._at(point)[0].tolist()
        cv2.circle(self.picture, (x, y), radius + 1, (255, 255, 255), -1, cv2.LINE_AA)
        cv2.circle(self.picture, (x, y), radius, colour, -1, cv2.LINE_AA)

    def crosses(self, points: ArrayLike, colour: Colour, size: int = 7, width: int = 1) -> None:
        """Mark points x, y."""
        for x, y in self._at(points).tolist():
            cv2.drawMarker(self.picture, (x, y), colour, cv2.MARKER_CROSS, size, width)

    def ring(self, point: ArrayLike, colour: Colour, width: int = 2) -> None:
        """Draw the border of one pixel."""
        x, y = (np.rint(np.asarray(point, dtype=np.float64)).astype(int) - [self.left, self.top]).tolist()
        corner, opposite = (x * self.zoom, y * self.zoom), ((x + 1) * self.zoom - 1, (y + 1) * self.zoom - 1)
        cv2.rectangle(self.picture, corner, opposite, colour, width)

    def _large(self, pixels: NDArray[np.uint8]) -> NDArray[np.uint8]:
        """Each pixel `zoom` times as large."""
        size = (pixels.shape[1] * self.zoom, pixels.shape[0] * self.zoom)
        return np.asarray(cv2.resize(pixels, size, interpolation=cv2.INTER_NEAREST), dtype=np.uint8)

    def _at(self, points: ArrayLike) -> NDArray[np.int32]:
        """Where the centres of pixels lie on the picture."""
        xy = np.asarray(points, dtype=np.float64).reshape(-1, 2) - [self.left, self.top] + 0.5
        return np.rint(xy * self.zoom).astype(np.int32)


def _mix(picture: NDArray[np.uint8], mask: NDArray[np.bool_], colour: Colour, strength: float) -> None:
    """Colour the pixels of a mask in place, wholly or in part."""
    if strength == 1:
        picture[mask] = colour
    else:
        picture[mask] = ((1 - strength) * picture[mask] + strength * np.array(colour)).astype(np.uint8)


def window_round(points: ArrayLike, margin: float) -> tuple[int, int, int, int]:
    """left, top, width, height of a square window round points x, y, with a margin on every side.

    >>> window_round([(10, 20), (30, 24)], margin=5)
    (5, 7, 31, 31)
    """
    xy = np.asarray(points, dtype=np.float64).reshape(-1, 2)
    low, high = xy.min(axis=0), xy.max(axis=0)
    side = int(np.ceil((high - low).max() + 2 * margin)) + 1
    left, top = np.floor((low + high) / 2 - (side - 1) / 2).astype(int).tolist()
    return left, top, side, side
