"""Figures 4.6 and 4.9 to 4.11: maps of the extremes, of the proposed prior and of the thesis's three clusters."""

from __future__ import annotations

from typing import Any

import numpy as np

from priorlab import plot
from priorlab.core.grid_map import Prior
from priorlab.core.measures import Measure
from priorlab.figures.case import Case, case, cases
from priorlab.figures.chapter4 import PROPOSED
from priorlab.figures.figure import Entry, Outcome, verdict_of
from priorlab.figures.map_sheet import map_sheet, numbers_of, pairs_told, posterior, show_map, show_survey
from priorlab.study.thesis_drawings import QUICK, THOROUGH

LOW, HIGH = (0.2, 0.4), (0.75, 0.74)
"""Middles of the thesis's clusters 1 (0.1 to 0.3, 0.2 to 0.6) and 2 (0.5 to 1, 0.48 to 1)."""

SHORTLIST = (*((0.2, space / 10) for space in range(6, 11)), (0.4, 0.7), (0.4, 0.8), (0.5, 0.7), (0.5, 0.8))
"""Eq. 4.28 with one decimal."""


def _overview(rng: np.random.Generator) -> Outcome:
    """Figure 4.6: one drawing, the maps of the highest precision and recall, the sweep with its front, the proposed map."""
    one = case("office_section_c")
    sweep, front = one.experiment.sweep(), one.experiment.sweep().front()
    figure, axes = map_sheet(2, 4, one, 3.6)
    show_survey(one, axes[0])
    scores = {}
    measures: tuple[Measure, Measure] = ("precision", "recall")
    for ax, measure in zip(axes[1:3], measures, strict=True):
        where = sweep.best(measure).plateaus[0]
        prior = Prior(where.p_wall.middle, where.p_space.middle)
        told = f"highest {measure}, ({prior.p_wall:.2f}, {prior.p_space:.2f})"
        scores[f"highest_{measure}"] = show_map(posterior(one, prior), one, ax, told)
    scores["proposed"] = show_map(posterior(one, Prior(*PROPOSED)), one, axes[3], "(0.2, 0.9), proposed")
    for ax, measure in zip(axes[4:6], measures, strict=True):
        plot.sweep(sweep, measure, ax, title=f"{measure}, and the front's priors")
        ax.plot(front.p_wall, front.p_space, "o", color="black", mec="white", ms=4)
    proposed = scores["proposed"]
    plot.front({"exact front": front}, axes[6], (proposed.precision, proposed.recall), "front; cross: (0.2, 0.9)")
    axes[6].set(xlim=(0.38, 1.02), ylim=(0.38, 1.02))
    axes[7].remove()
    f1 = {name: 2 * score.tp / (2 * score.tp + score.fp + score.fn) for name, score in scores.items()}
    better = [f1["proposed"] > f1[f"highest_{measure}"] for measure in measures]
    beats = [proposed.f_beta > scores[f"highest_{measure}"].f_beta for measure in measures]
    return Outcome(
        figure,
        {name: numbers_of(score) | {"f1": f1[name]} for name, score in scores.items()} | {"priors_on_the_front": len(front)},
        verdict_of([*better, *beats]),
        f"{one.plan.name}: F2 {proposed.f_beta:.2f} with (0.2, 0.9) against {scores['highest_precision'].f_beta:.2f} at the "
        f"highest precision and {scores['highest_recall'].f_beta:.2f} at the highest recall (F1 {f1['proposed']:.2f}, "
        f"{f1['highest_precision']:.2f}, {f1['highest_recall']:.2f}), after a thorough survey",
        "A drawing with its survey, the maps of the highest precision, the highest recall and the proposed prior, both colour "
        "maps with the front's priors, and the front.",
    )


def _low(rng: np.random.Generator) -> Outcome:
    """Figure 4.9: two office sections and a flat with a prior of cluster 1."""
    shown = [case(name) for name in ("office_section_a", "office_section_b", "flat_south")]
    figure, axes = map_sheet(3, 3, shown[0], 3.6)
    numbers: dict[str, Any] = {}
    for i, one in enumerate(shown):
        low = show_map(posterior(one, Prior(*LOW)), one, axes[3 * i], f"{one.plan.name}: {LOW}, cluster 1")
        proposed = show_map(posterior(one, Prior(*PROPOSED)), one, axes[3 * i + 1], f"{PROPOSED}, proposed")
        show_survey(one, axes[3 * i + 2])
        numbers[one.plan.name] = {
            "cluster_1": numbers_of(low),
            "proposed": numbers_of(proposed),
            "wall_in_space_cells": _in_space(one),
        }
    precise = [row["cluster_1"]["precision"] >= row["proposed"]["precision"] for row in numbers.values()]
    few = [row["cluster_1"]["recall"] < 0.5 * row["proposed"]["recall"] for row in numbers.values()]
    return Outcome(
        figure,
        {"prior": LOW, "drawings": numbers},
        verdict_of([*precise, *few]),
        f"{LOW} is at least as precise as (0.2, 0.9) on {sum(precise)} of {len(shown)} drawings and finds fewer than half "
        f"as many wall pixels on {sum(few)}: p_space only rules cells that the plan shows as space, and they hold at most "
        f"{100 * max(row['wall_in_space_cells'] for row in numbers.values()):.0f} % of the true wall pixels here",
        "Maps of three drawings with a prior of the thesis's cluster 1 beside the proposed prior and the survey's points.",
    )


def _in_space(one: Case) -> float:
    """Share of the true wall pixels that lie in cells where the plan shows space."""
    walls = one.experiment.pixels[0]
    return float(walls[~one.experiment.wall_cells].sum() / walls.sum())


def _shortlist(rng: np.random.Generator) -> Outcome:
    """Figure 4.10: the pairs of eq. 4.28 on one drawing; how does (0.2, 0.9) rank on all five, quick and thorough?"""
    one = case("office_section_c")
    figure, axes = map_sheet(3, 3, one, 3.4)
    for ax, prior in zip(axes, SHORTLIST, strict=True):
        show_map(posterior(one, Prior(*prior)), one, ax, f"{one.plan.name}: ({prior[0]:g}, {prior[1]:g})")
    numbers: dict[str, Any] = {}
    first = []
    for spacing, name in ((QUICK, "quick"), (THOROUGH, "thorough")):
        for each in cases(spacing=spacing):
            sweep = each.experiment.sweep()
            scores = {prior: sweep.at(*prior).f_beta for prior in SHORTLIST}
            top = max(scores.values())
            best = [prior for prior, score in scores.items() if score > top - 1e-12]
            first.append(PROPOSED in best)
            numbers[f"{each.plan.name}, {name}"] = {
                "f2": {f"({wall:g}, {space:g})": score for (wall, space), score in scores.items()},
                "best": pairs_told(best),
                "proposed_loses": top - scores[PROPOSED],
            }
    loss = max(row["proposed_loses"] for row in numbers.values())
    return Outcome(
        figure,
        numbers,
        verdict_of(first),
        f"(0.2, 0.9) has the highest F2 of the shortlist in {sum(first)} of {len(first)} cases (five drawings, {sum(first[:5])} "
        f"quick and {sum(first[5:])} thorough) and is at worst {loss:.2f} below the best pair; 'visual quality' is no number",
        "Maps of one drawing with the nine priors of the shortlist, each with its F2, precision and recall.",
    )


def _high(rng: np.random.Generator) -> Outcome:
    """Figure 4.11: two office sections with a prior of cluster 2."""
    shown = [case(name) for name in ("office_section_a", "office_section_c")]
    figure, axes = map_sheet(2, 3, shown[0], 3.6)
    numbers: dict[str, Any] = {}
    for i, one in enumerate(shown):
        high = show_map(posterior(one, Prior(*HIGH)), one, axes[3 * i], f"{one.plan.name}: {HIGH}, cluster 2")
        proposed = show_map(posterior(one, Prior(*PROPOSED)), one, axes[3 * i + 1], f"{PROPOSED}, proposed")
        show_survey(one, axes[3 * i + 2])
        numbers[one.plan.name] = {"cluster_2": numbers_of(high), "proposed": numbers_of(proposed)}
    more = [row["cluster_2"]["recall"] >= row["proposed"]["recall"] for row in numbers.values()]
    wrong = [row["cluster_2"]["precision"] < row["proposed"]["precision"] for row in numbers.values()]
    return Outcome(
        figure,
        {"prior": HIGH, "drawings": numbers},
        verdict_of([*more, *wrong]),
        f"{HIGH} finds at least as many walls as (0.2, 0.9) on {sum(more)} of {len(shown)} drawings and is less precise on "
        f"{sum(wrong)}: a high p_wall helps where cells were seen twice or more, and loses the walls that nobody saw",
        "Maps of two drawings with a prior of the thesis's cluster 2 beside the proposed prior and the survey's points.",
    )


FIGURE_4_6 = Entry(
    "fig-4-6",
    "one drawing: both extremes, the sweep, the front, the proposed prior",
    "Neither the map of the highest precision nor that of the highest recall is good; the one from (0.2, 0.9) is.",
    _overview,
)
FIGURE_4_9 = Entry(
    "fig-4-9",
    "maps of cluster 1: both numbers low",
    "Priors with both numbers low favour precision: their maps show very few of the walls.",
    _low,
)
FIGURE_4_10 = Entry(
    "fig-4-10",
    "maps of the shortlist",
    "Of all pairs of the shortlist, (0.2, 0.9) gives the best map.",
    _shortlist,
)
FIGURE_4_11 = Entry(
    "fig-4-11",
    "maps of cluster 2: both numbers high",
    "Priors with both numbers high favour recall: most walls are there, but free space is often mapped as wall.",
    _high,
)
