"""Doors and windows as an architect draws them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from priorlab.buildings.geometry import Leaf, Points
from priorlab.buildings.layout import PlacedDoor, PlacedWindow
from priorlab.buildings.paper import Paper

LEAF = 0.045
"""Thickness of a door leaf, metres."""


@dataclass(frozen=True)
class DoorHand:
    """How an office draws its doors: thickness of leaves and of the frame's posts in metres, weight of the arc as a share."""

    leaf: float = LEAF
    is_solid: bool = False
    post: float = 0.0
    arc: float = 1.0


DOOR_HANDS: dict[str, DoorHand] = {
    "plain": DoorHand(),
    "slab": DoorHand(leaf=0.075),
    "framed": DoorHand(leaf=0.055, post=0.06),
    "solid": DoorHand(leaf=0.04, is_solid=True, arc=0.75),
}
"""Door symbols by name."""


def draw_door(paper: Paper, door: PlacedDoor, weight: float, ink: str = "#000000", symbol: str = "plain") -> None:
    """The symbol of a door: its frame, its leaves, and what its kind adds."""
    part, opening, hand = door.part, door.opening, DOOR_HANDS[symbol]
    for side in (-1, 1) if hand.post and door.leaves else ():
        middle = opening.middle + side * (opening.width - hand.post) / 2 * opening.along
        paper.shape(bar(middle, opening.along, hand.post, opening.thickness), weight, ink)
    for leaf in door.leaves:
        if part.kind == "folding":
            _draw_folding(paper, leaf, hand, weight, ink)
        else:
            as_panel = part.kind == "arc_panel" or hand.is_solid
            _draw_leaf(paper, leaf, part.drawn_open, hand, as_panel, part.kind != "leaf", weight, ink)
    if part.kind == "sliding":
        for sign in (-1, 1):
            leaf_middle = opening.middle + sign * (0.22 * part.width * opening.along + 0.55 * LEAF * opening.across)
            paper.shape(bar(leaf_middle, opening.along, 0.56 * part.width, LEAF), weight, ink)
    if part.threshold:
        side = -1 if not door.leaves or float(door.leaves[0].square @ opening.across) > 0 else 1
        paper.line([opening.corner(-1, side), opening.corner(1, side)], weight, ink)


def _draw_leaf(paper: Paper, leaf: Leaf, degrees: float, hand: DoorHand, panel: bool, arc: bool, weight: float, ink: str) -> None:
    """An open leaf, a line or a rectangle, and the quarter arc of its tip."""
    tip = leaf.tip(degrees)
    if arc:
        angles = np.linspace(0, degrees, max(8, round(degrees / 4)))
        paper.line([leaf.tip(float(angle)) for angle in angles], hand.arc * weight, ink)
    if panel:
        along = (tip - leaf.hinge) / leaf.width
        inwards = leaf.tip(degrees - 90) - leaf.hinge
        middle = (leaf.hinge + tip) / 2 + hand.leaf / 2 * inwards / leaf.width
        paper.shape(bar(middle, along, leaf.width, hand.leaf), weight, ink, _fill(hand, ink))
    else:
        paper.line([leaf.hinge, tip], weight, ink)


def folded(leaf: Leaf) -> Points:
    """(5, 2) zigzag of a folding door: two pairs of panels, folded half open, from the hinge to the free end."""
    reach, panel = 0.62 * leaf.width, leaf.width / 4
    step = reach / 4
    height = math.sqrt(panel**2 - step**2)
    return np.array([leaf.hinge + i * step * leaf.shut + (i % 2) * height * leaf.square for i in range(5)])


def _fill(hand: DoorHand, ink: str) -> str:
    """The colour inside a leaf of two lines."""
    return ink if hand.is_solid else "#ffffff"


def _draw_folding(paper: Paper, leaf: Leaf, hand: DoorHand, weight: float, ink: str) -> None:
    """Panels in zigzag."""
    points = folded(leaf)
    for start, end in zip(points, points[1:], strict=False):
        along = (end - start) / np.linalg.norm(end - start)
        outline = bar((start + end) / 2, along, float(np.linalg.norm(end - start)), hand.leaf * 0.8)
        paper.shape(outline, weight, ink, _fill(hand, ink))


def draw_window(paper: Paper, window: PlacedWindow, weight: float, ink: str = "#000000", symbol: str = "box") -> None:
    """Both faces of the wall, the pane in between, the frame's posts; the wall's own ink closes the ends."""
    opening = window.opening
    inset = weight / 2 * paper.frame.metres_per_pixel / (opening.thickness / 2)  # the lines lie within the wall's faces
    for across in (-1 + inset, 1 - inset):
        paper.line([opening.corner(-1, across), opening.corner(1, across)], weight, ink)
    is_wide = opening.thickness / paper.frame.metres_per_pixel > 9
    if is_wide and symbol == "box":
        paper.shape(bar(opening.middle, opening.along, opening.width, 0.07), weight, ink)
    elif is_wide or symbol != "double":
        for across in PANES[symbol] if is_wide else (0.0,):
            paper.line([opening.corner(-1, across), opening.corner(1, across)], weight, ink)
    for share in np.linspace(-1, 1, window.part.casements + 1)[1:-1]:
        paper.line([opening.corner(share, -0.45), opening.corner(share, 0.45)], weight, ink)


PANES: dict[str, tuple[float, ...]] = {"line": (0.0,), "offset": (-0.45,), "double": (-0.33, 0.33)}
"""Where the panes lie between the faces of a wall, in halves of its thickness; "box" draws a frame of its own."""


def sills(window: PlacedWindow) -> list[Points]:
    """Ledges that stick out of both faces of the wall: ink that is no wall."""
    opening = window.opening
    reach = 1 + 0.12 / opening.thickness
    wide = 1 + 0.1 / opening.width
    return [
        np.array(
            [
                opening.corner(-wide, side),
                opening.corner(-wide, side * reach),
                opening.corner(wide, side * reach),
                opening.corner(wide, side),
            ]
        )
        for side in (-1, 1)
    ]


def bar(middle: Points, along: Points, length: float, thickness: float) -> Points:
    """(4, 2) corners of a slim rectangle."""
    across = np.array([-along[1], along[0]])
    return np.array(
        [middle + a * length / 2 * along + b * thickness / 2 * across for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    )
