"""The matcher against plain loops over all poses, against shifted scans whose pose is known, and where it must not be trusted."""

import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap
from priorlab.slam.likelihood_field import LikelihoodField
from priorlab.slam.match_refinement import climb, fit_peak, information, smooth_log_likelihoods
from priorlab.slam.scan import Scan
from priorlab.slam.scan_matching import MATCHING, Window, match_scan

CELL = 0.05
NONE = np.empty(0)


def field_of(walls):
    return LikelihoodField.of(GridMap(np.where(walls, -2.0, 2.0), Grid(walls.shape, 1, CELL)), MATCHING)


def room_walls(height=80, width=120):
    """A room of 6 x 4 m in cells, with a pillar and a stub of a wall, so that it looks like itself from one pose alone.

    Round it half a metre that nobody sees.
    """
    walls = np.zeros((height, width), dtype=bool)
    walls[[0, -1]] = walls[:, [0, -1]] = True
    walls[20:26, 80:86] = walls[50:80, 40] = True
    return np.pad(walls, 10)


def look(walls, pose, bearings, longest=12.0):
    """A scan by walking along every beam in steps of 5 mm: no ray caster of ours."""
    along = np.arange(0.0, longest, 0.005)
    ranges = []
    for bearing in bearings:
        x, y = pose[0] + along * math.cos(pose[2] + bearing), pose[1] + along * math.sin(pose[2] + bearing)
        rows, cols = walls.shape[0] - 1 - np.floor(y / CELL).astype(int), np.floor(x / CELL).astype(int)
        inside = (rows >= 0) & (rows < walls.shape[0]) & (cols >= 0) & (cols < walls.shape[1])
        hit = ~inside | walls[rows.clip(0, walls.shape[0] - 1), cols.clip(0, walls.shape[1] - 1)]
        ranges.append((along[np.argmax(hit)] if hit.any() else np.inf) + 0.0)
    ranges = np.array(ranges)
    returned = np.isfinite(ranges)
    return Scan(ranges[returned], np.asarray(bearings)[returned], NONE)


ROOM = room_walls()
ROOM_FIELD = field_of(ROOM)
BEARINGS = np.radians(np.arange(-90, 91, 3))


def score_of(pose, scan, field, guess, window):
    """Score of one pose, beam by beam."""
    image, n_rows, n_cols = field.image, *field.image.shape
    x, y, theta = pose
    fits = 0.0
    for z, bearing in zip(scan.ranges.tolist(), scan.bearings.tolist(), strict=True):
        row = n_rows - 1 - math.floor((y + z * math.sin(theta + bearing)) / CELL)
        col = math.floor((x + z * math.cos(theta + bearing)) / CELL)
        fits += float(image[row, col]) if 0 <= row < n_rows and 0 <= col < n_cols else field.far
    turn = (theta - guess[2] + math.pi) % (2 * math.pi) - math.pi
    away = ((x - guess[0]) ** 2 + (y - guess[1]) ** 2) / window.spread_m**2 + (turn / window.spread_turn) ** 2
    return field.parameters.temper * fits - away / 2


def by_loops(scan, field, guess, window):
    """The best score of all poses of the window, one after the other."""
    n_steps, n_turns = math.ceil(window.half_m / CELL - 1e-9), math.ceil(window.reach * window.spread_turn / window.turn_step)
    best = -math.inf
    for turn in range(-n_turns, n_turns + 1):
        for up in range(-n_steps, n_steps + 1):
            for right in range(-n_steps, n_steps + 1):
                pose = guess[0] + right * CELL, guess[1] + up * CELL, guess[2] + turn * window.turn_step
                best = max(best, score_of(pose, scan, field, guess, window))
    return best


@settings(max_examples=12, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_match_scan_finds_what_plain_loops_over_all_poses_find(seed):
    rng = np.random.default_rng(seed)
    walls = rng.random((50, 60)) < rng.choice([0.01, 0.05, 0.2])
    walls[0, 0] = True
    n = int(rng.integers(1, 14))
    scan = Scan(rng.uniform(0.1, 2.5, n), rng.uniform(-np.pi, np.pi, n), NONE)
    guess = np.array([*rng.uniform(-0.5, 3.0, 2), rng.uniform(-3, 3)])  # off the map, too
    spread_m, half_m = rng.choice([0.05, 0.2, 1.0]), rng.uniform(0.05, 0.5)
    window = Window(spread_m, spread_turn=0.1 * spread_m / half_m, reach=half_m / spread_m, turn_step=0.05)  # 0.1 to each side
    field = field_of(walls)
    match = match_scan(scan, field, guess, window)
    assert match.score == pytest.approx(by_loops(scan, field, guess, window), abs=1e-6)
    assert match.score == pytest.approx(score_of(match.cell, scan, field, guess, window), abs=1e-6)
    assert np.abs(match.cell - guess)[:2].max() < half_m + CELL and match.n_scored > 0


@settings(max_examples=15, deadline=None)
@given(
    st.floats(0.8, 5.2),
    st.floats(0.8, 3.0),
    st.floats(-3.1, 3.1),
    st.floats(-0.25, 0.25),
    st.floats(-0.25, 0.25),
    st.floats(-0.1, 0.1),
)
@example(
    x=1.21875, y=0.853515625, theta=0.0, dx=0.0, dy=0.00390625, turn=0.0
)  # ends on cells' borders: the last round leads down
def test_match_scan_recovers_where_a_scan_was_taken(x, y, theta, dx, dy, turn):
    row, col = ROOM.shape[0] - 1 - int(y / CELL), int(x / CELL)
    if ROOM[max(row - 6, 0) : row + 7, max(col - 6, 0) : col + 7].any():
        return  # in a wall
    truth = np.array([x, y, theta])
    scan = look(ROOM, truth, np.radians(np.arange(-180, 180, 4)))
    match = match_scan(scan, ROOM_FIELD, truth + [dx, dy, turn], Window(0.15, math.radians(4)))
    assert np.hypot(*(match.pose - truth)[:2]) < CELL
    assert abs((match.pose[2] - theta + np.pi) % (2 * np.pi) - np.pi) < CELL / 2.5  # a cell at the distance of the walls
    assert np.linalg.eigvalsh(match.covariance).min() > 0


def test_climb_ends_no_lower_than_it_began():
    rng = np.random.default_rng(3)
    window = Window()
    spacing = np.array([CELL, CELL, window.turn_step])
    higher = 0
    for _ in range(40):
        truth = np.array([*rng.uniform([1.0, 1.0], [3.4, 3.0]), rng.uniform(-3, 3)])
        scan = look(ROOM, truth, BEARINGS)
        guess = truth + rng.normal(size=3) * [0.1, 0.1, 0.05]
        began = guess + rng.integers(-2, 3, 3) * spacing

        def score(pose, scan=scan, guess=guess):
            away = pose - guess
            away[2] = (away[2] + np.pi) % (2 * np.pi) - np.pi
            return smooth_log_likelihoods(pose[None], scan.points, ROOM_FIELD)[0] - np.square(away / window.spread).sum() / 2

        ended = climb(began, scan.points, ROOM_FIELD, guess, window.spread, spacing)
        assert score(ended) >= score(began) - 1e-9
        higher += score(ended) > score(began) + 1
    assert higher > 20  # and mostly well above


def test_match_scan_moves_with_the_scan():
    truth = np.array([3.11, 1.93, 0.3])
    scan = look(ROOM, truth, BEARINGS)
    first = match_scan(scan, ROOM_FIELD, truth + [0.1, -0.05, 0.02])
    shifted = np.pad(ROOM, ((0, 7), (11, 0)))  # 7 cells more below, 11 more to the left
    second = match_scan(scan, field_of(shifted), truth + [0.1 + 11 * CELL, -0.05 + 7 * CELL, 0.02])
    np.testing.assert_allclose(second.pose - first.pose, [11 * CELL, 7 * CELL, 0], atol=2e-3)
    assert second.score == pytest.approx(first.score, abs=1e-6)


def test_match_scan_in_a_corridor_keeps_the_wheels_along_it_and_says_so():
    walls = np.zeros((60, 600), dtype=bool)
    walls[[9, 50]] = True  # two walls of 30 m, 2 m apart, no end in sight
    truth = np.array([15.0, 1.5, 0.0])
    scan = look(walls, truth, np.radians(np.arange(-80, 81, 2)), longest=4.0)
    match = match_scan(scan, field_of(walls), truth + [0.13, 0.12, 0.05])
    assert not match.trusted and "corridor" in match.distrusted_because
    assert match.pose[0] == pytest.approx(15.13, abs=0.03)  # nothing tells x but the guess
    assert match.pose[1] == pytest.approx(1.5, abs=0.03) and match.pose[2] == pytest.approx(0, abs=0.01)
    known = np.linalg.inv(match.covariance).diagonal() * Window().spread ** 2  # 1 is what the guess tells
    assert known[0] < 2 and known[1] > 50 and known[2] > 50


def test_match_scan_without_a_return_is_the_guess():
    match = match_scan(Scan(NONE, NONE, np.zeros(3)), ROOM_FIELD, [1, 1, 0.5])
    assert match.pose.tolist() == [1, 1, 0.5] and not match.trusted
    np.testing.assert_allclose(match.covariance, np.diag([0.01, 0.01, math.radians(3) ** 2]))


def test_match_scan_does_not_trust_what_the_map_does_not_explain():
    far_off = match_scan(look(ROOM, [3.5, 2.5, 0], BEARINGS), ROOM_FIELD, [100, 100, 0])
    assert "0 % of the beams" in far_off.distrusted_because and np.isfinite(far_off.pose).all()
    few = match_scan(look(ROOM, [3.5, 2.5, 0], BEARINGS[::10]), ROOM_FIELD, [3.5, 2.5, 0])
    assert "fewer than ten beams" in few.distrusted_because


def test_match_scan_on_the_rim_of_its_window_is_not_trusted():
    scan = look(ROOM, [3.5, 2.5, 0], np.radians(np.arange(-180, 180, 4)))
    assert not match_scan(scan, ROOM_FIELD, [4.0, 2.5, 0.0], Window(spread_m=0.2, reach=1.0)).trusted
    moved, turned = Window(spread_m=0.2, reach=1.0), Window(spread_turn=0.2, reach=1.0)
    for guess, window in (([3.74, 2.5, 0.0], moved), ([3.5, 2.26, 0.0], moved), ([3.5, 2.5, 0.23], turned)):
        match = match_scan(scan, ROOM_FIELD, guess, window)
        assert match.distrusted_because == "the best pose lies on the rim of the window"
    near = match_scan(scan, ROOM_FIELD, [3.5, 2.5, 0.18], turned)  # the rim is at 0.2007
    assert near.trusted and abs(near.pose[2]) < 0.01


def test_match_scan_says_what_is_wrong():
    scan = look(ROOM, [3.5, 2.5, 0], BEARINGS)
    with pytest.raises(ValueError, match="guess must be finite"):
        match_scan(scan, ROOM_FIELD, [np.nan, 0, 0])
    with pytest.raises(ValueError, match="spread_m must be a finite number above 0, got 0"):
        Window(spread_m=0)


def test_match_scan_in_a_wide_window_finds_the_room_again():
    truth = np.array([3.5, 2.5, 0.4])
    match = match_scan(look(ROOM, truth, BEARINGS), ROOM_FIELD, truth + [2.6, -1.7, 0.9], Window(3.0, 1.0, reach=1.0))
    np.testing.assert_allclose(match.pose, truth, atol=0.05)
    assert match.trusted


def test_match_scan_scores_few_of_the_poses():
    window = Window(spread_m=0.2, spread_turn=math.radians(5))
    match = match_scan(look(ROOM, [3.5, 2.5, 0.4], BEARINGS), ROOM_FIELD, [3.6, 2.4, 0.45], window)
    assert match.n_scored < 0.1 * len(window.turns) * 25**2


def test_fit_peak_of_a_known_paraboloid():
    around = np.stack(np.meshgrid(*[[-1.0, 0.0, 1.0]] * 3, indexing="ij"), axis=-1).reshape(27, 3)
    hessian = np.array([[-4.0, 1.0, 0.5], [1.0, -3.0, 0.0], [0.5, 0.0, -2.0]])
    slope = np.array([0.3, -0.2, 0.1])
    scores = 7 + around @ slope + 0.5 * np.einsum("ni,ij,nj->n", around, hessian, around)
    gradient, found = fit_peak(scores)
    np.testing.assert_allclose(gradient, slope, atol=1e-12)
    np.testing.assert_allclose(found, hessian, atol=1e-12)


def test_information_of_one_wall_is_across_it():
    walls = np.zeros((40, 200), dtype=bool)
    walls[0] = True  # one wall, y = 1.95 to 2
    scan = look(walls, [5.0, 1.0, np.pi / 2], np.radians(np.arange(-30, 31, 2)), longest=3.0)
    told = information(np.array([5.0, 1.0, np.pi / 2]), scan.points, field_of(walls), np.array([CELL, CELL, 0.01]))
    assert told[1, 1] > 100 * abs(told[0, 0]) and np.linalg.eigvalsh(told).min() >= -1e-9
