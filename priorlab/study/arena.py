"""The arena of thesis 5.3: 3 x 4 m, three rooms of boards, and the places at which a Kinect took depth images.

The thesis shows it in photographs only and gives neither walls nor poses nor the scale of its map. Ours has boards of 5 cm
and pixels of 2.5 cm, so that a cell "of side 2" is as wide as a wall and one "of side 3" wider: with the coarse cells a map
without the plan shows next to nothing, as in fig. 5.14 and 5.18. The poses look along the four headings of 4.5.2, stand
at least the blind zone away from the wall ahead, and leave parts of the arena unseen.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from priorlab.core.building import Truth
from priorlab.core.checks import check_positive
from priorlab.core.drawing import Walls
from priorlab.robot.relief import Relief, raise_walls

WIDTH_M, DEPTH_M, BOARD_M, BOARD_HEIGHT_M = 4.0, 3.0, 0.05, 0.6

MARGIN_M = 0.25
"""Floor round the arena on the map: a wall that is seen a little too far out must not fall off it."""

INNER_M = (
    (2.175, 2.225, 0.0, 0.5),  # left, right, bottom, top: the inner middle wall, with two doorways of 60 cm
    (2.175, 2.225, 1.1, 2.0),
    (2.175, 2.225, 2.6, 3.0),
    (2.225, 4.0, 1.475, 1.525),  # between the two rooms on the right
)

BOXES_M = ((0.25, 0.5, 2.5, 2.75), (3.5, 3.75, 0.25, 0.5))
"""Two boxes, 20 cm high, for those who want furniture: lower than the lens."""

POSES = (
    (0.7, 0.75, 0),  # x, y from the arena's lower left corner, metres; heading, degrees: the large room, from south to north
    (1.5, 0.75, 180),
    (1.1, 1.2, 270),
    (1.5, 1.6, 180),
    (0.7, 2.25, 0),
    (1.5, 2.25, 180),
    (1.1, 1.9, 90),
    (3.0, 2.25, 0),  # the upper room on the right
    (3.2, 2.0, 90),
    (3.0, 0.75, 0),  # the lower room on the right
    (3.1, 1.0, 270),
    (3.3, 0.6, 90),
)


@dataclass(frozen=True, eq=False)
class Arena:
    """The arena at one scale.

    Parameters
    ----------
    truth : its walls; nothing is don't-care
    walls : the plan, extracted without a mistake (thesis 5.3 assumes so)
    relief : how high everything stands
    poses : (N, 3) x, y, theta as the tape measure gave them; pixels, y up
    wall_thickness : pixels
    """

    truth: Truth
    walls: Walls
    relief: Relief
    poses: NDArray[np.float64]
    wall_thickness: float

    @property
    def metres_per_pixel(self) -> float:
        """Scale of the map."""
        return self.relief.metres_per_pixel

    def __repr__(self) -> str:
        height, width = self.truth.shape
        size = f"{width * self.metres_per_pixel:.1f} x {height * self.metres_per_pixel:.1f} m"
        return f"Arena({size} with its margin, {width} x {height} px, {len(self.poses)} poses)"


def build_arena(metres_per_pixel: float = 0.025, wall_height_m: float = BOARD_HEIGHT_M, boxes: bool = False) -> Arena:
    """The arena of 5.3.

    Parameters
    ----------
    metres_per_pixel : scale of its map
    wall_height_m : of the boards
    boxes : put two low boxes in, which the plan lacks

    >>> build_arena()
    Arena(4.5 x 3.5 m with its margin, 180 x 140 px, 12 poses)
    """
    scale = check_positive("metres_per_pixel", metres_per_pixel)
    rows, columns = (round((side + 2 * MARGIN_M) / scale) for side in (DEPTH_M, WIDTH_M))
    if min(rows, columns) < 10:
        raise ValueError(f"metres_per_pixel must leave the arena at least 10 pixels, got {scale:g}")
    x = (np.arange(columns) + 0.5) * scale - MARGIN_M
    y = (rows - np.arange(rows) - 0.5) * scale - MARGIN_M

    def box(left: float, right: float, bottom: float, top: float) -> NDArray[np.bool_]:
        """The pixels whose centres lie in a rectangle, metres."""
        return ((y >= bottom) & (y < top))[:, None] & ((x >= left) & (x < right))[None]

    solid = box(0, WIDTH_M, 0, DEPTH_M) & ~box(BOARD_M, WIDTH_M - BOARD_M, BOARD_M, DEPTH_M - BOARD_M)
    for part in INNER_M:
        solid |= box(*part)
    things = np.any([box(*part) for part in BOXES_M], axis=0) if boxes else None
    poses = np.array(POSES, dtype=np.float64)
    poses = np.column_stack([(poses[:, :2] + MARGIN_M) / scale, [math.radians(degrees) for degrees in poses[:, 2]]])
    return Arena(
        truth=Truth(solid, np.zeros_like(solid), metres_per_pixel=scale),
        walls=Walls(solid.astype(np.uint8), scale, "arena"),
        relief=raise_walls(solid, scale, wall_height_m, things),
        poses=poses,
        wall_thickness=BOARD_M / scale,
    )
