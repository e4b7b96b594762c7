"""Pieces of wall, each with a confidence: what supports it, in numbers from 0 to 1.

A piece is a straight stretch between junctions, or a window. It is trusted when the hypotheses agree on it, when it is as thick
as many walls of the plan are, and when it is long. Whether a door stands at its end, or how much of the plan it hangs together
with, tells nothing more: furniture stands along walls and beside doors.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.drawing.runs import run_lengths
from priorlab.drawing.strokes import common_thickness, thinner_run
from priorlab.drawing.weight import Hypothesis

SAME = 0.1
"""Thicknesses so near to each other, as a share, are one; and those within a pixel."""

LONG = 0.125
"""A piece as long as this share of the building has all the support that length gives: about three doors."""

SHARES = (0.5, 0.3, 0.2)
"""What agreement, thickness and length weigh: round numbers, the better witness first."""


@dataclass(frozen=True, eq=False)
class WallPiece:
    """A straight stretch of wall, in pixels of the drawing.

    Parameters
    ----------
    box : x, y, width, height of its bounding box
    mask : (height, width) bool within the box
    confidence : 0 to 1
    agreement : share of the hypotheses, weighed by their worth, that see it
    commonness : area of all walls that are as thick as it, over that of the commonest thickness
    length : its length over `LONG` of the building's, at most 1
    kind : "wall", or "window"
    """

    box: tuple[int, int, int, int]
    mask: NDArray[np.bool_]
    confidence: float
    agreement: float
    commonness: float
    length: float
    kind: Literal["wall", "window"] = "wall"

    def __repr__(self) -> str:
        x, y, width, height = self.box
        return f"WallPiece({self.kind}, {width} x {height} px at {x}, {y}, confidence {self.confidence:.2f})"


def wall_pieces(
    walls: NDArray[np.bool_],
    hypotheses: Sequence[Hypothesis],
    worths: Sequence[float],
    windows: NDArray[np.bool_] | None = None,
) -> tuple[WallPiece, ...]:
    """The pieces of walls, in reading order of their boxes' corners as `connectedComponents` gives them.

    Parameters
    ----------
    walls : (height, width) bool
    hypotheses : what may be wall, in the same pixels
    worths : trust in each of them, at least 0
    windows : (height, width) bool, boxes of windows: the walls in each are a piece of their own
    """
    if not walls.any():
        return ()
    labels, n_pieces, first_window = _split(walls, np.zeros_like(walls) if windows is None else windows)
    inside = labels[walls]
    area = np.bincount(inside, minlength=n_pieces).astype(np.float64)
    agreement = np.zeros(n_pieces)
    for hypothesis, worth in zip(hypotheses, worths, strict=True):
        agreement += worth * np.bincount(labels[hypothesis.walls & walls], minlength=n_pieces) / np.maximum(area, 1)
    agreement /= max(float(sum(worths)), 1e-9)
    boxes = _boxes(labels, n_pieces)
    thin = thinner_run(walls)
    thickness = [
        float(min(box[2:]) if k >= first_window else np.median(_cut(thin, box)[_cut(labels, box) == k])) if area[k] else 0.0
        for k, box in enumerate(boxes)
    ]
    common = _commonness(thin[walls & (labels < first_window)], np.array(thickness))
    extent = max(int(np.ptp(where)) + 1 for where in np.nonzero(walls))
    long = np.minimum([max(box[2:]) / (LONG * extent) for box in boxes], 1)
    confidence = np.column_stack([agreement, common, long]) @ SHARES
    return tuple(
        WallPiece(
            box=boxes[k],
            mask=_cut(labels, boxes[k]) == k,
            confidence=float(np.clip(confidence[k], 0, 1)),
            agreement=float(agreement[k]),
            commonness=float(common[k]),
            length=float(long[k]),
            kind="window" if k >= first_window else "wall",
        )
        for k in range(1, n_pieces)
        if area[k]
    )


def _commonness(of_walls: NDArray[np.int32], thickness: NDArray[np.float64]) -> NDArray[np.float64]:
    """How much wall is as thick as each piece, over how much is as thick as the commonest."""
    if not of_walls.size:
        return np.zeros_like(thickness)
    up_to = np.cumsum(np.bincount(of_walls, minlength=int(thickness.max()) + 2))

    def as_thick(at: NDArray[np.float64]) -> NDArray[np.float64]:
        slack = np.maximum(1.0, SAME * at)
        low, high = (np.clip(ends, 0, len(up_to) - 1).astype(int) for ends in (np.ceil(at - slack) - 1, np.floor(at + slack)))
        return (up_to[high] - up_to[low]).astype(np.float64)

    return as_thick(thickness) / as_thick(np.unique(of_walls).astype(np.float64)).max()


def _split(walls: NDArray[np.bool_], windows: NDArray[np.bool_]) -> tuple[NDArray[np.int32], int, int]:
    """Number the pieces from 1: pixels in longer horizontal runs, the others, windows; how many, and the first window's.

    Crumbs of one kind join the other.
    """
    level = walls & (run_lengths(walls, 1) >= run_lengths(walls, 0))
    crumb = common_thickness(walls) ** 2 / 2
    for mask, other in ((level, False), (walls & ~level, True)):
        _, labels, stats, _ = cv2.connectedComponentsWithStats(mask.astype(np.uint8), connectivity=8)
        small = stats[:, cv2.CC_STAT_AREA] < crumb
        small[0] = False
        level = np.where(small[labels], other, level)
    n_level, first = cv2.connectedComponents((walls & ~windows & level).astype(np.uint8), connectivity=8)
    n_upright, second = cv2.connectedComponents((walls & ~windows & ~level).astype(np.uint8), connectivity=8)
    n_windows, third = cv2.connectedComponents(windows.astype(np.uint8), connectivity=8)
    labels = np.where(second > 0, second + n_level - 1, first)
    labels = np.where(walls & windows, third + n_level + n_upright - 2, labels)
    return labels.astype(np.int32), n_level + n_upright + n_windows - 2, n_level + n_upright - 1


def _boxes(labels: NDArray[np.int32], n_pieces: int) -> list[tuple[int, int, int, int]]:
    """x, y, width, height of the box round every label."""
    rows, cols = np.nonzero(labels)
    which = labels[rows, cols]
    low, high = np.full((2, n_pieces), max(labels.shape)), np.full((2, n_pieces), -1)
    for k, where in enumerate((cols, rows)):
        np.minimum.at(low[k], which, where)
        np.maximum.at(high[k], which, where)
    size = high - low + 1
    return [(int(low[0, k]), int(low[1, k]), int(size[0, k]), int(size[1, k])) for k in range(n_pieces)]


def _cut(image: NDArray[Any], box: tuple[int, int, int, int]) -> NDArray[Any]:
    """The part of an image within a box."""
    x, y, width, height = box
    return image[y : y + height, x : x + width]
