"""How high everything stands: a building for a camera that sees walls of a height, low furniture, floor and ceiling."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.checks import check_image, check_positive


@dataclass(frozen=True, eq=False)
class Relief:
    """A plan with heights; every pixel is a block from the floor up to its height.

    Parameters
    ----------
    heights_m : (height, width) metres, 0 = floor, row 0 at the top
    metres_per_pixel : scale of the plan
    ceiling_m : height of the ceiling, or None under the open roof of an arena
    """

    heights_m: NDArray[np.float64]
    metres_per_pixel: float
    ceiling_m: float | None = None

    def __post_init__(self) -> None:
        heights = check_image("heights_m", self.heights_m, np.float64)
        if not (np.isfinite(heights).all() and (heights >= 0).all()):
            raise ValueError(f"heights_m must be finite numbers of at least 0, got {heights.min():g} to {heights.max():g}")
        object.__setattr__(self, "heights_m", heights)
        object.__setattr__(self, "metres_per_pixel", check_positive("metres_per_pixel", self.metres_per_pixel))
        if self.ceiling_m is not None and check_positive("ceiling_m", self.ceiling_m) < heights.max():
            raise ValueError(f"ceiling_m must not be below what stands under it, {heights.max():g} m, got {self.ceiling_m:g}")

    @property
    def levels_m(self) -> list[float]:
        """The heights that occur, from low to high, without the floor."""
        return [float(height) for height in np.unique(self.heights_m) if height > 0]

    @property
    def shape(self) -> tuple[int, int]:
        """Height and width of the plan, pixels."""
        return self.heights_m.shape


def raise_walls(
    walls: ArrayLike,
    metres_per_pixel: float,
    wall_height_m: float = 0.6,
    furniture: ArrayLike | None = None,
    furniture_height_m: float = 0.2,
    ceiling_m: float | None = None,
) -> Relief:
    """Walls of one height, furniture of another; where both stand the higher one counts.

    Parameters
    ----------
    walls : (height, width) bool, such as `truth.obstacles`
    metres_per_pixel : scale of the plan
    wall_height_m, furniture_height_m : metres
    furniture : (height, width) bool, such as `world.obstacles`, or None
    ceiling_m : height of the ceiling, or None

    >>> raise_walls([[True, False]], 0.05, furniture=[[False, True]]).heights_m.tolist()
    [[0.6, 0.2]]
    """
    solid = check_image("walls", walls)
    heights = np.where(solid, check_positive("wall_height_m", wall_height_m), 0.0)
    if furniture is not None:
        things = check_image("furniture", furniture)
        if things.shape != solid.shape:
            raise ValueError(f"walls and furniture must have one shape, got {solid.shape} and {things.shape}")
        heights = np.maximum(heights, np.where(things, check_positive("furniture_height_m", furniture_height_m), 0.0))
    return Relief(heights, metres_per_pixel, ceiling_m)
