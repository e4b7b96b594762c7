"""Log odds, natural and in float64 (thesis 2.3.4, eq. 2.16, 4.12 and 4.21).

A probability is always P(the cell is EMPTY), so log odds above 0 say "empty" and below 0 say "wall" (eq. 2.17).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.checks import as_float, as_numbers

DETECTED_WALL = 0.2
"""A cell counts as a detected wall when P(empty) is at most this (eq. 4.18; chapter 6 scores at 0.5)."""

OCCUPIED_IN_FIELD = 0.35
"""A cell is an obstacle for the likelihood field when P(empty) is below this (algorithm 6.4)."""

TIE = 1e-9
"""Log odds this close to a threshold count as lying on it: sums of floats never decide a tie."""


def log_odds(p: ArrayLike) -> NDArray[np.float64]:
    """l(p) = ln(p / (1 - p)), eq. 2.16.

    Parameters
    ----------
    p : array_like
        Probabilities in (0, 1), any shape.

    Raises
    ------
    ValueError
        When a probability is 0, 1, outside or NaN: its log odds would be infinite.

    >>> log_odds(0.5).item()
    0.0
    >>> round(log_odds(0.9).item(), 4)
    2.1972
    """
    p = as_numbers("p", p)
    inside = (p > 0.0) & (p < 1.0)
    if not inside.all():
        raise ValueError(f"a probability must lie strictly between 0 and 1, got {p[~inside].flat[0]:g}")
    return np.log(p / (1.0 - p))


def probability(log_odds: ArrayLike) -> NDArray[np.float64]:
    """p = 1 - 1 / (1 + exp(l)), eq. 4.21, computed without overflow.

    >>> probability(0.0).item()
    0.5
    >>> round(probability(log_odds(0.2)).item(), 12)
    0.2
    """
    return 0.5 * (1.0 + np.tanh(0.5 * as_numbers("log_odds", log_odds)))


def detection_limit(threshold: float = DETECTED_WALL) -> float:
    """The highest log odds that count as a detected wall: l <= logit(threshold) + 1e-9, and always below 0.

    A cell on the threshold is detected (eq. 4.18), but a cell at 0.5 knows nothing and never is: at the threshold 0.5 of
    chapter 6 the unseen cells of an uninformed map are no walls.

    Raises
    ------
    ValueError
        When the threshold does not lie in (0, 0.5].

    >>> detection_limit(0.5) < 0
    True
    """
    threshold = as_float("threshold", threshold)
    if not 0.0 < threshold <= 0.5:
        raise ValueError(f"threshold must lie above 0 and be at most 0.5, got {threshold:g}")
    return min(float(log_odds(threshold)) + TIE, -TIE)


def detected_as_wall(log_odds_map: ArrayLike, threshold: float = DETECTED_WALL) -> NDArray[np.bool_]:
    """True where P(empty) <= `threshold`; a cell on the threshold is detected, a cell at 0.5 never (`detection_limit`).

    >>> detected_as_wall(log_odds([0.1, 0.2, 0.21])).tolist()
    [True, True, False]
    >>> detected_as_wall(log_odds([0.499, 0.5]), threshold=0.5).tolist()
    [True, False]
    """
    return np.asarray(log_odds_map) <= detection_limit(threshold)
