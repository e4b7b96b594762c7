"""The pixels of an image file: header first, transparent over white, 8 bits a channel, upright."""

from __future__ import annotations

import contextlib
import struct
import warnings
import zlib
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageOps

from priorlab.core.files import MAX_PIXELS

FORMATS = ("PNG", "JPEG", "BMP", "TIFF")
"""What is read, told by content and not by suffix; of a file with several pages the first."""

KINDS = f"{', '.join(FORMATS[:-1])} or {FORMATS[-1]}"

_BROKEN = (OSError, SyntaxError, ValueError, EOFError, IndexError, KeyError, TypeError, struct.error, zlib.error)
"""What Pillow raises on a file that is damaged, by the place of the damage."""

_BAND = 512
"""Rows that are composed over white at a time: a 200 megapixel image must not need its size four times over."""


def read_pixels(path: Path) -> NDArray[np.uint8]:
    """The drawing as it should be seen: (height, width) grey or (height, width, 3) RGB.

    The size is taken from the header, before anything is decoded. Transparent parts show white paper. The rotation
    that a camera noted (EXIF) is applied.

    Raises
    ------
    FileNotFoundError
        When there is no file.
    ValueError
        When it is a folder, empty, not a PNG, JPEG, BMP or TIFF, broken, too large or too small.
    """
    image = open_image(path, "the drawing", FORMATS)
    if min(image.size) < 2:
        raise ValueError(f"the drawing must be at least 2 x 2 pixels, got {image.size[0]} x {image.size[1]}")
    if image.mode.startswith("I;16"):
        deep = np.asarray(image)
        grey = ((deep.astype(np.uint32) + 128) // 257).astype(np.uint8)  # 65535 -> 255, rounded
        if isinstance(image.info.get("transparency"), int):
            grey[deep == image.info["transparency"]] = 255
        return grey
    if image.mode in ("I", "F"):
        raise ValueError(f"the drawing must have 1, 8 or 16 bits a channel, got 32 in {path}")
    if image.has_transparency_data:
        return _over_white(image)
    return np.asarray(image if image.mode == "L" else image.convert("L" if image.mode == "1" else "RGB"))


def open_image(path: Path, what: str, formats: tuple[str, ...]) -> Image.Image:
    """A whole, upright Pillow image of one of Pillow's `formats`; sentences call it `what` ("the drawing")."""
    if not path.exists():
        raise FileNotFoundError(f"{what} must be a file, found nothing at {path}")
    if not path.is_file():
        raise ValueError(f"{what} must be a file, got the folder {path}")
    if path.stat().st_size == 0:
        raise ValueError(f"{what} must be an image, got an empty file: {path}")
    with path.open("rb") as stream, _pillow_on_our_terms():
        try:
            image = Image.open(stream, formats=formats)
        except _BROKEN:
            kinds = f"{', '.join(formats[:-1])} or {formats[-1]}"
            raise ValueError(f"{what} must be a whole {kinds} image, got something else or a broken start: {path}") from None
        width, height = image.size
        if width * height > MAX_PIXELS:
            limit, got = MAX_PIXELS // 10**6, width * height / 1e6
            raise ValueError(f"{what} must have at most {limit} megapixels, got {width} x {height} = {got:.1f} megapixels")
        try:
            image.load()
            ImageOps.exif_transpose(image, in_place=True)
        except _BROKEN as broken:
            raise ValueError(f"{what} must be a whole image, got a broken or cut-off file: {path} ({broken})") from None
        return image


def _over_white(image: Image.Image) -> NDArray[np.uint8]:
    """What is seen when a partly transparent image lies on white paper, as RGB."""
    width, height = image.size
    seen = np.empty((height, width, 3), dtype=np.uint8)
    for top in range(0, height, _BAND):
        bottom = min(top + _BAND, height)
        band = image.crop((0, top, width, bottom))
        band.info = image.info  # the transparent colour of a palette
        rgba = np.asarray(band.convert("RGBA")).astype(np.uint16)
        alpha = rgba[..., 3:]
        seen[top:bottom] = (rgba[..., :3] * alpha + 255 * (255 - alpha) + 127) // 255
    return seen


@contextlib.contextmanager
def _pillow_on_our_terms() -> Iterator[None]:
    """Our limit instead of Pillow's own, and no remarks on notes beside the pixels; damaged pixels still raise.

    Pillow keeps its limit (a warning at 89, a refusal at 179 megapixels) in a global: it is put aside and back.
    """
    before = Image.MAX_IMAGE_PIXELS
    Image.MAX_IMAGE_PIXELS = None
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)
            yield
    finally:
        Image.MAX_IMAGE_PIXELS = before
