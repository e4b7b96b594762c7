"""Mapping without a plan on a small simulated hall: against the truth, against the wheels alone, and the growing map alone."""

from dataclasses import replace

import numpy as np
import pytest

from priorlab.core.building import World
from priorlab.core.readings import RobotLog
from priorlab.core.sensor import Odometry, Scanner
from priorlab.robot.drive import drive
from priorlab.slam.growing_map import GrowingMap
from priorlab.slam.matched_mapping import Slip, map_by_matching
from priorlab.slam.scan import Scan
from priorlab.slam.scan_matching import MATCHING
from priorlab.slam.trajectory_error import absolute_trajectory_error_m, dead_reckoning

LASER = Scanner(n_beams=181, field_of_view=np.pi, min_range_m=0.1, max_range_m=15.0, outlier_rate=0.0, dropout_rate=0.0)
NONE = np.empty(0)


@pytest.fixture(scope="module")
def hall():
    """A drive through a hall of 8 x 5 m with two pillars, with bad wheels; its frame is moved to x = 30, y = -20."""
    obstacles = np.zeros((100, 160), dtype=bool)
    obstacles[[0, -1]] = obstacles[:, [0, -1]] = True
    obstacles[30:36, 50:56] = obstacles[60:66, 110:116] = True
    bad = Odometry((0.02, 0.02, 0.02, 0.02))
    log = drive(World(obstacles, 0.05), [[1, 1], [7, 1], [7, 4], [1, 4]], LASER, bad, np.random.default_rng(4))
    moved = log.truth + [30, -20, 0]
    return obstacles, replace(log, truth=moved, start=moved[0])


@pytest.fixture(scope="module")
def matched(hall):
    return map_by_matching(hall[1])


def test_map_by_matching_beats_the_wheels(hall, matched):
    log = hall[1]
    wheels = absolute_trajectory_error_m(dead_reckoning(log), log.truth)
    assert matched.ate_m() < min(0.1, wheels / 3)
    assert matched.heading_error_deg() < 1.0
    turns = np.angle(np.exp(1j * (matched.trajectory[:, 2] - log.truth[:, 2])))
    assert matched.heading_error_deg() == pytest.approx(np.degrees(np.median(np.abs(turns))))
    assert matched.trusted.mean() > 0.9 and np.isnan(matched.explained[0])


def test_map_by_matching_shows_the_walls_where_they_are(hall, matched):
    obstacles, log = hall
    np.testing.assert_allclose(matched.log.truth[:, :2] + matched.low, log.truth[:, :2], atol=1e-9)
    skin = np.zeros_like(obstacles)
    skin[[0, -1], 20:-20] = True
    rows, cols = np.nonzero(skin)
    xy = np.column_stack([cols + 0.5, 100 - rows - 0.5]) * 0.05 + [30, -20] - matched.low
    grid, p_empty = matched.map.grid, matched.map.p_empty
    near = np.array([p_empty[r - 2 : r + 3, c - 2 : c + 3].min() for r, c in grid.xy_to_cell(grid.metres_to_xy(xy))])
    assert (near < 0.5).mean() > 0.95
    middle = grid.xy_to_cell(grid.metres_to_xy([[34, -17.5] - matched.low]))[0]
    assert p_empty[tuple(middle)] > 0.9


def test_map_by_matching_repeats_itself_and_does_not_ask_where_its_frame_lies(hall, matched):
    log = hall[1]
    again = map_by_matching(log)
    np.testing.assert_array_equal(again.trajectory, matched.trajectory)
    np.testing.assert_array_equal(again.map.log_odds, matched.map.log_odds)
    shift = np.array([-40.0, 35.0, 0.0])  # whole cells
    moved = map_by_matching(replace(log, start=log.start + shift, truth=log.truth + shift))
    np.testing.assert_allclose(
        moved.trajectory[:, :2] + moved.low - shift[:2], matched.trajectory[:, :2] + matched.low, atol=0.02
    )


def test_matched_log_has_the_matched_poses_as_its_wheels(matched):
    assert absolute_trajectory_error_m(dead_reckoning(matched.matched_log), matched.log.truth) == pytest.approx(matched.ate_m())
    assert repr(matched).startswith(f"MatchedDrive({len(matched)} scans, ") and "ATE 0.0" in repr(matched)


def test_map_by_matching_with_one_scan_or_without_truth(hall):
    log = hall[1]
    first = RobotLog(log.odometry[:1], log.ranges[:1], log.bearings, LASER, log.start)
    alone = map_by_matching(first)
    np.testing.assert_allclose(alone.trajectory[0, :2] + alone.low, log.start[:2])
    assert "ATE" not in repr(alone)
    with pytest.raises(ValueError, match="must hold true poses"):
        alone.ate_m()
    blind = replace(first, ranges=np.full_like(first.ranges, np.nan))
    assert map_by_matching(blind).map.p_empty.min() == 0.5  # nothing seen, nothing said


def test_map_by_matching_says_what_is_wrong(hall):
    log = hall[1]
    empty = RobotLog(np.empty((0, 3)), np.empty((0, 181)), log.bearings, LASER, log.start)
    with pytest.raises(ValueError, match="at least one scan, got 0"):
        map_by_matching(empty)
    with pytest.raises(ValueError, match="per_m must be a finite number of at least 0, got -1"):
        Slip(per_m=-1)
    with pytest.raises(ValueError, match="least_m must be a finite number above 0"):
        Slip(least_m=0)
    with pytest.raises(ValueError, match="cell_m must be"):
        map_by_matching(log, cell_m=0)


def test_slip_window_grows_with_the_step():
    slip = Slip(0.1, 0.2, 0.01, 0.03, 0.5)
    window = slip.window(np.array([3.0, 4.0, -0.2]))
    assert window.spread_m == pytest.approx(0.1 + 0.2 * 5) and window.spread_turn == pytest.approx(0.01 + 0.03 * 5 + 0.5 * 0.2)


def test_growing_map_grows_to_all_sides_and_forgets_nothing():
    growing = GrowingMap(MATCHING, 0.05, np.array([0.02, 0.02]))
    ahead = Scan(np.array([2.0]), np.array([0.0]), NONE)
    seen = []
    for theta in (0.0, np.pi / 2, np.pi, -np.pi / 2):
        for at in ([0.02, 0.02], [-9.0, 7.0], [8.0, -12.0]):
            pose = np.array([*at, theta])
            growing.insert(pose, ahead)
            seen.append(pose[:2] + 2.0 * np.array([np.cos(theta), np.sin(theta)]))
    grid = growing.field.grid
    assert grid.shape == growing.log_odds.shape == growing.field.image.shape
    cells = grid.xy_to_cell(grid.metres_to_xy(np.array(seen) - growing.low))
    assert (growing.map.p_empty[tuple(cells.T)] < 0.35).all()  # all twelve hits
    assert (growing.map.p_empty < 0.5).sum() == 12
    whole = GrowingMap(MATCHING, 0.05, np.array([0.0, 0.0]))
    whole.log_odds, whole._low_cell = growing.log_odds, growing._low_cell
    np.testing.assert_array_equal(whole._fresh_field().image, growing.field.image)  # the windows add up to the whole field


def test_growing_map_trims_what_nobody_saw():
    growing = GrowingMap(MATCHING, 0.05, np.zeros(2))
    growing.insert(np.array([0.02, 0.02, 0.0]), Scan(np.array([2.0]), np.array([0.0]), NONE))
    before, hit = growing.log_odds.shape, np.array([[2.02, 0.02]])
    growing.trim()
    grid = growing.field.grid
    assert grid.shape == (41, 81) < before and growing.low.tolist() == [-1.0, -1.0]  # 41 cells of a ray, 20 on every side
    assert growing.map.p_empty[tuple(grid.xy_to_cell(grid.metres_to_xy(hit - growing.low))[0])] < 0.35
    assert growing.field.image.max() == growing.field.image[20, 60]


def test_growing_map_says_when_it_would_be_too_large():
    growing = GrowingMap(MATCHING, 0.05, np.zeros(2))
    with pytest.raises(ValueError, match="a side of the map must be at most 32766 cells of 0.05 m, got 20000.*leap"):
        growing.insert(np.array([1e5, 1e5, 0.0]), Scan(np.array([1.0]), np.array([0.0]), NONE))
