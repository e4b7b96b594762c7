"""What stands and is written in a flat: fixtures in their boxes, a bed or a table where there is space, names of rooms."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.buildings.parts import Compass, Furniture, Note, Stairs
from priorlab.study.flats.plan import FlatPlan
from priorlab.study.flats.rooms import PER_METRE, middle_of

ROOM_KINDS = frozenset(
    "balcony bathroom bedroom closet corridor kitchen living_room restroom washing_room".split()  # as the files name them
)
"""Things that are names of rooms."""

FIXTURES = {"bathtub": "bath", "toilet": "wc", "washing_basin": "basin", "cooking_counter": "counter"}
"""Things that are fixtures, and what we call them."""

SMALLEST = 0.3
"""Metres; boxes drawn smaller are taken for that."""


def furnish(
    plan: FlatPlan, free: NDArray[np.bool_], rng: np.random.Generator
) -> tuple[tuple[Furniture, ...], tuple[Stairs, ...], tuple[Note, ...]]:
    """Furniture, stairs and names; the floor they take is no longer `free` (changed in place)."""
    fixtures, stairs = _fixtures(plan, free)
    return (*fixtures, *_loose(plan, free, rng)), tuple(stairs), tuple(_names(plan))


def _fixtures(plan: FlatPlan, free: NDArray[np.bool_]) -> tuple[list[Furniture], list[Stairs]]:
    """Baths, basins, counters, backs to the nearest wall, and stairs along their boxes."""
    rooms, pieces, stairs = plan.rooms, [], []
    to_wall = _distance(rooms.labels > 0)
    for kind, box in plan.things:
        left, low, right, high = box
        width, height = max(right - left, SMALLEST), max(high - low, SMALLEST)
        x, y = middle_of(box)
        if kind == "stairs":
            size, up = (min(width, height), max(width, height)), "north" if height >= width else "east"
            stairs.append(Stairs((x, y), size, max(3, round(size[1] / 0.27)), "north" if up == "north" else "east"))
        elif kind in FIXTURES:
            sides: dict[Compass, tuple[float, float]] = {
                "north": (x, high),
                "south": (x, low),
                "east": (right, y),
                "west": (left, y),
            }
            away = {side: to_wall[tuple(rooms.pixel(np.array(point))[::-1])] for side, point in sides.items()}
            back = min(sides, key=lambda side: away[side])
            size = (width, height) if back in ("north", "south") else (height, width)
            name = "hob" if kind == "cooking_counter" and max(size) < 0.8 else FIXTURES[kind]
            pieces.append(Furniture(name, at=(x, y), back=back, size=size))
        else:
            continue
        free[rooms.taken(box)] = False
    return pieces, stairs


def _loose(plan: FlatPlan, free: NDArray[np.bool_], rng: np.random.Generator) -> list[Furniture]:
    """A bed or a table at the middle of the largest free circle of a room."""
    pieces = []
    for kind, box in plan.things:
        x, y = middle_of(box)
        if kind in ROOM_KINDS:  # here stands its name
            free[plan.rooms.taken((x - 0.6, y - 0.2, x + 0.6, y + 0.2))] = False
    directions: tuple[Compass, ...] = ("north", "east", "south", "west")
    for kind, box in plan.things:
        room = plan.rooms.at(box)
        if kind not in ("bedroom", "living_room", "kitchen") or room <= 1:
            continue
        space = _distance(free & (plan.rooms.labels == room))
        row, column = np.unravel_index(int(space.argmax()), space.shape)
        x, y = (float(v) for v in plan.rooms.point(float(column), float(row)))
        radius, back = float(space[row, column]) / PER_METRE, directions[int(rng.integers(4))]
        if kind == "bedroom" and radius > 1.25:
            pieces.append(Furniture("bed", at=(x, y), back=back, size=(1.4, 2.0)))
        elif kind != "bedroom" and radius > 1.05:
            pieces.append(Furniture("table", at=(x, y), back=back, size=(1.3, 0.8), chairs=4))
        else:
            continue
        free[plan.rooms.taken((x - 1, y - 1, x + 1, y + 1))] = False
    return pieces


def _names(plan: FlatPlan) -> list[Note]:
    """Names of rooms, smaller in small rooms, none where no letter fits."""
    space = _distance(plan.rooms.labels > 0) / PER_METRE
    notes = []
    for kind, box in plan.things:
        radius = float(space[tuple(plan.rooms.pixel(np.array(middle_of(box)))[::-1])])
        if kind in ROOM_KINDS and radius > SMALLEST:
            notes.append(Note(kind.replace("_", " ").upper(), middle_of(box), size=0.24 if radius > 0.9 else 0.16))
    return notes


def _distance(mask: NDArray[np.bool_]) -> NDArray[np.float32]:
    """Distance of True pixels to the next False one or to the rim, pixels."""
    padded = np.pad(mask, 1).astype(np.uint8)
    return np.asarray(cv2.distanceTransform(padded, cv2.DIST_L2, cv2.DIST_MASK_PRECISE), np.float32)[1:-1, 1:-1]
