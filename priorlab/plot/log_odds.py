"""Chapter 2.3.4 and 4.2 as pictures: the log-odds curve, and which prior flips a cell.

The numbers come from `priorlab.core.log_odds` and `priorlab.mapping`; here they are only drawn.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import ArrayLike

from priorlab.core.log_odds import DETECTED_WALL, log_odds
from priorlab.plot.style import BLACK, BLUE, GREEN, PINK, RED, SKY, finish, given_or_new

COLOURS = (BLACK, BLUE, RED, GREEN, PINK, SKY)
LINES = ("-", "--", "-.", ":", (0, (6, 1, 1, 1, 1, 1)), (0, (1, 1)))
P_TICKS = (0.01, 0.05, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 0.95, 0.99)


def log_odds_curve(ax: Axes | None = None, marks: Sequence[float] = (), linear: tuple[float, float] = (0.2, 0.8)) -> Axes:
    """l(p) from wall to empty (fig. 2.9), the part that is nearly straight shaded.

    Parameters
    ----------
    marks : probabilities to point out
    linear : ends of the shaded part
    """
    ax = given_or_new(ax, 6.5, 3.8)
    p = np.linspace(0.005, 0.995, 397)
    ax.axvspan(*linear, color="0.9", lw=0)
    ax.axhline(0, color="0.5", lw=0.8)
    ax.plot(p, log_odds(p), color=BLUE, lw=2)
    for mark in marks:
        at = float(log_odds(mark))
        ax.plot(mark, at, "o", color=RED)
        side, anchor = ((8, -12), "left") if mark <= 0.5 else ((-8, 4), "right")
        ax.annotate(f"l({mark:g}) = {at:.2f}", (mark, at), side, textcoords="offset points", ha=anchor)
    ax.set_xlim(0, 1)
    return finish(ax, "ln(p / (1 - p)), nearly straight where shaded", "P(empty):  0 = wall, 1 = empty", "log odds l")


def flip_lines(
    p_prior: ArrayLike,
    after: Mapping[str, ArrayLike],
    ax: Axes | None = None,
    threshold: float = DETECTED_WALL,
    pivot: float | None = None,
) -> Axes:
    """Log odds after some readings, against the prior that the cell started with.

    A line falls where a cell that is believed emptier ends up MORE wall; where it crosses the threshold the verdict flips.

    Parameters
    ----------
    p_prior : (N,) effective P(empty) that a cell started with
    after : for each label, (N,) log odds after those readings
    pivot : P(empty) of the sensor model; there all lines of equal readings meet when lam = 1
    """
    ax = given_or_new(ax, 7.0, 4.2)
    start = log_odds(p_prior)
    for (label, values), colour, line in zip(after.items(), COLOURS, LINES, strict=False):
        ax.plot(start, np.asarray(values), color=colour, ls=line, lw=2, label=label)
    low = min(float(np.min(np.asarray(values))) for values in after.values())
    edge = float(log_odds(threshold))
    ax.axhspan(min(low, edge) - 1, edge, color="0.9", lw=0)
    ax.axhline(edge, color="0.4", lw=0.8, ls=":")
    ax.text(start[0] + 0.1, min(low, edge) - 0.8, f"shaded: detected as wall, P(empty) <= {threshold:g}", va="bottom", fontsize=8)
    if pivot is not None:
        at = float(log_odds(pivot))
        ax.plot(at, at, "o", ms=9, mfc="none", mec="black")
        ax.annotate(f"the sensor's own {pivot:g}", (at, at), (0, 14), textcoords="offset points", fontsize=8, ha="center")
    ticks = [p for p in P_TICKS if start[0] <= log_odds(p) <= start[-1]]
    ax.set_xticks([float(log_odds(p)) for p in ticks], [f"{p:g}" for p in ticks])
    ax.set_xlim(start[0], start[-1])
    ax.legend(fontsize=8)
    return finish(ax, None, "effective prior P(empty), spaced by log odds", "log odds after the readings")
