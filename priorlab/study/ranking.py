"""Does a confidence know where it is wrong? The area under the ROC curve, weighted."""

from __future__ import annotations

import functools
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.building import Truth


def ranking_auc(confidence: ArrayLike, right: ArrayLike, weight: ArrayLike | None = None) -> float:
    """The chance that something right has a higher confidence than something wrong; ties count half.

    sum over right i, wrong j of w_i w_j ([c_i > c_j] + [c_i = c_j] / 2), divided by the sum of all w_i w_j: 1 ranks perfectly,
    .5 is a coin, 0 is upside down.

    Parameters
    ----------
    confidence : (N,) numbers, higher = surer
    right : (N,) bool, or the share from 0 to 1 that is right of each
    weight : (N,) what each counts, such as its area; 1 when left out

    Returns
    -------
    from 0 to 1; nan when nothing is wrong or nothing is right

    Raises
    ------
    ValueError
        When lengths differ, a share lies outside [0, 1], a weight below 0, or a confidence is no number.

    >>> ranking_auc([0.9, 0.8, 0.3], [True, False, True])
    0.5
    >>> ranking_auc([0.9, 0.8, 0.3], [True, False, True], weight=[3, 1, 1])
    0.75
    """
    confidence = np.atleast_1d(np.asarray(confidence, dtype=np.float64))
    right = np.atleast_1d(np.asarray(right, dtype=np.float64))
    weight = np.ones_like(confidence) if weight is None else np.atleast_1d(np.asarray(weight, dtype=np.float64))
    if not confidence.shape == right.shape == weight.shape or confidence.ndim != 1:
        raise ValueError(
            f"confidence, right and weight must be lists of one length, got {confidence.shape}, {right.shape}, {weight.shape}"
        )
    if not np.isfinite(confidence).all():
        raise ValueError("confidence must hold finite numbers, got some that are not")
    if not ((right >= 0) & (right <= 1)).all():
        raise ValueError(f"right must lie between 0 and 1, got {right.min():g} to {right.max():g}")
    if not (np.isfinite(weight) & (weight >= 0)).all():
        raise ValueError(f"weight must be finite and at least 0, got {weight.min():g}")
    _, level = np.unique(confidence, return_inverse=True)
    rights = np.bincount(level, right * weight)  # per level of confidence, lowest first
    wrongs = np.bincount(level, (1 - right) * weight)
    pairs = rights.sum() * wrongs.sum()
    if not pairs > 0:
        return float("nan")
    wrongs_below = np.cumsum(wrongs) - wrongs
    return float(np.sum(rights * (wrongs_below + wrongs / 2)) / pairs)


@dataclass(frozen=True, eq=False)
class Ranked:
    """Detected pixels by their confidence; several drawings add up.

    Parameters
    ----------
    confidence : (L,) levels
    right, wrong : (L,) how many pixels of each level are true walls and are none
    """

    confidence: NDArray[np.float64]
    right: NDArray[np.int64]
    wrong: NDArray[np.int64]

    @property
    def auc(self) -> float:
        """The chance that a right pixel has a higher confidence than a wrong one: large pieces count for much."""
        count = self.right + self.wrong
        return ranking_auc(self.confidence, self.right / np.maximum(count, 1), count)

    def __add__(self, other: Ranked) -> Ranked:
        return Ranked(
            np.concatenate([self.confidence, other.confidence]),
            np.concatenate([self.right, other.right]),
            np.concatenate([self.wrong, other.wrong]),
        )

    def precision(self, low: float, high: float = np.inf) -> float:
        """Share of right pixels among those with low <= confidence < high; nan of none."""
        among = (self.confidence >= low) & (self.confidence < high)
        right, wrong = int(self.right[among].sum()), int(self.wrong[among].sum())
        return right / (right + wrong) if right + wrong else float("nan")


def rank_pixels(confidence: ArrayLike, detected: ArrayLike, truth: Truth) -> Ranked:
    """Count the detected pixels of a drawing by confidence, without don't-care.

    Parameters
    ----------
    confidence : (height, width) from 0 to 1, of the piece of wall that a pixel belongs to
    detected : (height, width) bool
    """
    confidence, detected = np.asarray(confidence, dtype=np.float64), np.asarray(detected, dtype=bool)
    if not confidence.shape == detected.shape == truth.shape:
        raise ValueError(
            f"confidence and detected must have the truth's shape {truth.shape}, got {confidence.shape}, {detected.shape}"
        )
    counted = detected & ~truth.ignore
    levels, which = np.unique(np.round(confidence[counted], 3), return_inverse=True)
    right = np.bincount(which, truth.walls[counted], minlength=len(levels)).astype(np.int64)
    return Ranked(levels, right, np.bincount(which, minlength=len(levels)) - right)


def ranking_line(ranked: Iterable[Ranked | None], title: str) -> str:
    """One line about a method's confidence over several drawings together; empty when it gives none."""
    some = [one for one in ranked if one is not None]
    if not some:
        return ""
    together = functools.reduce(Ranked.__add__, some)
    parts = [f"Confidence of {title}: AUC {together.auc:.2f}"]
    for what, bounds in (("below 0.5", (-np.inf, 0.5)), ("from 0.5", (0.5, np.inf))):
        right = together.precision(*bounds)
        if np.isfinite(right):
            parts.append(f"of pixels {what} {100 * right:.1f} % are right")
    return ", ".join(parts)
