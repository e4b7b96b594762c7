"""Algorithm 6.1: a drive through a small floor with furniture; the loop against its parts called one after the other."""

from dataclasses import replace

import numpy as np
import pytest

from priorlab.core.building import Truth
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.readings import RobotLog
from priorlab.core.score import score_mask
from priorlab.mapping.overruled import OverruledSensorWarning
from priorlab.slam.estimate import estimate_pose
from priorlab.slam.fastslam import FastSLAM
from priorlab.slam.impassable import Impassable
from priorlab.slam.likelihood_field import LikelihoodField
from priorlab.slam.localization import choose, predict, weigh
from priorlab.slam.map_update import see_cells, update_seen
from priorlab.slam.measurement import share_explained
from priorlab.slam.parameters import TABLE_6_1, TUNED, Parameters
from priorlab.slam.particles import Particles, start_particles
from priorlab.slam.scan import choose_beams, weighing_steps
from priorlab.slam.trajectory_error import absolute_trajectory_error_m, dead_reckoning


def first_steps(log, n):
    """The beginning of a log."""
    return RobotLog(log.odometry[:n], log.ranges[:n], log.bearings, log.scanner, log.start, log.truth[:n])


@pytest.mark.parametrize(
    ("localize_in", "lag_m", "broad"),
    [("updated", 0.0, {}), ("updated", 0.7, {"robot_radius_m": 0.6}), ("static", 0.0, {"robot_radius_m": 0.6})],
)
def test_run_equals_its_parts_called_in_turn(slam_prior, drive_log, localize_in, lag_m, broad):
    log, parameters = first_steps(drive_log, 40), replace(TUNED, localize_in=localize_in, lag_m=lag_m, **broad)
    run = FastSLAM(parameters).run(slam_prior, log, np.random.default_rng(7))

    rng = np.random.default_rng(7)
    particles = start_particles(log.start, 4500, (0, 0, 0), rng)
    log_odds_map, plan = slam_prior.log_odds.copy(), LikelihoodField.of(slam_prior, parameters)
    impassable, n_charged = Impassable.of(slam_prior, parameters), 0
    weighs = weighing_steps(log, parameters)
    assert 10 < weighs.sum() < 40
    for k in range(40):
        # map and field are made anew from all scans in every step: the run only repairs a window of them
        behind, way = slam_prior.log_odds.copy(), np.hypot(*np.diff(log.odometry[:, :2], axis=0).T)
        for i in range(k if localize_in == "updated" else 0):
            if way[i : k - 1].sum() >= lag_m:
                old = see_cells(slam_prior.grid, run.trajectory[i], choose_beams(log, i, parameters), parameters)
                update_seen(behind, slam_prior.log_odds, old, parameters)
        field = LikelihoodField.of(GridMap(behind, slam_prior.grid), parameters)
        scan = choose_beams(log, k, parameters)
        stood = particles.log_weights
        particles = predict(particles, log.odometry[max(k - 1, 0)], log.odometry[k], rng, parameters, impassable)
        n_charged += int((particles.log_weights < stood).sum())
        if weighs[k]:
            particles = weigh(particles, scan, field)
        pose = estimate_pose(particles, parameters)
        assert np.array_equal(pose, run.trajectory[k])
        assert np.array_equal(run.explained[k], share_explained(pose, scan, plan), equal_nan=True)
        assert (len(particles), particles.effective_number) == (run.n_particles[k], run.ess[k])
        particles = choose(particles, rng, parameters) if weighs[k] else particles
        update_seen(log_odds_map, slam_prior.log_odds, see_cells(slam_prior.grid, pose, scan, parameters), parameters)
    assert np.array_equal(log_odds_map, run.map.log_odds)
    assert n_charged > 1000 or not broad  # walls took their share


def test_run_equals_start_steps_and_finish(slam_prior, drive_log):
    log, slam = first_steps(drive_log, 25), FastSLAM(localize_in="updated", resampling_interval=2)
    run = slam.run(slam_prior, log, np.random.default_rng(3))
    state, weighs = slam.start(slam_prior, log, np.random.default_rng(3)), weighing_steps(log, slam.parameters)
    for k in range(len(log)):
        assert not state.done and state.step == k
        before = state.particles
        step = slam.step(state)
        assert step.number == k and np.array_equal(step.pose, run.trajectory[k])
        assert (step.moved.log_weights <= before.log_weights).all()  # moving tells nothing but where walls are
        assert np.array_equal(step.weighed.poses, step.moved.poses)
        assert (step.weighed is not step.moved) == weighs[k] and state.particles is step.particles
        assert (step.particles is not step.weighed) == (weighs[k] and weighs[: k + 1].sum() % 2 == 0)
        assert np.array_equal(state.map.log_odds, run.at(k).log_odds)
    assert state.done and f"before step {len(log)}" in repr(state) and f"Step({len(log) - 1}" in repr(step)
    with pytest.raises(ValueError, match="step must be below the 25 scans of the log, got 25"):
        slam.step(state)
    assert np.array_equal(slam.finish(state).map.log_odds, run.map.log_odds)


@pytest.mark.parametrize("localize_in", ["updated", "static"])
def test_state_taken_up_again_goes_on_as_if_nothing_had_happened(slam_prior, drive_log, localize_in):
    log, slam = first_steps(drive_log, 30), FastSLAM(localize_in=localize_in)
    whole = slam.run(slam_prior, log, np.random.default_rng(3))
    first = slam.start(slam_prior, log, np.random.default_rng(3))
    for _ in range(12):
        slam.step(first)
    kept = first.rng.bit_generator.state, first.particles, first.log_odds.copy()
    while not first.done:  # goes on: what was kept must not hang on it
        slam.step(first)

    again = slam.start(slam_prior, log, np.random.default_rng(99))
    again.rng.bit_generator.state, again.particles = kept[0], Particles(kept[1].poses, kept[1].log_weights)
    again.step = 12
    for k in range(12):
        slam.map_scan(again, k, whole.trajectory[k])
    assert np.array_equal(again.log_odds, kept[2])
    while not again.done:
        slam.step(again)
    assert np.array_equal(again.recorder.poses, whole.trajectory[12:])
    assert np.array_equal(again.log_odds, whole.map.log_odds)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_updated_map_also_shows_the_way(slam_prior, seed, drive_floor):
    log = drive_floor(seed)
    run = FastSLAM(localize_in="updated").run(slam_prior, log, np.random.default_rng(100 + seed))
    assert run.ate_m() <= 0.3 and not run.lost
    assert run.ate_m() < 0.6 * absolute_trajectory_error_m(dead_reckoning(log), log.truth)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_tuned_finds_its_way_among_furniture(slam_prior, floor, seed, drive_floor):
    log = drive_floor(seed)
    run = FastSLAM().run(slam_prior, log, np.random.default_rng(100 + seed))
    assert run.ate_m(log) <= 0.3  # issue 5
    assert run.ate_m(log) < 0.6 * absolute_trajectory_error_m(dead_reckoning(log), log.truth)
    assert run.heading_error_deg() < 3
    assert not run.lost
    assert (run.n_particles >= 1500).all() and (run.n_particles <= 4500).all()


def test_prior_beats_no_prior_on_the_same_poses(slam_prior, drive_log, floor, prior_of):
    run = FastSLAM().run(slam_prior, drive_log, np.random.default_rng(0))
    truth = Truth(floor[0], np.zeros_like(floor[0]))
    with_plan = score_mask(run.map.detected(0.5), truth).f_beta
    without = run.remap(prior_of(floor[0], Prior.uninformed()))
    # an unseen cell of the uninformed map stands exactly on 0.5: it is no wall
    assert with_plan > 1.3 * score_mask(without.log_odds < -1e-9, truth).f_beta


def test_table_6_1_gets_lost(slam_prior, drive_log):
    run = FastSLAM(TABLE_6_1).run(slam_prior, drive_log, np.random.default_rng(0))
    assert run.ate_m() > 1.0
    assert run.lost and "LOST" in repr(run)


def test_same_seed_same_run_bit_for_bit(slam_prior, drive_log):
    log = first_steps(drive_log, 60)
    one, two, other = (FastSLAM().run(slam_prior, log, np.random.default_rng(seed)) for seed in (4, 4, 5))
    for name in ("trajectory", "n_particles", "ess", "sample", "explained"):
        assert np.array_equal(getattr(one, name), getattr(two, name), equal_nan=True)
    assert np.array_equal(one.map.log_odds, two.map.log_odds)
    assert not np.array_equal(one.trajectory, other.trajectory)


def test_run_leaves_the_prior_map_as_it_was(slam_prior, drive_log):
    before = slam_prior.log_odds.copy()
    FastSLAM().run(slam_prior, first_steps(drive_log, 20), np.random.default_rng(0))
    assert np.array_equal(slam_prior.log_odds, before)


def test_inaccurate_start_is_absorbed(slam_prior, drive_log):
    run = FastSLAM(start_variances=(0.1, 0.1, 0.1)).run(slam_prior, drive_log, np.random.default_rng(1))
    assert np.hypot(*(run.trajectory - drive_log.truth)[80:, :2].T).max() < 0.5
    assert run.n_particles[:20].max() > 2000  # the spread asks for more particles


def test_scan_without_a_return_is_skipped(slam_prior, drive_log):
    log = first_steps(drive_log, 30)
    ranges = log.ranges.copy()
    ranges[10:14] = np.nan
    ranges[20] = np.inf
    blind = RobotLog(log.odometry, ranges, log.bearings, log.scanner, log.start, log.truth)
    run = FastSLAM().run(slam_prior, blind, np.random.default_rng(0))
    assert np.isfinite(run.trajectory).all() and run.ate_m() < 0.3
    assert np.array_equal(run.at(13).log_odds, run.at(9).log_odds)
    assert np.isnan(run.explained[10:14]).all() and not run.lost


def test_particles_that_all_leave_the_map_stay_finite(slam_prior, drive_log):
    log = first_steps(drive_log, 30)
    odometry = log.odometry.copy()
    odometry[5:, :2] += 500.0  # a wheel slips into the next town
    run = FastSLAM().run(
        slam_prior, RobotLog(odometry, log.ranges, log.bearings, log.scanner, log.start), np.random.default_rng(0)
    )
    assert np.isfinite(run.trajectory).all() and np.isfinite(run.map.log_odds).all()
    assert run.ess[6] == pytest.approx(run.n_particles[6])
    assert "leapt" in run.lost_because or "in walls of the plan" in run.lost_because


def test_resampling_interval_lets_the_weights_pile_up(slam_prior, drive_log):
    log = first_steps(drive_log, 9)
    run = FastSLAM(resampling_interval=3, weigh_every_m=0, weigh_every_theta=0).run(slam_prior, log, np.random.default_rng(0))
    assert run.ess[5] < run.ess[3] and run.ess[8] < run.ess[6]
    assert run.n_particles.tolist()[:3] == [4500] * 3


def test_progress_counts_the_steps(slam_prior, drive_log):
    seen = []
    FastSLAM().run(slam_prior, first_steps(drive_log, 3), np.random.default_rng(0), progress=lambda *n: seen.append(n))
    assert seen == [(1, 3), (2, 3), (3, 3)]


def test_free_space_behind_no_return_only_when_asked(slam_prior, drive_log):
    log = first_steps(drive_log, 10)
    looked = [
        (
            FastSLAM(free_on_no_return=free).run(slam_prior, log, np.random.default_rng(0)).map.log_odds != slam_prior.log_odds
        ).sum()
        for free in (False, True)
    ]
    assert looked[1] > 1.2 * looked[0]


# --- bad input ------------------------------------------------------------------------------------------------------------


def started_at(log, start):
    return RobotLog(log.odometry, log.ranges, log.bearings, log.scanner, np.array(start), log.truth)


@pytest.mark.parametrize(
    ("start", "sentence"),
    [
        ((-1.0, 4.0, 0.0), r"start must lie on the map of 14.00 x 8.00 m, got x -1, y 4 m"),
        ((14.0, 4.0, 0.0), r"start must lie on the map"),
        ((4.6, 6.0, 0.0), r"start must lie in free space, got x 4.6, y 6 m, where the map shows a wall"),
    ],
)
def test_run_says_where_a_robot_cannot_start(slam_prior, drive_log, start, sentence):
    with pytest.raises(ValueError, match=sentence):
        FastSLAM().run(slam_prior, started_at(drive_log, start), np.random.default_rng(0))


def test_run_says_when_the_log_is_empty(slam_prior, drive_log):
    with pytest.raises(ValueError, match="the log must hold at least one scan, got 0"):
        FastSLAM().run(slam_prior, first_steps(drive_log, 0), np.random.default_rng(0))
    with pytest.raises(ValueError, match="prior_map must be a GridMap, got"):
        FastSLAM().run(slam_prior.p_empty, drive_log, np.random.default_rng(0))
    with pytest.raises(ValueError, match="log must be a RobotLog, got"):
        FastSLAM().run(slam_prior, drive_log.ranges, np.random.default_rng(0))


def test_run_says_when_there_is_no_wall_to_localize_by(floor, drive_log, prior_of):
    with pytest.raises(ValueError, match="the map must hold walls to localize in"):
        FastSLAM().run(prior_of(floor[0], Prior.uninformed()), drive_log, np.random.default_rng(0))


def test_run_warns_when_the_prior_is_surer_than_the_sensor(floor, drive_log, prior_of):
    with pytest.warns(OverruledSensorWarning, match=r"the effective p_space 0.9 must lie below the p_free 0.8"):
        FastSLAM().run(prior_of(floor[0], Prior(0.3, 1.0)), first_steps(drive_log, 2), np.random.default_rng(0))


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"alphas": (0.1, -0.1, 0.1, 0.1)}, "alphas must be 4 finite numbers of at least 0"),
        ({"alphas": (0.1, 0.1)}, "alphas must be 4 finite numbers"),
        ({"start_variances": (0.1, np.nan, 0)}, "start_variances must be 3 finite numbers of at least 0"),
        ({"sensor_offset_m": (0.1,)}, "sensor_offset_m must be two finite numbers"),
        ({"particle_limits": (100, 50)}, "particle_limits must be the fewest, at least 1, and the most, got .100, 50."),
        ({"temper": 0}, r"temper must lie in \(0, 1\], got 0"),
        ({"p_through_wall": 0}, r"p_through_wall must lie in \(0, 1\], got 0"),
        ({"p_through_wall": 1.5}, r"p_through_wall must lie in \(0, 1\], got 1.5"),
        ({"robot_radius_m": -0.1}, "robot_radius_m must be a finite number of at least 0, got -0.1"),
        ({"lam": 2}, "lam must lie between 0 and 1, got 2"),
        ({"z_random": 0}, "z_random must lie strictly between 0 and 1, got 0"),
        ({"sigma_hit_m": -1}, "sigma_hit_m must be a finite number above 0, got -1"),
        ({"thickening_m": -0.1}, "thickening_m must be a finite number of at least 0, got -0.1"),
        ({"weigh_every_m": -0.1}, "weigh_every_m must be a finite number of at least 0, got -0.1"),
        ({"weigh_every_theta": np.nan}, "weigh_every_theta must be a finite number of at least 0, got nan"),
        ({"lag_m": -1}, "lag_m must be a finite number of at least 0, got -1"),
        ({"n_beams": 0}, "n_beams must be a whole number of at least 1, got 0"),
        ({"n_beams": 1.5}, "n_beams must be a whole number of at least 1, got 1.5"),
        ({"resampling_interval": np.nan}, "resampling_interval must be a whole number of at least 1, got nan"),
        ({"alphas": 0.2}, "alphas must be 4 finite numbers of at least 0, got 0.2"),
        ({"alphas": (np.inf,) * 4}, "alphas must be 4 finite numbers of at least 0"),
        ({"sensor_offset_m": 0.1}, "sensor_offset_m must be two finite numbers x, y, got 0.1"),
        ({"particle_limits": 500}, "particle_limits must be the fewest, at least 1, and the most, got 500"),
        ({"particle_limits": (1.5, 3)}, "particle_limits must be the fewest"),
        ({"lam": "one"}, "lam must be a number, got 'one'"),
        ({"noise": "sd"}, "noise must be one of variance, std, got 'sd'"),
        ({"localize_in": "mine"}, "localize_in must be one of updated, static, own, got 'mine'"),
        ({"p_free": 0.1}, "p_free must be above p_occupied, got 0.1 and 0.2"),
        ({"tempr": 0.1}, "parameter must be one of .*; did you mean 'temper'"),
    ],
)
def test_parameters_say_what_is_wrong(change, sentence):
    with pytest.raises(ValueError, match=sentence):
        FastSLAM(**change)


def test_table_6_1_holds_what_is_printed():
    assert TABLE_6_1.resampling_interval == 1 and TABLE_6_1.particle_limits == (1500, 4500)
    assert TABLE_6_1.alphas == (0.2,) * 4 and TABLE_6_1.max_range_m == 12 and TABLE_6_1.max_distance_m == 2
    assert TABLE_6_1.n_beams == 60 and TABLE_6_1.sigma_hit_m == 0.2 and TABLE_6_1.z_random == 0.05
    assert (TABLE_6_1.p_free, TABLE_6_1.p_occupied) == (0.8, 0.2)
    assert TABLE_6_1.weigh_every_m == TABLE_6_1.weigh_every_theta == TABLE_6_1.lag_m == 0  # "for k = 1 : T_end"
    assert TABLE_6_1.lam == 1 and TABLE_6_1.thickening_m == 0 and TABLE_6_1.localize_in == "updated"
    assert TABLE_6_1.p_through_wall == 1  # algorithm 6.3 knows no walls
    assert TABLE_6_1.temper == 1 and TABLE_6_1.rotation_noise == "literal" and TABLE_6_1.noise == "variance"


def test_fastslam_shows_what_was_changed():
    assert repr(FastSLAM()) == "FastSLAM(TUNED)"
    assert repr(FastSLAM(TUNED, temper=0.1)) == "FastSLAM(TUNED, temper=0.1)"
    assert hash(Parameters(alphas=[0.1] * 4)) == hash(Parameters(alphas=(0.1,) * 4))
