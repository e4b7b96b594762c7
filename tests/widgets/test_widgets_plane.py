"""Small line drawings: values lie where the axes say, colours are those of the scale, text is escaped."""

from __future__ import annotations

import base64
import re
import xml.etree.ElementTree as ElementTree

import cv2
import numpy as np
import pytest

from priorlab.widgets.plane import UNKNOWN, Plane, cividis


@pytest.fixture
def plane():
    return Plane((0.0, 10.0), (-1.0, 1.0), ("x", "y"), "title", (200, 200), 20, (0, 5, 10), (-1, 0, 1))


def test_plane_is_well_formed_and_escapes_its_words(plane):
    plane.words(1, 0, "a < b & c")
    root = ElementTree.fromstring(plane.svg())
    texts = [node.text for node in root.iter("{http://www.w3.org/2000/svg}text")]
    assert {"x", "y", "title", "a < b & c", "10", "-1"} <= set(texts)


def test_plane_y_goes_up_and_ends_are_the_corners(plane):
    assert plane.at_x(0) == 52 and plane.at_x(10) == 180 and plane.at_x(5) == 116
    assert plane.at_y(-1) == 160 and plane.at_y(1) == 24 and plane.at_y(0) == 92


def test_plane_values_beyond_the_axes_lie_on_their_ends(plane):
    assert plane.at_x(99) == plane.at_x(10) and plane.at_y(-99) == plane.at_y(-1)


def test_plane_logarithmic_axis_has_equal_steps():
    plane = Plane((1, 100), (0, 1), ("n", ""), x_ticks=(1, 10, 100), logarithmic=True)
    assert plane.at_x(10) - plane.at_x(1) == pytest.approx(plane.at_x(100) - plane.at_x(10))


def test_plane_line_leaves_unknown_values_out(plane):
    plane.line([0, 5, 10], [0, np.nan, 1], "stroke='#000'")
    points = re.search(r"points='([^']*)'", plane.svg())[1].split()
    assert points == ["52.0,92.0", "180.0,24.0"]


def test_plane_copy_leaves_the_original_alone(plane):
    other = plane.copy()
    other.points(5, 0, "ring", "#123456")
    assert "#123456" in other.svg() and "#123456" not in plane.svg()


def test_plane_colours_has_x_to_the_right_and_y_up(plane):
    values = np.array([[0.0, 0.0], [0.0, 1.0]])  # high where x and y are high
    plane.colours(values)
    png = base64.b64decode(re.search(r"base64,([^']*)'", plane.svg())[1])
    pixels = cv2.imdecode(np.frombuffer(png, np.uint8), cv2.IMREAD_COLOR)[..., ::-1]
    high = cividis([[1.0]])[0, 0]
    assert (pixels[0, 1] == high).all() and not (pixels[1, 1] == high).all() and not (pixels[0, 0] == high).all()


def test_cividis_grows_lighter_and_marks_what_is_not_known():
    colours = cividis(np.linspace(0, 1, 50)[None])[0].astype(int)
    assert (np.diff(colours.sum(axis=1)) >= -2).all() and colours[-1].sum() > colours[0].sum() + 200
    assert tuple(cividis([[np.nan]])[0, 0]) == UNKNOWN
