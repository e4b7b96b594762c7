"""A recipe -> a whole building and its drawing: "a building per student", and the drawing suite."""

from __future__ import annotations

from collections import Counter

import numpy as np
from numpy.typing import NDArray

from priorlab.buildings.degradations import degrade
from priorlab.buildings.floor_plans import draw_plan
from priorlab.buildings.furnishing import Label, furnish
from priorlab.buildings.layout import lay_out
from priorlab.buildings.outline import outline_of
from priorlab.buildings.paper import coverage
from priorlab.buildings.parts import Description, Furniture, Room, Sheet, Stairs
from priorlab.buildings.recipe import Recipe
from priorlab.buildings.room_words import WORDS
from priorlab.buildings.shell import shell_of
from priorlab.buildings.site import STAMP, Site, margins_of
from priorlab.buildings.surroundings import surround
from priorlab.buildings.wall_masks import wall_masks
from priorlab.core.building import Truth
from priorlab.core.drawing import Drawing

LEGIBLE = 6.5
"""Least height of letters, pixels."""

CLEAR = 3.0
"""Least gap between loose furniture and walls, pixels."""


def grow_building(recipe: Recipe, passage: float = 0.0) -> Description:
    """The building of a recipe: rooms, doors, windows, furniture, and the sheet it is drawn on.

    Parameters
    ----------
    passage : floor kept clear beyond the swing of every door, metres; a robot that drives through needs some

    >>> len(grow_building(Recipe("one", seed=1, rooms=5)).rooms)
    5
    """
    rng_shell, rng_rooms, rng_site = np.random.default_rng(recipe.seed).spawn(3)
    outline = outline_of(recipe, rng_shell)
    bounds, margins = outline.bounds, margins_of(recipe)
    page = (bounds[0] - margins[0], bounds[1] - margins[1], bounds[2] + margins[2], bounds[3] + margins[3])
    metres_per_pixel = max(page[2] - page[0], page[3] - page[1]) / recipe.long_side
    styles = {"outer": recipe.outer.style(metres_per_pixel), "inner": recipe.inner.style(metres_per_pixel)}
    shell = shell_of(recipe, outline, styles["outer"].thickness, styles["inner"].thickness, rng_shell)
    text = max(0.2, LEGIBLE * metres_per_pixel)
    names = _names([cell.use for cell in shell.cells], WORDS[recipe.words])
    furniture: list[Furniture] = []
    stairs: list[Stairs] = []
    rooms: list[Room] = []
    gap = max(0.05, CLEAR * metres_per_pixel) if "furniture" in recipe.clutter else None
    above = STAMP * text if "stamps" in recipe.clutter else 0.0
    for cell, name in zip(shell.cells, names, strict=True):
        label = Label(name, 1.1 * text, recipe.font, above)
        pieces, flights, room = furnish(cell, list(shell.doors), label, gap, rng_rooms, passage)
        furniture += pieces
        stairs += flights
        rooms.append(room)
    sheet = Sheet(
        margins=margins,
        line=recipe.line,
        furniture_ink=recipe.furniture_ink,
        symbols=recipe.symbols,
        door_symbol=recipe.door_symbol,
        window_symbol=recipe.window,
        stairs_symbol=recipe.stairs,
        dimension_mark=recipe.dimension,
        font=recipe.font,
        decimal="." if recipe.words == "en" else ",",
        unit="m" if recipe.words == "en" else "cm",
    )
    around = surround(Site(recipe, shell, tuple(rooms), bounds, page, text, rng_site), sheet)
    return Description(
        name=recipe.name,
        metres_per_pixel=metres_per_pixel,
        walls=shell.walls,
        styles=styles,
        doors=shell.doors,
        windows=shell.windows,
        stairs=tuple(stairs),
        furniture=(*around.furniture, *furniture),
        rooms=tuple(rooms),
        notes=tuple(around.notes),
        dimensions=tuple(around.dimensions),
        lines=tuple(around.lines),
        marks=tuple(around.marks),
        sheet=around.sheet,
        start=rooms[0].name,
    )


def draw_recipe(recipe: Recipe) -> tuple[Drawing, Truth]:
    """The drawing of a recipe as it arrives, and its exact truth; the same every time."""
    drawing, truth = draw_plan(grow_building(recipe))
    return degrade(drawing, truth, recipe.degradations, np.random.default_rng([recipe.seed, 1]))


def wall_area(recipe: Recipe) -> NDArray[np.bool_]:
    """(height, width) True on the bodies of the walls, between the lines of hollow ones too; skewed as the drawing is."""
    layout = lay_out(grow_building(recipe))
    gaps = [door.opening.outline for door in layout.doors] + [window.opening.outline for window in layout.windows]
    body = coverage(wall_masks(layout, gaps).body) >= 0.5
    nothing = np.zeros_like(body)
    white = Drawing(np.full(body.shape, 255, np.uint8))
    skews = [degradation for degradation in recipe.degradations if degradation.kind == "skew"]
    return degrade(white, Truth(body, nothing), skews, np.random.default_rng(0))[1].walls


def _names(uses: list[str], words: dict[str, str]) -> list[str]:
    """A name for every room; where there are several of a kind they are numbered."""
    total, so_far, names = Counter(uses), Counter[str](), []
    for use in uses:
        so_far[use] += 1
        names.append(words[use] if total[use] == 1 else f"{words[use]} {so_far[use]}")
    return names
