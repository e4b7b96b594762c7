"""Surveys of small rooms whose ranges are known."""

import math

import numpy as np
import pytest

from priorlab.core.building import Truth, World
from priorlab.core.drawing import Door
from priorlab.core.grid import Grid
from priorlab.core.sensor import RangeSensor
from priorlab.mapping.evidence import gather_evidence
from priorlab.robot.explore import bearings_of, explore
from priorlab.robot.range_noise import RangeNoise

ROOM = np.pad(np.zeros((20, 30), dtype=bool), 2, constant_values=True)
TRUTH = Truth(ROOM, ROOM & False)
MIDDLE = [17.0, 12.0, 0.0]


def test_explore_measures_a_flat_wall_exactly():
    readings = explore(TRUTH, [MIDDLE], RangeSensor(max_range=40))
    expected = np.minimum(15 / np.cos(readings.bearings), 10 / np.abs(np.sin(readings.bearings) + 1e-300))
    np.testing.assert_allclose(readings.ranges[0], expected, atol=1e-9)
    assert readings.image_shape == ROOM.shape


def test_explore_says_inf_beyond_the_range():
    readings = explore(TRUTH, [MIDDLE, [25.0, 12.0, 0.0]], RangeSensor(max_range=8))
    middle = len(readings.bearings) // 2
    assert readings.ranges[0, middle] == math.inf and readings.ranges[1, middle] == 7.0


def test_explore_meets_furniture_and_windows_too():
    furniture, windows = ROOM.copy(), np.zeros_like(ROOM)
    furniture[:, 20] = windows[:, 21] = True
    sensor = RangeSensor(max_range=40)
    middle = len(bearings_of(sensor)) // 2
    assert explore(World(furniture, 0.05), [MIDDLE], sensor).ranges[0, middle] == 3.0
    assert explore(Truth(ROOM, ROOM & False, windows=windows), [MIDDLE], sensor).ranges[0, middle] == 4.0


@pytest.mark.parametrize("max_range", [1, 7.5, 20, 40, 133])
def test_bearings_are_at_most_a_pixel_apart_at_the_end_of_the_range(max_range):
    sensor = RangeSensor(max_range=max_range)
    bearings = bearings_of(sensor)
    assert np.diff(bearings).max() * max_range <= 1 + 1e-9
    assert bearings[0] == -sensor.half_angle and bearings[-1] == sensor.half_angle
    assert bearings[len(bearings) // 2] == 0.0


def test_repeats_have_noise_of_their_own():
    noise = RangeNoise(deviation=0.5)
    readings = explore(TRUTH, [MIDDLE, [10.0, 12.0, 0.0]], RangeSensor(max_range=60), np.random.default_rng(1), noise, repeats=3)
    assert readings.poses[:, 0].tolist() == [17, 17, 17, 10, 10, 10]
    exact = explore(TRUTH, readings.poses, RangeSensor(max_range=60)).ranges
    off = readings.ranges - exact
    assert 0.4 < off.std() < 0.6
    assert not np.allclose(off[0], off[1])


def test_explore_has_no_reading_where_one_is_lost():
    noise = RangeNoise(dropout_rate=0.3)
    readings = explore(TRUTH, [MIDDLE] * 50, RangeSensor(max_range=60), np.random.default_rng(2), noise)
    assert 0.25 < readings.share_missing < 0.35
    assert (np.isnan(readings.ranges) == ~readings.valid).all()
    exact = explore(TRUTH, [MIDDLE] * 50, RangeSensor(max_range=60))
    assert exact.valid is None and (readings.ranges == exact.ranges)[readings.valid].all()


def test_explore_in_the_blind_zone_has_no_reading_and_frees_nothing():
    """A wall 15 px ahead: a sensor that is blind below 20 px must not take it for free space up to its range."""
    blind = explore(TRUTH, [MIDDLE], RangeSensor(max_range=40), np.random.default_rng(0), RangeNoise(min_range=20.0))
    near = explore(TRUTH, [MIDDLE], RangeSensor(max_range=40)).ranges < 20.0
    assert near.any() and (blind.valid == ~near).all()
    ahead = gather_evidence(blind, Grid(ROOM.shape))
    assert not ahead.looks[ROOM.shape[0] - 1 - 12, 18:].any()


def test_explore_measures_by_chance_what_stands_a_little_beyond_the_range():
    readings = explore(TRUTH, [MIDDLE] * 400, RangeSensor(max_range=14.5), np.random.default_rng(3), RangeNoise(deviation=0.5))
    ahead = readings.ranges[:, len(readings.bearings) // 2]  # the wall stands at 15
    assert np.isfinite(ahead).mean() == pytest.approx(0.159, abs=0.06) and ahead[np.isfinite(ahead)].max() <= 14.5


def test_explore_says_how_far_it_is_and_can_be_interrupted(monkeypatch):
    monkeypatch.setattr("priorlab.robot.rays.RAYS_AT_ONCE", 100)
    told = []
    explore(TRUTH, [MIDDLE] * 20, RangeSensor(max_range=40), progress=lambda done, to_do: told.append((done, to_do)))
    assert told == sorted(told) and told[-1] == (20, 20) and len(told) == math.ceil(20 * 43 / 100)

    def interrupt(done, to_do):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        explore(TRUTH, [MIDDLE], progress=interrupt)


def test_explore_is_the_same_for_the_same_seed():
    noise = RangeNoise(deviation=0.5, outlier_rate=0.1)
    one, two = (explore(TRUTH, [MIDDLE], rng=np.random.default_rng(5), noise=noise).ranges for _ in range(2))
    assert (one == two).all()


def house(*doors):
    """A room of 20 x 30 in a garden of 8 all round, with an open front door of 6 in its lower wall."""
    walls = np.pad(ROOM, 8)
    walls[30:32, 20:26] = False
    return Truth(walls, walls & False, doors)


def test_explore_says_when_a_survey_leaves_the_building():
    front = Door(hinge=(20.0, 31.0), strike=(26.0, 31.0), tip=(23.0, 36.0))
    indoors, in_the_garden = [25.0, 20.0, 0.0], [4.0, 30.0, 0.0]
    assert len(explore(house(front), [indoors])) == 1
    with pytest.raises(ValueError, match="survey must stay in the building, got x, y = 4, 30 outdoors in row 1"):
        explore(house(front), [indoors, in_the_garden])
    for nobody_can_tell in (house(), World(house(front).walls, 0.05)):
        assert len(explore(nobody_can_tell, [indoors, in_the_garden])) == 2


@pytest.mark.parametrize("width", [6, 9])
def test_explore_takes_an_opening_without_a_door_for_no_way_out(width):
    """A second way out, not twice as wide as a door: the rooms behind it are still indoors, the garden is not."""
    open_house = house(Door(hinge=(20.0, 31.0), strike=(26.0, 31.0), tip=(23.0, 36.0)))
    open_house.walls[8:10, 25 : 25 + width] = False
    by_the_opening, beside_the_wall = [25.0 + width / 2, 25.0, 0.0], [25.0 + width / 2, 33.0, 0.0]
    assert len(explore(open_house, [by_the_opening])) == 1
    with pytest.raises(ValueError, match="outdoors in row 0"):
        explore(open_house, [beside_the_wall])


@pytest.mark.parametrize(
    ("survey", "keywords", "sentence"),
    [
        ([], {}, "survey must hold at least one pose x, y, theta, got none"),
        ([MIDDLE, [1.0, 2.0]], {}, r"survey must be rows of three numbers x, y, theta, got \[\[17"),
        ([["a", "b", "c"]], {}, r"survey must be rows of three numbers x, y, theta, got \[\['a'"),
        ([[1.0, 2.0]], {}, r"survey must have shape \(N, 3\)"),
        ([MIDDLE, [math.nan, 2, 0]], {}, r"survey must be finite numbers, got \[nan, 2.0, 0.0\] in row 1"),
        ([MIDDLE, [34.0, 2, 0]], {}, "survey must stay on the map of 34 x 24 pixels, got x, y = 34, 2 in row 1"),
        ([MIDDLE, [1.0, 5, 0]], {}, "survey must stand in free space, got an obstacle at x, y = 1, 5 in row 1"),
        ([MIDDLE], {"repeats": 0}, "repeats must be a whole number of at least 1, got 0"),
        ([MIDDLE], {"repeats": "3"}, "repeats must be a number, got '3'"),
        ([MIDDLE], {"noise": RangeNoise(1.0)}, "rng must be a numpy Generator.*got None"),
    ],
)
def test_explore_says_what_is_wrong(survey, keywords, sentence):
    with pytest.raises(ValueError, match=sentence):
        explore(TRUTH, survey, **keywords)
