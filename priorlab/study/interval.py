"""The mean over seeds and how far they lie apart."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Interval:
    """Mean, lowest and highest of some runs; nan when one of them has no value.

    >>> Interval.of([0.2, 0.4, 0.3])
    Interval(0.30, 0.20 to 0.40)
    """

    mean: float
    low: float
    high: float

    @classmethod
    def of(cls, values: Iterable[float]) -> Interval:
        """Of at least one value."""
        numbers = np.array(list(values), dtype=np.float64)
        if not numbers.size:
            raise ValueError("values must hold at least one number, got none")
        return cls(float(numbers.mean()), float(numbers.min()), float(numbers.max()))

    def __repr__(self) -> str:
        return f"Interval({self.mean:.2f}, {self.low:.2f} to {self.high:.2f})"
