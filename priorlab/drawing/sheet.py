"""A drawing made ready to be searched, and the way from its working pixels back to those that came in."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.drawing import Door
from priorlab.drawing.deskew import Turn


@dataclass(frozen=True, eq=False)
class Sheet:
    """A drawing made ready: what is ink, how dark, in the pixels we work in.

    Parameters
    ----------
    darkness : (height, width) uint8, largest channel distance from the colour of the paper
    lines : (height, width) bool, all ink, thin grey leaves and arcs included
    walls : (height, width) bool, ink dark enough for a wall
    hue : (height, width) uint8 hue in 0-179, or 255 where a pixel has no colour
    scale : working pixels per pixel of the straight drawing
    inverted : True when the paper is darker than the ink
    input_shape : (height, width) of the drawing that came in
    turn : how the drawing was turned straight, before it was scaled; None when it was straight
    """

    darkness: NDArray[np.uint8]
    lines: NDArray[np.bool_]
    walls: NDArray[np.bool_]
    hue: NDArray[np.uint8]
    scale: int
    inverted: bool
    input_shape: tuple[int, int]
    turn: Turn | None = None

    @property
    def long_side(self) -> int:
        """M, the long side in working pixels."""
        return max(self.lines.shape)

    def to_input(self, mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """A mask in working pixels as one in the drawing's own pixels."""
        if self.scale > 1:
            height, width = mask.shape
            blocks = mask.reshape(height // self.scale, self.scale, width // self.scale, self.scale)
            mask = blocks.mean(axis=(1, 3)) >= 0.5
        return mask if self.turn is None else self.turn.mask_back(mask)

    def points_to_work(self, points: ArrayLike) -> NDArray[np.float64]:
        """(N, 2) points x, y of the drawing in working pixels."""
        xy = np.asarray(points, dtype=np.float64).reshape(-1, 2)
        return (xy if self.turn is None else self.turn.points(xy)) * self.scale

    def points_to_input(self, points: ArrayLike) -> NDArray[np.float64]:
        """(N, 2) points x, y in working pixels as points of the drawing."""
        xy = np.asarray(points, dtype=np.float64).reshape(-1, 2) / self.scale
        return xy if self.turn is None else self.turn.points_back(xy)

    def doors_to_work(self, doors: Sequence[Door]) -> tuple[Door, ...]:
        """Doors of the drawing in working pixels."""
        return _moved(doors, self.points_to_work)

    def doors_to_input(self, doors: Sequence[Door]) -> tuple[Door, ...]:
        """Doors in working pixels as doors of the drawing."""
        return _moved(doors, self.points_to_input)


def _moved(doors: Sequence[Door], move: Callable[[ArrayLike], NDArray[np.float64]]) -> tuple[Door, ...]:
    """Doors with their points moved."""
    found = []
    for door in doors:
        hinge, strike, tip = ((float(x), float(y)) for x, y in move(door.points))
        found.append(replace(door, hinge=hinge, strike=strike, tip=tip))
    return tuple(found)
