"""Drives whose path and scans are known."""

import dataclasses
import math

import numpy as np
import pytest

from priorlab.core.building import World
from priorlab.core.sensor import KINECT, ODOMETRY, Odometry, Scanner
from priorlab.robot.drive import drive, true_path
from priorlab.slam.parameters import TUNED
from priorlab.slam.scan import choose_beams

WORLD = World(np.pad(np.zeros((56, 116), dtype=bool), 2, constant_values=True), metres_per_pixel=0.05)  # 6 x 3 m
TOUR = [[1.0, 1.0], [4.0, 1.0], [4.0, 2.0]]
EXACT = Scanner(range_noise_m=0, outlier_rate=0, dropout_rate=0, n_beams=3, field_of_view=math.pi / 2)


def go(seed=0, world=WORLD, tour=TOUR, **keywords):
    return drive(world, tour, rng=np.random.default_rng(seed), **keywords)


def test_true_path_steps_and_turns_evenly():
    path = true_path(TOUR, step_m=0.25, turn=math.pi / 6)
    np.testing.assert_allclose(path[:13], np.column_stack([np.linspace(1, 4, 13), np.ones(13), np.zeros(13)]), atol=1e-12)
    np.testing.assert_allclose(path[13:16], [[4, 1, math.pi / 6], [4, 1, math.pi / 3], [4, 1, math.pi / 2]], atol=1e-12)
    np.testing.assert_allclose(path[16:, 1], [1.25, 1.5, 1.75, 2.0])


def test_true_path_turns_the_short_way_round():
    path = true_path([[2, 0], [0, 0.1], [2, 0.1]], step_m=5, turn=0.3)
    turns = np.abs((np.diff(path[:, 2]) + math.pi) % (2 * math.pi) - math.pi)
    assert turns.sum() < math.pi + 1e-9 and turns.max() <= 0.3 + 1e-9


@pytest.mark.parametrize("step_m", [0.1, 0.37, 9])
def test_true_path_never_steps_too_far(step_m):
    path = true_path(TOUR, step_m)
    assert np.hypot(*np.diff(path[:, :2], axis=0).T).max() <= step_m + 1e-9
    assert path[-1, :2].tolist() == TOUR[-1]


def test_a_corner_named_twice_is_one_corner():
    assert (true_path([TOUR[0], TOUR[0], *TOUR[1:], TOUR[-1]]) == true_path(TOUR)).all()


def test_drive_scans_from_the_true_poses():
    log = go(scanner=EXACT)
    assert (log.truth == true_path(TOUR)).all() and (log.start == log.truth[0]).all()
    right, ahead, left = log.ranges[0]
    assert right == pytest.approx((1.0 - 0.1) * math.sqrt(2)) and ahead == math.inf
    assert left == pytest.approx((3.0 - 0.1 - 1.0) * math.sqrt(2))
    at_corner = np.argmin(np.abs(log.truth - [4, 1, 0]).sum(axis=1))
    assert log.ranges[at_corner, 1] == pytest.approx(6 - 0.1 - 4)


def test_drive_in_the_blind_zone_has_no_reading():
    near = go(tour=[[0.3, 0.3], [0.31, 0.3]], scanner=dataclasses.replace(EXACT, min_range_m=0.4))
    np.testing.assert_array_equal(near.ranges[0], [np.nan, np.inf, np.inf])  # 0.28 m to the right, else over 3 m
    beams = choose_beams(near, 0, TUNED)
    assert len(beams) == 0 and beams.open_bearings.tolist() == EXACT.bearings[1:].tolist()  # nothing is freed to the right


def test_drive_has_the_scanners_faults():
    faulty = Scanner(range_noise_m=0.05, dropout_rate=0.25, outlier_rate=0.1)
    log, clean = go(scanner=faulty), go(scanner=Scanner(range_noise_m=0, dropout_rate=0, outlier_rate=0))
    assert np.isnan(log.ranges).mean() == pytest.approx(0.25, abs=0.03)
    both = np.isfinite(log.ranges) & np.isfinite(clean.ranges)
    off = log.ranges[both] - clean.ranges[both]
    assert np.median(np.abs(off)) == pytest.approx(0.05 * 0.6745 / 0.9, rel=0.3)
    assert (np.abs(off) > 0.3).mean() == pytest.approx(0.08, abs=0.04)


def test_wheels_and_scanner_do_not_touch_each_other():
    usual = go()
    other_wheels = go(odometry=Odometry((0.1, 0.1, 0.1, 0.1)))
    other_scanner = go(scanner=dataclasses.replace(KINECT, n_beams=7))
    np.testing.assert_array_equal(other_wheels.ranges, usual.ranges)
    np.testing.assert_array_equal(other_scanner.odometry, usual.odometry)
    assert not np.allclose(other_wheels.odometry, usual.odometry)


def test_drive_draws_from_children_of_the_generator_only():
    rng, untouched = np.random.default_rng(0), np.random.default_rng(0)
    drive(WORLD, TOUR, rng=rng)
    assert rng.random() == untouched.random()


def test_drive_is_the_same_for_the_same_seed_only():
    one, two, other = go(4), go(4), go(5)
    np.testing.assert_array_equal(one.ranges, two.ranges)
    np.testing.assert_array_equal(one.odometry, two.odometry)
    assert not np.allclose(one.odometry, other.odometry)


def test_drive_goes_past_the_corner_of_an_obstacle():
    obstacles = WORLD.obstacles.copy()
    obstacles[20:40, 50:60] = True  # y from 1 to 2 m, x from 2.5 to 3 m
    world = World(obstacles, 0.05)
    assert len(go(world=world, tour=[[1, 0.9], [4, 0.9]])) == 31
    with pytest.raises(ValueError, match="tour must run through free space, got an obstacle on the way from x, y = 2.4, 1.5 m"):
        go(world=world, tour=[[1, 1.5], [4, 1.5]])


def test_drive_does_not_jump_over_a_thin_wall():
    obstacles = WORLD.obstacles.copy()
    obstacles[:, 61] = True
    with pytest.raises(ValueError, match="got an obstacle on the way"):
        go(world=World(obstacles, 0.05), step_m=10)


@pytest.mark.parametrize(
    ("tour", "keywords", "sentence"),
    [
        ([[1, 1]], {}, "tour must have at least two different corners, got 1 at one place"),
        ([[1, 1], [1, 1]], {}, "tour must have at least two different corners, got 2 at one place"),
        ([1, 2], {}, r"tour must have shape \(M, 2\)"),
        ([[1, 1], [math.nan, 1]], {}, r"tour must be finite numbers, got \[nan, 1.0\] in row 1"),
        ([[1, 1], [7, 1]], {}, "tour must stay on the map of 6 x 3 m, got x, y = 6"),
        (TOUR, {"step_m": 0}, "step_m must be a finite number above 0, got 0"),
        (TOUR, {"turn": -1}, "turn must be a finite number above 0, got -1"),
    ],
)
def test_drive_says_what_is_wrong(tour, keywords, sentence):
    with pytest.raises(ValueError, match=sentence):
        go(tour=tour, **keywords)


def test_drive_needs_a_generator():
    with pytest.raises(ValueError, match="rng must be a numpy Generator.*got None"):
        drive(WORLD, TOUR, KINECT, ODOMETRY)
