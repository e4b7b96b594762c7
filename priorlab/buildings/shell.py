"""Walls, doors and windows of a house that is grown from a seed: a hall with rooms on both sides, and what is added to it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import cycle

import cv2
import numpy as np

from priorlab.buildings.cells import Block, Box, Cell, Link, Side, reached, shared_side, split_at, split_evenly
from priorlab.buildings.outline import Outline
from priorlab.buildings.parts import Compass, DoorPart, Point, Wall, WindowPart
from priorlab.buildings.recipe import Recipe

NARROWEST = 1.15
"""Shortest shared wall that a door is put into, metres."""

WIDE = {"double": 1.5, "double_unequal": 1.25, "folding": 1.2}
"""Doors that are wider than a leaf, metres."""

JAMB = 0.15
"""Wall that is left between a door and the next corner, metres."""


@dataclass(frozen=True)
class Shell:
    """A house without its furniture."""

    outline: Outline
    walls: tuple[Wall, ...]
    doors: tuple[DoorPart, ...]
    windows: tuple[WindowPart, ...]
    cells: tuple[Cell, ...]


def shell_of(recipe: Recipe, outline: Outline, outer: float, inner: float, rng: np.random.Generator) -> Shell:
    """Split the house into rooms, join them by doors, light them by windows; thicknesses in metres."""
    width, depth = recipe.size
    in_wing = {"flat": 0, "corridor": 0, "wing": max(2, recipe.rooms // 4), "diagonal": 2}[recipe.kind]
    grow = _office if recipe.kind in ("corridor", "wing") else _flat
    clear = (outer, outer, width - outer, depth - outer)
    boxes, uses, paths = grow(clear, recipe.rooms - in_wing, inner, rng)
    house = [Cell(Block(), box, use) for box, use in zip(boxes, uses, strict=True)]
    walls = [Wall("outer", outline=outline.main)] + [Wall("inner", path=tuple(path)) for path in paths]
    added, more = _added(recipe, outline, in_wing, outer, inner, rng)
    cells = _used(house + added, recipe)
    house, added = cells[: len(house)], cells[len(house) :]
    links = reached(house, inner, NARROWEST, rng) + reached(added, inner, NARROWEST, rng)
    if recipe.kind == "wing":
        links.append(_widest(house, added[-1], outer))
    elif recipe.kind == "diagonal":
        low, high = outline.wing[0][1] + 0.9 * outer, outline.wing[3][1] - 0.9 * outer
        links.append(_through(house, added[0], low, high, width - outer / 2))
    doors = _doors(recipe, links, cells[0], outer, rng)
    return Shell(outline, (*walls, *more), tuple(doors), tuple(_windows(cells, outline, doors, outer)), tuple(cells))


def _added(
    recipe: Recipe, outline: Outline, rooms: int, outer: float, inner: float, rng: np.random.Generator
) -> tuple[list[Cell], list[Wall]]:
    """The cells and walls of a second wing, if there is one."""
    width = recipe.size[0]
    if recipe.kind == "wing":
        left, low = outline.main[2]
        boxes, paths = split_evenly((left + outer, low + outer, width - outer, 0.0), 1, rooms, inner, rng)
        between = Wall("outer", path=((left + outer / 2, outer / 2), (width - outer / 2, outer / 2)))
        return [Cell(Block(), box) for box in boxes], [between, *(Wall("inner", path=tuple(path)) for path in paths)]
    if recipe.kind == "diagonal":
        block, (start, _, end, top) = outline.wing_block, outline.wing_box
        boxes, paths = split_evenly((start + 0.5 * outer, outer, end - outer, top - outer), 0, rooms, inner, rng)
        inner_walls = [Wall("inner", path=tuple(block.out(*point) for point in path)) for path in paths]
        return [Cell(block, box) for box in boxes], [Wall("outer", path=_wing_path(outline, outer)), *inner_walls]
    return [], []


def _office(box: Box, rooms: int, wall: float, rng: np.random.Generator) -> tuple[list[Box], list[str], list[list[Point]]]:
    """A corridor through the middle, a row of rooms on either side."""
    wide = float(rng.uniform(1.7, 2.1))
    return _rows(box, rooms, wall, wide, "corridor", rng)


def _flat(box: Box, rooms: int, wall: float, rng: np.random.Generator) -> tuple[list[Box], list[str], list[list[Point]]]:
    """A hall with rooms on either side; it ends at the living room, which may have a kitchen beside it."""
    end = round(box[0] + float(rng.uniform(0.56, 0.64)) * (box[2] - box[0]), 2)
    west, east, path = split_at(box, 0, end, wall)
    with_kitchen = rooms >= 6
    boxes, uses, paths = _rows(west, rooms - 1 - with_kitchen, wall, float(rng.uniform(1.35, 1.6)), "hall", rng)
    paths.append(path)
    if not with_kitchen:
        return [*boxes, east], [*uses, "living"], paths
    hall = boxes[0]
    above, below = east[3] - hall[3], hall[1] - east[1]
    cut = hall[3] + 0.12 * above + wall if above > below else hall[1] - 0.12 * below - wall
    low, high, path = split_at(east, 1, round(cut, 2), wall)
    living, kitchen = (low, high) if above > below else (high, low)
    return [*boxes, living, kitchen], [*uses, "living", "kitchen"], [*paths, path]


def _rows(
    box: Box, rooms: int, wall: float, wide: float, name: str, rng: np.random.Generator
) -> tuple[list[Box], list[str], list[list[Point]]]:
    """A hall from west to east and two rows of rooms along it; the hall is the first box."""
    low = box[1] + float(rng.uniform(0.46, 0.54)) * (box[3] - box[1] - wide)
    south, rest, one = split_at(box, 1, round(low, 2), wall)
    hall, north, other = split_at(rest, 1, round(low + wide + wall, 2), wall)
    in_south = max(1, (rooms - 1) // 2)
    rows, paths = [hall], [one, other]
    for row, number in ((south, in_south), (north, max(1, rooms - 1 - in_south))):
        more, walls = split_evenly(row, 0, number, wall, rng)
        rows += more
        paths += walls
    return rows, [name] + [""] * (len(rows) - 1), paths


def _wing_path(outline: Outline, outer: float) -> tuple[Point, ...]:
    """The centre line of the wing's three walls; it begins and ends within the main house's wall."""
    block, half = outline.wing_block, outer / 2
    _, _, end, top = outline.wing_box
    cos, sin = float(np.cos(np.radians(block.turn))), float(np.sin(np.radians(block.turn)))

    def start(level: float) -> Point:
        along = (level * sin - half) / cos  # where the line at this level meets the main wall's centre line
        return block.out(along, level)

    return start(half), block.out(end - half, half), block.out(end - half, top - half), start(top - half)


def _widest(house: list[Cell], added: Cell, thickest: float) -> Link:
    """The wall that an added cell shares with the main house, where it is longest."""
    sides = [(cell, side) for cell in house if (side := shared_side(cell.box, added.box, thickest)) is not None]
    cell, side = max(sides, key=lambda pair: pair[1].length)
    return cell, added, side


def _through(house: list[Cell], added: Cell, low: float, high: float, level: float) -> Link:
    """The main house's eastern wall between two heights, for the cell that has most of it."""
    right = max(cell.box[2] for cell in house)
    at_wall = [cell for cell in house if abs(cell.box[2] - right) < 0.01]
    best = max(at_wall, key=lambda cell: min(high, cell.box[3]) - max(low, cell.box[1]))
    return best, added, Side(level, max(low, best.box[1]), min(high, best.box[3]), "east")


def _used(cells: list[Cell], recipe: Recipe) -> list[Cell]:
    """A use for every cell that has none: the smallest are bathrooms, one holds the stairs, the largest is for meeting."""
    homely = recipe.kind in ("flat", "diagonal")
    askew = [n for n, cell in enumerate(cells) if cell.block.turn]
    cells = [replace(cell, use=("study", "bedroom")[n % 2]) if n in askew else cell for n, cell in enumerate(cells)]
    free = sorted((n for n, cell in enumerate(cells) if not cell.use), key=lambda n: cells[n].area)
    uses = ["bath", "stairs"] if homely else ["wc", "stairs", "kitchen"]
    uses = [use for use in uses if use != "stairs" or recipe.rooms >= 7]
    rest = cycle(["study", "child", "bedroom"] if homely else ["archive", "office", "office"])
    uses = uses[: len(free)] + [next(rest) for _ in range(len(free) - len(uses))]
    if len(free) > 2:
        uses[-1] = "bedroom" if homely else "meeting"
    named = dict(zip(free, uses, strict=True))
    return [replace(cell, use=named.get(n, cell.use)) for n, cell in enumerate(cells)]


def _doors(recipe: Recipe, links: list[Link], hall: Cell, outer: float, rng: np.random.Generator) -> list[DoorPart]:
    """The entrance at the hall's western end, then a door for every link, kinds by turns."""
    entrance = Side(outer / 2, hall.box[1], hall.box[3], "west")
    kinds = cycle(sorted(map(str, recipe.doors), key=lambda kind: not kind.startswith("double")))
    narrow = cycle([str(kind) for kind in recipe.doors if kind not in WIDE] or ["arc"])
    front = _door(hall.block, entrance, next(kinds), "east", 0.95, rng)
    doors = [replace(front, open=0.0)]  # shut in the world, or its leaf would stand before the next door
    for one, other, side in links:
        opposite: Compass = {"north": "south", "south": "north", "east": "west", "west": "east"}[side.towards]  # type: ignore[assignment]
        opens = side.towards if one.use in ("hall", "corridor") or side.towards == "east" else opposite
        kind = next(kinds)
        if kind in WIDE and {one.use, other.use} & {"bath", "wc", "child", "stairs"}:
            kind = next(narrow)
        doors.append(_door(one.block, side, kind, opens, float(rng.choice([0.8, 0.86])), rng))
    return doors


def _door(block: Block, side: Side, kind: str, opens: Compass, width: float, rng: np.random.Generator) -> DoorPart:
    """A door near one end of a shared wall, hinged where the corner is; too wide a kind becomes a plain one."""
    wide = WIDE.get(kind, width)
    if side.length < wide + 2 * JAMB:
        kind, wide = "arc" if kind != "arc_panel" else kind, min(width, side.length - 2 * JAMB)
    at_low = bool(rng.random() < 0.5)
    slack = max(0.0, side.length - wide - 2 * JAMB)
    shift = JAMB + wide / 2 + min(slack, float(rng.uniform(0.0, 0.35)))
    along = side.low + shift if at_low else side.high - shift
    upright = side.towards in ("east", "west")
    end: Compass = ("south" if at_low else "north") if upright else ("west" if at_low else "east")
    drawn = {"double_unequal": "double", "leaf_90": "leaf", "leaf_45": "leaf"}.get(kind, kind)
    return DoorPart(
        at=block.out(*side.at(along)),
        width=wide,
        hinge=block.compass(end),
        opens=block.compass(opens),
        kind=drawn,  # type: ignore[arg-type]
        drawn_open=45.0 if kind == "leaf_45" else 90.0,
        share=0.68 if kind == "double_unequal" else 0.5,
    )


def _windows(cells: list[Cell], outline: Outline, doors: list[DoorPart], outer: float) -> list[WindowPart]:
    """Windows in the middle of every outer wall of a room, where neither door nor wing is in the way."""
    solids = [np.array(polygon, dtype=np.float32) for polygon in (outline.main, outline.wing) if polygon]
    windows = []
    for cell in cells:
        left, bottom, right, top = cell.box
        for side in (
            Side(bottom - outer / 2, left, right, "south"),
            Side(top + outer / 2, left, right, "north"),
            Side(left - outer / 2, bottom, top, "west"),
            Side(right + outer / 2, bottom, top, "east"),
        ):
            number = 2 if side.length > 5.5 else 1
            width = round(min(2.0, 0.5 * side.length / number) if cell.use not in ("bath", "wc") else 0.7, 2)
            for n in range(number):
                middle = side.low + (n + 0.5) * side.length / number
                ends = [_outside(cell, side, middle + shift, outer) for shift in (-width / 2 - 0.2, 0.0, width / 2 + 0.2)]
                at = cell.block.out(*side.at(middle))
                clear = all(np.hypot(at[0] - d.at[0], at[1] - d.at[1]) > (width + d.width) / 2 + 0.2 for d in doors)
                outdoors = all(cv2.pointPolygonTest(solid, point, False) < 0 for solid in solids for point in ends)
                if width >= 0.6 and side.length > width + 0.4 and clear and outdoors:
                    windows.append(WindowPart(at=at, width=width, casements=2 if width > 1.5 else 1))
    return windows


def _outside(cell: Cell, side: Side, along: float, outer: float) -> Point:
    """A point just beyond an outer wall."""
    sign = 1 if side.towards in ("north", "east") else -1
    level = side.level + sign * (outer / 2 + 0.15)
    return cell.block.out(*((level, along) if side.towards in ("east", "west") else (along, level)))
