"""Line weight: how thick is the stroke that a pixel of ink belongs to?"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.drawing.runs import grow_along, label_runs, run_lengths
from priorlab.drawing.valleys import valleys

FAINTEST = 25
"""Darkness below this does not belong to a line."""

HALF = 0.45
"""Of a pixel that a line covers half, so much of full darkness is left at least."""


def half_covered(darkness: NDArray[np.uint8], ink: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Pixels about half as dark as full ink: half of them, or more, is covered by a line."""
    return darkness >= (HALF * np.percentile(darkness[ink], 98) if ink.any() else 255)


def stroke_widths(ink: NDArray[np.bool_], largest: int = 24) -> NDArray[np.uint8]:
    """Side of the largest square of ink that covers each pixel, up to `largest` (a granulometry).

    >>> ink = np.zeros((6, 8), dtype=bool); ink[1] = True; ink[3:6, 2:7] = True
    >>> stroke_widths(ink).max(axis=1).tolist()
    [0, 1, 0, 3, 3, 3]
    """
    widths = ink.astype(np.uint8)
    for side in range(2, largest + 1):
        covered = opened(ink, side)
        if not covered.any():
            break
        widths[covered] = side
    return widths


def line_weights(darkness: NDArray[np.uint8], ink: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Weight of the line through each pixel in parts of a pixel: the darkness summed across it, over full darkness.

    Anti-aliasing spreads a line over more pixels and keeps this sum; the smaller of the sums along the two axes counts.

    >>> darkness = np.zeros((3, 5), dtype=np.uint8); darkness[0] = 255; darkness[1] = 51
    >>> line_weights(darkness, darkness > 100)[0].round(2).tolist()
    [1.2, 1.2, 1.2, 1.2, 1.2]
    """
    if not ink.any():
        return np.zeros(ink.shape)
    full = float(np.percentile(darkness[ink], 98))
    touched = (darkness > FAINTEST) & ~valleys(darkness)
    sums = []
    for axis in (0, 1):
        labels = label_runs(touched, axis)
        total = np.bincount(labels.ravel(), weights=darkness.ravel())
        sums.append(total[labels])
    return np.where(touched, np.minimum(*sums), 0.0) / full


def opened(ink: NDArray[np.bool_], side: int) -> NDArray[np.bool_]:
    """Ink that a square of `side` pixels fits into.

    The anchor of the dilation is the reflected anchor of the erosion: with an even side `cv2.MORPH_OPEN` would leak.
    """
    if side > min(ink.shape):
        return np.zeros_like(ink)
    square = np.ones((side, side), np.uint8)
    low, high = (0, 0), (side - 1, side - 1)
    eroded = cv2.erode(ink.astype(np.uint8), square, anchor=low, borderType=cv2.BORDER_CONSTANT, borderValue=0)
    return np.asarray(cv2.dilate(eroded, square, anchor=high), dtype=bool)


def disc(side: int) -> NDArray[np.uint8]:
    """Structuring element: the pixels of a disc about `side` pixels wide, the same turned and mirrored.

    `cv2.MORPH_ELLIPSE` is wider than high, and a turned sheet would be read otherwise.

    >>> disc(4).tolist()
    [[0, 0, 1, 0, 0], [0, 1, 1, 1, 0], [1, 1, 1, 1, 1], [0, 1, 1, 1, 0], [0, 0, 1, 0, 0]]
    """
    radius = side // 2
    along = np.arange(-radius, radius + 1) ** 2
    return (along[:, None] + along[None, :] <= radius**2).astype(np.uint8)


def thinner_run(mask: NDArray[np.bool_]) -> NDArray[np.int32]:
    """The shorter of the horizontal and the vertical run through every pixel: how thick a wall is there."""
    return np.minimum(run_lengths(mask, 0), run_lengths(mask, 1))


def common_thickness(mask: NDArray[np.bool_]) -> float:
    """The commonest wall thickness by area, pixels; 0 of nothing.

    >>> mask = np.zeros((20, 40), dtype=bool); mask[2:8] = True; mask[12] = True
    >>> common_thickness(mask)
    6.0
    """
    thickness = thinner_run(mask)[mask]
    return float(np.bincount(thickness).argmax()) if thickness.size else 0.0


def common_weight(weights: NDArray[np.float64], mask: NDArray[np.bool_]) -> float:
    """Half of a mask's lines, by their length, are no heavier than this; 0 of nothing.

    >>> weights = np.zeros((9, 10)); weights[0] = 1.0; weights[2] = 1.2; weights[4:8] = 4.0
    >>> float(common_weight(weights, weights > 0)), float(common_weight(weights, weights > 2))
    (1.2, 4.0)
    """
    found = np.sort(weights[mask & (weights > 0)])
    if not found.size:
        return 0.0
    length = np.cumsum(1.0 / np.maximum(found, FAINTEST / 255))
    return float(found[np.searchsorted(length, length[-1] / 2)])


def strip_strokes(mask: NDArray[np.bool_], share: float) -> NDArray[np.bool_]:
    """Walls without the strokes that hang on them: nothing thinner than a share of the commonest thickness stays.

    >>> mask = np.zeros((20, 40), dtype=bool); mask[2:8] = True; mask[8:, 5] = True
    >>> strip_strokes(mask, 0.5)[:, 5].sum()
    np.int64(6)
    """
    side = int(np.ceil(share * common_thickness(mask)))
    return opened(mask, side) if side > 1 else mask


def bridge_windows(walls: NDArray[np.bool_], ink: NDArray[np.bool_], longest: float) -> NDArray[np.bool_]:
    """Ink of windows: thin dark runs of at most `longest` pixels that join two pieces of wall along an axis.

    Parameters
    ----------
    walls : (height, width) bool, what was kept
    ink : (height, width) bool, all ink
    longest : pixels
    """
    rest = ink & ~walls
    found = np.zeros_like(walls)
    for axis in (0, 1):
        before, after = _neighbours(walls, axis)
        short = rest & (run_lengths(rest, axis) <= longest)
        found |= grow_along(short & before, short, axis) & grow_along(short & after, short, axis)
    return found


def _neighbours(mask: NDArray[np.bool_], axis: int) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Where the pixel before, and where the pixel after, along an axis is in the mask."""
    before, after = np.zeros_like(mask), np.zeros_like(mask)
    if axis == 1:
        before[:, 1:], after[:, :-1] = mask[:, :-1], mask[:, 1:]
    else:
        before[1:], after[:-1] = mask[:-1], mask[1:]
    return before, after
