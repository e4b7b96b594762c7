"""Records of a building that is known: the truth, the world as it is today, and the floor plan that shows it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import check_image, check_positive
from priorlab.core.drawing import Door, Drawing


@dataclass(frozen=True, eq=False)
class World:
    """What stands in a robot's way: (height, width) booleans, True = obstacle; it may hold what the plan does not show."""

    obstacles: NDArray[np.bool_]
    metres_per_pixel: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "obstacles", check_image("obstacles", self.obstacles))
        object.__setattr__(self, "metres_per_pixel", check_positive("metres_per_pixel", self.metres_per_pixel))


@dataclass(frozen=True, eq=False)
class Truth:
    """What a perfect extraction and a perfect map would say (thesis 3.3.2, fig. 3.10).

    Parameters
    ----------
    walls : (height, width) bool, True on structural walls and on the ink of windows
    ignore : (height, width) bool, don't-care: doors, stairs, built-in furniture, between the lines of double walls and
        windows, and the halo round anti-aliased walls; excluded from every score
    doors : the doors, each with its three points
    metres_per_pixel : scale, or None
    windows : (height, width) bool, True on the panes and frames of windows (wall and don't-care alike)
    """

    walls: NDArray[np.bool_]
    ignore: NDArray[np.bool_]
    doors: tuple[Door, ...] = ()
    metres_per_pixel: float | None = None
    windows: NDArray[np.bool_] | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "walls", check_image("walls", self.walls))
        object.__setattr__(self, "ignore", check_image("ignore", self.ignore))
        if self.walls.shape != self.ignore.shape:
            raise ValueError(f"walls and ignore must have one shape, got {self.walls.shape} and {self.ignore.shape}")

    @property
    def shape(self) -> tuple[int, int]:
        """Height and width, pixels."""
        return self.walls.shape

    @property
    def obstacles(self) -> NDArray[np.bool_]:
        """What a range sensor meets in the building of the plan: its walls and windows, no furniture, doors open."""
        return self.walls if self.windows is None else self.walls | self.windows


@dataclass(frozen=True, eq=False)
class FloorPlan:
    """A building of our own: its drawing, its exact truth, its world, and two ways through it.

    Parameters
    ----------
    name : as in `load_floor_plan(name)`
    drawing : what the architect hands over
    truth : exact walls, don't-care and doors
    world : the building as it is, which may hold furniture that the plan lacks
    survey : (N, 3) poses x, y, theta that look around (eq. 5.3, 5.4); x, y in pixels, y up
    tour : (M, 2) corners x, y of a path that a robot can drive, metres, y up
    """

    name: str
    drawing: Drawing
    truth: Truth
    world: World
    survey: NDArray[np.float64]
    tour: NDArray[np.float64]

    @property
    def metres_per_pixel(self) -> float:
        """Scale of the drawing."""
        return self.world.metres_per_pixel

    def __repr__(self) -> str:
        height, width = self.drawing.shape
        scale = self.metres_per_pixel
        return (
            f"FloorPlan({self.name}: {width * scale:.1f} x {height * scale:.1f} m at {scale:.4g} m per pixel, "
            f"{len(self.truth.doors)} doors, {len(self.survey)} survey poses)"
        )

    def _repr_png_(self) -> bytes:
        from priorlab.core.picture import encode_png

        return encode_png(self.drawing.grey)
