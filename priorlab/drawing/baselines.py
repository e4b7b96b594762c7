"""Simple filters to hold the method against (thesis fig. 3.15, 3.16): what does thickness alone give?

Each takes a drawing and returns its walls as a (height, width) mask. The thesis dilates the white paper, which erodes the
ink; an opening gives the ink that survives its thickness back.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Protocol

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.core.building import Truth
from priorlab.core.drawing import Drawing
from priorlab.core.score import Score, score_mask
from priorlab.drawing.preprocessing import large_components, paper_distance
from priorlab.drawing.runs import run_lengths
from priorlab.drawing.strokes import opened, thinner_run

DARK = 127
"""Distance from the paper above which a pixel is ink."""

DARKNESSES = (15, 35, 55, 80, 105, 127, 160, 200)
"""Thresholds that `best_darkness` chooses from."""


class Filter(Protocol):
    """What all of them are: a drawing and an ink threshold in, a (height, width) mask of walls out."""

    def __call__(self, drawing: Drawing, *, darkness: int = DARK) -> NDArray[np.bool_]:
        """The walls."""
        ...


def dilation(drawing: Drawing, side: int = 2, darkness: int = DARK) -> NDArray[np.bool_]:
    """White paper dilated by a square of `side` pixels, as the thesis ran it: the ink shrinks, thin lines go.

    >>> grey = np.full((8, 8), 255, dtype=np.uint8); grey[2:6, 2:6] = 0; grey[7] = 0
    >>> int(dilation(Drawing(grey)).sum())
    9
    """
    paper = (~ink_of(drawing, darkness)).astype(np.uint8)
    square = np.ones((side, side), np.uint8)
    return ~np.asarray(cv2.dilate(paper, square, borderType=cv2.BORDER_CONSTANT, borderValue=1), dtype=bool)


def opening(drawing: Drawing, side: int = 4, darkness: int = DARK) -> NDArray[np.bool_]:
    """Ink that a square of `side` pixels fits into; never a pixel that was no ink, for even sides too.

    >>> grey = np.full((8, 8), 255, dtype=np.uint8); grey[2:6, 2:6] = 0; grey[7] = 0
    >>> int(opening(Drawing(grey)).sum())
    16
    """
    return opened(ink_of(drawing, darkness), side)


def adaptive_opening(drawing: Drawing, share: float = 0.03, darkness: int = DARK) -> NDArray[np.bool_]:
    """Opening by a width that the drawing chooses, then pieces shorter than `share` of its long side are dropped.

    The width is half of the thickness that most ink lies in, counted where ink is at least 3 px thick.
    """
    ink = ink_of(drawing, darkness)
    thickness = thinner_run(ink)[ink]
    thick = thickness[(thickness >= 3) & (thickness <= 0.03 * max(ink.shape))]
    if not thick.size:
        return np.zeros_like(ink)
    side = max(3, int(np.median(thick)) // 2)
    return large_components(opened(ink, side), share * max(ink.shape))


def run_length(drawing: Drawing, share: float = 0.03, darkness: int = DARK) -> NDArray[np.bool_]:
    """Ink in horizontal or vertical runs of at least `share` of the long side, at least 3 px thick."""
    ink = ink_of(drawing, darkness)
    longest = np.maximum(run_lengths(ink, 0), run_lengths(ink, 1))
    return opened(longest >= share * max(ink.shape), 3)


def ink_of(drawing: Drawing, darkness: int = DARK) -> NDArray[np.bool_]:
    """Pixels that differ from the paper by more than `darkness`."""
    image = drawing.grey if drawing.colour is None else drawing.colour
    return np.asarray(paper_distance(image) > darkness, dtype=bool)


def best_darkness(simple: Filter, drawing: Drawing, truth: Truth, darknesses: Sequence[int] = DARKNESSES) -> tuple[int, Score]:
    """The ink threshold at which a filter does best on a drawing whose walls are known, and how well.

    A filter stands or falls with what it takes for ink: no method should look good beside one at a bad threshold.

    Parameters
    ----------
    simple : one of `BASELINES`, or a filter of the same kind
    drawing, truth : the drawing and its walls
    darknesses : distances from the paper to choose from

    Returns
    -------
    the threshold with the largest intersection over union, the smallest of equals, and the score there
    """
    if not len(darknesses):
        raise ValueError("darknesses must hold at least one threshold, got none")
    scores = {darkness: score_mask(simple(drawing, darkness=darkness), truth) for darkness in sorted(darknesses)}
    best = max(scores, key=lambda darkness: np.nan_to_num(scores[darkness].iou, nan=-1.0))
    return best, scores[best]


BASELINES: Mapping[str, Filter] = {
    "dilation 2 px": partial(dilation, side=2),
    "dilation 4 px": partial(dilation, side=4),
    "opening 4 px": opening,
    "adaptive opening": adaptive_opening,
    "run length": run_length,
}
"""All of them by name, with the thesis's and our usual sizes."""
