"""What happens to a sheet between the architect and us: skew, blur, uneven light, grain, JPEG. The truth goes along, exactly."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.core.building import Truth
from priorlab.core.drawing import Door, Drawing

Image = NDArray[np.uint8]


@dataclass(frozen=True)
class Degradation:
    """One of them and how much.

    Parameters
    ----------
    kind : "skew" (degrees, counter-clockwise), "blur" (standard deviation, pixels), "shading" (share of the light that the
        darkest corner lacks), "noise" (standard deviation, grey levels), "jpeg" (quality, 1 to 100)
    amount : in the unit of its kind
    """

    kind: Literal["skew", "blur", "shading", "noise", "jpeg"]
    amount: float

    def __post_init__(self) -> None:
        low, high = LIMITS[self.kind]
        if not low <= self.amount <= high:
            raise ValueError(f"amount of {self.kind} must lie between {low:g} and {high:g}, got {self.amount:g}")


LIMITS = {"skew": (-45.0, 45.0), "blur": (0.1, 5.0), "shading": (0.0, 0.9), "noise": (0.0, 80.0), "jpeg": (1.0, 100.0)}
"""What makes sense of each kind."""


def degrade(
    drawing: Drawing, truth: Truth, degradations: Sequence[Degradation], rng: np.random.Generator
) -> tuple[Drawing, Truth]:
    """A drawing as it arrives, and the truth of what can be seen on it.

    A skew turns walls, don't-care and doors with the sheet, which grows so that nothing is cut off; all else leaves the truth.

    >>> blank = Drawing(np.full((20, 30), 255, np.uint8))
    >>> nothing = Truth(np.zeros((20, 30), bool), np.zeros((20, 30), bool))
    >>> degrade(blank, nothing, [Degradation("skew", 90 / 4)], np.random.default_rng(0))[0].shape
    (30, 36)
    """
    for degradation in degradations:
        if degradation.kind == "skew":
            drawing, truth = skewed(drawing, truth, degradation.amount)
        else:
            image = drawing.grey if drawing.colour is None else drawing.colour
            drawing = _with_image(drawing, SPOILERS[degradation.kind](image, degradation.amount, rng))
    return drawing, truth


def skewed(drawing: Drawing, truth: Truth, degrees: float) -> tuple[Drawing, Truth]:
    """A sheet laid down askew, turned counter-clockwise about its middle."""
    height, width = drawing.shape
    angle = np.radians(degrees)
    cos, sin = float(np.cos(angle)), float(np.sin(angle))
    new_width = int(np.ceil(width * abs(cos) + height * abs(sin) - 1e-9))
    new_height = int(np.ceil(height * abs(cos) + width * abs(sin) - 1e-9))
    # corners of pixels are whole numbers here: a point p goes to turn @ p + shift
    turn = np.array([[cos, sin], [-sin, cos]])
    shift = np.array([new_width, new_height]) / 2 - turn @ (width / 2, height / 2)
    to_centres = turn @ (0.5, 0.5) + shift - 0.5  # OpenCV counts from the middle of the first pixel
    matrix = np.column_stack([turn, to_centres])

    def turned(image: Image, outside: Sequence[float] = (0.0,)) -> Image:
        flags = cv2.INTER_LINEAR
        return np.asarray(
            cv2.warpAffine(image, matrix, (new_width, new_height), flags=flags, borderValue=outside), dtype=np.uint8
        )

    def share(mask: NDArray[np.bool_]) -> Image:
        return turned(mask.astype(np.uint8) * 255)

    def point(p: tuple[float, float]) -> tuple[float, float]:
        x, y = turn @ p + shift
        return float(x), float(y)

    walls = share(truth.walls) >= 128
    rim = cv2.dilate(walls.astype(np.uint8), np.ones((3, 3), np.uint8)).astype(bool)  # anti-aliased anew
    ignore = ((share(truth.ignore) > 0) | rim) & ~walls
    ignore |= share(truth.ignore & truth.walls) >= 128  # don't-care that lies on walls stays so
    doors = tuple(Door(point(d.hinge), point(d.strike), point(d.tip), d.kind, d.quality) for d in truth.doors)
    windows = None if truth.windows is None else share(truth.windows) >= 128
    image = drawing.grey if drawing.colour is None else drawing.colour
    paper = np.atleast_1d(np.median(image, axis=(0, 1))).tolist()
    return _with_image(drawing, turned(image, paper)), Truth(walls, ignore, doors, truth.metres_per_pixel, windows)


def _blurred(image: Image, amount: float, rng: np.random.Generator) -> Image:
    """A soft copy."""
    return np.asarray(cv2.GaussianBlur(image, (0, 0), amount), dtype=np.uint8)


def _shaded(image: Image, amount: float, rng: np.random.Generator) -> Image:
    """Light that falls off towards one of the lower corners."""
    height, width = image.shape[:2]
    y, x = np.mgrid[0:height, 0:width]
    across, down = x / max(width - 1, 1), y / max(height - 1, 1)
    if rng.random() < 0.5:
        across = 1 - across
    fall = 0.6 * across + 0.4 * down**2
    light = 1 - amount * fall
    return _rounded(image * (light[..., None] if image.ndim == 3 else light))


def _noisy(image: Image, amount: float, rng: np.random.Generator) -> Image:
    """Grain: normal, independent in every pixel."""
    return _rounded(image + rng.normal(0.0, amount, image.shape))


def _packed(image: Image, amount: float, rng: np.random.Generator) -> Image:
    """Through a JPEG and back."""
    flags = [cv2.IMWRITE_JPEG_QUALITY, round(amount)]
    _, packed = cv2.imencode(".jpg", image[..., ::-1] if image.ndim == 3 else image, flags)
    back = cv2.imdecode(packed, cv2.IMREAD_COLOR if image.ndim == 3 else cv2.IMREAD_GRAYSCALE)
    assert back is not None
    return np.ascontiguousarray(back[..., ::-1] if image.ndim == 3 else back, dtype=np.uint8)


SPOILERS: dict[str, Callable[[Image, float, np.random.Generator], Image]] = {
    "blur": _blurred,
    "shading": _shaded,
    "noise": _noisy,
    "jpeg": _packed,
}
"""What leaves every pixel where it is."""


def _rounded(image: NDArray[np.float64]) -> Image:
    """Grey levels again."""
    return np.clip(np.round(image), 0, 255).astype(np.uint8)


def _with_image(drawing: Drawing, image: Image) -> Drawing:
    """The same drawing with another picture."""
    if image.ndim == 2:
        return replace(drawing, grey=image, colour=None)
    return replace(drawing, grey=np.asarray(cv2.cvtColor(image, cv2.COLOR_RGB2GRAY), np.uint8), colour=image)
