"""Layout -> truth: exact walls, don't-care and doors of the building that the drawing shows (thesis 3.3.2, fig. 3.10)."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.buildings.layout import Layout, footprints
from priorlab.buildings.paper import Paper, coverage, fine_mask
from priorlab.buildings.parts import Furniture
from priorlab.buildings.render import draw_doors, draw_windows
from priorlab.buildings.symbols_openings import draw_window, folded
from priorlab.buildings.wall_masks import WallMasks
from priorlab.core.building import Truth
from priorlab.core.drawing import Door


def truth_of(layout: Layout, walls: WallMasks) -> Truth:
    """The truth of a drawing.

    A pixel is wall when at least half of it is ink of a wall or of a window. Don't-care: doors (symbol and opening), stairs,
    built-in furniture, the space between the lines of walls and windows, doorways that the plan walls up though the world has
    them, and a rim of one pixel round the walls, where the drawing is anti-aliased.
    """
    frame = layout.frame
    structure = coverage(walls.all_ink) >= 0.5
    panes = _window_ink(layout)
    windows = coverage(fine_mask(frame, [window.opening.outline for window in layout.windows])) >= 0.5
    is_wall = structure | (panes & windows)

    shown = [door.opening.outline for door in layout.doors if not door.part.plan_shows_wall]
    walled_up = [door.opening.outline for door in layout.doors if door.part.plan_shows_wall]
    fixed = [outline for piece in layout.furniture if _is_fixture(piece.part) for outline in footprints(piece)]
    fixed += [outline for flight in layout.stairs for outline in footprints(flight)]
    ignore = coverage(fine_mask(frame, shown)) > 0
    ignore |= _ink_of_doors(layout) | _grown(coverage(fine_mask(frame, fixed)) > 0)
    ignore |= coverage(walls.band) > 0
    ignore |= windows | _ink_of_sills(layout)
    ignore |= _grown(is_wall | windows)
    ignore &= ~is_wall
    ignore |= coverage(fine_mask(frame, walled_up)) > 0
    return Truth(is_wall, ignore, doors_of(layout), frame.metres_per_pixel, windows)


def doors_of(layout: Layout) -> tuple[Door, ...]:
    """The doors that the plan shows, one per leaf, as triangles hinge, strike, tip; x right, y DOWN, pixels.

    Sliding doors and bare openings have no leaf that swings, hence no triangle. The tip of a folding door is the top of its
    first fold.
    """
    doors = []
    for door in layout.doors:
        for leaf in () if door.part.plan_shows_wall else door.leaves:
            tip = folded(leaf)[1] if door.part.kind == "folding" else leaf.tip(door.part.drawn_open)
            hinge, strike, top = layout.frame.to_image([leaf.hinge, leaf.strike, tip]).tolist()
            doors.append(Door(tuple(hinge), tuple(strike), tuple(top), door.part.kind))
    return tuple(doors)


def _is_fixture(part: object) -> bool:
    """Is it built-in furniture that the plan shows?"""
    return isinstance(part, Furniture) and part.is_built_in and not part.only_in_world


def _window_ink(layout: Layout) -> NDArray[np.bool_]:
    """Pixels at least half covered by the lines of windows."""
    paper = Paper(layout.frame)
    for window in layout.windows:
        draw_window(paper, window, layout.description.sheet.line, symbol=layout.description.sheet.window_symbol)
    return paper.picture() < 128


def _ink_of_doors(layout: Layout) -> NDArray[np.bool_]:
    """Pixels that door symbols touch at all."""
    paper = Paper(layout.frame)
    draw_doors(paper, layout, "#000000")
    return paper.picture() < 255


def _ink_of_sills(layout: Layout) -> NDArray[np.bool_]:
    """Pixels that windows and their sills touch at all."""
    paper = Paper(layout.frame)
    draw_windows(paper, layout, "#000000")
    return paper.picture() < 255


def _grown(mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """A mask and the rim of one pixel round it."""
    return cv2.dilate(mask.view(np.uint8), np.ones((3, 3), np.uint8)).astype(bool)
