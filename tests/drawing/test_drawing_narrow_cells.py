"""Narrow cells: what is filled before corners are looked for, known from walls that are drawn solid."""

import cv2
import numpy as np
import pytest

from priorlab.core.drawing import Drawing
from priorlab.drawing.corners import detect_corners
from priorlab.drawing.narrow_cells import with_narrow_cells


def _wall(hatched: bool) -> np.ndarray:
    """Grey drawing of one wall, 1000 x 20 pixels, hatched or solid."""
    wall = np.full((20, 1000), 255, dtype=np.uint8)
    if hatched:
        for x in range(-20, 1020, 10):
            cv2.line(wall, (x, 19), (x + 19, 0), 0, 2)
        cv2.rectangle(wall, (0, 0), (999, 19), 0, 2)
    else:
        wall[:] = 0
    sheet = np.full((300, 1200), 255, dtype=np.uint8)
    sheet[140:160, 100:1100] = wall
    return sheet


def test_with_narrow_cells_hatched_wall_is_the_solid_one():
    np.testing.assert_array_equal(with_narrow_cells(_wall(True) < 128, 12), _wall(False) < 128)


def test_detect_corners_hatched_wall_has_those_of_the_solid_one():
    corners = detect_corners(Drawing(_wall(True)))
    assert sorted(map(tuple, corners.round(-1).tolist())) == [(100, 140), (100, 160), (1100, 140), (1100, 160)]


@pytest.mark.parametrize("gap", [True, False])
def test_with_narrow_cells_fills_only_what_lines_enclose(gap):
    ink = np.zeros((30, 30), dtype=bool)
    ink[10, 5:25] = ink[16, 5:25] = ink[10:17, [5, 24]] = True
    if gap:
        ink[10, 12] = False
    assert with_narrow_cells(ink, 9).sum() == (ink.sum() if gap else 7 * 20)


def test_with_narrow_cells_strip_along_the_rim_of_the_sheet_stays_white():
    ink = np.zeros((30, 30), dtype=bool)
    ink[3] = True
    np.testing.assert_array_equal(with_narrow_cells(ink, 9), ink)
