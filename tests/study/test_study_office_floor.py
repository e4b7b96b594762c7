"""The simulated floor as a study: a run of one room, scored another way; seeds apart; lost runs without a gain."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import t

from priorlab.core.grid_map import Prior
from priorlab.core.score import score_map
from priorlab.slam.counting import counted_map
from priorlab.slam.fastslam import FastSLAM
from priorlab.slam.parameters import TUNED
from priorlab.study.added import changes_between
from priorlab.study.confidence import T_95, Confidence
from priorlab.study.office_floor import (
    ALONE,
    COUNTING,
    FLOOR_PRIOR,
    WITH,
    WITHOUT,
    FloorCondition,
    FloorRun,
    drive_floor,
    furnished,
    plan_as_prior,
    run_floor,
)

FEW = replace(TUNED, particle_limits=(200, 200))
ONE_ROOM = FloorCondition(clutter=None, tour_share=0.06, parameters=FEW)


@pytest.fixture(scope="module")
def row():
    return run_floor(ONE_ROOM, 0)


def test_run_floor_is_fastslam_on_its_log(row):
    again = FastSLAM(FEW).run(plan_as_prior("extracted", FLOOR_PRIOR), row.run.log, np.random.default_rng(0).spawn(3)[2])
    np.testing.assert_array_equal(row.run.trajectory, again.trajectory)
    assert row.ate_m == again.ate_m() < 0.3


def test_scores_are_those_of_maps_made_one_scan_after_another(row):
    truth, uninformed = row.floor.truth, plan_as_prior("extracted", Prior.uninformed())
    assert row.scores[WITH] == score_map(row.run.map, truth, 0.5)
    assert row.scores[WITHOUT] == score_map(row.run.remap(uninformed), truth, 0.5)
    assert row.scores[COUNTING].f_beta == counted_map(row.run).score(truth).f_beta
    assert row.scores[ALONE] == score_map(row.run.prior_map, truth, 0.5)
    assert row.coverage == pytest.approx(row.run.coverage(truth))
    assert row.gain_percent == pytest.approx(100 * (row.scores[WITH].f_beta / row.scores[WITHOUT].f_beta - 1))


def test_added_counts_what_was_seen_and_nothing_else(row):
    added, counted = row.added, counted_map(row.run)
    changes = changes_between(row.floor.truth, row.floor.world, row.run.map.grid)
    blocked = changes.blocked & (counted.hits + counted.misses > 0)
    assert 0 < added.blocked.seen == blocked.sum() < added.blocked.cells == changes.blocked.sum()
    assert added.blocked.right[WITH] == (blocked & (row.run.map.p_empty < 0.5 - 1e-9)).sum()
    assert added.blocked.right[COUNTING] == (blocked & (counted.hits > counted.misses)).sum()
    assert added.blocked.right[ALONE] == (blocked & (row.run.prior_map.p_empty < 0.5)).sum()
    doorways = sorted(int(doorway.sum()) for doorway in changes.doorways)
    assert sorted(doorway.cells for doorway in added.doorways) == doorways and len(doorways) == 2


@pytest.mark.parametrize("lam", [0.0, 1.0])
@pytest.mark.parametrize("thickening_m", [0.0, 0.2])
def test_mapped_is_the_map_that_a_filter_of_these_values_makes(row, lam, thickening_m):
    # localized in the plan, the robot goes the same way whatever becomes of the map
    run = FastSLAM(FEW, lam=lam, thickening_m=thickening_m).run(
        row.run.prior_map, row.run.log, np.random.default_rng(0).spawn(3)[2]
    )
    np.testing.assert_allclose(row.mapped(FLOOR_PRIOR, lam, thickening_m).log_odds, run.map.log_odds, atol=1e-9)


def test_f2_over_time_starts_with_the_plan_and_ends_with_the_scores(row):
    curves = row.f2_over_time()
    assert curves.f_beta[WITH][0] == pytest.approx(row.scores[ALONE].f_beta)
    assert curves.f_beta[WITH][-1] == pytest.approx(row.scores[WITH].f_beta)
    assert curves.f_beta[WITHOUT][-1] == pytest.approx(row.scores[WITHOUT].f_beta)


def test_a_lost_run_has_no_gain(row):
    astray = replace(row.run, trajectory=row.run.trajectory + [1.5, 0.0, 0.0])
    lost = FloorRun(row.condition, row.seed, row.floor, astray)
    assert lost.gain_percent is None and lost.as_numbers()["gain_percent"] is None
    assert "off the true position" in lost.as_numbers()["lost_because"]


def test_another_filter_drives_through_the_same_data():
    _, log = drive_floor(None, 0.002, 0.06, 0)
    assert run_floor(replace(ONE_ROOM, parameters=replace(FEW, temper=0.1)), 0).run.log is log


def test_wheels_scanner_and_furniture_have_seeds_apart():
    floor, log = drive_floor(None, 0.002, 0.06, 1)
    _, worse_wheels = drive_floor(None, 0.02, 0.06, 1)
    np.testing.assert_array_equal(log.ranges, worse_wheels.ranges)
    np.testing.assert_array_equal(log.truth, worse_wheels.truth)
    assert np.abs(log.odometry - worse_wheels.odometry).max() > 0
    assert (drive_floor(None, 0.002, 0.06, 2)[0].world.obstacles == floor.world.obstacles).all()  # the description's furniture
    loose = [furnished(0.3, 0.06, seed) for seed in (1, 2)]
    assert (loose[0].world.obstacles != loose[1].world.obstacles).any() and (loose[0].truth.walls == loose[1].truth.walls).all()


def test_without_a_plan_the_map_holds_only_what_was_seen():
    row = run_floor(replace(ONE_ROOM, plan="none"), 0)
    seen = row.evidence.seen | (row.run.prior_map.log_odds != 0)
    assert (row.run.map.log_odds[~seen] == 0).all() and (row.run.map.log_odds[seen] != 0).any()
    assert row.run.parameters.lam == 0 and row.run.parameters.localize_in == "updated"  # the first scan counts as a scan


def test_the_filter_takes_worse_wheels_for_worse():
    assert FloorCondition().filter == TUNED
    assert FloorCondition(odometry=0.02).filter.alphas[0] > TUNED.alphas[0]
    own = replace(TUNED, alphas=(0.3,) * 4)
    assert FloorCondition(odometry=0.02, parameters=own).filter == own


def test_confidence_of_by_hand():
    # 1, 2, 3: mean 2, s = 1, t for two degrees of freedom 4.303
    known = Confidence.of([1, 2, 3])
    assert known.row == pytest.approx((2, 2 - 4.303 / np.sqrt(3), 2 + 4.303 / np.sqrt(3)))
    assert known.as_numbers()["by_seed"] == [1, 2, 3]


def test_confidence_knows_students_t():
    assert pytest.approx(t.ppf(0.975, np.arange(1, 16)), abs=1e-3) == T_95


@pytest.mark.parametrize("values", [[1.0], [], [1.0, np.nan], list(range(17))])
def test_confidence_of_too_few_or_too_many_is_refused(values):
    with pytest.raises(ValueError, match="values must be 2 to 16 finite numbers"):
        Confidence.of(values)
