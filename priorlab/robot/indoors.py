"""Who has left a building that is known: a place that something much wider than a door can reach from the edge of the drawing."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.building import Truth, World
from priorlab.core.grid import Grid
from priorlab.robot.free_space import draw_sills, swept_from_outside

WIDEST_OPENING = 2.0
"""Openings in the outer wall are at most so many door widths wide; with a wider one nobody can tell in from out."""


def is_outdoors(building: Truth | World, xy: ArrayLike) -> NDArray[np.bool_]:
    """True for places outside the building.

    Only a truth with doors says how wide an opening may be: in a world, and between walls without doors, no place is outdoors.

    Parameters
    ----------
    building : its obstacles and doors
    xy : (N, 2) x, y in pixels, y up, on the map

    >>> walls = np.pad(np.pad(np.zeros((9, 9), dtype=bool), 1, constant_values=True), 9)
    >>> is_outdoors(Truth(walls, walls & False), [[14.5, 14.5], [2.5, 2.5]]).tolist()
    [False, False]
    """
    places = tuple(Grid(building.obstacles.shape).xy_to_pixel(xy).T)
    if isinstance(building, World) or not building.doors:
        return np.zeros(len(places[0]), dtype=bool)
    shut = building.obstacles | draw_sills(building.shape, building.doors)
    paper = np.pad(~shut, 1, constant_values=True).astype(np.uint8)  # a way round the building at the edge of the drawing
    _, parts = cv2.connectedComponents(paper, connectivity=4)
    if not (parts[1:-1, 1:-1][places] == parts[0, 0]).any():
        return np.zeros(len(places[0]), dtype=bool)  # behind shut doors: the usual case, and quickly seen
    gap = WIDEST_OPENING * float(np.median([door.width for door in building.doors]))
    return (swept_from_outside(shut, gap) & ~shut)[places]
