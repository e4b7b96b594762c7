"""The simulated floor of thesis 6.2.1: one drive for each seed, every map that its poses and scans can make, and their scores.

Each seed draws its own furniture, the faults of the wheels, those of the scanner and the particles, all apart: another filter
drives through the same data. Priors, weights of the prior and the depth of walls change nothing about where a robot takes itself
to be as long as it localizes in the plan, so they are compared on one run.

    from priorlab.study.office_floor import FloorCondition, run_floor
    print(run_floor(FloorCondition(), seed=0))
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import Any

import numpy as np

from priorlab.buildings.description import read_description
from priorlab.buildings.floor_plans import build_floor_plan, load_floor_plan
from priorlab.buildings.loose_furniture import with_loose_furniture
from priorlab.core.building import FloorPlan
from priorlab.core.drawing import Walls
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.readings import Evidence, RobotLog
from priorlab.core.score import Score, score_map
from priorlab.core.sensor import KINECT, Odometry
from priorlab.core.shipped import data_folder
from priorlab.mapping.over_time import OverTime, score_over_time
from priorlab.mapping.overruled import OverruledSensorWarning
from priorlab.mapping.prior import build_prior_map
from priorlab.mapping.timeline import EvidenceOverTime
from priorlab.mapping.update import update_map
from priorlab.robot.drive import drive
from priorlab.slam.counting import CountedMap
from priorlab.slam.fastslam import FastSLAM
from priorlab.slam.first_scan import map_of_first_scan
from priorlab.slam.parameters import TUNED, Parameters
from priorlab.slam.recording import Run
from priorlab.slam.run_evidence import evidence_of_run
from priorlab.slam.trajectory_error import absolute_trajectory_error_m, dead_reckoning, true_poses
from priorlab.study.added import Added, ShowsWalls, changes_between, what_was_added
from priorlab.study.qualities import walls_of_quality
from priorlab.study.worth import gain_percent

BUILDING = "office_floor"

SEEDS = (0, 1, 2, 3, 4)

FLOOR_PRIOR = Prior(p_wall=0.3, p_space=0.8)
"""Table 6.1: effective 0.27 and 0.72."""

CELL_M = 0.05

THRESHOLD = 0.5
"""Chapter 6 takes a cell for a wall when P(empty) is below this."""

INCOMPLETE = 0.4
"""Share of the rooms that an incomplete exploration visits (fig. 6.7)."""

NO_PLAN = "none"

WITH, WITHOUT, COUNTING, ALONE = MAPS = ("with the plan", "without (0.5)", "counting", "the plan alone")
"""The four maps of every comparison: of the same poses and scans the first three, the last of none."""

ALPHAS = {0.002: TUNED.alphas, 0.02: (0.05, 0.05, 0.05, 0.05)}
"""What the filter takes the wheels for, by their noise; for any other it takes twice the noise."""


@dataclass(frozen=True)
class FloorCondition:
    """Everything about a drive and its filter but the seed.

    Parameters
    ----------
    clutter : about four times as many pieces of furniture a room that the plan lacks; None is the furniture of the description
    odometry : alpha_1..4 of the wheels, variances per squared metre or radian of a step
    tour_share : of the rooms that are visited
    plan : the walls that the prior is made of, one of `QUALITIES` that has walls; "none" is no plan at all: the map starts from
        the first scan
    parameters : of the filter; its `alphas` are replaced by what fits `odometry` unless they were changed
    """

    clutter: float | None = 0.3
    odometry: float = 0.002
    tour_share: float = 1.0
    plan: str = "extracted"
    parameters: Parameters = TUNED

    @property
    def filter(self) -> Parameters:
        """The parameters with the alphas that fit the wheels."""
        if self.parameters.alphas != TUNED.alphas:
            return self.parameters
        return replace(self.parameters, alphas=ALPHAS.get(self.odometry, (2 * self.odometry,) * 4))


@dataclass(frozen=True, eq=False)
class FloorRun:
    """One drive, localized, and all maps of it.

    Parameters
    ----------
    condition, seed : which
    floor : the plan with the world of this seed
    run : what the filter did
    """

    condition: FloorCondition
    seed: int
    floor: FloorPlan
    run: Run

    # --- where was the robot? ------------------------------------------------------------------------------------

    @property
    def ate_m(self) -> float:
        """Absolute trajectory error, metres."""
        return self.run.ate_m()

    @property
    def dead_reckoning_m(self) -> float:
        """ATE of the wheels alone, metres."""
        return absolute_trajectory_error_m(dead_reckoning(self.run.log), true_poses(self.run.log))

    # --- maps ----------------------------------------------------------------------------------------------------

    @property
    def looks(self) -> EvidenceOverTime:
        """What every scan said about every cell; a third of a second and a million looks, so it is not kept."""
        return evidence_of_run(self.run)

    @cached_property
    def evidence(self) -> Evidence:
        """What all scans said."""
        return self.looks.at(len(self.run))

    @cached_property
    def counted(self) -> CountedMap:
        """The map that only counts."""
        return CountedMap.of(self.evidence)

    def prior_map(self, prior: Prior = FLOOR_PRIOR, quality: str | None = None) -> GridMap:
        """A prior of the plan that the robot had, or of another one."""
        plan = quality or ("extracted" if self.condition.plan == NO_PLAN else self.condition.plan)
        return plan_as_prior(plan, prior)

    def mapped(self, prior: Prior, lam: float | None = None, thickening_m: float | None = None) -> GridMap:
        """The map that the same poses and scans make of another prior, weight of the prior, or depth of walls."""
        parameters = self.run.parameters
        evidence = self.evidence
        if thickening_m is not None and thickening_m != parameters.thickening_m:
            evidence = evidence_of_run(self.run, replace(parameters, thickening_m=thickening_m)).at(len(self.run))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", OverruledSensorWarning)  # a trap is shown on purpose
            return update_map(self.prior_map(prior), evidence, parameters.lam if lam is None else lam)

    @cached_property
    def informed(self) -> GridMap:
        """With the plan as prior."""
        return self.run.map

    @cached_property
    def uninformed(self) -> GridMap:
        """From 0.5 everywhere."""
        return self.mapped(Prior.uninformed())

    # --- scores --------------------------------------------------------------------------------------------------

    @cached_property
    def scores(self) -> dict[str, Score]:
        """At P(empty) < 0.5: with the plan, without it, counting alone, and the plan untouched."""
        truth = self.floor.truth
        return {
            WITH: score_map(self.informed, truth, THRESHOLD),
            WITHOUT: score_map(self.uninformed, truth, THRESHOLD),
            COUNTING: self.counted.score(truth, THRESHOLD),
            ALONE: score_map(self.run.prior_map, truth, THRESHOLD),
        }

    @property
    def gain_percent(self) -> float | None:
        """Gain in F2 of the plan over no plan, percent; None of a lost robot, whose gain means nothing."""
        return None if self.run.lost else gain_percent(self.scores[WITH].f_beta, self.scores[WITHOUT].f_beta)

    @cached_property
    def coverage(self) -> float:
        """Share of the true wall pixels that lie in a cell that was looked at."""
        truth = self.floor.truth
        seen = self.run.map.grid.to_image(self.evidence.seen)
        return float(seen[truth.walls & ~truth.ignore].mean())

    @cached_property
    def added(self) -> Added:
        """What each map shows of the changes that the robot saw."""
        changes = changes_between(self.floor.truth, self.floor.world, self.run.map.grid)
        maps: dict[str, ShowsWalls] = {
            WITH: self.informed,
            WITHOUT: self.uninformed,
            COUNTING: self.counted,
            ALONE: self.run.prior_map,
        }
        return what_was_added(changes, self.evidence.seen, maps, THRESHOLD)

    def f2_over_time(self, every: int = 1) -> OverTime:
        """F2 after every step, with the plan and without."""
        priors = {WITH: self.run.prior_map, WITHOUT: self.prior_map(Prior.uninformed())}
        return score_over_time(self.looks, priors, self.floor.truth, self.run.parameters.lam, THRESHOLD, every=every)

    def as_numbers(self) -> dict[str, Any]:
        """Plain data, one flat row."""
        return {
            "seed": self.seed,
            "steps": len(self.run),
            "ate_m": self.ate_m,
            "rpe_m": self.run.rpe_m(),
            "rpe_deg": self.run.rpe_deg(),
            "heading_error_deg": self.run.heading_error_deg(),
            "dead_reckoning_m": self.dead_reckoning_m,
            "lost_because": self.run.lost_because,
            "mean_particles": float(self.run.n_particles.mean()),
            "coverage": self.coverage,
            **{f"f2, {name}": score.f_beta for name, score in self.scores.items()},
            "gain_percent": self.gain_percent,
        }

    def __repr__(self) -> str:
        f2 = ", ".join(f"{name} {score.f_beta:.2f}" for name, score in self.scores.items())
        gain = f"gain {self.gain_percent:+.0f} %" if self.gain_percent is not None else f"LOST: {self.run.lost_because}"
        return f"FloorRun(seed {self.seed}: ATE {self.ate_m:.2f} m, {100 * self.coverage:.0f} % seen, F2 {f2}, {gain})"


def run_floor(condition: FloorCondition, seed: int) -> FloorRun:
    """Drive over the floor once and localize."""
    floor, log = drive_floor(condition.clutter, condition.odometry, condition.tour_share, seed)
    parameters = condition.filter
    rng_filter = _generators(seed)[2]
    if condition.plan == NO_PLAN:
        prior_map = map_of_first_scan(plan_as_prior("extracted", Prior.uninformed()).grid, log, parameters)
        where = "updated" if parameters.localize_in == "static" else parameters.localize_in
        parameters = replace(parameters, localize_in=where, lam=0.0)
    else:
        prior_map = plan_as_prior(condition.plan, FLOOR_PRIOR)
    return FloorRun(condition, seed, floor, FastSLAM(parameters).run(prior_map, log, rng_filter))


def run_seeds(condition: FloorCondition, seeds: tuple[int, ...] = SEEDS) -> list[FloorRun]:
    """A run for each seed."""
    return [run_floor(condition, seed) for seed in seeds]


@lru_cache(maxsize=6)
def drive_floor(clutter: float | None, odometry: float, tour_share: float, seed: int) -> tuple[FloorPlan, RobotLog]:
    """The floor as it is furnished for a seed, and what the robot recorded there; kept while filters are compared on it."""
    floor = furnished(clutter, tour_share, seed)
    return floor, drive(floor.world, floor.tour, KINECT, Odometry((odometry,) * 4), _generators(seed)[1])


@lru_cache(maxsize=6)
def furnished(clutter: float | None, tour_share: float, seed: int) -> FloorPlan:
    """The floor with the furniture of a seed; the plan is always the same."""
    if clutter is None:
        return load_floor_plan(BUILDING, tour_share=tour_share)
    description = read_description(data_folder() / f"{BUILDING}.toml")
    return build_floor_plan(
        with_loose_furniture(description, clutter, _generators(seed)[0]), tour_share=tour_share, name=BUILDING
    )


@lru_cache(maxsize=6)
def plan_as_prior(quality: str, prior: Prior) -> GridMap:
    """A prior map of the floor's plan in cells of 5 cm."""
    walls = walls_of_quality(BUILDING, quality, np.random.default_rng(0))  # the plans that are compared here draw nothing
    scaled = Walls(walls.labels, load_floor_plan(BUILDING).metres_per_pixel)
    return build_prior_map(scaled, prior, cell_size_m=CELL_M)


def _generators(seed: int) -> list[np.random.Generator]:
    """For the furniture, the robot's wheels and scanner (apart, see `drive`), and the filter."""
    return np.random.default_rng(seed).spawn(3)
