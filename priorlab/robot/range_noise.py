"""What is wrong with measured ranges: noise, outliers, lost returns, a blind zone (thesis 5.3)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import check_not_negative, check_positive, check_record, check_rng, check_share


@dataclass(frozen=True)
class RangeNoise:
    """The faults of a range sensor; the defaults are none.

    Parameters
    ----------
    deviation : standard deviation of a range, in the unit of the ranges
    outlier_rate : share of readings that are anything between `min_range` and the end of the range
    dropout_rate : share of readings that are missing
    min_range : nearer obstacles give no reading (the blind zone)
    """

    deviation: float = 0.0
    outlier_rate: float = 0.0
    dropout_rate: float = 0.0
    min_range: float = 0.0

    def __post_init__(self) -> None:
        for name in ("deviation", "min_range"):
            check_not_negative(name, getattr(self, name))
        for name in ("outlier_rate", "dropout_rate"):
            check_share(name, getattr(self, name))


def disturb(
    ranges: NDArray[np.float64], noise: RangeNoise, max_range: float, rng: np.random.Generator | None
) -> NDArray[np.float64]:
    """Ranges as a faulty sensor reports them; inf = no return, nan = no reading.

    The same number of draws is taken whatever the ranges and the rates are, so that one fault can be changed
    and the others stay as they were.

    Parameters
    ----------
    ranges : any shape, true distances; inf where nothing stands
    noise : the faults
    max_range : what is measured beyond it is no return
    rng : draws the faults

    >>> rng = np.random.default_rng(0)
    >>> disturb(np.array([0.2, 1.0, 5.0]), RangeNoise(min_range=0.4), 3.0, rng).tolist()
    [nan, 1.0, inf]
    """
    rng = check_rng(rng)
    check_record("noise", noise, RangeNoise)
    check_positive("max_range", max_range)
    spread, random_range, is_outlier, is_lost = (
        rng.standard_normal(ranges.shape),
        rng.random(ranges.shape),
        rng.random(ranges.shape) < noise.outlier_rate,
        rng.random(ranges.shape) < noise.dropout_rate,
    )
    measured = ranges + noise.deviation * spread
    measured = np.where(is_outlier, noise.min_range + (max_range - noise.min_range) * random_range, measured)
    measured = measured.clip(0.0)
    measured = np.where(measured < noise.min_range, np.nan, np.where(measured > max_range, np.inf, measured))
    return np.where(is_lost, np.nan, measured)
