"""A map per particle: against full copies of maps, one array for each particle; tiles against a plain array."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from priorlab.buildings.floor_plans import load_floor_plan
from priorlab.core.drawing import WALL, Walls
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.readings import RobotLog
from priorlab.core.sensor import KINECT, ODOMETRY
from priorlab.mapping.prior import build_prior_map
from priorlab.robot.drive import drive
from priorlab.slam.estimate import estimate_pose
from priorlab.slam.fastslam import FastSLAM
from priorlab.slam.impassable import Impassable
from priorlab.slam.likelihood_field import LikelihoodField
from priorlab.slam.localization import choose, predict
from priorlab.slam.map_update import see_cells, update_seen
from priorlab.slam.measurement import log_weights
from priorlab.slam.own_maps import OwnMaps
from priorlab.slam.parameters import TUNED
from priorlab.slam.particles import Particles, start_particles
from priorlab.slam.scan import Scan, choose_beams, weighing_steps
from priorlab.slam.tiled_map import TILE, TiledMap

OWN = replace(TUNED, localize_in="own", particle_limits=(9, 12), temper=0.3)


def first_steps(log, n):
    return RobotLog(log.odometry[:n], log.ranges[:n], log.bearings, log.scanner, log.start, log.truth[:n])


def drive_with_full_maps(prior_map, log, rng, parameters):
    """Every particle a whole map and a whole field of its own, copied and made anew without thrift."""
    weighs = weighing_steps(log, parameters)
    way = np.cumsum(np.hypot(*np.diff(log.odometry[:, :2], axis=0, prepend=log.odometry[:1, :2]).T))
    particles = start_particles(log.start, parameters.particle_limits[1], parameters.start_variances, rng)
    paths = [[] for _ in range(len(particles))]
    trajectory, heaviest = [], 0
    impassable = Impassable.of(prior_map, parameters)

    def map_along(path, farthest_m):
        """The map that the scans up to some way draw along a path."""
        whole = prior_map.log_odds.copy()
        for i, pose in enumerate(path):
            if way[i] <= farthest_m:
                seen = see_cells(prior_map.grid, pose, choose_beams(log, i, parameters), parameters)
                update_seen(whole, prior_map.log_odds, seen, parameters)
        return whole

    for k in range(len(log)):
        scan = choose_beams(log, k, parameters)
        moved = predict(particles, log.odometry[max(k - 1, 0)], log.odometry[k], rng, parameters, impassable)
        logs = moved.log_weights.copy()
        if weighs[k]:
            for j, path in enumerate(paths):
                drawn = map_along(path, way[max(k - 1, 0)] - parameters.lag_m)
                field = LikelihoodField.of(GridMap(drawn, prior_map.grid), parameters)
                logs[j] += log_weights(moved.poses[j : j + 1], scan, field)[0]
        weighed = Particles(moved.poses, logs)
        trajectory.append(estimate_pose(weighed, parameters))
        particles = choose(weighed, rng, parameters) if weighs[k] else weighed
        ancestors = list(range(len(weighed))) if particles.ancestors is None else particles.ancestors.tolist()
        if len(set(logs.tolist())) > 1:
            heaviest = max(range(len(ancestors)), key=lambda i: logs[ancestors[i]])
        paths = [[*paths[a], pose] for a, pose in zip(ancestors, particles.poses, strict=True)]
    return np.array(trajectory), np.array(paths), heaviest, map_along(paths[heaviest], np.inf)


@pytest.mark.parametrize(
    ("lag_m", "n_steps", "changes"),
    [
        (0.0, 26, {}),
        (0.8, 26, {}),
        (9.0, 26, {}),
        (0.0, 20, {"sigma_hit_m": 0.3, "z_random": 0.3, "max_distance_m": 0.5}),
        (0.8, 26, {"robot_radius_m": 0.6}),
    ],
    ids=["at once", "behind", "all wait", "wide", "broad"],
)
def test_own_maps_agree_with_full_copies(slam_prior, drive_log, lag_m, n_steps, changes):
    log, parameters = first_steps(drive_log, n_steps), replace(OWN, lag_m=lag_m, **changes)
    if "sigma_hit_m" in changes:
        log = replace(log, start=log.start + [0.5, -0.25, 0.1])  # so that beams end far from every wall
    trajectory, paths, heaviest, drawn = drive_with_full_maps(slam_prior, log, np.random.default_rng(3), parameters)
    slam = FastSLAM(parameters)
    state = slam.start(slam_prior, log, np.random.default_rng(3))
    while not state.done:
        slam.step(state)
    run = slam.finish(state)
    assert np.array_equal(run.trajectory, trajectory)
    assert np.array_equal(state.own.paths, paths) and state.own.heaviest == heaviest
    assert len(np.unique(paths[:, -1], axis=0)) > 3  # and there were different ones
    assert np.array_equal(run.map.log_odds, drawn) and np.array_equal(run.path, paths[heaviest])
    assert not np.array_equal(run.path, run.trajectory)
    assert np.array_equal(run.at(-1).log_odds, drawn)


def test_own_maps_redrawn_along_their_paths_go_on_as_before(slam_prior, drive_log):
    log, slam = first_steps(drive_log, 40), FastSLAM(replace(OWN, lag_m=0.6))
    whole = slam.run(slam_prior, log, np.random.default_rng(3))
    first = slam.start(slam_prior, log, np.random.default_rng(3))
    for _ in range(25):
        slam.step(first)
    again = slam.start(slam_prior, log, np.random.default_rng(9))
    scans = [choose_beams(log, k, slam.parameters) for k in range(25)]
    again.own.redraw(first.own.paths.copy(), first.own.heaviest, scans, again.way_m[:25])
    assert all(np.array_equal(one.whole(), two.whole()) for one, two in zip(first.own.maps, again.own.maps, strict=True))
    again.particles, again.step = Particles(first.particles.poses.copy()), 25
    again.rng.bit_generator.state = first.rng.bit_generator.state
    while not again.done:
        slam.step(again)
    assert np.array_equal(again.recorder.poses, whole.trajectory[25:])
    assert np.array_equal(again.map.log_odds, whole.map.log_odds)


def test_own_maps_same_seed_same_run(slam_prior, drive_log):
    log = first_steps(drive_log, 30)
    one, two, other = (FastSLAM(OWN).run(slam_prior, log, np.random.default_rng(seed)) for seed in (4, 4, 5))
    assert np.array_equal(one.trajectory, two.trajectory) and np.array_equal(one.map.log_odds, two.map.log_odds)
    assert not np.array_equal(one.trajectory, other.trajectory)


def test_own_maps_of_thirty_particles_stay_small():
    floor = load_floor_plan("office_floor")
    walls = Walls((floor.truth.walls * WALL).astype(np.uint8), floor.metres_per_pixel)
    prior_map = build_prior_map(walls, Prior(p_wall=0.3, p_space=0.8), cell_size_m=0.05)
    log = drive(floor.world, floor.tour, KINECT, ODOMETRY, np.random.default_rng(0), step_m=0.5)
    log = RobotLog(log.odometry[::3], log.ranges[::3], log.bearings, log.scanner, log.start)  # as many tiles in less time
    slam, most = FastSLAM(localize_in="own", particle_limits=(30, 30)), 0
    state = slam.start(prior_map, log, np.random.default_rng(0))
    while not state.done:
        slam.step(state)
        most = max(most, state.own.nbytes + state.own.paths.nbytes)
    assert prior_map.log_odds.nbytes < most < 50e6  # issue 5; 30 whole maps are 59 MB, their fields 29 more
    assert len(state.own.maps[0].tiles) > 40  # most of the floor was seen


def test_own_maps_say_when_there_are_too_many_particles():
    with pytest.raises(ValueError, match="particle_limits must be at most 100 for a map per particle, got 4500"):
        FastSLAM(localize_in="own")
    assert FastSLAM(localize_in="own", particle_limits=(100, 100)).parameters.particle_limits == (100, 100)


def test_own_maps_survive_a_particle_off_the_map(slam_prior, drive_log):
    log = first_steps(drive_log, 20)
    odometry = log.odometry.copy()
    odometry[5:, :2] += 500.0
    run = FastSLAM(OWN).run(
        slam_prior, RobotLog(odometry, log.ranges, log.bearings, log.scanner, log.start), np.random.default_rng(0)
    )
    assert np.isfinite(run.trajectory).all() and np.isfinite(run.map.log_odds).all()


def test_own_maps_follow_the_heaviest_when_all_weigh_alike_and_fewer_go_on(slam_prior):
    own = OwnMaps(slam_prior, 30, replace(OWN, particle_limits=(10, 30)))
    nothing, poses = Scan(np.empty(0), np.empty(0), np.empty(0)), np.arange(90.0).reshape(30, 3)
    own.update(Particles(poses, np.arange(30.0)), Particles(poses), nothing, 0.0)
    assert own.heaviest == 29
    drawn = np.arange(2, 30, 3)  # ten of them, the last one 29
    own.update(Particles(poses), Particles(poses[drawn], ancestors=drawn), nothing, 1.0)
    assert own.heaviest == 9 and np.array_equal(own.paths[own.heaviest], [poses[29], poses[29]])
    own.update(Particles(poses[drawn]), Particles(poses[:3], ancestors=np.array([0, 1, 2])), nothing, 2.0)
    assert own.heaviest == 0  # it has no copy among those that go on
    assert np.array_equal(own.map_of_heaviest(), slam_prior.log_odds)


window = st.tuples(st.integers(0, 150), st.integers(0, 40), st.integers(0, 200), st.integers(0, 90))


@given(st.lists(window, max_size=6), window, st.integers(0, 999))
@settings(max_examples=40, deadline=None)
def test_tiled_map_agrees_with_a_plain_array(changes, look, seed):
    rng = np.random.default_rng(seed)
    prior = rng.normal(size=(2 * TILE + 40, 3 * TILE + 7))
    tiled, plain, history = TiledMap(prior, {}), prior.copy(), []

    def slices(row, height, col, width):
        return slice(row, min(row + height, prior.shape[0])), slice(col, min(col + width, prior.shape[1]))

    for numbers in changes:
        place = slices(*numbers)
        change = rng.normal(size=prior[place].shape)
        history.append((tiled, plain.copy()))
        tiled = tiled.changed(place, change)
        plain[place] += change
    assert np.array_equal(tiled.whole(), plain)
    assert np.array_equal(tiled.read(slices(*look)), plain[slices(*look)])
    for old_tiled, old_plain in history:  # a change leaves every older map as it was
        assert np.array_equal(old_tiled.whole(), old_plain)


def test_tiled_map_shares_what_did_not_change():
    prior = np.zeros((3 * TILE, 3 * TILE))
    one = TiledMap(prior, {}).changed((slice(0, 150), slice(0, 150)), np.ones((150, 150)))
    change = np.zeros((70, 70))
    change[0, 0] = 1.0  # the window touches four tiles, the change one of them
    two = one.changed((slice(10, 80), slice(10, 80)), change)
    assert [place for place in one.tiles if one.tiles[place] is not two.tiles[place]] == [(0, 0)]
    with pytest.raises(ValueError, match="read-only"):
        two.tiles[0, 0][0, 0] = 5.0
