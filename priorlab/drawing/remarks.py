"""What a reader should know about a result: sentences for what was found, what was not, and what cannot be."""

from __future__ import annotations

from collections.abc import Sequence

from priorlab.core.drawing import Drawing
from priorlab.drawing.candidates import DoorSearch
from priorlab.drawing.left_out import LEAST_KEPT, share_kept
from priorlab.drawing.method import Method
from priorlab.drawing.pieces import WallPiece
from priorlab.drawing.sheet import Sheet
from priorlab.drawing.walls import WallSearch

LARGEST_SHARE = 0.25
"""No building has more of its sheet in its walls; the thickest that we drew have 13 %."""

SURE = 0.6
"""The surest piece of real walls is surer than this; drawings have one of .8 or more."""

FINE_DOOR = 1.5
"""Doors hardly so many times as wide as the narrowest that can be told are a sign that others were not."""

WHAT_FAILED = {
    "corners": "there is no corner of long lines",
    "wedges": "no two lines meet in a corner as a leaf and its swing do",
    "connectivity": "no two lines meet in a corner with white opposite, as a leaf and its swing do",
    "geometry": "none has two equal sides, the angles and the size of a door",
    "orientation": "none opens along a wall",
    "symbol": "none has the ink of a leaf and its swing",
    "open side": "none is open on the side that people walk through",
    "jamb support": "none stands between two ends of wall",
    "dark share": "all are filled with ink",
    "overlap": "all lie on each other",
    "size mode": "all differ in size",
    "kind": "none is like the others",
    "outer walls": "all touch the outer walls",
}
"""Why nothing is left, by the stage that left nothing."""


def lost_stage(sheet: Sheet, search: DoorSearch, method: Method) -> str:
    """The stage after which nothing was left of walls."""
    if not sheet.lines.any():
        return "ink"
    if not len(search.corners):
        return "corners"
    if search.doors or method.sources == "both":
        return "walls"
    left = search.funnel
    return next((name for name in left if left[name] == 0), "walls")


def remarks(
    drawing: Drawing, sheet: Sheet, doors: DoorSearch, walls: WallSearch, lost_at: str | None, method: Method
) -> tuple[str, ...]:
    """What a reader should know about this result, a sentence each."""
    name = drawing.name
    if lost_at == "ink":
        return (f"{name} shows no ink: nothing stands out from its paper.",)
    said = [*_about_sheet(drawing, sheet), *_about_doors(drawing, doors, method)]
    if lost_at is not None:
        seeds = "no door to grow walls from" if method.sources == "doors" else "no piece of ink looks like a wall"
        return (*said, f"No wall was found, lost at '{lost_at}': {seeds}.")
    if walls.chosen != "doors":
        said.append(f"Walls were chosen by line weight: {walls.chosen}.")
        kept = share_kept(walls.walls, sheet.to_input(sheet.walls))
        if kept < LEAST_KEPT:
            said.append(f"Only {100 * kept:.0f} % of the ink as heavy as these walls was taken for wall: look what is missing.")
    return (*said, *about_walls(name, float(walls.walls.mean()), walls.pieces))


def about_walls(name: str, share: float, pieces: Sequence[WallPiece]) -> list[str]:
    """Doubts about walls that are there.

    >>> about_walls("stripes", 0.96, [])
    ['96 % of stripes was taken for wall, more than any building has: a pattern or a fill was mistaken for walls.']
    """
    said = []
    if share > LARGEST_SHARE:
        said.append(
            f"{100 * share:.0f} % of {name} was taken for wall, more than any building has: a pattern or a fill was mistaken for "
            "walls."
        )
    surest = max((piece.confidence for piece in pieces), default=1.0)
    if surest < SURE:
        said.append(f"No piece of wall in {name} is sure, the surest is {surest:.2f}: look at the picture before you use them.")
    return said


def _about_sheet(drawing: Drawing, sheet: Sheet) -> list[str]:
    """How the sheet was laid for reading."""
    name = drawing.name
    said = []
    if sheet.inverted:
        said.append(f"{name} is drawn light on dark paper; the light lines were read as ink.")
    if sheet.turn is not None and sheet.turn.degrees:
        said.append(f"{name} lies askew by {-sheet.turn.degrees:.1f} degrees: it was turned straight to be read.")
    if sheet.scale > 1:
        said.append(f"{name} is small ({max(drawing.shape)} px): it was worked on at {sheet.scale} times its size.")
    return said


def _about_doors(drawing: Drawing, doors: DoorSearch, method: Method) -> list[str]:
    """Why there is no door, or why there may be more."""
    name, n_corners = drawing.name, len(doors.corners)
    said = []
    if doors.n_tried < n_corners:
        said.append(
            f"{name} shows too regular a pattern: doors were looked for among the {doors.n_tried} strongest of {n_corners} "
            "corners."
        )
    finest = min((door.width for door in doors.doors), default=0.0)
    if not doors.doors:
        left = {"corners": n_corners, **doors.funnel}
        stage = next((stage for stage in left if left[stage] == 0), "corners")
        tried = f"of {left['wedges']} candidates at {n_corners} corners"
        said.append(f"No door was found: {tried}, {WHAT_FAILED[stage]} ('{stage}').")
        if max(drawing.shape) < method.upscale_below:
            said.append(f"Doors of {name} may be too small to be told: scan it so that a door is 35 pixels wide or more.")
    elif finest * doors.sheet.scale < FINE_DOOR * method.min_side:
        said.append(
            f"A door of {name} is only {finest:.0f} pixels wide; others may have been too small to be told: scan it so that a "
            "door is 35 pixels wide or more."
        )
    return said
