"""Drawings made by hand of which it is known what is wall: heavy strokes alone, with hairlines, with what looks heavy."""

import cv2
import numpy as np
import pytest

from priorlab.core.building import Truth
from priorlab.core.drawing import Drawing
from priorlab.core.score import score_mask
from priorlab.drawing.extraction import extract_walls
from priorlab.drawing.heavy_strokes import ALL_HEAVY, heavy_strokes, is_furnished, without_leaves
from priorlab.drawing.wall_choice import has_other_style
from priorlab.drawing.wall_sizes import wall_sizes
from priorlab.drawing.weight import STRAIGHT_CELLS, judged


def building():
    """Walls of two thicknesses round two rooms, an opening in each, a pier in one, a parapet below; (400, 500) bool."""
    walls = np.zeros((400, 500), dtype=bool)
    walls[60:70, 60:440] = walls[300:310, 60:440] = True
    walls[60:310, 60:70] = walls[60:310, 430:440] = True
    walls[70:300, 250:255] = True
    walls[300:310, 100:160] = False
    walls[300:310, 126:136] = True
    walls[150:190, 250:255] = False
    walls[310:350, 200:204] = walls[310:350, 380:384] = walls[346:350, 200:384] = True
    return walls


def dark(ink):
    return np.where(ink, 255, 0).astype(np.uint8)


def test_heavy_strokes_of_bare_walls_are_all_of_them():
    walls = building()
    np.testing.assert_array_equal(heavy_strokes(dark(walls), walls), walls)


def test_heavy_strokes_leave_hairlines():
    walls = building()
    ink = dark(walls)
    cv2.rectangle(ink, (90, 90), (160, 140), 255, 1)
    cv2.circle(ink, (340, 200), 30, 255, 1)
    ink[304, 160:166] = 255
    np.testing.assert_array_equal(heavy_strokes(ink, ink > 0), walls)


def test_heavy_strokes_leave_crossings_of_lines():
    walls = building()
    ink = dark(walls)
    for x in range(280, 400, 40):
        cv2.line(ink, (x, 90), (x + 30, 120), 255, 1)
        cv2.line(ink, (x + 30, 90), (x, 120), 255, 1)
        ink[99:111, x + 15] = ink[105, x + 9 : x + 21] = 255
    np.testing.assert_array_equal(heavy_strokes(ink, ink > 0), walls)


def test_heavy_strokes_of_pale_boxes_between_walls_are_none():
    walls = building()
    ink = dark(walls)
    ink[300:310, 100:126] = 90
    found = heavy_strokes(ink, ink > 40)
    assert not found[303:307, 104:122].any()
    np.testing.assert_array_equal(found & walls, walls)


def test_heavy_strokes_of_grey_walls_with_black_lines():
    walls = building()
    ink = (dark(walls) // 255 * 130).astype(np.uint8)
    cv2.rectangle(ink, (90, 90), (160, 140), 255, 1)
    np.testing.assert_array_equal(heavy_strokes(ink, ink > 0), walls)


@pytest.mark.parametrize("thick", [4, 5])
def test_heavy_strokes_is_none_where_furniture_is_as_heavy(thick):
    ink = dark(building())
    for x in range(90, 230, 35):
        for y in range(90, 280, 35):
            cv2.circle(ink, (x, y), 12, 255, thick)
    assert heavy_strokes(ink, ink > 0) is None


def test_heavy_strokes_is_none_where_much_is_drawn_outside():
    walls = np.zeros((400, 500), dtype=bool)
    walls[20:220, 20:220] = building()[60:260, 60:260]
    ink = dark(walls)
    for y in range(240, 390, 8):
        ink[y : y + 2, 20:480] = 255
    assert heavy_strokes(ink, ink > 0) is None


def test_heavy_strokes_is_none_of_words_and_of_nothing():
    page = np.zeros((400, 500), np.uint8)
    for line in range(12):
        cv2.putText(page, "walls that are words", (20, 30 + 30 * line), cv2.FONT_HERSHEY_SIMPLEX, 1, 255, 4)
    assert heavy_strokes(page, page > 0) is None
    assert heavy_strokes(np.zeros_like(page), page > 300) is None


def test_without_leaves_takes_off_what_swings_and_no_wall():
    walls = building()
    heavy = walls.copy()
    heavy[150:153, 255:295] = True  # a leaf as a bar of three pixels
    arc = np.zeros_like(walls)
    arc[153:190, 294] = True
    leaf = heavy & ~walls
    np.testing.assert_array_equal(without_leaves(heavy, [leaf | arc]), walls)
    np.testing.assert_array_equal(without_leaves(walls, [walls & (np.arange(500) > 420)]), walls)  # no arc: a wall


def test_is_furnished():
    walls = building()
    lines = walls.copy()
    lines[90:290:4, 80:240] = True
    assert not is_furnished(walls, walls)
    assert is_furnished(walls, lines)


@pytest.mark.parametrize("furnished", [False, True])
def test_extract_walls_keeps_all_walls_of_a_rendering(furnished):
    walls = building()
    grey = np.where(walls, 0, 255).astype(np.uint8)
    if furnished:
        for x in range(300, 420, 30):
            cv2.rectangle(grey, (x, 90), (x + 20, 130), 0, 1)
    found = extract_walls(Drawing(grey, name="rendering"))
    assert found.wall_search.chosen == ALL_HEAVY
    assert ALL_HEAVY in [hypothesis.name for hypothesis in found.hypotheses]
    score = score_mask(found.walls.mask, Truth(walls, np.zeros_like(walls)))
    assert score.iou > 0.99


def test_extract_walls_drops_blocks_between_furniture_alone():
    walls = building()
    grey = np.where(walls, 0, 255).astype(np.uint8)
    grey[230:250, 330:350] = 0
    bare = extract_walls(Drawing(grey, name="column")).walls.mask
    for x in range(80, 420, 15):
        cv2.rectangle(grey, (x, 90), (x + 10, 140), 0, 1)
    furnished = extract_walls(Drawing(grey, name="stove")).walls.mask
    assert bare[240, 340] and not furnished[240, 340]


def test_heavy_strokes_leave_letters_thinner_than_walls():
    walls = building()
    walls[310:] = False  # without the parapet nothing is as thin as letters
    walls[70:150, 250:258] = walls[190:300, 250:258] = True
    ink = dark(walls)
    cv2.putText(ink, "HALL", (90, 140), cv2.FONT_HERSHEY_SIMPLEX, 0.7, 255, 2)
    np.testing.assert_array_equal(heavy_strokes(ink, ink > 0), walls)


def test_has_other_style_of_walls_between_two_lines():
    walls = building()
    two_lines = np.zeros_like(walls)
    two_lines[20:32, 20:480] = True
    cells = judged(STRAIGHT_CELLS, two_lines, wall_sizes(500))
    assert has_other_style(walls, [cells])
    assert not has_other_style(walls, [judged("strokes", two_lines, wall_sizes(500))])
    assert not has_other_style(walls, [judged(STRAIGHT_CELLS, np.zeros_like(walls), wall_sizes(500))])


def test_extract_walls_takes_no_faces_of_hollow_walls_for_all_walls():
    grey = np.full((400, 500), 255, dtype=np.uint8)
    for inset in (60, 71):
        cv2.rectangle(grey, (inset, inset), (499 - inset, 399 - inset), 0, 4)
    found = extract_walls(Drawing(grey, name="hollow"))
    assert found.wall_search.chosen != ALL_HEAVY
    assert found.walls.mask[68, 100:400].mean() > 0.9
