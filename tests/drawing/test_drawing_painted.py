"""Rooms painted by hand: what is drawn on paint must come out as if drawn on white."""

import numpy as np
import pytest

from priorlab.core.drawing import Drawing
from priorlab.drawing.extraction import extract_walls
from priorlab.drawing.painted import local_paper, without_paint

TONES = {"left": (250, 220, 180), "right": (160, 200, 240)}


def plan(painted=True):
    """Walls round two rooms and between them, a line in each room; (200, 300, 3) uint8, and what is wall."""
    image = np.full((200, 300, 3), 255, np.uint8)
    if painted:
        image[30:170, 30:150], image[30:170, 150:270] = TONES["left"], TONES["right"]
    walls = np.zeros((200, 300), dtype=bool)
    walls[24:32, 24:276] = walls[168:176, 24:276] = walls[24:176, 24:32] = walls[24:176, 268:276] = True
    walls[32:168, 148:152] = True
    walls[32:168, 148:152] &= ~((np.arange(32, 168) > 80) & (np.arange(32, 168) < 110))[:, None]
    image[walls] = 20
    return image, walls


def test_local_paper_is_the_paint_of_each_room():
    image, _ = plan()
    paper = local_paper(image)
    assert tuple(paper[60, 60]) == TONES["left"] and tuple(paper[60, 240]) == TONES["right"] and tuple(paper[5, 5]) == (255,) * 3
    assert tuple(paper[28, 100]) in (TONES["left"], (255, 255, 255))  # on a wall, one of its two sides
    assert local_paper(plan(painted=False)[0]) is None


def test_without_paint_is_the_drawing_on_white():
    image, walls = plan()
    clean = without_paint(image)
    assert (clean[~walls] == 255).all()
    assert clean[walls].max() < 40


@pytest.mark.parametrize("share", [0.25, 0.5, 0.75])
def test_without_paint_of_ink_that_covers_a_part_of_a_pixel(share):
    image, _ = plan()
    image[100, 60:100] = np.rint(np.array(TONES["left"]) * (1 - share))
    assert without_paint(image)[100, 80] == pytest.approx([255 * (1 - share)] * 3, abs=2)


def test_without_paint_leaves_a_drawing_without_paint():
    image, _ = plan(painted=False)
    assert without_paint(image) is image


def test_extract_walls_of_painted_rooms_is_that_of_white_ones():
    (painted, walls), (white, _) = plan(), plan(painted=False)
    found = [extract_walls(Drawing(image.mean(axis=2).astype(np.uint8), image)).walls.mask for image in (painted, white)]
    np.testing.assert_array_equal(found[0], walls)
    np.testing.assert_array_equal(found[1], walls)


def test_local_paper_takes_no_pale_wall_for_paint():
    image = np.full((200, 300, 3), 255, dtype=np.uint8)
    image[20:180, 20:140], image[20:180, 150:280] = (240, 225, 200), (215, 235, 220)
    image[20:180, 140:150] = 130  # a grey wall between them, paler than half of the black line
    image[100, 20:280] = 0
    paper = local_paper(image)
    assert paper[50, 80].tolist() == [240, 225, 200] and paper[50, 200].tolist() == [215, 235, 220]
    assert paper[60, 145].min() > 195
