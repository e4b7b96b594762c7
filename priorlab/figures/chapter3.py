"""Table 3.1 on the drawing suite: how well walls and doors are found, by both presets and by simple filters."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from priorlab import plot
from priorlab.figures.figure import Entry, Outcome, verdict_of
from priorlab.study.drawing_suite import METHODS, Half, SuiteRow, by_style, score_suite, summary

HALVES: tuple[Half, Half] = ("tuned", "scored")

SHARE = 0.9
"""Share of the drawings that ROBUST has to bring over the bar."""

COLUMNS = ("precision", "recall", "area_recall", "false_positive_rate", "door_precision", "door_recall")


@lru_cache(maxsize=32)
def suite_rows(half: Half, method: str) -> tuple[SuiteRow, ...]:
    """One method on one half, computed once for all figures."""
    return tuple(score_suite(half, method))


def _table(rng: np.random.Generator) -> Outcome:
    """Means for each half and method, then for each style of wall, and every drawing's row in the numbers."""
    rows = {half: {method: suite_rows(half, method) for method in METHODS} for half in HALVES}
    means = {half: {method: summary(one) for method, one in methods.items()} for half, methods in rows.items()}
    styles = {half: {method: by_style(one) for method, one in methods.items()} for half, methods in rows.items()}
    numbers: dict[str, Any] = {
        half: {
            method: {
                "mean": _without_seconds(means[half][method]),
                "by_style": {style: _without_seconds(told) for style, told in styles[half][method].items()},
                "drawings": {row.name: _row(row) for row in rows[half][method]},
            }
            for method in METHODS
        }
        for half in HALVES
    }
    thesis = [row.meets_bar for half in HALVES for row in rows[half]["THESIS"]]
    robust = {half: float(np.mean([row.meets_bar for row in rows[half]["ROBUST"]])) for half in HALVES}
    told = "; ".join(
        f"{half} half: "
        + ", ".join(f"{method} {means[half][method]['meet_bar']} of {means[half][method]['drawings']}" for method in METHODS)
        for half in HALVES
    )
    return Outcome(
        _sheet(means, styles),
        numbers,
        verdict_of([*thesis, *(share >= SHARE for share in robust.values())]),
        f"precision 98 %, recall 61 % and false positive rate 0.12 % at once: {told}",
        "Two tables for the tuned and the scored half of the suite: means of every method, and by the style of the walls.",
    )


def _sheet(means: dict[Half, dict[str, dict[str, float]]], styles: dict[Half, dict[str, dict[str, dict[str, float]]]]) -> Figure:
    """The means as one table, the styles as another."""
    names = ("P", "R", "R area", "FPR", "doors P", "doors R")
    first = [
        [half if n == 0 else "", method, *_cells(one)]
        for half, methods in means.items()
        for n, (method, one) in enumerate(methods.items())
    ]
    second = [
        [
            half if n == 0 else "",
            style,
            *(word for method in ("THESIS", "ROBUST") for word in _short(styles[half][method][style])),
        ]
        for half in styles
        for n, style in enumerate(styles[half]["ROBUST"])
    ]
    figure = Figure(figsize=(11, 0.26 * (len(first) + len(second)) + 2.2), layout="constrained")
    FigureCanvasAgg(figure)
    top, bottom = figure.subplots(2, 1, height_ratios=[len(first) + 2, len(second) + 2])
    plot.number_table(
        first,
        ["half", "method", *names, "meet the bar"],
        top,
        "Table 3.1 on our suite: means, %",
        (0.09, 0.2) + (0.1,) * 7,
        len(means["tuned"]),
    )
    head = [f"{method}: {word}" for method in ("THESIS", "ROBUST") for word in ("P", "R", "FPR", "met")]
    plot.number_table(
        second,
        ["half", "walls", *head],
        bottom,
        "by style of the walls, %",
        (0.09, 0.11) + (0.1,) * 8,
        len(styles["tuned"]["ROBUST"]),
    )
    return figure


def _cells(one: dict[str, float]) -> list[str]:
    """A method's means as words; a method that finds no doors at all looks for none."""
    shown = one if one["door_precision"] >= 0 else {**one, "door_recall": -1.0}
    return [*(_percent(shown[column], 3 if column == "false_positive_rate" else 1) for column in COLUMNS), _met(one)]


def _short(one: dict[str, float]) -> list[str]:
    """A style's means as words."""
    return [_percent(one["precision"]), _percent(one["recall"]), _percent(one["false_positive_rate"], 3), _met(one)]


def _met(one: dict[str, float]) -> str:
    """How many drawings meet the bar."""
    return f"{one['meet_bar']:.0f} of {one['drawings']:.0f}"


def _percent(value: float, digits: int = 1) -> str:
    """A number, or a dash for what is undefined."""
    return "-" if value < 0 else f"{value:.{digits}f}"


def _without_seconds(one: dict[str, float]) -> dict[str, float]:
    """Numbers that are the same on every machine."""
    return {name: value for name, value in one.items() if name != "seconds"}


def _row(row: SuiteRow) -> dict[str, Any]:
    """A drawing's numbers in percent; -1 where nothing was detected."""
    walls = row.walls
    shares = {
        "precision": walls.precision,
        "recall": walls.recall,
        "area_recall": row.area_recall,
        "false_positive_rate": walls.false_positive_rate,
    }
    rounded: dict[str, Any] = {name: round(100 * value, 3) if np.isfinite(value) else -1.0 for name, value in shares.items()}
    doors = {"doors_true": row.doors_true, "doors_found": row.doors_found, "doors_right": row.doors_right}
    return {"style": row.style, **rounded, **doors, "meets_bar": row.meets_bar}


TABLE_3_1 = Entry(
    "table-3-1",
    "walls and doors of the drawing suite: both presets and the simple filters, on the tuned and on the scored half",
    "Precision over 98 %, recall over 61 %, false positive rate at most 0.12 % on every drawing.",
    _table,
)
