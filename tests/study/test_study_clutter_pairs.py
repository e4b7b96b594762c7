"""A clean plan as the prior in a furnished building: a small pair made by hand, the real ones where PRIORLAB_REAL_DATA says.

`make real DATA=folder` prints the real table.
"""

import os
from pathlib import Path

import cv2
import numpy as np
import pytest

from priorlab.core.drawing import Walls
from priorlab.study.clutter_pairs import Pair, as_walls, clutter_pair, drive_pair, longest_blind_way_m, pairs_table, read_pair
from priorlab.study.full_tour import full_tour


@pytest.fixture(scope="module")
def pair():
    """Two rooms of 4 x 5 m with a doorway between them; a desk and a box stand in the way."""
    plan = np.zeros((108, 172), dtype=bool)
    plan[:4] = plan[-4:] = plan[:, :4] = plan[:, -4:] = plan[:, 84:88] = True
    plan[40:62, 84:88] = False
    world = plan.copy()
    world[6:18, 20:50] = world[80:90, 130:140] = True
    return Pair("hut", plan, world)


def test_full_tour_leaves_no_place_far_off(pair):
    walls = as_walls(pair.world, 0.05)
    tour = full_tour(walls, apart_m=1.5)
    col, row = tour[:, 0] / 0.05, 108 - tour[:, 1] / 0.05
    assert not pair.world[row.astype(int), col.astype(int)].any()
    assert (tour[:, 0] < 4).any() and (tour[:, 0] > 5).any()  # both rooms
    along = np.concatenate([np.linspace(a, b, 50) for a, b in zip(tour[:-1], tour[1:], strict=True)])
    distance = cv2.distanceTransform((~pair.world).astype(np.uint8), cv2.DIST_L2, 5)
    rows, cols = np.nonzero(distance > 12)  # places where it can stand
    places = np.column_stack([cols + 0.5, 108 - rows - 0.5]) * 0.05
    nearest = np.array([np.hypot(*(along - place).T).min() for place in places[::37]])
    assert nearest.max() < 1.5 + 0.2
    assert len(full_tour(walls, apart_m=6.0)) < len(tour)


def test_full_tour_near_its_landmarks_goes_round_a_hall():
    hall = np.zeros((208, 308), dtype=bool)
    hall[:4] = hall[-4:] = hall[:, :4] = hall[:, -4:] = True  # 15 x 10 m
    furnished = hall.copy()
    furnished[100:108, 150:158] = True  # a pillar that the plan does not know: no landmark

    def farthest(tour):
        along = np.concatenate([np.linspace(a, b, 50) for a, b in zip(tour[:-1], tour[1:], strict=True)])
        return np.minimum.reduce([along[:, 0], along[:, 1], 15.4 - along[:, 0], 10.4 - along[:, 1]]).max() - 0.2

    walls = as_walls(furnished, 0.05)
    across, round_it = full_tour(walls), full_tour(walls, landmarks=hall, near_m=1.5)
    assert farthest(across) > 4 and farthest(round_it) < 1.55
    assert np.ptp(round_it, axis=0).min() > 6  # all round, not along one wall


def test_full_tour_leaves_its_landmarks_where_it_must(pair):
    only_left = pair.plan.copy()
    only_left[:, 60:] = False  # nothing in the right room is a landmark: it lies behind, and stops are on the left alone
    tour = full_tour(as_walls(pair.world, 0.05), landmarks=only_left, near_m=1.0)
    assert tour[:, 0].max() < 4.2
    both_ends = pair.plan.copy()
    both_ends[:, 40:130] = False
    tour = full_tour(as_walls(pair.world, 0.05), landmarks=both_ends, near_m=1.0)
    assert tour[:, 0].min() < 2 and tour[:, 0].max() > 6.5  # through the doorway, far from both


def test_full_tour_covers_the_largest_part(pair):
    solid = pair.plan.copy()
    solid[40:62, 84:88] = True  # the doorway is walled up
    solid[:, 30:34] = True  # so the right room is the largest part; the first pixel lies in the left one
    tour = full_tour(as_walls(solid, 0.05), apart_m=1.5)
    assert tour[:, 0].min() > 4.4 and len(tour) > 4
    rows, cols = np.nonzero(cv2.distanceTransform((~solid).astype(np.uint8), cv2.DIST_L2, 5) > 12)
    places = np.column_stack([cols + 0.5, 108 - rows - 0.5])[cols > 88] * 0.05
    assert max(np.hypot(*(tour - place).T).min() for place in places[::37]) < 2
    with pytest.raises(ValueError, match="the largest part of the free space must hold a place for the robot near its landmarks"):
        full_tour(as_walls(solid, 0.05), landmarks=np.pad(solid[:, :20], ((0, 0), (0, 152))), near_m=1.0)


@pytest.mark.parametrize("as_image", [lambda mask: mask.astype(int), lambda mask: 255 * mask.astype(np.uint8), np.ndarray.tolist])
def test_full_tour_takes_landmarks_as_any_image(pair, as_image):
    walls = as_walls(pair.world, 0.05)
    expected = full_tour(walls, landmarks=pair.plan, near_m=1.0)
    np.testing.assert_array_equal(full_tour(walls, landmarks=as_image(pair.plan), near_m=1.0), expected)


def test_full_tour_says_what_is_wrong(pair):
    with pytest.raises(ValueError, match="near_m must be a number, got 'a'"):
        full_tour(as_walls(pair.world, 0.05), near_m="a")
    with pytest.raises(ValueError, match="landmarks must be a 2-D image with at least one pixel, got shape"):
        full_tour(as_walls(pair.world, 0.05), landmarks=[True, False])
    with pytest.raises(ValueError, match="apart_m must be a finite number above 0"):
        full_tour(as_walls(pair.world, 0.05), apart_m=0)
    with pytest.raises(ValueError, match="metres_per_pixel must be known"):
        full_tour(Walls(as_walls(pair.world, 0.05).labels))
    with pytest.raises(ValueError, match="near_m must be above 0, got -1"):
        full_tour(as_walls(pair.world, 0.05), near_m=-1)
    with pytest.raises(ValueError, match=r"landmarks must have the shape of the walls, \(108, 172\), got \(10, 10\)"):
        full_tour(as_walls(pair.world, 0.05), landmarks=np.ones((10, 10), dtype=bool))
    with pytest.raises(ValueError, match="a place for the robot"):
        full_tour(as_walls(pair.world, 0.05), landmarks=pair.plan, near_m=0.05)


def test_pair_truth_counts_only_the_skin_of_thick_walls():
    plan = np.zeros((40, 40), dtype=bool)
    plan[:, :20] = True
    counted = ~Pair("block", plan, plan).truth.ignore
    assert counted[20, 18:].all() and not counted[20, :17].any()  # two pixels of 5 cm


def test_read_pair_reads_what_lies_there_and_refuses_other_sizes(tmp_path, pair):
    for end, solid in (("", pair.plan), ("_furnitures", pair.world)):
        cv2.imwrite(str(tmp_path / f"hut{end}.png"), np.where(solid, 0, 255).astype(np.uint8))
    read = read_pair(tmp_path, "hut")
    np.testing.assert_array_equal(read.plan, pair.plan)
    np.testing.assert_array_equal(read.world, pair.world)
    with pytest.raises(FileNotFoundError):
        read_pair(tmp_path, "barn")
    cv2.imwrite(str(tmp_path / "hut_furnitures.png"), 255 * np.eye(50, dtype=np.uint8))
    with pytest.raises(ValueError, match="hut_furnitures.png must be as large as hut.png"):
        read_pair(tmp_path, "hut")


def test_drive_pair_finds_its_way_and_the_plan_pays(pair):
    row = drive_pair(pair, seed=1, step_m=0.2)
    assert row.run.ate_m() < 0.2 and not row.run.lost
    assert row.f2_plan > row.f2_none and row.gain == pytest.approx(row.f2_plan / row.f2_none - 1)
    assert row.f2_prior == 1.0 and 0.3 < row.seen <= 1
    again = drive_pair(pair, seed=1, step_m=0.2)
    np.testing.assert_array_equal(again.run.trajectory, row.run.trajectory)
    header, line = pairs_table([row]).splitlines()
    assert header.split()[0] == "building" and line.split()[0] == "hut" and line.endswith("%")


def test_longest_blind_way_is_summed_between_scans_that_return(pair):
    run = drive_pair(pair, seed=0, step_m=0.5).run
    way, blind, longest = 0.0, 0.0, 0.0
    for k in range(1, len(run)):
        way = float(np.hypot(*(run.log.odometry[k] - run.log.odometry[k - 1])[:2]))
        blind = 0.0 if np.isfinite(run.explained[k]) else blind + way
        longest = max(longest, blind)
    assert longest_blind_way_m(run) == pytest.approx(longest)


@pytest.mark.skipif("PRIORLAB_REAL_DATA" not in os.environ, reason="PRIORLAB_REAL_DATA is not set")
def test_clutter_pairs_of_real_buildings():
    """Three buildings, five seeds each; three minutes."""
    folder = Path(os.environ["PRIORLAB_REAL_DATA"]) / "clutter_pairs"
    rows = [clutter_pair(folder, name, seed) for name in ("lab_ipa", "lab_intel", "office_a") for seed in range(5)]
    print("\n" + pairs_table(rows))
    for row in rows:
        assert not row.run.lost and row.run.ate_m() <= 0.3 and row.f2_plan > row.f2_none
