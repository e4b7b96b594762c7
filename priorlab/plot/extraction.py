"""Chapter 3 as pictures: the drawing, its corners, doors and walls, and the funnel of tests. Image pixels, y DOWN."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon
from numpy.typing import ArrayLike

from priorlab.core.building import Truth
from priorlab.core.drawing import Door, Drawing, Walls
from priorlab.plot.style import BLACK, BLUE, GREEN, ORANGE, RED, ax_for_image, finish, given_or_new

FOUND, INVENTED, MISSED, IGNORED = (0, 0, 0), (86, 180, 233), (213, 94, 0), (226, 226, 226)
SCORED = np.array([(255, 255, 255), INVENTED, MISSED, FOUND, *[IGNORED] * 4], dtype=np.uint8)
"""Colour of a pixel by 1 (detected) + 2 (a true wall) + 4 (does not count)."""
LEGEND = "black: found, dark orange: missed, light blue: invented, light grey: not counted"


def drawing(plan: Drawing, ax: Axes | None = None, title: str | None = None, faint: bool = False) -> Axes:
    """The drawing as it came; `faint` makes it a background to draw on."""
    ax = ax_for_image(ax, plan.shape)
    grey = plan.grey.astype(np.float32) / 255
    image = plan.colour if plan.colour is not None and not faint else np.stack([1 - 0.35 * (1 - grey) if faint else grey] * 3, -1)
    ax.imshow(image, interpolation="antialiased")
    return _in_pixels(ax, plan.shape, title)


def corners(points: ArrayLike, plan: Drawing, ax: Axes | None = None, title: str | None = None) -> Axes:
    """The corners (N, 2), x right and y down, as crosses on the faint drawing (eq. 3.1)."""
    xy = np.asarray(points, dtype=np.float64).reshape(-1, 2)
    ax = drawing(plan, ax, f"{len(xy)} corners" if title is None else title, faint=True)
    ax.plot(xy[:, 0], xy[:, 1], "+", color=BLUE, ms=5, mew=1.0)
    return ax


def doors(found: Sequence[Door], plan: Drawing, ax: Axes | None = None, title: str | None = None) -> Axes:
    """The doors as triangles (fig. 3.5): the open side dashed, the tip a dot."""
    ax = drawing(plan, ax, f"{len(found)} doors" if title is None else title, faint=True)
    for door in found:
        hinge, strike, tip = door.points
        ax.add_patch(Polygon(door.points, closed=True, fc=ORANGE, ec=RED, alpha=0.45, lw=1.2))
        ax.plot(*np.transpose([hinge, strike]), "--", color=BLACK, lw=1.4)
        ax.plot(*tip, "o", color=RED, ms=4)
    return ax


def walls(found: Walls, truth: Truth | None = None, ax: Axes | None = None, title: str | None = None) -> Axes:
    """The walls, black; with the truth also what was missed and what was invented."""
    ax = ax_for_image(ax, found.shape)
    if truth is None:
        image = np.where(found.mask[..., None], np.uint8(0), np.uint8(255)).repeat(3, -1)
        words = f"walls: {100 * found.mask.mean():.1f} % of the pixels"
    else:
        image, words = scored_image(found.mask, truth), LEGEND
    ax.imshow(image, interpolation="antialiased")
    return _in_pixels(ax, found.shape, words if title is None else title)


def funnel(left: Mapping[str, int], lost_at: str | None = None, ax: Axes | None = None, title: str | None = None) -> Axes:
    """How many candidates each test leaves, from the first to the last; a stage that lost everything is marked.

    Parameters
    ----------
    left : test -> candidates left after it
    lost_at : the stage that lost the walls
    """
    names, counts = list(left), np.array(list(left.values()), dtype=np.float64)
    ax = given_or_new(ax, 6.0, 0.34 * len(names) + 1.0)
    rows = np.arange(len(names))
    colours = [RED if count == 0 else GREEN for count in counts]
    ax.barh(rows, np.log10(1 + counts), color=colours, height=0.7)
    for row, (name, count) in enumerate(zip(names, counts, strict=True)):
        ax.text(np.log10(1 + count) + 0.05, row, f"{int(count):,}{'  none left' if not count else ''}", va="center", fontsize=9)
        if name == lost_at:
            ax.plot(0, row, "x", color=BLACK, ms=9, mew=2, clip_on=False)
    ax.set_yticks(rows, [name.replace("_", " ") for name in names])
    ax.invert_yaxis()
    top = max(1.0, float(np.log10(1 + counts.max(initial=1))))
    ticks = np.arange(0, int(np.ceil(top)) + 1)
    ax.set_xticks(np.log10(1 + 10.0**ticks), [f"{10 ** int(tick):,}" for tick in ticks])
    ax.set_xlim(0, 1.25 * top + 0.2)
    return finish(ax, title, "left after each test (logarithmic)", "")


def scored_image(detected: ArrayLike, truth: Truth) -> np.ndarray:
    """(height, width, 3) uint8: every pixel by what the score makes of it, see `LEGEND`."""
    detected = np.asarray(detected, dtype=bool)
    what = detected.view(np.uint8) | truth.walls.view(np.uint8) << 1 | truth.ignore.view(np.uint8) << 2
    return SCORED.take(what, axis=0, mode="clip")


def _in_pixels(ax: Axes, shape: tuple[int, int], title: str | None) -> Axes:
    """Axes of an image: pixels, y down."""
    ax.set(xlim=(-0.5, shape[1] - 0.5), ylim=(shape[0] - 0.5, -0.5))
    ax.locator_params(nbins=5)
    return finish(ax, title, "x, pixels", "y, pixels (down)")
