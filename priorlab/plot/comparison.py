"""With the plan, without it, the plan alone: lines and bars over seeds, each with the lowest and the highest run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import ArrayLike

from priorlab.plot.style import ALONE, BLACK, BLUE, GREEN, NO_PLAN, ORANGE, PINK, PLAN, RED, SKY, finish, given_or_new

THREE = {"with the plan": PLAN, "without (0.5)": NO_PLAN, "the plan alone": ALONE}
"""The names under which the three lines of every comparison are told apart."""

HATCHES = {"with the plan": "", "without (0.5)": "//", "the plan alone": ".."}
SERIES = tuple(zip((BLUE, ORANGE, GREEN, PINK, SKY, RED, BLACK), "os^DvPX", ("-", "--", "-.", ":", "-", "--", "-."), strict=True))


def interval_lines(
    x: ArrayLike | Mapping[str, ArrayLike],
    curves: Mapping[str, ArrayLike],
    ax: Axes | None = None,
    title: str | None = None,
    x_label: str = "",
    y_label: str = "F2 at P(empty) <= 0.2",
) -> Axes:
    """One line for each name through the means, the room between the lowest and the highest run shaded.

    Parameters
    ----------
    x : (K,) for all lines, or a row for each name
    curves : by name, (K, 3) mean, lowest, highest
    """
    ax = given_or_new(ax, 6.0, 3.8)
    for i, (name, values) in enumerate(curves.items()):
        at = np.asarray(x[name] if isinstance(x, Mapping) else x, dtype=np.float64)
        mean, low, high = np.asarray(values, dtype=np.float64).T
        colour, marker, line = SERIES[i % len(SERIES)]
        style = THREE.get(name, {"color": colour, "marker": marker, "ls": line})
        ax.plot(at, mean, label=name, lw=1.6, ms=5, markevery=max(1, len(at) // 12), **style)
        ax.fill_between(at, low, high, color=style["color"], alpha=0.2, lw=0)
    ax.legend(fontsize=8)
    return finish(ax, title, x_label, y_label)


def interval_bars(
    groups: Sequence[str],
    bars: Mapping[str, ArrayLike],
    ax: Axes | None = None,
    title: str | None = None,
    x_label: str = "F2 at P(empty) <= 0.2",
) -> Axes:
    """Bars side by side for each group, lying, with a whisker from the lowest to the highest run and the mean beside it.

    Parameters
    ----------
    groups : from top to bottom
    bars : by name, (G, 3) mean, lowest, highest
    """
    ax = given_or_new(ax, 6.0, 0.32 * len(groups) * len(bars) + 1.2)
    rows, height = np.arange(len(groups)), 0.8 / len(bars)
    widest = 0.0
    for i, (name, values) in enumerate(bars.items()):
        mean, low, high = np.asarray(values, dtype=np.float64).T
        at = rows + height * (i - (len(bars) - 1) / 2)
        colour = THREE.get(name, {"color": SERIES[i % len(SERIES)][0]})["color"]
        face = "white" if name == "the plan alone" else colour
        ax.barh(
            at, mean, height * 0.92, color=face, ec=colour if face == "white" else "white", hatch=HATCHES.get(name), label=name
        )
        ax.hlines(at, low, high, color=BLACK, lw=1.2)
        for y, value, top in zip(at, mean, high, strict=True):
            ax.text(max(top, 0.0), y, f" {value:.2f}", va="center", fontsize=7)
        widest = max(widest, float(np.nanmax(high)))
    ax.set_yticks(rows, groups)
    ax.invert_yaxis()
    ax.set_xlim(0, 1.15 * widest)
    ax.legend(fontsize=8, ncols=len(bars) if len(bars) < 4 else 2, loc="lower center", bbox_to_anchor=(0.5, 1.0), frameon=False)
    ax.set_title(title or "", pad=24 if len(bars) < 4 else 38)
    return finish(ax, None, x_label, "")


def gains(
    x: ArrayLike | Mapping[str, ArrayLike], curves: Mapping[str, ArrayLike], ax: Axes | None = None, title: str | None = None
) -> Axes:
    """Gain in F2 over no prior, percent, one line for each name; above 50 % the axis is logarithmic.

    Parameters
    ----------
    x : mean looks at a seen cell, (K,) or a row for each name
    curves : by name, (K, 3) mean, lowest, highest
    """
    ax = interval_lines(x, curves, ax, title, "mean looks at a seen cell", "gain in F2 over no prior, %")
    ax.axhline(0, color=BLACK, lw=1)
    ax.axhline(20, color=BLACK, lw=1, ls=":")
    ax.text(0.01, 20, "the thesis's +20 %", ha="left", va="bottom", fontsize=8, transform=ax.get_yaxis_transform())
    ax.set_yscale("symlog", linthresh=50)
    ax.set_yticks([-50, -20, 0, 20, 50, 100, 200, 500, 1000], ["-50", "-20", "0", "20", "50", "100", "200", "500", "1000"])
    lows, highs = (np.concatenate([np.asarray(values)[:, i] for values in curves.values()]) for i in (1, 2))
    ax.set_ylim(min(-30.0, float(np.nanmin(lows)) * 1.3), max(60.0, float(np.nanmax(highs)) * 1.4))
    return ax


def looks_axis(ax: Axes, lowest: float, highest: float) -> Axes:
    """Mean looks, logarithmic, with numbers that can be read."""
    ax.set_xscale("log")
    ticks = [tick for tick in (1, 1.2, 1.5, 2, 3, 4, 6, 8, 12, 20, 40) if lowest * 0.95 <= tick <= highest * 1.05]
    ax.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    ax.minorticks_off()
    return ax
