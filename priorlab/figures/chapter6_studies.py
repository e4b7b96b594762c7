"""Chapter 6 beyond the thesis's own figures: worlds, filters and maps as tables over five seeds; and what the robot added."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from priorlab import plot
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.score import score_map
from priorlab.figures.figure import Entry, Outcome, sheet, verdict_of
from priorlab.figures.floor_case import AT, COMPLETE, UNFINISHED, ate_of, f2_of, gain_of, n_lost, runs_of, summary_of
from priorlab.mapping.overruled import overruled_readings
from priorlab.slam.counting import GMAPPING_THRESHOLD
from priorlab.slam.parameters import TUNED
from priorlab.study.confidence import Confidence
from priorlab.study.office_floor import (
    ALONE,
    COUNTING,
    FLOOR_PRIOR,
    NO_PLAN,
    WITH,
    WITHOUT,
    FloorCondition,
    FloorRun,
    run_seeds,
)
from priorlab.study.worth import gain_percent

COLUMNS = ("", "ATE, m", "heading, deg", "lost", "walls seen", WITH, WITHOUT, COUNTING, ALONE, "gain, %")
WIDTHS = (0.19, 0.125, 0.08, 0.055, 0.075, 0.125, 0.125, 0.06, 0.075, 0.09)

ATE_LIMIT_M = 0.3
GAIN_LIMIT = 40.0
"""What the simulated floor has to reach on every seed, and in the mean."""

FEW = 30
"""Particles that can have a map each; 4,500 would not fit into memory."""

RAW = Prior(p_wall=0.2, p_space=0.9, factor=1.0)
"""The prior of chapter 5 without its factor: surer than the sensor of chapter 6 (eq. 2.22)."""


def _worlds(rng: np.random.Generator) -> Outcome:
    """Clutter, wheels and tours."""
    groups = {
        "clutter 0": run_seeds(replace(COMPLETE, clutter=0.0)),
        "clutter 0.3, odometry 0.002": runs_of(COMPLETE),
        "clutter 0.6": run_seeds(replace(COMPLETE, clutter=0.6)),
        "furniture as described": run_seeds(replace(COMPLETE, clutter=None)),
        "odometry 0.02": run_seeds(replace(COMPLETE, odometry=0.02)),
        "40 % of the rooms": runs_of(UNFINISHED),
    }
    usual = groups["clutter 0.3, odometry 0.002"]
    gain = gain_of(usual)
    holds = {
        "ATE at most 0.3 m on every seed": max(run.ate_m for run in usual) <= ATE_LIMIT_M,
        "gain at least 40 %": gain is not None and gain.mean >= GAIN_LIMIT,
        "no robot lost in any world": all(n_lost(runs) == 0 for runs in groups.values()),
    }
    return _table_of(groups, holds, "TUNED, localized in the plan", "worlds")


def _filters(rng: np.random.Generator) -> Outcome:
    """Where to localize, and with what values; and without any plan."""
    groups: dict[str, Sequence[FloorRun]] = {
        "localized in the plan": runs_of(COMPLETE),
        "in the plan, walls hinder nobody": run_seeds(_with(p_through_wall=1.0)),
        "in the map, 3 m behind": runs_of(_with(localize_in="updated")),
        "no plan at all": run_seeds(replace(COMPLETE, plan=NO_PLAN)),
        f"in a map of its own for each of {FEW} particles": run_seeds(_with(localize_in="own", particle_limits=(FEW, FEW))),
    }
    holds = {
        "the plan keeps the robot on its way": n_lost(groups["localized in the plan"]) == 0,
        "walls that hinder particles keep the robot nearer to its way on every seed": all(
            through.ate_m > plan.ate_m
            for through, plan in zip(groups["in the plan, walls hinder nobody"], groups["localized in the plan"], strict=True)
        ),
        "without a plan it is worse on every seed": all(
            none.ate_m > plan.ate_m for none, plan in zip(groups["no plan at all"], groups["localized in the plan"], strict=True)
        ),
    }
    return _table_of(groups, holds, "clutter 0.3, odometry 0.002", "filters")


def _with(**changes: Any) -> FloorCondition:
    """The usual floor with other values of the filter."""
    return replace(COMPLETE, parameters=replace(TUNED, **changes))


def _table_of(groups: Mapping[str, Sequence[FloorRun]], holds: dict[str, bool], base: str, what: str) -> Outcome:
    """A row for each group."""
    figure, axes = sheet(1, 1, 15.0, 0.42 * len(groups) + 0.9)
    rows = [[name, *_row(runs)] for name, runs in groups.items()]
    plot.number_table(rows, COLUMNS, axes[0], f"{base}; five seeds, mean and 95 % interval; F2 at {AT}", WIDTHS)
    return Outcome(
        figure,
        {**{name: summary_of(runs) for name, runs in groups.items()}, "holds": holds},
        verdict_of(list(holds.values())),
        f"five seeds, {base}: "
        + "; ".join(
            f"{name}: ATE {ate_of(runs).told()} m, {n_lost(runs)} lost, F2 {f2_of(runs, WITH).mean:.2f} against "
            f"{f2_of(runs, WITHOUT).mean:.2f}" + (f", gain {gain.mean:+.0f} %" if (gain := gain_of(runs)) else "")
            for name, runs in groups.items()
        ),
        f"A table: error, lost robots, coverage, F2 of four maps and gain for several {what}.",
    )


def _row(runs: Sequence[FloorRun]) -> list[str]:
    """The numbers of a group as a line of the table; a lost robot leaves no gain."""
    gain = gain_of(runs)
    return [
        ate_of(runs).told(),
        f"{Confidence.of(run.run.heading_error_deg() for run in runs).mean:.1f}",
        f"{n_lost(runs)} of {len(runs)}",
        f"{100 * Confidence.of(run.coverage for run in runs).mean:.0f} %",
        f2_of(runs, WITH).told(),
        f2_of(runs, WITHOUT).told(),
        f"{f2_of(runs, COUNTING).mean:.2f}",
        f"{f2_of(runs, ALONE).mean:.2f}",
        "-" if gain is None else f"{gain.mean:+.0f} ({gain.low:+.0f} to {gain.high:+.0f})",
    ]


def _updates(rng: np.random.Generator) -> Outcome:
    """The weight of the prior, the depth of walls, the trap of eq. 2.22, the threshold: all on the same poses and scans."""
    runs = runs_of(COMPLETE)
    priors = {"0.27 / 0.72": FLOOR_PRIOR, "0.2 / 0.9, surer than the sensor": RAW}
    choices = {
        **{f"prior {name}, lam 1, 0.10 m": (prior, 1.0, 0.10) for name, prior in priors.items()},
        **{f"prior {name}, lam 0, 0.10 m": (prior, 0.0, 0.10) for name, prior in priors.items()},
        "prior 0.27 / 0.72, lam 1, 0 m": (FLOOR_PRIOR, 1.0, 0.0),
        "prior 0.27 / 0.72, lam 1, 0.20 m": (FLOOR_PRIOR, 1.0, 0.2),
    }
    rows: list[list[str]] = []
    numbers: dict[str, Any] = {}
    for name, (prior, lam, depth) in choices.items():
        f2 = [(_f2(run, run.mapped(prior, lam, depth)), _f2(run, run.mapped(Prior.uninformed(), lam, depth))) for run in runs]
        strict = [_f2(run, run.mapped(prior, lam, depth), 0.2) for run in runs]
        held = {
            "with": Confidence.of(one for one, _ in f2),
            "without": Confidence.of(other for _, other in f2),
            "gain_percent": Confidence.of(gain_percent(one, other) for one, other in f2),
            "with_at_0.2": Confidence.of(strict),
            "gain_percent_at_0.2": Confidence.of(
                gain_percent(one, _f2(run, run.mapped(Prior.uninformed(), lam, depth), 0.2))
                for one, run in zip(strict, runs, strict=True)
            ),
        }
        overruled = bool(overruled_readings(prior, TUNED.p_free, TUNED.p_occupied, lam))
        rows.append(
            [name, *(value.told(2 if "gain" not in key else 0) for key, value in held.items()), "yes" if overruled else ""]
        )
        numbers[name] = {**{key: value.as_numbers() for key, value in held.items()}, "breaks_eq_2_22": overruled}
    columns = ["", "with, at 0.5", "without, at 0.5", "gain, %, at 0.5", "with, at 0.2", "gain, %, at 0.2", "breaks eq. 2.22"]
    figure, axes = sheet(1, 1, 14.0, 0.42 * len(rows) + 0.9)
    title = "F2 of other maps of the same five drives, at P(empty) < 0.5 and at 0.2: prior, weight of the prior, depth of walls"
    plot.number_table(rows, columns, axes[0], title, [0.28, 0.13, 0.13, 0.13, 0.13, 0.11, 0.09])
    gmapping = Confidence.of(run.counted.score(run.floor.truth, GMAPPING_THRESHOLD).f_beta for run in runs)
    usual, sure = (numbers[f"prior {name}, lam 1, 0.10 m"]["with"]["mean"] for name in priors)
    holds = {
        "a prior surer than the sensor is worse (lam 1)": sure < usual,
        "lam 0 scores higher": numbers["prior 0.27 / 0.72, lam 0, 0.10 m"]["with"]["mean"] > usual,
        "the gain falls with the depth of walls": numbers["prior 0.27 / 0.72, lam 1, 0 m"]["gain_percent"]["mean"]
        > numbers["prior 0.27 / 0.72, lam 1, 0.20 m"]["gain_percent"]["mean"],
    }
    return Outcome(
        figure,
        {
            **numbers,
            "lost": n_lost(runs),
            "ate_m": ate_of(runs).as_numbers(),
            "f2_plan_alone": f2_of(runs, ALONE).as_numbers(),
            "f2_counting": f2_of(runs, COUNTING).as_numbers(),
            "f2_counting_as_gmapping_draws_it": gmapping.as_numbers(),
            "holds": holds,
        },
        verdict_of(list(holds.values())),
        f"five seeds, ATE {ate_of(runs).told()} m, {n_lost(runs)} lost: "
        + "; ".join(
            f"{name}: F2 {row['with']['mean']:.2f}, gain {row['gain_percent']['mean']:+.0f} %" for name, row in numbers.items()
        )
        + f"; the plan alone {f2_of(runs, ALONE).mean:.2f}; counting {f2_of(runs, COUNTING).mean:.2f}, with gmapping's threshold "
        f"of a quarter {gmapping.mean:.2f}",
        "A table of F2 for priors, weights of the prior and depths of walls at two thresholds.",
    )


def _f2(run: FloorRun, grid_map: GridMap, threshold: float = 0.5) -> float:
    """F2 of a map of the run."""
    return score_map(grid_map, run.floor.truth, threshold).f_beta


WORLDS = Entry(
    "study-slam",
    "FastSLAM on the simulated floor, by world",
    "With the plan the robot keeps its way (ATE at most 0.3 m) and F2 is at least 40 % higher, in a cluttered building too.",
    _worlds,
)
FILTERS = Entry(
    "study-slam-filters",
    "FastSLAM on the simulated floor, by filter",
    "The plan lets a robot localize better than no plan, and better still when its walls hinder the particles.",
    _filters,
)
UPDATES = Entry(
    "study-slam-updates",
    "maps of one drive, by prior, weight of the prior and depth of walls",
    "A prior must be less sure than the sensor; without the subtraction of l_0 the map is better; deep walls make the gain "
    "small.",
    _updates,
)
