"""What every shipped building promises: exact truth, a survey in free space, a tour that can be driven."""

import math

import numpy as np
import pytest

from priorlab.buildings.description import read_description
from priorlab.buildings.floor_plans import build_floor_plan, floor_plan_names, load_floor_plan, sensor_range
from priorlab.core.grid import Grid
from priorlab.core.sensor import RangeSensor
from priorlab.core.shipped import data_folder

NAMES = ["busy_flat", "office_floor", "office_wing", "small_flat"]


@pytest.fixture(params=NAMES)
def plan(request):
    return load_floor_plan(request.param)


def test_floor_plan_names_hold_the_four_promised():
    assert set(NAMES) <= set(floor_plan_names())


def test_shapes_and_scale_agree(plan):
    shape = plan.drawing.shape
    assert plan.truth.walls.shape == plan.truth.ignore.shape == plan.truth.windows.shape == plan.world.obstacles.shape == shape
    assert plan.drawing.metres_per_pixel == plan.world.metres_per_pixel == plan.truth.metres_per_pixel == plan.metres_per_pixel


def test_ink_is_dark_where_the_truth_says_wall(plan):
    assert (plan.drawing.grey[plan.truth.walls] <= 128).mean() > 0.999


def test_walls_are_the_heaviest_ink(plan):
    """A wall pixel that is don't-care would not count: only doorways that the plan walls up may be both."""
    both = plan.truth.walls & plan.truth.ignore & ~plan.truth.windows
    assert both.any() == (plan.name == "office_floor")
    assert np.array_equal(both, both & ~plan.world.obstacles | both & plan.truth.walls)


def test_world_contains_the_walls_of_the_plan_except_doorways_walled_up(plan):
    missing = plan.truth.obstacles & ~plan.world.obstacles
    if plan.name != "office_floor":
        assert not missing.any()
    else:  # two gaps of 1 m through walls of 0.15 m and 0.2 m
        assert np.count_nonzero(missing) * plan.metres_per_pixel**2 == pytest.approx(1 * 0.15 + 1 * 0.2, rel=0.05)
        assert plan.truth.ignore[missing].all()


def test_world_of_office_floor_holds_furniture_that_the_plan_lacks():
    plan = load_floor_plan("office_floor")
    added = plan.world.obstacles & ~plan.truth.obstacles & ~plan.truth.ignore
    assert added.sum() * plan.metres_per_pixel**2 > 15  # square metres
    assert np.mean(plan.drawing.grey[added] == 255) > 0.9
    half_open = [door for door in read_description(data_folder() / "office_floor.toml").doors if 0 < door.open < 90]
    assert len(half_open) >= 3


def test_jambs_touch_walls(plan):
    structure = plan.truth.walls | plan.truth.ignore & plan.world.obstacles
    for door in plan.truth.doors:
        jambs = [door.hinge] if door.kind == "double" else [door.hinge, door.strike]
        for x, y in jambs:
            row, col = int(y), int(x)
            assert structure[row - 2 : row + 3, col - 2 : col + 3].any(), f"{plan.name}: {door}"


def test_leaves_end_on_ink(plan):
    for door in plan.truth.doors:
        x, y = door.tip
        patch = plan.drawing.grey[int(y) - 2 : int(y) + 3, int(x) - 2 : int(x) + 3]
        assert patch.min() < 160, f"{plan.name}: {door}"


def test_doors_are_isosceles_and_wide_enough(plan):
    for door in plan.truth.doors:
        if door.kind in ("folding", "double"):
            continue
        leaf = math.dist(door.hinge, door.tip)
        assert leaf == pytest.approx(door.width)
        assert door.width >= 35


def test_survey_stands_in_free_space(plan):
    pixels = Grid(plan.drawing.shape).xy_to_pixel(plan.survey[:, :2])
    near = [(dr, dc) for dr in (-2, 0, 2) for dc in (-2, 0, 2)]
    for dr, dc in near:
        rows, cols = (pixels + (dr, dc)).T
        assert not plan.truth.walls[rows, cols].any()
        assert not plan.world.obstacles[rows, cols].any()


def test_survey_looks_in_the_four_headings_by_turns(plan):
    quarter = plan.survey[:, 2] / (np.pi / 2)
    assert np.allclose(quarter, np.round(quarter))
    assert set(np.round(quarter).astype(int) % 4) == {0, 1, 2, 3}


def looks_by_loop(plan, spacing=None):
    """Mean looks per seen 3-pixel cell, by stepping along beams: slow, coarse, and nothing of the package's ray casting."""
    survey = load_floor_plan(plan.name, survey_spacing=spacing).survey
    reach, height = sensor_range(plan.truth), plan.drawing.shape[0]
    looks = np.zeros((height // 3 + 1, plan.drawing.shape[1] // 3 + 1), dtype=int)
    steps = np.arange(0.5, reach, 1.0)
    bearings = np.linspace(-math.pi / 6, math.pi / 6, 41)[:, None]
    for x, y, theta in survey:
        cols = (x + steps * np.cos(theta + bearings)).astype(int)
        rows = (height - y - steps * np.sin(theta + bearings)).astype(int)
        open_so_far = ~np.logical_or.accumulate(plan.truth.obstacles[rows, cols], axis=1)
        cells = np.unique(np.column_stack([rows[open_so_far] // 3, cols[open_so_far] // 3]), axis=0)
        looks[cells[:, 0], cells[:, 1]] += 1
    return looks[looks > 0].mean()


def test_default_survey_is_a_quick_one(plan):
    assert RangeSensor(max_range=40).max_range == pytest.approx(sensor_range(plan.truth), abs=4.1)
    assert 1.2 < looks_by_loop(plan) < 2.8


def test_survey_spacing_sets_the_density():
    plan = load_floor_plan("small_flat")
    assert len(load_floor_plan("small_flat", survey_spacing=4).survey) > 2.5 * len(plan.survey)
    assert looks_by_loop(plan, spacing=4) > 2 * looks_by_loop(plan)


def clearance_by_loop(plan):
    """Smallest distance from the tour to the middle of any obstacle pixel, metres, every 5 cm."""
    scale, height = plan.metres_per_pixel, plan.drawing.shape[0]
    reach = math.ceil(0.4 / scale)
    nearest = math.inf
    for start, end in zip(plan.tour, plan.tour[1:], strict=False):
        n = max(2, math.ceil(math.dist(start, end) / 0.05))
        for x, y in start + np.linspace(0, 1, n)[:, None] * (end - start):
            row, col = int(height - y / scale), int(x / scale)
            rows, cols = np.nonzero(plan.world.obstacles[row - reach : row + reach + 1, col - reach : col + reach + 1])
            dx = (cols + col - reach + 0.5) * scale - x
            dy = (height - (rows + row - reach) - 0.5) * scale - y
            nearest = min(nearest, float(np.hypot(dx, dy).min(initial=math.inf)))
    return nearest


def test_tour_keeps_clear_of_every_obstacle(plan):
    assert clearance_by_loop(plan) > 0.2


def test_tour_enters_every_room(plan):
    description = read_description(data_folder() / f"{plan.name}.toml")
    left, bottom = description.sheet.margins[:2]
    for room in description.rooms:
        x, y = (room.visit or (room.at,))[0]
        nearest = min(math.dist((x + left, y + bottom), corner) for corner in plan.tour)
        assert nearest < 1.0, f"{plan.name}: {room.name}"


def test_tour_share_leaves_the_exploration_incomplete():
    whole, half = load_floor_plan("office_floor").tour, load_floor_plan("office_floor", tour_share=0.5).tour
    assert np.array_equal(whole[: len(half) - 1], half[:-1])
    lengths = [np.hypot(*np.diff(tour, axis=0).T).sum() for tour in (half, whole)]
    assert 0.3 < lengths[0] / lengths[1] < 0.8
    with pytest.raises(ValueError, match="tour_share must lie above 0 and up to 1, got 0"):
        load_floor_plan("office_floor", tour_share=0)


def test_building_twice_gives_the_same_to_the_last_bit(plan):
    again = build_floor_plan(read_description(data_folder() / f"{plan.name}.toml"))
    assert np.array_equal(plan.drawing.grey, again.drawing.grey)
    assert np.array_equal(plan.truth.walls, again.truth.walls) and np.array_equal(plan.truth.ignore, again.truth.ignore)
    assert np.array_equal(plan.survey, again.survey) and np.array_equal(plan.tour, again.tour)


def test_sizes_are_as_promised():
    height, width = load_floor_plan("small_flat").drawing.shape
    assert width <= 600 and height <= 800
    floor = load_floor_plan("office_floor")
    rows, cols = np.nonzero(floor.truth.walls)
    sides = [(index.max() + 1 - index.min()) * floor.metres_per_pixel for index in (rows, cols)]
    assert sides == pytest.approx([10, 40])
    assert 6 <= len(read_description(data_folder() / "office_wing.toml").rooms) <= 10


def test_shared_arrays_cannot_be_changed(plan):
    with pytest.raises(ValueError, match="read-only"):
        plan.truth.walls[0, 0] = True
