"""A picture and the words for those who do not see it."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.core.picture import encode_png


class Picture:
    """PNG or SVG bytes with an alternative text; a `Screen` shows it.

    Parameters
    ----------
    width : CSS pixels on the screen, 0 = as large as the image

    Attributes
    ----------
    image, mime, alt : what `show` or `show_svg` made

    >>> picture = Picture(width=300)
    >>> picture.show(np.full((2, 3), 255, dtype=np.uint8), alt="an empty map")
    >>> picture
    Picture(image/png: an empty map)
    """

    def __init__(self, width: int = 0) -> None:
        self.width = width
        self.image, self.mime, self.alt = b"", "image/png", ""

    def show(self, pixels: NDArray[np.uint8], alt: str) -> None:
        """Show a grey (height, width) or RGB (height, width, 3) image."""
        if 0 < self.width < pixels.shape[1]:  # no wider than it is shown: thin walls stay visible, and less has to travel
            size = (self.width, max(1, round(pixels.shape[0] * self.width / pixels.shape[1])))
            pixels = np.asarray(cv2.resize(pixels, size, interpolation=cv2.INTER_AREA), dtype=np.uint8)
        self.mime, self.image, self.alt = "image/png", encode_png(pixels), alt

    def show_svg(self, svg: str, alt: str) -> None:
        """Show a line drawing."""
        self.mime, self.image, self.alt = "image/svg+xml", svg.encode(), alt

    def __repr__(self) -> str:
        return f"Picture({self.mime}: {self.alt})"
