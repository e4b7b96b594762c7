"""Figures 5.15 to 5.17, 5.19 and 5.20: four places where the plan helps most, zoomed in.

The places are chosen by a rule, not by eye: windows of 60 cm that do not overlap, in order of how many more pixels the plan
gets right on the FIRST survey (3 images a pose, cells of 2 px). The zooms then ask the other surveys.
"""

from __future__ import annotations

from functools import partial

import cv2
import numpy as np
from matplotlib.patches import Rectangle
from numpy.typing import NDArray

from priorlab import plot
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.score import score_mask
from priorlab.figures.depth_case import COARSE, FINE, INFORMATIVE, NONE, REPEATS, arena, final_map, seeds_of
from priorlab.figures.figure import Entry, Outcome, sheet, verdict_of

WINDOW_M = 0.6
N_PLACES = 4

Window = tuple[slice, slice]


def places(seed: int) -> list[Window]:
    """Rows and columns of the four windows."""
    side = round(WINDOW_M / arena().metres_per_pixel)
    right = {prior: _is_right(final_map(seed, prior, FINE, REPEATS)) for prior in (INFORMATIVE, NONE)}
    gain = right[INFORMATIVE].astype(np.float64) - right[NONE]
    gained = cv2.boxFilter(gain, -1, (side, side), anchor=(0, 0), normalize=False, borderType=cv2.BORDER_CONSTANT)
    height, width = gained.shape
    gained = gained[: height - side + 1, : width - side + 1].copy()  # windows that lie whole in the arena
    chosen: list[Window] = []
    for _ in range(N_PLACES):
        row, col = (int(at) for at in np.unravel_index(gained.argmax(), gained.shape))
        chosen.append((slice(row, row + side), slice(col, col + side)))
        gained[max(0, row - side + 1) : row + side, max(0, col - side + 1) : col + side] = -np.inf
    return chosen


def _is_right(grid_map: GridMap) -> NDArray[np.bool_]:
    """(height, width) pixels that the map calls what they are: wall or empty."""
    return grid_map.grid.to_image(grid_map.detected()) == arena().truth.walls


def window_f2(seed: int, prior: Prior, size: int, repeats: int, window: Window) -> float:
    """F2 of a map inside a window."""
    grid_map, truth = final_map(seed, prior, size, repeats), arena().truth
    cut = type(truth)(truth.walls[window], truth.ignore[window])
    return score_mask(grid_map.grid.to_image(grid_map.detected())[window], cut).f_beta


def _locations(rng: np.random.Generator) -> Outcome:
    """Where they are."""
    seeds = seeds_of(rng)
    windows = places(seeds[0])
    figure, (ax,) = sheet(1, 1, 6.2, 4.8)
    plot.map(final_map(seeds[0], INFORMATIVE, FINE, REPEATS), ax, title="1 to 4: where the plan helps most")
    height = arena().truth.shape[0]
    gains, scores = [], []
    for number, (rows, cols) in enumerate(windows, start=1):
        side = cols.stop - cols.start
        ax.add_patch(Rectangle((cols.start, height - rows.stop), side, side, fill=False, ec="#d55e00", lw=2))
        ax.text(cols.start + 2, height - rows.start - 2, str(number), color="#d55e00", weight="bold", va="top", fontsize=12)
        with_plan, without = (window_f2(seeds[0], prior, FINE, REPEATS, (rows, cols)) for prior in (INFORMATIVE, NONE))
        scores.append((with_plan, without))
        gains.append({"rows": [rows.start, rows.stop], "columns": [cols.start, cols.stop], "with": with_plan, "without": without})
    told = "; ".join(f"{i}: {without:.2f} to {with_plan:.2f}" for i, (with_plan, without) in enumerate(scores, start=1))
    return Outcome(
        figure,
        {"places": gains, "side_m": WINDOW_M},
        verdict_of([with_plan > without for with_plan, without in scores]),
        f"F2 inside four windows of {100 * WINDOW_M:.0f} cm without and with the plan: {told}; chosen by the pixels that the "
        f"plan sets right on one survey, so better there by construction: the zooms test them on the others",
        "The arena's map with the plan; four numbered squares along walls that the camera saw badly or not at all.",
    )


def _zooms(rng: np.random.Generator, size: int, repeats: int) -> Outcome:
    """The four places, without the plan above and with it below; judged on surveys that did not choose them."""
    first, *others = seeds_of(rng)
    windows = places(first)
    figure, axes = sheet(2, N_PLACES, 2.5, 2.7)
    height = arena().truth.shape[0]
    for column, (rows, cols) in enumerate(windows):
        for row, (prior, name) in enumerate(((NONE, "without"), (INFORMATIVE, "with the plan"))):
            ax = axes[row * N_PLACES + column]
            plot.map(final_map(first, prior, size, repeats), ax, title=f"{column + 1}, {name}")
            ax.set(xlim=(cols.start, cols.stop), ylim=(height - rows.stop, height - rows.start), xlabel="", ylabel="")
    f2 = np.array(
        [[[window_f2(seed, prior, size, repeats, w) for prior in (INFORMATIVE, NONE)] for w in windows] for seed in others]
    )  # (surveys, places, with and without)
    mean, won = f2.mean(axis=0), (f2[..., 0] > f2[..., 1]).sum(axis=0)
    told = "; ".join(f"{i + 1}: {mean[i, 1]:.2f} to {mean[i, 0]:.2f}, {won[i]} of {len(others)}" for i in range(N_PLACES))
    return Outcome(
        figure,
        {"f2_with": mean[:, 0].tolist(), "f2_without": mean[:, 1].tolist(), "better_on": won.tolist(), "surveys": len(others)},
        verdict_of([bool(count > len(others) / 2) for count in won]),
        f"mean F2 at the four places without and with the plan, and on how many of {len(others)} other surveys that is better: "
        f"{told}",
        f"Four places of the map from {repeats} image{'s' * (repeats > 1)} a pose, cells of {size} px: above without the plan, "
        f"much grey and broken walls, below with it, walls mostly whole.",
    )


FIGURE_5_15 = Entry(
    "fig-5-15",
    "four places where the plan helps most",
    "There are places, mostly along walls, where the map with the plan is visibly better.",
    _locations,
)
FIGURE_5_16, FIGURE_5_17, FIGURE_5_19, FIGURE_5_20 = (
    Entry(
        f"fig-5-{number}",
        f"the four places, cells of {size} px, {repeats} image{'s' * (repeats > 1)} a pose",
        "At all four places the map with the plan is the better one.",
        partial(_zooms, size=size, repeats=repeats),
    )
    for number, size, repeats in ((16, FINE, REPEATS), (17, COARSE, REPEATS), (19, FINE, 1), (20, COARSE, 1))
)
