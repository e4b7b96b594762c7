"""Localization on a log's own map: a simulated drive. (The real logs: test_study_real_logs_table.py.)"""

from dataclasses import replace

import numpy as np
import pytest

from priorlab.core.building import World
from priorlab.core.readings import RobotLog
from priorlab.core.sensor import Scanner
from priorlab.interchange.relations import Relations
from priorlab.robot.drive import drive
from priorlab.study.real_logs import (
    LASER,
    WornWheels,
    every_other,
    into_map_frame,
    localize_on_odd_scans,
    logs_table,
    map_from_truth,
    wear_wheels,
)

SICK = Scanner(n_beams=181, field_of_view=np.pi, min_range_m=0.1, max_range_m=20.0, outlier_rate=0.0, dropout_rate=0.0)


@pytest.fixture(scope="module")
def hall():
    """A drive through a hall of 8 x 5 m with two pillars, its frame moved to x = 30, y = -20."""
    obstacles = np.zeros((100, 160), dtype=bool)
    obstacles[[0, -1]] = obstacles[:, [0, -1]] = True
    obstacles[30:36, 50:56] = obstacles[60:66, 110:116] = True
    log = drive(World(obstacles, 0.05), [[1, 1], [7, 1], [7, 4], [1, 4]], SICK, rng=np.random.default_rng(4))
    moved = log.truth + [30, -20, 0]
    stamps = np.arange(len(log)) / 4
    return obstacles, RobotLog(moved, log.ranges, log.bearings, SICK, moved[0], moved, stamps)


def test_laser_pins_what_it_was_chosen_with():
    """The preset TUNED may be tuned anew for the plan's sake; the numbers of the real logs were taken with these."""
    weighing = (LASER.n_beams, LASER.sigma_hit_m, LASER.z_random, LASER.max_distance_m, LASER.max_range_m, LASER.temper)
    assert weighing == (60, 0.05, 0.98, 2.0, 20.0, 0.2)
    assert (LASER.weigh_every_m, LASER.weigh_every_theta, LASER.lam, LASER.particle_limits) == (0, 0, 0, (4500, 4500))


def test_map_from_truth_shows_the_walls_where_they_are(hall):
    obstacles, log = hall
    shifted, grid = into_map_frame(log, 20.0)
    low = log.truth[0] - shifted.truth[0]
    assert np.allclose(low[:2], [29, -21], atol=0.15) and low[2] == 0  # a metre outside the hall's corner
    p_empty = map_from_truth(shifted, grid, LASER).p_empty
    rows, cols = np.nonzero(obstacles)
    xy = np.column_stack([cols + 0.5, 100 - rows - 0.5]) * 0.05 + [30, -20] - low[:2]
    near = np.array([p_empty[r - 2 : r + 3, c - 2 : c + 3].min() for r, c in grid.xy_to_cell(grid.metres_to_xy(xy))])
    skin = (rows == 0) | (rows == 99) | (cols == 0) | (cols == 159)
    assert (near[skin] < 0.5).mean() > 0.95  # a scanner does not see the inside of pillars
    middle = grid.xy_to_cell(grid.metres_to_xy([[34, -17.5] - low[:2]]))[0]
    assert p_empty[tuple(middle)] > 0.99 and p_empty[0, 0] == 0.5


def test_every_other_starts_at_its_own_first_pose(hall):
    log = hall[1]
    even, odd = every_other(log, 0), every_other(log, 1)
    assert len(even) + len(odd) == len(log)
    np.testing.assert_array_equal(odd.start, log.truth[1])
    np.testing.assert_array_equal(odd.ranges[3], log.ranges[7])
    assert odd.stamps[3] == log.stamps[7]


def test_wear_wheels_without_faults_is_the_truth_and_the_bias_makes_steps_longer(hall):
    log, rng = hall[1], np.random.default_rng(0)
    np.testing.assert_allclose(wear_wheels(log, rng, WornWheels(0, 0, 0)).odometry[:, :2], log.truth[:, :2], atol=1e-9)
    worn = wear_wheels(log, rng, WornWheels(0, 0.5, 0)).odometry
    np.testing.assert_allclose(worn[:, :2] - worn[0, :2], 1.5 * (log.truth[:, :2] - log.truth[0, :2]), atol=1e-9)


def test_wear_wheels_spreads_as_it_says():
    steps = np.linspace(0, 2000, 20001)
    straight = RobotLog(np.zeros((20001, 3)), np.zeros((20001, 1)), [0.0], SICK, [0, 0, 0], np.outer(steps, [1, 0, 0]))
    worn = wear_wheels(straight, np.random.default_rng(1), WornWheels()).odometry
    lengths = np.hypot(*np.diff(worn[:, :2], axis=0).T)
    assert lengths.mean() == pytest.approx(0.103, rel=0.01) and lengths.std() == pytest.approx(0.01, rel=0.03)
    assert np.diff(np.unwrap(worn[:, 2])).std() == pytest.approx(np.radians(1) * 0.1, rel=0.03)


def test_localize_on_odd_scans_finds_its_way_and_repeats_itself(hall):
    few = replace(LASER, particle_limits=(500, 500))
    rows = [localize_on_odd_scans(hall[1], seed=2, parameters=few) for _ in range(2)]
    assert rows[0].run.ate_m() < 0.08 < rows[0].dead_reckoning_m and not rows[0].run.lost
    np.testing.assert_array_equal(rows[0].run.trajectory, rows[1].run.trajectory)
    true_step = Relations([[0.25, 10.25]], [_step(hall[1].truth[1], hall[1].truth[41])])
    assert rows[0].relation_errors(true_step).translation_m[0] < 0.2
    assert len(logs_table("hall", rows, true_step).splitlines()) == 3
    with pytest.raises(ValueError, match="must have stamps"):
        localize_on_odd_scans(replace(hall[1], stamps=None), 2, few).relation_errors(true_step)


def _step(start, end):
    """By complex numbers: the way from one pose to another as the first one sees it."""
    way = complex(*(end - start)[:2]) * np.exp(-1j * start[2])
    return np.array([way.real, way.imag, end[2] - start[2]])


def test_localize_on_odd_scans_has_its_map_from_the_even_ones_alone(hall):
    few = replace(LASER, particle_limits=(5, 5))
    row = localize_on_odd_scans(hall[1], 0, few)
    shifted, grid = into_map_frame(hall[1], 20.0)
    np.testing.assert_array_equal(row.run.prior_map.log_odds, map_from_truth(every_other(shifted, 0), grid, few).log_odds)
    np.testing.assert_array_equal(row.run.log.ranges, hall[1].ranges[1::2])


def test_into_map_frame_holds_the_robot_when_it_only_looks_ahead():
    eyes = Scanner(n_beams=3, field_of_view=0.2, min_range_m=0.1, max_range_m=20.0)
    truth = np.array([[5.0, 5.0, 0.0], [5.5, 5.0, 0.0]])
    log = RobotLog(truth, np.full((2, 3), 6.0), eyes.bearings, eyes, truth[0], truth)
    shifted, grid = into_map_frame(log, 20.0)
    assert grid.contains(grid.metres_to_xy(shifted.truth[:, :2])).all()
    assert np.allclose(shifted.truth[0, :2], [1.0, 1.0 + 6 * np.sin(0.1)], atol=0.01)  # a metre of room behind it


def test_into_map_frame_holds_what_a_scanner_far_from_the_robots_middle_sees():
    """A scanner 3 m ahead of it, on a robot that looks along y: beams of 4 m end 7 m ahead, one to either side by 4 sin(0.1)."""
    eyes = Scanner(n_beams=3, field_of_view=0.2, min_range_m=0.1, max_range_m=20.0)
    truth = np.array([[0.0, 0.0, np.pi / 2]] * 2)
    log = RobotLog(truth, np.full((2, 3), 4.0), eyes.bearings, eyes, truth[0], truth)
    shifted, grid = into_map_frame(log, 20.0, sensor_offset_m=(3.0, 0.0))
    assert np.allclose(shifted.truth[0, :2], [1.0 + 4 * np.sin(0.1), 1.0])
    assert grid.shape == (180, 56)  # 7 m and a metre before and behind; 0.8 m and a metre on either side


def test_localize_on_odd_scans_says_what_is_missing(hall):
    log = hall[1]
    with pytest.raises(ValueError, match="must hold true poses"):
        localize_on_odd_scans(replace(log, truth=None), 0)
    short = RobotLog(log.odometry[:3], log.ranges[:3], log.bearings, SICK, log.start, log.truth[:3])
    with pytest.raises(ValueError, match="at least four scans .* got 3"):
        localize_on_odd_scans(short, 0)
