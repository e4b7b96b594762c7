"""Where the building lies on its sheet: metres of the description <-> pixels of the drawing."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.buildings.parts import Description


@dataclass(frozen=True)
class Frame:
    """The sheet in the building's metres.

    Parameters
    ----------
    origin_m : x, y of the sheet's lower left corner in the description's metres
    shape : height and width, pixels
    metres_per_pixel : scale
    """

    origin_m: tuple[float, float]
    shape: tuple[int, int]
    metres_per_pixel: float

    def to_image(self, points_m: ArrayLike) -> NDArray[np.float64]:
        """(..., 2) points of the description as x right, y DOWN, pixels; a pixel's centre is at +0.5."""
        xy = self.to_world_m(points_m) / self.metres_per_pixel
        return np.stack([xy[..., 0], self.shape[0] - xy[..., 1]], axis=-1)

    def to_world_m(self, points_m: ArrayLike) -> NDArray[np.float64]:
        """(..., 2) points of the description in the world frame: metres from the sheet's lower left corner, y up."""
        return np.asarray(points_m, dtype=np.float64) - self.origin_m


def frame_of(description: Description) -> Frame:
    """The sheet that holds the building's walls and the margins round them, in whole pixels."""
    points = np.concatenate([np.array(wall.outline or wall.path) for wall in description.walls])
    left, bottom, right, top = description.sheet.margins
    low = points.min(axis=0) - (left, bottom)
    size = points.max(axis=0) + (right, top) - low
    width, height = np.ceil(np.round(size / description.metres_per_pixel, 6)).astype(int)
    if min(width, height) < 1:
        raise ValueError(f"margins must leave room for the building, got {list(description.sheet.margins)}")
    return Frame((float(low[0]), float(low[1])), (int(height), int(width)), description.metres_per_pixel)
