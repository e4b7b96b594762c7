"""Figures 6.3, 6.4, 6.5 and 6.7: the floor's plan, the start, and the ways that were estimated on it."""

from __future__ import annotations

from functools import partial

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from priorlab.core.building import FloorPlan
from priorlab.core.grid_map import GridMap
from priorlab.core.score import score_walls
from priorlab.figures.figure import Entry, Outcome, sheet, verdict_of
from priorlab.figures.floor_case import (
    COMPLETE,
    UNFINISHED,
    ate_of,
    hits_of,
    n_lost,
    runs_of,
    summary_of,
    window_of,
)
from priorlab.plot.floor import floor_map, way_and_hits
from priorlab.plot.style import BLUE, RED, finish
from priorlab.robot.rays import cast_rays
from priorlab.slam.trajectory_error import position_errors_m, true_poses
from priorlab.study.added import changes_between
from priorlab.study.confidence import Confidence
from priorlab.study.office_floor import (
    CELL_M,
    FLOOR_PRIOR,
    SEEDS,
    FloorCondition,
    drive_floor,
    furnished,
    plan_as_prior,
)
from priorlab.study.qualities import extracted

NEARLY_PERFECT = 0.98
"""Precision and recall of walls that were extracted nearly perfectly: as the thesis's table 3.1 has its best ones."""

ATE_LIMIT_M = 0.3

REACH_M = 45.0


def _start(rng: np.random.Generator) -> Outcome:
    """Figure 6.3: where the robot is put down, and what a tape would measure there, on the plan and in the building."""
    figure, axes = sheet(1, 1, 12.0, 4.2)
    floors = [drive_floor(COMPLETE.clutter, COMPLETE.odometry, UNFINISHED.tour_share, seed) for seed in SEEDS]
    floor, log = floors[0]
    _drawing(floor, axes[0])
    x, y, theta = log.start
    axes[0].plot(x, y, "o", color=BLUE, ms=9, label=f"start: x {x:.2f} m, y {y:.2f} m")
    axes[0].annotate(
        "", (x + 1.8 * np.cos(theta), y + 1.8 * np.sin(theta)), (x, y), arrowprops={"arrowstyle": "->", "color": RED, "lw": 2.4}
    )
    axes[0].plot([], [], "-", color=RED, lw=2.4, label=f"heading {np.degrees(theta):.0f} degrees")
    axes[0].legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2, fontsize=8, frameon=False)
    told = {"building": floor.truth.obstacles, "extracted plan": extracted(floor.name).walls.mask}
    taped = {name: _tape(walls, log.start, floor.metres_per_pixel) for name, walls in told.items()}
    off = float(np.abs(taped["building"] - taped["extracted plan"]).max())
    free = [bool(_is_free(plan_as_prior("extracted", FLOOR_PRIOR), one.start)) for _, one in floors]
    holds = {"start is free on the plan": all(free), "plan and building measure alike": off <= CELL_M}
    return Outcome(
        figure,
        {
            "start": {"x_m": float(x), "y_m": float(y), "theta_deg": float(np.degrees(theta))},
            "to_the_walls_m": {name: distances.round(4).tolist() for name, distances in taped.items()},
            "holds": holds,
        },
        verdict_of(list(holds.values())),
        f"the walls to the left and right of the start are {taped['building'][0]:.2f} and {taped['building'][1]:.2f} m away in "
        f"the building; on the extracted plan the tape reads the same to {100 * off:.0f} cm, a cell being {100 * CELL_M:.0f} cm",
        "The floor's plan with the place where the robot starts as a dot and its heading as an arrow.",
    )


def _is_free(plan: GridMap, pose: NDArray[np.float64]) -> bool:
    """No wall of a map where a pose stands."""
    row, col = plan.grid.xy_to_cell(plan.grid.metres_to_xy(pose[:2]))
    return not plan.detected(0.5)[row, col]


def _tape(walls: NDArray[np.bool_], start: NDArray[np.float64], scale: float) -> NDArray[np.float64]:
    """(2,) distance to the walls left and right of a pose, metres."""
    angles = start[2] + np.array([np.pi / 2, -np.pi / 2])
    return cast_rays(walls, np.tile(start[:2] / scale, (2, 1)), angles, REACH_M / scale) * scale


def _plan(rng: np.random.Generator) -> Outcome:
    """Figure 6.4: the plan, what was extracted of it, and what the building is like."""
    floor, found = furnished(COMPLETE.clutter, 1.0, SEEDS[0]), extracted("office_floor").walls
    figure, axes = sheet(3, 1, 11.0, 3.3)
    _drawing(floor, axes[0], "A  plan of the building")
    plan = plan_as_prior("extracted", FLOOR_PRIOR)
    floor_map(plan, window_of(floor.truth), axes[1], "B  extracted walls and empty space")
    _drawing(floor, axes[2], "C  the building of seed 0, where it is not as the plan")
    changes = changes_between(floor.truth, floor.world, plan.grid)
    for cells, colour, label in (
        (changes.blocked, RED, "furniture, half-open doors: the plan shows space"),
        (changes.opened, BLUE, "doorways: the plan shows a wall"),
    ):
        rows, cols = np.nonzero(cells)
        xy = plan.grid.xy_to_metres(plan.grid.cell_to_xy(np.column_stack([rows, cols])))
        axes[2].plot(xy[:, 0], xy[:, 1], "s" if colour == BLUE else ".", color=colour, ms=1.6, label=label)
    axes[2].legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2, fontsize=8, frameon=False, markerscale=5)
    score = score_walls(found, floor.truth)
    walled_up = sum(bool(plan.detected(0.5)[doorway].mean() > 0.5) for doorway in changes.doorways)
    holds = {
        "precision nearly perfect": score.precision >= NEARLY_PERFECT,
        "recall nearly perfect": score.recall >= NEARLY_PERFECT,
        "some doorways appear as walls": walled_up > 0,
    }
    return Outcome(
        figure,
        {
            "precision": score.precision,
            "recall": score.recall,
            "f2": score.f_beta,
            "doorways_walled_up": walled_up,
            "cells_blocked": int(changes.blocked.sum()),
            "cells_opened": int(changes.opened.sum()),
            "holds": holds,
        },
        verdict_of(list(holds.values())),
        f"walls extracted with precision {score.precision:.3f} and recall {score.recall:.3f}; {walled_up} doorways of the "
        "building are walls in the plan",
        "The plan as drawn, the extracted walls as a map, and the building with what the plan lacks marked.",
    )


def _way(condition: FloorCondition, rng: np.random.Generator) -> Outcome:
    """Figures 6.5 and 6.7: the way as it was estimated, with the ends of the beams; and its error on all seeds."""
    runs = runs_of(condition)
    first = runs[0]
    figure, axes = sheet(2, 1, 11.0, 3.4)
    told = f"seed {first.seed}: {'LOST' if first.run.lost else f'ATE {first.ate_m:.2f} m'}"
    way_and_hits(first.run.prior_map, first.run.trajectory, hits_of(first.run), window_of(first.floor.truth), axes[0], told)
    for i, run in enumerate(runs):
        errors = position_errors_m(run.run.trajectory, true_poses(run.run.log))
        line = ("-", "--", "-.", ":", (0, (5, 1, 1, 1)))[i % 5]
        axes[1].plot(
            np.linspace(0, 100, len(errors)),
            errors,
            ls=line,
            lw=1.3,
            color=_SHADES[i % 5],
            label=f"seed {run.seed}: ATE {run.ate_m:.2f} m",
        )
    axes[1].axhline(ATE_LIMIT_M, color="black", ls=":", lw=1)
    axes[1].text(1, ATE_LIMIT_M, f"ATE to reach: {ATE_LIMIT_M:g} m", va="bottom", fontsize=8)
    axes[1].set(xlim=(0, 100), ylim=(0, None))
    axes[1].legend(fontsize=8, ncols=5, loc="lower center", bbox_to_anchor=(0.5, 1.0), frameon=False)
    finish(axes[1], None, "share of the drive, %", "distance to the truth, m")
    holds = {
        "no robot lost": n_lost(runs) == 0,
        "better than the wheels alone on every seed": all(run.ate_m < run.dead_reckoning_m for run in runs),
    }
    wheels = Confidence.of(run.dead_reckoning_m for run in runs)
    headings = Confidence.of(run.run.heading_error_deg() for run in runs)
    metres = Confidence.of(float(np.hypot(*np.diff(true_poses(run.run.log)[:, :2], axis=0).T).sum()) for run in runs)
    return Outcome(
        figure,
        {**summary_of(runs), "way_m": metres.as_numbers(), "holds": holds},
        verdict_of(list(holds.values())),
        f"{100 * condition.tour_share:.0f} % of the rooms, {metres.mean:.0f} m; ATE {ate_of(runs).told()} m over five seeds, at "
        f"most {max(run.ate_m for run in runs):.2f} m, median heading error {headings.told()} degrees, {n_lost(runs)} lost; the "
        f"wheels alone are {wheels.told()} m off",
        "The way of the robot on the plan with the ends of its beams as crosses; and its distance to the truth over the drive.",
    )


_SHADES = ("#0072b2", "#e69f00", "#009e73", "#d55e00", "#cc79a7")


def _drawing(floor: FloorPlan, ax: Axes, title: str | None = None) -> None:
    """The plan as drawn, in metres."""
    (height, width), scale = floor.drawing.shape, floor.metres_per_pixel
    ax.imshow(
        floor.drawing.grey,
        cmap="gray",
        vmin=0,
        vmax=255,
        extent=(0, width * scale, 0, height * scale),
        interpolation="antialiased",
    )
    left, right, bottom, top = window_of(floor.truth)
    ax.set(xlim=(left, right), ylim=(bottom, top))
    finish(ax, None, "x, m", "y, m")
    if title is not None:
        ax.set_title(title, loc="left")


FIGURE_6_3 = Entry(
    "fig-6-3",
    "where the robot starts",
    "With the drawing's scale a start that was measured with a tape becomes a pose on the map.",
    _start,
)
FIGURE_6_4 = Entry(
    "fig-6-4",
    "the plan of the floor and its walls",
    "The walls are extracted nearly perfectly; some doors appear as walls.",
    _plan,
)
FIGURE_6_5 = Entry(
    "fig-6-5",
    "the way of the complete exploration",
    "The robot localizes with the plan all the way through a cluttered floor.",
    partial(_way, COMPLETE),
)
FIGURE_6_7 = Entry(
    "fig-6-7",
    "the way of an incomplete exploration",
    "The robot localizes with the plan all the way through the part that it explores.",
    partial(_way, UNFINISHED),
)
