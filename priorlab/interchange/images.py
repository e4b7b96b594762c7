"""An image file becomes a Drawing."""

from __future__ import annotations

import math
import os
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import check_positive
from priorlab.core.drawing import Drawing
from priorlab.core.files import WORKING_PIXELS
from priorlab.interchange.pixels import KINDS, read_pixels

_HUE = 32
"""A pixel has a hue when its strongest and weakest channel differ by more; yellowed paper and JPEG's fringes do not."""

_HUED_SHARE = 1e-3
"""A drawing is a coloured one when more of it than this has a hue: thin coloured lines cover several times as much."""


def read_drawing(path: str | os.PathLike[str], metres_per_pixel: float | None = None) -> Drawing:
    """Read a drawing from a PNG, JPEG, BMP or TIFF file.

    Transparent parts become white paper, the camera's rotation is applied, and the colours are kept only when there
    are some. An image above 16 megapixels is reduced to that by averaging areas; `reduced_by` of the result says by
    how much (1 = as it came), and a given scale grows with it. Above 200 megapixels it is refused from its header.

    Parameters
    ----------
    path : the file; its content decides what it is, not its suffix
    metres_per_pixel : scale of the FILE's pixels, or None when it is not known

    Returns
    -------
    Drawing, named after the file

    Raises
    ------
    FileNotFoundError
        When there is no such file.
    ValueError
        When it is no image, broken, of one colour, too small or too large.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = cv2.imwrite(f"{folder}/flat.png", np.array([[0, 255, 255], [0, 255, 255]], np.uint8))
    ...     read_drawing(f"{folder}/flat.png", metres_per_pixel=0.02)
    Drawing(flat: 3 x 2 px, 0.02 m per pixel)
    """
    path = Path(path)
    if metres_per_pixel is not None:
        metres_per_pixel = check_positive("metres_per_pixel", metres_per_pixel)
    _check_not_vectors(path)
    pixels, reduced_by = _reduced(read_pixels(path))
    if (pixels == pixels[0, 0]).all():
        raise ValueError(f"the drawing must show something, got an image of one colour: {path}")
    grey = pixels if pixels.ndim == 2 else np.asarray(cv2.cvtColor(pixels, cv2.COLOR_RGB2GRAY), dtype=np.uint8)
    return Drawing(
        grey=grey,
        colour=pixels if pixels.ndim == 3 and _has_hues(pixels) else None,
        metres_per_pixel=None if metres_per_pixel is None else metres_per_pixel * reduced_by,
        name=path.stem,
        reduced_by=reduced_by,
    )


def _check_not_vectors(path: Path) -> None:
    """Say that a PDF or DXF has to be exported as an image first."""
    if path.is_file():
        with path.open("rb") as stream:
            start = stream.read(1024)
        kind = "PDF" if b"%PDF-" in start else "DXF" if path.suffix.lower() in (".dxf", ".dwg") else None
        if kind:
            raise ValueError(f"the drawing must be a {KINDS} image, got a {kind} file: export {path} as a PNG first")


def _reduced(pixels: NDArray[np.uint8]) -> tuple[NDArray[np.uint8], float]:
    """At most `WORKING_PIXELS` pixels, each the mean of its area, and the factor."""
    height, width = pixels.shape[:2]
    if height * width <= WORKING_PIXELS:
        return pixels, 1.0
    factor = math.sqrt(height * width / WORKING_PIXELS)
    size = (max(int(width / factor), 2), max(int(height / factor), 2))
    factor = max(width, height) / max(size)
    return np.asarray(cv2.resize(pixels, size, interpolation=cv2.INTER_AREA), dtype=np.uint8), factor


def _has_hues(rgb: NDArray[np.uint8]) -> bool:
    """True when the colours of a drawing say something."""
    red, green, blue = cv2.split(rgb)
    strongest = cv2.max(cv2.max(red, green), blue)
    weakest = cv2.min(cv2.min(red, green), blue)
    return bool(np.count_nonzero(cv2.subtract(strongest, weakest) > _HUE) > _HUED_SHARE * strongest.size)
