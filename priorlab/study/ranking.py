"""Does a confidence know where it is wrong? The area under the ROC curve, weighted."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike


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
