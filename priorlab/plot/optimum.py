"""Chapter 4.3 to 4.6 as pictures: the sweep over all priors, the fronts, the clusters."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes

from priorlab.core.grid_map import Prior
from priorlab.optimize.clusters import Clusters
from priorlab.optimize.front import FLOOR, Front
from priorlab.optimize.sweep import Sweep
from priorlab.plot.style import BLACK, BLUE, GREEN, ORANGE, PINK, RED, SKY, finish, given_or_new

MARKERS = ("o", "s", "^", "D", "v", "P")
COLOURS = (BLUE, ORANGE, GREEN, PINK, SKY, RED)
MEASURES = {"precision": "precision", "recall": "recall", "f_beta": "F-beta", "false_positive_rate": "false positive rate"}


def sweep(
    every_prior: Sweep,
    measure: str = "f_beta",
    ax: Axes | None = None,
    prior: Prior | None = None,
    n: int = 181,
    title: str | None = None,
) -> Axes:
    """A measure of every pair p_wall, p_space as a colour map (fig. 4.5), computed exactly, not interpolated.

    Parameters
    ----------
    every_prior : `Experiment.sweep()`
    measure : "precision", "recall", "f_beta" or "false_positive_rate"
    prior : marked with a cross
    n : pairs a side
    """
    if measure not in MEASURES:
        raise ValueError(f"measure must be one of {', '.join(MEASURES)}, got {measure!r}")
    ax = given_or_new(ax, 5.2, 4.2)
    values = getattr(every_prior.grid(n), measure)  # p_wall down, p_space across
    shown = ax.imshow(values.T, origin="lower", extent=(0.1, 1, 0.1, 1), cmap="cividis", interpolation="nearest", aspect="equal")
    ax.figure.colorbar(shown, ax=ax, shrink=0.85)
    edge = every_prior.threshold / every_prior.factor
    if 0.1 < edge < 1:
        ax.axvline(edge, color="white", ls=":", lw=1.2)
        ax.axhline(edge, color="white", ls=":", lw=1.2)
    if prior is not None:
        ax.plot(prior.p_wall, prior.p_space, "X", color=RED, mec="white", ms=11, label=f"({prior.p_wall:g}, {prior.p_space:g})")
        ax.legend(loc="lower right", fontsize=8)
    name = f"F{every_prior.beta:g}" if measure == "f_beta" else MEASURES[measure]
    return finish(ax, name if title is None else title, "p_wall, before the factor", "p_space, before the factor")


def front(
    fronts: Front | Mapping[str, Front],
    ax: Axes | None = None,
    prior: tuple[float, float] | None = None,
    title: str | None = None,
) -> Axes:
    """Pareto fronts in precision and recall (fig. 4.7); each has a marker and a line of its own.

    The line is the border of what can be reached: steps, for there are no compromises between two points.

    Parameters
    ----------
    fronts : one, or several by the name of the legend
    prior : precision and recall of a prior to point out
    """
    ax = given_or_new(ax, 5.6, 4.2)
    named = {fronts.name: fronts} if isinstance(fronts, Front) else fronts
    styles = zip(MARKERS, COLOURS, ("-", "--", "-.", ":", "-", "--"), strict=True)
    for (name, one), (marker, colour, line) in zip(named.items(), styles, strict=False):
        label = f"{name} ({len(one)})" if len(one) else f"{name}: empty"
        size, fill = (7, "none") if marker == "o" else (3.5, colour)
        order = np.argsort(one.recall)
        (border,) = ax.plot(one.recall[order], one.precision[order], ls=line, color=colour, lw=1.2, drawstyle="steps-pre")
        border.set(marker=marker, markersize=size, markerfacecolor=fill, label=label)
    if prior is not None:
        precision, recall = prior
        ax.plot(recall, precision, "X", color=RED, mec="white", ms=13, label="the prior used", zorder=1.5)
    ax.axvspan(0, FLOOR, color="0.93", lw=0)
    ax.axhspan(0, FLOOR, color="0.93", lw=0)
    ax.text(0.02, 0.02, f"below the floor of {100 * FLOOR:g} % (eq. 4.19)", transform=ax.transAxes, fontsize=8)
    ax.set(xlim=(0, 1.02), ylim=(0, 1.02))
    ax.legend(fontsize=8, loc="lower left", bbox_to_anchor=(0.0, 0.08))
    return finish(ax, title, "recall", "precision")


def clusters(groups: Clusters, ax: Axes | None = None, title: str | None = None, centres: bool = True) -> Axes:
    """The priors of the front in their groups (fig. 4.8), each with a colour and a marker; a cross at the centre."""
    ax = given_or_new(ax, 5.2, 4.2)
    for i, centre in enumerate(np.asarray(groups.centres)):
        own = groups.priors[groups.labels == i]
        marker, colour = MARKERS[i % len(MARKERS)], COLOURS[i % len(COLOURS)]
        ax.plot(
            own[:, 0],
            own[:, 1],
            marker,
            color=colour,
            ms=5,
            alpha=0.8,
            label=f"cluster {i + 1}: {len(own)} prior{'s' * (len(own) != 1)}",
        )
        if centres:
            ax.plot(*centre, "x", color=BLACK, ms=9, mew=2)
    ax.set(xlim=(0.05, 1.05), ylim=(0.05, 1.05), aspect="equal")
    if len(groups.priors):
        ax.legend(fontsize=8)
    return finish(ax, title, "p_wall, before the factor", "p_space, before the factor")
