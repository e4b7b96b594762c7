"""A figure of our own: a floor mapped without any plan from worn wheels, with the scan matcher and without it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import cache

import numpy as np

from priorlab import plot
from priorlab.buildings.floor_plans import load_floor_plan
from priorlab.core.grid_map import GridMap
from priorlab.core.sensor import Scanner
from priorlab.figures.figure import Entry, Outcome, sheet, verdict_of
from priorlab.robot.drive import drive
from priorlab.slam.scan_matching import MATCHING
from priorlab.slam.trajectory_error import dead_reckoning, position_errors_m, true_poses
from priorlab.study.confidence import Confidence
from priorlab.study.matched_logs import MatchedLog, match_log
from priorlab.study.real_logs import into_map_frame, map_from_truth

BUILDING = "office_floor"
SEEDS = (0, 1, 2, 3, 4)
LASER = Scanner(n_beams=181, field_of_view=math.pi, min_range_m=0.1, max_range_m=12.0, range_noise_m=0.02)
"""A laser as robots of these sizes carry it: half a circle, 12 m, two centimetres."""

ROUND_M = 6.0
"""Of the maps is shown what lies so near to the way."""

FACTOR = 3.0
"""By so much the matcher has to make the error smaller, on every seed."""


@cache
def floors_of(building: str, seeds: tuple[int, ...], tour_share: float = 1.0) -> tuple[MatchedLog, ...]:
    """The furnished building, driven and mapped once for each seed."""
    plan = load_floor_plan(building, tour_share=tour_share)
    logs = [drive(plan.world, plan.tour, LASER, rng=np.random.default_rng((seed, 1))) for seed in seeds]
    return tuple(match_log(log, seed) for log, seed in zip(logs, seeds, strict=True))


def _errors(ways: Sequence[np.ndarray], rows: Sequence[MatchedLog]) -> np.ndarray:
    """(T, 3) mean, lowest and highest distance to the true position over the runs, for as many scans as all have."""
    errors = [position_errors_m(way, true_poses(row.worn)) for way, row in zip(ways, rows, strict=True)]
    shared = np.array([error[: min(map(len, errors))] for error in errors])
    return np.stack([shared.mean(axis=0), shared.min(axis=0), shared.max(axis=0)], axis=1)


def wheels_alone(row: MatchedLog) -> tuple[GridMap, np.ndarray]:
    """The map that the scans make from where the wheels say that the robot is; and that way."""
    believed = dead_reckoning(row.worn)
    log, grid = into_map_frame(replace(row.worn, truth=believed), MATCHING.max_range_m)
    assert log.truth is not None
    return map_from_truth(log, grid, MATCHING), log.truth


def _matching(rng: np.random.Generator) -> Outcome:
    """Five seeds of wheels and scanner."""
    return matching_outcome(floors_of(BUILDING, SEEDS))


def matching_outcome(rows: Sequence[MatchedLog]) -> Outcome:
    """The figure of some runs; the maps are those of the first."""
    wheels, matched = Confidence.of(row.wheels_m for row in rows), Confidence.of(row.drive.ate_m() for row in rows)
    factors = [row.wheels_m / row.drive.ate_m() for row in rows]
    headings = Confidence.of(row.drive.heading_error_deg() for row in rows)
    first = rows[0].drive
    figure, axes = sheet(3, 1, 9.0, 3.6)
    believed_map, believed = wheels_alone(rows[0])
    plot.map(believed_map, axes[0], trajectory=believed, title="")
    plot.map(first.map, axes[1], trajectory=first.trajectory, truth=first.log.truth, title="")
    for ax, way in ((axes[0], believed), (axes[1], first.trajectory)):
        ax.set_xlim(way[:, 0].min() - ROUND_M, way[:, 0].max() + ROUND_M)
        ax.set_ylim(way[:, 1].min() - ROUND_M, way[:, 1].max() + ROUND_M)
    curves = {"wheels alone": _errors([dead_reckoning(row.worn) for row in rows], rows)}
    curves["matched"] = _errors([row.drive.trajectory + [*row.drive.low, 0.0] for row in rows], rows)
    steps = np.arange(len(curves["matched"])) + 1
    plot.interval_lines(steps, curves, axes[2], "", f"scan (mean, lowest and highest of {len(rows)} seeds)", "error, m")
    axes[2].set_yscale("log")
    axes[2].set_ylim(0.005, None)
    for ax, title in zip(
        axes,
        (
            f"A  by the wheels alone: ATE {rows[0].wheels_m:.2f} m",
            f"B  matched: ATE {first.ate_m():.2f} m",
            "C  distance to the true position",
        ),
        strict=True,
    ):
        ax.set_title(title, loc="left")
    numbers = {
        "building": BUILDING,
        "scans": [len(row.drive) for row in rows],
        "ate_m_wheels": wheels.as_numbers(),
        "ate_m_matched": matched.as_numbers(),
        "heading_deg_matched": headings.as_numbers(),
        "factor": factors,
        "trusted_share": [float(row.drive.trusted.mean()) for row in rows],
    }
    return Outcome(
        figure,
        numbers,
        verdict_of([factor >= FACTOR for factor in factors]),
        f"{len(rows)} seeds, no plan: ATE {wheels.told()} m by worn wheels alone, {matched.told()} m with every scan matched to "
        f"the map so far, {min(factors):.0f} to {max(factors):.0f} times less; heading {headings.told(1)} degrees",
        "Two maps of a floor, bent and blurred by the wheels alone, straight and sharp with matching; the two errors on the way.",
    )


SCAN_MATCHING = Entry(
    "study-scan-matching",
    "a floor mapped without a plan: worn wheels, and a scan matcher (ours)",
    "Matching every scan to the map so far makes the error of worn wheels at least three times smaller.",
    _matching,
)
