"""What work costs as it grows, on logarithmic axes where linear growth is a straight line of slope 1."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import ArrayLike

from priorlab.plot.style import BLACK, BLUE, GREEN, ORANGE, RED, LineStyle, finish, given_or_new

LOOKS: tuple[LineStyle, ...] = (
    {"color": BLUE, "ls": "-", "marker": "o"},
    {"color": RED, "ls": "--", "marker": "s"},
    {"color": GREEN, "ls": "-.", "marker": "^"},
    {"color": ORANGE, "ls": (0, (1, 1)), "marker": "v"},
)


def cost(
    amounts: ArrayLike,
    seconds: Mapping[str, ArrayLike],
    ax: Axes | None = None,
    title: str | None = None,
    what: str = "pixels",
) -> Axes:
    """Seconds against an amount of work, a line for each kind, with a dotted line of linear growth through the first of each.

    Parameters
    ----------
    amounts : (N,) pixels or poses
    seconds : by kind of work, (N,)
    what : the unit of the amounts
    """
    ax = given_or_new(ax, 5.4, 4.0)
    x = np.asarray(amounts, dtype=np.float64)
    for (kind, times), look in zip(seconds.items(), LOOKS, strict=False):
        y = np.asarray(times, dtype=np.float64)
        ax.plot(x, y, label=kind, lw=1.8, ms=5, **look)
        ax.plot(x, y[0] * x / x[0], color=BLACK, ls=":", lw=1)
    ax.plot([], [], color=BLACK, ls=":", lw=1, label="linear from the first")
    ax.set(xscale="log", yscale="log")
    ax.set_xticks(x, [f"{amount:,.0f}" for amount in x])
    ax.tick_params(axis="x", which="minor", bottom=False, labelbottom=False)
    ax.legend(fontsize=8)
    return finish(ax, title, what, "seconds of the processor")
