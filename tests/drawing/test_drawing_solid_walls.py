"""Solid walls among furniture: hand-made drawings that each rule decides."""

import re

import numpy as np
import pytest

from priorlab.core.drawing import Door, Drawing
from priorlab.drawing.faces import thin_cells, walls_between
from priorlab.drawing.joined import with_others
from priorlab.drawing.method import ROBUST
from priorlab.drawing.network import of_network
from priorlab.drawing.preprocessing import prepare
from priorlab.drawing.runs import gap_ends
from priorlab.drawing.strokes import line_weights
from priorlab.drawing.symbol import Symbols, ink_beside
from priorlab.drawing.wall_choice import choose, door_agreement
from priorlab.drawing.wall_sizes import WallSizes
from priorlab.drawing.weight import Hypothesis, evenness, judged, weight_hypotheses, with_openings

SIZES = WallSizes(400, 12.0)


def _ring(thick=10):
    """A house of 300 x 200 pixels without openings."""
    walls = np.zeros((260, 400), dtype=bool)
    walls[30:230, 50:350] = True
    walls[30 + thick : 230 - thick, 50 + thick : 350 - thick] = False
    return walls


def _weights(ink):
    """Weights of lines drawn full black."""
    return line_weights(np.where(ink, 255, 0).astype(np.uint8), ink)


def _leaf(hinge, tip):
    """Symbols of one leaf; what is not asked is 0."""
    zero = np.zeros(1)
    points = {"hinge": np.array([hinge], float), "strike": np.zeros((1, 2)), "tip": np.array([tip], float)}
    return Symbols(**points, leaf=zero, arc=zero, chord=zero, equal=zero, open_ink=zero, crossed=zero, beyond=zero)


@pytest.mark.parametrize(("more", "share"), [((), 0.0), ((34,), 1.0), ((26, 34), 1.0)])
def test_ink_beside_sees_the_lines_of_a_window_and_no_lone_leaf(more, share):
    lines = np.zeros((60, 80), dtype=bool)
    lines[30, 10:60] = True
    lines[list(more), 10:60] = True
    lines = lines | np.roll(lines, 1, axis=0)
    assert ink_beside(lines, _leaf((15, 30), (45, 30)))[0] == pytest.approx(share)


def test_walls_between_windows_leave_walls_solid():
    ink = _ring()
    ink[30:40, 90:190] = ink[30:40, 220:320] = False  # two windows, as long as the piers are in all
    ink[[30, 34, 38], 90:190] = ink[[30, 34, 38], 220:320] = True
    heavy = ink.copy()
    heavy[30:40, 90:190] = heavy[30:40, 220:320] = False
    found, solid = walls_between(heavy, ink, thin_cells(ink, SIZES), SIZES)
    assert solid and not (found & ~heavy).any()


def test_walls_between_two_lines_are_not_solid():
    ink = _ring()
    ink &= ~np.pad(ink, 2)[4:, 2:-2] | ~np.pad(ink, 2)[:-4, 2:-2] | ~np.pad(ink, 2)[2:-2, 4:] | ~np.pad(ink, 2)[2:-2, :-4]
    found, solid = walls_between(ink, ink, thin_cells(ink, SIZES), SIZES)
    assert not solid and found[35, 100:300].all()


def test_evenness_falls_with_every_line_beside_thick_walls():
    walls = _ring()
    alone = evenness(walls)
    walls[100, 60:340] = True
    one = evenness(walls)
    walls[120, 60:340] = True
    assert alone == 1.0 > one > evenness(walls) > 0


def test_with_openings_walls_up_a_door_but_no_room():
    walls = _ring()
    walls[30:40, 180:220] = False
    whole = with_openings(walls, SIZES)
    assert whole[30:40, 180:220].all() and not whole[60:200, 80:320].any()


def test_judged_solid_piers_between_windows_count_as_a_wall():
    walls = _ring()
    for left in range(80, 330, 40):
        walls[30:40, left : left + 22] = walls[220:230, left : left + 22] = False
    assert judged("piers", walls, SIZES, solid=True).quality > 2 * judged("piers", walls, SIZES).quality


def test_choose_takes_the_heavier_of_solid_strokes():
    lines = _ring()
    lines[60:63, 100:200] = True
    hypotheses = [Hypothesis("light", lines, 1.0, True, 2.0), Hypothesis("heavy", _ring(), 0.8, True, 8.0)]
    assert choose(hypotheses, [1.0, 0.8]).name == "heavy"
    assert choose(hypotheses, [1.0, 0.5]).name == "light"


def test_with_others_thin_partition_with_a_door_comes_back_and_a_shelf_does_not():
    ring, thin = _ring(), np.zeros((260, 400), dtype=bool)
    thin[40:120, 200:203] = thin[160:220, 200:203] = True  # a partition with a door of 40 pixels
    thin[100:103, 80:140] = True  # a shelf
    door = Door((201, 120), (201, 160), (241, 120))
    best, other = Hypothesis("heavy", ring, 1.0, True, 8.0), Hypothesis("light", ring | thin, 0.1, True, 2.0)
    found = with_others(best, [best, other], [1.0, 0.1], SIZES, [door], _weights(ring | thin))
    assert found[45:115, 201].all() and found[165:215, 201].all() and not found[101, 80:140].any()
    assert np.array_equal(with_others(best, [best, other], [1.0, 0.1], SIZES, [], _weights(ring | thin)), ring)


def test_with_others_heavy_partition_needs_no_door():
    ring, thin, hair = _ring(), np.zeros((260, 400), dtype=bool), np.zeros((260, 400), dtype=bool)
    thin[40:220, 200:204] = True
    hair[40:220, [100, 300]] = True
    best, other = Hypothesis("heavy", ring, 1.0, True, 8.0), Hypothesis("light", ring | thin | hair, 0.1, True, 2.0)
    found = with_others(best, [best, other], [1.0, 0.1], SIZES, [], _weights(ring | thin | hair))
    assert found[45:215, 201].all() and not found[45:215, [100, 300]].any()


def test_with_others_heavy_partition_may_leave_the_building_and_a_line_may_not():
    ring, thin, hair = _ring(), np.zeros((260, 400), dtype=bool), np.zeros((260, 400), dtype=bool)
    thin[80:84, 350:390] = True  # the side of a porch: nothing lies above, below and beyond it
    hair[[120, 180], 350:390] = True
    best, other = Hypothesis("heavy", ring, 1.0, True, 8.0), Hypothesis("light", ring | thin | hair, 0.1, True, 2.0)
    found = with_others(best, [best, other], [1.0, 0.1], SIZES, [], _weights(ring | thin | hair))
    assert found[82, 355:385].all() and not found[[120, 180], 355:385].any()


@pytest.mark.parametrize(("thick", "trusted"), [(3, 0.5), (4, 1.0), (9, 1.0)])
def test_weight_hypotheses_trust_solid_walls_that_are_heavier_than_lines(thick, trusted):
    walls, lines = _ring(thick), np.zeros((260, 400), dtype=bool)
    for y in range(60, 210, 30):
        lines[y : y + 2, 80:320] = True
    sheet = prepare(Drawing(np.where(walls | lines, 0, 255).astype(np.uint8)), ROBUST)
    found = {h.name: h for h in weight_hypotheses(sheet, walls | lines, walls | lines, SIZES)}
    heavy = found[f"strokes of at least {min(thick, 6)} px"]
    alone = judged("walls", heavy.walls, SIZES, solid=True)
    assert heavy.solid and heavy.quality == pytest.approx(trusted * alone.quality)


def test_door_agreement_of_walls_without_jambs_is_a_quarter():
    nothing, door = np.zeros((260, 400), dtype=bool), Door((201, 120), (201, 160), (241, 120))
    assert door_agreement(nothing, [door], nothing) == 0.25
    assert door_agreement(_ring(), [Door((60, 100), (60, 140), (100, 100))], nothing) == 1.0


def test_of_network_keeps_a_wall_to_which_lines_lead_and_no_thin_one():
    walls, ink = _ring(), np.zeros((260, 400), dtype=bool)
    walls[30:40, 100:300] = False  # too wide for an opening
    far = np.zeros_like(walls)
    far[30:40, 190:215] = True
    door = Door((55, 100), (55, 140), (95, 100))
    ink[34, 100:300] = True
    assert not of_network(walls | far, [door], SIZES)[far].any()
    assert np.array_equal(of_network(walls | far, [door], SIZES, lines=ink), walls | far)
    assert not of_network(walls | far, [door], SIZES, lines=ink & (np.arange(400) > 230) & (np.arange(400) < 280))[far].any()
    far[33:40] = False
    assert not of_network(walls | far, [door], SIZES, lines=ink)[far].any()


def test_of_network_drops_furniture_that_stands_alone():
    walls, stray, leaf = _ring(), np.zeros((260, 400), dtype=bool), np.zeros((260, 400), dtype=bool)
    stray[120:126, 150:190] = True
    leaf[100:140, 240:246] = True  # stands alone, but a door hangs on it
    door = Door((243, 140), (243, 180), (283, 140))
    assert np.array_equal(of_network(walls | stray | leaf, [door], SIZES), walls | leaf)
    assert np.array_equal(of_network(walls | stray | leaf, [], SIZES), walls)


def test_of_network_keeps_the_piers_between_windows():
    walls = _ring()
    for left in range(80, 330, 40):
        walls[30:40, left : left + 22] = False
    assert np.array_equal(of_network(walls, [], SIZES), walls)


@pytest.mark.parametrize("axis", [0, 1])
def test_gap_ends_equals_a_walk_along_every_row(axis):
    mask = np.random.default_rng(5).random((30, 40)) < 0.4
    found = gap_ends(mask, 3, axis)
    for row, seen in zip(mask if axis == 1 else mask.T, found if axis == 1 else found.T, strict=True):
        expected, runs = np.zeros(len(row), dtype=int), "".join("#" if ink else " " for ink in row)
        for gap in re.finditer("(?<=#) +(?=#)", runs):
            if len(gap[0]) <= 3:
                ends = len(re.search("#+$", runs[: gap.start()])[0]), len(re.match("#+", runs[gap.end() :])[0])
                expected[gap.start() : gap.end()] = min(ends)
        assert seen.tolist() == expected.tolist()
