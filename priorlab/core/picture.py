"""P(empty) as a picture: white = empty, black = wall; PNG bytes for notebooks, reports and files."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray

_QUICK = (
    [cv2.IMWRITE_PNG_COMPRESSION, 1, cv2.IMWRITE_PNG_FILTER, cv2.IMWRITE_PNG_FILTER_NONE]
    if hasattr(cv2, "IMWRITE_PNG_FILTER")
    else []
)
"""Maps are flat: unfiltered they take half the bytes of OpenCV's own choice, in less time. OpenCV before 4.12 offers no choice,
and to name level 1 there makes it try every filter on every row, which takes three times as long."""


def grey_of(p_empty: ArrayLike) -> NDArray[np.uint8]:
    """Probabilities (or booleans "is empty") as grey values, 255 P(empty), rounded.

    >>> grey_of([[0.0, 0.5, 1.0]]).tolist()
    [[0, 128, 255]]
    """
    return np.rint(np.asarray(p_empty, dtype=np.float32) * np.float32(255)).clip(0, 255).astype(np.uint8)


def encode_png(image: NDArray[np.uint8], compression: int = 1) -> bytes:
    """PNG bytes of a grey (height, width) or RGB (height, width, 3) image."""
    if image.dtype != np.uint8 or image.ndim not in (2, 3) or image.size == 0:
        raise ValueError(f"image must be a non-empty uint8 picture, got {image.dtype} of shape {image.shape}")
    if image.ndim == 3:
        image = np.asarray(cv2.cvtColor(image, cv2.COLOR_RGB2BGR), dtype=np.uint8)  # OpenCV keeps blue first
    ok, png = cv2.imencode(".png", image, _QUICK if compression == 1 else [cv2.IMWRITE_PNG_COMPRESSION, compression])
    if not ok:
        raise ValueError(f"the image of shape {image.shape} could not be encoded as PNG")
    return png.tobytes()
