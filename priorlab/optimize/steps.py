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

from priorlab.core.log_odds import detection_limit
from priorlab.core.log_odds import log_odds as logit

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
    rising, falling : sorted critical log odds, each once, of the cells that are detected at or above it, at or below it
    rising_pixels, falling_pixels : (2, m + 1) running sums of their true and false pixels, from 0
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
        pixels : (2, N) its counted true-wall pixels and counted empty pixels
        threshold : P(empty) at or below which a cell is a detected wall; t = logit(threshold)
        """
        limit = detection_limit(threshold)  # as `detected_as_wall` decides a tie
        nominal = float(logit(threshold))
        always = np.flatnonzero((np.abs(slope) < FLAT) & (total <= limit))
        rising, rising_pixels, up = _running_sums(total, slope, pixels, slope >= FLAT, limit, nominal)
        falling, falling_pixels, down = _running_sums(total, slope, pixels, slope <= -FLAT, limit, nominal)
        return cls(
            always=pixels[:, always].sum(axis=1, dtype=np.int64),
            rising=rising,
            rising_pixels=rising_pixels,
            falling=falling,
            falling_pixels=falling_pixels,
            breaks=_distinct(np.concatenate([up, down])),
        )

    def counts(self, log_odds: ArrayLike) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """True and false pixels detected when the class has these prior log odds (any shape)."""
        l_0 = np.asarray(log_odds, dtype=np.float64)
        risen = np.searchsorted(self.rising, l_0, side="right")
        fallen = np.searchsorted(self.falling, l_0, side="left")
        (tp, fp), (tp_up, fp_up), (tp_down, fp_down) = self.always, self.rising_pixels, self.falling_pixels
        return tp + tp_up[risen] + tp_down[-1] - tp_down[fallen], fp + fp_up[risen] + fp_down[-1] - fp_down[fallen]


def _running_sums(
    total: NDArray, slope: NDArray, pixels: NDArray, bent: NDArray[np.bool_], limit: float, nominal: float
) -> tuple[NDArray, NDArray, NDArray]:
    """Some cells' critical values, sorted and each once, the running sums of their pixels, and where they nominally flip."""
    chosen = np.flatnonzero(bent)
    critical = (total[chosen] - limit) / slope[chosen]
    order = np.argsort(critical)
    critical, chosen = critical[order], chosen[order]
    ends = np.flatnonzero(np.diff(critical, append=np.inf) != 0)  # cells that flip together, as most do, are one step
    sums = np.zeros((2, len(ends) + 1), dtype=np.int64)
    for kind, of_kind in enumerate(pixels):
        sums[kind, 1:] = np.cumsum(of_kind[chosen], dtype=np.int64)[ends]
    breaks = (total[chosen] - nominal) / slope[chosen]
    return critical[ends], sums, breaks[np.diff(breaks, prepend=np.inf) != 0]


def _distinct(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Sorted values, one of each group that only rounding keeps apart."""
    values = np.sort(values)
    return values[np.diff(values, prepend=-np.inf) > NOISE]
