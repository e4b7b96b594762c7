"""Furniture that the plan lacks, put into a building's rooms by chance: the clutter of chapter 6.

The drawing and its truth stay as they are. Pieces keep away from doors and from each other, and none cuts a room off.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.buildings.layout import Layout, footprints, lay_out, place
from priorlab.buildings.paper import coverage, fine_mask
from priorlab.buildings.parts import Compass, Description, Furniture, Point
from priorlab.buildings.rooms import indoors, room_regions
from priorlab.buildings.tour import Passable
from priorlab.buildings.world import world_of

PIECES_PER_CLUTTER = 4.0
"""Clutter c means about 4 c pieces for each room (method-slam.md, section 1)."""

KINDS: tuple[tuple[str, tuple[float, float], bool], ...] = (
    ("desk", (1.3, 0.7), False),
    ("table", (1.6, 0.8), False),
    ("round_table", (0.9, 0.9), False),
    ("box", (0.6, 0.5), False),
    ("plant", (0.6, 0.6), False),
    ("cabinet", (1.2, 0.5), True),
    ("shelf", (1.5, 0.4), True),
    ("sofa", (1.5, 0.8), True),
)
"""Kind, width and depth in metres, and whether it stands with its back to a wall."""

SIDES: tuple[Compass, ...] = ("south", "east", "north", "west")

DOOR_ROOM_M = 1.0
"""Round the middle of a door's opening nothing stands so near, metres."""

APART_M = 0.1
"""Between two pieces, metres."""

TRIES = 30
"""Places that are tried for a piece; in a room that is full it is left out."""

CUT_OFF_M2 = 0.5
"""A piece may cut off so much floor behind it, not more: no room becomes unreachable."""


def with_loose_furniture(description: Description, clutter: float, rng: np.random.Generator) -> Description:
    """A building with other loose furniture: what only the world held is taken out, and other pieces are put in.

    Parameters
    ----------
    description : of the building
    clutter : about four times as many pieces for each room: 0 is none, 0.3 one or two, 0.6 two or three
    rng : draws how many, which and where

    Returns
    -------
    Description with the same plan

    Raises
    ------
    ValueError
        When `clutter` is negative or not finite.
    """
    if not (math.isfinite(clutter) and clutter >= 0):
        raise ValueError(f"clutter must be a finite number of at least 0, got {clutter:g}")
    bare = replace(description, furniture=tuple(piece for piece in description.furniture if not piece.only_in_world))
    floor = _Floor.of(lay_out(bare))
    most = PIECES_PER_CLUTTER * clutter
    added = []
    for region in floor.regions:
        n_pieces = int(most) + int(rng.random() < most - int(most))
        for _ in range(n_pieces):
            piece = _place_one(floor, region, rng)
            if piece is not None:
                added.append(piece)
    return replace(bare, furniture=(*bare.furniture, *added))


@dataclass
class _Floor:
    """What is taken and what a robot still reaches, while pieces are put in; images, True = so."""

    layout: Layout
    regions: list[NDArray[np.bool_]]
    solid: NDArray[np.bool_]
    taken: NDArray[np.bool_]
    outdoors: NDArray[np.bool_]
    cut_off_m2: float = 0.0

    @classmethod
    def of(cls, layout: Layout) -> _Floor:
        """Without loose furniture."""
        solid = world_of(layout).obstacles
        near_doors = np.zeros(solid.shape, dtype=np.uint8)
        radius = round(DOOR_ROOM_M / layout.frame.metres_per_pixel)
        for door in layout.doors:
            x, y = np.rint(layout.frame.to_image(door.part.at)).astype(int)
            cv2.circle(near_doors, (int(x), int(y)), radius, 1, -1)
        regions = list(room_regions(layout, solid).values())
        floor = cls(layout, regions, solid, solid | near_doors.astype(bool), ~indoors(layout, solid))
        floor.cut_off_m2 = floor.cut_off_by(solid)
        return floor

    def footprint(self, piece: Furniture) -> NDArray[np.bool_]:
        """(height, width) True where a piece stands."""
        return coverage(fine_mask(self.layout.frame, footprints(place(piece)))) >= 0.5

    def cut_off_by(self, solid: NDArray[np.bool_]) -> float:
        """Floor that a robot fits on but cannot get to from the largest free part, square metres."""
        ground = Passable(solid | self.outdoors, self.layout.frame.metres_per_pixel)
        _, _, stats, _ = cv2.connectedComponentsWithStats(ground.free.astype(np.uint8), connectivity=8)
        parts = np.sort(stats[1:, cv2.CC_STAT_AREA])
        return float(parts[:-1].sum()) * (ground.step * ground.scale) ** 2


def _place_one(floor: _Floor, region: NDArray[np.bool_], rng: np.random.Generator) -> Furniture | None:
    """A piece of a random kind somewhere in a room, or None when no place was found; marks what it takes."""
    scale = floor.layout.frame.metres_per_pixel
    gap = np.ones((2 * math.ceil(APART_M / scale) + 1,) * 2, np.uint8)
    for _ in range(TRIES):
        piece = _drawn(floor, region, rng)
        where = floor.footprint(piece)
        if (where & ~region).any() or (where & floor.taken).any():
            continue
        cut_off = floor.cut_off_by(floor.solid | where)
        if cut_off > floor.cut_off_m2 + CUT_OFF_M2:
            continue
        floor.solid, floor.cut_off_m2 = floor.solid | where, cut_off
        floor.taken |= cv2.dilate(where.astype(np.uint8), gap).astype(bool)
        return piece
    return None


def _drawn(floor: _Floor, region: NDArray[np.bool_], rng: np.random.Generator) -> Furniture:
    """A piece at a random place of a room's bounding box; it may not fit."""
    kind, size, at_wall = KINDS[int(rng.integers(len(KINDS)))]
    frame = floor.layout.frame
    rows, cols = np.flatnonzero(region.any(axis=1)), np.flatnonzero(region.any(axis=0))
    (left, bottom), (right, top) = (
        np.array([col, frame.shape[0] - row]) * frame.metres_per_pixel + frame.origin_m
        for col, row in ((cols[0], rows[-1] + 1), (cols[-1] + 1, rows[0]))
    )
    at = (float(rng.uniform(left, right)), float(rng.uniform(bottom, top)))
    if not at_wall:
        turn = float(rng.choice([0.0, 0.0, 0.0, rng.uniform(-20, 20)]))
        return Furniture(kind, at=at, back=SIDES[int(rng.integers(4))], size=size, turn=turn, only_in_world=True)
    side = SIDES[int(rng.integers(4))]
    off = frame.metres_per_pixel  # a pixel of air, or the footprint would lie on the wall
    at_side: dict[str, Point] = {
        "south": (at[0], bottom + off),
        "north": (at[0], top - off),
        "west": (left + off, at[1]),
        "east": (right - off, at[1]),
    }
    return Furniture(kind, against=at_side[side], back=side, size=size, only_in_world=True)
