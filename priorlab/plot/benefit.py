"""Chapter 5 as pictures: what the prior is worth, over time and against how often cells are seen."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import ArrayLike

from priorlab.core.score import Score
from priorlab.plot.style import ALONE, BLUE, NO_PLAN, PLAN, RED, finish, given_or_new


def f_over_time(
    steps: ArrayLike,
    with_prior: ArrayLike,
    without_prior: ArrayLike,
    prior_alone: float | None = None,
    ax: Axes | None = None,
    title: str | None = None,
    threshold: float = 0.2,
) -> Axes:
    """F2 of the map while the robot explores (fig. 5.9), with the plan and without; the prior alone is the third line."""
    ax = given_or_new(ax, 6.0, 3.6)
    steps = np.asarray(steps)
    every = max(1, len(steps) // 8)
    ax.plot(steps, np.asarray(with_prior), label="with the plan as prior", markevery=every, ms=5, lw=1.8, **PLAN)
    ax.plot(steps, np.asarray(without_prior), label="without (0.5 everywhere)", markevery=every, ms=5, lw=1.8, **NO_PLAN)
    if prior_alone is not None:
        ax.axhline(prior_alone, color=ALONE["color"], ls=ALONE["ls"], lw=1.6, label="the prior alone, no reading")
    ax.set(ylim=(0, 1.02), xlim=(float(steps[0]), float(steps[-1])))
    ax.legend(fontsize=8)
    return finish(ax, title, "readings taken", f"F2 at P(empty) <= {threshold:g}")


def score_bars(scores: Mapping[str, Score], ax: Axes | None = None, title: str | None = None) -> Axes:
    """Precision, recall and F-beta of several maps or methods side by side, each bar with its number."""
    ax = given_or_new(ax, 6.0, 0.75 * len(scores) + 1.0)
    looks = (("precision", BLUE, ""), ("recall", "#56b4e9", "//"), ("f_beta", RED, ".."))
    rows = np.arange(len(scores))
    for i, (measure, colour, hatch) in enumerate(looks):
        values = np.array([getattr(score, measure) for score in scores.values()], dtype=np.float64)
        label = f"F{next(iter(scores.values())).beta:g}" if measure == "f_beta" else measure
        at = rows + 0.27 * (i - 1)
        ax.barh(at, np.nan_to_num(values), height=0.25, color=colour, hatch=hatch, ec="white", label=label)
        for y, value in zip(at, values, strict=True):
            words = f"{value:.2f}" if np.isfinite(value) else "nothing detected"
            ax.text((value if np.isfinite(value) else 0) + 0.01, y, words, va="center", fontsize=8)
    ax.set_yticks(rows, list(scores))
    ax.invert_yaxis()
    ax.set_xlim(0, 1.1)
    ax.legend(fontsize=8, ncols=3, loc="upper center", bbox_to_anchor=(0.5, -0.16 if len(scores) > 2 else -0.25), frameon=False)
    return finish(ax, title, "", "")
