"""Drawing particles with a probability proportional to their weight (the second loop of algorithm 6.2).

All three draw numbers in [0, 1) and look up in whose share of the summed weights each lies. They differ in the numbers:
independent ones (multinomial), one in each of n equal intervals (stratified), one offset for all intervals (systematic).
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.checks import as_numbers, check_choice, check_rng, check_whole
from priorlab.slam.parameters import METHODS, MOST_PARTICLES


def resample(
    weights: ArrayLike,
    n_draws: int,
    rng: np.random.Generator,
    method: Literal["systematic", "stratified", "multinomial"] = "systematic",
) -> NDArray[np.int64]:
    """Indices of the particles that go on; one of weight w appears n_draws * w times on average.

    Parameters
    ----------
    weights : (N,) not negative, with the sum 1
    n_draws : how many particles go on; need not be N
    rng : draws 1, n_draws or n_draws numbers
    method : "systematic" repeats every particle floor or ceil of n_draws * w times, the least noise; "stratified" comes close;
        "multinomial" draws independently

    Returns
    -------
    (n_draws,) indices; not falling, except for "multinomial"

    Raises
    ------
    ValueError
        When a weight is negative or nan, when they do not sum to 1, or when n_draws is no whole number of at least 1.

    >>> resample([0.5, 0.0, 0.25, 0.25], 4, np.random.default_rng(0)).tolist()
    [0, 0, 2, 3]
    """
    weights, rng = as_numbers("weights", weights), check_rng(rng)
    check_choice("resampling", method, METHODS)
    if weights.ndim != 1 or len(weights) == 0:
        raise ValueError(f"weights must be a list of at least one number, got shape {weights.shape}")
    if not (weights >= 0).all():
        raise ValueError(f"weights must not be negative or nan, got {weights[~(weights >= 0)][0]:g}")
    if not abs(weights.sum() - 1.0) <= 1e-9:
        raise ValueError(f"weights must sum to 1, got {weights.sum():.6g}")
    n_draws = check_whole("n_draws", n_draws, most=MOST_PARTICLES)
    if method == "systematic":
        positions = (np.arange(n_draws) + rng.random()) / n_draws
    elif method == "stratified":
        positions = (np.arange(n_draws) + rng.random(n_draws)) / n_draws
    else:
        positions = rng.random(n_draws)
    shares = np.cumsum(weights)
    last = np.flatnonzero(weights)[-1]  # rounding may leave the sum a hair below 1: the rest belongs to the last with weight
    return np.minimum(np.searchsorted(shares, positions, side="right"), last)
