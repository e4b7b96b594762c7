"""A tour that leaves no corner out: the way of a robot that has to see a whole building (fig. 6.5)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import check_positive
from priorlab.core.drawing import Walls
from priorlab.core.grid import Grid
from priorlab.robot.free_space import find_free_space
from priorlab.robot.route import Roads, shortest_round

OFF_WALLS_M = 0.5
"""Stops keep this far from walls and furniture; only ways through doors come nearer."""


def full_tour(walls: Walls, apart_m: float = 4.0) -> NDArray[np.float64]:
    """A path through all that can be reached: every free place lies within `apart_m` of a stop.

    The stops are found one by one, each the place farthest from all others; `plan_tour` visits the middles of rooms alone,
    which leaves most walls of a large office beyond the reach of a Kinect.

    Parameters
    ----------
    walls : what the robot must not hit, with a scale
    apart_m : metres; a third of the sensor's range more than it misses little

    Returns
    -------
    (M, 2) corners x, y of the path; metres, y up

    Raises
    ------
    LeakError, ValueError
        As `find_free_space` does; when the drawing has no scale; when the robot fits nowhere.
    """
    apart = check_positive("apart_m", apart_m) / Grid(walls.shape, 1, walls.metres_per_pixel).scale
    grid = Grid(walls.shape, 1, walls.metres_per_pixel)
    space = find_free_space(walls)
    roads = Roads(space.drivable, space.distance, step=max(1, int(space.door_width / 8)))
    room_to_stand = space.distance[tuple(roads.points.T)] * grid.scale
    places = roads.points[room_to_stand >= min(OFF_WALLS_M, room_to_stand.max(initial=0.0))]
    if not len(places):
        raise ValueError(f"the free space must hold a place for the robot, got none between walls of shape {walls.shape}")
    stops = [places[0]]
    nearest = np.hypot(*(places - stops[0]).T)
    while nearest.max() > apart:
        stops.append(places[int(nearest.argmax())])
        nearest = np.minimum(nearest, np.hypot(*(places - stops[-1]).T))
    corners = shortest_round(roads, [(int(row), int(col)) for row, col in stops])
    return grid.xy_to_metres(grid.pixel_to_xy(corners))
