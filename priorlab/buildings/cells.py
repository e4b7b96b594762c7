"""Rooms as rectangles: a house is split into cells, and neighbours are joined by doors until every room can be reached."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from priorlab.buildings.geometry import turned
from priorlab.buildings.parts import Compass, Point

Box = tuple[float, float, float, float]
"""Left, bottom, right, top."""

NORMALS: dict[Compass, Point] = {"south": (0.0, -1.0), "north": (0.0, 1.0), "west": (-1.0, 0.0), "east": (1.0, 0.0)}


@dataclass(frozen=True)
class Block:
    """A part of the house with an own frame: where its origin lies, metres, and how far it is turned, degrees."""

    origin: Point = (0.0, 0.0)
    turn: float = 0.0

    def out(self, x: float, y: float) -> Point:
        """A point of the block in the building's metres."""
        far = np.array(self.origin) + turned(np.array([x, y]), self.turn)
        return float(far[0]), float(far[1])

    def compass(self, side: Compass) -> Compass:
        """The compass word that lies nearest to a side of the block."""
        looks = turned(np.array(NORMALS[side]), self.turn)
        return max(NORMALS, key=lambda word: float(np.dot(NORMALS[word], looks)))


@dataclass(frozen=True)
class Cell:
    """A room between its walls: the block it lies in, its clear rectangle there, and what it is used for."""

    block: Block
    box: Box
    use: str = ""

    @property
    def area(self) -> float:
        """Square metres."""
        left, bottom, right, top = self.box
        return (right - left) * (top - bottom)


@dataclass(frozen=True)
class Side:
    """Where two cells, or a cell and outdoors, share a wall: along x or along y of the block, from low to high.

    `level` is the wall's centre line, `towards` the side of the first cell that it lies on.
    """

    level: float
    low: float
    high: float
    towards: Compass

    @property
    def length(self) -> float:
        """Metres."""
        return self.high - self.low

    def at(self, along: float) -> Point:
        """A point of the centre line in the block's frame."""
        return (self.level, along) if self.towards in ("east", "west") else (along, self.level)


Link = tuple[Cell, Cell, Side]
"""Two cells that a door joins, and the wall that it is in, seen from the first."""


def split_at(box: Box, axis: int, at: float, thickness: float) -> tuple[Box, Box, list[Point]]:
    """Two boxes with a wall between them at x = at (axis 0) or y = at (axis 1), and the wall's centre line, which runs into its
    neighbours."""
    left, bottom, right, top = box
    half = thickness / 2
    if axis == 0:
        return (left, bottom, at - half, top), (at + half, bottom, right, top), [(at, bottom - half), (at, top + half)]
    return (left, bottom, right, at - half), (left, at + half, right, top), [(left - half, at), (right + half, at)]


def split_evenly(
    box: Box, axis: int, number: int, thickness: float, rng: np.random.Generator
) -> tuple[list[Box], list[list[Point]]]:
    """A box cut into a row of so many boxes of uneven width, and the walls between them."""
    shares = rng.uniform(0.75, 1.3, number)
    cuts = box[axis] + np.cumsum(shares / shares.sum())[:-1] * (box[axis + 2] - box[axis])
    boxes, walls, rest = [], [], box
    for cut in cuts:
        first, rest, wall = split_at(rest, axis, round(float(cut), 2), thickness)
        boxes.append(first)
        walls.append(wall)
    return [*boxes, rest], walls


def shared_side(one: Box, other: Box, thickest: float) -> Side | None:
    """The wall between two boxes of one block, or None when they are no neighbours."""
    for axis in (0, 1):
        across, forward, backward = 1 - axis, ("east", "north")[axis], ("west", "south")[axis]
        low, high = max(one[across], other[across]), min(one[across + 2], other[across + 2])
        if high - low < 0.3:
            continue
        if -0.01 <= other[axis] - one[axis + 2] <= thickest + 0.01:
            return Side((other[axis] + one[axis + 2]) / 2, low, high, forward)  # type: ignore[arg-type]
        if -0.01 <= one[axis] - other[axis + 2] <= thickest + 0.01:
            return Side((one[axis] + other[axis + 2]) / 2, low, high, backward)  # type: ignore[arg-type]
    return None


def reached(cells: list[Cell], thickest: float, narrowest: float, rng: np.random.Generator) -> list[Link]:
    """Pairs of neighbours that join all cells of a block with as few doors as can be (Kruskal); halls are preferred."""
    edges = []
    for i, one in enumerate(cells):
        for j in range(i + 1, len(cells)):
            side = shared_side(one.box, cells[j].box, thickest)
            if side is not None and side.length >= narrowest:
                is_hall = bool({one.use, cells[j].use} & {"hall", "corridor"})
                edges.append((0.0 if is_hall else 1.0 + float(rng.random()), i, j, side))
    group = list(range(len(cells)))
    chosen: list[Link] = []
    for _, i, j, side in sorted(edges, key=lambda edge: edge[:3]):
        if group[i] != group[j]:
            chosen.append((cells[i], cells[j], side))
            group = [group[i] if g == group[j] else g for g in group]
    return chosen
