"""How all pictures look: colours of Okabe and Ito, and the axes of a picture that lies on a drawing."""

from __future__ import annotations

from typing import Any

import matplotlib.pyplot as plt
from matplotlib.axes import Axes

BLACK, ORANGE, SKY, GREEN, BLUE, RED, PINK = "#000000", "#e69f00", "#56b4e9", "#009e73", "#0072b2", "#d55e00", "#cc79a7"
"""Told apart by colour-blind readers; every use adds a marker, a line style or a word."""

LineStyle = dict[str, Any]

PLAN: LineStyle
NO_PLAN: LineStyle
ALONE: LineStyle
PLAN, NO_PLAN, ALONE = (
    {"color": BLUE, "ls": "-", "marker": "o"},
    {"color": RED, "ls": "--", "marker": "s"},
    {"color": BLACK, "ls": ":", "marker": "D"},
)
"""The three lines of every comparison: with the plan as prior, without it, the prior alone."""

GREY: dict[str, Any] = {"cmap": "gray", "vmin": 0, "vmax": 1, "interpolation": "auto"}
"""P(empty) as it is always shown: 0 black, 1 white."""


def given_or_new(ax: Axes | None, width: float = 6.0, height: float = 4.5) -> Axes:
    """The ax that was given, or one on a new figure of some inches."""
    return plt.subplots(figsize=(width, height), layout="constrained")[1] if ax is None else ax


def ax_for_image(ax: Axes | None, shape: tuple[int, int], width: float = 7.0) -> Axes:
    """The ax that was given, or one on a new figure with the proportions of an image."""
    return given_or_new(ax, width, min(max(width * shape[0] / shape[1], 2.0), 12.0) + 0.5)


def finish(ax: Axes, title: str | None, x: str, y: str) -> Axes:
    """Name the axes, with their units, and drop the frame that says nothing."""
    ax.set(xlabel=x, ylabel=y)
    if title is not None:
        ax.set_title(title)
    ax.spines[["top", "right"]].set_visible(False)
    return ax
