"""A sheet that is turned or mirrored has the same doors: how it lies on the table says nothing about the building."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from priorlab.buildings.floor_plans import load_floor_plan
from priorlab.core.drawing import Drawing
from priorlab.drawing.corners import amid_equals, detect_corners
from priorlab.drawing.doors import detect_doors

WAYS: dict[str, tuple[Callable, Callable]] = {  # of the image, and of the points (x, y) back, given height and width
    "mirrored": (lambda a: a[:, ::-1], lambda x, y, h, w: (w - 1 - x, y)),
    "turned left": (lambda a: np.rot90(a), lambda x, y, h, w: (w - 1 - y, x)),
}


@pytest.fixture(scope="module")
def flat() -> Drawing:
    return load_floor_plan("busy_flat").drawing


@pytest.fixture(scope="module")
def doors_as_it_lies(flat) -> np.ndarray:
    return _doors(flat)


def _doors(drawing: Drawing) -> np.ndarray:
    """(K, 3, 2) hinge, strike and tip of its doors."""
    return np.array([door.points for door in detect_doors(drawing, detect_corners(drawing))])


@pytest.mark.parametrize("way", WAYS)
def test_detect_doors_the_same_however_the_sheet_lies(flat, doors_as_it_lies, way):
    of_image, back = WAYS[way]
    found = _doors(replace(flat, grey=np.ascontiguousarray(of_image(flat.grey)), colour=None))
    found = np.stack(back(found[..., 0], found[..., 1], *flat.shape), axis=-1)
    apart = np.linalg.norm(found[:, None] - doors_as_it_lies[None], axis=-1).max(axis=-1)  # of the farthest of three points
    assert len(found) == len(doors_as_it_lies) >= 8
    assert apart.min(axis=0).max() <= 2


@pytest.mark.parametrize("width", [1, 2, 3])
def test_amid_equals_any_of_them_gives_their_middle(width):
    response = np.zeros((20, 30), dtype=np.float32)
    response[8, 10 : 10 + width] = 5.0
    response[12, 12] = 5.0  # as strong, but apart
    for begin in range(10, 10 + width):
        assert amid_equals(response, np.array([[begin, 8.0]])).tolist() == [[10 + (width - 1) / 2, 8.0]]
