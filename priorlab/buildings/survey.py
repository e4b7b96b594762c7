"""A survey: a net of straight lanes through the free space of every room, looking left and right in turn (eq. 5.3, 5.4)."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.core.survey import look_around

Segment = tuple[tuple[float, float], tuple[float, float]]

LANE_GAP = 1.7
"""Lanes lie at most so many sensor ranges apart: the cones of two lanes meet, and every wall lies within range of one."""

KEEP_OFF_M = 0.1
"""Poses stay so far from every obstacle, metres."""


def survey_of(
    rooms: list[NDArray[np.bool_]], obstacles: NDArray[np.bool_], metres_per_pixel: float, reach: float, spacing: float
) -> NDArray[np.float64]:
    """Poses along horizontal and vertical lanes of every room.

    Parameters
    ----------
    rooms : (height, width) True inside each room
    obstacles : (height, width) True where no robot can stand
    metres_per_pixel : scale
    reach : range of the sensor, pixels
    spacing : distance between poses, pixels

    Returns
    -------
    (N, 3) x, y, theta; pixels, y up
    """
    distance = cv2.distanceTransform((~obstacles).view(np.uint8), cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
    free = distance > max(2.0, KEEP_OFF_M / metres_per_pixel)
    segments = [segment for room in rooms for segment in _net(room, room & free, LANE_GAP * reach)]
    return look_around(segments, spacing)


def _net(room: NDArray[np.bool_], free: NDArray[np.bool_], gap: float) -> list[Segment]:
    """Lanes of one room: rows and columns spread evenly over it, kept where a robot can stand."""
    height = room.shape[0]
    rows, cols = np.flatnonzero(room.any(axis=1)), np.flatnonzero(room.any(axis=0))
    lanes: list[Segment] = []
    for row in _spread(rows[0], rows[-1] + 1, gap):
        y = height - row - 0.5
        lanes += [((start + 0.5, y), (end - 0.5, y)) for start, end in _runs(free[row])]
    for col in _spread(cols[0], cols[-1] + 1, gap):
        lanes += [((col + 0.5, height - end + 0.5), (col + 0.5, height - start - 0.5)) for start, end in _runs(free[:, col])]
    return lanes


def _spread(start: int, end: int, gap: float) -> list[int]:
    """Middles of the fewest equal strips, at most `gap` wide, of the range."""
    n_strips = max(1, int(np.ceil((end - start) / gap)))
    return [int(start + (end - start) * (i + 0.5) / n_strips) for i in range(n_strips)]


def _runs(line: NDArray[np.bool_], shortest: int = 3) -> list[tuple[int, int]]:
    """Runs of True in a row of pixels as start and end (exclusive)."""
    change = np.flatnonzero(np.diff(np.concatenate([[0], line.astype(np.int8), [0]])))
    return [(int(start), int(end)) for start, end in zip(change[::2], change[1::2], strict=True) if end - start >= shortest]
