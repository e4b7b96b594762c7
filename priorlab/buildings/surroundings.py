"""All clutter of a recipe, gathered round its building."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from priorlab.buildings import clutter_outdoors as outdoors
from priorlab.buildings import clutter_sheet as on_sheet
from priorlab.buildings.parts import Sheet
from priorlab.buildings.site import ROOM, Site, Surroundings


def surround(site: Site, sheet: Sheet) -> Surroundings:
    """All clutter of the recipe, in its order."""
    around = Surroundings(sheet=sheet)
    free = site.bounds[2] + 0.4  # where the next thing on the right may begin
    for kind in site.recipe.clutter:
        if kind in DRAWN:
            DRAWN[kind](site, around, free)
            free += ROOM[kind][2]
    return around


def _printed(**changes: bool) -> Callable[[Site, Surroundings, float], None]:
    """What the sheet itself prints."""

    def switch(site: Site, around: Surroundings, free: float) -> None:
        around.sheet = replace(around.sheet, **changes)  # type: ignore[arg-type]

    return switch


DRAWN: dict[str, Callable[[Site, Surroundings, float], None]] = {
    "axes": on_sheet.add_axes,
    "block": on_sheet.add_block,
    "border": on_sheet.add_border,
    "cars": outdoors.add_cars,
    "cloud": on_sheet.add_cloud,
    "compass": on_sheet.add_compass,
    "decking": outdoors.add_decking,
    "dimensions": on_sheet.add_dimensions,
    "frame": _printed(frame=True),
    "hedge": outdoors.add_hedge,
    "legend": on_sheet.add_legend,
    "levels": on_sheet.add_levels,
    "north_arrow": _printed(north_arrow=True),
    "notes": on_sheet.add_notes,
    "parking": outdoors.add_parking,
    "paving": outdoors.add_paving,
    "ruler": on_sheet.add_ruler,
    "scale_bar": _printed(scale_bar=True),
    "section": on_sheet.add_section,
    "stamps": on_sheet.add_stamps,
    "strip": on_sheet.add_strip,
    "trees": outdoors.add_trees,
}
"""Who draws what; "furniture" is in the rooms."""
