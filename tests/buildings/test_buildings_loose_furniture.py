"""Furniture put into a building by chance: the plan stays, rooms stay reachable, doors stay clear."""

import cv2
import numpy as np
import pytest

from priorlab.buildings.description import read_description
from priorlab.buildings.floor_plans import build_floor_plan
from priorlab.buildings.loose_furniture import with_loose_furniture
from priorlab.core.shipped import data_folder


@pytest.fixture(scope="module")
def flat():
    return read_description(data_folder() / "small_flat.toml")


@pytest.fixture(scope="module")
def furnished(flat):
    return with_loose_furniture(flat, 0.6, np.random.default_rng(1))


def loose(description):
    return [piece for piece in description.furniture if piece.only_in_world]


def test_with_loose_furniture_leaves_the_plan_as_it_is(flat, furnished):
    plan, other = build_floor_plan(flat), build_floor_plan(furnished)
    np.testing.assert_array_equal(plan.drawing.grey, other.drawing.grey)
    np.testing.assert_array_equal(plan.truth.walls, other.truth.walls)
    np.testing.assert_array_equal(plan.truth.ignore, other.truth.ignore)
    assert (other.world.obstacles & ~plan.world.obstacles).any()


def test_with_loose_furniture_puts_in_about_four_times_the_clutter_a_room(flat):
    floor = read_description(data_folder() / "office_floor.toml")  # rooms that are large enough
    pieces = loose(with_loose_furniture(floor, 0.3, np.random.default_rng(0)))
    assert len(floor.rooms) <= len(pieces) <= 2 * len(floor.rooms)
    assert not loose(with_loose_furniture(floor, 0.0, np.random.default_rng(0)))
    assert loose(floor)  # it had some that were taken out


def test_with_loose_furniture_keeps_every_room_reachable_and_doors_clear(flat, furnished):
    plan = build_floor_plan(furnished)  # the tour raises when a room cannot be reached
    added = plan.world.obstacles & ~build_floor_plan(with_loose_furniture(flat, 0.0, np.random.default_rng(0))).world.obstacles
    scale, height = plan.metres_per_pixel, added.shape[0]
    left, bottom, _, _ = flat.sheet.margins
    for door in flat.doors:
        near = np.zeros(added.shape, np.uint8)
        at = (round((door.at[0] + left) / scale), round(height - (door.at[1] + bottom) / scale))
        cv2.circle(near, at, round(0.95 / scale), 1, -1)
        assert not (added & near.astype(bool)).any()


def test_with_loose_furniture_is_the_same_for_the_same_seed(flat, furnished):
    assert with_loose_furniture(flat, 0.6, np.random.default_rng(1)).furniture == furnished.furniture
    assert with_loose_furniture(flat, 0.6, np.random.default_rng(2)).furniture != furnished.furniture


@pytest.mark.parametrize("clutter", [-0.1, np.nan, np.inf])
def test_with_loose_furniture_asks_for_a_share(flat, clutter):
    with pytest.raises(ValueError, match="clutter must be a finite number of at least 0"):
        with_loose_furniture(flat, clutter, np.random.default_rng(0))
