"""The drawing suite of chapter 3: 28 drawings of grown buildings, half of them to tune on, half of them only to score.

rows = score_suite("tuned", ROBUST, progress=print)
print(summary(rows))
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from priorlab.buildings.grow import draw_recipe, wall_area
from priorlab.buildings.recipe import Recipe, read_recipes
from priorlab.core.building import Truth
from priorlab.core.drawing import Door, Drawing, Walls
from priorlab.core.score import Score, score_mask
from priorlab.core.shipped import data_folder, nearest_name
from priorlab.drawing.baselines import BASELINES
from priorlab.drawing.extraction import Extraction, extract_walls
from priorlab.drawing.method import ROBUST, THESIS, Method

Half = Literal["tuned", "scored"]

BAR = (0.98, 0.61, 0.0012)
"""The thesis's table 3.1: precision and recall at least, false positive rate at most."""

NEAR = 0.3
"""A jamb is found when it lies within this share of the door's width."""

Found = Extraction | Walls | NDArray[np.bool_]
"""What a method may give: an extraction with its doors, walls, or a mask."""

METHODS: Mapping[str, Callable[[Drawing], Found]] = {
    "THESIS": partial(extract_walls, method=THESIS),
    "ROBUST": partial(extract_walls, method=ROBUST),
    **BASELINES,
}
"""Both presets and the simple filters; these take everything darker than half-way between paper and black for ink."""


@dataclass(frozen=True, eq=False)
class SuiteCase:
    """A drawing of the suite, with what is true of it.

    Parameters
    ----------
    name, style : as in the description; the style says how the walls look
    recipe : the description
    drawing, truth : as they arrive; truth.doors are the true doors, one per leaf
    area : (height, width) bool, the walls' bodies, between the lines of hollow and hatched ones too
    """

    name: str
    style: str
    recipe: Recipe
    drawing: Drawing
    truth: Truth
    area: NDArray[np.bool_]


@dataclass(frozen=True)
class SuiteRow:
    """How a method did on a drawing of the suite.

    Parameters
    ----------
    name, style, method : whose row it is
    walls : pixels counted without don't-care; its recall is of the walls' ink
    area_recall : share of the walls' bodies that was detected; as good as `walls.recall` where walls are solid
    doors_found, doors_true, doors_right : numbers of doors; none are found by a method that looks for none
    seconds : that the method took
    """

    name: str
    style: str
    method: str
    walls: Score
    area_recall: float
    doors_found: int
    doors_true: int
    doors_right: int
    seconds: float = 0.0

    @property
    def meets_bar(self) -> bool:
        """Does it reach all three numbers of the thesis's table?"""
        precision, recall, rate = BAR
        walls = self.walls
        return walls.precision >= precision and walls.recall >= recall and walls.false_positive_rate <= rate


def suite(half: Half, names: Sequence[str] = ()) -> list[SuiteCase]:
    """The drawings of one half, rendered anew (some seconds); or only some of them.

    Raises
    ------
    ValueError
        For an unknown half or name, with the nearest match.
    """
    nearest_name("half", half, ["tuned", "scored"])
    recipes = {recipe.name: recipe for recipe in read_recipes(data_folder() / f"suite_{half}.toml")}
    return [case_of(recipes[nearest_name("drawing", name, list(recipes))]) for name in names or recipes]


def case_of(recipe: Recipe) -> SuiteCase:
    """A recipe, drawn."""
    drawing, truth = draw_recipe(recipe)
    return SuiteCase(recipe.name, recipe.style, recipe, drawing, truth, wall_area(recipe))


def score_suite(
    half: Half,
    method: Method | str | Callable[[Drawing], Found],
    names: Sequence[str] = (),
    progress: Callable[[str], None] | None = None,
) -> list[SuiteRow]:
    """Score a method on one half of the suite.

    Parameters
    ----------
    method : a `Method`, the name of one of `METHODS`, or whatever turns a drawing into walls
    names : only these drawings
    progress : called with a line for each drawing
    """
    rows = []
    for case in suite(half, names):
        rows.append(score_case(case, method))
        if progress is not None:
            progress(told(rows[-1]))
    return rows


def score_case(case: SuiteCase, method: Method | str | Found | Callable[[Drawing], Found]) -> SuiteRow:
    """Score what a method finds, or what was found already, on one drawing."""
    started = time.perf_counter()
    if isinstance(method, Extraction | Walls | np.ndarray):
        found, name = method, getattr(getattr(method, "method", None), "name", "given")
    else:
        run, name = _runner(method)
        found = run(case.drawing)
    seconds = time.perf_counter() - started
    mask = found if isinstance(found, np.ndarray) else found.walls.mask if isinstance(found, Extraction) else found.mask
    doors = found.doors if isinstance(found, Extraction) else ()
    return SuiteRow(
        name=case.name,
        style=case.style,
        method=name,
        walls=score_mask(mask, case.truth),
        area_recall=float(mask[case.area].mean()) if case.area.any() else float("nan"),
        doors_found=len(doors),
        doors_true=len(case.truth.doors),
        doors_right=len(matched_doors(doors, case.truth.doors)),
        seconds=seconds,
    )


def matched_doors(found: Sequence[Door], true: Sequence[Door], near: float = NEAR) -> list[tuple[int, int]]:
    """Pairs (found, true) of doors that are the same: one to one, nearest first.

    Both jambs must lie within `near` door widths of the true ones, whichever is called hinge, and the tip on the true side
    of the wall.

    >>> door = Door((10, 10), (50, 10), (10, 50))
    >>> matched_doors([Door((51, 11), (12, 10), (50, 48))], [door]), matched_doors([Door((10, 10), (50, 10), (10, -30))], [door])
    ([(0, 0)], [])
    """
    pairs: list[tuple[float, int, int]] = []
    for i, one in enumerate(found):
        for j, other in enumerate(true):
            there = np.abs(one.points[:2] - other.points[:2])
            swapped = np.abs(one.points[1::-1] - other.points[:2])
            apart = min(float(np.hypot(*jambs.T).max()) for jambs in (there, swapped))
            if apart <= near * other.width and _side(one, other) * _side(other, other) > 0:
                pairs.append((apart / other.width, i, j))
    chosen: list[tuple[int, int]] = []
    for _, i, j in sorted(pairs):
        if all(i != a and j != b for a, b in chosen):
            chosen.append((i, j))
    return chosen


def summary(rows: Sequence[SuiteRow]) -> dict[str, float]:
    """Means over drawings in percent, drawings that meet the bar, doors of all drawings together.

    Precision is undefined where nothing was detected; such drawings count in `nothing_found`, not in its mean.
    """
    if not rows:
        raise ValueError("rows must hold at least one drawing, got none")
    precision = np.array([row.walls.precision for row in rows])
    found, true = sum(row.doors_found for row in rows), sum(row.doors_true for row in rows)
    right = sum(row.doors_right for row in rows)
    defined = precision[np.isfinite(precision)]
    return {
        "drawings": len(rows),
        "precision": _percent(float(defined.mean()) if defined.size else float("nan")),
        "recall": _percent(float(np.mean([row.walls.recall for row in rows]))),
        "area_recall": _percent(float(np.mean([row.area_recall for row in rows]))),
        "false_positive_rate": _percent(float(np.mean([row.walls.false_positive_rate for row in rows]))),
        "meet_bar": sum(row.meets_bar for row in rows),
        "nothing_found": int(np.count_nonzero(~np.isfinite(precision))),
        "door_precision": _percent(right / found if found else float("nan")),
        "door_recall": _percent(right / true if true else float("nan")),
        "seconds": round(float(np.mean([row.seconds for row in rows])), 2),
    }


def by_style(rows: Sequence[SuiteRow]) -> dict[str, dict[str, float]]:
    """A summary for every style of wall, in the order of the rows."""
    return {style: summary([row for row in rows if row.style == style]) for style in dict.fromkeys(row.style for row in rows)}


def told(row: SuiteRow) -> str:
    """A row as a line of text."""
    walls = row.walls
    return (
        f"{row.name:15}{row.style:9}{row.method:18}P {100 * walls.precision:5.1f}  R {100 * walls.recall:5.1f}  "
        f"area {100 * row.area_recall:5.1f}  FPR {100 * walls.false_positive_rate:6.3f}  {'met' if row.meets_bar else '-  '}  "
        f"doors {row.doors_right} right of {row.doors_found} found, {row.doors_true} true  {row.seconds:.1f} s"
    )


def _runner(method: Method | str | Callable[[Drawing], Found]) -> tuple[Callable[[Drawing], Found], str]:
    """A callable and its name."""
    if isinstance(method, Method):
        return partial(extract_walls, method=method), method.name
    if isinstance(method, str):
        return METHODS[nearest_name("method", method, list(METHODS))], method
    return method, getattr(method, "__name__", "method")


def _side(one: Door, wall: Door) -> float:
    """On which side of a door's open side the tip of another lies: positive or negative."""
    along, to_tip = wall.points[1] - wall.points[0], one.points[2] - wall.points[0]
    return float(along[0] * to_tip[1] - along[1] * to_tip[0])


def _percent(share: float) -> float:
    """Percent, rounded; -1 for what is undefined."""
    return round(100 * share, 3) if np.isfinite(share) else -1.0
