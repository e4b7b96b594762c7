"""What stands round and over a grown building on its sheet: terraces, cars, trees, measures, axes, notes, frames."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from priorlab.buildings.cells import Box
from priorlab.buildings.lettering import text_width
from priorlab.buildings.parts import Dimension, Furniture, Line, Mark, Note, Room, Sheet
from priorlab.buildings.recipe import Recipe
from priorlab.buildings.room_words import WORDS
from priorlab.buildings.shell import Shell

STAMP = 1.9
"""Room that a stamp takes above a label, in heights of small letters."""

BASE = 0.7
"""Margin of a bare sheet, metres."""

ROOM: dict[str, Box] = {
    "axes": (0.9, 0.0, 0.0, 0.9),
    "block": (0.0, 2.6, 0.0, 0.0),
    "border": (0.7, 0.7, 0.7, 0.7),
    "cars": (0.0, 0.0, 6.0, 0.0),
    "cloud": (0.0, 0.0, 0.0, 0.0),
    "compass": (0.0, 0.0, 2.0, 0.0),
    "decking": (0.0, 2.7, 0.0, 0.0),
    "dimensions": (1.5, 0.0, 0.0, 1.5),
    "frame": (0.6, 0.6, 0.6, 0.6),
    "furniture": (0.0, 0.0, 0.0, 0.0),
    "hedge": (0.0, 0.0, 2.4, 0.0),
    "legend": (0.0, 0.0, 4.4, 0.0),
    "levels": (0.0, 0.0, 0.0, 0.0),
    "north_arrow": (0.0, 1.4, 0.0, 0.0),
    "notes": (0.0, 1.9, 0.0, 0.0),
    "parking": (0.0, 0.0, 6.0, 0.0),
    "paving": (0.0, 2.7, 0.0, 0.0),
    "ruler": (0.0, 1.2, 0.0, 0.0),
    "scale_bar": (0.0, 1.2, 0.0, 0.0),
    "section": (1.0, 0.0, 1.0, 0.0),
    "stamps": (0.0, 0.0, 0.0, 0.0),
    "strip": (0.0, 0.0, 3.4, 0.0),
    "trees": (0.0, 0.0, 2.4, 0.0),
}
"""What each kind of clutter needs beside the building: left, bottom, right, top, metres; they stand side by side on the right."""


@dataclass
class Surroundings:
    """Parts that are gathered round a building."""

    furniture: list[Furniture] = field(default_factory=list)
    lines: list[Line] = field(default_factory=list)
    marks: list[Mark] = field(default_factory=list)
    notes: list[Note] = field(default_factory=list)
    dimensions: list[Dimension] = field(default_factory=list)
    sheet: Sheet = field(default_factory=Sheet)


@dataclass(frozen=True)
class Site:
    """What the clutter is drawn round.

    Parameters
    ----------
    recipe, shell, rooms : what was grown
    bounds, page : of the building and of the whole sheet: left, bottom, right, top, metres
    text : height of small letters, metres
    rng : for what is left to chance
    """

    recipe: Recipe
    shell: Shell
    rooms: tuple[Room, ...]
    bounds: Box
    page: Box
    text: float
    rng: np.random.Generator


def margins_of(recipe: Recipe) -> Box:
    """Left, bottom, right, top: on the left and above things lie over one another, on the right and below side by side."""
    frames = sum(max(ROOM[kind]) for kind in recipe.clutter if kind in ("frame", "border"))
    plain = np.array([ROOM[kind] for kind in recipe.clutter if kind not in ("frame", "border")] or [(0.0, 0.0, 0.0, 0.0)])
    left, bottom, right, top = (plain[:, 0].sum(), plain[:, 1].max(), plain[:, 2].sum(), plain[:, 3].sum())
    return tuple(float(BASE + side + frames) for side in (left, bottom, right, top))  # type: ignore[return-value]


def surround(site: Site, sheet: Sheet) -> Surroundings:
    """All clutter of the recipe, in its order."""
    around = Surroundings(sheet=sheet)
    free = site.bounds[2] + 0.4  # where the next thing on the right may begin
    for kind in site.recipe.clutter:
        if kind in DRAWN:
            DRAWN[kind](site, around, free)
            free += ROOM[kind][2]
    return around


def _dimensions(site: Site, around: Surroundings, free: float) -> None:
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


def _axes(site: Site, around: Surroundings, free: float) -> None:
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


def _section(site: Site, around: Surroundings, free: float) -> None:
    """A dash-dot line through the building, with arrows at its ends."""
    left, _, right, _ = site.bounds
    rooms = sorted((cell.box for cell in site.shell.cells if cell.block.turn == 0), key=lambda box: box[3])
    y = rooms[-1][3] - 0.35
    around.lines.append(Line(((left - 0.5, y), (right + 0.5, y)), dashed=True, weight=site.recipe.line))
    for x in (left - 0.6, right + 0.6):
        around.marks.append(Mark("section", (x, y), 0.6, "A"))


def _terrace(site: Site, around: Surroundings, boards: bool) -> None:
    """A terrace before the southern wall: boards, or square slabs."""
    width = site.recipe.size[0]
    left, right, low, high = 0.15 * width, 0.15 * width + min(0.6 * width, 7.0), site.bounds[1] - 2.4, site.bounds[1]
    weight = site.recipe.line
    around.lines.append(Line(((left, high), (left, low), (right, low), (right, high)), weight=weight))
    step = 0.24 if boards else 0.6
    for y in np.arange(high - step, low + 0.1, -step):
        around.lines.append(Line(((left, float(y)), (right, float(y))), weight=weight))
    for x in np.arange(left + step, right - 0.1, step) if not boards else ():
        around.lines.append(Line(((float(x), low), (float(x), high)), weight=weight))


def _paving(site: Site, around: Surroundings, free: float) -> None:
    """Slabs."""
    _terrace(site, around, boards=False)


def _decking(site: Site, around: Surroundings, free: float) -> None:
    """Boards."""
    _terrace(site, around, boards=True)


def _cars(site: Site, around: Surroundings, free: float) -> None:
    """A few cars on the right, free on the forecourt."""
    _, low, _, high = site.bounds
    for y in np.arange(low + 1.3, high - 1.0, 3.1):
        turn = float(site.rng.uniform(-6, 6))
        around.furniture.append(Furniture("car", at=(free + 2.7, float(y)), back="west", turn=turn))


def _parking(site: Site, around: Surroundings, free: float) -> None:
    """Stalls on the right, most of them taken."""
    _, low, _, high = site.bounds
    levels = np.arange(low + 0.3, high, 2.6)
    for y in levels:
        around.lines.append(Line(((free + 0.4, float(y)), (free + 5.4, float(y))), weight=site.recipe.line))
    for y in levels[:-1]:
        if site.rng.random() < 0.7:
            around.furniture.append(Furniture("car", at=(free + 2.9, float(y) + 1.3), back="west"))


def _row_of_trees(site: Site, around: Surroundings, size: tuple[float, float], free: float) -> None:
    """Trees in a row on the right."""
    _, low, _, high = site.bounds
    y = low + size[0] / 2
    while y < high:
        across = float(site.rng.uniform(*size))
        around.furniture.append(Furniture("tree", at=(free + 1.1, y), size=(across, across)))
        y += across + 0.3


def _trees(site: Site, around: Surroundings, free: float) -> None:
    """A few large ones."""
    _row_of_trees(site, around, (1.6, 2.2), free)


def _hedge(site: Site, around: Surroundings, free: float) -> None:
    """Many smaller ones."""
    _row_of_trees(site, around, (1.1, 1.5), free)


def _notes(site: Site, around: Surroundings, free: float) -> None:
    """Lines of text below the building."""
    words = WORDS[site.recipe.words]
    size = site.text
    for number, text in enumerate([words["floor"], *words["notes"].split("|")][:4]):
        at = (site.bounds[0], site.bounds[1] - 0.5 - 1.9 * number * size)
        around.notes.append(Note(text, at, size, align="left"))


def _legend(site: Site, around: Surroundings, free: float) -> None:
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


def _levels(site: Site, around: Surroundings, free: float) -> None:
    """Heights: one in the hall, away from its label, one outdoors."""
    hall, label = site.shell.cells[0].box, site.rooms[0].at
    size = 4.2 * site.text
    at = max((hall[0] + 1.5, hall[2] - 1.5 - 0.8 * size), key=lambda x: abs(x + 0.4 * size - label[0]))
    if abs(at + 0.4 * size - label[0]) > 0.4 * size + 0.8:
        around.marks.append(Mark("level", (at, (hall[1] + hall[3]) / 2 - 0.2 * size), size, "±0.00"))
    around.marks.append(Mark("level", (site.bounds[0] + 0.2 * site.recipe.size[0], site.bounds[1] - 0.55), size, "-0.16"))


def _cloud(site: Site, around: Surroundings, free: float) -> None:
    """Something was changed in the largest room."""
    cell = max((cell for cell in site.shell.cells if cell.block.turn == 0), key=lambda cell: cell.area)
    left, bottom, right, top = cell.box
    size = min(0.55 * (right - left), 0.9 * (top - bottom))
    around.marks.append(Mark("cloud", ((left + right) / 2, (bottom + top) / 2), size, "B"))


def _ruler(site: Site, around: Surroundings, free: float) -> None:
    """Metres below the building."""
    around.marks.append(Mark("ruler", (site.bounds[0] + 0.2, site.bounds[1] - 1.1), 5.0))


def _compass(site: Site, around: Surroundings, free: float) -> None:
    """On the right, below."""
    around.marks.append(Mark("compass", (free + 0.8, site.bounds[1] + 0.8), 1.3, turn=float(site.rng.uniform(-40, 40))))


def _border(site: Site, around: Surroundings, free: float) -> None:
    """One heavy line round the sheet, letters at its fields."""
    left, bottom, right, top = site.page
    a, b, c, d = left + 0.5, bottom + 0.5, right - 0.5, top - 0.5
    around.lines.append(Line(((a, b), (c, b), (c, d), (a, d), (a, b)), weight=site.recipe.line))
    for n, x in enumerate(np.linspace(a, c, 7)[1:-1]):
        around.lines.append(Line(((float(x), d), (float(x), top)), weight=site.recipe.line))
        around.notes.append(Note("ABCDEF"[n], (float(x) - (c - a) / 12, d + 0.25), min(site.text, 0.25)))


def _strip(site: Site, around: Surroundings, free: float) -> None:
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


def _stamps(site: Site, around: Surroundings, free: float) -> None:
    """A number above the label of every room that is not turned."""
    for number, room in enumerate(site.rooms, start=1):
        if room.turn == 0:
            above = (1.6 if room.show_area else 0.7) * room.text + 0.45 * STAMP * site.text
            around.marks.append(Mark("stamp", (room.at[0], room.at[1] + above), 2.8 * site.text, f"{number:02d}"))


def _printed(**changes: bool | tuple[str, ...]) -> Callable[[Site, Surroundings, float], None]:
    """What the sheet itself prints."""

    def switch(site: Site, around: Surroundings, free: float) -> None:
        around.sheet = replace(around.sheet, **changes)  # type: ignore[arg-type]

    return switch


DRAWN: dict[str, Callable[[Site, Surroundings, float], None]] = {
    "axes": _axes,
    "block": _printed(block=("TOWN HALL", "Ground floor plan", "1 : 100   A2", "Drawn by: PL", "Sheet 2 of 9")),
    "border": _border,
    "cars": _cars,
    "cloud": _cloud,
    "compass": _compass,
    "decking": _decking,
    "dimensions": _dimensions,
    "frame": _printed(frame=True),
    "hedge": _hedge,
    "legend": _legend,
    "levels": _levels,
    "north_arrow": _printed(north_arrow=True),
    "notes": _notes,
    "parking": _parking,
    "paving": _paving,
    "ruler": _ruler,
    "scale_bar": _printed(scale_bar=True),
    "section": _section,
    "stamps": _stamps,
    "strip": _strip,
    "trees": _trees,
}
"""Who draws what; "furniture" is in the rooms."""
