"""Precision, recall, F-beta and false positive rate of whole arrays of counts, as `Score` has them for one."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

Measure = Literal["precision", "recall", "f_beta"]


def share(part: NDArray, whole: NDArray | int) -> NDArray[np.float64]:
    """part / whole; nan of nothing."""
    part = np.asarray(part, dtype=np.float64)
    whole = np.broadcast_to(np.asarray(whole, dtype=np.float64), part.shape)
    return np.divide(part, whole, out=np.full(part.shape, np.nan), where=whole > 0)


def f_beta_of(tp: NDArray, fp: NDArray, positives: int, beta: float) -> NDArray[np.float64]:
    """(1 + beta^2) TP / (TP + beta^2 positives + FP), which is eq. 5.1 with FN = positives - TP; 0 of nothing."""
    weight = beta**2
    bottom = np.add(tp, fp, dtype=np.float64)
    bottom += weight * positives
    return np.divide((1 + weight) * np.asarray(tp, dtype=np.float64), bottom, out=np.zeros(bottom.shape), where=bottom > 0)
