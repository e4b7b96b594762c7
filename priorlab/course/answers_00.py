"""The exercises of notebook 00, start here. The last one is judged by running the path of the notebook itself."""

from __future__ import annotations

import warnings
from functools import cache
from typing import Any

import numpy as np

from priorlab.core.building import Truth
from priorlab.core.drawing import Walls
from priorlab.core.grid_map import Prior
from priorlab.core.readings import Evidence
from priorlab.core.score import score_map
from priorlab.core.sensor import RangeSensor
from priorlab.course.exercise import Exercise, Mistake, as_numbers

PLAN, CELL_SIZE, MAX_RANGE = "office_wing", 3, 40


def exercises(seed: int = 0) -> dict[str, Exercise]:
    """The exercises of notebook 00 with one learner's numbers."""
    rng = np.random.default_rng([0, seed])
    return {
        "00.occupancy": _occupancy(rng, seed),
        "00.darkest": _darkest(rng),
        "00.f2": _f2(rng),
        "00.worse": _worse(),
    }


def _occupancy(rng: np.random.Generator, seed: int) -> Exercise:
    """The convention."""
    occupancy = 0.3 if seed == 0 else float(rng.choice([0.1, 0.2, 0.35, 0.65, 0.8]))
    return Exercise(
        asks=f"A ROS map says that a cell has occupancy {occupancy:g}. What is its P(empty)?",
        answer=lambda: 1 - occupancy,
        because="P(empty) = 1 - occupancy; only the border to other software converts.",
        mistakes=(
            Mistake(
                lambda: occupancy,
                "that is the field's occupancy itself; here every probability is P(empty) (convention flipped).",
            ),
            Mistake(lambda: 100 * (1 - occupancy), "that is in per cent; a probability lies between 0 and 1."),
        ),
        hints=("occupied or empty: the two probabilities sum to 1.",),
    )


def _darkest(rng: np.random.Generator) -> Exercise:
    """Rows, columns and what dark means."""
    p, picks = _shuffled(rng)
    while len(set(picks)) < len(picks):  # every mistake must show
        p, picks = _shuffled(rng)
    darkest, swapped, lightest, from_below, from_one = picks
    lines = "\n".join("  " + "  ".join(f"{value:.2f}" for value in line) for line in p)
    return Exercise(
        asks=f"A map's P(empty):\n{lines}\nWhich cell is most surely a wall? Answer (row, col), counted from 0.",
        answer=lambda: darkest,
        because="lowest P(empty), row 0 at the top, row before column.",
        mistakes=(
            Mistake(lambda: swapped, "row and column swapped: arrays are [row, col], the row first."),
            Mistake(lambda: lightest, "that is the EMPTIEST cell (convention flipped): a wall is low, dark."),
            Mistake(
                lambda: from_below, "you counted rows from below: arrays have row 0 at the top; only x, y in the world go up."
            ),
            Mistake(lambda: from_one, "counted from 1; Python counts from 0."),
        ),
        hints=("wall = low, space = high.",),
    )


def _shuffled(rng: np.random.Generator) -> tuple[np.ndarray, tuple[tuple[int, int], ...]]:
    """A small map and five cells: the darkest, row and column swapped, the lightest, counted from below, counted from 1."""
    p = rng.permutation(np.linspace(0.05, 0.95, 15)).reshape(3, 5)
    row, col = (int(i) for i in np.unravel_index(p.argmin(), p.shape))
    high_row, high_col = (int(i) for i in np.unravel_index(p.argmax(), p.shape))
    return p, ((row, col), (col, row), (high_row, high_col), (len(p) - 1 - row, col), (row + 1, col + 1))


def _f2(rng: np.random.Generator) -> Exercise:
    """Precision, recall and F2 by hand."""
    tp, fp, fn = (int(10 * rng.integers(*ends)) for ends in ((60, 80), (10, 20), (25, 45)))
    precision, recall = tp / (tp + fp), tp / (tp + fn)

    def f_beta(pre: float, rec: float, weight: float) -> float:
        """eq. 5.1, the weight already squared."""
        return (1 + weight) * pre * rec / (weight * pre + rec)

    return Exercise(
        asks=f"{tp} wall pixels were found, {fn} missed; {fp} are called wall and are none. What is F2, to three decimals?",
        answer=lambda: f_beta(precision, recall, 4.0),
        because="beta = 2 weighs recall more: a missed wall is worse for a robot than an invented one.",
        mistakes=(
            Mistake(lambda: f_beta(precision, recall, 1.0), "that is F1; here beta = 2."),
            Mistake(lambda: f_beta(precision, recall, 2.0), "beta enters squared: the weight is 4, not 2."),
            Mistake(lambda: f_beta(recall, precision, 4.0), "precision and recall swapped."),
            Mistake(lambda: precision, "that is precision alone."),
            Mistake(lambda: recall, "that is recall alone."),
        ),
        hints=(
            "precision = TP / (TP + FP): of what the map calls wall, how much is; recall = TP / (TP + FN).",
            "F2 = 5 x precision x recall / (4 x precision + recall), eq. 5.1.",
        ),
        tolerance=1e-3,
    )


def _worse() -> Exercise:
    """A prior that hurts."""
    return Exercise(
        asks="Find a prior (p_wall, p_space) with which the map is WORSE (F2) than with no prior at all.",
        answer=lambda: (0.9, 0.2),
        because="a prior is a claim; a wrong claim is worse than none.",
        hints=("what if the map believes that the plan's walls are empty?", "or that every room is filled: p_space = 0.2."),
        accept=_is_worse,
    )


def _is_worse(answer: Any) -> str | None:
    """None when the prior hurts, otherwise the numbers."""
    values = as_numbers(answer)
    if values is None or values.shape != (2,):
        return "two numbers are asked for, (p_wall, p_space)."
    try:
        prior = Prior(*values.tolist())
    except ValueError as error:
        return f"{error}."
    with_prior, without = _f2_of(prior), _f2_of(Prior.uninformed())
    if with_prior < without:
        return None
    return f"with {tuple(values.tolist())} the map scores F2 {with_prior:.3f}, without a prior {without:.3f}."


def _f2_of(prior: Prior) -> float:
    """F2 of the notebook's map under a prior."""
    from priorlab.mapping.overruled import OverruledSensorWarning
    from priorlab.mapping.prior import build_prior_map
    from priorlab.mapping.update import update_map

    walls, evidence, truth = _first_survey()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", OverruledSensorWarning)  # any prior may be tried here
        return score_map(update_map(build_prior_map(walls, prior, cell_size=CELL_SIZE), evidence), truth).f_beta


@cache
def _first_survey() -> tuple[Walls, Evidence, Truth]:
    """What notebook 00 has in hand after its survey."""
    from priorlab.buildings.floor_plans import load_floor_plan
    from priorlab.drawing.extraction import extract_walls
    from priorlab.mapping.evidence import gather_evidence
    from priorlab.mapping.prior import build_prior_map
    from priorlab.robot.explore import explore

    plan = load_floor_plan(PLAN)
    walls = extract_walls(plan.drawing).walls
    readings = explore(plan.truth, plan.survey, RangeSensor(max_range=MAX_RANGE))
    grid = build_prior_map(walls, Prior.uninformed(), cell_size=CELL_SIZE).grid
    return walls, gather_evidence(readings, grid), plan.truth
