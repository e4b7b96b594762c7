"""Figures 5.8, 5.9 and 5.10: what the prior is worth, by density of the survey, over time, and by its quality."""

from __future__ import annotations

from typing import Any

import numpy as np

from priorlab import plot
from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap, Prior
from priorlab.figures.case import case
from priorlab.figures.figure import Entry, Outcome, sheet, verdict_of
from priorlab.figures.map_sheet import NO_PLAN, bare, map_sheet, posterior, show_map
from priorlab.figures.row_summary import gain_told, interval_of, mean_looks_of, summary_of, survey_title, three_curves
from priorlab.mapping.over_time import score_over_time
from priorlab.mapping.update import update_map
from priorlab.robot.explore import explore
from priorlab.study.conditions import SEEDS, Condition, Row, run_all, vary
from priorlab.study.qualities import prior_of_quality
from priorlab.study.surveys import thinned
from priorlab.study.thesis_drawings import (
    DENSE,
    FINEST,
    QUICK,
    THESIS_DRAWINGS,
    THOROUGH,
    sensor_for,
    thesis_plan,
)

SPACINGS = (QUICK, 0.9, 0.6, 0.45, THOROUGH, 0.2, DENSE, FINEST)
SLOW = 3.0
"""Mean looks at a seen cell from which a survey is no longer called quick (method page: the claim holds below about 3)."""

OVER_TIME = ("flat_north", "office_section_a")
EVERY = 4
DAMAGED = ("30 % missing", "70 % missing", "a wall too many")


def _density(rng: np.random.Generator) -> Outcome:
    """F2 of the five drawings with the plan, without and of the plan alone; and the gain from a quick survey to a dense one."""
    rows = run_all(list(vary(Condition(""), building=THESIS_DRAWINGS, spacing=SPACINGS)))
    figure, axes = sheet(1, 3, 5.4, 4.6)
    for ax, spacing, name in zip(axes, (QUICK, THOROUGH), ("quick", "thorough"), strict=False):
        own = [row for row in rows if row.condition.spacing == spacing]
        plot.interval_bars(THESIS_DRAWINGS, three_curves(_by_drawing(own)), ax, survey_title(name, own))
    looks, gains = {}, {}
    for name in THESIS_DRAWINGS:
        groups = [[row for row in rows if row.condition == Condition(name, spacing)] for spacing in SPACINGS]
        looks[name] = [mean_looks_of(group) for group in groups]
        gains[name] = [interval_of([row.worth.gain_percent for row in group]) for group in groups]
    plot.looks_axis(plot.gains(looks, gains, axes[2], "quick to dense, 5 seeds each"), 1.0, 14.0)
    told = [row.as_numbers() for row in rows]
    by_looks = np.array([(row["mean_looks"], row["gain_percent"]) for row in told])
    quick, slow = (by_looks[where, 1] for where in (by_looks[:, 0] < SLOW, by_looks[:, 0] >= SLOW))
    at = {
        name: [row for row in told if row["spacing"] == spacing]
        for name, spacing in (("quick", QUICK), ("thorough", THOROUGH), ("dense", DENSE))
    }
    return Outcome(
        figure,
        {"rows": told, "seeds": list(SEEDS)},
        verdict_of((by_looks[:, 1] >= 20).tolist()),
        "the gain is "
        + ", ".join(f"{_range(own, 'gain_percent')} % after a {name} survey" for name, own in at.items())
        + f" ({', '.join(f'{_mean_of(own):.1f}' for own in at.values())} looks at a seen cell); "
        f"'at least +20 %' holds for {int((quick >= 20).sum())} of {len(quick)} surveys below {SLOW:g} looks and "
        f"{int((slow >= 20).sum())} of {len(slow)} above",
        "Bars of F2 with the plan, without it and of the plan alone for a quick and a thorough survey of five drawings, and the "
        "gain in F2 over the mean number of looks at a seen cell, which falls below zero for the office sections.",
    )


def _over_time(rng: np.random.Generator) -> Outcome:
    """F2 while a flat and a section are explored densely: with the plan, without, the plan alone; five surveys each."""
    figure, axes = sheet(1, 2, 6.2, 4.0)
    numbers: dict[str, Any] = {}
    never_below, ends_above = [], []
    for ax, name in zip(axes, OVER_TIME, strict=True):
        plan = thesis_plan(name, FINEST)
        grid = Grid(plan.truth.shape, 3, plan.metres_per_pixel)
        starts = {
            "with the plan": prior_of_quality(name, "extracted", grid, Prior(), rng),
            "without (0.5)": GridMap(np.zeros(grid.shape), grid, NO_PLAN),
        }
        runs = []
        for child in rng.spawn(len(SEEDS)):
            survey = thinned(plan.survey, round(DENSE / FINEST), child)
            runs.append(score_over_time(explore(plan.truth, survey, sensor_for(plan)), starts, plan.truth, every=EVERY))
        n = min(len(one.steps) for one in runs) - 1  # seeds differ by a few poses
        curves = {key: np.array([interval_of([one.f_beta[key][k] for one in runs]) for k in range(n)]) for key in starts}
        alone = float(runs[0].f_beta["with the plan"][0])
        curves["the plan alone"] = np.full((n, 3), alone)
        steps = runs[0].steps[:n]
        plot.interval_lines(steps, curves, ax, f"{name}, 3 px cells", "readings taken")
        ax.set_ylim(0, 1.02)
        informed, uninformed = curves["with the plan"][:, 0], curves["without (0.5)"][:, 0]
        never_below.append(bool((informed >= uninformed).all()))
        ends_above.append(bool(informed[-1] > uninformed[-1]))
        below = np.flatnonzero(informed < uninformed)
        numbers[name] = {
            "steps": steps.tolist()[:: max(1, n // 60)],
            "with_the_plan": curves["with the plan"][:: max(1, n // 60)].round(4).tolist(),
            "without": curves["without (0.5)"][:: max(1, n // 60)].round(4).tolist(),
            "plan_alone": alone,
            "ends": [float(informed[-1]), float(uninformed[-1])],
            "first_reading_below": int(steps[below[0]]) if below.size else None,
            "readings": int(steps[-1]),
        }
    alone_best = [row["plan_alone"] > max(row["ends"]) for row in numbers.values()]
    said = "; ".join(
        f"{name}: with the plan {row['plan_alone']:.2f} to {row['ends'][0]:.2f}, without it 0 to {row['ends'][1]:.2f}"
        + (f", which leads from reading {row['first_reading_below']} of {row['readings']}" if row["first_reading_below"] else "")
        for name, row in numbers.items()
    )
    return Outcome(
        figure,
        numbers,
        verdict_of([*never_below, *ends_above]),
        f"{said}; the plan alone, which the thesis does not draw, ends above both on {sum(alone_best)} of {len(alone_best)}",
        "F2 over the readings taken, for a flat and an office section: with the plan it falls from a high start, without it it "
        "rises from zero and crosses in the section; the plan alone is dotted.",
    )


def _damaged(rng: np.random.Generator) -> Outcome:
    """Figure 5.10: maps from priors with missing parts and with a wall too many; and F2 over five seeds on all drawings."""
    one = case("office_section_b", 3, QUICK)
    figure, axes = map_sheet(len(DAMAGED), 3, one, 3.2)
    grid, evidence = one.experiment.evidence.grid, one.experiment.evidence
    for i, quality in enumerate(DAMAGED):
        start = prior_of_quality(one.plan.name, quality, grid, Prior(), np.random.default_rng((SEEDS[0], 1)))
        plot.map(start, axes[3 * i], title=f"prior: {quality}")
        axes[3 * i].title.set_fontsize(8)
        bare(axes[3 * i])
        show_map(update_map(start, evidence), one, axes[3 * i + 1], "the map from it, quick survey")
        show_map(posterior(one, NO_PLAN), one, axes[3 * i + 2], "the map without a prior")
    rows = run_all(list(vary(Condition(""), quality=DAMAGED, spacing=(QUICK, THOROUGH), building=THESIS_DRAWINGS)))
    gains: dict[str, Any] = {}
    for quality in DAMAGED:
        for name, spacing in (("quick", QUICK), ("thorough", THOROUGH)):
            own = [row for row in rows if (row.condition.quality, row.condition.spacing) == (quality, spacing)]
            gains[f"{quality}, {name}"] = summary_of(own)
    better = [row["better"] == row["of"] for row in gains.values()]
    said = "; ".join(f"{key}: {gain_told(row)}, better in {row['better']} of {row['of']}" for key, row in gains.items())
    return Outcome(
        figure,
        gains,
        verdict_of(better),
        f"gain in F2 over no prior on five drawings and five seeds: {said}",
        "Priors that lack parts of the plan or hold a wall too many, the maps that they lead to, and the map without a prior.",
    )


def _by_drawing(rows: list[Row]) -> list[list[Row]]:
    """The rows of each drawing."""
    return [[row for row in rows if row.condition.building == name] for name in THESIS_DRAWINGS]


def _mean_of(rows: list[dict[str, Any]]) -> float:
    """Mean looks of rows that are plain numbers."""
    return float(np.mean([row["mean_looks"] for row in rows]))


def _range(rows: list[dict[str, Any]], key: str) -> str:
    """From the lowest to the highest, signed."""
    values = [row[key] for row in rows]
    return f"{min(values):+.0f} to {max(values):+.0f}"


FIGURE_5_8 = Entry(
    "fig-5-8",
    "F2 with the plan and without, and the gain by density of the survey",
    "The informative prior raises F2 by at least 20 % on all five drawings.",
    _density,
)
FIGURE_5_9 = Entry(
    "fig-5-9",
    "F2 over time with the plan, without, and the plan alone",
    "With the informative prior F2 is higher from the start to the end of the exploration.",
    _over_time,
)
FIGURE_5_10 = Entry(
    "fig-5-10",
    "maps from damaged priors",
    "Even a prior that lacks walls or has one too many gives a better map than none.",
    _damaged,
)
