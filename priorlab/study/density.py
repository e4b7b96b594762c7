"""What is a prior worth, the more often cells are seen? Gain of a prior over none, by building and density of the survey "
"(ch. 5)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from priorlab.buildings.floor_plans import load_floor_plan
from priorlab.core.grid_map import Prior
from priorlab.core.sensor import RangeSensor
from priorlab.drawing.extraction import extract_walls
from priorlab.drawing.method import ROBUST, Method
from priorlab.pipeline import map_with_prior

SPACINGS = (20.0, 12.0, 8.0, 5.0, 3.0)
"""Pixels between the poses of a survey, from quick to dense."""


@dataclass(frozen=True)
class DensityRow:
    """One building at one density: looks at a seen cell, F2 with the prior, without it and of the prior alone."""

    building: str
    spacing: float
    poses: int
    mean_looks: float
    f2_prior: float
    f2_none: float
    f2_alone: float

    @property
    def gain_percent(self) -> float:
        """How much higher the F2 is with the prior, percent; nan when nothing was found without it."""
        return 100 * (self.f2_prior / self.f2_none - 1) if self.f2_none else float("nan")


def gain_by_density(
    buildings: Sequence[str],
    spacings: Sequence[float] = SPACINGS,
    prior: Prior | None = None,
    cell_size: float = 3,
    method: Method = ROBUST,
    sensor: RangeSensor | None = None,
) -> list[DensityRow]:
    """Map every building at every density, with the prior and without.

    Parameters
    ----------
    buildings : names for `load_floor_plan`
    spacings : pixels between the poses of a survey
    prior : `Prior()`, the thesis's (0.2, 0.9), by default
    cell_size : pixels
    method : of the extraction, done once a building

    Returns
    -------
    A row for each building and spacing, in this order; the exact ranges of chapter 4 leave nothing to chance.
    """
    rows = []
    for name in buildings:
        walls = extract_walls(load_floor_plan(name).drawing, method).walls
        for spacing in spacings:
            plan = load_floor_plan(name, survey_spacing=spacing)
            one = map_with_prior(walls, plan.truth, plan.survey, prior or Prior(), cell_size, sensor or RangeSensor(), plan.truth)
            scores = [score.f_beta if score else np.nan for score in (one.score_informed, one.score_uninformed, one.score_prior)]
            rows.append(DensityRow(name, float(spacing), len(plan.survey), one.evidence.mean_looks, *scores))
    return rows
