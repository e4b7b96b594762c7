"""Painting on a magnified drawing, and the funnel in SVG."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import numpy as np
import pytest

from priorlab.widgets.canvas import BLUE, GREEN, RED, Canvas, window_round
from priorlab.widgets.funnel import funnel_svg


@pytest.fixture
def paper():
    return np.full((10, 12), 255, dtype=np.uint8)


def test_canvas_window_outside_the_drawing_is_paper():
    canvas = Canvas(np.zeros((4, 4), np.uint8), 1, (-2, -2, 8, 8), faint=0.0)
    assert (canvas.picture[2:6, 2:6] == 0).all() and canvas.picture.sum() == 255 * 3 * (64 - 16)


def test_canvas_faint_ink_is_grey(paper):
    paper[3, 3] = 0
    assert Canvas(paper, faint=0.6).picture[3, 3].tolist() == [153, 153, 153]


def test_canvas_fill_colours_whole_pixels_of_the_window_only(paper):
    canvas = Canvas(paper, 3, (2, 1, 5, 4))
    canvas.fill([(2, 1), (6, 4), (7, 4), (0, 0)], RED)
    red = (canvas.picture == RED).all(axis=2)
    assert red.sum() == 18 and red[:3, :3].all() and red[9:, 12:].all()


def test_canvas_ring_and_dot_lie_on_their_pixel(paper):
    canvas = Canvas(paper, 10)
    canvas.ring((4, 2), BLUE, 1)
    rows, cols = np.nonzero((canvas.picture == BLUE).all(axis=2))
    assert (rows.min(), rows.max(), cols.min(), cols.max()) == (20, 29, 40, 49)
    canvas.dot((8, 7), GREEN, 3)
    rows, cols = np.nonzero((canvas.picture == GREEN).all(axis=2))
    assert rows.mean() == pytest.approx(75, abs=0.6) and cols.mean() == pytest.approx(85, abs=0.6)


def test_canvas_triangle_tints_its_inside(paper):
    canvas = Canvas(paper, 4)
    canvas.triangle([(1, 1), (9, 1), (1, 8)], RED, 1, 0.5)
    assert canvas.picture[12, 12].tolist() == [234, 174, 127] and canvas.picture[38, 46].tolist() == [255, 255, 255]


def test_window_round_is_square_and_holds_its_points():
    left, top, width, height = window_round([(3, 40), (50, 44)], 5)
    assert width == height == 58 and left <= -2 and left + width >= 55 and top <= 35 and top + height >= 49


def test_funnel_svg_has_a_bar_for_each_stage_and_escapes_names():
    svg = funnel_svg({"corners": 200, "a < b": 10, "none": 0}, marked="a < b")
    texts = [element.text for element in ET.fromstring(svg).iter() if element.tag.endswith("text")]
    assert "200" in texts and "\u25b8 a < b" in texts and "0 none left" in texts
    bars = [float(element.get("width")) for element in ET.fromstring(svg).iter() if element.tag.endswith("rect")][1:]
    assert bars[0] > bars[1] > bars[2] and bars[1] / bars[0] == pytest.approx(np.log10(11) / np.log10(201), abs=1e-2)
