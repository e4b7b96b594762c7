"""A building in one row: what to grow from which seed, in whose hand it is drawn, and what happens to the sheet afterwards."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from priorlab.buildings.degradations import Degradation
from priorlab.buildings.description import record_of
from priorlab.buildings.parts import (
    DimensionMark,
    DoorSymbol,
    FontName,
    StairsSymbol,
    SymbolFamily,
    WallStyle,
    WindowSymbol,
)
from priorlab.core.checks import check_positive

Clutter = Literal[
    "furniture",
    "dimensions",
    "axes",
    "block",
    "border",
    "cars",
    "cloud",
    "compass",
    "decking",
    "frame",
    "hedge",
    "legend",
    "levels",
    "north_arrow",
    "notes",
    "parking",
    "paving",
    "ruler",
    "scale_bar",
    "section",
    "stamps",
    "strip",
    "trees",
]


@dataclass(frozen=True)
class WallLook:
    """A style of wall in pixels of the drawing: thickness, weight of the outline, distance of the hatching; colours "#rrggbb"."""

    look: Literal["filled", "hollow", "hatched", "single"] = "filled"
    px: float = 8.0
    line: float = 1.6
    hatch_px: float = 7.0
    hatch_angle: float = 45.0
    ink: str = "#000000"
    fill: str | None = None

    def __post_init__(self) -> None:
        for name in ("px", "line", "hatch_px"):
            check_positive(name, getattr(self, name))

    def style(self, metres_per_pixel: float) -> WallStyle:
        """The style in metres."""
        return WallStyle(
            thickness=self.px * metres_per_pixel,
            look=self.look,
            ink=self.ink,
            fill=self.fill,
            line=self.px if self.look == "single" else self.line,
            hatch=self.hatch_px * metres_per_pixel,
            hatch_angle=self.hatch_angle,
        )


@dataclass(frozen=True)
class Recipe:
    """A building to grow and a drawing to make of it.

    Parameters
    ----------
    name, seed : the same seed grows the same building
    kind : "flat", "corridor" (an office floor), "wing" (two at a right angle), "diagonal" (a wing at an angle)
    style : what tables call its walls
    size : width and depth of the main house, metres
    rooms : how many, about
    long_side : of the sheet, pixels
    outer, inner : how the walls look
    doors : kinds that doors take by turns
    symbols, door_symbol, window, stairs, dimension, font : whose hand draws them
    line : weight of thin lines, pixels
    furniture_ink : colour of furniture
    words : language of names and notes
    clutter : what else stands in and round the building
    degradations : what happens to the sheet, in this order
    """

    name: str
    seed: int = 0
    kind: Literal["flat", "corridor", "wing", "diagonal"] = "flat"
    style: str = "filled"
    size: tuple[float, float] = (11.0, 9.0)
    rooms: int = 7
    long_side: int = 800
    outer: WallLook = WallLook(px=12)
    inner: WallLook = WallLook(px=6)
    doors: tuple[Literal["arc", "arc_panel", "double", "double_unequal", "leaf_90", "leaf_45", "folding"], ...] = ("arc",)
    symbols: SymbolFamily = "plain"
    door_symbol: DoorSymbol = "plain"
    window: WindowSymbol = "box"
    stairs: StairsSymbol = "plain"
    dimension: DimensionMark = "tick"
    font: FontName = "sans"
    line: float = 1.2
    furniture_ink: str = "#000000"
    words: Literal["en", "de", "fr"] = "en"
    clutter: tuple[Clutter, ...] = ("furniture",)
    degradations: tuple[Degradation, ...] = ()

    def __post_init__(self) -> None:
        for name in ("line", "long_side"):
            check_positive(name, getattr(self, name))
        if self.size[0] < 5 or self.size[1] < 5:
            raise ValueError(f"size must be at least 5 x 5 m, got {self.size[0]:g} x {self.size[1]:g}")
        if not 4 <= self.rooms <= 30:
            raise ValueError(f"rooms must lie between 4 and 30, got {self.rooms}")
        if not self.doors:
            raise ValueError(f"doors must name at least one kind, got none in {self.name!r}")


def read_recipes(path: str | Path) -> list[Recipe]:
    """The rows `[[drawing]]` of a TOML file.

    Raises
    ------
    ValueError
        One sentence with the file, the row, the rule and the value.
    """
    path = Path(path)
    rows = tomllib.loads(path.read_text(encoding="utf-8")).get("drawing", [])
    try:
        return [record_of(Recipe, row, f"drawing {number}") for number, row in enumerate(rows, start=1)]
    except ValueError as error:
        raise ValueError(f"{path.name}: {error}") from error
