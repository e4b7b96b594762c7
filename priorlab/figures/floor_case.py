"""The simulated floor for all figures of chapter 6: runs of every seed, made once, and what they say together."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from priorlab.core.building import Truth
from priorlab.core.pose import compose
from priorlab.plot.floor import Window, thinned_hits
from priorlab.slam.recording import Run
from priorlab.slam.scan import choose_beams
from priorlab.study.confidence import Confidence
from priorlab.study.office_floor import INCOMPLETE, MAPS, FloorCondition, FloorRun, run_seeds

COMPLETE = FloorCondition()
"""Clutter 0.3, odometry 0.002, all rooms, the extracted walls, `TUNED`."""

UNFINISHED = FloorCondition(tour_share=INCOMPLETE)

AT = "P(empty) < 0.5, walls 0.10 m thick"
"""Threshold and thickening, which every figure of chapter 6 states."""

NUMBERS = ("ate_m", "rpe_m", "rpe_deg", "heading_error_deg", "dead_reckoning_m", "mean_particles", "coverage")


@lru_cache(maxsize=3)
def runs_of(condition: FloorCondition) -> tuple[FloorRun, ...]:
    """A run for each of the five seeds; figures that follow one another share them."""
    return tuple(run_seeds(condition))


def summary_of(runs: Sequence[FloorRun]) -> dict[str, Any]:
    """Mean, 95 % interval and each seed's value of everything; the gain only of runs that were not lost, None of one or none."""
    rows = [run.as_numbers() for run in runs]
    gains = [run.gain_percent for run in runs if run.gain_percent is not None]
    return {
        "seeds": [run.seed for run in runs],
        "lost": [run.run.lost_because for run in runs],
        **{name: Confidence.of(row[name] for row in rows).as_numbers() for name in NUMBERS},
        "f2": {name: f2_of(runs, name).as_numbers() for name in MAPS},
        "gain_percent": Confidence.of(gains).as_numbers() if len(gains) > 1 else None,
    }


def f2_of(runs: Iterable[FloorRun], name: str) -> Confidence:
    """F2 of one of the maps over the seeds."""
    return Confidence.of(run.scores[name].f_beta for run in runs)


def gain_of(runs: Sequence[FloorRun]) -> Confidence | None:
    """Gain over the seeds, or None when a robot was lost: then a gain means nothing."""
    gains = [run.gain_percent for run in runs if run.gain_percent is not None]
    return Confidence.of(gains) if len(gains) == len(runs) else None


def ate_of(runs: Iterable[FloorRun]) -> Confidence:
    """ATE over the seeds, metres."""
    return Confidence.of(run.ate_m for run in runs)


def n_lost(runs: Iterable[FloorRun]) -> int:
    """How many of the robots got lost."""
    return sum(run.run.lost for run in runs)


def gain_told(runs: Sequence[FloorRun]) -> str:
    """The gain in words, or that it has none."""
    gain = gain_of(runs)
    if gain is None:
        return f"no gain to tell: {n_lost(runs)} of {len(runs)} robots got lost"
    return f"gain {gain.mean:+.0f} % ({gain.low:+.0f} to {gain.high:+.0f})"


def window_of(truth: Truth, margin_m: float = 0.6) -> Window:
    """The building without the margins of its sheet, metres."""
    scale = truth.metres_per_pixel or 1.0
    rows, cols = np.flatnonzero(truth.walls.any(axis=1)), np.flatnonzero(truth.walls.any(axis=0))
    bottom, top = (truth.shape[0] - rows[-1] - 1) * scale, (truth.shape[0] - rows[0]) * scale
    return cols[0] * scale - margin_m, (cols[-1] + 1) * scale + margin_m, bottom - margin_m, top + margin_m


def hits_of(run: Run) -> NDArray[np.float64]:
    """(H, 2) where the beams ended, seen from the estimates, metres; one in every square of 10 cm."""
    ends = []
    for k, pose in enumerate(run.trajectory):
        points = choose_beams(run.log, k, run.parameters).points
        ends.append(compose(pose, np.column_stack([points, np.zeros(len(points))]))[:, :2])
    return thinned_hits(np.concatenate(ends))


def curves_of(runs: Sequence[FloorRun], n_points: int = 60) -> tuple[NDArray[np.float64], dict[str, NDArray[np.float64]]]:
    """F2 over the share of the drive: (K,) percent, and by name (K, 3) mean and 95 % interval; drives differ in length."""
    percent = np.linspace(0, 100, n_points)
    over_time = [run.f2_over_time() for run in runs]
    curves = {}
    for name in over_time[0].names:
        rows = np.array([np.interp(percent, 100 * one.steps / one.steps[-1], one.f_beta[name]) for one in over_time])
        curves[name] = np.array([Confidence.of(column).row for column in rows.T])
    return percent, curves
