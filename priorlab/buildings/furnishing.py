"""Furniture for rooms that were grown: what a room's use asks for, each piece where it fits, doors kept clear."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from priorlab.buildings.cells import Box, Cell
from priorlab.buildings.geometry import turned
from priorlab.buildings.lettering import text_width
from priorlab.buildings.parts import BUILT_IN, FURNITURE_SIZES, Compass, DoorPart, Furniture, Point, Room, Stairs

NEEDS: dict[str, tuple[tuple[str, tuple[float, float] | None], ...]] = {
    "archive": (("shelf", (2.0, 0.35)), ("shelf", (2.0, 0.35)), ("shelf", None), ("cabinet", None)),
    "bath": (("bath", None), ("basin", None), ("wc", None), ("washer", None), ("shower", None)),
    "bedroom": (("bed", None), ("cupboard", None), ("cabinet", None), ("plant", None)),
    "child": (("bed", (0.9, 2.0)), ("desk", (1.2, 0.65)), ("cupboard", (1.2, 0.6)), ("box", None)),
    "corridor": (("cabinet", (1.2, 0.35)), ("plant", None)),
    "hall": (("cabinet", (1.0, 0.3)),),
    "kitchen": (("counter", (2.4, 0.6)), ("fridge", None), ("washer", None), ("table", (1.2, 0.8))),
    "living": (
        ("sofa", (2.2, 0.9)),
        ("shelf", (2.0, 0.35)),
        ("table", None),
        ("armchair", None),
        ("plant", None),
        ("cabinet", None),
    ),
    "meeting": (("table", (2.8, 1.1)), ("cabinet", (1.4, 0.45)), ("plant", None)),
    "office": (("desk", None), ("shelf", None), ("cabinet", None), ("desk", None), ("plant", None)),
    "study": (("desk", None), ("shelf", None), ("armchair", None), ("plant", None)),
    "wc": (("wc", None), ("basin", (0.5, 0.4)), ("wc", None), ("basin", (0.5, 0.4))),
}
"""Kind and size (width along the back, depth) by a room's use; what does not fit is left out."""

SIDES: tuple[Compass, ...] = ("south", "east", "north", "west")


@dataclass
class _Floor:
    """What is still free of a room while it is filled: its rectangle and the boxes that are taken."""

    box: Box
    taken: list[Box] = field(default_factory=list)

    def is_free(self, box: Box) -> bool:
        """Does a box lie in the room and on nothing?"""
        left, bottom, right, top = self.box
        if box[0] < left - 1e-9 or box[1] < bottom - 1e-9 or box[2] > right + 1e-9 or box[3] > top + 1e-9:
            return False
        return not any(box[0] < t[2] and t[0] < box[2] and box[1] < t[3] and t[1] < box[3] for t in self.taken)


@dataclass(frozen=True)
class Label:
    """What is written in a room: its name, the height of the letters in metres, the font, and room kept free above, metres."""

    name: str
    text: float
    font: str = "sans"
    above: float = 0.0


def furnish(
    cell: Cell, doors: list[DoorPart], label: Label, gap: float | None, rng: np.random.Generator, passage: float = 0.0
) -> tuple[list[Furniture], list[Stairs], Room]:
    """Fill a room and find a place for its label.

    Parameters
    ----------
    doors : all doors of the house
    gap : between loose furniture and walls, metres; what is built in touches them; None leaves the room empty
    passage : floor kept clear beyond a door's swing, metres
    """
    floor = _Floor(cell.box, [swing for door in doors if (swing := _swing(cell, door, passage)) is not None])
    flights = _flight(cell, floor) if cell.use == "stairs" else []
    groups: list[list[Furniture]] = []  # each has taken one box of the floor
    for kind, size in NEEDS.get(cell.use, ()) if gap is not None else ():
        width, depth = size or FURNITURE_SIZES[kind]
        if kind == "table":
            group = _table(cell, floor, width, depth)
        else:
            group = _against_wall(cell, floor, kind, (width, depth), 0.0 if kind in BUILT_IN else gap or 0.0, rng)
            if group and kind == "counter":
                group += _on_counter(group[0])
        groups += [group] if group else []
    while (place := _free_place(floor, label)) is None and groups:
        groups.pop()
        floor.taken.pop()
    left, bottom, right, top = cell.box
    place = place or _free_place(floor, replace(label, above=0.0))
    at, text, show_area = place or (((left + right) / 2, (bottom + top) / 2), 0.75 * label.text, False)
    room = Room(label.name, cell.block.out(*at), text=text, show_area=show_area, turn=cell.block.turn)
    return [piece for group in groups for piece in group], flights, room


def _swing(cell: Cell, door: DoorPart, passage: float) -> Box | None:
    """The part of a room that a door needs, in the room's frame; None when the door is elsewhere."""
    x, y = turned(np.array(door.at) - cell.block.origin, -cell.block.turn)
    left, bottom, right, top = cell.box
    dx, dy = max(left - x, 0.0, x - right), max(bottom - y, 0.0, y - top)
    if max(dx, dy) > 0.6:
        return None
    deep, half = passage + (0.65 * door.width if door.kind == "double" else door.width), door.width / 2 + 0.1 + passage / 2
    across = (deep, half) if dx > dy else (half, deep)
    return (x - across[0] - dx, y - across[1] - dy, x + across[0] + dx, y + across[1] + dy)


def _against_wall(
    cell: Cell, floor: _Floor, kind: str, size: tuple[float, float], gap: float, rng: np.random.Generator
) -> list[Furniture]:
    """A piece with its back to a wall, in a corner when one is free."""
    (width, depth), (left, bottom, right, top) = size, floor.box
    for side in rng.permutation(np.array(SIDES)).tolist():
        upright = side in ("east", "west")
        low, high = (bottom, top) if upright else (left, right)
        room = high - low - width
        if room < 2 * gap:
            continue
        steps = np.array([gap, room - gap, *rng.uniform(gap, room - gap, 6)])
        for start in low + steps:
            level = {"south": bottom + gap, "north": top - gap, "west": left + gap, "east": right - gap}[side]
            inner = level + (depth + (0.45 if kind == "desk" else 0.0)) * (1 if side in ("south", "west") else -1)
            near, far = min(level, inner), max(level, inner)
            box = (near, start, far, start + width) if upright else (start, near, start + width, far)
            if floor.is_free(box):
                floor.taken.append(box)
                middle = start + width / 2
                chairs = {"chairs": 1} if kind == "desk" else {}
                return [_piece(cell, kind, (level, middle) if upright else (middle, level), side, size, chairs)]
    return []


def _on_counter(counter: Furniture) -> list[Furniture]:
    """A sink and a hob on a worktop."""
    assert counter.size is not None and counter.against is not None
    along = turned(np.array([1.0, 0.0]), {"north": 0, "west": 90, "south": 180, "east": 270}[counter.back] + counter.turn)
    return [
        Furniture(
            kind,
            against=(float(counter.against[0] + shift * along[0]), float(counter.against[1] + shift * along[1])),
            back=counter.back,
            turn=counter.turn,
        )
        for kind, shift in (("sink", -0.6), ("hob", 0.65))
    ]


def _table(cell: Cell, floor: _Floor, width: float, depth: float) -> list[Furniture]:
    """A table with chairs where it has room around, as near to the middle as can be."""
    left, bottom, right, top = floor.box
    if top - bottom > right - left:
        width, depth = depth, width
    middle = ((left + right) / 2, (bottom + top) / 2)
    places = [(x, y) for x in np.arange(left + 0.4, right, 0.2) for y in np.arange(bottom + 0.4, top, 0.2)]
    for x, y in sorted(places, key=lambda place: (place[0] - middle[0]) ** 2 + (place[1] - middle[1]) ** 2):
        box = (x - width / 2 - 0.5, y - depth / 2 - 0.5, x + width / 2 + 0.5, y + depth / 2 + 0.5)
        if floor.is_free(box):
            floor.taken.append(box)
            lengthwise = width >= depth
            size = (width, depth) if lengthwise else (depth, width)
            back: Compass = "north" if lengthwise else "west"
            chairs = 8 if size[0] > 2.5 else 6 if size[0] > 1.5 else 4
            return [Furniture("table", at=cell.block.out(x, y), back=back, size=size, turn=cell.block.turn, chairs=chairs)]
    return []


def _flight(cell: Cell, floor: _Floor) -> list[Stairs]:
    """A flight of stairs in a corner that no door needs, as wide as the room allows."""
    left, bottom, right, top = floor.box
    upright = top - bottom >= right - left
    long, across = (top - bottom, right - left) if upright else (right - left, top - bottom)
    for run, wide in ((3.2, 1.9), (2.8, 1.6), (2.4, 1.3), (2.2, 1.0)):
        w, h = (wide, run) if upright else (run, wide)
        for x in (left, right - w):
            for y in (bottom, top - h):
                if run < long and wide < 0.75 * across and floor.is_free((x, y, x + w, y + h)):
                    floor.taken.append((x, y, x + w, y + h))
                    up: Compass = (
                        ("north" if y < bottom + 0.1 else "south") if upright else ("east" if x < left + 0.1 else "west")
                    )
                    at = cell.block.out(x + w / 2, y + h / 2)
                    return [Stairs(at=at, size=(wide, run), treads=max(6, round(run / 0.28)), up=up)]
    return []


def _free_place(floor: _Floor, label: Label) -> tuple[Point, float, bool] | None:
    """Where a label fits, as near to the middle as can be: with the area, without it, or smaller; None when nowhere."""
    left, bottom, right, top = floor.box
    middle = ((left + right) / 2, (bottom + top) / 2)
    places = [(x, y) for x in np.arange(left + 0.15, right, 0.12) for y in np.arange(bottom + 0.15, top, 0.12)]
    places.sort(key=lambda place: (place[0] - middle[0]) ** 2 + (place[1] - middle[1]) ** 2)
    wide = text_width(label.name.upper(), label.font)
    for size, lines in ((label.text, 2), (label.text, 1), (0.75 * label.text, 1)):
        half = size * max(wide, text_width("88.8 m", label.font) if lines == 2 else 0.0) / 2 + 0.05
        high = (1.6 if lines == 2 else 0.7) * size + 0.03
        for x, y in places:
            if floor.is_free((x - half, y - high, x + half, y + high + label.above)):
                return (float(x), float(y)), size, lines == 2
    return None


def _piece(cell: Cell, kind: str, against: Point, back: Compass, size: tuple[float, float], more: dict[str, Any]) -> Furniture:
    """A piece that stands against a wall of its room."""
    return Furniture(kind, against=cell.block.out(*against), back=back, size=size, turn=cell.block.turn, **more)
