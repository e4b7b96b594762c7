"""Colour-blind readers tell the colours of the labs apart, simulated by the matrices of Machado, Oliveira and Fernandes."""

from __future__ import annotations

from itertools import combinations

import cv2
import numpy as np
import pytest

from priorlab.plot.extraction import FOUND, IGNORED, INVENTED, MISSED
from priorlab.widgets.flip_lab import GAINED, LOST, NEVER_SEEN, NEVER_WALL, flip_colours
from priorlab.widgets.update_steps import FREE, WALL

SEEN_BY = {
    "all cones": np.eye(3),
    "no red cones": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    "no green cones": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    "no blue cones": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
}
TOGETHER = {
    "what the score counts": (FOUND, INVENTED, MISSED, IGNORED, (255, 255, 255)),
    "what a reading said": (FREE, WALL, (255, 255, 255), (0, 0, 0)),
    "what flipped": (GAINED, LOST, (255, 255, 255), (0, 0, 0)),
    "when a cell flips": (NEVER_SEEN, NEVER_WALL, (0, 0, 0), *map(tuple, flip_colours([[0.0, 0.5, 1.0]])[0])),
}


def lab_of(colour, matrix):
    """A colour as somebody sees it, in CIE Lab."""
    srgb = np.array(colour) / 255
    linear = np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
    seen = np.clip(np.asarray(matrix) @ linear, 0, 1)
    back = np.where(seen <= 0.0031308, 12.92 * seen, 1.055 * seen ** (1 / 2.4) - 0.055)
    return cv2.cvtColor(back.astype(np.float32).reshape(1, 1, 3), cv2.COLOR_RGB2Lab).ravel()


@pytest.mark.parametrize("together", TOGETHER)
@pytest.mark.parametrize("eyes", SEEN_BY)
def test_colours_that_stand_together_differ_for_everybody(eyes, together):
    seen = [lab_of(colour, SEEN_BY[eyes]) for colour in TOGETHER[together]]
    nearest = min(np.linalg.norm(one - other) for one, other in combinations(seen, 2))
    assert nearest > 10, nearest
