"""Description -> drawing: what the architect hands over."""

from __future__ import annotations

import cv2
import numpy as np

from priorlab.buildings.layout import Layout, Placed, chairs_of
from priorlab.buildings.paper import Paper, rgb
from priorlab.buildings.parts import Description, Furniture, Room, Sheet, Stairs
from priorlab.buildings.pen import Pen
from priorlab.buildings.symbol_families import FAMILIES
from priorlab.buildings.symbols_marks import draw_mark
from priorlab.buildings.symbols_openings import draw_door, draw_window, sills
from priorlab.buildings.symbols_sheet import (
    BLOCK_WIDTH,
    draw_dimension,
    draw_frame,
    draw_north_arrow,
    draw_scale_bar,
    draw_title,
    draw_title_block,
)
from priorlab.buildings.symbols_stairs import STAIRS
from priorlab.buildings.wall_masks import WallMasks, hatching
from priorlab.core.drawing import Drawing


def render(layout: Layout, walls: WallMasks, areas_m2: dict[str, float]) -> Drawing:
    """The drawing: lines of the site, furniture, stairs, walls, windows, doors, then all that is written."""
    description, sheet = layout.description, layout.description.sheet
    colourful = _is_colourful(description)
    paper = Paper(layout.frame, sheet.paper, colourful, sheet.font)
    for line in description.lines:
        (paper.dashes if line.dashed else paper.line)(np.array(line.path), line.weight, sheet.ink)
    for piece in layout.furniture:
        if isinstance(piece.part, Furniture) and not piece.part.only_in_world:
            draw_piece(paper, piece, sheet)
    for flight in layout.stairs:
        if isinstance(flight.part, Stairs):
            STAIRS[sheet.stairs_symbol](Pen(paper, flight, sheet.line, sheet.ink), flight.part.treads)
    draw_walls(paper, layout, walls)
    draw_windows(paper, layout, sheet.ink)
    draw_doors(paper, layout, sheet.ink)
    _draw_writing(paper, layout, areas_m2)
    picture = paper.picture()
    grey = np.asarray(cv2.cvtColor(picture, cv2.COLOR_RGB2GRAY), np.uint8) if colourful else picture
    return Drawing(grey, picture if colourful else None, description.metres_per_pixel, description.name)


def draw_piece(paper: Paper, piece: Placed, sheet: Sheet) -> None:
    """A piece of furniture in the sheet's hand, its chairs below it."""
    family = FAMILIES[sheet.symbols]
    for chair in chairs_of(piece):
        family["chair"](Pen(paper, chair, sheet.line, sheet.furniture_ink))
    assert isinstance(piece.part, Furniture)
    family[piece.part.kind](Pen(paper, piece, sheet.line, sheet.furniture_ink))


def draw_walls(paper: Paper, layout: Layout, walls: WallMasks) -> None:
    """Bands, hatching and ink of the walls."""
    sheet = layout.description.sheet
    for name, style in layout.description.styles.items():
        band = walls.bodies[name] & ~walls.ink[name]
        if band.any():
            paper.stain(band, style.fill or sheet.paper)
            if style.look == "hatched":
                paper.stain(hatching(band, style, sheet.line, layout.frame.metres_per_pixel), style.ink)
        paper.stain(walls.ink[name], style.ink)


def draw_windows(paper: Paper, layout: Layout, ink: str) -> None:
    """All windows, sills first."""
    sheet = layout.description.sheet
    for window in layout.windows:
        for sill in sills(window) if window.part.sill else ():
            paper.line(sill, sheet.line, ink)
        draw_window(paper, window, sheet.line, ink, sheet.window_symbol)


def draw_doors(paper: Paper, layout: Layout, ink: str) -> None:
    """All doors that the plan knows."""
    sheet = layout.description.sheet
    for door in layout.doors:
        if not door.part.plan_shows_wall:
            draw_door(paper, door, sheet.line, ink, sheet.door_symbol)


def _is_colourful(description: Description) -> bool:
    """Is any ink of the description not grey?"""
    sheet = description.sheet
    inks = [sheet.ink, sheet.furniture_ink, sheet.paper, *(style.ink for style in description.styles.values())]
    inks += [style.fill for style in description.styles.values() if style.fill]
    return any(len(set(rgb(ink))) > 1 for ink in inks)


def _draw_writing(paper: Paper, layout: Layout, areas_m2: dict[str, float]) -> None:
    """Labels, notes, dimension chains and what stands on the sheet."""
    description, sheet = layout.description, layout.description.sheet
    for room in description.rooms:
        _draw_label(paper, room, areas_m2[room.name], description)
    for note in description.notes:
        paper.text(note.text, note.at, note.size, note.turn, sheet.ink, note.align)
    for mark in description.marks:
        draw_mark(paper, mark, sheet)
    outline = np.concatenate([piece.outline for piece in layout.pieces])
    bounds = np.array([outline.min(axis=0), outline.max(axis=0)])
    for chain in description.dimensions:
        draw_dimension(paper, chain, bounds, sheet)
    low = np.array(layout.frame.origin_m)
    high = low + np.array(layout.frame.shape[::-1]) * description.metres_per_pixel
    inset = 0.5 if sheet.frame else 0.3
    draw_title(paper, sheet, low + (bounds[0, 0] - low[0] if not sheet.frame else inset, inset))
    right = np.array([bounds[1, 0] if not sheet.frame else high[0] - inset, low[1] + inset])
    if sheet.block:
        right = right - (BLOCK_WIDTH + 0.4, 0.0)
    if sheet.north_arrow:
        draw_north_arrow(paper, right + (-0.4, 0.4), sheet.line)
    if sheet.scale_bar:
        draw_scale_bar(paper, right - (1.5 if sheet.north_arrow else 0.4, 0.0), sheet.line)
    if sheet.block:
        draw_title_block(paper, sheet, np.array([high[0] - inset, low[1] + inset]))
    if sheet.frame:
        draw_frame(paper, low, high, sheet.line)


def _draw_label(paper: Paper, room: Room, area_m2: float, description: Description) -> None:
    """A room's name in capitals and its area below."""
    sheet = description.sheet
    lines = [(line, room.text) for line in room.name.upper().split("\n")]
    if room.show_area:
        lines.append((f"{area_m2:.1f} m²".replace(".", sheet.decimal), 0.78 * room.text))
    pitch = 1.75 * room.text
    angle = np.radians(room.turn)
    down = np.array([np.sin(angle), -np.cos(angle)])
    for number, (line, size) in enumerate(lines):
        paper.text(line, np.array(room.at) + (number - (len(lines) - 1) / 2) * pitch * down, size, room.turn, sheet.ink)
