"""How many particles are enough: KLD sampling (Fox 2003), which the toolbox of 6.2.2 uses; Table 6.1 prints the limits.

Space is cut into bins. With n particles in k bins the Kullback-Leibler distance to the true belief stays below epsilon, with
the probability of the normal quantile z, when

    n >= (k - 1) / (2 epsilon) * (1 - 2 / (9 (k - 1)) + sqrt(2 / (9 (k - 1))) z)^3.

A belief that is spread over many bins needs many particles, one in a heap needs few.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from priorlab.slam.parameters import TUNED, Parameters

_FARTHEST_BIN = 2**27  # particles this far out share a bin: x, y and theta together must fit into 64 bits


def kld_bound(n_bins: int | NDArray[np.int64], parameters: Parameters = TUNED) -> NDArray[np.float64]:
    """Particles that k bins ask for, before the limits (Fox 2003); one bin asks for none.

    >>> kld_bound(np.array([1, 2, 10])).round().tolist()
    [0.0, 329.0, 1085.0]
    """
    below = np.asarray(n_bins, dtype=np.float64) - 1.0
    part = 2.0 / (9.0 * np.maximum(below, 1.0))
    return below / (2 * parameters.kld_epsilon) * (1 - part + np.sqrt(part) * parameters.kld_quantile) ** 3


def pose_bins(poses: NDArray[np.float64], parameters: Parameters = TUNED) -> NDArray[np.int64]:
    """(N, 3) whole numbers: the bin of every pose. Headings go round: the last bin of theta is beside the first.

    >>> pose_bins(np.array([[0.6, -0.1, np.radians(-5)]])).tolist()
    [[1, -1, 35]]
    """
    xy = np.floor(poses[:, :2] / parameters.kld_bin_m).clip(-_FARTHEST_BIN, _FARTHEST_BIN).astype(np.int64)
    n_theta = theta_bin_count(parameters)
    theta = np.floor((poses[:, 2] % (2 * np.pi)) * (n_theta / (2 * np.pi))).astype(np.int64) % n_theta
    return np.column_stack([xy, theta])


def theta_bin_count(parameters: Parameters = TUNED) -> int:
    """How many bins of theta make the full circle; 36 of 10 degrees."""
    return max(1, math.ceil(2 * math.pi / parameters.kld_bin_theta - 1e-9))


def number_bins(bins: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """(K, 3) the different bins in rising order, and (N,) which of them each row is.

    >>> different, number = number_bins(np.array([[7, 0, 3], [5, 9, 0], [7, 0, 3]]))
    >>> different.tolist(), number.tolist()
    ([[5, 9, 0], [7, 0, 3]], [1, 0, 1])
    """
    x, y, theta = (column - column.min() for column in bins.T)
    keys = (x * (y.max() + 1) + y) * (theta.max() + 1) + theta  # one whole number per bin: sorting rows is slow
    _, first, number = np.unique(keys, return_index=True, return_inverse=True)
    return bins[first], number


def kld_count(drawn: NDArray[np.int64], parameters: Parameters = TUNED) -> int:
    """How many particles to go on with, by Fox's rule: draw until the draws are as many as the bins that they fell in ask for.

    Parameters
    ----------
    drawn : (M,) number of the bin of particles that were drawn independently by weight, in the order of drawing; M is the most
        that may go on
    parameters : limits, epsilon and quantile

    Returns
    -------
    n between the limits of `parameters.particle_limits`
    """
    fewest, most = parameters.particle_limits
    first_seen = np.full(int(drawn.max()) + 1, len(drawn))
    np.minimum.at(first_seen, drawn, np.arange(len(drawn)))
    is_new = np.bincount(first_seen, minlength=len(drawn) + 1)[: len(drawn)]
    enough = np.arange(1, len(drawn) + 1) >= np.maximum(kld_bound(np.cumsum(is_new), parameters), fewest)
    return int(np.argmax(enough)) + 1 if enough.any() else most
