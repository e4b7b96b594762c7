"""Which way the doors of a flat open: the hinge and the side where a leaf meets least, drawn by lot among equals."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.buildings.parts import Compass, DoorKind, DoorPart
from priorlab.study.flats.lines import Gap, Points
from priorlab.study.flats.plan import FlatPlan
from priorlab.study.flats.rooms import RoomPicture

SLIDING_ABOVE, PAIR_ABOVE, BARE_BELOW = 2.1, 1.25, 0.5
"""Widths, metres: wider doors slide, have two leaves, narrower ones are bare openings."""


def hang_doors(plan: FlatPlan, free: NDArray[np.bool_], rng: np.random.Generator) -> list[DoorPart]:
    """A door for every gap; what its leaf sweeps is no longer `free` (changed in place, the floor of the room picture)."""
    leaf: DoorKind = "arc_panel" if rng.random() < 0.35 else "arc"
    closets = {plan.rooms.at(box) for kind, box in plan.things if kind == "closet"}
    doors = []
    for gap in plan.doors:
        of_closet = bool(closets & set(plan.rooms.beside(gap.wall, (gap.low + gap.high) / 2)))
        kind = _kind(gap.width, leaf, of_closet, rng)
        ways = [((1, -1)[way // 2], (1, -1)[way % 2]) for way in rng.permutation(4)]
        swept = [_swept(gap, hinge, opens, kind, plan.rooms) for hinge, opens in ways]
        clear = [float((floor & free).sum() / max(floor.sum(), 1)) for floor in swept]
        outdoors = [bool((floor & (plan.rooms.labels == 1)).any()) for floor in swept]
        best = int(np.argmax(np.round(clear, 1) - np.array(outdoors)))
        hinge, opens = ways[best]
        if kind not in ("opening", "sliding"):
            free &= ~swept[best]
        x, y = gap.middle
        hinge_side, open_side = compass(hinge * gap.wall.along), compass(opens * gap.wall.across)
        doors.append(DoorPart((float(x), float(y)), gap.width, hinge_side, open_side, kind))
    return doors


def compass(direction: Points) -> Compass:
    """The compass word nearest to a direction.

    >>> compass(np.array([0.2, -0.9]))
    'south'
    """
    x, y = direction
    if abs(x) >= abs(y):
        return "east" if x > 0 else "west"
    return "north" if y > 0 else "south"


def _kind(width: float, leaf: DoorKind, of_closet: bool, rng: np.random.Generator) -> DoorKind:
    """What a door of this width is."""
    if width > SLIDING_ABOVE:
        return "sliding"
    if width > PAIR_ABOVE:
        return "folding" if of_closet and rng.random() < 0.5 else "double"
    return "opening" if width < BARE_BELOW else leaf


def _swept(gap: Gap, hinge: int, opens: int, kind: DoorKind, rooms: RoomPicture) -> NDArray[np.bool_]:
    """The floor that the leaves sweep, a pixel of the room picture each."""
    along, across = gap.wall.along, gap.wall.across
    radius = gap.width / 2 if kind == "double" else gap.width
    angle = np.radians(np.linspace(5, 85, 17))[:, None]
    floor = np.zeros(rooms.labels.shape, np.uint8)
    for side in (hinge, -hinge) if kind == "double" else (hinge,):
        pivot = gap.middle + side * gap.width / 2 * along + opens * gap.wall.thickness / 2 * across
        rim = pivot + radius * (np.cos(angle) * -side * along + np.sin(angle) * opens * across)
        cv2.fillPoly(floor, [rooms.pixel(np.vstack([pivot, rim])).astype(np.int32)], 1)
    return floor.astype(bool)
