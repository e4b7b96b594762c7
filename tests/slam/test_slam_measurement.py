"""Algorithm 6.4 against a slow loop over particles, beams and boundary cells."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.readings import RobotLog
from priorlab.core.sensor import Scanner
from priorlab.slam.likelihood_field import LikelihoodField, distance_to_boundary, log_likelihood_of
from priorlab.slam.measurement import beam_log_likelihoods, log_weights, scan_exponent, share_explained
from priorlab.slam.parameters import TABLE_6_1, TUNED, Parameters
from priorlab.slam.scan import Scan, choose_beams, weighing_steps

NEAR = replace(TUNED, max_distance_m=0.5, sigma_hit_m=0.2, z_random=0.5)


def scan_of(ranges, bearings, offset=(0.0, 0.0)):
    return Scan(np.asarray(ranges, float), np.asarray(bearings, float), np.empty(0), offset)


def map_of(occupied, cell_m=0.1):
    return GridMap(np.where(occupied, -2.0, 2.0), Grid(occupied.shape, 1, cell_m))


def slow_boundary(occupied):
    """Occupied cells beside a free one; beyond the rim nothing is free."""
    rows, cols = occupied.shape
    cells = []
    for r in range(rows):
        for c in range(cols):
            around = [(r + dr, c + dc) for dr, dc in ((0, 1), (1, 0), (0, -1), (-1, 0))]
            if occupied[r, c] and any(0 <= i < rows and 0 <= j < cols and not occupied[i, j] for i, j in around):
                cells.append((r, c))
    return cells


def slow_log_weight(pose, scan, occupied, cell_m, parameters):
    """The printed loop of algorithm 6.4 (with the sine that the print lacks), a sum of logarithms for the product."""
    boundary, total = slow_boundary(occupied), 0.0
    x, y, theta = pose
    x_sens, y_sens = scan.offset
    for z, bearing in zip(scan.ranges, scan.bearings, strict=True):
        x_z = x + x_sens * math.cos(theta) - y_sens * math.sin(theta) + z * math.cos(theta + bearing)
        y_z = y + y_sens * math.cos(theta) + x_sens * math.sin(theta) + z * math.sin(theta + bearing)
        col, row = math.floor(x_z / cell_m), occupied.shape[0] - 1 - math.floor(y_z / cell_m)
        dist = parameters.max_distance_m
        if 0 <= row < occupied.shape[0] and 0 <= col < occupied.shape[1]:
            dist = min([dist, *(cell_m * math.hypot(row - r, col - c) for r, c in boundary)])
        prob = math.exp(-(dist**2) / (2 * parameters.sigma_hit_m**2)) / math.sqrt(2 * math.pi * parameters.sigma_hit_m**2)
        total += math.log((1 - parameters.z_random) * prob + parameters.z_random / parameters.max_range_m)
    full = math.sqrt(parameters.n_beams / len(scan.ranges))  # fewer beams weigh more each
    return min(1.0, parameters.temper * full) * total


@pytest.mark.parametrize("offset", [(0.0, 0.0), (0.3, -0.2)])
def test_log_weights_agree_with_a_slow_loop(offset):
    rng = np.random.default_rng(5)
    occupied = np.zeros((24, 30), dtype=bool)
    occupied[3:9, 4:11], occupied[15:, 20:26], occupied[12, 2:20] = True, True, True
    field = LikelihoodField.of(map_of(occupied), NEAR)
    poses = np.column_stack([rng.uniform(-0.5, 3.5, 40), rng.uniform(-0.5, 2.9, 40), rng.uniform(-np.pi, np.pi, 40)])
    scan = scan_of(rng.uniform(0.1, 2.0, 9), rng.uniform(-1, 1, 9), offset)
    expected = [slow_log_weight(pose, scan, occupied, 0.1, NEAR) for pose in poses]
    assert np.allclose(log_weights(poses, scan, field), expected, atol=1e-5)
    assert np.std(expected) > 0.05  # and the weights differ


def test_log_weights_are_largest_at_the_true_heading_and_place():
    occupied = np.zeros((40, 40), dtype=bool)
    occupied[:, 30:] = True  # a wall to the right of x = 3 m
    occupied[:10] = True  # and one above y = 3 m
    field = LikelihoodField.of(map_of(occupied), NEAR)
    scan = scan_of([1.05, 1.05], [0.0, np.pi / 2])  # 1 m ahead, 1 m to the LEFT, which is up
    poses = np.array([[2.0, 2.0, 0.0], [2.0, 2.0, 0.5], [1.5, 2.0, 0.0], [2.0, 2.5, 0.0], [2.0, 2.0, -np.pi / 2]])
    assert log_weights(poses, scan, field).argmax() == 0


def test_log_weights_off_the_map_are_equal_and_finite():
    field = LikelihoodField.of(map_of(np.eye(20, dtype=bool)), TUNED)
    poses = np.array([[1e3, 0, 0], [-1e6, 5, 1], [1e12, -1e12, 2]])
    weights = log_weights(poses, scan_of([1.0] * 60, np.linspace(-0.5, 0.5, 60)), field)
    assert np.isfinite(weights).all() and np.ptp(weights) == 0
    assert weights[0] == pytest.approx(0.05 * 60 * field.far, rel=1e-6)


def test_log_weights_of_no_beam_say_nothing():
    field = LikelihoodField.of(map_of(np.eye(20, dtype=bool)), TUNED)
    assert log_weights(np.zeros((4, 3)), scan_of([], []), field).tolist() == [0, 0, 0, 0]
    assert math.isnan(share_explained(np.zeros(3), scan_of([], []), field))


@pytest.mark.parametrize(("sigma_hit_m", "within_sigmas", "share"), [(0.05, 4.0, 0.3), (0.05, 3.0, 0.2), (0.2, 4.0, 0.5)])
def test_share_explained_counts_beams_that_end_near_a_wall(sigma_hit_m, within_sigmas, share):
    wall = np.zeros((60, 80), dtype=bool)
    wall[:, 60] = True  # its cells' centres at x = 6.05 m
    field = LikelihoodField.of(map_of(wall), replace(TUNED, sigma_hit_m=sigma_hit_m))
    short_m = np.repeat([0.0, 0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 1.0, 1.2, 1.5], 2)  # two beams each; how far before the wall they end
    scan = scan_of(5.05 - short_m, np.zeros(20))
    assert share_explained(np.array([1.0, 3.05, 0.0]), scan, field, within_sigmas) == share
    if within_sigmas == 4.0:  # what a run records and `lost_because` asks
        assert share_explained(np.array([1.0, 3.05, 0.0]), scan, field) == share


def test_log_weights_of_more_particles_than_opencv_counts():
    field = LikelihoodField.of(map_of(np.eye(20, dtype=bool)), TUNED)
    poses = np.random.default_rng(0).uniform(0, 2, (40_000, 3))
    scan = scan_of([0.3, 0.5], [0.0, 0.4])
    assert np.array_equal(log_weights(poses, scan, field)[35_000:], log_weights(poses[35_000:], scan, field))


@pytest.mark.parametrize(
    ("n_returned", "temper", "exponent"),
    [(60, 0.05, 0.05), (15, 0.05, 0.1), (1, 0.05, 0.3872983), (1, 0.5, 1.0), (60, 1.0, 1.0), (7, 1.0, 1.0)],
)
def test_scan_exponent_grows_as_the_root_of_the_beams_that_lack(n_returned, temper, exponent):
    parameters = replace(NEAR, temper=temper)
    assert scan_exponent(n_returned, parameters) == pytest.approx(exponent)
    rng = np.random.default_rng(0)
    scan, poses = scan_of(rng.uniform(0.2, 0.9, n_returned), rng.uniform(-1, 1, n_returned)), rng.uniform(0.5, 1.5, (30, 3))
    fields = [LikelihoodField.of(map_of(np.eye(20, dtype=bool)), replace(NEAR, temper=t)) for t in (1.0, temper)]
    literal, tempered = (log_weights(poses, scan, field) for field in fields)
    assert np.allclose(tempered, exponent * literal)


def test_field_of_a_thick_wall_is_low_inside_it():
    occupied = np.zeros((41, 41), dtype=bool)
    occupied[:, 10:31] = True
    row = LikelihoodField.of(map_of(occupied, 0.05), NEAR).image[20]
    assert row.argmax() in (10, 30) and row[20] < row[10] and row[20] == pytest.approx(row[0], abs=0.05)


@given(st.integers(0, 2**32 - 1), st.floats(0.05, 0.6), st.floats(1.0, 9.0))
@settings(max_examples=25, deadline=None)
def test_distance_to_boundary_agrees_with_a_slow_search(seed, density, farthest):
    occupied = np.random.default_rng(seed).random((11, 13)) < density
    boundary = slow_boundary(occupied)
    for (row, col), distance in np.ndenumerate(distance_to_boundary(occupied, farthest)):
        expected = min([farthest, *(math.hypot(row - r, col - c) for r, c in boundary)])
        assert distance == pytest.approx(expected, rel=1e-6)


@given(st.integers(0, 2**32 - 1), st.sampled_from([0.3, 0.5, 0.47, 0.62]))
@settings(max_examples=60, deadline=None)
def test_refresh_of_a_window_equals_the_whole_field_worked_out_again(seed, max_distance_m):
    parameters = replace(TUNED, max_distance_m=max_distance_m)
    rng = np.random.default_rng(seed)
    log_odds_map = np.where(rng.random((60, 70)) < 0.05, -2.0, 2.0)
    log_odds_map[20:30, 10:50] = -2.0
    grid = Grid((60, 70), 1, 0.1)
    field = LikelihoodField.of(GridMap(log_odds_map, grid), parameters)
    top, left = rng.integers(0, 60), rng.integers(0, 70)
    window = (slice(int(top), min(60, int(top) + 12)), slice(int(left), min(70, int(left) + 9)))
    log_odds_map[window] *= np.where(rng.random(log_odds_map[window].shape) < 0.5, -1, 1)
    field.refresh(log_odds_map, *window)
    again = LikelihoodField.of(GridMap(log_odds_map, grid), parameters)
    assert np.array_equal(field.image, again.image)


def test_log_likelihood_of_hand_values():
    parameters = Parameters(sigma_hit_m=0.2, z_random=0.05, max_range_m=12.0)
    at_wall = math.log(0.95 / (0.2 * math.sqrt(2 * math.pi)) + 0.05 / 12)
    assert log_likelihood_of(np.array([0.0, 50.0]), parameters) == pytest.approx([at_wall, math.log(0.05 / 12)], rel=1e-6)


def test_field_needs_walls(prior_of):
    with pytest.raises(ValueError, match=r"the map must hold walls to localize in.*below 0.35, got a lowest P\(empty\) of 0.5"):
        LikelihoodField.of(prior_of(np.eye(20, dtype=bool), Prior.uninformed()))
    with pytest.raises(ValueError, match="got a lowest P.empty. of 0.36"):
        LikelihoodField.of(prior_of(np.eye(20, dtype=bool), Prior(0.4, 0.8)))


def test_field_counts_a_cell_on_the_threshold_as_free():
    log_odds_map = np.log([[0.35 / 0.65, 0.27 / 0.73, 4.0]])
    assert LikelihoodField.of(GridMap(log_odds_map, Grid((1, 3), 1, 0.1))).occupied(log_odds_map).tolist() == [
        [False, True, False]
    ]


def test_field_refuses_a_map_without_scale_and_one_too_long():
    with pytest.raises(ValueError, match="metres_per_pixel must be known"):
        LikelihoodField.of(GridMap(np.full((2, 2), -2.0), Grid((2, 2))))
    with pytest.raises(ValueError, match="at most 32766 cells"):
        LikelihoodField.of(GridMap(np.full((1, 40_000), -2.0), Grid((1, 40_000), 1, 0.1)))


def test_beam_log_likelihoods_go_by_sensor_offset():
    occupied = np.zeros((20, 20), dtype=bool)
    occupied[:, 15] = True  # x from 1.5 to 1.6 m
    field = LikelihoodField.of(map_of(occupied), NEAR)
    facing_up = np.array([[0.55, 1.0, np.pi / 2]])  # the scanner sits 0.5 m to the robot's right: at x = 1.05
    scan = scan_of([0.5], [-np.pi / 2], offset=(0.0, -0.5))
    assert beam_log_likelihoods(facing_up, scan, field)[0, 0] == pytest.approx(field.image.max())


def log_of(ranges, scanner=None):
    ranges = np.atleast_2d(np.asarray(ranges, float))
    scanner = scanner or Scanner(n_beams=ranges.shape[1])
    return RobotLog(np.zeros((len(ranges), 3)), ranges, scanner.bearings, scanner, np.zeros(3))


def test_choose_beams_drops_what_is_no_return():
    scan = choose_beams(log_of([np.nan, 0.1, 0.4, 1.0, 2.99, 3.0, 5.0, np.inf]), 0, TUNED)
    assert scan.ranges.tolist() == [0.4, 1.0, 2.99]
    assert len(scan.open_bearings) == 3


def test_choose_beams_thins_after_dropping():
    ranges = np.full(200, np.nan)
    ranges[50:150] = np.linspace(1, 2, 100)
    scan = choose_beams(log_of(ranges), 0, TUNED)
    assert len(scan) == 60 and scan.ranges[0] == 1 and scan.ranges[-1] == 2
    assert np.diff(scan.ranges).max() < 0.03


def test_choose_beams_takes_the_shorter_of_the_two_ranges():
    scanner = Scanner(n_beams=3, min_range_m=0.0, max_range_m=8.0)
    log = log_of([0.0, 2.0, 5.0], scanner)
    assert choose_beams(log, 0, TUNED).ranges.tolist() == [2.0]
    assert choose_beams(log, 0, replace(TUNED, max_range_m=12.0)).ranges.tolist() == [2.0, 5.0]


def slow_weighing_steps(log, every_m, every_theta):
    """Drive along; note where the robot stood when a scan last weighed."""
    weighs, x, y, theta = [], None, None, None
    for (px, py, ptheta), ranges in zip(log.odometry.tolist(), log.ranges.tolist(), strict=True):
        returned = any(log.scanner.min_range_m <= r < 3.0 for r in ranges)
        moved = x is None or math.hypot(px - x, py - y) >= every_m
        moved = moved or abs(math.atan2(math.sin(ptheta - theta), math.cos(ptheta - theta))) >= every_theta
        weighs.append(returned and moved)
        if weighs[-1]:
            x, y, theta = px, py, ptheta
    return weighs


@pytest.mark.parametrize(("every_m", "every_theta"), [(0.2, math.radians(20)), (0.35, 3.0), (50.0, 0.5), (0.0, 9.0)])
def test_weighing_steps_agree_with_a_slow_drive(every_m, every_theta):
    rng = np.random.default_rng(1)
    poses = np.cumsum(rng.normal(0, (0.1, 0.1, 0.15), (150, 3)), axis=0)
    poses[:, 2] = (poses[:, 2] + np.pi) % (2 * np.pi) - np.pi
    ranges = np.where(rng.random((150, 4)) < 0.3, rng.uniform(0.4, 2.9, (150, 4)), np.inf)
    log = RobotLog(poses, ranges, Scanner(n_beams=4).bearings, Scanner(n_beams=4), poses[0])
    weighs = weighing_steps(log, replace(TUNED, weigh_every_m=every_m, weigh_every_theta=every_theta))
    assert weighs.tolist() == slow_weighing_steps(log, every_m, every_theta)
    assert 0 < weighs.sum() < 150


def test_weighing_steps_take_every_scan_as_printed_and_one_of_a_robot_that_stands():
    log = log_of([[1.0, 2.0]] * 5 + [[np.nan, np.inf]])
    assert weighing_steps(log, TUNED).tolist() == [True] + [False] * 5
    assert weighing_steps(log, TABLE_6_1).tolist() == [True] * 5 + [False]
