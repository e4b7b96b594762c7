"""Painted drawings: ink lies over pale tones that fill rooms, and is told from them as from white paper."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

FLAT = 8
"""Paint differs by no more from pixel to pixel, of 255."""

ROOM = 0.03
"""A painted room is as wide as this share of the long side, everywhere wider than lines."""

PATCH = 5
"""Where rooms are painted, every pale patch that holds a square of so many pixels is: closets and openings."""

TONE = 24
"""Paint differs so much from the paper, of 255."""

SHARE = 0.05
"""A drawing is painted when rooms make up so much of it."""

DARKER = 60
"""Closets and openings are darker than the darkest room by no more than this, of 255."""

PALE = 0.5
"""Paint is at most so far from the paper as the darkest ink."""


def without_paint(image: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """A drawing on white instead of painted rooms; the same image when no room is painted.

    What is drawn takes its share of the light that the paint below it gives back: a pixel over the colour of the nearest patch.

    Parameters
    ----------
    image : (height, width, 3) uint8

    >>> image = np.full((100, 100, 3), 255, dtype=np.uint8); image[:, 50:] = 180; image[:, 48:52] = 0; image[:, 52] = 90
    >>> without_paint(image)[50, [10, 48, 51, 52, 90], 0].tolist()
    [255, 0, 0, 128, 255]
    """
    paper = local_paper(image)
    if paper is None:
        return image
    return np.asarray(np.rint(np.minimum(image.astype(np.float64) / np.maximum(paper, 1), 1) * 255), dtype=np.uint8)


def local_paper(image: NDArray[np.uint8]) -> NDArray[np.uint8] | None:
    """(height, width, 3) the colour of the paper or paint that each pixel lies on; None where no room is painted."""
    paper = np.median(image.reshape(-1, 3), axis=0).astype(np.uint8)
    apart = cv2.absdiff(image, np.broadcast_to(paper, image.shape).copy()).max(axis=2)
    square = np.ones((3, 3), np.uint8)
    flat = (cv2.dilate(image, square).astype(int) - cv2.erode(image, square)).max(axis=2) <= FLAT
    pale = flat & (apart <= PALE * apart.max())
    side = max(PATCH, round(ROOM * max(image.shape[:2])))
    rooms = cv2.morphologyEx(pale.astype(np.uint8), cv2.MORPH_OPEN, np.ones((side, side), np.uint8)).astype(bool)
    if (rooms & (apart >= TONE)).mean() < SHARE:
        return None
    pale &= apart <= apart[rooms].max() + DARKER  # what is darker than all rooms is a pale wall
    patches = cv2.erode(pale.astype(np.uint8), square).astype(bool)  # flat at its rim, too: a square of PATCH pixels
    _, nearest = cv2.distanceTransformWithLabels(
        (~patches).astype(np.uint8), cv2.DIST_L2, cv2.DIST_MASK_5, labelType=cv2.DIST_LABEL_PIXEL
    )
    colours = np.zeros((int(nearest.max()) + 1, 3), np.uint8)
    colours[nearest[patches]] = image[patches]
    return np.asarray(colours[nearest], dtype=np.uint8)
