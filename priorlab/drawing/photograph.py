"""Is it a drawing at all? A photograph has areas whose tone changes from place to place; paper and fillings have not."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

LOOKED_AT = 500
"""Long side that an image is reduced to before it is judged, pixels: grain goes, tones stay."""

SMALLEST = 60
"""Images with a shorter short side are not judged, pixels."""

SHADE = 0.88
"""A tone below this share of the paper's round it is none of the paper."""

AREA = 7
"""An area is wider than a line when a square of so many pixels fits into it, after reduction."""

RANGE = (3.0, 30.0)
"""Standard deviation of the greys in such a square: below it is a filling, above it is drawn."""

MOST = 0.13
"""Drawings and scans had up to 0.03 of their area in changing tones, photographs from 0.15."""


PAPER_WINDOW = 25
"""A sheet's paper lies within so many grey levels."""

LEAST_PAPER = 0.2
"""The commonest tones of a drawing, as many as `PAPER_WINDOW`, hold at least this share of it; of unevenly lit scans 0.47."""


def is_photograph(grey: NDArray[np.uint8]) -> bool:
    """True when too much of an image has continuous tones to be a drawing, or no tone is common enough to be paper.

    >>> is_photograph(np.full((100, 100), 255, dtype=np.uint8))
    False
    """
    return continuous_share(grey) > MOST or paper_share(grey) < LEAST_PAPER


def paper_share(grey: NDArray[np.uint8]) -> float:
    """Share of an image in the commonest tones that follow one another: its paper, where it has one.

    >>> round(paper_share(np.arange(256, dtype=np.uint8).reshape(16, 16)), 2)
    0.1
    """
    counts = np.bincount(grey.ravel(), minlength=256)
    return float(np.convolve(counts, np.ones(PAPER_WINDOW), mode="valid").max() / grey.size)


def continuous_share(grey: NDArray[np.uint8]) -> float:
    """Share of an image that lies in areas, wider than a line, whose tone is not the paper's and changes from place to place.

    Parameters
    ----------
    grey : (height, width) uint8
    """
    shrink = max(1.0, max(grey.shape) / LOOKED_AT)
    if min(grey.shape) / shrink < SMALLEST:
        return 0.0
    small = cv2.resize(grey, None, fx=1 / shrink, fy=1 / shrink, interpolation=cv2.INTER_AREA) if shrink > 1 else grey
    light = 255 - small if np.median(small) < 128 else small
    soft = cv2.GaussianBlur(light, (0, 0), 1.0)
    side = max(3, round(0.06 * max(small.shape))) | 1
    paper = cv2.blur(cv2.dilate(soft, np.ones((side, side), np.uint8)), (side, side))  # a scan's paper changes slowly
    shaded = (soft < SHADE * paper.astype(np.float64)).astype(np.uint8)
    wide = cv2.morphologyEx(shaded, cv2.MORPH_OPEN, np.ones((AREA, AREA), np.uint8)).astype(bool)
    tones = light.astype(np.float64)
    variance = cv2.blur(tones**2, (AREA, AREA)) - cv2.blur(tones, (AREA, AREA)) ** 2
    return float((wide & (variance > RANGE[0] ** 2) & (variance < RANGE[1] ** 2)).mean())
