"""The mean over seeds and how well it is known: a 95 % interval, with each seed's value beside it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

T_95 = (12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.160, 2.145, 2.131)
"""Student's t, two-sided 95 %, for 1 to 15 degrees of freedom."""


@dataclass(frozen=True)
class Confidence:
    """Mean of some runs with the interval mean +- t s / sqrt(n), in which the true mean lies in 95 of 100 cases.

    Parameters
    ----------
    mean, low, high : of the interval
    values : each seed's

    >>> Confidence.of([0.1, 0.2, 0.3, 0.4, 0.5])
    0.30 (0.10 to 0.50)
    """

    mean: float
    low: float
    high: float
    values: tuple[float, ...]

    @classmethod
    def of(cls, values: Iterable[float]) -> Confidence:
        """Of 2 to 16 finite values, normal about their mean."""
        own = tuple(float(value) for value in values)
        if not 2 <= len(own) <= len(T_95) + 1 or not np.isfinite(own).all():
            raise ValueError(f"values must be 2 to {len(T_95) + 1} finite numbers, got {list(own)}")
        mean, half = float(np.mean(own)), T_95[len(own) - 2] * float(np.std(own, ddof=1)) / len(own) ** 0.5
        return cls(mean, mean - half, mean + half, own)

    @property
    def row(self) -> tuple[float, float, float]:
        """Mean, low, high: what the plots take."""
        return self.mean, self.low, self.high

    def as_numbers(self) -> dict[str, Any]:
        """Plain data."""
        return {"mean": self.mean, "interval_95": [self.low, self.high], "by_seed": list(self.values)}

    def told(self, digits: int = 2, unit: str = "") -> str:
        """In words.

        >>> Confidence.of([40, 50, 60]).told(0, " %")
        '50 % (25 to 75)'
        """
        return f"{self.mean:.{digits}f}{unit} ({self.low:.{digits}f} to {self.high:.{digits}f})"

    def __repr__(self) -> str:
        return self.told()
