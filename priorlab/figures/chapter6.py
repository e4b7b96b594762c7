"""Figures 6.6 and 6.8: FastSLAM on a whole floor, and when the exploration stays incomplete."""

from __future__ import annotations

from functools import partial

import numpy as np

from priorlab import plot
from priorlab.buildings.floor_plans import load_floor_plan
from priorlab.core.drawing import Walls
from priorlab.core.score import Score
from priorlab.figures.case import extracted
from priorlab.figures.figure import Entry, Outcome, sheet
from priorlab.pipeline import drive_with_prior

BUILDING = "office_floor"
GAIN = 50.0
"""Percent, as the thesis has it for the complete exploration."""


def _drive(share: float, rng: np.random.Generator) -> Outcome:
    """One drive: the extracted walls, the map with the plan and without, the error."""
    plan = load_floor_plan(BUILDING, tour_share=share)
    walls = Walls(extracted(BUILDING).walls.labels, plan.metres_per_pixel)
    rng_world, rng_filter = rng.spawn(2)
    drive = drive_with_prior(walls, plan.world, plan.tour, plan.truth, rng_world, rng_filter)
    run, gain = drive.run, drive.gain_percent
    figure, axes = sheet(3, 1, 9.0, 4.0)
    plot.map(run.prior_map, axes[0], truth=drive.log.truth, title="A  the plan as prior, and the way")
    plot.map(drive.uninformed, axes[1], metric=True, title="B  without the plan, same poses and scans")
    plot.map(run.map, axes[2], trajectory=run.trajectory, title="C  with the plan")
    scores = {"prior_alone": drive.score_prior, "with_plan": drive.score_informed, "without_plan": drive.score_uninformed}
    numbers = {
        "tour_share": share,
        "steps": len(run),
        "ate_m": run.ate_m(),
        "lost_because": run.lost_because,
        "gain_percent": gain,
        **{name: _row(score) for name, score in scores.items() if score is not None},
    }
    fails = run.lost or gain is None or gain <= GAIN
    words = f"LOST ({run.lost_because}), so the gain means nothing" if run.lost else f"gain {gain or 0:+.0f} %"
    f2 = {name: score.f_beta if score else float("nan") for name, score in scores.items()}
    return Outcome(
        figure,
        numbers,
        "differs" if fails else "agrees",
        f"F2 {f2['with_plan']:.2f} with the plan, {f2['without_plan']:.2f} without, {f2['prior_alone']:.2f} the plan alone "
        f"(at P(empty) < "
        f"0.5); ATE {run.ate_m():.2f} m; {words}",
        "Three maps of one floor: the prior with the way of the robot, the map without the plan, the map with it.",
    )


def _row(score: Score) -> dict[str, float]:
    """Three measures."""
    return {"precision": score.precision, "recall": score.recall, "f2": score.f_beta}


FIGURE_6_6 = Entry("fig-6-6", "FastSLAM on a whole floor", "With the plan as prior F2 is over 50 % higher.", partial(_drive, 1.0))
FIGURE_6_8 = Entry(
    "fig-6-8",
    "FastSLAM when the exploration stays incomplete",
    "Without the plan the map says little about the building; with it F2 is far higher.",
    partial(_drive, 0.4),
)
