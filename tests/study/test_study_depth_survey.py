"""The arena of 5.3 and a survey of it: what the thesis says about both, and that every shortcut is none."""

import math

import numpy as np
import pytest

import priorlab as pl
from priorlab.core.grid import Grid
from priorlab.robot.depth_image import depth_image
from priorlab.robot.depth_noise import DepthNoise
from priorlab.robot.rays import cast_rays
from priorlab.robot.strip import strip_ranges
from priorlab.study.arena import build_arena
from priorlab.study.depth_survey import ByHand, survey_arena


@pytest.fixture(scope="module")
def arena():
    return build_arena()


@pytest.fixture(scope="module")
def survey(arena):
    return survey_arena(arena, np.random.default_rng(3), repeats=2)


def test_the_arena_is_three_by_four_metres_with_three_rooms(arena):
    import cv2

    height, width = (np.ptp(np.flatnonzero(arena.truth.walls.any(axis=axis))) + 1 for axis in (1, 0))
    assert (height * 0.025, width * 0.025) == (3.0, 4.0)
    closed = arena.truth.walls.copy()
    left, right = round((2.175 + 0.25) / 0.025), round((2.225 + 0.25) / 0.025)
    closed[10:-10, left:right] = True  # doorways shut
    regions, _, stats, _ = cv2.connectedComponentsWithStats((~closed).astype(np.uint8), connectivity=4)
    areas = stats[1:, cv2.CC_STAT_AREA] * 0.025**2
    assert regions - 2 == 3 and sorted(areas.round(1)) == [2.5, 2.5, 3.8, 6.2]  # 3.8: the floor outside


@pytest.mark.parametrize("scale", [0.02, 0.025, 0.05])
def test_the_plan_is_the_truth_at_every_scale(scale):
    arena = build_arena(scale)
    assert np.array_equal(arena.walls.mask, arena.truth.walls) and not arena.truth.ignore.any()
    assert arena.truth.walls.sum() * scale**2 == pytest.approx(0.05 * (2 * 4 + 2 * 2.9 + 1.8 + 1.775), rel=0.25)
    assert arena.poses[:, :2].max(axis=0) * scale == pytest.approx([3.55, 2.5])


def test_poses_look_along_four_headings_and_past_the_blind_zone(arena):
    quarter = arena.poses[:, 2] / (math.pi / 2)
    assert set(quarter.round(9) % 4) == {0, 1, 2, 3}
    ahead = cast_rays(arena.truth.walls, arena.poses[:, :2], arena.poses[:, 2], 200) * arena.metres_per_pixel
    assert ahead.min() > 0.4 and np.sort(ahead)[-3] < 3.0  # two look through the doorways to the far wall


def test_boxes_stand_in_the_relief_and_not_on_the_plan(arena):
    with_boxes = build_arena(boxes=True)
    low = with_boxes.relief.heights_m == 0.2
    assert low.sum() == 200 and not (low & with_boxes.walls.mask).any()
    assert np.array_equal(with_boxes.walls.mask, arena.walls.mask)


def test_a_scan_is_the_strip_of_its_image(survey):
    noise = DepthNoise(deviation_at_1m=0.004, hole_rate=0.3)
    for pose, repeat in ((0, 0), (5, 1)):
        whole, short = strip_ranges(survey.image(pose, repeat, noise)), survey.scan(pose, repeat, noise)
        assert np.array_equal(whole.ranges_m, short.ranges_m) and np.array_equal(whole.valid, short.valid)


def test_without_faults_a_survey_sees_what_the_camera_sees(arena):
    exact = survey_arena(arena, np.random.default_rng(0), repeats=1, by_hand=ByHand(0.0, 0.0))
    none = DepthNoise(0.0, 0.0, 0.0)
    for pose in (0, 7):
        assert np.array_equal(exact.image(pose, 0, none), depth_image(arena.relief, arena.poses[pose]))


def test_readings_tell_the_measured_poses_not_the_true_ones(arena, survey):
    readings = survey.readings(2)
    assert np.array_equal(readings.poses, arena.poses.repeat(2, axis=0))
    assert np.array_equal(readings[::2].ranges, survey.readings(1).ranges)
    assert np.array_equal(survey.readings(1, poses=slice(3, 5)).ranges, survey.readings(1).ranges[3:5])
    assert len(survey.readings(1, poses=slice(0, 0))) == 0


def test_poses_by_hand_are_as_wrong_as_said(arena):
    none = DepthNoise(0.0, 0.0, 0.0)
    right = survey_arena(arena, np.random.default_rng(0), repeats=1, by_hand=ByHand(0.0, 0.0)).readings(1, none)
    wrong = survey_arena(arena, np.random.default_rng(0), repeats=1, by_hand=ByHand(0.05, 0.0)).readings(1, none)
    both = np.isfinite(right.ranges) & np.isfinite(wrong.ranges)
    off = (np.where(both, right.ranges, 0) - np.where(both, wrong.ranges, 0))[both] * arena.metres_per_pixel
    assert 0.02 < np.median(np.abs(off)) < 0.08


def test_one_seed_one_survey(arena, survey):
    again = survey_arena(arena, np.random.default_rng(3), repeats=2)
    assert np.array_equal(again.readings(2).ranges, survey.readings(2).ranges)
    assert repr(survey) == "DepthSurvey(12 poses x 2 images of 480 x 640 px)"


@pytest.mark.parametrize("seed", range(3))
def test_the_plan_helps_most_where_cells_are_coarse_and_looks_are_few(arena, seed):
    """Thesis 5.3: with one reading and cells of 3 the map without the plan is next to nothing."""
    readings = survey_arena(arena, np.random.default_rng(seed), repeats=1).readings(1)
    evidence = pl.gather_evidence(readings, Grid(arena.truth.shape, 3, arena.metres_per_pixel))
    f2 = [
        pl.score_map(pl.update_map(pl.build_prior_map(arena.walls, prior, cell_size=3), evidence), arena.truth).f_beta
        for prior in (pl.Prior(), pl.Prior.uninformed())
    ]
    assert f2[0] > 1.5 * f2[1]


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda survey: survey.readings(3), "repeats must lie between 1 and the 2 images of a pose, got 3"),
        (lambda survey: survey.readings(0), "got 0"),
        (lambda survey: survey_arena(survey.arena, np.random.default_rng(0), repeats=0), "repeats must be at least 1, got 0"),
        (lambda survey: ByHand(position_m=-0.1), "position_m must be a finite number of at least 0, got -0.1"),
        (lambda survey: build_arena(0.5), "metres_per_pixel must leave the arena at least 10 pixels, got 0.5"),
        (lambda survey: build_arena(0), "metres_per_pixel must be a finite number above 0"),
    ],
)
def test_depth_survey_says_what_is_wrong(survey, make, sentence):
    with pytest.raises(ValueError, match=sentence):
        make(survey)
