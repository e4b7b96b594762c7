"""A description worked out: where every piece of wall, opening, leaf and piece of furniture lies."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from priorlab.buildings.frame import Frame, frame_of
from priorlab.buildings.geometry import COMPASS, Leaf, Opening, Piece, Points, leaves_of, opening_in, pieces, rectangle, turned
from priorlab.buildings.parts import FURNITURE_SIZES, Description, DoorPart, Furniture, Stairs, WindowPart

QUARTERS = {"north": 0.0, "west": 90.0, "south": 180.0, "east": 270.0}
"""How far a piece is turned whose back looks that way, degrees."""


@dataclass(frozen=True, eq=False)
class PlacedDoor:
    """A door with its gap in the wall and its leaves."""

    part: DoorPart
    opening: Opening
    leaves: tuple[Leaf, ...]


@dataclass(frozen=True, eq=False)
class PlacedWindow:
    """A window with its gap in the wall."""

    part: WindowPart
    opening: Opening


@dataclass(frozen=True, eq=False)
class Placed:
    """Something with a back: its middle, width along the back, depth and turn in degrees; +y of its own frame is the back."""

    part: Furniture | Stairs
    middle: Points
    width: float
    depth: float
    turn: float

    def at(self, local: Points) -> Points:
        """(..., 2) points of its own frame in the building's metres."""
        return self.middle + turned(local, self.turn)


@dataclass(frozen=True, eq=False)
class Layout:
    """Everything placed."""

    description: Description
    frame: Frame
    pieces: tuple[Piece, ...]
    doors: tuple[PlacedDoor, ...]
    windows: tuple[PlacedWindow, ...]
    furniture: tuple[Placed, ...]
    stairs: tuple[Placed, ...]


def lay_out(description: Description) -> Layout:
    """Work a description out, or say which door or window stands on no wall."""
    walls = pieces(description)
    doors = []
    for number, door in enumerate(description.doors, start=1):
        opening = opening_in(walls, door, f"doors {number}")
        doors.append(PlacedDoor(door, opening, tuple(leaves_of(door, opening))))
    windows = [
        PlacedWindow(window, opening_in(walls, window, f"windows {number}"))
        for number, window in enumerate(description.windows, start=1)
    ]
    return Layout(
        description,
        frame_of(description),
        tuple(walls),
        tuple(doors),
        tuple(windows),
        tuple(place(piece) for piece in description.furniture),
        tuple(Placed(flight, np.array(flight.at), *flight.size, QUARTERS[flight.up]) for flight in description.stairs),
    )


def place(piece: Furniture) -> Placed:
    """Where a piece of furniture stands."""
    width, depth = piece.size or FURNITURE_SIZES[piece.kind]
    turn = QUARTERS[piece.back] + piece.turn
    if piece.at is not None:
        middle = np.array(piece.at)
    else:
        middle = np.array(piece.against) - depth / 2 * turned(np.array(COMPASS["north"]), turn)
    return Placed(piece, middle, width, depth, turn)


def chairs_of(placed: Placed) -> list[Placed]:
    """The chairs that belong to a table or desk: by turns in front and behind, then at the ends."""
    part = placed.part
    if not isinstance(part, Furniture) or not part.chairs:
        return []
    if part.kind == "desk":
        seats = [((0.0, -placed.depth / 2 - 0.2), 180.0)]
    elif part.kind == "round_table":
        angles = np.arange(part.chairs) * 360 / part.chairs
        radius = placed.width / 2 + 0.12
        seats = [((-radius * np.sin(np.radians(a)), radius * np.cos(np.radians(a))), float(a)) for a in angles]
    else:
        at_ends = min(2, part.chairs % 2 if part.chairs < 6 else 2 - part.chairs % 2)
        rows = (part.chairs - at_ends) // 2
        spread = (np.arange(rows) + 0.5) * placed.width / max(rows, 1) - placed.width / 2
        side, end = placed.depth / 2 + 0.12, placed.width / 2 + 0.12
        seats = [((x, side), 0.0) for x in spread] + [((x, -side), 180.0) for x in spread]
        seats += [((-end, 0.0), 90.0), ((end, 0.0), 270.0)][:at_ends]
    chair = Furniture(kind="chair", at=(0.0, 0.0), only_in_world=part.only_in_world)
    return [Placed(chair, placed.at(np.array(middle)), 0.45, 0.45, placed.turn + turn) for middle, turn in seats]


def footprints(placed: Placed) -> list[Points]:
    """Convex outlines of the floor that a piece takes, its chairs included."""
    round_kind = isinstance(placed.part, Furniture) and placed.part.kind in ("round_table", "plant")
    if round_kind:
        angle = np.radians(np.arange(0, 360, 15))
        own = placed.at(np.column_stack([placed.width / 2 * np.cos(angle), placed.depth / 2 * np.sin(angle)]))
    else:
        own = rectangle(placed.middle, placed.width, placed.depth, placed.turn)
    return [own] + [rectangle(chair.middle, chair.width, chair.depth, chair.turn) for chair in chairs_of(placed)]
