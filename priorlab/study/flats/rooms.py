"""A coarse picture of a flat in which its rooms are told apart."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.interchange.r2v import Box
from priorlab.study.flats.lines import Points, WallLine

PER_METRE = 25
"""Pixels per metre of the picture."""


@dataclass(frozen=True, eq=False)
class RoomPicture:
    """A coarse picture of a flat: (height, width) labels, 0 on walls, 1 outside, 2... one number for each closed room."""

    labels: NDArray[np.int32]
    low: Points

    def pixel(self, points: Points) -> NDArray[np.int64]:
        """(..., 2) column and row of points."""
        xy = np.rint((np.asarray(points) - self.low) * PER_METRE).astype(int)
        height, width = self.labels.shape
        return np.clip(np.stack([xy[..., 0], height - 1 - xy[..., 1]], axis=-1), 0, [width - 1, height - 1])

    def point(self, column: float, row: float) -> Points:
        """The point of a pixel, metres."""
        return self.low + np.array([column, self.labels.shape[0] - 1 - row]) / PER_METRE

    def at(self, box: Box) -> int:
        """Label at a box's middle."""
        column, row = self.pixel(np.array(middle_of(box)))
        return int(self.labels[row, column])

    def taken(self, box: Box) -> tuple[slice, slice]:
        """Rows and columns that a box covers."""
        (left, bottom), (right, top) = self.pixel(np.array([box[:2], box[2:]]))
        return slice(top, bottom + 1), slice(left, right + 1)

    def beside(self, wall: WallLine, share: float) -> tuple[int, int]:
        """What lies to the left and to the right of a wall there."""
        sides = []
        for side in (1, -1):
            for distance in (0.2, 0.3, 0.45):
                column, row = self.pixel(wall.at(share) + side * distance * wall.across)
                label = int(self.labels[row, column])
                if label:
                    break
            sides.append(label)
        return sides[0], sides[1]


def picture_rooms(walls: Sequence[WallLine], margin: float = 0.6) -> RoomPicture:
    """Tell rooms apart: what the centre lines, openings shut, cut off from the outside and from each other."""
    ends = np.array([point for wall in walls for point in (wall.start, wall.end)])
    low = ends.min(axis=0) - margin
    width, height = np.ceil((ends.max(axis=0) + margin - low) * PER_METRE).astype(int) + 1
    canvas = np.full((height, width), 1, np.uint8)
    picture = RoomPicture(canvas.astype(np.int32), low)
    for wall in walls:
        first, last = (tuple(int(v) for v in picture.pixel(point)) for point in (wall.start, wall.end))
        cv2.line(canvas, first, last, 0, 3)
    _, labels = cv2.connectedComponents(canvas, connectivity=4)
    outside = labels[0, 0]
    swapped = np.where(labels == outside, 1, np.where(labels == 1, outside, labels))
    return RoomPicture(np.where(canvas == 0, 0, swapped).astype(np.int32), low)


def middle_of(box: Box) -> tuple[float, float]:
    """The middle of a box."""
    return (box[0] + box[2]) / 2, (box[1] + box[3]) / 2
