"""What the prior is worth in a quick survey, and what the update does to it, on every bundled building (chapters 4 and 5).

These are the claims that hold; those that depend on the building are left alone: the gain in a dense survey, whether (0.2, 0.9)
is on the front, the optimum of a weaker sensor.
"""

import functools
import math
import warnings

import numpy as np
import pytest

from priorlab.buildings.floor_plans import floor_plan_names, load_floor_plan, sensor_range
from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.readings import Readings
from priorlab.core.sensor import RangeSensor
from priorlab.mapping.evidence import gather_evidence
from priorlab.mapping.overruled import OverruledSensorWarning
from priorlab.mapping.prior import build_prior_map
from priorlab.mapping.recursion import update_step_by_step
from priorlab.mapping.update import update_map
from priorlab.optimize.experiment import Experiment
from priorlab.robot.explore import explore
from priorlab.study.qualities import extracted

BUILDINGS = floor_plan_names()
QUICK = 1.5
"""Mean looks at a seen cell of a quick survey: poses as far apart as the sensor reaches."""

buildings = pytest.mark.parametrize("name", BUILDINGS)


@functools.cache
def surveyed(name):
    """A building, its extracted walls and a quick survey of it."""
    plan = load_floor_plan(name)
    reach = sensor_range(plan.truth)
    quick = load_floor_plan(name, survey_spacing=reach)
    return plan.truth, extracted(name).walls, explore(plan.truth, quick.survey, RangeSensor(max_range=reach))


@functools.cache
def experiment(name, cell_size):
    truth, walls, readings = surveyed(name)
    return Experiment(walls, gather_evidence(readings, Grid(walls.shape, cell_size)), truth)


def update_quietly(prior_map, evidence, lam=1.0):
    """The update of a prior that may break eq. 2.22."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", OverruledSensorWarning)
        return update_map(prior_map, evidence, lam)


# --- what the prior is worth ---------------------------------------------------------------------------------------------


@buildings
@pytest.mark.parametrize("cell_size", [1, 2, 3, 5])
def test_a_quick_survey_gains_a_fifth_or_more_from_the_plan(name, cell_size):
    """Figure 5.8's claim, with the condition that it needs."""
    one = experiment(name, cell_size)
    assert 1 < one.evidence.mean_looks < QUICK
    informed, uninformed = one.score(Prior(0.2, 0.9)).f_beta, one.score(Prior.uninformed()).f_beta
    assert informed >= 1.2 * uninformed


@buildings
@pytest.mark.parametrize("cell_size", [2, 3])
def test_p_space_03_reaches_the_highest_precision_of_the_thesis_grid(name, cell_size):
    """Table 4.1, to the hundredths of a percent that it prints: 0.3 is the first value above 0.2 / 0.9."""
    table = experiment(name, cell_size).sweep().grid()
    assert table.p_space[2] == 0.3
    assert 100 * (np.nanmax(table.precision) - np.nanmax(table.precision[:, 2])) < 0.01


@buildings
def test_an_f2_optimal_p_wall_lies_just_below_the_threshold(name):
    """0.2222 x 0.9 = 0.2: the highest prior that is still a detected wall."""
    best = experiment(name, 3).sweep().best("f_beta")
    assert any(plateau.p_wall.low <= 0.2 / 0.9 + 1e-9 and plateau.p_wall.high >= 0.2 for plateau in best.plateaus)


# --- what the update does ------------------------------------------------------------------------------------------------


@buildings
def test_closed_form_equals_recursion_and_the_order_does_not_matter(name):
    _, walls, readings = surveyed(name)
    rng = np.random.default_rng(len(name))
    some = readings[rng.integers(0, len(readings), 25)]  # some poses more than once
    prior_map = build_prior_map(walls, Prior(*rng.uniform(0.1, 1.0, 2)), rng.choice([2, 3, 2.5]))
    for lam in (0.0, 1.0, rng.uniform(0, 2)):
        evidence = gather_evidence(some, prior_map.grid)
        closed = update_quietly(prior_map, evidence, lam).log_odds
        np.testing.assert_allclose(closed, update_step_by_step(prior_map, some, lam).log_odds, rtol=0, atol=1e-9)
        shuffled = gather_evidence(some[rng.permutation(len(some))], prior_map.grid)
        np.testing.assert_allclose(update_quietly(prior_map, shuffled, lam).log_odds, closed, rtol=0, atol=1e-9)


@buildings
def test_a_higher_prior_moves_the_map_one_way_for_each_update(name):
    """Cells seen once forget the prior (lam = 1); seen more often a higher prior makes more wall; with lam = 0 always less."""
    one = experiment(name, 3)
    looks = one.evidence.looks
    assert (looks == 1).any() and (looks > 1).any()
    priors = [Prior(p, p) for p in (0.2, 0.4, 0.6, 0.8, 1.0)]
    maps = {lam: [constant(prior, one.evidence.grid) for prior in priors] for lam in (0.0, 1.0)}
    after = {lam: np.array([update_quietly(start, one.evidence, lam).log_odds for start in maps[lam]]) for lam in maps}
    np.testing.assert_allclose(np.ptp(after[1.0][:, looks == 1], axis=0), 0, atol=1e-9)
    assert (np.diff(after[1.0][:, looks > 1], axis=0) < 0).all()
    assert (np.diff(after[0.0], axis=0) > 0).all()


def constant(prior, grid):
    """A map that starts with the prior's p_wall everywhere."""
    p = prior.effective_p_wall
    return GridMap(np.full(grid.shape, math.log(p / (1 - p))), grid, prior)


@buildings
def test_free_readings_never_change_the_prior_1_with_the_sensor_09(name):
    """1.0 x 0.9 is what a free reading says: it carries nothing (eq. 2.22), and a wall reading counts twice."""
    _, walls, readings = surveyed(name)
    nothing_met = Readings(
        readings.poses, np.full(readings.ranges.shape, np.inf), readings.bearings, readings.sensor, readings.image_shape
    )
    grid = Grid(walls.shape, 3)
    free, prior_map = gather_evidence(nothing_met, grid), constant(Prior(1.0, 1.0), grid)
    assert free.looks.max() > 3
    np.testing.assert_allclose(update_quietly(prior_map, free).p_empty, 0.9, atol=1e-9)
    seen = gather_evidence(readings, grid)
    wall = (seen.looks == 1) & (seen.total < -2.19)
    moved = update_quietly(prior_map, seen).log_odds - prior_map.log_odds
    assert wall.any()
    np.testing.assert_allclose(moved[wall], -2 * math.log(9), atol=1e-9)
