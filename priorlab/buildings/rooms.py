"""Rooms as regions of the drawing: what a label's point reaches when all doors are shut."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.buildings.layout import Layout
from priorlab.buildings.paper import coverage, fine_mask


def room_regions(layout: Layout, solid: NDArray[np.bool_]) -> dict[str, NDArray[np.bool_]]:
    """(height, width) True inside each room, by name.

    Parameters
    ----------
    solid : walls and windows as bodies, pixels; the openings of the doors are shut here

    Raises
    ------
    ValueError
        When a room's point lies in a wall, or its region leaks outdoors.
    """
    _, labels = cv2.connectedComponents((~_shut(layout, solid)).view(np.uint8), connectivity=4)
    regions = {}
    for room in layout.description.rooms:
        x, y = np.floor(layout.frame.to_image(room.at)).astype(int)
        height, width = layout.frame.shape
        if not (0 <= x < width and 0 <= y < height) or labels[y, x] == 0:
            raise ValueError(f"the point of room {room.name!r} must lie between its walls, got {list(room.at)}")
        region = labels == labels[y, x]
        if region[0].any() or region[-1].any() or region[:, 0].any() or region[:, -1].any():
            raise ValueError(f"room {room.name!r} must be closed by walls, windows and doors, but {list(room.at)} leads outdoors")
        regions[room.name] = region
    return regions


def indoors(layout: Layout, solid: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(height, width) True inside the building: what the sheet's rim does not reach when all doors are shut."""
    rim = np.pad(~_shut(layout, solid), 1, constant_values=True)
    _, labels = cv2.connectedComponents(rim.view(np.uint8), connectivity=4)
    return (labels != labels[0, 0])[1:-1, 1:-1]


def _shut(layout: Layout, solid: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Walls, windows and shut doors."""
    return solid | (coverage(fine_mask(layout.frame, [door.opening.outline for door in layout.doors])) > 0)


def room_areas_m2(layout: Layout, regions: dict[str, NDArray[np.bool_]]) -> dict[str, float]:
    """Floor area of each room, square metres."""
    return {name: float(np.count_nonzero(region)) * layout.frame.metres_per_pixel**2 for name, region in regions.items()}
