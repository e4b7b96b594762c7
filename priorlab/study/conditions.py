"""Chapter 5 as a table: one row for each building, survey, cell size, sensor, update, quality of the prior - and seed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from functools import lru_cache
from itertools import product
from typing import Any

import numpy as np

from priorlab.buildings.floor_plans import load_floor_plan
from priorlab.core.grid import Grid
from priorlab.core.grid_map import Prior
from priorlab.core.readings import Evidence
from priorlab.mapping.evidence import gather_evidence
from priorlab.robot.explore import EXACT, explore
from priorlab.robot.range_noise import RangeNoise
from priorlab.study.qualities import prior_of_quality
from priorlab.study.surveys import part_of, thinned
from priorlab.study.thesis_drawings import FINEST, QUICK, sensor_for, thesis_plan
from priorlab.study.worth import Worth, worth_of

SEEDS = (0, 1, 2, 3, 4)
"""Each seed draws its own survey (first lane, first pose and first side on every lane, explored part), damage and noise."""


@dataclass(frozen=True)
class Condition:
    """Everything about one run but the seed.

    Parameters
    ----------
    building : name of a bundled building
    spacing : between the poses, in sensor ranges; a multiple of `FINEST`
    cell_size : pixels
    explored : share of the poses that the robot gets to
    quality : of the prior, one of `QUALITIES`
    prior : p_wall and p_space
    lam : weight of the prior in the update
    p_free, p_occupied : the inverse sensor model
    noise : faults of the sensor, pixels
    """

    building: str
    spacing: float = QUICK
    cell_size: float = 3
    explored: float = 1.0
    quality: str = "extracted"
    prior: Prior = Prior()
    lam: float = 1.0
    p_free: float = 0.9
    p_occupied: float = 0.1
    noise: RangeNoise = EXACT

    def __post_init__(self) -> None:
        every = self.spacing / FINEST
        if every < 1 - 1e-9 or abs(every - round(every)) > 1e-9:
            raise ValueError(f"spacing must be a multiple of {FINEST:g} sensor ranges, got {self.spacing:g}")
        if not 0 < self.explored <= 1:
            raise ValueError(f"explored must lie in (0, 1], got {self.explored:g}")


@dataclass(frozen=True)
class Row:
    """What one condition gave with one seed."""

    condition: Condition
    seed: int
    poses: int
    worth: Worth

    def as_numbers(self) -> dict[str, Any]:
        """Plain data, one flat row."""
        told, worth = self.condition, self.worth
        return {
            **{key: value for key, value in asdict(told).items() if key not in ("prior", "noise")},
            "p_wall": told.prior.p_wall,
            "p_space": told.prior.p_space,
            "range_deviation": told.noise.deviation,
            "seed": self.seed,
            "poses": self.poses,
            "coverage": worth.coverage,
            "mean_looks": worth.mean_looks,
            "f2_with_prior": worth.informed.f_beta,
            "f2_without": worth.uninformed.f_beta,
            "f2_prior_alone": worth.alone.f_beta,
            "f2_with_prior_where_seen": worth.seen_informed.f_beta,
            "f2_without_where_seen": worth.seen_uninformed.f_beta,
            "f2_with_prior_where_unseen": worth.unseen.f_beta,
            "gain_percent": worth.gain_percent,
            "breaks_eq_2_22": worth.overruled,
        }


def run(condition: Condition, seed: int) -> Row:
    """One survey of one building: explore, gather, update with the prior and without, score."""
    looked = replace(condition, quality="extracted", prior=Prior(), lam=1.0)  # what the readings do not depend on
    poses, evidence = _explored(looked, seed)
    prior_map = prior_of_quality(
        condition.building, condition.quality, evidence.grid, condition.prior, np.random.default_rng((seed, 1))
    )
    truth = load_floor_plan(condition.building).truth
    return Row(condition, seed, poses, worth_of(prior_map, evidence, truth, condition.lam))


@lru_cache(maxsize=64)
def _explored(condition: Condition, seed: int) -> tuple[int, Evidence]:
    """How many poses a survey has, and what it saw; kept while priors are compared on it."""
    rng_survey, rng_part, rng_noise = np.random.default_rng((seed, 0)).spawn(3)
    plan = thesis_plan(condition.building, FINEST)
    survey = thinned(plan.survey, round(condition.spacing / FINEST), rng_survey)
    if condition.explored < 1:
        survey = part_of(survey, condition.explored, rng_part)
    sensor = sensor_for(plan, condition.p_free, condition.p_occupied)
    grid = Grid(plan.truth.shape, condition.cell_size, plan.metres_per_pixel)
    return len(survey), gather_evidence(explore(plan.truth, survey, sensor, rng_noise, condition.noise), grid)


def run_all(conditions: Sequence[Condition], seeds: Sequence[int] = SEEDS) -> list[Row]:
    """A row for each condition and seed, in this order."""
    return [run(condition, seed) for condition in conditions for seed in seeds]


def vary(base: Condition, **values: Sequence[Any]) -> Iterator[Condition]:
    """Every combination of some values in place of the base's.

    >>> [(c.building, c.cell_size) for c in vary(Condition("flat_north"), building=["flat_north", "flat_south"], cell_size=[3])]
    [('flat_north', 3), ('flat_south', 3)]
    """
    for chosen in product(*values.values()):
        yield replace(base, **dict(zip(values, chosen, strict=True)))
