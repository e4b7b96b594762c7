"""What the score counts, as a picture: found, missed and invented wall pixels."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.core.building import Truth
from priorlab.core.grid_map import GridMap

EMPTY, INVENTED, MISSED, FOUND, IGNORED = (255, 255, 255), (86, 180, 233), (213, 94, 0), (0, 0, 0), (225, 225, 225)
"""Colours that colour-blind readers tell apart (Okabe and Ito), and that differ in lightness as well."""

LEGEND = "black: found; dark orange: missed; light blue: invented; grey: not counted"


def scored_picture(grid_map: GridMap, truth: Truth, threshold: float) -> NDArray[np.uint8]:
    """(height, width, 3) RGB: every pixel of the drawing by what the score makes of it.

    >>> grid_map = GridMap(np.array([[-3.0, 3.0, -3.0, 3.0]]), __import__("priorlab").Grid((1, 4)))
    >>> truth = Truth(np.array([[1, 1, 0, 0]]), np.zeros((1, 4)))
    >>> scored_picture(grid_map, truth, 0.2).tolist()                          # found, missed, invented, empty
    [[[0, 0, 0], [213, 94, 0], [86, 180, 233], [255, 255, 255]]]
    """
    detected = grid_map.grid.to_image(grid_map.detected(threshold))
    kind = detected.astype(np.uint8) + 2 * truth.walls.astype(np.uint8)
    kind[truth.ignore] = 4
    colours = np.zeros((256, 1, 3), dtype=np.uint8)
    colours[:5, 0] = (EMPTY, INVENTED, MISSED, FOUND, IGNORED)
    return np.asarray(cv2.applyColorMap(kind, colours), dtype=np.uint8)


def reduced(picture: NDArray[np.uint8], width: int) -> NDArray[np.uint8]:
    """A picture no wider than it is shown: thin walls stay visible, and less has to travel.

    >>> reduced(np.zeros((300, 900, 3), dtype=np.uint8), 450).shape
    (150, 450, 3)
    """
    scale = width / picture.shape[1]
    if scale >= 1:
        return picture
    size = (width, max(1, round(picture.shape[0] * scale)))
    return np.asarray(cv2.resize(picture, size, interpolation=cv2.INTER_AREA), dtype=np.uint8)
