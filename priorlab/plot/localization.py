"""Chapter 6 as pictures: particles, ways and their error. Metres, y UP."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import ArrayLike

from priorlab.core.grid_map import GridMap
from priorlab.plot.maps import map as draw_map
from priorlab.plot.style import BLUE, GREEN, ORANGE, RED, finish, given_or_new


def trajectory(
    estimated: ArrayLike, truth: ArrayLike | None = None, odometry: ArrayLike | None = None, ax: Axes | None = None
) -> Axes:
    """Ways x, y in metres: estimated (solid), true (dashed), by the wheels alone (dotted)."""
    ax = given_or_new(ax)
    ways = ((odometry, ":", ORANGE, "wheels alone"), (truth, "--", GREEN, "true way"), (estimated, "-", RED, "estimated way"))
    for way, line, colour, label in ways:
        if way is not None:
            x, y = np.asarray(way, dtype=np.float64)[:, :2].T
            ax.plot(x, y, line, color=colour, lw=1.6, label=label)
    x, y = np.asarray(estimated, dtype=np.float64)[0, :2]
    ax.plot(x, y, "o", color=RED, ms=6, label="start")
    ax.set_aspect("equal")
    ax.legend(fontsize=8)
    return finish(ax, None, "x, m", "y, m")


def particles(poses: ArrayLike, grid_map: GridMap, ax: Axes | None = None, truth: ArrayLike | None = None) -> Axes:
    """Particles (S, 3) as short arrows on a map, and the true pose (3,) as a cross."""
    poses = np.asarray(poses, dtype=np.float64)
    ax = draw_map(grid_map, ax, metric=True)
    x, y, theta = poses.T
    ax.quiver(x, y, np.cos(theta), np.sin(theta), color=BLUE, scale=40, width=0.003, label=f"{len(poses)} particles")
    if truth is not None:
        ax.plot(*np.asarray(truth)[:2], "x", color=RED, ms=10, mew=2, label="true pose")
    ax.legend(fontsize=8)
    return ax


def trajectory_error(errors_m: ArrayLike, ax: Axes | None = None, title: str | None = None) -> Axes:
    """Distance to the true position at every step, metres; its root mean square is the ATE."""
    ax = given_or_new(ax, 6.0, 3.0)
    errors = np.asarray(errors_m, dtype=np.float64)
    ate = float(np.sqrt((errors**2).mean()))
    ax.plot(errors, color=BLUE, lw=1.4, label="distance to the true position")
    ax.axhline(ate, color=RED, ls="--", lw=1.4, label=f"ATE {ate:.2f} m")
    ax.set(xlim=(0, len(errors) - 1), ylim=(0, None))
    ax.legend(fontsize=8)
    return finish(ax, title, "step", "error, m")


def particle_numbers(
    n_particles: ArrayLike, ess: ArrayLike | None = None, ax: Axes | None = None, title: str | None = None
) -> Axes:
    """How many particles KLD sampling asked for at every step, and their effective number."""
    ax = given_or_new(ax, 6.0, 3.0)
    ax.plot(np.asarray(n_particles), color=BLUE, lw=1.4, label="particles")
    if ess is not None:
        ax.plot(np.asarray(ess), "--", color=RED, lw=1.2, label="effective number")
    ax.set_ylim(0, None)
    ax.legend(fontsize=8)
    return finish(ax, title, "step", "particles")
