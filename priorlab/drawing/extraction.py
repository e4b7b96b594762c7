"""Algorithm 3.2 as one call: a drawing goes in, its walls come out, with everything that was seen on the way."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from priorlab.core.drawing import Door, Drawing, Walls
from priorlab.drawing.candidates import DoorSearch
from priorlab.drawing.corners import corners_of
from priorlab.drawing.doors import search_doors
from priorlab.drawing.left_out import LEAST_KEPT, share_kept
from priorlab.drawing.method import ROBUST, Method
from priorlab.drawing.photograph import is_photograph
from priorlab.drawing.pieces import WallPiece
from priorlab.drawing.preprocessing import LEAST_CONTRAST, prepare
from priorlab.drawing.sheet import Sheet
from priorlab.drawing.walls import WallSearch, as_walls, search_walls
from priorlab.drawing.weight import Hypothesis


@dataclass(frozen=True, eq=False)
class Extraction:
    """The walls of a drawing and how they were found; all in pixels of the drawing, x right, y down.

    Parameters
    ----------
    drawing : what came in
    method : how it was read
    walls : the result
    door_search : corners, connected pairs, candidates and the test that each one failed
    wall_search : outer walls, the walls after each sweep, the hypotheses and which was taken
    lost_at : the stage that lost the walls ("ink", "corners", a test's name, "walls"), or None when there are walls
    notes : sentences for the reader
    """

    drawing: Drawing
    method: Method
    walls: Walls
    door_search: DoorSearch
    wall_search: WallSearch
    lost_at: str | None
    notes: tuple[str, ...]

    @property
    def corners(self) -> NDArray[np.float64]:
        """(N, 2) Harris corners."""
        return self.door_search.corners

    @property
    def doors(self) -> tuple[Door, ...]:
        """The doors."""
        return self.door_search.doors

    @property
    def outer(self) -> NDArray[np.bool_]:
        """(height, width) ink of the outer walls, eq. 3.12."""
        return self.wall_search.outer

    @property
    def sweeps(self) -> tuple[NDArray[np.bool_], ...]:
        """(height, width) walls after the jambs' runs and after each sweep, eq. 3.16-3.19."""
        return self.wall_search.sweeps

    @property
    def hypotheses(self) -> tuple[Hypothesis, ...]:
        """What doors, line weights and hues each take for walls."""
        return self.wall_search.hypotheses

    @property
    def pieces(self) -> tuple[WallPiece, ...]:
        """The straight stretches of the walls, each with its confidence."""
        return self.wall_search.pieces

    @property
    def confidence(self) -> NDArray[np.float64]:
        """(height, width) confidence of the piece that each wall pixel belongs to, 0 to 1; 0 where there is no wall."""
        picture = np.zeros(self.walls.shape)
        for piece in self.pieces:
            x, y, width, height = piece.box
            part = picture[y : y + height, x : x + width]
            part[piece.mask] = np.maximum(part[piece.mask], piece.confidence)
        return picture

    @property
    def funnel(self) -> Mapping[str, int]:
        """How many are left: corners, wedges of connected sides, then after each test, in order."""
        return {"corners": len(self.corners), **self.door_search.funnel}

    @property
    def door_width(self) -> float | None:
        """Median open side of the doors, pixels; None without doors."""
        return float(np.median([door.width for door in self.doors])) if self.doors else None

    def __repr__(self) -> str:
        share = 100 * self.walls.mask.mean()
        found = f"{len(self.corners)} corners, {len(self.doors)} doors, {share:.1f} % wall"
        return f"Extraction({self.drawing.name}, {self.method.name}: {found})"


def extract_walls(drawing: Drawing, method: Method = ROBUST, progress: Callable[[str, float], None] | None = None) -> Extraction:
    """Find corners, doors and walls (algorithm 3.2).

    Parameters
    ----------
    drawing : any drawing; one in which nothing is found gives a result that says so
    method : `ROBUST`, or `THESIS`
    progress : called with the name of each step and the share done before it

    Returns
    -------
    the walls, and everything that was seen

    >>> blank = Drawing(np.full((40, 60), 255, dtype=np.uint8), name="blank")
    >>> found = extract_walls(blank)
    >>> found.lost_at, found.notes[0]
    ('ink', 'blank shows no ink: it has one colour all over.')
    """
    say = progress or (lambda step, done: None)
    say("ink", 0.0)
    sheet = prepare(drawing, method)
    unfit = why_unfit(drawing)
    if unfit:
        sheet = without_ink(sheet)
    say("corners", 0.05)
    corners = corners_of(sheet, method.n_corners, method)
    say("doors", 0.1)
    door_search = search_doors(sheet, sheet.points_to_input(corners), method)
    say("walls", 0.6)
    wall_search = search_walls(sheet, door_search.doors, corners, method)
    say("done", 1.0)
    walls = as_walls(drawing, wall_search.walls, wall_search.windows)
    lost_at = None if walls.mask.any() else _lost_at(sheet, door_search, method)
    return Extraction(
        drawing=drawing,
        method=method,
        walls=walls,
        door_search=door_search,
        wall_search=wall_search,
        lost_at=lost_at,
        notes=(unfit,) if unfit else _notes(drawing, sheet, door_search, wall_search, lost_at, method),
    )


def why_unfit(drawing: Drawing) -> str:
    """The sentence that says why an image is no drawing to be read; empty for one that may be.

    >>> why_unfit(Drawing(np.arange(20, dtype=np.uint8).reshape(4, 5), name="stamp"))
    'stamp is 5 x 4 pixels: too small to show a wall and a door.'
    """
    height, width = drawing.shape
    grey = drawing.grey
    if np.ptp(grey) < LEAST_CONTRAST and (drawing.colour is None or np.ptp(drawing.colour, axis=(0, 1)).max() < LEAST_CONTRAST):
        return f"{drawing.name} shows no ink: it has one colour all over."
    if min(height, width) < SMALLEST_SIDE:
        return f"{drawing.name} is {width} x {height} pixels: too small to show a wall and a door."
    if is_photograph(grey):
        return (
            f"{drawing.name} looks like a photograph: its tones change from place to place, and no ink stands out from a paper. "
            "Scan the drawing, or photograph it flat and evenly lit."
        )
    return ""


def without_ink(sheet: Sheet) -> Sheet:
    """A sheet of which nothing is taken for ink."""
    nothing = np.zeros_like(sheet.lines)
    return replace(sheet, darkness=np.zeros_like(sheet.darkness), lines=nothing, walls=nothing)


SMALLEST_SIDE = 24
"""An image with a shorter side shows no building, pixels."""


def _lost_at(sheet: Sheet, search: DoorSearch, method: Method) -> str:
    """The stage after which nothing was left."""
    if not sheet.lines.any():
        return "ink"
    if not len(search.corners):
        return "corners"
    if search.doors or method.sources == "both":
        return "walls"
    left = search.funnel
    return next((name for name in left if left[name] == 0), "walls")


def _notes(
    drawing: Drawing, sheet: Sheet, doors: DoorSearch, walls: WallSearch, lost_at: str | None, method: Method
) -> tuple[str, ...]:
    """What a reader should know about this result, a sentence each."""
    name = drawing.name
    notes = []
    if lost_at == "ink":
        return (f"{name} shows no ink: nothing stands out from its paper.",)
    if sheet.inverted:
        notes.append(f"{name} is drawn light on dark paper; the light lines were read as ink.")
    if sheet.turn is not None and sheet.turn.degrees:
        notes.append(f"{name} lies askew by {-sheet.turn.degrees:.1f} degrees: it was turned straight to be read.")
    if sheet.scale > 1:
        notes.append(f"{name} is small ({max(drawing.shape)} px): it was worked on at {sheet.scale} times its size.")
    if not doors.doors:
        left = doors.funnel
        last = next((test for test in left if left[test] == 0), "corners")
        notes.append(f"No door was found: of {len(doors.corners)} corners and {left['wedges']} candidates none passed '{last}'.")
        if max(drawing.shape) < method.upscale_below:
            notes.append(f"Doors of {name} may be too small to be told: scan it so that a door is 35 pixels wide or more.")
    if lost_at is not None:
        seeds = "no door to grow walls from" if method.sources == "doors" else "no piece of ink looks like a wall"
        notes.append(f"No wall was found, lost at '{lost_at}': {seeds}.")
    elif walls.chosen != "doors":
        notes.append(f"Walls were chosen by line weight: {walls.chosen}.")
        kept = share_kept(walls.walls, sheet.to_input(sheet.walls))
        if kept < LEAST_KEPT:
            notes.append(
                f"Only {100 * kept:.0f} % of all that is as heavy as these walls was taken for wall: look what is missing."
            )
    return tuple(notes)
