"""Pictures of a report: a drawn figure as PNG inside the page, with the sentence for who cannot see it."""

from __future__ import annotations

import base64
import io
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import matplotlib
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

DOTS_PER_INCH = 120
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
    """Draw on a new figure of `size` inches; pyplot's list of open figures is left alone."""
    with matplotlib.rc_context(STYLE):
        figure = Figure(figsize=size, dpi=DOTS_PER_INCH, layout="constrained")
        FigureCanvasAgg(figure)
        draw(figure.add_subplot())
        raw = io.BytesIO()
        figure.savefig(raw, format="png", bbox_inches="tight", pad_inches=0.08)
    return Picture(_smaller(raw.getvalue()), alt, caption, wide)


def size_for(shape: tuple[int, int], width: float = 6.4, tallest: float = 7.5) -> tuple[float, float]:
    """Inches for a picture that lies on a drawing: its proportions and room for the axes."""
    height = width * shape[0] / shape[1]
    if height > tallest:
        width, height = max(width * tallest / height, 3.2), tallest
    return width, height + 0.7


def _smaller(png: bytes) -> bytes:
    """The same picture in 256 colours, a third of the bytes."""
    image = Image.open(io.BytesIO(png)).convert("RGB").quantize(256, method=Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE)
    small = io.BytesIO()
    image.save(small, format="PNG", optimize=True)
    return small.getvalue() if small.tell() < len(png) else png
