"""Sheets laid askew by a known angle: it is found, and everything comes back in the pixels that came in."""

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from priorlab.buildings.floor_plans import load_floor_plan
from priorlab.core.drawing import Drawing
from priorlab.drawing.deskew import find_skew, turn_by
from priorlab.drawing.extraction import extract_walls
from priorlab.drawing.method import ROBUST, THESIS
from priorlab.drawing.preprocessing import prepare


def _laid_askew(grey: np.ndarray, degrees: float) -> tuple[np.ndarray, np.ndarray]:
    """The sheet turned about its middle by OpenCV's own rotation, and the matrix; nothing of deskew.py is used."""
    height, width = grey.shape
    matrix = cv2.getRotationMatrix2D(((width - 1) / 2, (height - 1) / 2), degrees, 1.0)
    return cv2.warpAffine(grey, matrix, (width, height), flags=cv2.INTER_CUBIC, borderValue=255), matrix


@pytest.mark.parametrize("name", ["small_flat", "office_wing"])
@pytest.mark.parametrize("degrees", [0.3, -0.8, 2.5, -6.0, 14.0])
def test_find_skew_of_a_turned_drawing(name, degrees):
    askew, _ = _laid_askew(load_floor_plan(name).drawing.grey, degrees)
    assert find_skew(askew) == pytest.approx(degrees, abs=0.05)


@pytest.mark.parametrize("name", ["small_flat", "busy_flat", "office_wing", "office_floor"])
def test_find_skew_straight_is_zero_even_with_noise(name):
    grey = load_floor_plan(name).drawing.grey
    noise = np.random.default_rng(3).normal(0, 12, grey.shape)
    assert find_skew(grey) == 0
    assert find_skew(np.clip(grey + noise, 0, 255).astype(np.uint8)) == 0


def test_find_skew_a_wing_at_an_angle_is_no_skew():
    grey = np.full((600, 800), 255, dtype=np.uint8)
    cv2.rectangle(grey, (40, 300), (300, 560), 0, 4)  # the straight house
    wing = cv2.boxPoints(((520, 220), (420, 220), 12)).astype(np.int32)  # a larger wing, 12 degrees off
    cv2.polylines(grey, [wing], True, 0, 4)
    assert find_skew(grey) == 0


@pytest.mark.parametrize("shape", [(1, 1), (5, 5), (40, 3), (300, 300)])
@pytest.mark.parametrize("value", [0, 255])
def test_find_skew_of_nothing_is_zero(shape, value):
    assert find_skew(np.full(shape, value, dtype=np.uint8)) == 0


def test_find_skew_of_noise_is_zero():
    assert find_skew(np.random.default_rng(1).integers(0, 256, (300, 400)).astype(np.uint8)) == 0


@given(st.floats(-15, 15), st.integers(1, 60), st.integers(1, 60), st.integers(0, 1000))
def test_turn_points_there_and_back(degrees, height, width, seed):
    turn = turn_by(degrees, (height, width))
    points = np.random.default_rng(seed).uniform(0, 60, (5, 2))
    assert np.allclose(turn.points_back(turn.points(points)), points)
    corners = turn.points([(0, 0), (width - 1, 0), (0, height - 1), (width - 1, height - 1)])
    assert (corners > -1).all() and (corners < np.array(turn.to_shape[::-1])).all()  # nothing is cut off


def test_turn_mask_back_is_where_it_came_from():
    turn = turn_by(7, (120, 160))
    mask = np.zeros((120, 160), dtype=np.uint8)
    mask[40:80, 30:110] = 255
    there = turn.image(mask) >= 128
    back = turn.mask_back(there)
    assert back.shape == (120, 160)
    assert (back != (mask > 0)).sum() <= 240  # only pixels of the rim, 236 long, differ
    assert back[45:75, 35:105].all() and not back[:35].any()


@pytest.mark.parametrize("degrees", [-4.0])
def test_extract_walls_of_a_turned_drawing_answers_in_its_own_pixels(room, degrees):
    askew, matrix = _laid_askew(room.grey, degrees)
    truth = cv2.warpAffine(room.walls.astype(np.uint8) * 255, matrix, askew.shape[::-1]) >= 128
    found = extract_walls(Drawing(askew, name="askew"))
    halo = cv2.dilate(truth.astype(np.uint8), np.ones((3, 3), np.uint8)).astype(bool)
    inner = cv2.erode(truth.astype(np.uint8), np.ones((3, 3), np.uint8)).astype(bool)
    assert found.walls.shape == askew.shape
    assert all(stage.shape == askew.shape for stage in (*found.sweeps, found.outer))
    assert (found.walls.mask & ~halo).sum() < 0.02 * truth.sum()
    assert found.walls.mask[inner].mean() > 0.97
    true_jambs = np.array(room.jambs) @ matrix[:, :2].T + matrix[:, 2]
    assert len(found.doors) == 1
    jambs = found.doors[0].points[:2]
    assert min(np.abs(jambs - true_jambs).max(), np.abs(jambs[::-1] - true_jambs).max()) < 5
    assert any("lies askew" in note for note in found.notes)


def test_prepare_thesis_turns_nothing(room):
    askew, _ = _laid_askew(room.grey, 5)
    assert prepare(Drawing(askew), THESIS).turn is None
    assert prepare(Drawing(askew), ROBUST).turn is not None
    assert prepare(room.drawing, ROBUST).turn is None
