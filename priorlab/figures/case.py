"""The five drawings of chapters 4 and 5, ours: walls extracted, surveyed once, ready for every prior."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

from priorlab.buildings.floor_plans import floor_plan_names, load_floor_plan
from priorlab.core.building import FloorPlan
from priorlab.core.sensor import RangeSensor
from priorlab.drawing.extraction import Extraction, extract_walls
from priorlab.drawing.method import ROBUST, Method
from priorlab.mapping.evidence import gather_evidence
from priorlab.mapping.prior import build_prior_map
from priorlab.optimize.experiment import Experiment
from priorlab.robot.explore import explore


@dataclass(frozen=True, eq=False)
class Case:
    """A building with what was extracted and the experiment of a quick survey."""

    plan: FloorPlan
    extraction: Extraction
    experiment: Experiment


def cases(cell_size: float = 3, at_most: int = 5) -> list[Case]:
    """Up to five bundled buildings, by name."""
    return [case(name, cell_size) for name in floor_plan_names()[:at_most]]


@lru_cache(maxsize=16)
def case(name: str, cell_size: float = 3) -> Case:
    """One building; the ranges of chapter 4 are exact, so nothing here is left to chance."""
    plan, extraction = load_floor_plan(name), extracted(name)
    grid = build_prior_map(extraction.walls, None, cell_size).grid
    evidence = gather_evidence(explore(plan.truth, plan.survey, RangeSensor()), grid)
    return Case(plan, extraction, Experiment(extraction.walls, evidence, plan.truth))


@lru_cache(maxsize=32)
def extracted(name: str, method: Method = ROBUST) -> Extraction:
    """The walls of a bundled building, once for all figures."""
    return extract_walls(load_floor_plan(name).drawing, method)
