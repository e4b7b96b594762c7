"""Degradations do what they say, and the truth goes along."""

import math

import cv2
import numpy as np
import pytest

from priorlab.buildings.degradations import LIMITS, Degradation, degrade
from priorlab.buildings.description import parse_description
from priorlab.buildings.floor_plans import draw_plan
from priorlab.buildings.frame import frame_of
from priorlab.core.building import Truth
from priorlab.core.drawing import Door, Drawing

HUT = """
metres_per_pixel = 0.02
walls = [{{ style = "outer", outline = {outline} }}]
doors = [{{ at = {at}, width = 1.0, hinge = "west", opens = "north" }}]
[styles.outer]
thickness = 0.2
[sheet]
margins = [1, 1, 1, 1]
"""
CORNERS = np.array([[0, 0], [4, 0], [4, 3], [0, 3]], dtype=float)
DOOR_AT = np.array([1.5, 0.1])


def hut(degrees=0.0):
    """A hut with a door, turned about the middle of its sheet by its description: no picture is turned."""
    angle = math.radians(degrees)
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    corners, at = ((points - (2, 1.5)) @ turn.T for points in (CORNERS, DOOR_AT))
    text = HUT.format(outline=corners.round(9).tolist(), at=at.round(9).tolist())
    description = parse_description(text, "hut")
    return draw_plan(description), frame_of(description).to_image((0.0, 0.0))


def spoiled(kind, amount, grey, seed=0):
    drawing = Drawing(np.asarray(grey, dtype=np.uint8))
    truth = Truth(np.zeros(drawing.shape, bool), np.zeros(drawing.shape, bool))
    after, same = degrade(drawing, truth, [Degradation(kind, amount)], np.random.default_rng(seed))
    assert same is truth
    return after.grey.astype(float)


@pytest.mark.parametrize("degrees", [4.0, -2.5, 30.0])
def test_skew_of_the_truth_is_the_truth_of_the_skewed_building(degrees):
    (drawing, truth), middle = hut()
    (_, wanted), wanted_middle = hut(degrees)
    _, skewed = degrade(drawing, truth, [Degradation("skew", degrees)], np.random.default_rng(0))
    shift = np.array(skewed.shape[::-1]) / 2 - wanted_middle  # the hut stands in the middle of its sheet
    assert np.allclose(middle, np.array(drawing.shape[::-1]) / 2)
    whole = np.round(shift).astype(int)
    there = np.zeros_like(skewed.walls)
    rows, cols = np.nonzero(wanted.walls)
    there[rows + whole[1], cols + whole[0]] = True
    for one, other in ((there, skewed.walls), (skewed.walls, there)):
        away = cv2.distanceTransform((~other).astype(np.uint8), cv2.DIST_L2, 5)
        assert away[one].max() <= 1.5  # a pixel, and half a one for the shift
    assert skewed.walls.sum() == pytest.approx(10 * (2 * (200 + 150) - 40 - 50), rel=0.01)  # turning keeps areas
    found = skewed.doors[0].points
    assert np.abs(found - (wanted.doors[0].points + shift)).max() < 1e-6


def test_skew_turns_points_counter_clockwise_about_the_middle():
    drawing = Drawing(np.full((40, 60), 255, np.uint8))
    truth = Truth(np.zeros((40, 60), bool), np.zeros((40, 60), bool), (Door((30, 20), (50, 20), (30, 5)),))
    _, skewed = degrade(drawing, truth, [Degradation("skew", 30)], np.random.default_rng(0))
    height, width = skewed.shape
    assert skewed.doors[0].points[0] == pytest.approx([width / 2, height / 2])
    assert skewed.doors[0].points[1] == pytest.approx([width / 2 + 20 * math.cos(math.pi / 6), height / 2 - 10])  # y is down


def test_skew_keeps_a_rim_of_dont_care_and_paper_white():
    (drawing, truth), _ = hut()
    after, skewed = degrade(drawing, truth, [Degradation("skew", 3)], np.random.default_rng(0))
    rim = cv2.dilate(skewed.walls.astype(np.uint8), np.ones((3, 3), np.uint8)).astype(bool) & ~skewed.walls
    assert skewed.ignore[rim].all() and not (skewed.ignore & skewed.walls).any()
    assert after.grey[0, 0] == after.grey[-1, -1] == 255
    assert (after.grey[skewed.walls] < 160).all() and (after.grey[~skewed.walls & ~skewed.ignore] > 200).all()


def test_noise_has_its_standard_deviation_and_no_bias():
    grey = spoiled("noise", 12, np.full((200, 200), 128))
    assert grey.std() == pytest.approx(12, rel=0.05) and grey.mean() == pytest.approx(128, abs=0.3)


def test_noise_is_the_same_for_the_same_seed_only():
    flat = np.full((20, 20), 128)
    assert np.array_equal(spoiled("noise", 9, flat, 4), spoiled("noise", 9, flat, 4))
    assert not np.array_equal(spoiled("noise", 9, flat, 4), spoiled("noise", 9, flat, 5))


def test_blur_spreads_a_line_by_its_standard_deviation():
    grey = np.full((61, 61), 255)
    grey[:, 30] = 0
    profile = 255 - spoiled("blur", 2.0, grey)[30]
    x = np.arange(61) - 30
    assert (profile * x).sum() == pytest.approx(0)
    assert math.sqrt((profile * x**2).sum() / profile.sum()) == pytest.approx(2.0, rel=0.05)


def test_shading_takes_its_share_of_the_light_from_one_corner():
    grey = spoiled("shading", 0.3, np.full((50, 80), 200))
    assert grey.max() == 200 and grey.min() == pytest.approx(140)
    assert grey.min() in (grey[-1, 0], grey[-1, -1])


def test_jpeg_is_coarser_with_less_quality():
    rng = np.random.default_rng(3)
    grey = np.kron(rng.integers(0, 2, (10, 10)) * 255, np.ones((7, 7)))
    errors = [np.abs(spoiled("jpeg", quality, grey) - grey).mean() for quality in (100, 70, 20)]
    assert errors[0] < 1 < errors[1] < errors[2]


def test_colour_goes_through_all_of_them():
    colour = np.full((40, 50, 3), (250, 240, 200), np.uint8)
    colour[10:20, 10:40] = (140, 20, 30)
    drawing = Drawing(cv2.cvtColor(colour, cv2.COLOR_RGB2GRAY), colour)
    truth = Truth(np.zeros((40, 50), bool), np.zeros((40, 50), bool))
    steps = [Degradation("skew", 5), Degradation("blur", 0.6), Degradation("shading", 0.1), Degradation("jpeg", 90)]
    after, _ = degrade(drawing, truth, steps, np.random.default_rng(0))
    assert after.colour is not None and after.colour.shape == (*after.grey.shape, 3)
    red = after.colour[after.shape[0] // 2 - 5, after.shape[1] // 2].astype(int)
    assert red[0] - red[1] > 80 and abs(int(after.colour[1, 1, 0]) - 250) < 12


@pytest.mark.parametrize(("kind", "amount"), [(kind, 2 * limits[1] + 1) for kind, limits in LIMITS.items()])
def test_too_much_is_refused(kind, amount):
    with pytest.raises(ValueError, match=f"amount of {kind} must lie between"):
        Degradation(kind, amount)
