"""The score: every pixel is classified as wall or empty (thesis 3.3.2, 4.3.2 and eq. 5.1)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from priorlab.core.building import Truth
from priorlab.core.checks import check_choice, check_positive, check_record
from priorlab.core.drawing import Walls
from priorlab.core.grid_map import GridMap
from priorlab.core.log_odds import DETECTED_WALL

WindowsAre = Literal["wall", "empty", "ignore"]
"""What the person who marked the walls took windows for."""


@dataclass(frozen=True)
class Score:
    """Counts of pixels and the measures made of them; don't-care pixels are in none.

    Parameters
    ----------
    tp, fp, fn, tn : true wall detected, empty detected as wall, true wall missed, empty left empty
    beta : weight of recall in F-beta; the thesis takes 2
    threshold : P(empty) at or below which a cell counted as wall; None for a mask

    >>> Score(tp=8, fp=2, fn=8, tn=82)
    Score(precision 0.800, recall 0.500, F2 0.541, false positive rate 0.024)
    """

    tp: int
    fp: int
    fn: int
    tn: int
    beta: float = 2.0
    threshold: float | None = None

    @property
    def precision(self) -> float:
        """TP / (TP + FP); nan when nothing was detected."""
        return _ratio(self.tp, self.tp + self.fp)

    @property
    def recall(self) -> float:
        """TP / (TP + FN); nan when there is no wall."""
        return _ratio(self.tp, self.tp + self.fn)

    @property
    def false_positive_rate(self) -> float:
        """FP / (FP + TN); nan when everything is wall."""
        return _ratio(self.fp, self.fp + self.tn)

    @property
    def iou(self) -> float:
        """Intersection over union, TP / (TP + FP + FN)."""
        return _ratio(self.tp, self.tp + self.fp + self.fn)

    @property
    def f_beta(self) -> float:
        """(1 + beta^2) precision recall / (beta^2 precision + recall), eq. 5.1; 0 when nothing was detected rightly."""
        weight = self.beta**2
        bottom = (1 + weight) * self.tp + weight * self.fn + self.fp
        return (1 + weight) * self.tp / bottom if bottom else 0.0

    def __repr__(self) -> str:
        at = "" if self.threshold is None else f" at P(empty) {'<' if self.threshold == 0.5 else '<='} {self.threshold:g}"
        return (
            f"Score(precision {self.precision:.3f}, recall {self.recall:.3f}, F{self.beta:g} {self.f_beta:.3f}, "
            f"false positive rate {self.false_positive_rate:.3f}{at})"
        )


def score_mask(detected: ArrayLike, truth: Truth, beta: float = 2.0, threshold: float | None = None) -> Score:
    """Count a (height, width) mask of detected walls against the truth, pixel by pixel, without its don't-care pixels."""
    check_record("truth", truth, Truth)
    detected = np.asarray(detected, dtype=bool)
    if detected.shape != truth.shape:
        raise ValueError(f"map and truth must have one shape, got {detected.shape} and {truth.shape}")
    check_positive("beta", beta)
    counted = ~truth.ignore
    n_counted = int(np.count_nonzero(counted))
    detected_counted = detected & counted
    tp = int(np.count_nonzero(detected_counted & truth.walls))
    positive = int(np.count_nonzero(truth.walls & counted))
    fp = int(np.count_nonzero(detected_counted)) - tp
    return Score(tp=tp, fp=fp, fn=positive - tp, tn=n_counted - positive - fp, beta=beta, threshold=threshold)


def score_walls(walls: Walls, truth: Truth, beta: float = 2.0, windows: WindowsAre = "wall") -> Score:
    """How well walls were extracted from a drawing (thesis 3.3.2).

    Parameters
    ----------
    walls : what was found
    truth : what is there
    beta : weight of recall in F-beta
    windows : whoever marked the truth took windows for "wall", as our own truths do, or "empty"; "ignore" counts none of them

    Raises
    ------
    ValueError
        When walls and truth differ in shape, or `windows` is none of the three.
    """
    check_record("walls", walls, Walls)
    check_record("truth", truth, Truth)
    check_choice("windows", windows, get_args(WindowsAre))
    if windows == "wall" or walls.shape != truth.shape:
        return score_mask(walls.mask, truth, beta)
    known = np.zeros(truth.shape, dtype=bool) if truth.windows is None else truth.windows
    if windows == "ignore":
        return score_mask(walls.mask, replace(truth, ignore=truth.ignore | known | walls.windows), beta)
    return score_mask(walls.mask & ~walls.windows, replace(truth, walls=truth.walls & ~known, windows=None), beta)


def score_map(grid_map: GridMap, truth: Truth, threshold: float = DETECTED_WALL, beta: float = 2.0) -> Score:
    """How well a map shows the walls: pixels whose cell has P(empty) <= `threshold` are detected (eq. 4.14-4.18).

    The thesis's chapters 4 and 5 score at 0.2, its chapter 6 at 0.5.

    Raises
    ------
    ValueError
        When the map lies on another drawing than the truth, or the threshold outside (0, 0.5].
    """
    check_record("grid_map", grid_map, GridMap)
    check_record("truth", truth, Truth)
    if grid_map.grid.image_shape != truth.shape:
        raise ValueError(f"map and truth must have one shape, got {grid_map.grid.image_shape} and {truth.shape}")
    return score_mask(grid_map.grid.to_image(grid_map.detected(threshold)), truth, beta, threshold)


def _ratio(part: int, whole: int) -> float:
    """A share, nan of nothing."""
    return part / whole if whole else float("nan")
