"""What the robot added to its plan: clutter, opened walls and doorways, for four maps of the same drives."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from priorlab import plot
from priorlab.figures.figure import Entry, Outcome, sheet, verdict_of
from priorlab.figures.floor_case import AT, COMPLETE, ate_of, n_lost, runs_of
from priorlab.plot.floor import Window, floor_map
from priorlab.study.added import Added, changes_between
from priorlab.study.confidence import Confidence
from priorlab.study.office_floor import ALONE, COUNTING, MAPS, WITH, WITHOUT, FloorRun

ROOM_M = 1.6
"""Round a doorway, metres."""


def _added(rng: np.random.Generator) -> Outcome:
    """Bars of what is shown rightly, and a doorway close by."""
    runs = runs_of(COMPLETE)
    parts: dict[str, Callable[[Added, str], float]] = {
        "clutter: furniture, half-open doors": lambda added, name: added.blocked.share[name],
        "opened: cells of walled-up doorways": lambda added, name: added.opened.share[name],
        "doorways that a planner could take": lambda added, name: added.passable[name] / len(added.doorways),
    }
    shares = {part: {name: _over_seeds([of(run.added, name) for run in runs]) for name in MAPS} for part, of in parts.items()}
    figure, axes = sheet(2, 3, 4.6, 3.4)
    first = runs[0]
    changes = changes_between(first.floor.truth, first.floor.world, first.run.map.grid)
    doorway = changes.doorways[int(np.argmax([(mask & first.evidence.seen).sum() for mask in changes.doorways]))]
    window = _around(first, doorway)
    shown = (first.run.prior_map, "the plan alone: a wall"), (first.uninformed, WITHOUT), (first.informed, WITH)
    for ax, (grid_map, title) in zip(axes[:3], shown, strict=True):
        floor_map(grid_map, window, ax, f"a doorway, {title}")
        _outline(first, doorway, ax)
    for ax, (part, by_name) in zip(axes[3:], shares.items(), strict=True):
        bars = {name: np.array([by_name[name].row]) for name in MAPS}
        plot.interval_bars([""], bars, ax, part, "share shown rightly, of the seen")
        ax.set_xlim(0, 1.25)
        ax.set_title(part, pad=40)
    holds = {
        "clutter: the map with the plan shows more than the plan": shares["clutter: furniture, half-open doors"][WITH].low > 0,
        "doorways: small mistakes of the plan are corrected": shares["opened: cells of walled-up doorways"][WITH].low > 0.5,
        "no less than without the plan": all(
            by_name[WITH].mean >= by_name[WITHOUT].mean - 0.02 for by_name in list(shares.values())[:2]
        ),
    }
    seen = {"blocked": _seen(runs, "blocked"), "opened": _seen(runs, "opened")}
    return Outcome(
        figure,
        {
            **{part: {name: value.as_numbers() for name, value in by_name.items()} for part, by_name in shares.items()},
            "cells_seen": {name: value.as_numbers() for name, value in seen.items()},
            "ate_m": ate_of(runs).as_numbers(),
            "lost": n_lost(runs),
            "holds": holds,
        },
        verdict_of(list(holds.values())),
        f"five seeds, {AT}, ATE {ate_of(runs).told()} m, {n_lost(runs)} lost; of what was seen and the plan does not show, the "
        "maps show rightly: "
        + "; ".join(
            f"{part}: {100 * by_name[WITH].mean:.0f} % with the plan, {100 * by_name[WITHOUT].mean:.0f} % without, "
            f"{100 * by_name[COUNTING].mean:.0f} % by counting, {100 * by_name[ALONE].mean:.0f} % the plan alone"
            for part, by_name in shares.items()
        ),
        "A doorway in the plan, where it is a wall, and in two maps; bars of how much of the changes four maps show.",
    )


def _over_seeds(shares: Sequence[float]) -> Confidence:
    """Over the seeds whose robot saw any of it."""
    return Confidence.of(share for share in shares if np.isfinite(share))


def _seen(runs: Sequence[FloorRun], kind: str) -> Confidence:
    """How many cells of a kind of change were seen."""
    return Confidence.of(getattr(run.added, kind).seen for run in runs)


def _around(run: FloorRun, mask: NDArray[np.bool_]) -> Window:
    """A window about some cells, metres."""
    x, y = _centres(run, mask).mean(axis=0)
    return x - ROOM_M, x + ROOM_M, y - 0.7 * ROOM_M, y + 0.7 * ROOM_M


def _centres(run: FloorRun, mask: NDArray[np.bool_]) -> NDArray[np.float64]:
    """(N, 2) middles of cells, metres."""
    grid = run.run.map.grid
    return grid.xy_to_metres(grid.cell_to_xy(np.argwhere(mask)))


def _outline(run: FloorRun, mask: NDArray[np.bool_], ax: Axes) -> None:
    """A dashed frame about some cells."""
    side = run.run.map.grid.cell_size_m / 2
    (left, bottom), (right, top) = _centres(run, mask).min(axis=0) - side, _centres(run, mask).max(axis=0) + side
    ax.plot([left, right, right, left, left], [bottom, bottom, top, top, bottom], "--", color="#d55e00", lw=1.8)


ADDED = Entry(
    "study-added",
    "what the robot added to its plan",
    "The final map is unaffected by small mistakes of the plan, such as doorways that appear as walls: mapping corrects them.",
    _added,
)
