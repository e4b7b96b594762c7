"""Sections of chapters 4 and 5: the prior map, the survey, the map with the plan and without."""

from __future__ import annotations

from functools import partial

from priorlab import plot
from priorlab.core.grid_map import GridMap
from priorlab.pipeline import Mapping, PipelineResult
from priorlab.plot.extraction import LEGEND
from priorlab.report.pictures import picture, size_for
from priorlab.report.section import Section, percent, score_table


def prior_section(result: PipelineResult, prior_map: GridMap) -> Section:
    """Chapter 4.2."""
    prior, grid = result.prior, prior_map.grid
    rows, cols = grid.shape
    return Section(
        "Prior map: believe the drawing a little",
        (
            f"Where the drawing shows a wall, a cell starts with P(empty) = {prior.effective_p_wall:.3g}; where it shows "
            f"space, with "
            f"{prior.effective_p_space:.3g}. These are p_wall = {prior.p_wall:g} and p_space = {prior.p_space:g} times "
            f"{prior.factor:g}, the factor "
            "that keeps the log odds finite.",
        ),
        (
            picture(
                lambda ax: plot.map(prior_map, ax),
                f"The prior map: dark walls at P(empty) {prior.effective_p_wall:.2g}, light space at "
                f"{prior.effective_p_space:.2g}.",
                f"{cols} x {rows} cells of {grid.cell_size:g} pixels.",
                size_for(result.drawing.shape),
                wide=True,
            ),
        ),
    )


def survey_section(result: PipelineResult, mapping: Mapping) -> Section:
    """Chapter 4.5.2."""
    taken, evidence, size = mapping.readings, mapping.evidence, size_for(result.drawing.shape)
    who = (
        "The robot explores the true building of the plan."
        if result.plan is not None
        else (
            "Nobody has surveyed this building, so the robot explores the building AS EXTRACTED: its walls are taken for "
            f"the world. Rooms that its walls close hold {100 * (result.share_indoors or 0):.0f} % of the space within their "
            "outline; the rest is not explored."
        )
    )
    return Section(
        "The robot looks around",
        (
            f"{who} From {len(taken)} known poses it measures ranges up to {taken.sensor.max_range:.0f} pixels. The survey saw "
            f"{100 * evidence.seen.mean():.0f} % of the cells, each {evidence.mean_looks:.2f} times on average. That mean "
            "decides what a prior is worth: the more often a cell is looked at, the less the plan has to add.",
        ),
        (
            picture(
                lambda ax: plot.readings(taken, mapping.prior_map, ax, every=max(1, len(taken) // 60), title=""),
                f"Rays from some of {len(taken)} poses on the map, with a dot where a ray met a wall.",
                "Rays from some of the poses; dots where they met a wall.",
                size,
            ),
            picture(
                lambda ax: plot.looks(evidence, ax, title=""),
                f"A colour map of how often each cell was seen, {evidence.mean_looks:.1f} times on average.",
                "How often each cell was seen; white: never.",
                (size[0] + 0.6, size[1]),
            ),
        ),
    )


def posterior_section(result: PipelineResult, mapping: Mapping) -> Section:
    """Chapter 5."""
    size, change = size_for(result.drawing.shape), mapping.disagreement
    pictures = [
        picture(
            lambda ax: plot.map(mapping.uninformed, ax),
            "The map of the survey without the plan: grey where nothing was seen.",
            "Without the plan: every cell starts at 0.5.",
            size,
        ),
        picture(
            lambda ax: plot.map(mapping.informed, ax),
            "The map of the same survey with the plan as prior: walls also where the robot hardly looked.",
            "With the plan as prior; the same readings.",
            size,
        ),
    ]
    differ = (
        f"The readings contradict the plan in {int(change.opened.sum())} cells that it calls wall and "
        f"{int(change.blocked.sum())} that it "
        "calls space."
    )
    if result.plan is None or mapping.score_informed is None:
        text = (
            "The same evidence updates two maps: one started from the plan, one from 0.5 everywhere. No truth is known, so "
            "there is no score; the "
            "pictures show what the plan adds.",
            differ,
        )
        return Section("Posterior map: with and without the plan", text, tuple(pictures))
    truth = result.plan.truth
    for name, grid_map, score in (
        ("Without", mapping.uninformed, mapping.score_uninformed),
        ("With", mapping.informed, mapping.score_informed),
    ):
        assert score is not None
        pictures.append(
            picture(
                partial(plot.scored, grid_map, truth, 0.2, title=""),
                f"{name} the plan, every pixel by what the score makes of it: recall {percent(score.recall)}, precision "
                f"{percent(score.precision)}.",
                f"{name} the plan, judged at P(empty) <= 0.2. {LEGEND.capitalize()}.",
                size,
            )
        )
    gain = mapping.gain_percent
    alone = mapping.score_prior
    best_alone = (
        (
            f"The plan alone scores best, F2 {alone.f_beta:.3f}: the building stands as it was drawn, and every look takes the "
            "prior off again (the term - n l_0 of eq. 4.11; notebook 04 shows why). A plan that is wrong would turn this round.",
        )
        if alone is not None and alone.f_beta > mapping.score_informed.f_beta
        else ()
    )
    said = "" if gain is None else f" With the plan F2 is {gain:+.0f} % against the map without it."
    return Section(
        "Posterior map: with and without the plan",
        (f"The same evidence updates two maps: one started from the plan, one from 0.5 everywhere.{said}", *best_alone, differ),
        tuple(pictures),
        (
            score_table(
                {
                    "the plan alone, no reading": mapping.score_prior,
                    "readings alone, no plan": mapping.score_uninformed,
                    "plan and readings": mapping.score_informed,
                },
                "Detected as wall: P(empty) <= 0.2",
            ),
        ),
    )
