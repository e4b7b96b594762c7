"""Records of chapter 3: the drawing that comes in, the doors and walls that are found in it.

Everything here is in the pixels of the drawing that came in: x to the right, y DOWN, as the thesis's equations 3.6-3.9 have it.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import check_image, check_positive

EMPTY, WALL, WINDOW = 0, 1, 2
"""Labels of `Walls`; the ink of windows is wall too. Later classes (stairs, furniture) get the next numbers."""


@dataclass(frozen=True, eq=False)
class Drawing:
    """An architectural drawing or floor plan.

    Parameters
    ----------
    grey : (height, width) uint8, 0 black ink, 255 white paper
    colour : (height, width, 3) uint8 RGB, or None for a grey drawing
    metres_per_pixel : scale, or None when nobody said
    name : what messages and reports call it
    reduced_by : factor by which the image was made smaller when it was read (1 = as it came)
    """

    grey: NDArray[np.uint8]
    colour: NDArray[np.uint8] | None = None
    metres_per_pixel: float | None = None
    name: str = "drawing"
    reduced_by: float = 1.0

    def __post_init__(self) -> None:
        grey = np.asarray(self.grey)
        if grey.dtype != np.uint8:
            raise ValueError(f"grey must hold uint8 from 0 (ink) to 255 (paper), got {grey.dtype}")
        object.__setattr__(self, "grey", check_image("grey", grey, np.uint8))
        if self.colour is not None and self.colour.shape != (*self.grey.shape, 3):
            raise ValueError(f"colour must have shape {(*self.grey.shape, 3)}, got {self.colour.shape}")
        if self.metres_per_pixel is not None:
            object.__setattr__(self, "metres_per_pixel", check_positive("metres_per_pixel", self.metres_per_pixel))

    @property
    def shape(self) -> tuple[int, int]:
        """Height and width, pixels."""
        return self.grey.shape

    def __repr__(self) -> str:
        height, width = self.shape
        scale = "scale unknown" if self.metres_per_pixel is None else f"{self.metres_per_pixel:.4g} m per pixel"
        return f"Drawing({self.name}: {width} x {height} px, {scale})"


@dataclass(frozen=True)
class Door:
    """A door as an isosceles triangle (thesis fig. 3.5): two jambs on the wall and the tip of the open leaf.

    `hinge` and `strike` are the ends of the side AB that is open (no ink joins them); `tip` is the third vertex,
    where leaf and arc meet. Points are (x, y), pixels, y down.
    """

    hinge: tuple[float, float]
    strike: tuple[float, float]
    tip: tuple[float, float]
    kind: str = "arc"
    quality: float = 1.0

    @property
    def points(self) -> NDArray[np.float64]:
        """(3, 2) hinge, strike, tip."""
        return np.array([self.hinge, self.strike, self.tip], dtype=np.float64)

    @property
    def width(self) -> float:
        """Length of the open side, pixels."""
        return float(np.hypot(self.strike[0] - self.hinge[0], self.strike[1] - self.hinge[1]))


@dataclass(frozen=True, eq=False)
class Walls:
    """What each pixel of a drawing was found to be.

    Parameters
    ----------
    labels : (height, width) uint8, `EMPTY`, `WALL` or `WINDOW`
    metres_per_pixel : scale of the drawing, or None
    name : the drawing's name
    mask : (height, width) bool, made of the labels: walls and the ink of windows

    >>> walls = Walls(np.array([[0, 1, 2]], dtype=np.uint8))
    >>> walls.mask.tolist(), walls.windows.tolist()
    ([[False, True, True]], [[False, False, True]])
    """

    labels: NDArray[np.uint8]
    metres_per_pixel: float | None = None
    name: str = "walls"
    mask: NDArray[np.bool_] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        given = np.asarray(self.labels)
        if given.dtype.kind not in "bui" or (given.size and not (given.min() >= 0 and given.max() <= 255)):
            raise ValueError(f"labels must be whole numbers from 0 to 255, got {given.dtype} from {given.min()} to {given.max()}")
        labels = check_image("labels", given, np.uint8)
        if self.metres_per_pixel is not None:
            object.__setattr__(self, "metres_per_pixel", check_positive("metres_per_pixel", self.metres_per_pixel))
        object.__setattr__(self, "labels", labels)
        object.__setattr__(self, "mask", (labels == WALL) | (labels == WINDOW))

    @property
    def windows(self) -> NDArray[np.bool_]:
        """(height, width) bool, the ink of windows."""
        return self.labels == WINDOW

    @property
    def shape(self) -> tuple[int, int]:
        """Height and width, pixels."""
        return self.labels.shape

    def __repr__(self) -> str:
        height, width = self.shape
        return f"Walls({self.name}: {width} x {height} px, {100 * self.mask.mean():.1f} % wall)"

    def _repr_png_(self) -> bytes:
        from priorlab.core.picture import encode_png, grey_of

        return encode_png(grey_of(~self.mask))
