"""Pictures of a report: a drawn figure as PNG inside the page, with the sentence for who cannot see it."""

from __future__ import annotations

import base64
import io
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import NDArray
from PIL import Image

DOTS_PER_INCH = 120
WHOLE_PAGE = 8.0
"""Figures wider than this many inches stand alone in their row."""
STYLE: Any = {"font.size": 10, "axes.titlesize": 10, "axes.labelsize": 9, "xtick.labelsize": 8, "ytick.labelsize": 8}


@dataclass(frozen=True)
class Picture:
    """PNG bytes, what they show in one sentence, and the line below them."""

    png: bytes
    alt: str
    caption: str
    wide: bool = False

    @property
    def data_uri(self) -> str:
        """The picture as an address that needs no file and no network."""
        return "data:image/png;base64," + base64.b64encode(self.png).decode()


def picture(draw: Callable[[Axes], object], alt: str, caption: str, size: tuple[float, float], wide: bool = False) -> Picture:
    """Draw on a new figure of `size` inches; pyplot's list of open figures is left alone. `wide` takes the page's whole width."""
    with matplotlib.rc_context(STYLE):
        figure = Figure(figsize=size, dpi=DOTS_PER_INCH, layout="constrained")
        canvas = FigureCanvasAgg(figure)
        draw(figure.add_subplot())
        canvas.draw()
        pixels = np.asarray(canvas.buffer_rgba())[..., :3]
    return Picture(_as_png(_without_margin(pixels)), alt, caption, wide or size[0] > WHOLE_PAGE)


def is_long(shape: tuple[int, int]) -> bool:
    """True for a drawing that needs the whole width of the page."""
    return shape[1] > 2 * shape[0]


def size_for(shape: tuple[int, int], tallest: float = 7.5) -> tuple[float, float]:
    """Inches for a picture that lies on a drawing: its proportions and room for the axes."""
    width = 10.5 if is_long(shape) else 6.4
    height = width * shape[0] / shape[1]
    if height > tallest:
        width, height = max(width * tallest / height, 3.2), tallest
    return width, height + 0.7


def _without_margin(pixels: NDArray[np.uint8], left: int = 10) -> NDArray[np.uint8]:
    """The picture without the white around it, but for `left` pixels."""
    rows, cols = (np.flatnonzero((pixels < 255).any(axis=(axis, 2))) for axis in (1, 0))
    top, side = max(rows[0] - left, 0), max(cols[0] - left, 0)
    return pixels[top : rows[-1] + left + 1, side : cols[-1] + left + 1]


def _as_png(pixels: NDArray[np.uint8]) -> bytes:
    """PNG in 256 colours: a third of the bytes."""
    image = Image.fromarray(pixels).quantize(256, method=Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE)
    png = io.BytesIO()
    image.save(png, format="PNG", compress_level=6)
    return png.getvalue()
