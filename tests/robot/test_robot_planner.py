"""Surveys and tours of a small house: corridor, four rooms, a closet, one front door."""

import cv2
import numpy as np
import pytest

from priorlab.core.building import Truth, World
from priorlab.core.drawing import Door, Walls
from priorlab.core.grid import Grid
from priorlab.robot.drive import drive
from priorlab.robot.explore import explore
from priorlab.robot.free_space import LeakError, find_free_space
from priorlab.robot.planner import plan_survey, plan_tour

DOOR, SCALE = 17, 0.05


def make_house(missing=(), closed=()):
    """Walls (140 x 200 px) and doors; `missing` boxes (y0, y1, x0, x1) are cut out of the walls, `closed` doors walled up."""
    ink = np.zeros((140, 200), dtype=np.uint8)
    for y0, y1, x0, x1 in (
        (10, 13, 10, 190),
        (127, 130, 10, 190),
        (10, 130, 10, 13),
        (10, 130, 187, 190),
        (55, 58, 10, 190),
        (85, 88, 10, 190),
        (10, 58, 90, 93),
        (85, 130, 110, 113),
        (85, 130, 170, 173),
    ):
        ink[y0:y1, x0:x1] = 1
    doors = []
    for number, (x, y, upright) in enumerate(
        [(30, 55, False), (130, 55, False), (40, 85, False), (140, 85, False), (10, 63, True), (172, 85, False)]
    ):
        width = 13 if number == 5 else DOOR  # the closet's
        box = (slice(y, y + width), slice(x, x + 3)) if upright else (slice(y, y + 3), slice(x, x + width))
        if number not in closed:
            ink[box] = 0
        along, across = ((0, width), (width, 0)) if upright else ((width, 0), (0, width))
        hinge = (x + 1, y) if upright else (x, y + 1)
        strike, tip = ((hinge[0] + dx, hinge[1] + dy) for dx, dy in (along, across))
        doors.append(Door(hinge, strike, tip))
    for y0, y1, x0, x1 in missing:
        ink[y0:y1, x0:x1] = 0
    return Walls(ink, SCALE), tuple(doors)


ROOMS = {
    "upper left": (50, 105),
    "upper right": (140, 105),
    "corridor": (100, 68),
    "lower left": (60, 32),
    "lower right": (140, 32),
    "closet": (180, 32),
}
"""A point x, y (pixels, y up) in each room."""


def rooms_of(points):
    """Names of the rooms that hold points x, y: by flooding the house with its doors closed."""
    walls, doors = make_house()
    plan = walls.labels.copy()
    for door in doors:
        cv2.line(plan, tuple(map(int, door.hinge)), tuple(map(int, door.strike)), 1, 3)
    _, parts = cv2.connectedComponents(1 - plan, connectivity=4)
    names = {parts[139 - y, x]: name for name, (x, y) in ROOMS.items()}
    return {names.get(parts[139 - int(y), int(x)]) for x, y in points}


def clearance_of(points, walls):
    """Distance of points x, y to the nearest wall pixel, one by one."""
    wall_xy = Grid(walls.shape).pixel_to_xy(np.argwhere(walls.mask))
    return np.array([np.hypot(*(wall_xy - point).T).min() for point in points])


@pytest.mark.parametrize("with_doors", [True, False])
def test_plan_survey_looks_into_every_room(with_doors):
    walls, doors = make_house()
    poses = plan_survey(walls, doors if with_doors else ())
    assert rooms_of(poses[:, :2]) - {None} >= set(ROOMS) - {"closet"}
    assert not with_doors or "closet" in rooms_of(poses[:, :2])
    assert clearance_of(poses[:, :2], walls).min() > 0.2 * min(13, DOOR)
    readings = explore(Truth(walls.mask, walls.mask & False), poses)
    assert len(readings) == len(poses)


def test_plan_survey_stays_indoors():
    walls, doors = make_house()
    x, y, _ = plan_survey(walls, doors).T
    assert x.min() > 10 and x.max() < 190 and y.min() > 10 and y.max() < 130


def test_plan_survey_is_denser_with_a_shorter_spacing():
    walls, doors = make_house()
    sparse, dense = (len(plan_survey(walls, doors, spacing=spacing)) for spacing in (12, 3))
    assert 3 < dense / sparse < 4.5


def test_plan_tour_visits_every_room_and_can_be_driven():
    walls, doors = make_house()
    tour = plan_tour(walls, doors)
    assert rooms_of(tour / SCALE) - {None} == set(ROOMS)
    log = drive(World(walls.mask, SCALE), tour, rng=np.random.default_rng(0))
    assert clearance_of(log.truth[::5, :2] / SCALE, walls).min() > 0.2 * 13


def test_plan_tour_in_pixels_is_the_tour_in_metres():
    walls, doors = make_house()
    np.testing.assert_allclose(plan_tour(walls, doors, in_pixels=True) * SCALE, plan_tour(walls, doors))


def test_plan_tour_leaves_out_a_room_without_a_door():
    walls, doors = make_house(closed=[1])
    assert rooms_of(plan_tour(walls, doors) / SCALE) - {None} == set(ROOMS) - {"upper right"}


def test_plan_tour_of_one_room_goes_from_end_to_end():
    ink = np.pad(np.zeros((40, 90), dtype=np.uint8), 3, constant_values=1)
    tour = plan_tour(Walls(ink), door_width=17, in_pixels=True)
    assert np.ptp(tour[:, 0]) > 70


def test_find_free_space_tells_the_rooms_apart():
    walls, doors = make_house()
    space = find_free_space(walls, doors)
    rooms = {name: space.rooms[139 - y, x] for name, (x, y) in ROOMS.items()}
    assert sorted(rooms.values()) == [1, 2, 3, 4, 5, 6]


def test_find_free_space_closes_a_front_door_that_is_not_known():
    walls, _ = make_house()
    space = find_free_space(walls, door_width=DOOR)
    assert space.drivable[139 - 68, 100] and not space.drivable[:, :9].any()
    assert 0.9 < space.share_indoors <= 1.0


def test_a_room_whose_wall_is_missing_is_outdoors():
    walls, doors = make_house(missing=[(10, 13, 20, 70)])
    poses = plan_survey(walls, doors)
    assert rooms_of(poses[:, :2]) - {None} == set(ROOMS) - {"upper left"}


def test_a_building_that_leaks_says_where():
    ink = np.pad(np.zeros((94, 144), dtype=np.uint8), 3, constant_values=1)
    ink[:3, 60:100] = 0
    with pytest.raises(LeakError, match="leaks outdoors near x, y = ") as caught:
        plan_survey(Walls(np.pad(ink, 10)), door_width=17)
    words = str(caught.value).replace(",", "").split()
    x, y = (float(words[words.index("=") + k]) for k in (1, 2))
    gap = float(words[words.index("gap") + 2])
    assert 70 <= x <= 110 and 100 <= y <= 116 and gap == pytest.approx(40, abs=3)


def test_a_building_that_mostly_leaks_says_where_though_a_closet_is_closed():
    walls, doors = make_house(
        missing=[(88, 127, 10, 13), (13, 55, 10, 13), (13, 55, 187, 190), (58, 85, 187, 190), (88, 110, 110, 113)]
    )
    opened = walls.labels.copy()
    opened[127:130, 115:160] = 0
    with pytest.raises(LeakError, match="leaks outdoors near x, y = "):
        plan_tour(Walls(opened, SCALE), doors)


@pytest.mark.parametrize(
    ("walls", "keywords", "sentence"),
    [
        (Walls(np.zeros((50, 50), np.uint8)), {"door_width": 9}, "walls must hold at least one wall pixel to plan between"),
        (Walls(np.eye(50, dtype=np.uint8)), {}, "door_width must be known to plan, got None"),
        (Walls(np.eye(50, dtype=np.uint8)), {"door_width": 0}, "door_width must be a finite number above 0, got 0"),
        (make_house()[0], {"spacing": 0}, "spacing must be a finite number above 0, got 0"),
        (make_house()[0], {"clearance": -1}, "clearance must be a finite number above 0, got -1"),
        (make_house()[0], {"max_range": np.inf}, "max_range must be a finite number above 0, got inf"),
    ],
)
def test_plan_survey_says_what_is_wrong(walls, keywords, sentence):
    with pytest.raises(ValueError, match=sentence):
        plan_survey(walls, **keywords)


def test_plan_tour_in_metres_needs_a_scale():
    walls, doors = make_house()
    with pytest.raises(ValueError, match="metres_per_pixel must be known"):
        plan_tour(Walls(walls.labels), doors)
