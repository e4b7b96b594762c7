"""Many more drawings to tune on: buildings from other seeds, in the hands of the tuned half, looser in every measure.

The tuned half of the suite holds 14 drawings; thresholds fit so few too well. These are drawn at random over the same styles,
with other thicknesses, weights and sizes of letters, and with furniture that no family of symbols has (`stray_ink`). Even
numbers are for work, odd ones are held back. Symbols, fonts and clutter of the scored half occur in none.

rows = [score_case(development_case(number), ROBUST) for number in development_numbers("work")]
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Literal

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.buildings.degradations import Degradation, degrade
from priorlab.buildings.floor_plans import draw_plan
from priorlab.buildings.grow import grow_building, wall_area
from priorlab.buildings.parts import Description
from priorlab.buildings.recipe import Recipe, WallLook
from priorlab.core.building import Truth
from priorlab.core.drawing import Drawing
from priorlab.study.drawing_suite import SuiteCase
from priorlab.study.stray_ink import with_stray_ink

Image = NDArray[np.uint8]

STYLES = (
    "filled",
    "hollow",
    "hatched",
    "filled",
    "grey",
    "outline",
    "hollow",
    "hatched",
    "coloured",
    "filled",
    "mixed",
    "single",
)
"""Styles by turns: those that drawings come in most, most often."""

SIZES: dict[str, tuple[int, int]] = {
    "filled": (300, 1500),
    "grey": (420, 1000),
    "coloured": (500, 1200),
    "single": (520, 1100),
    "hollow": (720, 1300),
    "outline": (720, 1300),
    "hatched": (860, 1500),
    "mixed": (640, 1300),
}
"""Shortest and longest long side of each style, pixels."""

CLUTTER = ("dimensions", "section", "notes", "cars", "trees", "paving", "legend", "block", "frame", "scale_bar", "north_arrow")
"""What may stand round the building."""

COLOURS = ("#1c3f94", "#7a1f1f", "#1f6b3a", "#8a4b12", "#54307a")
"""Inks of coloured walls."""


def development_numbers(half: Literal["work", "held_back", "both"] = "work", count: int = 20) -> list[int]:
    """Numbers of drawings: even ones for work, odd ones held back.

    >>> development_numbers("work", 3), development_numbers("held_back", 3)
    ([0, 2, 4], [1, 3, 5])
    """
    first, step = {"work": (0, 2), "held_back": (1, 2), "both": (0, 1)}[half]
    return list(range(first, first + step * count, step))


def development_recipe(number: int) -> Recipe:
    """What drawing `number` is; its style comes by turns (every style in either half), all else by chance."""
    rng = np.random.default_rng([2028, number])
    style = STYLES[number // 2 % len(STYLES)]
    kind = rng.choice(["flat", "flat", "corridor", "wing", "diagonal"], p=[0.35, 0.2, 0.3, 0.1, 0.05])
    low, high = SIZES[style]
    long_side = round(float(np.exp(rng.uniform(np.log(low), np.log(high)))))
    metres = min(max(long_side / rng.uniform(48, 80), 6.5), 22.0)
    size = (round(float(metres), 1), round(float(metres * rng.uniform(0.62, 0.85)), 1))
    clutter = [str(kind) for kind in rng.permutation(CLUTTER)[: rng.integers(0, 4)]] if long_side > 450 else []
    per_metre = long_side / (metres + 3.0)
    outer, inner = _looks(style, rng, max(rng.uniform(0.2, 0.42) * per_metre, 4), max(rng.uniform(0.09, 0.2) * per_metre, 2.5))
    line = outer.line if style == "outline" else float(rng.choice([1.0, 1.0, 1.2, 1.5, 1.8, 2.2]))
    return Recipe(
        name=f"dev_{number}_{style}",
        seed=9000 + number,
        kind=kind,
        style=style,
        size=(max(size[0], 5.5), max(size[1], 5.2)),
        rooms=int(np.clip(rng.normal(size[0] * size[1] / 14, 1.5), 4, 16)),
        long_side=long_side,
        outer=outer,
        inner=inner,
        doors=tuple(rng.choice(["arc", "arc", "arc_panel", "double", "double_unequal", "leaf_90", "leaf_45", "folding"], 3)),
        symbols=rng.choice(["plain", "soft"]),
        door_symbol=rng.choice(["plain", "slab"]),
        window=rng.choice(["box", "line"]),
        stairs=rng.choice(["plain", "cut"]),
        dimension=rng.choice(["tick", "dot"]),
        font=rng.choice(["sans", "mono", "oblique"]),
        line=min(line, 0.4 * inner.px) if style != "outline" else line,
        furniture_ink=str(rng.choice(["#000000", "#000000", "#404040", "#808080", "#7a7a5a"])),
        clutter=("furniture", *clutter),  # type: ignore[arg-type]
        degradations=_degradations(rng),
    )


def development_case(number: int) -> SuiteCase:
    """Drawing `number`, drawn: letters larger or smaller, stray ink among the furniture, then what happens to the sheet."""
    recipe = development_recipe(number)
    drawing, truth = draw_plan(described(recipe))
    drawing = with_stray_ink(drawing, truth, recipe.line, np.random.default_rng([recipe.seed, 3]))
    drawing, truth = degrade(drawing, truth, recipe.degradations, np.random.default_rng([recipe.seed, 1]))
    return SuiteCase(recipe.name, recipe.style, recipe, drawing, truth, wall_area(recipe))


def described(recipe: Recipe) -> Description:
    """The building of a development recipe, with letters smaller or larger."""
    grown = grow_building(recipe)
    larger = float(np.random.default_rng([recipe.seed, 2]).uniform(0.85, 1.3))
    rooms = tuple(replace(room, text=room.text * larger) for room in grown.rooms)
    return replace(grown, rooms=rooms, notes=tuple(replace(note, size=note.size * larger) for note in grown.notes))


def false_ink(case: SuiteCase, mask: NDArray[np.bool_]) -> dict[str, int]:
    """Pixels wrongly taken for wall, by what stands nearest to them: what to mend first.

    Kinds are "edge" (within three pixels of a true wall), "door", "window", "furniture", "stairs", "letters", "sheet"
    (dimensions, notes, title block, section marks) and "stray" (the rest: stray ink, stains, nothing at all).
    """
    wrong = mask & ~case.truth.walls & ~case.truth.ignore
    kinds = kinds_of_ink(case)
    names = list(kinds)
    apart = np.stack([cv2.distanceTransform((~kinds[name]).astype(np.uint8), cv2.DIST_L2, 5)[wrong] for name in names])
    near_wall = cv2.dilate(case.truth.walls.astype(np.uint8), np.ones((7, 7), np.uint8)).astype(bool)[wrong]
    nearest = np.where(apart.min(axis=0) <= 8, apart.argmin(axis=0), len(names))
    found = {name: int(np.count_nonzero((nearest == k) & ~near_wall)) for k, name in enumerate([*names, "stray"])}
    return {"edge": int(near_wall.sum()), **found}


def kinds_of_ink(case: SuiteCase) -> dict[str, NDArray[np.bool_]]:
    """The ink of each kind of part: what is missing on a drawing without it."""
    full = described(case.recipe)
    plain = draw_plan(full)[0]
    skews = [degradation for degradation in case.recipe.degradations if degradation.kind == "skew"]

    def missing(**changes: Any) -> NDArray[np.bool_]:
        other = draw_plan(replace(full, **changes))[0]
        return turned((other.grey.astype(int) - plain.grey) > 40)

    def turned(ink: NDArray[np.bool_]) -> NDArray[np.bool_]:
        white = Drawing(np.full(ink.shape, 255, np.uint8))
        return degrade(white, Truth(ink, np.zeros_like(ink)), skews, np.random.default_rng(0))[1].walls

    doors = np.zeros(case.drawing.shape, np.uint8)
    for door in case.truth.doors:
        cv2.fillPoly(doors, [np.rint(door.points).astype(np.int32)], 1)
    windows = np.zeros_like(doors) if case.truth.windows is None else case.truth.windows
    nothing: tuple[()] = ()
    return {
        "door": doors.astype(bool),
        "window": windows.astype(bool),
        "furniture": missing(furniture=nothing),
        "stairs": missing(stairs=nothing),
        "letters": missing(rooms=tuple(replace(room, text=1e-6, show_area=False) for room in full.rooms)),
        "sheet": missing(notes=nothing, dimensions=nothing, lines=nothing, marks=nothing),
    }


def _looks(style: str, rng: np.random.Generator, outer_px: float, inner_px: float) -> tuple[WallLook, WallLook]:
    """Outer and inner walls of a style."""
    weight = float(rng.choice([1.2, 1.5, 1.75, 2.0, 2.5, 3.0]))
    if style in ("filled", "grey", "coloured"):
        tone = f"#{rng.integers(0x48, 0xA8):02x}" * 1
        ink = {"grey": tone + tone[1:] * 2, "coloured": str(rng.choice(COLOURS))}.get(style, "#000000")
        return WallLook(px=outer_px, ink=ink), WallLook(px=inner_px, ink=ink)
    if style == "single":
        thick = float(np.clip(outer_px / 4, 2.5, 5))
        return WallLook("single", px=thick), WallLook("single", px=max(thick * 0.75, 2))
    outer_px, inner_px = max(outer_px, 5 * weight), max(inner_px, 2 * weight + 3)
    if style in ("hollow", "outline"):
        fill = str(rng.choice(["#cccccc", "#e0e0e0"])) if style == "hollow" and rng.random() < 0.25 else None
        return WallLook("hollow", px=outer_px, line=weight, fill=fill), WallLook("hollow", px=inner_px, line=weight, fill=fill)
    pitch, angle = float(rng.uniform(5, 9)), float(rng.choice([45, 45, -45, 60]))
    hatched = WallLook("hatched", px=max(outer_px, 12), line=weight, hatch_px=pitch, hatch_angle=angle)
    if style == "mixed":
        return hatched, WallLook(px=max(inner_px, 4))
    return hatched, WallLook("hatched", px=max(inner_px, 9), line=weight, hatch_px=pitch, hatch_angle=angle)


def _degradations(rng: np.random.Generator) -> tuple[Degradation, ...]:
    """None, or one to three of them, mild to rough."""
    amounts = {"skew": (0.6, 3.0), "blur": (0.4, 0.9), "shading": (0.1, 0.3), "noise": (3, 10), "jpeg": (60, 90)}
    chosen = [kind for kind in amounts if rng.random() < 0.22]
    signs = {"skew": float(rng.choice([-1, 1]))}
    return tuple(Degradation(kind, signs.get(kind, 1) * float(rng.uniform(*amounts[kind]))) for kind in chosen)  # type: ignore[arg-type]
