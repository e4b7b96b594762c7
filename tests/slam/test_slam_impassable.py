"""The motion model with a map: what is impassable, against distances worked out one by one, and what it does to a cloud."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap
from priorlab.slam.checkpoint import resume, run_with_checkpoints
from priorlab.slam.fastslam import FastSLAM
from priorlab.slam.impassable import Impassable
from priorlab.slam.localization import choose, predict
from priorlab.slam.parameters import TABLE_6_1, TUNED
from priorlab.slam.particles import Particles

WALL, FREE, UNKNOWN = math.log(0.27 / 0.73), math.log(0.72 / 0.28), 0.0


def map_of(walls, cell_size=1, metres_per_pixel=0.1):
    """A map of walls in cells."""
    rows, cols = np.shape(walls)
    return GridMap(np.where(walls, WALL, FREE), Grid((rows * cell_size, cols * cell_size), cell_size, metres_per_pixel))


def doorway():
    """6 x 4 m of 0.1 m cells: a wall 0.3 m thick across, x from 2.0 m, with a doorway from y = 1.5 to 2.4 m."""
    walls = np.zeros((40, 60), dtype=bool)
    walls[:, 20:23] = True
    walls[40 - 24 : 40 - 15, 20:23] = False
    return walls


@given(st.integers(0, 2**32 - 1), st.sampled_from([0.0, 0.1, 0.15, 0.25, 0.28, 0.4]), st.sampled_from([1, 2]))
def test_impassable_cells_lie_within_the_radius_of_a_wall(seed, radius_m, cell_size):
    rng = np.random.default_rng(seed)
    walls = rng.random((9, 12)) < 0.06
    parameters = replace(TUNED, robot_radius_m=radius_m)
    cells = Impassable.of(map_of(walls, cell_size), parameters).cells
    side = 0.1 * cell_size
    held = [(int(r), int(c)) for r, c in np.argwhere(walls)]
    for r in range(9):
        for c in range(12):
            assert cells[r, c] == any(math.hypot(r - i, c - j) * side <= radius_m + 1e-9 for i, j in held)


def test_impassable_is_not_what_nobody_knows():
    one = map_of(doorway())
    unknown = GridMap(np.where(doorway(), UNKNOWN, FREE), one.grid)
    assert Impassable.of(one).cells.any() and not Impassable.of(unknown).cells.any()
    assert not Impassable.of(one, replace(TUNED, occupied_below=0.2)).cells.any()  # 0.27 is no obstacle then


@pytest.mark.parametrize(
    ("before", "after", "share"),
    [
        ((1.0, 2.0), (1.5, 2.0), 1.0),  # free ground
        ((1.8, 2.0), (2.1, 2.0), 1.0),  # through the doorway
        ((1.8, 1.0), (2.1, 1.0), 0.1),  # into the wall
        ((2.1, 1.0), (2.2, 1.0), 1.0),  # on inside it: it was charged for already
        ((2.1, 1.0), (2.6, 1.0), 1.0),  # out again
        ((1.8, 1.58), (2.1, 1.58), 0.1),  # the robot grazes the jamb ...
        ((1.8, 1.62), (2.1, 1.62), 1.0),  # ... or does not: two cells lie 0.2 m apart
        ((-5.0, 1.0), (-4.0, 1.0), 1.0),  # off the map
        ((1e9, 1e9), (-1e9, 1e9), 1.0),
    ],
)
def test_a_particle_loses_weight_where_it_drives_into_a_wall(before, after, share):
    impassable = Impassable.of(map_of(doorway()))
    logs = impassable.log_weights(np.array([[*before, 0.3]]), np.array([[*after, 0.3]]))
    assert math.exp(logs.item()) == pytest.approx(share)


def test_off_the_map_nothing_is_impassable():
    walls = np.zeros((5, 5), dtype=bool)
    walls[:, 0] = walls[:, -1] = walls[0] = walls[-1] = True
    there = np.array([[-0.05, 0.05, 0.0], [0.55, 0.25, 0.0], [0.25, -3.0, 0.0], [1e9, -1e9, 0.0]])
    free = np.full((4, 3), 0.25)
    assert Impassable.of(map_of(walls), replace(TUNED, robot_radius_m=0.0)).log_weights(free, there).tolist() == [0, 0, 0, 0]


def test_predict_without_walls_is_algorithm_6_3():
    cloud = Particles(np.random.default_rng(0).normal([1.8, 2.0, 0.0], 0.2, (200, 3)), np.linspace(-1, 0, 200))
    walls = Impassable.of(map_of(doorway()))
    free, held = (
        predict(cloud, [0, 0, 0], [0.4, 0, 0], np.random.default_rng(1), TUNED, impassable) for impassable in (None, walls)
    )
    assert np.array_equal(free.poses, held.poses) and np.array_equal(free.log_weights, cloud.log_weights)
    charged = held.log_weights - free.log_weights
    assert 10 < (charged < 0).sum() < 190 and set(charged.round(9)) == {0.0, round(math.log(0.1), 9)}


def test_a_doorway_tells_where_the_robot_is():
    """No scan at all: a robot that has come through a door was in front of it. Without the plan's walls it may be anywhere."""
    spread = np.random.default_rng(2).normal([1.5, 2.0, 0.0], [0.1, 0.6, 0.02], (4000, 3))
    clouds = {}
    for name, impassable in (("free", None), ("held", Impassable.of(map_of(doorway())))):
        cloud, rng = Particles(spread), np.random.default_rng(3)
        for k in range(12):
            cloud = predict(cloud, [0.1 * k, 0, 0], [0.1 * k + 0.1, 0, 0], rng, TUNED, impassable)
        y = cloud.poses[:, 1]
        centre = cloud.weights @ y
        clouds[name] = math.sqrt(cloud.weights @ np.square(y - centre))
    assert clouds["free"] == pytest.approx(0.6, abs=0.05)
    assert clouds["held"] < 0.6 * clouds["free"]


def test_a_doorway_that_the_plan_walls_up_costs_every_particle_the_same():
    walls = doorway()
    walls[:, 20:23] = True
    cloud = Particles(np.random.default_rng(4).normal([1.5, 2.0, 0.0], [0.02, 0.02, 0.01], (500, 3)))
    impassable, rng = Impassable.of(map_of(walls)), np.random.default_rng(5)
    for k in range(12):
        cloud = predict(cloud, [0.1 * k, 0, 0], [0.1 * k + 0.1, 0, 0], rng, TUNED, impassable)
    assert np.allclose(cloud.log_weights, math.log(0.1))


@pytest.mark.parametrize("spread_m", [0.03, 0.1])
def test_a_filter_comes_through_a_doorway_that_the_plan_walls_up(spread_m):
    """Draws lie between the steps at which particles pay: the estimate lags inside the wall, and no longer behind it."""
    walls = doorway()
    walls[:, 20:23] = True
    rng, impassable = np.random.default_rng(6), Impassable.of(map_of(walls))
    cloud, lags = Particles(rng.normal([1.5, 2.0, 0.0], [spread_m, spread_m, 0.01], (3000, 3))), []
    for k in range(16):
        cloud = predict(cloud, [0.1 * k, 0, 0], [0.1 * k + 0.1, 0, 0], rng, TUNED, impassable)
        lags.append(1.5 + 0.1 * (k + 1) - cloud.weights @ cloud.poses[:, 0])
        cloud = choose(cloud, rng, TUNED) if k % 2 else cloud
    assert 0.3 * spread_m < max(lags) < 1.5 * spread_m and abs(lags[-1]) < 0.3 * spread_m + 0.02


def test_resume_goes_on_with_what_walls_have_taken(slam_prior, drive_log, tmp_path):
    slam = FastSLAM(robot_radius_m=0.6, weigh_every_m=1.0, weigh_every_theta=3.0, particle_limits=(200, 200))
    whole = slam.run(slam_prior, drive_log, np.random.default_rng(3))
    state = slam.start(slam_prior, drive_log, np.random.default_rng(3))
    for _ in range(60):
        slam.step(state)
    assert len(set(state.particles.log_weights.round(6))) > 1  # what the last record before step 70 holds
    with pytest.raises(KeyboardInterrupt):
        run_with_checkpoints(
            slam, slam_prior, drive_log, np.random.default_rng(3), tmp_path / "part", every=20, progress=interrupted_at(70)
        )
    assert np.array_equal(resume(tmp_path / "part").trajectory, whole.trajectory)


def interrupted_at(last):
    """Progress that stops the drive."""

    def progress(done, n):
        if done == last:
            raise KeyboardInterrupt

    return progress


@pytest.mark.filterwarnings("default")
def test_a_start_beside_a_wall_is_warned_of(slam_prior, drive_log):
    with pytest.warns(UserWarning, match=r"start lies nearer to a wall than robot_radius_m, 2 m: walls do not hinder"):
        FastSLAM(robot_radius_m=2).start(slam_prior, drive_log, np.random.default_rng(0))


def test_table_6_1_lets_particles_drive_through_walls(slam_prior, drive_log):
    assert FastSLAM(TABLE_6_1).start(slam_prior, drive_log, np.random.default_rng(0)).impassable is None
    state = FastSLAM(robot_radius_m=0.3).start(slam_prior, drive_log, np.random.default_rng(0))
    assert state.impassable.cells.sum() > (slam_prior.p_empty < 0.35).sum()
