"""Detected pixels of one class of cells as step functions of the class's prior (method of the exact sweep).

A cell is a detected wall when l = l_0 + S - lam n l_0 <= t, t = logit(threshold): a linear inequality in the prior log
odds l_0. With k = lam n - 1 it is detected when k l_0 >= S - t:

    k > 0   l_0 at or above (S - t) / k       looked at often: a higher P(empty) makes MORE wall
    k < 0   l_0 at or below (S - t) / k       never looked at: the prior alone decides
    k = 0   S <= t, whatever the prior        looked at once, lam = 1

So one sort of the critical values answers for every prior at once.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.log_odds import TIE

FLAT = 1e-12
"""A |k| below this is 0: the prior has no say."""

NOISE = 1e-12
"""Critical log odds closer than this are one: their sums were taken in another order."""


@dataclass(frozen=True, eq=False)
class Steps:
    """How many true and false wall pixels a class of cells detects, for any prior log odds of the class.

    Parameters
    ----------
    always : (2,) true and false pixels detected whatever the prior
    rising, falling : sorted critical log odds of the cells that are detected at or above it, at or below it
    rising_pixels, falling_pixels : (m + 1, 2) running sums of their true and false pixels, from 0
    breaks : sorted log odds at which a count changes, a tie being exactly on it
    """

    always: NDArray[np.int64]
    rising: NDArray[np.float64]
    rising_pixels: NDArray[np.int64]
    falling: NDArray[np.float64]
    falling_pixels: NDArray[np.int64]
    breaks: NDArray[np.float64]

    @classmethod
    def of_cells(cls, total: NDArray, slope: NDArray, pixels: NDArray, threshold: float) -> Steps:
        """Sort the cells of one class.

        Parameters
        ----------
        total : (N,) S of each cell
        slope : (N,) k = lam n - 1
        pixels : (N, 2) its counted true-wall pixels and counted empty pixels
        threshold : t, log odds
        """
        counted = pixels.any(axis=1)
        total, slope, pixels = total[counted], slope[counted], pixels[counted]
        level = total - (threshold + TIE)  # as `detected_as_wall` decides a tie
        flat = np.abs(slope) < FLAT
        rising, rising_pixels = _running_sums(level, slope, pixels, slope >= FLAT)
        falling, falling_pixels = _running_sums(level, slope, pixels, slope <= -FLAT)
        ties = (total - threshold)[~flat] / slope[~flat]
        return cls(
            always=pixels[flat & (level <= 0)].sum(axis=0),
            rising=rising,
            rising_pixels=rising_pixels,
            falling=falling,
            falling_pixels=falling_pixels,
            breaks=_distinct(ties),
        )

    def counts(self, log_odds: ArrayLike) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """True and false pixels detected when the class has these prior log odds (any shape)."""
        l_0 = np.asarray(log_odds, dtype=np.float64)
        pixels = self.always + self.rising_pixels[np.searchsorted(self.rising, l_0, side="right")]
        pixels = pixels + (self.falling_pixels[-1] - self.falling_pixels[np.searchsorted(self.falling, l_0, side="left")])
        return pixels[..., 0], pixels[..., 1]


def _running_sums(level: NDArray, slope: NDArray, pixels: NDArray, chosen: NDArray) -> tuple[NDArray, NDArray]:
    """The chosen cells' critical values, sorted, and the running sums of their pixels."""
    critical = level[chosen] / slope[chosen]
    order = np.argsort(critical)
    sums = np.zeros((len(order) + 1, 2), dtype=np.int64)
    np.cumsum(pixels[chosen][order], axis=0, out=sums[1:])
    return critical[order], sums


def _distinct(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Sorted values, one of each group that only rounding keeps apart."""
    values = np.sort(values)
    return values[np.diff(values, prepend=-np.inf) > NOISE]
