"""Figure 6.9: localizing in the drawing as it is against localizing in the walls extracted from it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, Literal

import numpy as np

from priorlab import plot
from priorlab.figures.figure import Entry, Outcome, sheet, verdict_of
from priorlab.figures.floor_case import COMPLETE, ate_of, hits_of, n_lost, runs_of, summary_of, window_of
from priorlab.plot.floor import floor_map, way_and_hits
from priorlab.slam.trajectory_error import position_errors_m, true_poses
from priorlab.study.confidence import Confidence
from priorlab.study.office_floor import FloorCondition, FloorRun, run_seeds

AS_IS = "drawing as it is"
PLANS = {"extracted walls": "extracted", AS_IS: AS_IS}
PLACES: dict[str, Literal["static", "updated"]] = {"the plan (static)": "static", "the map as it grows": "updated"}


def _as_is(rng: np.random.Generator) -> Outcome:
    """Figure 6.9: A to C, and the errors of all seeds, localized in the plan and in the map that starts from it."""
    runs = {(place, plan): _runs(quality, where) for place, where in PLACES.items() for plan, quality in PLANS.items()}
    ours, theirs = (runs["the plan (static)", plan] for plan in PLANS)
    first, other = ours[0], theirs[0]
    window = window_of(first.floor.truth)
    figure, axes = sheet(3, 2, 7.6, 2.9)
    floor_map(other.run.prior_map, window, axes[0], "A  the drawing as it is, as a map")
    for ax, letter, run, plan in ((axes[1], "B", other, AS_IS), (axes[2], "C", first, "extracted walls")):
        told = "LOST" if run.run.lost else f"ATE {run.ate_m:.2f} m"
        way_and_hits(run.run.prior_map, run.run.trajectory, hits_of(run.run), window, ax, f"{letter}  {plan}, {told}")
    percent = np.linspace(0, 100, 60)
    plot.interval_lines(
        percent,
        {plan: _errors(runs["the plan (static)", plan], percent) for plan in PLANS},
        axes[3],
        None,
        "share of the drive, %",
        "distance to the truth, m",
    )
    axes[3].set_title("D  localized in the plan, five seeds", loc="left")
    axes[3].set(xlim=(0, 100), ylim=(0, None))
    bars = {plan: np.array([ate_of(runs[place, plan]).row for place in PLACES]) for plan in PLANS}
    plot.interval_bars(list(PLACES), bars, axes[4], None, "ATE, m: mean and 95 % interval")
    bars = {plan: np.array([_particles(runs[place, plan]).row for place in PLACES]) for plan in PLANS}
    plot.interval_bars(list(PLACES), bars, axes[5], None, "particles that KLD sampling asks for, mean of a drive")

    worse = {place: _difference(runs[place, AS_IS], runs[place, "extracted walls"]) for place in PLACES}
    late = _late(theirs, ours)
    holds = {
        "localized in the plan: worse as it is": worse["the plan (static)"].low > 0,
        "worse towards the end": late.low > 0,
        "localized in the growing map: worse as it is": worse["the map as it grows"].low > 0,
    }
    numbers: dict[str, Any] = {f"{place}, {plan}": summary_of(some) for (place, plan), some in runs.items()}
    numbers |= {
        "ate_as_is_minus_extracted_m": {place: value.as_numbers() for place, value in worse.items()},
        "last_fifth_as_is_minus_extracted_m": late.as_numbers(),
        "holds": holds,
    }
    return Outcome(
        figure,
        numbers,
        verdict_of(list(holds.values())),
        "five seeds; " + "; ".join(_told(runs, place, worse[place]) for place in PLACES),
        "The drawing as it is, the ways that were estimated in it and in the extracted walls, and their errors over five seeds.",
    )


def _told(runs: Mapping[tuple[str, str], Sequence[FloorRun]], place: str, worse: Confidence) -> str:
    """The errors in both plans."""
    theirs, ours = runs[place, AS_IS], runs[place, "extracted walls"]
    return (
        f"localized in {place}: ATE {ate_of(theirs).told()} m as it is ({n_lost(theirs)} lost) against {ate_of(ours).told()} m "
        f"with extracted walls ({n_lost(ours)} lost), in pairs {worse.mean:+.2f} m ({worse.low:+.2f} to {worse.high:+.2f})"
    )


def _runs(plan: str, where: Literal["static", "updated"]) -> Sequence[FloorRun]:
    """All seeds; those with extracted walls are the runs of other figures."""
    parameters = replace(COMPLETE.parameters, localize_in=where)
    condition: FloorCondition = replace(COMPLETE, plan=plan, parameters=parameters)
    return runs_of(condition) if plan == COMPLETE.plan else run_seeds(condition)


def _errors(runs: Sequence[FloorRun], percent: np.ndarray) -> np.ndarray:
    """(K, 3) distance to the truth over the share of the drive."""
    rows = []
    for run in runs:
        errors = position_errors_m(run.run.trajectory, true_poses(run.run.log))
        rows.append(np.interp(percent, np.linspace(0, 100, len(errors)), errors))
    return np.array([Confidence.of(column).row for column in np.array(rows).T])


def _late(theirs: Sequence[FloorRun], ours: Sequence[FloorRun]) -> Confidence:
    """How much farther from the truth the last fifth of the drive is, in pairs, metres."""
    far = []
    for their, our in zip(theirs, ours, strict=True):
        truth = true_poses(our.run.log)
        last = slice(4 * len(truth) // 5, None)
        far.append(
            float(position_errors_m(their.run.trajectory[last], truth[last]).mean())
            - float(position_errors_m(our.run.trajectory[last], truth[last]).mean())
        )
    return Confidence.of(far)


def _difference(theirs: Sequence[FloorRun], ours: Sequence[FloorRun]) -> Confidence:
    """ATE as it is minus ATE with extracted walls, in pairs, metres."""
    return Confidence.of(their.ate_m - our.ate_m for their, our in zip(theirs, ours, strict=True))


def _particles(runs: Sequence[FloorRun]) -> Confidence:
    """Mean number of particles of a drive."""
    return Confidence.of(float(run.run.n_particles.mean()) for run in runs)


FIGURE_6_9 = Entry(
    "fig-6-9",
    "localizing in the drawing as it is",
    "In the drawing as it is localization is significantly worse than in the extracted walls, above all towards the end.",
    _as_is,
)
