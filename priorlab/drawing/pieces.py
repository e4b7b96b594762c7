"""Pieces of wall, each with a confidence: what supports it, in numbers from 0 to 1.

A piece is a straight stretch between junctions. It is trusted when the hypotheses agree on it, when it is longer than thick,
when it is part of the building's network, and when a door stands at its end.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.core.drawing import Door
from priorlab.drawing.runs import run_lengths
from priorlab.drawing.strokes import common_thickness
from priorlab.drawing.weight import Hypothesis

AT_JAMB = 0.3
"""A jamb within so many door widths supports a piece."""

LONG_ENOUGH = 6.0
"""A piece so many times longer than thick has all the support that length gives."""

SHARES = (0.6, 0.2, 0.2)
"""What agreement, length and network weigh; a door then halves the doubt that is left."""


@dataclass(frozen=True, eq=False)
class WallPiece:
    """A straight stretch of wall, in pixels of the drawing.

    Parameters
    ----------
    box : x, y, width, height of its bounding box
    mask : (height, width) bool within the box
    confidence : 0 to 1
    agreement : share of the hypotheses, weighed by their worth, that see it
    slenderness : its length in thicknesses over `LONG_ENOUGH`, at most 1
    network : share of all walls that it is joined to, doors and windows bridged
    at_door : a door stands at its end
    kind : "wall", or "window"
    """

    box: tuple[int, int, int, int]
    mask: NDArray[np.bool_]
    confidence: float
    agreement: float
    slenderness: float
    network: float
    at_door: bool
    kind: Literal["wall", "window"] = "wall"


def wall_pieces(
    walls: NDArray[np.bool_],
    hypotheses: Sequence[Hypothesis],
    worths: Sequence[float],
    doors: Sequence[Door],
    windows: NDArray[np.bool_] | None = None,
) -> tuple[WallPiece, ...]:
    """The pieces of walls, in reading order of their boxes' corners as `connectedComponents` gives them.

    Parameters
    ----------
    walls : (height, width) bool
    hypotheses : what may be wall, in the same pixels
    worths : trust in each of them, at least 0
    doors : in the same pixels
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
    across, down = run_lengths(walls, 1)[walls], run_lengths(walls, 0)[walls]
    thickness = np.bincount(inside, np.minimum(across, down), minlength=n_pieces) / np.maximum(area, 1)
    slender = np.minimum(area / np.maximum(thickness, 1) ** 2 / LONG_ENOUGH, 1)
    network = _network(walls, labels, area, doors)
    at_door = _at_jambs(labels, n_pieces, doors)
    confidence = np.column_stack([agreement, slender, network]) @ SHARES
    confidence = np.where(at_door, 1 - (1 - confidence) / 2, confidence)
    boxes = _boxes(labels, n_pieces)
    return tuple(
        WallPiece(
            box=boxes[k],
            mask=_cut(labels, boxes[k]) == k,
            confidence=float(np.clip(confidence[k], 0, 1)),
            agreement=float(agreement[k]),
            slenderness=float(slender[k]),
            network=float(network[k]),
            at_door=bool(at_door[k]),
            kind="window" if k >= first_window else "wall",
        )
        for k in range(1, n_pieces)
        if area[k]
    )


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


def _network(
    walls: NDArray[np.bool_], labels: NDArray[np.int32], area: NDArray[np.float64], doors: Sequence[Door]
) -> NDArray[np.float64]:
    """For every piece: the share of all walls that lies in its network, where doors and gaps of a few pixels are bridged."""
    joined = cv2.dilate(walls.astype(np.uint8), np.ones((7, 7), np.uint8))
    for door in doors:
        start, end = (tuple(int(round(c)) for c in jamb) for jamb in (door.hinge, door.strike))
        cv2.line(joined, start, end, 1, 7)
    n_nets, nets = cv2.connectedComponents(joined, connectivity=8)
    size = np.bincount(nets[walls], minlength=n_nets) / walls.sum()
    total = np.bincount(labels[walls], size[nets[walls]], minlength=len(area))
    return np.asarray(total / np.maximum(area, 1))


def _at_jambs(labels: NDArray[np.int32], n_pieces: int, doors: Sequence[Door]) -> NDArray[np.bool_]:
    """Which pieces have a jamb near them."""
    found = np.zeros(n_pieces, dtype=bool)
    for door in doors:
        reach = max(2, round(AT_JAMB * door.width / 2))
        for x, y in np.rint([door.hinge, door.strike]).astype(int):
            found[labels[max(0, y - reach) : y + reach + 1, max(0, x - reach) : x + reach + 1]] = True
    found[0] = False
    return found


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
