"""Sweeps, outer walls and strokes on drawings of a few pixels, and runs against a plain loop."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from priorlab.core.drawing import Door
from priorlab.drawing.outer_walls import outer_walls
from priorlab.drawing.runs import gaps_between, grow_along, run_lengths
from priorlab.drawing.strokes import bridge_windows, line_weights, opened, stroke_widths
from priorlab.drawing.sweeps import HORIZONTAL, VERTICAL, jamb_runs, orientation, sweep_walls

masks = hnp.arrays(bool, st.tuples(st.integers(1, 8), st.integers(1, 8)))


def _art(text: str) -> np.ndarray:
    return np.array([[c == "#" for c in line] for line in text.split()])


def _slow_run_lengths(row: list[bool]) -> list[int]:
    return [n if dark else 0 for dark, group in itertools.groupby(row) for n in [len(list(group))] for _ in range(n)]


@given(masks)
def test_run_lengths_equals_a_loop(mask):
    assert run_lengths(mask, 1).tolist() == [_slow_run_lengths(row) for row in mask.tolist()]
    assert run_lengths(mask, 0).T.tolist() == [_slow_run_lengths(row) for row in mask.T.tolist()]


@given(masks, masks)
def test_grow_along_keeps_whole_runs_or_nothing(ink, seeds):
    seeds = np.resize(seeds, ink.shape)
    for row, seed, found in zip(ink, seeds, grow_along(seeds, ink, 1), strict=True):
        start = 0
        for dark, group in itertools.groupby(row.tolist()):
            end = start + len(list(group))
            assert (found[start:end] == (dark and seed[start:end].any())).all()
            start = end


def test_gaps_between_needs_both_ends():
    assert gaps_between(_art("..#..#...#."), 2, 1)[0].tolist() == _art("...##......")[0].tolist()


def test_orientation_eq_3_15():
    assert orientation(Door((0, 0), (30, 4), (0, 30))) == "h"
    assert orientation(Door((0, 0), (4, 30), (30, 0))) == "v"
    assert orientation(Door((0, 0), (30, 30), (30, 0))) == ""


def test_jamb_runs_leave_both_jambs_of_a_vertical_door():
    ink = np.zeros((12, 3), dtype=bool)
    ink[1:4, 1] = ink[8:11, 1] = True
    found = jamb_runs(ink, [Door((1, 3), (1, 8), (2, 5))])
    assert np.array_equal(found, ink)


def test_sweep_walls_grows_run_by_run():
    ink = _art("""
        .........
        .####.##.
        .#.......
        .#..#####
        .####...#
    """)
    start = np.zeros_like(ink)
    start[1, 1] = True
    stages = sweep_walls(ink, start, HORIZONTAL, 4)
    assert np.array_equal(stages[1], _art("""
        .........
        .####....
        .........
        .........
        .........
    """))  # fmt: skip
    assert np.array_equal(stages[2], _art("""
        .........
        .####....
        .#.......
        .#.......
        .#.......
    """))  # fmt: skip
    assert np.array_equal(stages[3], _art("""
        .........
        .####....
        .#.......
        .#.......
        .####....
    """))  # fmt: skip
    assert np.array_equal(stages[4], stages[3] | _art("""
        .........
        .........
        .........
        ....#....
        .........
    """))  # fmt: skip
    assert len(sweep_walls(ink, start, VERTICAL, 2)) == 3


def test_outer_walls_take_a_corner_two_pixels_inside():
    room = np.zeros((40, 60), dtype=bool)
    room[5, 5:50] = room[30, 5:50] = room[5:31, 5] = room[5:31, 49] = True
    room[15, 5:50] = True  # an inner wall
    found = outer_walls(room, [(7, 7), (47, 28)], tolerance=2)
    assert found[5, 20] and found[30, 20] and found[20, 5] and found[20, 49]
    assert not found[15, 20]


def test_outer_walls_without_corners_are_none():
    assert not outer_walls(np.ones((5, 5), dtype=bool), np.empty((0, 2))).any()


@given(masks, st.integers(1, 5))
def test_opened_is_every_square_that_fits(ink, side):
    expected = np.zeros_like(ink)
    for y, x in itertools.product(range(ink.shape[0] - side + 1), range(ink.shape[1] - side + 1)):
        if ink[y : y + side, x : x + side].all():
            expected[y : y + side, x : x + side] = True
    assert np.array_equal(opened(ink, side), expected)


def test_stroke_widths_of_two_bars():
    ink = np.zeros((20, 30), dtype=bool)
    ink[2:4], ink[10:17, 3:25] = True, True
    widths = stroke_widths(ink)
    assert set(np.unique(widths[2:4])) == {2}
    assert set(np.unique(widths[10:17, 3:25])) == {7}


def test_line_weights_survive_anti_aliasing():
    darkness = np.zeros((9, 40), dtype=np.uint8)
    darkness[1] = 255
    darkness[5], darkness[6] = 255, 128  # a line of one pixel and a half
    weights = line_weights(darkness, darkness > 100)
    assert weights[1, 20] == pytest.approx(1)
    assert weights[5, 20] == pytest.approx(1.5, abs=0.01)


def test_bridge_windows_joins_two_pieces_and_leaves_a_dead_end():
    walls = _art("""
        ##......##
        ##......##
        ..........
    """)
    ink = _art("""
        ##########
        ##......##
        ####......
    """)
    assert np.array_equal(bridge_windows(walls, ink, 6), _art("""
        ..######..
        ..........
        ..........
    """))  # fmt: skip
    assert not bridge_windows(walls, ink, 5).any()
