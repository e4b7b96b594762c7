"""A survey and a tour through a building of which only the extracted walls are known."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import check_positive
from priorlab.core.drawing import Door, Walls
from priorlab.core.grid import Grid
from priorlab.core.survey import look_around
from priorlab.robot.free_space import FreeSpace, find_free_space
from priorlab.robot.route import Roads, shortest_round

Segment = tuple[tuple[float, float], tuple[float, float]]

QUICK = 0.35
"""Poses of a quick survey stand this many sensor ranges apart: a seen cell is looked at one and a half times."""


LONG_ROOM = 5.0
"""A room longer than this many door widths (4 m) is driven to both ends: a Kinect does not see them from the middle."""


def plan_survey(
    walls: Walls,
    doors: Sequence[Door] = (),
    door_width: float | None = None,
    max_range: float | None = None,
    spacing: float | None = None,
    clearance: float | None = None,
) -> NDArray[np.float64]:
    """Poses that look around in every room: straight lanes along the room, looking left and right in turn (eq. 5.3, 5.4).

    Parameters
    ----------
    walls : extracted from a drawing
    doors : its doors; rooms are told apart by them
    door_width : pixels; see `find_free_space`
    max_range : of the sensor, pixels; a door's width by default, as the thesis's. Lanes lie at most this far apart
    spacing : pixels between poses on a lane, 0.35 `max_range` by default; a shorter one is a denser survey
    clearance : pixels that the robot keeps from walls

    Returns
    -------
    (N, 3) x, y, theta; pixels, y up

    Raises
    ------
    LeakError, ValueError
        As `find_free_space` does.
    """
    space = find_free_space(walls, doors, door_width, clearance)
    reach = space.door_width if max_range is None else check_positive("max_range", max_range)
    spacing = QUICK * reach if spacing is None else check_positive("spacing", spacing)
    lanes = [lane for room in range(1, space.rooms.max() + 1) for lane in _lanes(space.rooms == room, reach)]
    return look_around(lanes, spacing)


def plan_tour(
    walls: Walls,
    doors: Sequence[Door] = (),
    door_width: float | None = None,
    clearance: float | None = None,
    in_pixels: bool = False,
) -> NDArray[np.float64]:
    """A path that a robot can drive through all the rooms that it can reach, from the largest part of the building.

    Every room is visited at its middle, a long one at both ends too. The order is the nearest next stop, improved by turning
    stretches round; between stops the way is the shortest one that keeps the clearance.

    Parameters
    ----------
    walls, doors, door_width, clearance : as in `plan_survey`
    in_pixels : give pixels instead of metres; a drawing without a scale has no metres

    Returns
    -------
    (M, 2) corners x, y of the path; metres (or pixels), y up. A room that no door leads to is left out.

    Raises
    ------
    LeakError, ValueError
        As `find_free_space` does; and when metres are asked of a drawing without a scale.
    """
    grid = Grid(walls.shape, 1, walls.metres_per_pixel)
    scale = 1.0 if in_pixels else grid.scale
    space = find_free_space(walls, doors, door_width, clearance)
    roads = Roads(space.drivable, space.distance, step=max(1, int(space.door_width / 8)))
    path = shortest_round(roads, [stop for room in range(1, space.rooms.max() + 1) for stop in _stops(space, room)])
    return grid.pixel_to_xy(path) * scale


def _lanes(room: NDArray[np.bool_], apart: float) -> list[Segment]:
    """Straight lanes ((x0, y0), (x1, y1)) along the longer side of a room, evenly spaced and at most `apart` from each other."""
    rows, cols = np.nonzero(room)
    along_x = np.ptp(cols) >= np.ptp(rows)
    first, last = (rows.min(), rows.max()) if along_x else (cols.min(), cols.max())
    n_lanes = max(1, math.ceil((last - first + 1) / apart))
    to_xy = Grid(room.shape).pixel_to_xy
    lanes: list[Segment] = []
    for line in np.floor(first + (last - first + 1) * (np.arange(n_lanes) + 0.5) / n_lanes).astype(int):
        for start, end in _runs(room[line] if along_x else room[:, line]):
            ends = [[line, start], [line, end]] if along_x else [[start, line], [end, line]]
            (x0, y0), (x1, y1) = to_xy(ends).tolist()
            lanes.append(((x0, y0), (x1, y1)))
    return lanes


def _runs(line: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """First and last index of every run of True."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], line.astype(np.int8), [0]])))
    return [(int(start), int(end) - 1) for start, end in zip(edges[::2], edges[1::2], strict=True)]


def _stops(space: FreeSpace, room: int) -> list[tuple[int, int]]:
    """Pixels (row, col) that a tour visits in a room: the one farthest from the walls, both ends of a long or only room."""
    inside = space.rooms == room
    row, col = np.unravel_index(int(np.where(inside, space.distance, -1.0).argmax()), inside.shape)
    stops = [(int(row), int(col))]
    pixels = np.argwhere(inside)
    along = int(np.ptp(pixels[:, 1]) >= np.ptp(pixels[:, 0]))
    if space.rooms.max() == 1 or np.ptp(pixels[:, along]) > LONG_ROOM * space.door_width:
        order = pixels[:, along] + np.abs(pixels[:, 1 - along] - stops[0][1 - along]) * [[1], [-1]]
        stops += [(int(r), int(c)) for r, c in pixels[[order[0].argmin(), order[1].argmax()]]]
    return stops
