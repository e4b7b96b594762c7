"""A tour that leaves no corner out: the way of a robot that has to see a whole building (fig. 6.5)."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.checks import as_float, check_image, check_positive
from priorlab.core.drawing import Walls
from priorlab.core.grid import Grid
from priorlab.robot.free_space import find_free_space
from priorlab.robot.route import Roads, shortest_round

OFF_WALLS_M = 0.5
"""Stops keep this far from walls and furniture; only ways through doors come nearer."""


def full_tour(
    walls: Walls, apart_m: float = 4.0, landmarks: ArrayLike | None = None, near_m: float = np.inf
) -> NDArray[np.float64]:
    """A path through all that can be reached: every place in the largest connected part of the free space lies within `apart_m`
    of a stop.

    The stops are found one by one, each the place farthest from all others; `plan_tour` visits the middles of rooms alone,
    which leaves most walls of a large office beyond the reach of a Kinect. A robot that must find itself by what it sees is not
    driven across the middle of a hall: with `near_m`, stops and ways keep so near to `landmarks` wherever they can, and places
    farther off need no stop.

    Parameters
    ----------
    walls : what the robot must not hit, with a scale
    apart_m : metres; a third of the sensor's range more than it misses little
    landmarks : (height, width) image, True or above 0 where something stands that it should keep in sight; the walls by default
    near_m : metres from the landmarks; no matter by default

    Returns
    -------
    (M, 2) corners x, y of the path; metres, y up

    Raises
    ------
    LeakError, ValueError
        As `find_free_space` does; when the drawing has no scale; when the robot fits nowhere, or in the largest part of the
        free space nowhere near `landmarks`; when these are no image of the walls' shape, or `near_m` is not above 0.
    """
    grid = Grid(walls.shape, 1, walls.metres_per_pixel)
    apart = check_positive("apart_m", apart_m) / grid.scale
    if not (reach_m := as_float("near_m", near_m)) > 0:
        raise ValueError(f"near_m must be above 0, got {reach_m:g}")
    marks = walls.mask if landmarks is None else check_image("landmarks", landmarks)
    if marks.shape != walls.shape:
        raise ValueError(f"landmarks must have the shape of the walls, {walls.shape}, got {marks.shape}")
    space = find_free_space(walls)
    near = _within(reach_m / grid.scale, marks)
    roads = Roads(space.drivable, space.distance, step=max(1, int(space.door_width / 8)), preferred=near)
    points = roads.points[roads.in_largest_part & near[tuple(roads.points.T)]]
    room_to_stand = space.distance[tuple(points.T)] * grid.scale
    places = points[room_to_stand >= min(OFF_WALLS_M, room_to_stand.max(initial=0.0))]
    if not len(places):
        raise ValueError(
            f"the largest part of the free space must hold a place for the robot near its landmarks, "
            f"got none between walls of shape {walls.shape}"
        )
    stops = [places[0]]
    nearest = np.hypot(*(places - stops[0]).T)
    while nearest.max() > apart:
        stops.append(places[int(nearest.argmax())])
        nearest = np.minimum(nearest, np.hypot(*(places - stops[-1]).T))
    corners = shortest_round(roads, [(int(row), int(col)) for row, col in stops])
    return grid.xy_to_metres(grid.pixel_to_xy(corners))


def _within(reach: float, landmarks: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Pixels at most `reach` pixels from a landmark."""
    away = cv2.distanceTransform((~landmarks).astype(np.uint8), cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
    return np.asarray(away <= reach)
