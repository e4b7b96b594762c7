"""Chapters 4 and 5 as pictures: a map, what was seen, and what the score makes of it. World frame, y UP.

Maps of chapters 4 and 5 are drawn in the drawing's pixels, those of chapter 6 - a trajectory is given - in metres.
"""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from numpy.typing import ArrayLike

from priorlab.core.building import Truth
from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap
from priorlab.core.log_odds import DETECTED_WALL
from priorlab.core.readings import Evidence, Readings
from priorlab.plot.extraction import LEGEND, scored_image
from priorlab.plot.style import BLUE, GREEN, GREY, RED, ax_for_image, finish


def map(
    grid_map: GridMap,
    ax: Axes | None = None,
    trajectory: ArrayLike | None = None,
    poses: ArrayLike | None = None,
    title: str | None = None,
    truth: ArrayLike | None = None,
    metric: bool = False,
) -> Axes:
    """A map: black = wall, white = empty, grey = not known.

    Parameters
    ----------
    grid_map : any map
    trajectory : (T, 2 or more) x, y, ... in METRES; then the axes are in metres
    poses : (N, 2 or more) x, y, ... of a survey, in the drawing's PIXELS
    truth : (T, 2 or more) the true way, metres, drawn dashed under the trajectory
    metric : metres even without a way
    """
    grid = grid_map.grid
    metric = metric or trajectory is not None or truth is not None
    ax = ax_for_image(ax, grid.image_shape)
    ax.imshow(grid_map.p_empty, extent=_extent(grid, metric), **GREY)
    if poses is not None:
        xy = np.asarray(poses, dtype=np.float64)[:, :2] * (grid.scale if metric else 1.0)
        ax.plot(xy[:, 0], xy[:, 1], ".", color=BLUE, ms=3, label="survey poses")
    if truth is not None:
        x, y = np.asarray(truth, dtype=np.float64)[:, :2].T
        ax.plot(x, y, "--", color=GREEN, lw=2.2, label="true way")
    if trajectory is not None:
        x, y = np.asarray(trajectory, dtype=np.float64)[:, :2].T
        ax.plot(x, y, "-", color=RED, lw=1.2, label="estimated way")
        ax.plot(x[0], y[0], "o", color=RED, ms=6, label="start")
    if trajectory is not None or truth is not None:
        ax.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=3, fontsize=8, frameon=False)
    return _in_world(ax, grid, metric, title)


def looks(evidence: Evidence, ax: Axes | None = None, title: str | None = None) -> Axes:
    """How often every cell was seen; white = never."""
    ax = ax_for_image(ax, evidence.grid.image_shape)
    n = np.where(evidence.seen, evidence.looks.astype(np.float64), np.nan)
    top = float(np.nanpercentile(n, 99)) if evidence.seen.any() else 1.0
    image = ax.imshow(
        n, extent=_extent(evidence.grid, False), cmap="cividis_r", vmin=0.5, vmax=max(top, 2.0), interpolation="nearest"
    )
    ax.figure.colorbar(image, ax=ax, shrink=0.8, label="looks at a cell")
    words = f"{100 * evidence.seen.mean():.0f} % of the cells seen, {evidence.mean_looks:.2f} looks each"
    return _in_world(ax, evidence.grid, False, words if title is None else title)


def readings(taken: Readings, on: GridMap, ax: Axes | None = None, every: int = 1, title: str | None = None) -> Axes:
    """Rays of every `every`-th pose on a map: thin lines, with a dot where one met an obstacle, none where nothing is known."""
    ax = map(on, ax, title="" if title is None else title)
    some = taken[::every]
    angles = some.poses[:, 2, None] + some.bearings
    hit = some.met
    known = np.ones(hit.shape, dtype=bool) if some.valid is None else some.valid
    length = np.where(hit, some.ranges, some.sensor.max_range)
    start = np.broadcast_to(some.poses[:, None, :2], (*length.shape, 2))
    end = start + length[..., None] * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    rays = np.stack([start, end], axis=-2)[:, ::4][known[:, ::4]]
    ax.add_collection(LineCollection(list(rays), colors=BLUE, linewidths=0.3, alpha=0.5))
    ax.plot(end[hit][:, 0], end[hit][:, 1], ".", color=RED, ms=1.5)
    ax.plot(some.poses[:, 0], some.poses[:, 1], "o", color=BLUE, ms=2.5)
    return ax


def scored(
    grid_map: GridMap, truth: Truth, threshold: float = DETECTED_WALL, ax: Axes | None = None, title: str | None = None
) -> Axes:
    """Every pixel by what the score makes of it at a threshold."""
    grid = grid_map.grid
    ax = ax_for_image(ax, grid.image_shape)
    height, width = grid.image_shape
    ax.imshow(
        scored_image(grid.to_image(grid_map.detected(threshold)), truth),
        extent=(0, width, 0, height),
        interpolation="antialiased",
    )
    return _in_world(ax, grid, False, f"at P(empty) <= {threshold:g}; {LEGEND}" if title is None else title)


def _extent(grid: Grid, metric: bool) -> tuple[float, float, float, float]:
    """Left, right, bottom and top of the cells; those at the upper and right rim stick out of the drawing."""
    side = grid.cell_size_m if metric else grid.cell_size
    rows, cols = grid.shape
    return 0.0, cols * side, 0.0, rows * side


def _in_world(ax: Axes, grid: Grid, metric: bool, title: str | None) -> Axes:
    """Axes that end with the drawing."""
    height, width = grid.image_shape
    scale, unit = (grid.scale, "m") if metric else (1.0, "pixels")
    ax.set(xlim=(0, width * scale), ylim=(0, height * scale), aspect="equal")
    ax.locator_params(nbins=6)
    return finish(ax, title, f"x, {unit}", f"y, {unit}")
