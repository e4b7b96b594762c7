"""A building's floor in metres: maps cut to the building, the way of a robot and what its beams hit (fig. 6.3 to 6.9)."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import ArrayLike

from priorlab.core.grid_map import GridMap
from priorlab.plot.maps import map as draw_map
from priorlab.plot.style import BLUE, RED

Window = tuple[float, float, float, float]
"""Left, right, bottom and top, metres."""


def floor_map(grid_map: GridMap, window: Window | None = None, ax: Axes | None = None, title: str | None = None) -> Axes:
    """A map in metres, cut to a window: black = wall, white = empty, grey = not known."""
    ax = draw_map(grid_map, ax, metric=True)
    if title is not None:
        ax.set_title(title, loc="left")
    return _cut(ax, window)


def way_and_hits(
    grid_map: GridMap,
    way: ArrayLike,
    hits: ArrayLike,
    window: Window | None = None,
    ax: Axes | None = None,
    title: str | None = None,
) -> Axes:
    """The way of a robot and where its beams ended, on a pale map.

    Parameters
    ----------
    grid_map : what lies below
    way : (T, 2 or more) x, y, metres; the start is a dot
    hits : (H, 2) ends of beams, metres
    window : what is shown
    """
    ax = draw_map(grid_map, ax, metric=True)
    ax.images[-1].set_alpha(0.35)
    x, y = np.asarray(hits, dtype=np.float64).reshape(-1, 2).T
    ax.plot(x, y, "x", color=RED, ms=2.2, mew=0.5, label="hits")
    x, y = np.asarray(way, dtype=np.float64)[:, :2].T
    ax.plot(x, y, "-", color=BLUE, lw=1.4, label="way")
    ax.plot(x[0], y[0], "o", color=BLUE, ms=6, label="start")
    ax.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=3, fontsize=8, frameon=False, markerscale=2)
    if title is not None:
        ax.set_title(title, loc="left")
    return _cut(ax, window)


def thinned_hits(hits: ArrayLike, apart_m: float = 0.1) -> np.ndarray:
    """(K, 2) one of the points in every square of a side; a drive hits a wall hundreds of times.

    >>> thinned_hits([[0.01, 0.01], [0.02, 0.09], [0.51, 0.01]]).tolist()
    [[0.01, 0.01], [0.51, 0.01]]
    """
    points = np.asarray(hits, dtype=np.float64).reshape(-1, 2)
    _, first = np.unique(np.floor(points / apart_m).astype(np.int64), axis=0, return_index=True)
    return points[np.sort(first)]


def _cut(ax: Axes, window: Window | None) -> Axes:
    """Axes that show a window only."""
    if window is not None:
        ax.set(xlim=window[:2], ylim=window[2:])
    return ax
