"""What a robot added to its plan, scored apart: the score of a whole map counts it as a mistake, or not at all.

F2 asks for the plan's walls. A map that is nothing but the plan scores best, furniture that a robot found counts against it, and
a doorway that the plan walls up is don't-care. So here are asked only the cells where the building is not as the plan shows it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.core.building import Truth, World
from priorlab.core.checks import as_float
from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap
from priorlab.core.log_odds import TIE
from priorlab.mapping.over_time import OverTime, score_over_time
from priorlab.slam.recording import Run
from priorlab.slam.run_evidence import evidence_of_run

DOORWAY_M = 0.6
"""An opened patch of the plan's walls that is at least this long is a doorway; shorter ones are corners of one."""


class ShowsWalls(Protocol):
    """A `GridMap` or a `CountedMap`."""

    @property
    def p_empty(self) -> NDArray[np.float64]:
        """(rows, cols) P(empty)."""

    def detected(self, threshold: float = ...) -> NDArray[np.bool_]:
        """(rows, cols) True where the map shows a wall."""


@dataclass(frozen=True, eq=False)
class Changes:
    """Cells where the building is not as its plan shows it. Cells that touch don't-care of the drawing are in none.

    Parameters
    ----------
    blocked : (rows, cols) bool, the plan shows space, the world holds something: furniture, leaves of half-open doors
    opened : (rows, cols) bool, the plan shows a wall through and through, the world is free
    doorways : masks of the patches of `opened` that are long enough to be a doorway, from left to right
    grid : the cells
    """

    blocked: NDArray[np.bool_] = field(repr=False)
    opened: NDArray[np.bool_] = field(repr=False)
    doorways: tuple[NDArray[np.bool_], ...] = field(repr=False)
    grid: Grid

    def __repr__(self) -> str:
        return f"Changes({self.blocked.sum()} cells blocked, {self.opened.sum()} opened, {len(self.doorways)} doorways)"


@dataclass(frozen=True)
class Part:
    """One kind of change.

    Parameters
    ----------
    cells : how many there are
    seen : how many of them a scan looked at
    right : by the map's name, how many of the seen ones it shows as they are
    """

    cells: int
    seen: int
    right: dict[str, int]

    @property
    def share(self) -> dict[str, float]:
        """Of the seen cells that each map shows rightly; nan when none was seen."""
        return {name: right / self.seen if self.seen else float("nan") for name, right in self.right.items()}


@dataclass(frozen=True)
class Added:
    """What some maps show of the changes that a robot has seen.

    Parameters
    ----------
    blocked, opened : the two kinds
    doorways : each doorway that the plan walls up
    passable : by the map's name, how many of the doorways it shows free in more than half of their cells, seen or not: a planner
        could go through
    """

    blocked: Part
    opened: Part
    doorways: tuple[Part, ...]
    passable: dict[str, int]

    def __repr__(self) -> str:
        told = ", ".join(
            f"{name}: {100 * self.blocked.share[name]:.0f} % of {self.blocked.seen} blocked, "
            f"{100 * self.opened.share[name]:.0f} % of {self.opened.seen} opened, "
            f"{self.passable[name]} of {len(self.doorways)} doorways"
            for name in self.passable
        )
        return f"Added({told})"


def changes_between(plan: Truth, world: World, grid: Grid) -> Changes:
    """Where the world is not as the plan says.

    Parameters
    ----------
    plan : what the drawing shows; its walls and windows, and its don't-care
    world : the building as it is
    grid : cells over both

    >>> plan = Truth(np.array([[0, 1, 1, 0]], bool), np.zeros((1, 4), bool), metres_per_pixel=1.0)
    >>> world = World(np.array([[1, 1, 0, 0]], bool), metres_per_pixel=1.0)
    >>> changes_between(plan, world, Grid((1, 4), 1, 1.0))
    Changes(1 cells blocked, 1 opened, 1 doorways)
    """
    if not plan.shape == world.obstacles.shape == grid.image_shape:
        raise ValueError(
            f"plan, world and grid must have one shape, got {plan.shape}, {world.obstacles.shape} and {grid.image_shape}"
        )
    solid = world.obstacles
    shown = grid.any_in_cells(plan.obstacles | plan.ignore)
    blocked = grid.any_in_cells(solid & ~(plan.obstacles | plan.ignore)) & ~shown
    opened = ~grid.any_in_cells(~plan.walls) & ~grid.any_in_cells(solid)
    return Changes(blocked, opened, _doorways_in(opened, grid), grid)


def what_was_added(changes: Changes, seen: NDArray[np.bool_], maps: Mapping[str, ShowsWalls], threshold: float = 0.5) -> Added:
    """How much of what changed, and was seen, some maps show as it is.

    A blocked cell is right when the map shows a wall (P(empty) at most `threshold`), an opened one when it shows space as surely
    (P(empty) at least 1 - `threshold`); a cell at 0.5 knows nothing and is neither.

    Parameters
    ----------
    changes : from `changes_between`
    seen : (rows, cols) True where a scan looked, from where the robot took itself to be: `counted_map(run).seen`
    maps : by name; at the end of the run, or the prior alone
    threshold : as in `score_map`
    """
    for name, cells in {"seen": np.asarray(seen), **{name: one.p_empty for name, one in maps.items()}}.items():
        if cells.shape != changes.grid.shape:
            raise ValueError(f"{name} must have the shape of changes, {changes.grid.shape} cells, got {cells.shape}")
    threshold = as_float("threshold", threshold)
    wall = {name: one.detected(threshold) for name, one in maps.items()}
    free = {name: one.p_empty > max(1 - threshold - TIE, 0.5 + TIE) for name, one in maps.items()}
    return Added(
        blocked=_part(changes.blocked, seen, wall),
        opened=_part(changes.opened, seen, free),
        doorways=tuple(_part(doorway, seen, free) for doorway in changes.doorways),
        passable={name: sum(bool(shows[doorway].mean() > 0.5) for doorway in changes.doorways) for name, shows in free.items()},
    )


def f2_over_time(run: Run, prior_maps: Mapping[str, GridMap], truth: Truth, threshold: float = 0.5, every: int = 1) -> OverTime:
    """F2 of the map of several priors after 0, 1, 2, ... steps of a run, all from the same poses and scans (fig. 6.6 E, 6.8 D).

    The curve of the run's own prior is that of `score_map(run.at(k), truth, threshold)`, k + 1 steps done, to the last pixel.

    Parameters
    ----------
    run : poses and scans
    prior_maps : by name, where each map starts; on the run's grid
    truth : walls and don't-care pixels
    threshold : as in `score_map`
    every : report after every so many steps, and after the last

    Returns
    -------
    OverTime; `.steps` and `.f_beta[name]` are the curve, `.seen` the share of the cells that were looked at
    """
    return score_over_time(evidence_of_run(run), prior_maps, truth, run.parameters.lam, threshold, every=every)


def _part(cells: NDArray[np.bool_], seen: NDArray[np.bool_], shows: Mapping[str, NDArray[np.bool_]]) -> Part:
    """Count one kind of change."""
    looked = cells & seen
    return Part(int(cells.sum()), int(looked.sum()), {name: int((right & looked).sum()) for name, right in shows.items()})


def _doorways_in(opened: NDArray[np.bool_], grid: Grid) -> tuple[NDArray[np.bool_], ...]:
    """The connected patches that are long enough, from left to right."""
    n_labels, labels, stats, _ = cv2.connectedComponentsWithStats(opened.astype(np.uint8), connectivity=8)
    long = [i for i in range(1, n_labels) if max(stats[i, 2:4]) * grid.cell_size_m >= DOORWAY_M - 1e-9]
    return tuple(labels == i for i in sorted(long, key=lambda i: (stats[i, 0], stats[i, 1])))
