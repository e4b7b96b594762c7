"""Windows told apart from walls: on walls made by hand in every style, and on what looks like a window and is none."""

import cv2
import numpy as np
import pytest

from priorlab.core.drawing import Drawing
from priorlab.drawing.deskew import turn_by
from priorlab.drawing.extraction import extract_walls
from priorlab.drawing.wall_sizes import WallSizes
from priorlab.drawing.window_search import find_windows

SIZES = WallSizes(600, 14)
TOP, LOW = 30, 44
"""Rows of the faces of a wall that runs from x = 40 to 360."""

GAP = slice(160, 240)
"""Columns of its window."""


def _wall(style: str) -> tuple[np.ndarray, np.ndarray]:
    """Ink, and walls as they are found (insides too), of a wall with a hole for a window."""
    ink = np.zeros((80, 400), np.uint8)
    if style == "filled":
        ink[TOP : LOW + 1, 40:361] = 1
    else:
        cv2.rectangle(ink, (40, TOP), (360, LOW), 1, 1)
        cv2.line(ink, (GAP.start - 1, TOP), (GAP.start - 1, LOW), 1)
        cv2.line(ink, (GAP.stop, TOP), (GAP.stop, LOW), 1)
    for x in range(40, 346, 8) if style == "hatched" else ():
        cv2.line(ink, (x, LOW), (x + LOW - TOP, TOP), 1)
    ink[:, GAP] = 0
    walls = np.zeros(ink.shape, dtype=bool)
    walls[TOP : LOW + 1, 40:361] = True
    walls[:, GAP] = False
    return ink > 0, walls


def _glazed(style: str, rows) -> tuple[np.ndarray, np.ndarray]:
    """The same with lines across the hole."""
    ink, walls = _wall(style)
    ink[list(rows), GAP] = True
    return ink, walls | ink


@pytest.mark.parametrize("style", ["filled", "hollow", "hatched"])
@pytest.mark.parametrize("rows", [(TOP, 37, LOW), (TOP, 36, 38, LOW), (TOP, 31, 34, 40, 41, LOW)])
def test_find_windows_lines_with_white_between_are_one(style, rows):
    found = find_windows(*_glazed(style, rows)[::-1], SIZES)
    assert found[TOP : LOW + 1, GAP].all()
    assert not found[:, : GAP.start - 2].any() and not found[:, GAP.stop + 2 :].any()


@pytest.mark.parametrize("style", ["filled", "hollow", "hatched"])
def test_find_windows_whose_lines_were_missed(style):
    ink, walls = _glazed(style, (TOP, 37, LOW))
    walls[:, GAP] = False
    assert find_windows(walls, ink, SIZES)[TOP : LOW + 1, GAP].all()


def test_find_windows_two_lines_are_one_only_if_lighter_than_walls():
    ink, walls = _glazed("filled", (TOP, LOW))
    assert not find_windows(walls, ink, SIZES, weight=0).any()
    assert find_windows(walls, ink, SIZES, weight=4)[TOP : LOW + 1, GAP].all()


@pytest.mark.parametrize(("rows", "found"), [((TOP, LOW), False), ((TOP, 37, LOW), True)])
def test_find_windows_of_another_hue_have_three_lines(rows, found):
    ink, walls = _wall("filled")
    lines = np.zeros_like(ink)
    lines[list(rows), GAP] = True  # two lines of another hue are a partition of another kind
    assert find_windows(walls | lines, lines, SIZES, np.inf, fewest=3).any() == found


def test_find_windows_none_in_walls_without():
    for style in ("filled", "hollow", "hatched"):
        ink, walls = _wall(style)
        assert not find_windows(walls, ink, SIZES).any()
        assert not find_windows(np.zeros_like(walls), np.zeros_like(ink), SIZES).any()


def test_find_windows_shelf_without_wall_at_its_end_is_none():
    ink, walls = _glazed("filled", (TOP, 37, LOW))
    assert find_windows(walls, ink, SIZES).any()
    ink[:, GAP.stop :] = walls[:, GAP.stop :] = False
    assert not find_windows(walls, ink, SIZES).any()


def test_find_windows_treads_are_too_many_thicknesses_long():
    ink, walls = _glazed("hollow", (TOP, 37, LOW))
    long = np.zeros((80, 800), dtype=bool), np.zeros((80, 800), dtype=bool)
    for wide, mask in zip(long, (ink, walls), strict=True):
        wide[:, : GAP.start], wide[:, -160:] = mask[:, : GAP.start], mask[:, -160:]
        wide[:, GAP.start : -160] = mask[:, [200]]
    assert not find_windows(long[1], long[0], SIZES).any()


@pytest.mark.parametrize(("weight", "found"), [(0.0, False), (3.0, True)])
def test_find_windows_between_the_sides_of_two_walls_only_if_lighter(weight, found):
    walls = np.zeros((120, 300), dtype=bool)
    walls[:, 40:52] = walls[:, 140:152] = True  # a shaft, or a corridor's end
    walls[[50, 55, 63], 52:140] = True
    assert find_windows(walls, walls, SIZES, weight).any() == found


def test_find_windows_post_across_is_part_of_it():
    ink, walls = _glazed("filled", (TOP, 37, LOW))
    ink[TOP : LOW + 1, 198:201] = walls[TOP : LOW + 1, 198:201] = True
    assert find_windows(walls, ink, SIZES)[TOP : LOW + 1, GAP].all()


def test_find_windows_hatched_wall_with_a_cavity_is_none():
    ink, walls = _glazed("hatched", (TOP, 37, LOW))
    ink[TOP + 1 : 36, 41:159] = ink[TOP + 1 : 36, 241:360] = False  # the hatching fills the lower half of the wall
    ink[36, 40:361] = True
    found = find_windows(walls, ink, SIZES)
    assert found[TOP : LOW + 1, GAP].all()
    assert not found[:, : GAP.start - 2].any() and not found[:, GAP.stop + 2 :].any()


def test_find_windows_upright():
    ink, walls = _glazed("filled", (TOP, 37, LOW))
    assert np.array_equal(find_windows(walls.T, ink.T, SIZES), find_windows(walls, ink, SIZES).T)


@pytest.mark.parametrize("degrees", [20, 30])
def test_find_windows_of_a_wing(degrees):
    ink, walls = _glazed("filled", (TOP, TOP + 1, 37, 38, LOW - 1, LOW))
    turn = turn_by(degrees, ink.shape)
    leaning = [turn.image(np.where(mask, 0, 255).astype(np.uint8)) < 128 for mask in (walls, ink)]
    window = np.zeros_like(ink)
    window[TOP : LOW + 1, GAP] = True
    window = turn.image(np.where(window, 0, 255).astype(np.uint8)) < 128
    found = find_windows(*leaning, SIZES)
    assert (found & window).sum() / (found | window).sum() > 0.85


def _house() -> np.ndarray:
    """Grey paper: filled walls, a window in two of them, a partition."""
    grey = np.full((500, 600), 255, dtype=np.uint8)
    cv2.rectangle(grey, (60, 60), (539, 439), 0, -1)
    cv2.rectangle(grey, (72, 72), (527, 427), 255, -1)
    grey[72:428, 300:308] = 0
    for y in (60, 428):
        grey[y : y + 12, 150:230] = 255
        grey[[y, y + 5, y + 11], 150:230] = 0
    return grey


def test_extract_walls_labels_windows_and_keeps_their_ink():
    walls = extract_walls(Drawing(_house())).walls
    assert walls.windows[[60, 65, 71], 150:230].mean() > 0.95
    assert walls.mask[[60, 65, 71], 150:230].mean() > 0.95
    assert not walls.windows[:, 260:].any() and not walls.windows[:, :140].any()


def test_extract_walls_window_is_a_piece_of_its_own():
    found = extract_walls(Drawing(_house()))
    panes = [piece for piece in found.pieces if piece.kind == "window"]
    assert len(panes) == 2
    assert all(abs(piece.box[0] - 150) <= 2 and abs(piece.box[2] - 80) <= 4 and piece.box[3] == 12 for piece in panes)
    total = np.zeros(found.walls.shape, dtype=int)
    for piece in found.pieces:
        x, y, width, height = piece.box
        total[y : y + height, x : x + width] += piece.mask
    assert np.array_equal(total, found.walls.mask.astype(int))
