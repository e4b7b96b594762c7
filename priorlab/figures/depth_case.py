"""What the figures of section 5.3 share: surveys of the arena by seed, their evidence, and the maps of both priors."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.readings import Evidence
from priorlab.core.score import Score, score_map
from priorlab.mapping.evidence import gather_evidence
from priorlab.mapping.prior import build_prior_map
from priorlab.mapping.update import update_map
from priorlab.study.arena import Arena, build_arena
from priorlab.study.depth_survey import DepthSurvey, survey_arena

N_SURVEYS = 8
"""Surveys behind every interval: the same poses, other errors of tape measure and camera."""

REPEATS = 3
INFORMATIVE, NONE = Prior(p_wall=0.2, p_space=0.9), Prior.uninformed()
FINE, COARSE = 2, 3


@dataclass(frozen=True)
class Interval:
    """Lowest, mean and highest of a number over the surveys."""

    low: float
    mean: float
    high: float

    @classmethod
    def of(cls, values: list[float]) -> Interval:
        """Of some values."""
        return cls(float(np.min(values)), float(np.mean(values)), float(np.max(values)))

    def __str__(self) -> str:
        return f"{self.mean:.2f} ({self.low:.2f} to {self.high:.2f})"


@lru_cache(maxsize=1)
def arena() -> Arena:
    """The arena."""
    return build_arena()


def seeds_of(rng: np.random.Generator) -> tuple[int, ...]:
    """A seed for each survey, the same for all figures of one run."""
    return tuple(int(seed) for seed in rng.integers(2**32, size=N_SURVEYS))


@lru_cache(maxsize=N_SURVEYS)
def survey(seed: int) -> DepthSurvey:
    """Three images from every pose."""
    return survey_arena(arena(), np.random.default_rng(seed), repeats=REPEATS)


@lru_cache(maxsize=8 * N_SURVEYS)
def evidence(seed: int, cell_size: int, repeats: int, weaker: bool = False) -> Evidence:
    """What 1 or 3 images from each pose say; `weaker` is the sensor model 0.8 and 0.2."""
    p_free, p_occupied = (0.8, 0.2) if weaker else (0.9, 0.1)
    grid = Grid(arena().truth.shape, cell_size, arena().metres_per_pixel)
    return gather_evidence(survey(seed).readings(repeats, p_free=p_free, p_occupied=p_occupied), grid)


def final_map(seed: int, prior: Prior, cell_size: int, repeats: int) -> GridMap:
    """The map after all poses."""
    return update_map(build_prior_map(arena().walls, prior, cell_size), evidence(seed, cell_size, repeats))


def final_score(seed: int, prior: Prior, cell_size: int, repeats: int) -> Score:
    """Its score."""
    return score_map(final_map(seed, prior, cell_size, repeats), arena().truth)


def final_f2(seeds: tuple[int, ...], prior: Prior, cell_size: int, repeats: int) -> Interval:
    """F2 over the surveys."""
    return Interval.of([final_score(seed, prior, cell_size, repeats).f_beta for seed in seeds])


def prior_alone(cell_size: int) -> float:
    """F2 of the plan before the first image."""
    return score_map(build_prior_map(arena().walls, INFORMATIVE, cell_size), arena().truth).f_beta
