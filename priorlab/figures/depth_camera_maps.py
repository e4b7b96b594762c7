"""Figures 5.14, 5.18 and 5.21, and the optimum of section 5.3: maps with and without the plan, from 3 images a pose and 1."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any, Literal

import numpy as np

from priorlab import plot
from priorlab.core.score import score_map
from priorlab.figures.depth_case import (
    COARSE,
    FINE,
    INFORMATIVE,
    NONE,
    REPEATS,
    Interval,
    arena,
    evidence,
    final_f2,
    final_map,
    final_score,
    prior_alone,
    seeds_of,
    survey,
)
from priorlab.figures.figure import Entry, Outcome, sheet, verdict_of
from priorlab.mapping.evidence import gather_evidence
from priorlab.mapping.over_time import OverTime, score_over_time
from priorlab.mapping.prior import build_prior_map
from priorlab.mapping.update import update_map
from priorlab.optimize.experiment import Experiment
from priorlab.plot.style import BLUE, RED

PLAN, WITHOUT = "with the plan", "without"
NEXT_TO_NOTHING = 0.25
"""F2 below which we call a map "effectively no information"."""

NEAR_BEST = 0.95
"""Share of the best F2 that still counts as an optimum."""


def _final_maps(rng: np.random.Generator, repeats: int) -> Outcome:
    """Both priors at both cell sizes, over all surveys."""
    seeds = seeds_of(rng)
    figure, axes = sheet(2, 2, 5.0, 4.0)
    f2: dict[int, dict[str, Interval]] = {}
    for row, size in enumerate((FINE, COARSE)):
        f2[size] = {WITHOUT: final_f2(seeds, NONE, size, repeats), PLAN: final_f2(seeds, INFORMATIVE, size, repeats)}
        for column, (name, prior) in enumerate(((WITHOUT, NONE), (PLAN, INFORMATIVE))):
            title = f"cells of {size} px, {name}: F2 {f2[size][name]}"
            plot.map(final_map(seeds[0], prior, size, repeats), axes[2 * row + column], title=title)
    better = {size: better_on(seeds, size, repeats) for size in f2}
    ratio = {size: f2[size][PLAN].mean / max(f2[size][WITHOUT].mean, 1e-9) for size in f2}
    looks, nothing = evidence(seeds[0], FINE, repeats).mean_looks, f2[COARSE][WITHOUT].mean < NEXT_TO_NOTHING
    numbers: dict[str, Any] = {f"cells_of_{size}_px": {name: vars(one) for name, one in f2[size].items()} for size in f2}
    numbers |= {"prior_alone": {size: prior_alone(size) for size in f2}, "mean_looks": looks, "surveys": len(seeds)}
    numbers["the_plan_is_better_on"] = better
    said = "; ".join(
        f"cells of {size} px: F2 {f2[size][PLAN]} with the plan, {f2[size][WITHOUT]} without, {prior_alone(size):.2f} for the "
        f"plan alone, better with it on {better[size]} of {len(seeds)} surveys"
        for size in f2
    )
    return Outcome(
        figure,
        numbers,
        verdict_of([better[FINE] == len(seeds), better[COARSE] == len(seeds), ratio[COARSE] > ratio[FINE], nothing]),
        f"{said} ({len(seeds)} surveys, mean and range, {looks:.1f} looks at a seen cell); without the plan the coarse map is "
        f"{'next to nothing' if nothing else 'more than nothing'}",
        f"Four maps of the arena from {repeats} image{'s' * (repeats > 1)} a pose: fine cells above, coarse below, without the "
        f"plan on the left, with it on the right.",
    )


def better_on(seeds: tuple[int, ...], size: int, repeats: int) -> int:
    """On how many surveys the plan gives the higher F2."""
    pairs = [[final_score(seed, prior, size, repeats).f_beta for prior in (INFORMATIVE, NONE)] for seed in seeds]
    return sum(informed > uninformed for informed, uninformed in pairs)


def _over_time(rng: np.random.Generator) -> Outcome:
    """F2 after every image, for 3 images a pose and for 1; the plan alone is the third line."""
    seeds = seeds_of(rng)
    figure, axes = sheet(1, 2, 6.0, 4.2)
    alone, numbers, holds, last = prior_alone(FINE), {}, [], {}
    for ax, repeats in zip(axes, (REPEATS, 1), strict=True):
        runs = [_curves(seed, repeats) for seed in seeds]
        curves = {name: np.array([run.f_beta[name] for run in runs]) for name in (PLAN, WITHOUT)}
        steps = runs[0].steps
        title = f"{repeats} image{'s' * (repeats > 1)} a pose, cells of {FINE} px"
        plot.f_over_time(steps, curves[PLAN].mean(axis=0), curves[WITHOUT].mean(axis=0), alone, ax, title=title)
        for name, colour in ((PLAN, BLUE), (WITHOUT, RED)):
            ax.fill_between(steps, curves[name].min(axis=0), curves[name].max(axis=0), color=colour, alpha=0.15, lw=0)
        last[repeats] = {name: Interval.of(curve[:, -1].tolist()) for name, curve in curves.items()}
        falls = bool((curves[PLAN][:, -1] < curves[PLAN][:, 0]).all())
        holds += [alone > 0.9, falls, bool((curves[PLAN] >= curves[WITHOUT]).all())]
        numbers[f"{repeats}_a_pose"] = {
            "steps": steps.tolist(),
            **{name: {"mean": curve.mean(axis=0).tolist()} for name, curve in curves.items()},
            "final": {name: vars(interval) for name, interval in last[repeats].items()},
        }
    readings_of_beyond = {beyond: _final_with(seeds, beyond) for beyond in ("thickness", "hit_cell", "all")}
    half = last[1][WITHOUT].mean <= 0.6 * last[1][PLAN].mean
    levels = "higher" if last[1][PLAN].mean > 0.4 and last[1][WITHOUT].mean > 0.2 else "not all higher"
    highest = max(interval.high for both in last.values() for interval in both.values())
    near = {name: abs(last[1][name].mean - value) <= 0.1 for name, value in ((PLAN, 0.4), (WITHOUT, 0.2))}
    return Outcome(
        figure,
        {
            "prior_alone": alone,
            **numbers,
            "thesis_final": {PLAN: 0.4, WITHOUT: 0.2},
            "within_0.1_of_the_thesis": near,
            "beyond_1_a_pose": readings_of_beyond,
        },
        verdict_of([*holds, half, *near.values()]),
        f"F2 starts at {alone:.2f} and falls to {last[REPEATS][PLAN]} with 3 images a pose and {last[1][PLAN]} with 1; without "
        f"the plan it ends at {last[REPEATS][WITHOUT]} and {last[1][WITHOUT]}; the thesis reads about 0.4 against 0.2 with 1: "
        f"the {'ratio' if half else 'order'} is ours too, our levels are {levels}; the plan alone, which the thesis does not "
        f"draw, stands {'above' if alone > highest else 'not above'} every final map; the levels hang on what 'beyond' means in "
        f"eq. 5.6: with the hit cell alone (eq. 6.1) 1 image ends at {_pair(readings_of_beyond['hit_cell'])} with and without "
        f"the plan, with the whole shadow (the letter) at {_pair(readings_of_beyond['all'])}",
        "Two plots of F2 over the images taken: with the plan a line that falls from above 0.9, without it one that rises from 0 "
        "and stays below; the plan alone is dotted; shaded: the range over the surveys.",
    )


def _final_with(seeds: tuple[int, ...], beyond: Literal["thickness", "hit_cell", "all"]) -> dict[str, float]:
    """Mean final F2 from 1 image a pose, for a reading of "beyond the obstacle"."""
    maps = {name: build_prior_map(arena().walls, prior, FINE) for name, prior in ((PLAN, INFORMATIVE), (WITHOUT, NONE))}
    f2: dict[str, list[float]] = {name: [] for name in maps}
    for seed in seeds:
        taken = survey(seed).readings(1)
        seen = gather_evidence(replace(taken, sensor=replace(taken.sensor, beyond=beyond)), maps[PLAN].grid)
        for name, start in maps.items():
            f2[name].append(score_map(update_map(start, seen), arena().truth).f_beta)
    return {name: float(np.mean(values)) for name, values in f2.items()}


def _pair(f2: dict[str, float]) -> str:
    """With and without the plan."""
    return f"{f2[PLAN]:.2f} and {f2[WITHOUT]:.2f}"


def _curves(seed: int, repeats: int) -> OverTime:
    """F2 after every image."""
    maps = {name: build_prior_map(arena().walls, prior, FINE) for name, prior in ((PLAN, INFORMATIVE), (WITHOUT, NONE))}
    return score_over_time(survey(seed).readings(repeats), maps, arena().truth)


def _optimum(rng: np.random.Generator) -> Outcome:
    """Where F2 is highest, for both sensor models, 3 images and 1, both cell sizes: plateaus, exact."""
    seeds = seeds_of(rng)
    figure, axes = sheet(2, 2, 5.0, 4.0)
    numbers: dict[str, Any] = {}
    rows, near, low, widths = [], [], [], []
    for row, (model, weaker, proposed) in enumerate((("0.9 / 0.1", False, (0.2, 1.0)), ("0.8 / 0.2", True, (0.4, 0.75)))):
        for column, repeats in enumerate((REPEATS, 1)):
            sweeps = [_experiment(seed, FINE, repeats, weaker).sweep() for seed in seeds]
            best = [sweep.best("f_beta") for sweep in sweeps]
            at = [max(one.plateaus, key=lambda p: p.p_wall.width * p.p_space.width) for one in best]
            there = [sweep.at(*proposed).f_beta for sweep in sweeps]
            low_wall = [where.p_wall.high <= 0.2223 for where in at]
            share = Interval.of([value / one.value for value, one in zip(there, best, strict=True)])
            key = f"{model}, {repeats} a pose"
            numbers[key] = {
                "best": vars(Interval.of([one.value for one in best])),
                "at": [str(where) for where in at],
                "f2_at_the_thesis_optimum": vars(Interval.of(there)),
                "share_of_the_best": vars(share),
                "p_wall_at_most_0.222_on": sum(low_wall),
            }
            title = f"{model}, {repeats} a pose; cross: {proposed}"
            ax = plot.sweep(sweeps[0], "f_beta", axes[2 * row + column], title=title)
            ax.plot(*proposed, "x", color=RED, ms=10, mew=2, clip_on=False)
            near.append(share.mean >= NEAR_BEST)
            low.append(sum(low_wall))
            widths += [where.p_space.width for where in at]
            rows.append(f"{100 * share.mean:.0f} % at {proposed} for {key}")
    return Outcome(
        figure,
        numbers,
        verdict_of(near),
        f"of the best F2 the thesis's optima reach {', '.join(rows)}; the best p_wall is at most 0.2222 = 0.2 / 0.9 on "
        f"{sum(low)} of {4 * len(seeds)} sweeps, where a wall that nobody saw stays a wall; p_space may move by "
        f"{np.mean(widths):.2f} on average without a change",
        "Four colour maps of F2 over p_wall and p_space: sensor model 0.9 / 0.1 above, 0.8 / 0.2 below, three images a pose on "
        "the left, one on the right; a cross marks the thesis's optimum.",
    )


def _experiment(seed: int, size: int, repeats: int, weaker: bool) -> Experiment:
    """The arena, ready for every prior."""
    return Experiment(arena().walls, evidence(seed, size, repeats, weaker), arena().truth)


FIGURE_5_14 = Entry(
    "fig-5-14",
    "final maps from 3 images a pose, two cell sizes, with the plan and without",
    "The plan helps at both cell sizes, more at the coarse one, where the map without it gives effectively no information.",
    partial(_final_maps, repeats=REPEATS),
)
FIGURE_5_18 = Entry(
    "fig-5-18",
    "final maps from 1 image a pose, two cell sizes, with the plan and without",
    "With a single image the plan still shows walls with coarse cells; without it the coarse map shows none.",
    partial(_final_maps, repeats=1),
)
FIGURE_5_21 = Entry(
    "fig-5-21",
    "F2 over the images taken, 3 and 1 a pose, with the plan, without, and the plan alone",
    "With the perfect plan F2 starts very high, falls as errors come in, and stays above; it ends near 0.4, and at 0.2 without "
    "the plan and 1 image a pose.",
    _over_time,
)
OPTIMUM_5_3 = Entry(
    "optimum-5-3",
    "the best prior for the depth camera, two sensor models (text of section 5.3)",
    "A narrow range of optima: (0.2, 1) for the sensor model 0.9 / 0.1, (0.4, 0.75) for 0.8 / 0.2.",
    _optimum,
)
