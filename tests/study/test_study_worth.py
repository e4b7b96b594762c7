"""What a prior was worth, against pixels counted by hand; a whole run against the step-by-step recursion."""

import math
import warnings

import numpy as np
import pytest

from priorlab.core.building import Truth
from priorlab.core.drawing import Walls
from priorlab.core.grid import Grid
from priorlab.core.grid_map import Prior
from priorlab.core.log_odds import log_odds
from priorlab.core.readings import Evidence
from priorlab.core.score import score_mask
from priorlab.core.sensor import RangeSensor
from priorlab.mapping.other_priors import constant_prior
from priorlab.mapping.prior import build_prior_map
from priorlab.mapping.recursion import update_step_by_step
from priorlab.robot.explore import explore
from priorlab.study.conditions import Condition, run, run_all, vary
from priorlab.study.interval import Interval
from priorlab.study.qualities import QUALITIES, extracted, prior_of_quality, walls_of_quality
from priorlab.study.surveys import thinned
from priorlab.study.thesis_drawings import FINEST, sensor_for, thesis_plan
from priorlab.study.worth import gain_percent, worth_of


def hand_made():
    """Six cells of one pixel: walls at 0, 1 and 2, of which the plan shows 0 and 1, and a wall too many at 3; 4 is space."""
    walls = Walls(np.array([[1, 1, 0, 1, 0, 0]], dtype=np.uint8))
    truth = Truth(np.array([[1, 1, 1, 0, 0, 0]], dtype=bool), np.array([[0, 0, 0, 0, 0, 1]], dtype=bool))
    grid = Grid((1, 6))
    looks = np.array([[0, 1, 1, 1, 0, 0]])
    total = np.array([[0, log_odds(0.1), log_odds(0.1), log_odds(0.9), 0, 0]], dtype=float)
    return walls, truth, Evidence(total, looks, grid, RangeSensor())


def test_worth_of_counts_seen_and_unseen_apart():
    walls, truth, evidence = hand_made()
    worth = worth_of(build_prior_map(walls, Prior()), evidence, truth)
    counts = {name: (s.tp, s.fp, s.fn, s.tn) for name, s in vars(worth).items() if hasattr(s, "tp")}
    assert counts == {
        "informed": (3, 0, 0, 2),  # 0 from the plan, 1 and 2 seen, 3 seen free
        "uninformed": (2, 0, 1, 2),  # 0 was never seen
        "alone": (2, 1, 1, 1),
        "seen_informed": (2, 0, 0, 1),
        "seen_uninformed": (2, 0, 0, 1),
        "unseen": (1, 0, 0, 1),
    }
    assert worth.coverage == pytest.approx(2 / 3) and worth.mean_looks == 1.0 and not worth.overruled
    f2_without = 5 * 2 / (5 * 2 + 4 * 1)
    assert worth.gain_percent == pytest.approx(100 * (1 / f2_without - 1))


def test_worth_tells_of_eq_2_22_in_a_column_not_by_a_warning():
    walls, truth, evidence = hand_made()
    weak = Evidence(evidence.total, evidence.looks, evidence.grid, RangeSensor(p_free=0.8, p_occupied=0.2))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert worth_of(build_prior_map(walls, Prior()), weak, truth).overruled
        assert not worth_of(build_prior_map(walls, Prior()), weak, truth, lam=0.0).overruled


def test_gain_is_nan_when_nothing_was_found_without():
    assert math.isnan(gain_percent(0.5, 0.0)) and gain_percent(0.3, 0.4) == pytest.approx(-25)


def test_interval_of_runs():
    assert Interval.of([1, 4, 1]) == Interval(2.0, 1.0, 4.0)
    with pytest.raises(ValueError, match="values must hold at least one number"):
        Interval.of([])


@pytest.mark.parametrize("lam", [1.0, 0.0])
def test_run_agrees_with_the_recursion(lam):
    condition = Condition("flat_south", spacing=1.2, cell_size=5, lam=lam)
    row = run(condition, seed=3)
    plan = thesis_plan("flat_south", FINEST)
    rng = np.random.default_rng((3, 0)).spawn(3)[0]
    readings = explore(plan.truth, thinned(plan.survey, 24, rng), sensor_for(plan))
    start = build_prior_map(extracted("flat_south").walls, Prior(), 5)
    for prior_map, score in ((start, row.worth.informed), (constant_prior(0.5, start.grid), row.worth.uninformed)):
        slow = update_step_by_step(prior_map, readings, lam)
        expected = score_mask(start.grid.to_image(slow.detected()), plan.truth)
        assert (score.tp, score.fp) == (expected.tp, expected.fp)
    assert row.poses == len(readings)


def test_condition_says_what_no_survey_can_be():
    with pytest.raises(ValueError, match="spacing must be a multiple of 0.05 sensor ranges, got 0.33"):
        Condition("flat_north", spacing=0.33)
    with pytest.raises(ValueError, match=r"explored must lie in \(0, 1\], got 0"):
        Condition("flat_north", explored=0)


def test_runs_are_reproducible_and_seeds_differ():
    base = Condition("flat_north", cell_size=5, quality="poor")
    one, other = run_all([base], seeds=[0, 1])
    assert run(base, 0).as_numbers() == one.as_numbers()
    assert one.worth.informed != other.worth.informed and one.worth.alone != other.worth.alone


def test_more_looks_less_gain_and_less_explored_more_gain():
    def gain(**changed):
        return run(next(vary(Condition("office_section_b", cell_size=3), **{k: [v] for k, v in changed.items()})), 0).worth

    quick, dense = gain(spacing=1.2), gain(spacing=0.2)
    assert dense.mean_looks > 2 * quick.mean_looks and dense.gain_percent < 0 < 50 < quick.gain_percent
    part = gain(spacing=0.3, explored=0.25)
    assert part.coverage < 0.5 and part.unseen.f_beta > 0.8 and part.gain_percent > 100


def test_every_quality_makes_a_prior_map_and_bad_names_are_told():
    grid = Grid(thesis_plan("flat_north").truth.shape, 5)
    truth_f2 = {}
    plan = thesis_plan("flat_north")
    for quality in QUALITIES:
        start = prior_of_quality("flat_north", quality, grid, Prior(), np.random.default_rng(0))
        assert start.grid.shape == grid.shape
        truth_f2[quality] = score_mask(grid.to_image(start.detected()), plan.truth).f_beta
    assert truth_f2["true walls"] >= truth_f2["30 % missing"] > truth_f2["70 % missing"] > truth_f2["0.8 everywhere"] == 0
    with pytest.raises(ValueError, match="did you mean 'poor'"):
        walls_of_quality("flat_north", "pooor", np.random.default_rng(0))
