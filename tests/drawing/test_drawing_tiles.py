"""Divide and conquer: tiles cover the drawing once, and their budgets add up."""

from dataclasses import replace

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from priorlab.buildings.floor_plans import load_floor_plan
from priorlab.core.drawing import Door, Drawing
from priorlab.drawing.corners import detect_corners
from priorlab.drawing.extraction import extract_walls
from priorlab.drawing.method import THESIS, Method
from priorlab.drawing.tiles import tile_boxes


@given(st.integers(1, 60), st.integers(1, 60), st.integers(1, 7))
def test_tile_boxes_cover_every_pixel_once(height, width, n):
    count = np.zeros((height, width), dtype=int)
    for left, top, right, bottom in tile_boxes((height, width), n):
        count[top:bottom, left:right] += 1
    assert (count == 1).all()


def test_tile_boxes_rejects_none():
    with pytest.raises(ValueError, match="tiles must be at least 1, got 0"):
        tile_boxes((5, 5), 0)


def test_method_rejects_no_tiles():
    with pytest.raises(ValueError, match="tiles must be above 0, got 0"):
        Method(tiles=0)


def test_detect_corners_in_tiles_gives_each_tile_its_budget():
    grey = np.full((200, 200), 255, dtype=np.uint8)
    for x in range(10, 95, 20):  # a crowd of strong corners in the upper left
        for y in range(10, 95, 20):
            cv2.rectangle(grey, (x, y), (x + 9, y + 9), 0, -1)
    cv2.rectangle(grey, (130, 130), (170, 160), 150, -1)  # a pale box in the lower right
    method = replace(THESIS, n_corners=20)
    whole, tiled = detect_corners(Drawing(grey), method=method), detect_corners(Drawing(grey), method=replace(method, tiles=2))
    assert len(whole) == 20 and (whole < 100).all()  # the crowd took all
    pale = tiled[(tiled > 100).all(axis=1)]
    assert {tuple(np.round(p, -1)) for p in pale} == {(130.0, 130.0), (170.0, 130.0), (130.0, 160.0), (170.0, 160.0)}
    assert len(tiled) == 24


def test_detect_corners_a_seam_is_no_edge():
    grey = np.full((100, 100), 255, dtype=np.uint8)
    grey[47:53, 10:90] = 0  # a wall along the seam and across the other one
    corners = detect_corners(Drawing(grey), method=replace(THESIS, tiles=2))
    assert {tuple(np.round(p, -1)) for p in corners} == {(10.0, 50.0), (90.0, 50.0)}


def _is_near(door: Door, true: Door) -> bool:
    """Are the jambs the true ones, either way round?"""
    jambs, wanted = door.points[:2], true.points[:2]
    return min(np.abs(jambs - wanted).max(), np.abs(jambs[::-1] - wanted).max()) < 0.3 * true.width


def test_extract_walls_thesis_in_tiles_finds_more_doors():
    plan = load_floor_plan("flat_north")
    right = {}
    for tiles in (1, 2):
        found = extract_walls(plan.drawing, replace(THESIS, tiles=tiles))
        assert len(found.corners) <= tiles**2 * THESIS.n_corners
        right[tiles] = sum(any(_is_near(door, true) for door in found.doors) for true in plan.truth.doors)
    assert right[2] >= right[1] + 2
