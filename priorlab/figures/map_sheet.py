"""Maps side by side, each with its scores below the title."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from priorlab import plot
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.score import Score, score_map
from priorlab.figures.case import Case
from priorlab.figures.figure import sheet
from priorlab.mapping.overruled import OverruledSensorWarning
from priorlab.mapping.prior import build_prior_map
from priorlab.mapping.update import update_map

NO_PLAN = Prior.uninformed()


def map_sheet(rows: int, cols: int, of: Case, width: float = 3.3) -> tuple[Figure, list[Axes]]:
    """A sheet whose panels have the proportions of a drawing."""
    height, across = of.plan.drawing.shape
    return sheet(rows, cols, width, width * height / across + 0.42)


def prior_map_of(one: Case, prior: Prior) -> GridMap:
    """The map that a case starts from, on the cells of its evidence."""
    grid = one.experiment.evidence.grid
    return build_prior_map(one.extraction.walls, prior, grid.cell_size)


def posterior(one: Case, prior: Prior) -> GridMap:
    """The map that a prior ends at on a case's readings."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", OverruledSensorWarning)  # p_space = 1 breaks eq. 2.22 on the edge: shown, not told here
        return update_map(prior_map_of(one, prior), one.experiment.evidence)


def show_map(grid_map: GridMap, one: Case, ax: Axes, title: str, poses: bool = False) -> Score:
    """Draw a map, its title with F2, precision and recall, and hand the score back."""
    score = score_map(grid_map, one.plan.truth)
    plot.map(grid_map, ax, poses=one.plan.survey if poses else None, title=f"{title}\n{told(score)}")
    ax.title.set_fontsize(8)
    bare(ax)
    return score


def show_survey(one: Case, ax: Axes, title: str = "drawing and survey") -> None:
    """The drawing with the points where measurements were taken."""
    plot.drawing(one.plan.drawing, ax)
    height = one.plan.drawing.shape[0]
    ax.plot(one.plan.survey[:, 0], height - one.plan.survey[:, 1], ".", color="#0072b2", ms=2)
    ax.set_title(
        f"{title}\n{len(one.plan.survey)} poses, {one.experiment.evidence.mean_looks:.1f} looks at a seen cell", fontsize=8
    )
    bare(ax)


def told(score: Score) -> str:
    """F2, precision and recall in a few characters."""
    precision = "-" if np.isnan(score.precision) else f"{score.precision:.2f}"
    return f"F2 {score.f_beta:.2f}   precision {precision}   recall {score.recall:.2f}"


def numbers_of(score: Score) -> dict[str, Any]:
    """A score as plain data; None where there is none."""
    values = {
        "f2": score.f_beta,
        "precision": score.precision,
        "recall": score.recall,
        "false_positive_rate": score.false_positive_rate,
    }
    return {name: None if np.isnan(value) else value for name, value in values.items()}


def bare(ax: Axes) -> None:
    """No ticks: a map among others needs none."""
    ax.set(xticks=[], yticks=[], xlabel="", ylabel="")


def pairs_told(priors: Sequence[tuple[float, float]]) -> str:
    """Pairs in a row.

    >>> pairs_told([(0.2, 0.9), (0.2, 1.0)])
    '(0.2, 0.9), (0.2, 1)'
    """
    return ", ".join(f"({wall:g}, {space:g})" for wall, space in priors)
