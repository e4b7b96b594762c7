"""On a sheet: measures, axes, sections, notes, marks, frames. `free` is where the next thing on the right may begin, metres."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from priorlab.buildings.lettering import text_width
from priorlab.buildings.parts import Dimension, Line, Mark, Note
from priorlab.buildings.room_words import WORDS
from priorlab.buildings.site import STAMP, Site, Surroundings


def add_dimensions(site: Site, around: Surroundings, free: float) -> None:
    """Two chains above and two on the left: rooms, and the whole."""
    width, depth = site.recipe.size
    for side, axis, whole in (("north", 0, width), ("west", 1, depth)):
        cuts = _cuts(site, axis)
        parts = tuple(sorted({0.0, whole, *cuts}))
        size = site.text
        around.dimensions.append(Dimension(side, parts, distance=0.6, size=size))  # type: ignore[arg-type]
        around.dimensions.append(Dimension(side, (0.0, whole), distance=1.25, size=size))  # type: ignore[arg-type]


def _cuts(site: Site, axis: int) -> list[float]:
    """Where inner walls of the main house meet its northern (axis 0) or western (axis 1) wall."""
    cells = [cell.box for cell in site.shell.cells if cell.block.turn == 0]
    edge = max(box[3] for box in cells) if axis == 0 else min(box[0] for box in cells)
    at_wall = [box for box in cells if abs((box[3] if axis == 0 else box[0]) - edge) < 0.01]
    starts = sorted(box[axis] for box in at_wall)[1:]
    ends = sorted(box[axis + 2] for box in at_wall)[:-1]
    return [round((start + end) / 2, 2) for start, end in zip(starts, ends, strict=True)]


def add_axes(site: Site, around: Surroundings, free: float) -> None:
    """Bubbles at the ends of stubs of axes, above and on the left."""
    width, depth = site.recipe.size
    beyond = 2.0 if "dimensions" in site.recipe.clutter else 0.75
    size = max(0.5, 2.6 * site.text)
    for number, x in enumerate([0.0, *_cuts(site, 0), width]):
        around.marks.append(Mark("bubble", (x, depth + beyond), size, "ABCDEFGHJK"[number % 10]))
        around.lines.append(Line(((x, depth + 0.2), (x, depth + beyond - size / 2)), dashed=True, weight=site.recipe.line))
    for number, y in enumerate([0.0, *_cuts(site, 1), depth], start=1):
        around.marks.append(Mark("bubble", (-beyond, y), size, str(number)))
        around.lines.append(Line(((-beyond + size / 2, y), (-0.2, y)), dashed=True, weight=site.recipe.line))


def add_section(site: Site, around: Surroundings, free: float) -> None:
    """A dash-dot line through the building, with arrows at its ends."""
    left, _, right, _ = site.bounds
    rooms = sorted((cell.box for cell in site.shell.cells if cell.block.turn == 0), key=lambda box: box[3])
    y = rooms[-1][3] - 0.35
    around.lines.append(Line(((left - 0.5, y), (right + 0.5, y)), dashed=True, weight=site.recipe.line))
    for x in (left - 0.6, right + 0.6):
        around.marks.append(Mark("section", (x, y), 0.6, "A"))


def add_block(site: Site, around: Surroundings, free: float) -> None:
    """A title block in the lower right corner, with the recipe's name."""
    title = site.recipe.name.replace("_", " ").upper()
    lines = (title, "Ground floor plan", "1 : 100   A2", "Drawn by: PL", "Sheet 2 of 9")
    around.sheet = replace(around.sheet, block=lines)


def add_notes(site: Site, around: Surroundings, free: float) -> None:
    """Lines of text below the building."""
    words = WORDS[site.recipe.words]
    size = site.text
    for number, text in enumerate([words["floor"], *words["notes"].split("|")][:4]):
        at = (site.bounds[0], site.bounds[1] - 0.5 - 1.9 * number * size)
        around.notes.append(Note(text, at, size, align="left"))


def add_legend(site: Site, around: Surroundings, free: float) -> None:
    """A table of signs on the right."""
    rows = WORDS[site.recipe.words]["legend"].split("|")
    left, top, pitch = free + 0.4, site.bounds[3] - 0.4, 2.2 * site.text
    wide = 3.4
    for number in range(len(rows) + 1):
        y = top - number * pitch
        around.lines.append(Line(((left, y), (left + wide, y)), weight=site.recipe.line))
    for x in (left, left + 0.9, left + wide):
        around.lines.append(Line(((x, top), (x, top - len(rows) * pitch)), weight=site.recipe.line))
    for number, text in enumerate(rows):
        around.notes.append(Note(text, (left + 1.0, top - (number + 0.5) * pitch), site.text, align="left"))


def add_levels(site: Site, around: Surroundings, free: float) -> None:
    """Heights: one in the hall, away from its label, one outdoors."""
    hall, label = site.shell.cells[0].box, site.rooms[0].at
    size = 4.2 * site.text
    at = max((hall[0] + 1.5, hall[2] - 1.5 - 0.8 * size), key=lambda x: abs(x + 0.4 * size - label[0]))
    if abs(at + 0.4 * size - label[0]) > 0.4 * size + 0.8:
        around.marks.append(Mark("level", (at, (hall[1] + hall[3]) / 2 - 0.2 * size), size, "±0.00"))
    around.marks.append(Mark("level", (site.bounds[0] + 0.2 * site.recipe.size[0], site.bounds[1] - 0.55), size, "-0.16"))


def add_cloud(site: Site, around: Surroundings, free: float) -> None:
    """Something was changed in the largest room."""
    cell = max((cell for cell in site.shell.cells if cell.block.turn == 0), key=lambda cell: cell.area)
    left, bottom, right, top = cell.box
    size = min(0.55 * (right - left), 0.9 * (top - bottom))
    around.marks.append(Mark("cloud", ((left + right) / 2, (bottom + top) / 2), size, "B"))


def add_ruler(site: Site, around: Surroundings, free: float) -> None:
    """Metres below the building."""
    around.marks.append(Mark("ruler", (site.bounds[0] + 0.2, site.bounds[1] - 1.1), 5.0))


def add_compass(site: Site, around: Surroundings, free: float) -> None:
    """On the right, below."""
    around.marks.append(Mark("compass", (free + 0.8, site.bounds[1] + 0.8), 1.3, turn=float(site.rng.uniform(-40, 40))))


def add_border(site: Site, around: Surroundings, free: float) -> None:
    """One heavy line round the sheet, letters at its fields."""
    left, bottom, right, top = site.page
    a, b, c, d = left + 0.5, bottom + 0.5, right - 0.5, top - 0.5
    around.lines.append(Line(((a, b), (c, b), (c, d), (a, d), (a, b)), weight=site.recipe.line))
    for n, x in enumerate(np.linspace(a, c, 7)[1:-1]):
        around.lines.append(Line(((float(x), d), (float(x), top)), weight=site.recipe.line))
        around.notes.append(Note("ABCDEF"[n], (float(x) - (c - a) / 12, d + 0.25), min(site.text, 0.25)))


def add_strip(site: Site, around: Surroundings, free: float) -> None:
    """A title strip at the right edge of the sheet."""
    _, bottom, right, top = site.page
    left, right, low, high = right - 3.2, right - 0.4, bottom + 0.4, top - 0.4
    weight, words = site.recipe.line, WORDS[site.recipe.words]
    around.lines.append(Line(((left, low), (right, low), (right, high), (left, high), (left, low)), weight=weight))
    for n, text in enumerate((*words["notes"].split("|"), site.recipe.name.replace("_", " "), words["floor"])):
        y = low + 0.9 * (n + 1)
        around.lines.append(Line(((left, y), (right, y)), weight=weight))
        size = min(1.2 * site.text, 2.5 / max(text_width(text, site.recipe.font), 1.0))
        around.notes.append(Note(text, ((left + right) / 2, y - 0.45), size))


def add_stamps(site: Site, around: Surroundings, free: float) -> None:
    """A number above the label of every room that is not turned."""
    for number, room in enumerate(site.rooms, start=1):
        if room.turn == 0:
            above = (1.6 if room.show_area else 0.7) * room.text + 0.45 * STAMP * site.text
            around.marks.append(Mark("stamp", (room.at[0], room.at[1] + above), 2.8 * site.text, f"{number:02d}"))
