"""Straight pieces of wall, openings in them, and the triangles of the doors: pure geometry in the description's metres."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from priorlab.buildings.parts import Compass, Description, DoorPart, Point, Wall, WallStyle, WindowPart

COMPASS: dict[str, Point] = {"north": (0.0, 1.0), "south": (0.0, -1.0), "east": (1.0, 0.0), "west": (-1.0, 0.0)}

Points = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Piece:
    """A straight piece of wall: centre line `start` to `end`, its (4, 2) mitred outline, and its style."""

    start: Points
    end: Points
    outline: Points
    style: str
    thickness: float

    @property
    def along(self) -> Points:
        """Unit vector from start to end."""
        return (self.end - self.start) / np.linalg.norm(self.end - self.start)


@dataclass(frozen=True, eq=False)
class Opening:
    """A gap in a wall: its middle on the centre line, unit vectors along and across the wall, width and wall thickness."""

    middle: Points
    along: Points
    across: Points
    width: float
    thickness: float

    def corner(self, along: float, across: float) -> Points:
        """A point of the opening: `along` and `across` in halves of width and thickness (-1 to 1)."""
        return self.middle + along * self.width / 2 * self.along + across * self.thickness / 2 * self.across

    @property
    def outline(self) -> Points:
        """(4, 2) corners of the gap in the wall."""
        return np.array([self.corner(-1, -1), self.corner(1, -1), self.corner(1, 1), self.corner(-1, 1)])


@dataclass(frozen=True, eq=False)
class Leaf:
    """One swinging leaf: hinge and strike on the face of the wall, unit vectors of the shut and of the square-open leaf."""

    hinge: Points
    strike: Points
    shut: Points
    square: Points
    width: float

    def tip(self, degrees: float) -> Points:
        """The free end of the leaf when it is opened so far."""
        angle = math.radians(degrees)
        return self.hinge + self.width * (math.cos(angle) * self.shut + math.sin(angle) * self.square)


def pieces_of(wall: Wall, style: WallStyle, metres_per_pixel: float) -> list[Piece]:
    """The straight pieces of a wall, joined by mitres."""
    thickness = style.line * metres_per_pixel if style.look == "single" else style.thickness
    if wall.outline:
        outer = np.array(wall.outline)
        if _signed_area(outer) < 0:
            outer = outer[::-1]
        inner = _shifted(outer, thickness, closed=True)
        one, other = np.vstack([outer, outer[:1]]), np.vstack([inner, inner[:1]])
    else:
        path = np.array(wall.path)
        closed = len(path) > 3 and np.allclose(path[0], path[-1])
        line = path[:-1] if closed else path
        one, other = (_shifted(line, side * thickness / 2, closed) for side in (-1, 1))
        if closed:
            one, other = np.vstack([one, one[:1]]), np.vstack([other, other[:1]])
    middle = (one + other) / 2
    return [
        Piece(middle[i], middle[i + 1], np.array([one[i], one[i + 1], other[i + 1], other[i]]), wall.style, thickness)
        for i in range(len(middle) - 1)
    ]


def opening_in(pieces: list[Piece], part: DoorPart | WindowPart, where: str) -> Opening:
    """The gap that a door or window makes in the wall it stands on; `where` names it in messages."""
    at = np.array(part.at)
    best, best_distance, best_share = None, math.inf, 0.0
    for piece in pieces:
        length = float(np.linalg.norm(piece.end - piece.start))
        share = float((at - piece.start) @ piece.along)
        offset = at - piece.start - np.clip(share, 0, length) * piece.along
        distance = float(np.linalg.norm(offset)) - piece.thickness / 2
        if distance < best_distance - 1e-9:
            best, best_distance, best_share = piece, distance, share
    if best is None or best_distance > 0.05:
        raise ValueError(f"{where}: at must lie on a wall, got {list(part.at)}, which is {best_distance:.2f} m from the nearest")
    length = float(np.linalg.norm(best.end - best.start))
    if not part.width / 2 - 1e-6 <= best_share <= length - part.width / 2 + 1e-6:
        raise ValueError(
            f"{where}: width must fit on its straight wall of {length:.2f} m, got {part.width:g} m at {list(part.at)}"
        )
    along = best.along
    return Opening(best.start + best_share * along, along, np.array([-along[1], along[0]]), part.width, best.thickness)


def leaves_of(door: DoorPart, opening: Opening) -> list[Leaf]:
    """The swinging leaves of a door: none of sliding doors and bare openings, two of double doors."""
    if door.kind in ("sliding", "opening"):
        return []
    to_hinge = _towards(door.hinge, opening.along)
    side = _towards(door.opens, opening.across)
    hinge, far = opening.corner(to_hinge, side), opening.corner(-to_hinge, side)
    square = side * opening.across
    shut = -to_hinge * opening.along
    if door.kind != "double":
        return [Leaf(hinge, far, shut, square, door.width)]
    width = door.share * door.width
    meeting = hinge + width * shut
    return [Leaf(hinge, meeting, shut, square, width), Leaf(far, meeting, -shut, square, door.width - width)]


def pieces(description: Description) -> list[Piece]:
    """All straight pieces of wall of a building."""
    return [
        piece
        for wall in description.walls
        for piece in pieces_of(wall, description.styles[wall.style], description.metres_per_pixel)
    ]


def rectangle(middle: Points, width: float, depth: float, degrees: float = 0.0) -> Points:
    """(4, 2) corners of a turned rectangle."""
    corners = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]]) * (width, depth)
    return np.asarray(middle) + turned(corners, degrees)


def turned(points: Points, degrees: float) -> Points:
    """Points turned counter-clockwise about the origin; quarter turns are exact."""
    quarter = round(degrees / 90)
    if abs(degrees - 90 * quarter) < 1e-9:
        cos, sin = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[quarter % 4]
    else:
        cos, sin = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return np.asarray(points, dtype=np.float64) @ np.array([[cos, sin], [-sin, cos]])


def _towards(word: Compass | None, axis: Points) -> int:
    """+1 when a compass word points along `axis`, -1 when against it."""
    assert word is not None  # DoorPart has checked it
    return 1 if float(np.dot(COMPASS[word], axis)) >= 0 else -1


def _signed_area(polygon: Points) -> float:
    """Twice the area, positive when counter-clockwise."""
    x, y = polygon.T
    return float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))


def _shifted(line: Points, distance: float, closed: bool) -> Points:
    """A line moved to its left, its corners mitred."""
    ends = np.vstack([line, line[:1]]) if closed else line
    along = np.diff(ends, axis=0)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    normal = np.column_stack([-along[:, 1], along[:, 0]])
    before = np.vstack([normal[-1:], normal[:-1]]) if closed else np.vstack([normal[:1], normal])
    after = normal if closed else np.vstack([normal, normal[-1:]])
    mitre = before + after
    return line + distance * mitre * (2 / np.maximum(np.sum(mitre**2, axis=1, keepdims=True), 0.5))
