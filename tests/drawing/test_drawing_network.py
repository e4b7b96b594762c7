"""Close strokes part, frames and blocks are no building: small drawings made by hand, their answers counted by eye."""

import cv2
import numpy as np
import pytest

from priorlab.core.drawing import Door
from priorlab.drawing.faces import tidy
from priorlab.drawing.network import of_network, walled_up, without_blocks, without_marks
from priorlab.drawing.valleys import narrow_gaps, valleys
from priorlab.drawing.wall_sizes import WallSizes, wall_sizes

SIZES = WallSizes(200, 8)


def house(shape=(200, 200)):
    """A square ring of walls, 6 px thick, from 60 to 140, with a door of 16 px in its lower side."""
    walls = np.zeros(shape, dtype=bool)
    walls[60:140, 60:140] = True
    walls[66:134, 66:134] = False
    walls[134:140, 92:108] = False
    return walls, Door(hinge=(92, 137), strike=(108, 137), tip=(92, 121))


@pytest.mark.parametrize("sigma", [0.0, 0.8])
def test_valleys_part_a_table_from_the_wall_behind_it(sigma):
    darkness = np.zeros((40, 40), np.float32)
    darkness[:, 10:20] = darkness[:, 22:24] = 250
    darkness = cv2.GaussianBlur(darkness, (0, 0), sigma) if sigma else darkness
    darkness = darkness.astype(np.uint8)
    ink = (darkness > 60) & ~valleys(darkness)
    parts = cv2.connectedComponents(ink[5:35].astype(np.uint8), connectivity=4)[0] - 1
    assert parts == 2 and ink[20, 11:19].all()


def test_valleys_leave_a_line_whole_that_wavers():
    rng = np.random.default_rng(0)
    darkness = np.zeros((20, 60), np.uint8)
    darkness[9:11] = rng.integers(120, 250, (2, 60))
    assert not valleys(darkness)[9:11].any()


def test_valleys_leave_lighter_fill_between_dark_edges():
    darkness = np.full((30, 30), 0, np.uint8)
    darkness[10:20] = 100
    darkness[[10, 19]] = 250
    assert not valleys(darkness)[12:18].any()


def test_narrow_gaps_fill_between_the_lines_of_a_window_only():
    walls = np.zeros((30, 30), dtype=bool)
    walls[[5, 9, 20]] = True
    assert np.flatnonzero(narrow_gaps(walls)[:, 15]).tolist() == [6, 7, 8]


def test_tidy_within_ink_keeps_a_crack_of_paper_open():
    walls = np.zeros((40, 80), dtype=bool)
    walls[10:18, 5:75] = walls[20:26, 5:75] = True
    ink = walls.copy()
    ink[18:20, 5:75] = True
    assert tidy(walls, SIZES, within=ink)[18:20, 20].all() and not tidy(walls, SIZES, within=walls)[18:20, 20].any()


def test_of_network_drops_the_frame_round_the_building_and_what_stands_beside_it():
    walls, door = house()
    more = walls.copy()
    cv2.rectangle(more.view(np.uint8), (5, 5), (194, 194), 1, 5)
    more[165:172, 40:90] = True
    assert np.array_equal(of_network(more, [door], SIZES), walls)


def test_of_network_keeps_a_second_building_without_a_door_that_is_large():
    walls, door = house((200, 400))
    walls[60:140, 260:340] = walls[60:140, 60:140]
    assert np.array_equal(of_network(walls, [door], SIZES), walls)


def test_of_network_keeps_all_large_pieces_where_no_door_was_found():
    walls, _ = house()
    cv2.rectangle(walls.view(np.uint8), (5, 5), (194, 194), 1, 5)
    assert np.array_equal(of_network(walls, [], SIZES), walls)


def test_walled_up_closes_the_opening_of_a_wing():
    wing = np.zeros((200, 200), np.uint8)
    for start, end in (((30, 60), (85, 85)), ((100, 92), (155, 117)), ((30, 60), (10, 104)), ((155, 117), (135, 161))):
        cv2.line(wing, start, end, 1, 7)
    wing = wing.astype(bool)
    assert not wing[88, 92] and walled_up(wing, SIZES)[88, 92]


def test_without_blocks_keeps_a_pier_at_a_door():
    walls = np.zeros((60, 90), dtype=bool)
    walls[10:18, 5:85] = True
    walls[40:48, 30:40] = True
    at_pier = Door(hinge=(41, 44), strike=(60, 44), tip=(41, 25))
    assert not without_blocks(walls, walls, [])[44, 35] and without_blocks(walls, walls, [at_pier])[44, 35]


def test_without_blocks_keeps_long_walls_that_stand_alone():
    walls = np.zeros((60, 90), dtype=bool)
    walls[10:18, 5:85] = walls[40:48, 10:60] = True
    assert np.array_equal(without_blocks(walls, walls, []), walls)


def ringed(gap=0):
    """Walls of two rooms in a frame, with a gap in it."""
    walls, frame = np.zeros((2, 200, 300), dtype=bool)
    walls[50:150, [60, 150, 239]] = walls[[50, 149], 60:240] = True
    frame[[5, 194], 5:295] = frame[5:195, [5, 294]] = True
    frame[5, 100 : 100 + gap] = False
    return walls, frame


def test_without_marks_takes_a_closed_frame_off_alone():
    walls, frame = ringed()
    np.testing.assert_array_equal(without_marks(walls | frame, wall_sizes(300)), walls)
    walls, frame = ringed(gap=40)  # a way in: outer walls with a free core
    np.testing.assert_array_equal(without_marks(walls | frame, wall_sizes(300)), walls | frame)
    np.testing.assert_array_equal(without_marks(frame, wall_sizes(300)), frame)  # nothing in it


def test_without_marks_takes_small_things_beside_the_building_off_where_there_is_a_frame():
    walls, frame = ringed()
    arrow, pier, wing = np.zeros((3, 200, 300), dtype=bool)
    arrow[20:30, 270:280] = pier[100:104, 100:104] = True
    wing[60:140, [250, 280]] = wing[[60, 139], 250:281] = True
    np.testing.assert_array_equal(without_marks(walls | pier | arrow | frame, wall_sizes(300)), walls | pier)
    np.testing.assert_array_equal(without_marks(walls | wing | frame, wall_sizes(300)), walls | wing)
    np.testing.assert_array_equal(without_marks(walls | arrow, wall_sizes(300)), walls | arrow)
