"""The parts of a building as its description names them: metres, x right, y up, origin where the description likes it.

Every record says which of its values can be left out and what they are then. Compass words (north, south, east, west)
are directions on the sheet: north is up.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from priorlab.core.checks import check_positive

Point = tuple[float, float]
Compass = Literal["north", "south", "east", "west"]
DoorKind = Literal["arc", "arc_panel", "double", "leaf", "folding", "sliding", "opening"]
SymbolFamily = Literal["plain", "soft", "angular", "atelier"]
DoorSymbol = Literal["plain", "slab", "framed", "solid"]
WindowSymbol = Literal["box", "line", "offset", "double"]
StairsSymbol = Literal["plain", "cut", "winder", "dogleg"]
DimensionMark = Literal["tick", "dot", "arrow", "ring"]
FontName = Literal["sans", "mono", "oblique", "serif", "stix", "stroke"]
MarkKind = Literal["bubble", "cloud", "compass", "level", "ruler", "section", "stamp"]

FURNITURE_SIZES: dict[str, tuple[float, float]] = {
    "armchair": (0.85, 0.85),
    "basin": (0.6, 0.48),
    "bath": (1.7, 0.75),
    "bed": (1.6, 2.0),
    "box": (0.6, 0.6),
    "cabinet": (0.9, 0.45),
    "car": (1.8, 4.3),
    "chair": (0.45, 0.45),
    "counter": (2.4, 0.6),
    "cupboard": (1.8, 0.6),
    "desk": (1.6, 0.8),
    "fridge": (0.6, 0.6),
    "hob": (0.6, 0.6),
    "plant": (0.45, 0.45),
    "round_table": (1.1, 1.1),
    "shelf": (1.6, 0.35),
    "shower": (0.9, 0.9),
    "sink": (0.9, 0.6),
    "sofa": (2.0, 0.9),
    "table": (1.6, 0.9),
    "tree": (2.0, 2.0),
    "washer": (0.6, 0.6),
    "wc": (0.4, 0.65),
}
"""Kinds of furniture with their usual width along the back and depth, metres."""

BUILT_IN = frozenset({"basin", "bath", "counter", "fridge", "hob", "shower", "sink", "washer", "wc"})
"""Kinds that count as built in unless the description says otherwise."""


@dataclass(frozen=True)
class WallStyle:
    """How walls look and how thick they are.

    Parameters
    ----------
    thickness : metres
    look : "filled", "hollow" (two lines), "hatched" (two lines and hatching), or "single" (one line of `line` pixels)
    ink : colour "#rrggbb" of lines and filling
    fill : colour between the lines of a hollow or hatched wall, or None
    line : weight of the outline, pixels
    hatch, hatch_angle : distance between hatch lines, metres, and their direction, degrees
    """

    thickness: float = 0.12
    look: Literal["filled", "hollow", "hatched", "single"] = "filled"
    ink: str = "#000000"
    fill: str | None = None
    line: float = 1.6
    hatch: float = 0.12
    hatch_angle: float = 45.0

    def __post_init__(self) -> None:
        for name in ("thickness", "line", "hatch"):
            check_positive(name, getattr(self, name))


@dataclass(frozen=True)
class Wall:
    """A wall along a path (its centre line) or along a closed outline (its outer face, thickness inwards)."""

    style: str
    path: tuple[Point, ...] = ()
    outline: tuple[Point, ...] = ()


@dataclass(frozen=True)
class DoorPart:
    """A door in a wall.

    Parameters
    ----------
    at : middle of the opening, on a wall
    width : of the opening
    hinge : the end of the opening where the hinge sits (for double doors: the wider leaf)
    opens : the side to which the leaf swings
    kind : "arc" and "arc_panel" (quarter arc, leaf a line or a rectangle), "double", "leaf" (no arc), "folding", "sliding",
        "opening" (nothing but a gap)
    drawn_open : angle of the drawn leaf, degrees
    open : angle of the leaf in the world, degrees; 0 is shut
    share : of a double door's width that the leaf at the hinge takes
    threshold : draw the line of the wall's outer face through the opening
    plan_shows_wall : the plan shows a wall where the world has this doorway
    """

    at: Point
    width: float = 0.8
    hinge: Compass | None = None
    opens: Compass | None = None
    kind: DoorKind = "arc"
    drawn_open: float = 90.0
    open: float = 90.0
    share: float = 0.5
    threshold: bool = False
    plan_shows_wall: bool = False

    def __post_init__(self) -> None:
        check_positive("width", self.width)
        if self.kind != "opening" and (self.hinge is None or self.opens is None):
            raise ValueError(f"hinge and opens must be given for a door of kind {self.kind!r}, got {self.hinge} and {self.opens}")
        for name in ("drawn_open", "open"):
            if not 0 <= getattr(self, name) <= 180:
                raise ValueError(f"{name} must lie between 0 and 180 degrees, got {getattr(self, name):g}")
        if not 0.2 <= self.share <= 0.8:
            raise ValueError(f"share must lie between 0.2 and 0.8, got {self.share:g}")


@dataclass(frozen=True)
class WindowPart:
    """A window in a wall: its middle, its width, and how many casements it has; `sill` draws a ledge on both faces."""

    at: Point
    width: float = 1.2
    casements: int = 1
    sill: bool = False

    def __post_init__(self) -> None:
        check_positive("width", self.width)
        if self.casements < 1:
            raise ValueError(f"casements must be at least 1, got {self.casements}")


@dataclass(frozen=True)
class Stairs:
    """A straight flight: its middle, (width, run), number of treads and the direction that leads up."""

    at: Point
    size: tuple[float, float] = (1.0, 3.0)
    treads: int = 12
    up: Compass = "north"

    def __post_init__(self) -> None:
        if self.treads < 2:
            raise ValueError(f"treads must be at least 2, got {self.treads}")


@dataclass(frozen=True)
class Furniture:
    """A piece of furniture or a fixture.

    Parameters
    ----------
    kind : one of `FURNITURE_SIZES`
    at, against : its middle, or the middle of its back (for a piece that stands against a wall); one of the two
    back : the side to which its back turns
    size : (width along the back, depth); the kind's usual size when left out
    turn : further turn counter-clockwise, degrees
    chairs : round a table, or before a desk
    built_in : don't-care in the truth; baths, counters and the like are built in unless told otherwise
    only_in_world : the plan lacks it
    """

    kind: str
    at: Point | None = None
    against: Point | None = None
    back: Compass = "north"
    size: tuple[float, float] | None = None
    turn: float = 0.0
    chairs: int = 0
    built_in: bool | None = None
    only_in_world: bool = False

    def __post_init__(self) -> None:
        if self.kind not in FURNITURE_SIZES:
            from priorlab.core.shipped import nearest_name

            nearest_name("kind", self.kind, sorted(FURNITURE_SIZES))
        if (self.at is None) == (self.against is None):
            raise ValueError(f"exactly one of at and against must be given, got {self.at} and {self.against}")
        for side in self.size or ():
            check_positive("size", side)

    @property
    def is_built_in(self) -> bool:
        """Does it count as a part of the building?"""
        return self.kind in BUILT_IN if self.built_in is None else self.built_in


@dataclass(frozen=True)
class Room:
    """A room: its name and a point inside, where the label stands; the area is measured, not typed.

    `visit` are points that the tour drives to (found by itself when left out); `label` may break the name into lines.
    """

    name: str
    at: Point
    text: float = 0.28
    show_area: bool = True
    turn: float = 0.0
    visit: tuple[Point, ...] = ()


@dataclass(frozen=True)
class Note:
    """Free text on the sheet: its middle (or left end), height of a line in metres, turn counter-clockwise in degrees."""

    text: str
    at: Point
    size: float = 0.24
    turn: float = 0.0
    align: Literal["centre", "left"] = "centre"


@dataclass(frozen=True)
class Dimension:
    """A dimension chain: the points that it measures (x for north and south, y for east and west) and its distance outside.

    `level` puts the line inside the building instead: at this y (north, south) or x (east, west).
    """

    side: Compass
    points: tuple[float, ...]
    distance: float = 0.6
    size: float = 0.22
    level: float | None = None

    def __post_init__(self) -> None:
        if len(self.points) < 2 or list(self.points) != sorted(set(self.points)):
            raise ValueError(f"points must be at least two, rising, got {list(self.points)}")


@dataclass(frozen=True)
class Line:
    """A thin line on the sheet that is no wall: a terrace, a roof edge, a car park."""

    path: tuple[Point, ...]
    dashed: bool = False
    weight: float = 1.0


@dataclass(frozen=True)
class Mark:
    """A sign on the sheet that is no wall: an axis bubble, a section arrow, a height, a room stamp, a compass, a ruler, a cloud.

    `size` is its width in metres; what `text` means depends on the kind.
    """

    kind: MarkKind
    at: Point
    size: float = 0.6
    text: str = ""
    turn: float = 0.0

    def __post_init__(self) -> None:
        check_positive("size", self.size)


@dataclass(frozen=True)
class Sheet:
    """The paper round the building.

    Parameters
    ----------
    margins : left, bottom, right, top of the building's outline, metres
    title, subtitle : lower left corner; no title, no text
    north_arrow, scale_bar, frame : draw them?
    block : lines of the title block in the lower right corner
    decimal : "." or "," in areas and dimensions
    line : weight of thin lines (furniture, doors, dimensions), pixels
    ink, furniture_ink, paper : colours "#rrggbb" of lines and text, of furniture, of the paper
    symbols, door_symbol, window_symbol, stairs_symbol, dimension_mark : whose hand draws them (docs/drawing_suite.md)
    font : of everything that is written
    unit : of the measures in dimension chains
    """

    margins: tuple[float, float, float, float] = (1.0, 1.0, 1.0, 1.0)
    title: str = ""
    subtitle: str = ""
    north_arrow: bool = False
    scale_bar: bool = False
    frame: bool = False
    block: tuple[str, ...] = ()
    decimal: Literal[".", ","] = "."
    line: float = 1.2
    ink: str = "#000000"
    furniture_ink: str = "#000000"
    paper: str = "#ffffff"
    symbols: SymbolFamily = "plain"
    door_symbol: DoorSymbol = "plain"
    window_symbol: WindowSymbol = "box"
    stairs_symbol: StairsSymbol = "plain"
    dimension_mark: DimensionMark = "tick"
    font: FontName = "sans"
    unit: Literal["m", "cm", "mm"] = "m"


@dataclass(frozen=True)
class Description:
    """A whole building, as a teacher writes it in TOML (docs/adding_a_building.md)."""

    name: str
    metres_per_pixel: float
    walls: tuple[Wall, ...]
    styles: dict[str, WallStyle] = field(default_factory=lambda: {"outer": WallStyle(0.3), "inner": WallStyle(0.12)})
    doors: tuple[DoorPart, ...] = ()
    windows: tuple[WindowPart, ...] = ()
    stairs: tuple[Stairs, ...] = ()
    furniture: tuple[Furniture, ...] = ()
    rooms: tuple[Room, ...] = ()
    notes: tuple[Note, ...] = ()
    dimensions: tuple[Dimension, ...] = ()
    lines: tuple[Line, ...] = ()
    marks: tuple[Mark, ...] = ()
    sheet: Sheet = field(default_factory=Sheet)
    start: str | None = None

    def __post_init__(self) -> None:
        check_positive("metres_per_pixel", self.metres_per_pixel)
        if not self.walls:
            raise ValueError(f"walls must hold at least one wall, got none in {self.name!r}")
