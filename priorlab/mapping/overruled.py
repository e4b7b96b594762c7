"""Eq. 2.22: a reading that agrees with the prior must still say something, or looking twice makes a free cell a wall."""

from __future__ import annotations

import warnings

import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.grid_map import Prior
from priorlab.core.log_odds import TIE, log_odds


class OverruledSensorWarning(UserWarning):
    """The prior is surer than the sensor: readings that confirm the plan turn the map against it."""


def is_overruled(p_wall: ArrayLike, p_space: ArrayLike, p_free: float, p_occupied: float, lam: float = 1.0) -> NDArray[np.bool_]:
    """True for pairs of EFFECTIVE priors that break eq. 2.22; arrays broadcast. `overruled_readings` says why.

    >>> is_overruled(p_wall=0.18, p_space=[0.81, 0.9], p_free=0.9, p_occupied=0.1).tolist()
    [False, True]
    """
    free, occupied = log_odds([p_free, p_occupied])
    return (lam * log_odds(p_space) >= free - TIE) | (lam * log_odds(p_wall) <= occupied + TIE)


def overruled_readings(prior: Prior, p_free: float, p_occupied: float, lam: float = 1.0) -> str | None:
    """A sentence when the prior breaks eq. 2.22, None when it does not.

    Each further look adds logit(ISM) - lam l_0 to a cell. A free reading of plan space must add something above 0 and a
    wall reading of a plan wall something below 0; for lam = 1 that is p_space < p_free and p_wall > p_occupied (eq. 2.22),
    for lam = 0 it always holds.

    Parameters
    ----------
    prior : its EFFECTIVE values count
    p_free, p_occupied : the inverse sensor model
    lam : weight of the prior in the update, as in `update_map`

    >>> overruled_readings(Prior(0.2, 0.9), p_free=0.9, p_occupied=0.1) is None
    True
    >>> overruled_readings(Prior(0.2, 1.0), p_free=0.8, p_occupied=0.1)
    'the effective p_space 0.9 must lie below the p_free 0.8 of the sensor (eq. 2.22): each free look makes space less free'
    >>> overruled_readings(Prior(0.2, 1.0), p_free=0.7, p_occupied=0.1, lam=0.5).split(":")[0]
    '0.5 times the log odds of the effective p_space 0.9 must lie below those of the p_free 0.7 of the sensor (eq. 2.22)'
    """
    if not is_overruled(prior.effective_p_wall, prior.effective_p_space, p_free, p_occupied, lam):
        return None
    space, wall = log_odds([prior.effective_p_space, prior.effective_p_wall])
    free, occupied = log_odds([p_free, p_occupied])
    faults, what_counts, those = [], "the effective", ""
    if lam != 1:  # the sensor's own number is the limit for lam = 1 alone
        what_counts, those = f"{lam:g} times the log odds of the effective", "those of "
    if lam * space >= free - TIE:
        what = "says nothing" if lam * space <= free + TIE else "makes space less free"
        faults.append(
            f"{what_counts} p_space {prior.effective_p_space:.3g} must lie below {those}the p_free {p_free:g} of the sensor "
            f"(eq. 2.22): each free look {what}"
        )
    if lam * wall <= occupied + TIE:
        what = "says nothing" if lam * wall >= occupied - TIE else "makes walls less of a wall"
        faults.append(
            f"{what_counts} p_wall {prior.effective_p_wall:.3g} must lie above {those}the p_occupied {p_occupied:g} of the "
            f"sensor (eq. 2.22): each wall look {what}"
        )
    return "; ".join(faults)


def warn_when_overruled(prior: Prior | None, p_free: float, p_occupied: float, lam: float, stacklevel: int = 3) -> None:
    """Warn, in one sentence with the numbers, when prior and sensor meet and the prior breaks eq. 2.22."""
    sentence = prior and overruled_readings(prior, p_free, p_occupied, lam)
    if sentence:
        warnings.warn(sentence, OverruledSensorWarning, stacklevel=stacklevel)
