"""Deskew: by how much was a sheet laid askew on the glass, and the way to straight pixels and back."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray

LEAST_TURN = 0.25
"""A sheet within so many degrees of straight is left as it is."""

LARGEST_TURN = 15.0
"""No sheet is laid more askew than this, degrees; steeper lines belong to a building drawn at an angle."""

SHORTEST_SHARE = 0.02
"""Segments shorter than this share of the long side are text and symbols."""

BIN = 0.1
"""Width of a bin of the histogram of angles, degrees."""

PEAK_WIDTH = 0.6
"""Segments within so many degrees of a peak belong to it."""

PEAK_SHARE = 0.25
"""So much of the length of all segments lies in the peak when a sheet is askew."""

STRAIGHT_SHARE = 0.2
"""A sheet with so much straight length, as a share of the peak's, is not askew: a wing of the building is."""

WING_OFF = 2.0
"""Walls within so many degrees of an axis stand along it."""

WING_SHARE = 0.04
"""So much of the length of all outlines has the angle of a wing."""

MOST_WINGS = 2
"""Angles of wings that are told apart."""


@dataclass(frozen=True, eq=False)
class Turn:
    """A rotation of the image about its middle, onto a sheet large enough for all of it, or for the part that was cut out.

    Parameters
    ----------
    degrees : counter-clockwise as one sees it
    from_shape, to_shape : (height, width) before and after
    matrix : (2, 3), takes (x, y, 1) of the image that came in to the straight one, pixel centres at whole numbers
    """

    degrees: float
    from_shape: tuple[int, int]
    to_shape: tuple[int, int]
    matrix: NDArray[np.float64]

    def points(self, points: ArrayLike) -> NDArray[np.float64]:
        """(N, 2) points x, y in the turned image."""
        xy = np.asarray(points, dtype=np.float64).reshape(-1, 2)
        return xy @ self.matrix[:, :2].T + self.matrix[:, 2]

    def points_back(self, points: ArrayLike) -> NDArray[np.float64]:
        """(N, 2) points of the turned image in the one that came in."""
        xy = np.asarray(points, dtype=np.float64).reshape(-1, 2) - self.matrix[:, 2]
        return xy @ self.matrix[:, :2]  # the inverse of a rotation is its transpose

    def image(self, image: NDArray[np.uint8]) -> NDArray[np.uint8]:
        """A grey or colour image, turned; the corners that appear have the paper's colour."""
        paper = np.median(image.reshape(-1, *image.shape[2:]), axis=0)
        fill = tuple(float(value) for value in np.atleast_1d(paper))
        height, width = self.to_shape
        turned = cv2.warpAffine(image, self.matrix, (width, height), flags=cv2.INTER_CUBIC, borderValue=fill)
        return np.asarray(turned, dtype=np.uint8)

    def mask_back(self, mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """A mask of the turned image in the pixels of the one that came in: at least half of a pixel is covered."""
        height, width = self.from_shape
        share = cv2.warpAffine(
            mask.astype(np.uint8) * 255, self.matrix, (width, height), flags=cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
        )
        return np.asarray(share >= 128)


def turn_by(degrees: float, shape: tuple[int, int]) -> Turn:
    """The rotation by an angle, counter-clockwise as one sees it.

    >>> turn = turn_by(90, (3, 5))
    >>> turn.to_shape, turn.points([(4, 1)]).round(6).tolist()
    ((5, 3), [[1.0, 0.0]])
    """
    height, width = shape
    cos, sin = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    to_width = int(np.ceil(width * abs(cos) + height * abs(sin) - 1e-9))
    to_height = int(np.ceil(width * abs(sin) + height * abs(cos) - 1e-9))
    turn = np.array([[cos, sin], [-sin, cos]])  # y down
    middle, to_middle = np.array([width - 1, height - 1]) / 2, np.array([to_width - 1, to_height - 1]) / 2
    matrix = np.column_stack([turn, to_middle - turn @ middle])
    return Turn(float(degrees), shape, (to_height, to_width), matrix)


def then_cut(turn: Turn, left: int, top: int, width: int, height: int) -> Turn:
    """A turn, and of what it gives only a rectangle, pixels.

    >>> then_cut(turn_by(0, (100, 200)), 50, 20, 60, 40).points([(50, 20)]).tolist()
    [[0.0, 0.0]]
    """
    matrix = turn.matrix.copy()
    matrix[:, 2] -= (left, top)
    return Turn(turn.degrees, turn.from_shape, (height, width), matrix)


def find_skew(grey: NDArray[np.uint8]) -> float:
    """Angle by which the lines of a sheet lean, degrees counter-clockwise as one sees it; 0 for a straight one.

    The angles of all line segments (LSD) modulo 90 degrees are weighted by their length. A sheet is askew when they agree on
    one small angle, and hardly any is straight: where many are, the paper is straight and a wing of the building leans.

    Parameters
    ----------
    grey : (height, width) uint8

    >>> sheet = np.full((200, 300), 255, dtype=np.uint8)
    >>> _ = cv2.rectangle(sheet, (50, 50), (250, 150), 0, 2)
    >>> find_skew(sheet)
    0.0
    >>> 2.8 < find_skew(turn_by(3, sheet.shape).image(sheet)) < 3.2
    True
    """
    angles, lengths = _segments(grey)
    if not len(angles):
        return 0.0
    near = np.abs(angles) <= LARGEST_TURN
    if not near.any():
        return 0.0
    peak = _peak(angles[near], lengths[near])
    at_peak = np.abs(angles - peak) <= PEAK_WIDTH
    agreed = lengths[at_peak].sum()
    if abs(peak) < LEAST_TURN or agreed < PEAK_SHARE * lengths.sum():
        return 0.0
    if abs(peak) > 2 * PEAK_WIDTH:  # nearer, the two groups are one
        straight = lengths[np.abs(angles) <= PEAK_WIDTH].sum()
        if straight > STRAIGHT_SHARE * agreed:
            return 0.0
    return float(peak)


def wing_angles(walls: NDArray[np.bool_]) -> list[float]:
    """Angles off the axes at which parts of a building stand, degrees counter-clockwise as one sees it, longest first.

    Parameters
    ----------
    walls : (height, width) bool, whose outlines are looked at

    >>> wing = np.zeros((200, 300), dtype=np.uint8)
    >>> _ = cv2.rectangle(wing, (20, 20), (120, 120), 1, 5), cv2.line(wing, (120, 60), (280, 140), 1, 5)
    >>> [round(angle) for angle in wing_angles(wing > 0)]
    [-27]
    """
    angles, lengths = _segments(np.where(walls, 0, 255).astype(np.uint8))
    found: list[float] = []
    off = np.abs(angles) > WING_OFF
    while len(found) < MOST_WINGS and lengths[off].sum() >= WING_SHARE * lengths.sum() > 0:
        near = np.abs((angles[:, None] - angles[off] + 45) % 90 - 45) <= 2 * PEAK_WIDTH
        agreed = lengths @ near
        if agreed.max() < WING_SHARE * lengths.sum():
            break
        best = near[:, agreed.argmax()]
        one = angles[off][agreed.argmax()]
        found.append(float(one + np.average((angles[best] - one + 45) % 90 - 45, weights=lengths[best])))
        off &= ~best
    return found


def _segments(grey: NDArray[np.uint8]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Angles of the line segments in -45 to 45 degrees, counter-clockwise as one sees it, and their lengths in pixels."""
    if min(grey.shape) < 16:
        return np.empty(0), np.empty(0)
    found: Any = cv2.createLineSegmentDetector(cv2.LSD_REFINE_STD).detect(grey)[0]
    if found is None:
        return np.empty(0), np.empty(0)
    ends = found.reshape(-1, 4).astype(np.float64)  # OpenCV 4 has one more axis than 5
    across, down = (ends[:, 2:] - ends[:, :2]).T
    lengths = np.hypot(across, down)
    long = lengths >= max(12.0, SHORTEST_SHARE * max(grey.shape))
    angles = (np.degrees(np.arctan2(-down, across)) + 45.0) % 90.0 - 45.0
    return angles[long], lengths[long]


def _peak(angles: NDArray[np.float64], lengths: NDArray[np.float64]) -> float:
    """The angle that most length agrees on: the top of a smoothed histogram, then the weighted median round it."""
    n_bins = round(2 * LARGEST_TURN / BIN) + 1
    bins = np.clip(np.rint((angles + LARGEST_TURN) / BIN).astype(int), 0, n_bins - 1)
    counts = np.bincount(bins, weights=lengths, minlength=n_bins)
    smooth = np.convolve(counts, np.ones(5), mode="same")
    top = float(smooth.argmax()) * BIN - LARGEST_TURN
    close = np.abs(angles - top) <= PEAK_WIDTH
    order = np.argsort(angles[close])
    total = np.cumsum(lengths[close][order])
    return float(angles[close][order][np.searchsorted(total, total[-1] / 2)])
