"""What a group of runs says: intervals over drawings and seeds, titles of surveys, gains in words."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any

import numpy as np

from priorlab.study.conditions import Row
from priorlab.study.interval import Interval


def interval_of(values: Iterable[float]) -> list[float]:
    """Mean, lowest, highest, as plain data."""
    of = Interval.of(values)
    return [of.mean, of.low, of.high]


def curve_of(groups: Iterable[Iterable[Row]], value: Callable[[Row], float]) -> list[list[float]]:
    """An interval for each group."""
    return [interval_of(value(row) for row in group) for group in groups]


def three_curves(groups: Sequence[Sequence[Row]]) -> dict[str, list[list[float]]]:
    """F2 with the plan, without it and of the plan alone: an interval for each group."""
    return {
        "with the plan": curve_of(groups, lambda row: row.worth.informed.f_beta),
        "without (0.5)": curve_of(groups, lambda row: row.worth.uninformed.f_beta),
        "the plan alone": curve_of(groups, lambda row: row.worth.alone.f_beta),
    }


def mean_looks_of(rows: Iterable[Row]) -> float:
    """Mean looks at a seen cell over some runs."""
    return float(np.mean([row.worth.mean_looks for row in rows]))


def survey_title(name: str, rows: Sequence[Row]) -> str:
    """What a survey saw, in two lines."""
    coverage = float(np.mean([row.worth.coverage for row in rows]))
    drawings, seeds = (len({key(row) for row in rows}) for key in (lambda row: row.condition.building, lambda row: row.seed))
    return (
        f"{name} survey: {mean_looks_of(rows):.1f} looks at a seen cell,\n"
        f"{100 * coverage:.0f} % of the walls seen; {drawings} drawings x {seeds} seeds"
    )


def summary_of(rows: Iterable[Row]) -> dict[str, Any]:
    """What a group gives: gain, F2, looks; and on how many drawings and seeds the prior is better than none."""
    own = list(rows)
    return {
        "gain_percent": interval_of(row.worth.gain_percent for row in own),
        "better": sum(row.worth.informed.f_beta > row.worth.uninformed.f_beta for row in own),
        "of": len(own),
        "f2_with_prior": interval_of(row.worth.informed.f_beta for row in own),
        "f2_without": interval_of(row.worth.uninformed.f_beta for row in own),
        "f2_prior_alone": interval_of(row.worth.alone.f_beta for row in own),
        "mean_looks": interval_of(row.worth.mean_looks for row in own),
        "coverage": interval_of(row.worth.coverage for row in own),
    }


def gain_told(summary: dict[str, Any]) -> str:
    """Mean gain and its range.

    >>> gain_told({"gain_percent": [20.0, -5.0, 41.2]})
    '+20 % (-5 to +41)'
    """
    mean, low, high = summary["gain_percent"]
    return f"{mean:+.0f} % ({low:+.0f} to {high:+.0f})"
