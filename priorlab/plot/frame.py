"""The frame and the thresholds as one picture (docs/conventions.md)."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from priorlab.core.grid import Grid
from priorlab.core.log_odds import DETECTED_WALL, OCCUPIED_IN_FIELD

INK, CELL, POSE = "#222222", "#0072b2", "#d55e00"


def frame(ax: Axes, grid: Grid | None = None, pixel: tuple[int, int] = (1, 5)) -> Axes:
    """Draw a small drawing with its pixels, cells, world axes, one pixel in every unit and one pose.

    Parameters
    ----------
    ax : where to draw
    grid : a small grid with a scale; 6 x 9 pixels in cells of 3 by default
    pixel : the pixel (row, col) that is spelled out
    """
    grid = grid or Grid(image_shape=(6, 9), cell_size=3, metres_per_pixel=0.05)
    height, width = grid.image_shape
    wall = np.zeros(grid.image_shape)
    wall[0, :] = wall[:, 0] = 1
    ax.imshow(np.where(wall, 0.35, 1.0), cmap="gray", vmin=0, vmax=1, extent=(0, width, 0, height))
    for side, colour, weight in ((1.0, "0.75", 0.6), (float(grid.cell_size), CELL, 1.8)):  # pixels, then cells
        ax.vlines(np.arange(0, width + 1e-9, side), 0, height, color=colour, lw=weight)
        ax.hlines(np.arange(0, height + 1e-9, side), 0, width, color=colour, lw=weight)

    x, y = grid.pixel_to_xy(pixel).tolist()
    row, col = grid.xy_to_cell((x, y))
    ax.plot(x, y, "o", color=INK, ms=5, zorder=4)
    ax.annotate(
        f"pixel (row {pixel[0]}, col {pixel[1]})\nx, y = {x:g}, {y:g} px\n= {x * grid.scale:.3f}, {y * grid.scale:.3f} m\n"
        f"cell (row {row}, col {col})\nROS cell (row {grid.shape[0] - 1 - row}, col {col})",
        (x, y),
        xytext=(width + 1.2, height - 0.2),
        va="top",
        fontsize=9,
        arrowprops={"arrowstyle": "-", "color": INK, "lw": 0.8},
    )
    for tip, label, at in (((2.2, 0), "x", (2.2, -0.5)), ((0, 2.2), "y", (-0.45, 2.1))):
        ax.annotate("", tip, (0, 0), arrowprops={"arrowstyle": "-|>", "color": INK, "lw": 2}, zorder=5)
        ax.text(*at, label, ha="center", va="center", fontsize=11, weight="bold", color=INK)
    ax.plot(0, 0, "s", color=INK, ms=6, zorder=5, clip_on=False)
    ax.text(-0.15, -0.75, "origin = lower left corner\n= origin of the ROS map", fontsize=8, va="top")
    theta = np.deg2rad(35)
    at_x, at_y = 5.5, 1.4
    ax.annotate(
        "",
        (at_x + 1.6 * np.cos(theta), at_y + 1.6 * np.sin(theta)),
        (at_x, at_y),
        arrowprops={"arrowstyle": "-|>", "color": POSE, "lw": 2},
    )
    ax.plot([at_x, at_x + 1.6], [at_y, at_y], ":", color=POSE)
    arc = np.linspace(0, theta, 20)
    ax.plot(at_x + np.cos(arc), at_y + np.sin(arc), color=POSE, lw=1.2)
    ax.text(at_x + 1.15, at_y + 0.22, r"$\theta$", color=POSE, fontsize=12)
    ax.text(-0.25, height - 0.5, "row 0", ha="right", va="center", fontsize=8)
    ax.text(-0.25, 0.5, f"row {height - 1}", ha="right", va="center", fontsize=8)
    ax.text(0.5, height + 0.25, "col 0", ha="center", fontsize=8)
    ax.text(width - 0.5, height + 0.25, f"col {width - 1}", ha="center", fontsize=8)
    ax.text(
        width + 1.2,
        1.2,
        f"blue: cells of {grid.cell_size:g} px, counted\nfrom the lower left corner;\narray row 0 at the top",
        fontsize=9,
        color=CELL,
    )
    ax.set(xlim=(-1.6, width + 7.5), ylim=(-1.9, height + 0.9), aspect="equal")
    ax.axis("off")
    return ax


def thresholds(ax: Axes) -> Axes:
    """Draw P(empty) from wall to free with the thresholds that cut it."""
    ax.imshow(np.linspace(0, 1, 256)[None], cmap="gray", vmin=0, vmax=1, extent=(0, 1, 0, 1), aspect="auto")
    marks = [
        (DETECTED_WALL, f"{DETECTED_WALL:g}\ndetected as wall\n(score, ch. 4-5)", 0),
        (OCCUPIED_IN_FIELD, f"{OCCUPIED_IN_FIELD:g}\nobstacle in the\nlikelihood field", 0),
        (0.5, "0.5\nnot known;\nscore of ch. 6", 0),
        (1 - 0.65, "1 - 0.65\nROS: occupied", 1),
        (1 - 0.196, "1 - 0.196\nROS: free", 1),
    ]
    for p_empty, label, above in marks:
        ax.plot([p_empty, p_empty], [0, 1], color=POSE, lw=1.6)
        ax.text(p_empty, 1.12 if above else -0.12, label, ha="center", va="bottom" if above else "top", fontsize=8)
    ax.text(0.0, 1.12, "0 = wall", ha="left", va="bottom", fontsize=9, weight="bold")
    ax.text(1.0, 1.12, "1 = empty", ha="right", va="bottom", fontsize=9, weight="bold")
    ax.set(xlim=(0, 1), ylim=(-1.6, 2.0))
    ax.axis("off")
    return ax
