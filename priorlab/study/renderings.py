"""Renderings: plans as programs draw them from vectors, 512 x 512 pixels, walls solid, nothing round them, and their exact truth.

Sets of plans for learning come as such pictures. Their walls are black, dark or coloured in one or two thicknesses, their rooms
white or pastel, their openings white, tinted or filled with thin symbols.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.buildings.geometry import Points
from priorlab.buildings.layout import Layout, lay_out
from priorlab.buildings.paper import coverage, fine_mask, rgb
from priorlab.buildings.parts import Description, DoorPart, Note, Sheet
from priorlab.buildings.render import render
from priorlab.buildings.truth import doors_of
from priorlab.buildings.wall_masks import wall_masks
from priorlab.core.building import Truth
from priorlab.core.drawing import Drawing

SIDE = 512
"""Height and width of a rendering, pixels."""

RIM = (14, 48)
"""Least and most white round the building, pixels."""

THIN = (0.085, 0.12)
"""Thickness of walls of one thin pen, metres."""

LEAST, WINDOWED = 3.0, 5.0
"""No wall is drawn thinner, pixels; nor of one thin pen where the three lines of a window have to be seen in it."""

SWINGS = 1.3
"""Wider openings get no door that swings, metres."""

DARK = ("#000000", "#000000", "#1a1a1a", "#222222")
GREYS = ("#444444", "#5a5a5a", "#707070")
COLOURS = ("#1f3a68", "#6b2b1d", "#2f4a36", "#3d3350")


@dataclass(frozen=True)
class RenderingLook:
    """How a program draws its plans.

    Parameters
    ----------
    name : of the look
    walls : "thick" as the building has them, or "thin", all in one pen
    ink : "dark", "grey" or "colour" of the walls
    doors, windows : what stands in an opening, or nothing
    furniture, names : are they drawn?
    rooms : the darkest and the lightest value of a channel that fills rooms; None leaves them white
    tinted : openings are filled with a light tone
    crisp : no grey pixels at edges
    """

    name: str
    walls: Literal["thick", "thin"] = "thick"
    ink: Literal["dark", "grey", "colour"] = "dark"
    doors: Literal["none", "arc"] = "none"
    windows: Literal["none", "lines", "boxes"] = "none"
    furniture: bool = False
    names: bool = False
    rooms: tuple[int, int] | None = None
    tinted: bool = False
    crisp: bool = False


RENDERING_LOOKS = (
    RenderingLook("bare", crisp=True),
    RenderingLook("bare thin", walls="thin"),
    RenderingLook("arcs", doors="arc"),
    RenderingLook("arcs, windows, names", doors="arc", windows="lines", names=True),
    RenderingLook("thin, arcs, windows", walls="thin", doors="arc", windows="lines"),
    RenderingLook("grey, arcs, window boxes", ink="grey", doors="arc", windows="boxes"),
    RenderingLook("furnished", doors="arc", windows="lines", furniture=True, names=True),
    RenderingLook("coloured rooms", rooms=(170, 250)),
    RenderingLook("coloured rooms, tinted openings", rooms=(150, 250), windows="boxes", tinted=True, crisp=True),
    RenderingLook("coloured rooms, arcs, furnished", rooms=(190, 250), doors="arc", windows="lines", furniture=True),
    RenderingLook("coloured walls, arcs", ink="colour", doors="arc", windows="boxes"),
    RenderingLook("coloured walls and rooms", ink="colour", rooms=(195, 250), names=True, windows="lines"),
)
"""Looks of renderings, from bare to rich."""


def draw_rendering(description: Description, look: RenderingLook, rng: np.random.Generator) -> tuple[Drawing, Truth]:
    """A rendering of a building and its truth: walls alone, openings are empty, nothing is left out of the score.

    Parameters
    ----------
    description : the building; its scale, sheet and symbols give way to the look's
    look : how it is drawn
    rng : for its scale, thicknesses and colours
    """
    described = redrawn(description, look, rng)
    layout = lay_out(described)
    frame, ink = layout.frame, rgb(layout.description.styles[layout.pieces[0].style].ink)
    closed, body = (wall_masks(layout, gaps).body for gaps in ([], _openings(layout)))
    panes = coverage(fine_mask(frame, [window.opening.outline for window in layout.windows])) >= 0.5
    fills = _fills(coverage(closed) >= 0.5, look, rng)
    fills[(coverage(closed & ~body) >= 0.5) & (look.tinted | panes & (look.windows == "boxes"))] = rng.integers(170, 240, 3)
    symbols, wall, truth = _symbols(described, look), coverage(body), coverage(body) >= 0.5
    if look.crisp:
        symbols[wall > 0] = 255
        wall = truth.astype(np.float64)
    image = _painted(symbols, fills, wall, np.array(ink))
    grey = np.asarray(cv2.cvtColor(image, cv2.COLOR_RGB2GRAY), dtype=np.uint8)
    colour = image if np.ptp(image, axis=2).any() else None
    drawing = Drawing(grey, colour, frame.metres_per_pixel, f"{description.name}, {look.name}")
    return drawing, Truth(truth, np.zeros_like(truth), doors_of(layout), frame.metres_per_pixel, panes & ~truth)


def redrawn(description: Description, look: RenderingLook, rng: np.random.Generator) -> Description:
    """The building at the scale of a rendering, in a look's pens, without what stands on a sheet."""
    points = np.concatenate([np.array(wall.outline or wall.path) for wall in description.walls])
    size = np.ptp(points, axis=0)
    rim = int(rng.integers(*RIM))
    scale = float(size.max()) / (SIDE - 2 * rim)
    right, top = ((SIDE * scale - size) / 2).tolist()
    ink = str(rng.choice({"dark": DARK, "grey": GREYS, "colour": COLOURS}[look.ink]))
    thin, thicker = float(rng.uniform(*THIN)), float(rng.uniform(0.9, 1.2))
    least = WINDOWED if look.walls == "thin" and look.windows == "lines" else LEAST
    styles = {}
    for name, style in description.styles.items():
        thickness = max(thin if look.walls == "thin" else thicker * style.thickness, least * scale)
        styles[name] = replace(style, thickness=thickness, look="filled", ink=ink)
    line = float(rng.uniform(1.0, 1.4)) if look.walls == "thick" else 1.0
    pen, furniture_pen = str(rng.choice(("#000000", "#505050"))), str(rng.choice(("#404040", "#808080", "#a0a0a0")))
    margins = (right, top, right, top)
    return replace(
        description,
        metres_per_pixel=scale,
        styles=styles,
        doors=tuple(_as_drawn(door, look) for door in description.doors),
        furniture=description.furniture if look.furniture else (),
        stairs=description.stairs if look.furniture else (),
        rooms=(),
        notes=tuple(note for note in description.notes if look.names and _fits(note, description)),
        dimensions=(),
        lines=(),
        marks=(),
        sheet=Sheet(margins=margins, line=line, ink=pen, furniture_ink=furniture_pen, window_symbol="line"),
    )


def _as_drawn(door: DoorPart, look: RenderingLook) -> DoorPart:
    """A door with the symbol that a look gives it: swings only where a leaf fits."""
    swings = look.doors == "arc" and door.kind not in ("opening", "sliding") and door.width <= SWINGS
    return replace(door, kind=door.kind if swings else "opening", threshold=False, plan_shows_wall=False)


def _fits(note: Note, description: Description) -> bool:
    """Is the box round a word clear of walls? Programs leave out what does not fit."""
    half = np.array([0.4 * len(note.text) * note.size, 0.8 * note.size])
    low, high = np.array(note.at) - half, np.array(note.at) + half
    for wall in description.walls:
        points = np.array((*wall.outline, wall.outline[0]) if wall.outline else wall.path)
        for start, end in zip(points, points[1:], strict=False):
            along = start + np.linspace(0, 1, 50)[:, None] * (end - start)
            if ((along > low) & (along < high)).all(axis=1).any():
                return False
    return True


def _symbols(description: Description, look: RenderingLook) -> NDArray[np.uint8]:
    """(height, width, 3) the building drawn on white; windows without lines are openings."""
    if look.windows != "lines":
        bare = tuple(DoorPart(window.at, window.width, kind="opening") for window in description.windows)
        description = replace(description, windows=(), doors=(*description.doors, *bare))
    layout = lay_out(description)
    picture = render(layout, wall_masks(layout, _openings(layout)), {})
    return picture.colour if picture.colour is not None else np.asarray(cv2.cvtColor(picture.grey, cv2.COLOR_GRAY2RGB), np.uint8)


def _openings(layout: Layout) -> list[Points]:
    """Outlines of the gaps in the walls."""
    return [door.opening.outline for door in layout.doors] + [window.opening.outline for window in layout.windows]


def _fills(closed: NDArray[np.bool_], look: RenderingLook, rng: np.random.Generator) -> NDArray[np.uint8]:
    """(height, width, 3) tones of the rooms that walls with shut openings close; white elsewhere."""
    fills = np.full((*closed.shape, 3), 255, np.uint8)
    if look.rooms is not None:
        n_rooms, rooms = cv2.connectedComponents((~closed).astype(np.uint8), connectivity=4)
        tones = rng.integers(*look.rooms, (n_rooms, 3))
        tones[rooms[0, 0]] = 255
        fills[~closed] = tones[rooms[~closed]]
    return fills


def _painted(
    symbols: NDArray[np.uint8], fills: NDArray[np.uint8], wall: NDArray[np.float64], ink: NDArray[np.int64]
) -> NDArray[np.uint8]:
    """Symbols as ink over paint; at edges of walls, the walls' ink over the paint beside them."""
    cover = wall[..., None]
    beside = cv2.erode(fills, np.ones((3, 3), np.uint8))  # paint goes on below the edge of a wall
    at_edge = cover * ink + (1 - cover) * beside
    return np.rint(np.where(cover > 0, at_edge, symbols.astype(np.float64) * fills / 255)).astype(np.uint8)
