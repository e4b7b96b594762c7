"""The five drawings of chapters 4 and 5, ours: walls extracted, surveyed once, ready for every prior; shared by all figures."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from priorlab.core.building import FloorPlan
from priorlab.core.grid import Grid
from priorlab.core.readings import Readings
from priorlab.drawing.extraction import Extraction
from priorlab.mapping.evidence import gather_evidence
from priorlab.optimize.experiment import Experiment
from priorlab.optimize.front import Front
from priorlab.optimize.pareto import pareto_front
from priorlab.robot.explore import explore
from priorlab.study.qualities import extracted as extracted
from priorlab.study.thesis_drawings import THESIS_DRAWINGS, THOROUGH, sensor_for, thesis_plan


@dataclass(frozen=True, eq=False)
class Case:
    """A building with what was extracted, what a survey saw, and the experiment that they make."""

    plan: FloorPlan
    extraction: Extraction
    readings: Readings
    experiment: Experiment


def cases(cell_size: float = 3, spacing: float = THOROUGH) -> list[Case]:
    """The five drawings, in the thesis's order."""
    return [case(name, cell_size, spacing) for name in THESIS_DRAWINGS]


@lru_cache(maxsize=64)
def case(name: str, cell_size: float = 3, spacing: float = THOROUGH) -> Case:
    """One building; the ranges of chapter 4 are exact, so nothing here is left to chance.

    Parameters
    ----------
    name : of a bundled building
    cell_size : pixels
    spacing : of the survey, in sensor ranges: `QUICK`, `THOROUGH`, `DENSE`
    """
    return _seen(thesis_plan(name, spacing), _readings(name, spacing), cell_size)


def case_of_survey(name: str, survey: NDArray[np.float64], cell_size: float = 3) -> Case:
    """One building after any other survey."""
    plan = replace(thesis_plan(name), survey=survey)
    return _seen(plan, explore(plan.truth, survey, sensor_for(plan)), cell_size)


def _seen(plan: FloorPlan, readings: Readings, cell_size: float) -> Case:
    """What readings make of a building."""
    walls = extracted(plan.name).walls
    evidence = gather_evidence(readings, Grid(plan.truth.shape, cell_size, walls.metres_per_pixel))
    return Case(plan, extracted(plan.name), readings, Experiment(walls, evidence, plan.truth))


@lru_cache(maxsize=32)
def _readings(name: str, spacing: float) -> Readings:
    """What the sensor measured, whatever the cells."""
    plan = thesis_plan(name, spacing)
    return explore(plan.truth, plan.survey, sensor_for(plan))


@lru_cache(maxsize=16)
def searched_front(name: str, seed: int) -> Front:
    """What NSGA-II finds for a building; figures 4.7 and 4.8 share it."""
    return pareto_front(case(name).experiment, np.random.default_rng(seed))
