"""A sheet may be laid on the glass any way round: turned or mirrored, its walls are found as well as before."""

import numpy as np
import pytest

from priorlab.core.building import Truth
from priorlab.core.drawing import Drawing
from priorlab.core.score import score_mask
from priorlab.drawing.extraction import extract_walls
from priorlab.study.drawing_suite import suite

A_POINT = 0.01


def _iou(image, truth, way):
    """How well the walls of a drawing are found when it is laid down in some way."""
    grey, walls, ignore = (np.ascontiguousarray(way(plane)) for plane in (image, truth.walls, truth.ignore))
    return score_mask(extract_walls(Drawing(grey)).walls.mask, Truth(walls, ignore)).iou


@pytest.mark.parametrize("name", ["garden_house"])
def test_extract_walls_however_the_sheet_lies(name):
    (case,) = suite("tuned", [name])
    grey = case.drawing.grey
    upright = _iou(grey, case.truth, np.asarray)
    turned, mirrored = _iou(grey, case.truth, np.rot90), _iou(grey, case.truth, np.fliplr)
    assert turned == pytest.approx(upright, abs=A_POINT) and mirrored == pytest.approx(upright, abs=A_POINT)
