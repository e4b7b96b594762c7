"""Figures 5.1 to 5.7: maps with the plan and without, by cell size, survey and explored part."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from priorlab.core.grid_map import Prior
from priorlab.core.measures import Measure
from priorlab.figures.case import case, case_of_survey
from priorlab.figures.figure import Entry, Outcome, verdict_of
from priorlab.figures.map_sheet import NO_PLAN, map_sheet, numbers_of, posterior, prior_map_of, show_map, show_survey
from priorlab.study.surveys import part_of, thinned
from priorlab.study.thesis_drawings import QUICK, THOROUGH, thesis_plan
from priorlab.study.worth import worth_of

COARSE = (3.0, 5.0, 10.0)
SURVEYS = {"quick": QUICK, "thorough": THOROUGH}


def _best_of_each(rng: np.random.Generator) -> Outcome:
    """Figure 5.1: the maps of the highest precision and of the highest recall, of a section and a flat."""
    shown = [case("office_section_a"), case("flat_south")]
    figure, axes = map_sheet(2, 3, shown[0], 3.6)
    numbers: dict[str, Any] = {}
    for i, one in enumerate(shown):
        sweep, scores = one.experiment.sweep(), {}
        measures: tuple[Measure, Measure] = ("precision", "recall")
        front = sweep.front(floor=0.0)  # the ends of the front: of all maps of the highest precision the one that finds most
        for ax, measure in zip(axes[3 * i :], measures, strict=False):
            end = int(np.argmax(getattr(front, measure)))
            prior = Prior(front.p_wall[end], front.p_space[end])
            told = f"{one.plan.name}: highest {measure}, ({prior.p_wall:.2f}, {prior.p_space:.2f})"
            scores[measure] = show_map(posterior(one, prior), one, ax, told)
        show_survey(one, axes[3 * i + 2])
        numbers[one.plan.name] = {f"highest_{measure}": numbers_of(score) for measure, score in scores.items()}
    prefers = {
        beta: [_f(row["highest_recall"], beta) > _f(row["highest_precision"], beta) for row in numbers.values()]
        for beta in (1, 2)
    }
    told_rows = "; ".join(
        f"{name}: recall {row['highest_precision']['recall']:.2f} at the highest precision, precision "
        f"{row['highest_recall']['precision']:.2f} at the highest recall"
        for name, row in numbers.items()
    )
    return Outcome(
        figure,
        numbers,
        verdict_of(prefers[1]),
        f"{told_rows}; F1, to which both measures are worth the same, prefers the map of the highest recall on {sum(prefers[1])} "
        f"of {len(numbers)}; F2, which favours recall by construction, on {sum(prefers[2])}",
        "Maps of two drawings with the priors of the highest precision and of the highest recall, and the survey's points.",
    )


def _f(row: dict[str, Any], beta: float) -> float:
    """F-beta (eq. 5.1) of a row's precision and recall."""
    precision, recall = row["precision"], row["recall"]
    return (1 + beta**2) * precision * recall / (beta**2 * precision + recall)


def _resolutions(name: str, sizes: tuple[float, ...], rng: np.random.Generator) -> Outcome:
    """Figures 5.2 to 5.6: one drawing, several cell sizes, quick and thorough, without the plan and with it."""
    first = case(name, sizes[0])
    figure, axes = map_sheet(len(sizes), 5, first, 3.0)
    numbers: dict[str, Any] = {}
    for row, size in enumerate(sizes):
        here = axes[5 * row : 5 * row + 5]
        ones = {how: case(name, size, spacing) for how, spacing in SURVEYS.items()}
        if len(sizes) > 2 and row < 2:
            show_survey(ones["quick" if row == 0 else "thorough"], here[0], f"{name}, {'quick' if row == 0 else 'thorough'}")
        else:
            show_map(prior_map_of(case(name, size), Prior()), case(name, size), here[0], f"the plan alone, {size:g} px")
        for i, (how, one) in enumerate(ones.items()):
            without = show_map(posterior(one, NO_PLAN), one, here[1 + 2 * i], f"without, {how}, {size:g} px")
            informed = show_map(posterior(one, Prior()), one, here[2 + 2 * i], f"with the plan, {how}, {size:g} px")
            worth = worth_of(prior_map_of(one, Prior()), one.experiment.evidence, one.plan.truth)
            numbers[f"{how}, {size:g} px"] = {
                "with": numbers_of(informed),
                "without": numbers_of(without),
                "prior_alone_f2": worth.alone.f_beta,
                "coverage": worth.coverage,
                "mean_looks": worth.mean_looks,
            }
    better = {key: row["with"]["f2"] > row["without"]["f2"] for key, row in numbers.items()}
    whole = {key: row["with"]["recall"] >= 0.95 for key, row in numbers.items()}
    worse = [key for key, ok in better.items() if not ok]
    lowest = min(numbers, key=lambda key: numbers[key]["with"]["recall"])
    return Outcome(
        figure,
        numbers,
        verdict_of([*better.values(), *whole.values()]),
        f"{name}: with the plan F2 is higher in {sum(better.values())} of {len(better)} maps"
        + (f" (not {'; '.join(worse)})" if worse else "")
        + f"; recall with the plan lies between {numbers[lowest]['with']['recall']:.2f} ({lowest}) and "
        f"{max(row['with']['recall'] for row in numbers.values()):.2f}, so 'no wall missed, even with coarse cells' holds for "
        f"{sum(whole.values())} of {len(whole)}; the plan alone has F2 "
        f"{min(row['prior_alone_f2'] for row in numbers.values()):.2f} to "
        f"{max(row['prior_alone_f2'] for row in numbers.values()):.2f}",
        f"Maps of {name} for cell sizes {', '.join(f'{size:g}' for size in sizes)} px, without the plan and with it, after a "
        "quick and a thorough survey.",
    )


def _incomplete(rng: np.random.Generator) -> Outcome:
    """Figure 5.7: a section of which half was explored, and a flat of which one corner was, with a few scans of the rest."""
    seeds = rng.spawn(5)
    figure, axes = map_sheet(2, 3, case("office_section_a"), 3.6)
    numbers: dict[str, Any] = {}
    wins, drawn = [], {"office_section_a": "half explored", "flat_south": "one corner, and a few scans"}
    for i, (name, how) in enumerate(drawn.items()):
        runs = []
        for k, child in enumerate(seeds):
            one = case_of_survey(name, _unfinished(name, i == 0, child))
            worth = worth_of(prior_map_of(one, Prior()), one.experiment.evidence, one.plan.truth)
            runs.append(worth)
            if k == 0:
                show_map(posterior(one, NO_PLAN), one, axes[3 * i], f"{name}: without, {how}")
                show_map(posterior(one, Prior()), one, axes[3 * i + 1], "with the plan")
                show_survey(one, axes[3 * i + 2], how)
        wins += [worth.informed.f_beta > worth.uninformed.f_beta for worth in runs]
        numbers[name] = [
            {
                "f2_with": worth.informed.f_beta,
                "f2_without": worth.uninformed.f_beta,
                "f2_prior_alone": worth.alone.f_beta,
                "f2_with_where_seen": worth.seen_informed.f_beta,
                "f2_without_where_seen": worth.seen_uninformed.f_beta,
                "f2_with_where_unseen": worth.unseen.f_beta,
                "coverage": worth.coverage,
                "mean_looks": worth.mean_looks,
            }
            for worth in runs
        ]
    return Outcome(
        figure,
        numbers,
        verdict_of([all(wins)]),
        f"with the plan F2 is higher in {sum(wins)} of {len(wins)} explorations; "
        + "; ".join(f"{name}: {_means(rows)}" for name, rows in numbers.items()),
        "Maps of an office section and a flat that were explored in part, without the plan and with it, and the points of the "
        "survey.",
    )


def _means(rows: list[dict[str, float]]) -> str:
    """The means of some runs in a sentence."""
    mean = {key: float(np.mean([row[key] for row in rows])) for key in rows[0]}
    return (
        f"{mean['f2_with']:.2f} against {mean['f2_without']:.2f} with {100 * mean['coverage']:.0f} % of the walls seen; where "
        f"seen {mean['f2_with_where_seen']:.2f} against {mean['f2_without_where_seen']:.2f}, where not "
        f"{mean['f2_with_where_unseen']:.2f} against 0"
    )


def _unfinished(name: str, half: bool, rng: np.random.Generator) -> NDArray[np.float64]:
    """The poses of an incomplete exploration."""
    whole = thesis_plan(name, THOROUGH).survey
    if half:
        return part_of(whole, 0.5, rng)
    return np.concatenate([part_of(whole, 0.2, rng), thinned(whole, 25, rng)])


def _entry(number: int, name: str, sizes: tuple[float, ...]) -> Entry:
    """Figures 5.2 to 5.6."""
    return Entry(
        f"fig-5-{number}",
        f"{name} with the plan and without, by cell size",
        "Without a prior walls are missing, above all in coarse grids; with it no wall is missed, even in coarse ones.",
        partial(_resolutions, name, sizes),
    )


FIGURE_5_1 = Entry(
    "fig-5-1",
    "maps of the highest precision and of the highest recall",
    "Recall shapes the outline of a map more than precision does: that is why F2 is the measure.",
    _best_of_each,
)
FIGURE_5_2 = _entry(2, "flat_north", (3.0, 10.0))
FIGURES_5_3_TO_5_6 = tuple(
    _entry(number, name, COARSE)
    for number, name in enumerate(("flat_south", "office_section_a", "office_section_b", "office_section_c"), start=3)
)
FIGURE_5_7 = Entry(
    "fig-5-7",
    "maps of an incomplete exploration",
    "After an incomplete exploration the map without a prior is far worse: the plan tells of what nobody saw.",
    _incomplete,
)
