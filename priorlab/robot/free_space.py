"""Where a robot can go between extracted walls: the free space indoors, as far from the walls as its body needs.

Extracted walls have gaps: open doors, and windows that were not found. Indoors is what cannot be reached from the border of
the drawing by something as wide as a door; so gaps up to a door's width do not let the outdoors in.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import check_positive
from priorlab.core.drawing import Door, Walls
from priorlab.core.grid import Grid

DOOR_WIDTH_M = 0.85
"""A door's width when no door was measured, metres."""

GAP_IN_DOORS = 1.15
"""Gaps up to this many door widths are closed against the outdoors: door frames and thin ink make a gap wider."""


INDOORS_AT_LEAST = 0.25
"""A plan leaks when less than this share of the space within its outline is indoors; single rooms may be open."""


class LeakError(ValueError):
    """The free space between the walls is connected to the outdoors, so that hardly any indoors is left to plan in."""


@dataclass(frozen=True, eq=False)
class FreeSpace:
    """The space indoors that a robot can use.

    Parameters
    ----------
    drivable : (height, width) bool, the space indoors in which a robot of this clearance fits
    distance : (height, width) float32, pixels to the nearest wall
    rooms : (height, width) int32, drivable space cut at the doors, rooms counted from 1; 0 = none
    door_width : pixels
    clearance : pixels
    share_indoors : drivable space as a share of the space within the building's outline; low when rooms leak
    """

    drivable: NDArray[np.bool_]
    distance: NDArray[np.float32]
    rooms: NDArray[np.int32]
    door_width: float
    clearance: float
    share_indoors: float


def find_free_space(
    walls: Walls, doors: Sequence[Door] = (), door_width: float | None = None, clearance: float | None = None
) -> FreeSpace:
    """Find the free space indoors.

    Parameters
    ----------
    walls : extracted from a drawing
    doors : the doors of the drawing; their open sides close rooms, and double doors may be wider than a door
    door_width : pixels; by default the median of the doors, or 0.85 m in a drawing whose scale is known
    clearance : pixels that the robot keeps from walls; by default a fifth of a door (0.17 m)

    Raises
    ------
    LeakError
        When less than a quarter of the space within the walls' outline is indoors; the sentence says where it leaks.
        A single room that leaks counts as outdoors, and the rest is used.
    ValueError
        When there is no wall, or neither door width, doors nor scale tell how wide a door is.
    """
    if not walls.mask.any():
        raise ValueError("walls must hold at least one wall pixel to plan between, got none")
    width = _door_width(walls, doors, door_width)
    clearance = 0.2 * width if clearance is None else check_positive("clearance", clearance)
    sills = draw_sills(walls.shape, doors)
    distance = _distance_to(walls.mask)
    outdoors = swept_from_outside(walls.mask | sills, GAP_IN_DOORS * width)
    drivable = _parts_of(~outdoors & (distance > clearance), min_area=width**2) > 0
    within = _outline(walls.mask, width) & (distance > clearance)
    share = float(drivable.sum() / max(1, within.sum()))
    if share < INDOORS_AT_LEAST:
        raise LeakError(_where_it_leaks(walls.mask | sills, outdoors, width))
    rooms = _rooms(drivable, sills, distance, width)
    return FreeSpace(drivable, distance, rooms, width, clearance, share)


def _door_width(walls: Walls, doors: Sequence[Door], door_width: float | None) -> float:
    """How wide a door is, pixels: told, measured or from the scale."""
    if door_width is not None:
        return check_positive("door_width", door_width)
    if doors:
        return check_positive("the median door's width", float(np.median([door.width for door in doors])))
    if walls.metres_per_pixel is None:
        raise ValueError("door_width must be known to plan, got None: give it, the doors, or the drawing's scale")
    return DOOR_WIDTH_M / walls.metres_per_pixel


def draw_sills(shape: tuple[int, int], doors: Sequence[Door]) -> NDArray[np.bool_]:
    """The open sides of the doors, closed."""
    canvas = np.zeros(shape, dtype=np.uint8)
    for door in doors:
        start, end = (tuple(int(v) for v in np.floor(point)) for point in (door.hinge, door.strike))
        cv2.line(canvas, start, end, 1, thickness=3)
    return canvas > 0


def _distance_to(solid: NDArray[np.bool_]) -> NDArray[np.float32]:
    """Pixels to the nearest solid pixel."""
    return cv2.distanceTransform((~solid).astype(np.uint8), cv2.DIST_L2, cv2.DIST_MASK_PRECISE).astype(np.float32, copy=False)


def swept_from_outside(solid: NDArray[np.bool_], gap: float) -> NDArray[np.bool_]:
    """What a disc of diameter `gap` that comes from beyond the border can sweep over."""
    rim = int(np.ceil(gap)) + 1  # paper all round, so that a wall near the border does not bar the way round the building
    padded = np.pad(solid, rim)
    passable = (_distance_to(padded) > gap / 2).astype(np.uint8)
    _, parts = cv2.connectedComponents(passable, connectivity=4)
    centres = parts == parts[0, 0]
    return (_distance_to(centres) <= gap / 2)[rim:-rim, rim:-rim]


def _rooms(
    drivable: NDArray[np.bool_], sills: NDArray[np.bool_], distance: NDArray[np.float32], width: float
) -> NDArray[np.int32]:
    """Drivable space cut at the known doors, and where it is as narrow as a door that was not found."""
    smallest = width**2 / 4
    pieces = _parts_of(drivable & ~sills, smallest)
    cores = _parts_of((pieces > 0) & (distance > GAP_IN_DOORS * width / 2), min_area=1)
    if not cores.any():
        return pieces
    _, nearest = cv2.distanceTransformWithLabels((cores == 0).astype(np.uint8), cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_CCOMP)
    has_core = np.bincount(pieces[cores > 0], minlength=pieces.max() + 1) > 0
    nearest[~has_core[pieces]] = 0  # a closet narrower than a door stays one room
    rooms = np.zeros_like(pieces)
    for core in np.unique(nearest[pieces > 0]):
        parts = _parts_of((pieces > 0) & (nearest == core) & ~sills, smallest)
        rooms += np.where(parts > 0, parts + rooms.max(), 0)
    return rooms


def _parts_of(mask: NDArray[np.bool_], min_area: float) -> NDArray[np.int32]:
    """The connected parts of a mask that have at least this area, counted from 1; 0 elsewhere."""
    _, parts, stats, _ = cv2.connectedComponentsWithStats(mask.astype(np.uint8), connectivity=4)
    keep = stats[:, cv2.CC_STAT_AREA] >= min_area
    keep[0] = False
    return np.where(keep, np.cumsum(keep), 0).astype(np.int32)[parts]


def _outline(solid: NDArray[np.bool_], gap: float) -> NDArray[np.bool_]:
    """What lies within a rubber band round the building: the largest group of walls with gaps of at most twice `gap`."""
    _, groups = cv2.connectedComponents((_distance_to(solid) <= gap).astype(np.uint8))
    building = solid & (groups == np.bincount(groups[solid]).argmax())
    rows, cols = np.nonzero(building)
    band = cv2.convexHull(np.column_stack([cols, rows]).astype(np.int32))
    return cv2.fillConvexPoly(np.zeros(solid.shape, dtype=np.uint8), band, 1) > 0


def _where_it_leaks(solid: NDArray[np.bool_], outdoors: NDArray[np.bool_], door_width: float) -> str:
    """The sentence for walls that do not close: the widest way out from the middle of the part that leaks."""
    distance = _distance_to(solid)
    to_outline = _distance_to(np.pad(~_outline(solid, door_width), 1, constant_values=True))[1:-1, 1:-1]
    depth = np.where(outdoors, np.minimum(distance, to_outline), 0.0)
    row, col = np.unravel_index(int(depth.argmax()), solid.shape)
    middle = int(row), int(col)
    low, high = 0.0, float(max(solid.shape))
    while high - low > 0.5:  # the largest disc that still gets out of the middle
        radius = (low + high) / 2
        inside, outside = _reach(distance > radius, middle)
        low, high = (radius, high) if (inside & outside).any() else (low, radius)
    inside, outside = _reach(distance > high, middle)
    inside[middle] = True
    detour = _distance_to(inside) + _distance_to(outside | _rim(solid.shape))
    detour[distance <= low] = np.inf
    x, y = Grid(solid.shape).pixel_to_xy(np.unravel_index(int(detour.argmin()), solid.shape))
    return (
        f"walls must close the building for planning, but it leaks outdoors near x, y = {x:.0f}, {y:.0f} (pixels from the lower "
        f"left corner): got a gap of {2 * low:.0f} px where a door has {door_width:.0f}"
    )


def _reach(passable: NDArray[np.bool_], middle: tuple[int, int]) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """What is connected to the middle, and what to the outdoors beyond the border."""
    padded = np.pad(passable, 1, constant_values=True).astype(np.uint8)
    _, parts = cv2.connectedComponents(padded, connectivity=4)
    parts, outdoors = parts[1:-1, 1:-1], parts[0, 0]
    inside = parts == parts[middle] if passable[middle] else np.zeros_like(passable)
    return inside, passable & (parts == outdoors)


def _rim(shape: tuple[int, int]) -> NDArray[np.bool_]:
    """The pixels of the border."""
    rim = np.ones(shape, dtype=bool)
    rim[1:-1, 1:-1] = False
    return rim
