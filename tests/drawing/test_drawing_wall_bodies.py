"""Bodies of hollow walls: hand-made houses whose walls are known from the mask that their lines were drawn from."""

from dataclasses import replace

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from priorlab.core.drawing import Door, Drawing
from priorlab.drawing.arms import arms_of
from priorlab.drawing.faces import thin_cells
from priorlab.drawing.method import ROBUST
from priorlab.drawing.preprocessing import prepare
from priorlab.drawing.wall_bodies import ends_at_jambs, hollow_walls, wall_bodies
from priorlab.drawing.wall_choice import prefer_bodies
from priorlab.drawing.wall_completion import hollow_round
from priorlab.drawing.wall_scene import scene_of
from priorlab.drawing.wall_sizes import WallSizes
from priorlab.drawing.weight import HATCHED, STRAIGHT_CELLS, Hypothesis

SIZES = WallSizes(400, 20.0)
WIDTH = 40
"""Of the doors."""

DOORS = (Door((100.0, 224.0), (140.0, 224.0), (100.0, 184.0)), Door((204.0, 100.0), (204.0, 140.0), (244.0, 100.0)))
"""In the wall below, and in the one between the rooms."""


def _walls():
    """A house of two rooms of 300 x 200 pixels; 12 px round it and 8 px between the rooms; two doors, two windows above."""
    walls = np.zeros((300, 400), dtype=bool)
    walls[30:230, 50:350] = True
    walls[42:218, 62:200] = walls[42:218, 208:338] = False
    walls[218:230, 100:140] = walls[100:140, 200:208] = False
    walls[30:42, 90:150] = walls[30:42, 170:190] = False
    return walls


def _lines(walls, weight=2):
    """The outline of walls, as a hollow wall is drawn."""
    inner = cv2.erode(walls.astype(np.uint8), np.ones((2 * weight + 1, 2 * weight + 1), np.uint8)).astype(bool)
    return walls & ~inner


def _house():
    """Its lines, with those of the windows."""
    ink = _lines(_walls())
    for x in (slice(90, 150), slice(170, 190)):
        ink[[30, 31, 35, 36, 40, 41], x] = True
    return ink


def test_hollow_walls_are_the_bodies_from_opening_to_opening():
    found, walls = hollow_walls(_house(), DOORS, SIZES).walls, _walls()
    assert found[walls].mean() > 0.99
    glass = found & ~walls
    assert not glass[46:].any() and not glass[:, 195:].any()  # at most the ends of the windows' lines


def test_hollow_walls_hold_the_pier_between_two_windows():
    found = hollow_walls(_house(), DOORS, SIZES).walls
    assert found[30:42, 150:170].all() and not found[33, 100:140].any()


def test_hollow_walls_go_on_from_known_ones_along_windows():
    known = np.zeros((300, 400), dtype=bool)
    known[32:228, 52:60] = True  # the inside of the wall on the left: its cell goes up to the first window
    found = hollow_walls(_house(), (), SIZES, known).walls
    assert found[30:42, 150:170].all() and found[60:200, 340:348].all()
    assert not hollow_walls(_house(), (), SIZES).walls.any()


def test_hollow_round_solid_partitions_is_taken_and_no_smaller_ring():
    solid = np.zeros((300, 400), dtype=bool)
    solid[42:218, 200:204] = True
    ring, ink = _walls() & ~np.pad(np.ones((176, 276), dtype=bool), ((42, 82), (62, 62))), _house()
    ink[42:218, 202:206] = False
    scene = scene_of(prepare(Drawing(np.where(ink | solid, 0, 255).astype(np.uint8)), ROBUST), (), ROBUST)
    found = hollow_round([Hypothesis(STRAIGHT_CELLS, ring, 1.0)], solid, scene)
    assert found[ring].all()
    assert not hollow_round([Hypothesis(STRAIGHT_CELLS, ring & (np.arange(400) < 150), 1.0)], solid, scene).any()
    assert not hollow_round([Hypothesis("long cells", ring, 1.0)], solid, scene).any()


def test_prefer_bodies_that_are_worth_more_than_all_others():
    one, other = (np.zeros((20, 20), dtype=bool) for _ in range(2))
    one[:4] = other[8:] = True
    best, bodies = Hypothesis("strokes", one, 1.0, True, 3.0), Hypothesis("bodies of hollow walls", other, 1.0)
    assert prefer_bodies(best, bodies, 0.5, 1.0) is best
    assert prefer_bodies(best, bodies, 1.0, 1.0) is bodies
    assert prefer_bodies(replace(best, name=HATCHED), bodies, 2.0, 1.0).name == HATCHED
    assert prefer_bodies(replace(best, hue=3), bodies, 2.0, 1.0).hue == 3


@pytest.mark.parametrize("box", [(46, 58, 70, 130), (150, 210, 322, 334), (60, 120, 64, 76)])
def test_hollow_walls_hold_no_box_that_is_as_thick_as_a_wall(box):
    top, bottom, left, right = box
    shelf = np.zeros((300, 400), dtype=bool)
    shelf[top:bottom, left:right] = True
    found = hollow_walls(_house() | _lines(shelf), DOORS, SIZES).walls
    assert not (found & shelf)[top + 3 : bottom - 3, left + 3 : right - 3].any()
    assert found[_walls()].mean() > 0.99


def test_hollow_walls_hold_no_closet_between_two_walls():
    walls = _walls()
    walls[42:218, 226:234] = True  # a shaft 18 px wide beside the wall between the rooms: thin enough for a wall
    walls[100:140, 200:208] = False
    ink = _lines(walls)
    found = hollow_walls(ink, DOORS[:1], SIZES).walls
    assert found[150:200, 201:207].all() and found[150:200, 227:233].all() and not found[150:200, 212:222].any()


def test_hollow_walls_go_on_across_an_opening_and_not_across_a_room():
    ink = _lines(_near_and_far())
    found = hollow_walls(ink, (Door((100.0, 55.0), (100.0, 95.0), (140.0, 55.0)),), SIZES).walls
    assert found[150:160, 95:105].all() and not found[290:300, 95:105].any()


def _near_and_far():
    """Four pieces of one wall: a door between the first two, an opening of two door widths, and one of three."""
    walls = np.zeros((400, 200), dtype=bool)
    walls[10:55, 90:110] = walls[95:140, 90:110] = walls[145:165, 90:110] = walls[285:330, 90:110] = True
    walls[140:145] = False
    return walls


def test_hollow_walls_without_doors_are_none():
    found = hollow_walls(_house(), (), SIZES)
    assert not found.walls.any() and found.quality == 0


def test_wall_bodies_of_a_blank_sheet_are_none():
    blank = np.zeros((50, 60), dtype=bool)
    assert not wall_bodies(thin_cells(blank, SIZES), blank, DOORS, SIZES).any()


def test_ends_at_jambs_prefer_the_pair_that_lies_in_line():
    cells = np.zeros((60, 200), dtype=np.int32)
    cells[20:30, 10:60], cells[20:30, 105:150], cells[32:38, 101:150] = 1, 2, 3  # a bench stands nearer to the right jamb
    arms = arms_of(cells, 1)
    (found,) = ends_at_jambs([arms], [Door((62.0, 31.0), (102.0, 31.0), (62.0, 0.0))])
    assert arms.cell[found].tolist() == [1, 2]


def test_ends_at_jambs_pass_over_doors_along_the_other_axis():
    cells = np.zeros((60, 200), dtype=np.int32)
    cells[20:30, 10:60] = 1
    (found,) = ends_at_jambs([arms_of(cells, 1)], [Door((62.0, 25.0), (62.0, 59.0), (96.0, 25.0))])
    assert not found.size


@given(st.integers(2, 30), st.integers(2, 30), st.integers(1, 20), st.integers(1, 20))
def test_arms_of_a_box_are_the_box(width, height, x, y):
    cells = np.zeros((60, 60), dtype=np.int32)
    cells[y : y + height, x : x + width] = 1
    for axis, size, thickness in ((1, width, height), (0, height, width)):
        arms = arms_of(cells, axis)
        assert len(arms.cell) == (4 * size >= thickness)  # a pier is no more than four times thicker than long
        if len(arms.cell):
            assert (arms.length[0], arms.thickness[0], arms.dead[0].tolist()) == (size, thickness, [True, True])


@given(st.integers(0, 10_000))
def test_arms_of_a_turned_sheet_are_the_arms_turned(seed):
    white = np.random.default_rng(seed).random((12, 15)) < 0.8
    _, cells = cv2.connectedComponents(white.astype(np.uint8), connectivity=4)
    one, other = arms_of(cells.astype(np.int32), 0), arms_of(np.ascontiguousarray(cells.T).astype(np.int32), 1)
    assert one.axis == 0 and other.axis == 1
    for name in ("cell", "along", "across", "dead"):
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name))


def test_arms_of_ragged_cells_leave_out_single_steps():
    cells = np.zeros((80, 40), dtype=np.int32)
    cells[:, 5:15] = 1
    cells[40:80, 15] = 1  # the wall's edge steps by a pixel
    cells[50:58, 15:30] = 1
    assert [(a, b) for a, b in arms_of(cells, 1).along.tolist() if b - a < 2] == []
