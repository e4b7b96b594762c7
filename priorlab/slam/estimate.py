"""One pose out of many particles: "the mean of the highest weighted particles" (the last line of algorithm 6.2)."""

from __future__ import annotations

from itertools import product

import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import check_record
from priorlab.slam.kld import number_bins, pose_bins, theta_bin_count
from priorlab.slam.parameters import TUNED, Parameters
from priorlab.slam.particles import Particles


def estimate_pose(particles: Particles, parameters: Parameters = TUNED) -> NDArray[np.float64]:
    """The pose that the particles speak for, from their weights before resampling.

    Parameters
    ----------
    particles : poses and weights
    parameters : `estimate` decides. "cluster": the weighted mean of the heaviest cluster, so that two rooms that look alike do
        not put the robot into the wall between them. "mean": of all particles. "best": the particle of the largest weight

    Returns
    -------
    (3,) x, y, theta; metres

    >>> spread = Particles([[0, 0, 0], [0.2, 0, 0], [9, 0, 0]], np.log([0.3, 0.3, 0.4]))
    >>> estimate_pose(spread).round(3).tolist()                               # the two that stand together weigh more
    [0.1, 0.0, 0.0]
    """
    check_record("particles", particles, Particles)
    check_record("parameters", parameters, Parameters)
    weights = particles.weights
    if parameters.estimate == "best":
        return particles.poses[int(np.argmax(weights))].copy()
    if parameters.estimate == "mean":
        return circular_mean(particles.poses, weights)
    cluster = clusters(particles.poses, parameters)
    heaviest = cluster == np.argmax(np.bincount(cluster, weights))
    return circular_mean(particles.poses[heaviest], weights[heaviest])


def circular_mean(poses: NDArray[np.float64], weights: NDArray[np.float64]) -> NDArray[np.float64]:
    """(3,) weighted mean; of the headings the direction of the mean arrow, so that 179 and -179 degrees make 180, not 0.

    >>> mean = circular_mean(np.radians([[0, 0, 179], [0, 0, -179]]), np.array([0.5, 0.5]))
    >>> abs(np.degrees(mean[2])).round(6).item()
    180.0
    """
    x, y = weights @ poses[:, :2] / weights.sum()
    theta = np.arctan2(weights @ np.sin(poses[:, 2]), weights @ np.cos(poses[:, 2]))
    return np.array([x, y, theta])


def clusters(poses: NDArray[np.float64], parameters: Parameters = TUNED) -> NDArray[np.int64]:
    """(N,) number of every particle's cluster: particles whose KLD bins touch, also across a corner, are one cluster.

    >>> clusters(np.array([[0, 0, 0], [5, 5, 0], [0.6, 0.6, 0], [0, 0, -0.01]])).tolist()
    [0, 1, 0, 0]
    """
    bins, number = number_bins(pose_bins(poses, parameters))
    one, other = _touching(bins, theta_bin_count(parameters))
    label = np.arange(len(bins))
    while not np.array_equal(label[one], label[other]):  # every bin takes the lowest number that it touches, till nothing changes
        lowest = np.minimum(label[one], label[other])
        np.minimum.at(label, one, lowest)
        np.minimum.at(label, other, lowest)
        label = label[label]  # and follows where that number went: long chains join in few rounds
    return np.unique(label, return_inverse=True)[1][number]


def _touching(bins: NDArray[np.int64], n_theta: int) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Pairs of rows of the sorted (K, 3) bins that are neighbours; theta goes round."""
    low, high = bins.min(axis=0) - 1, bins.max(axis=0) + 1
    stride_x, stride_y = (high[1] - low[1] + 1) * n_theta, n_theta

    def key(x: NDArray, y: NDArray, theta: NDArray) -> NDArray[np.int64]:
        return (x - low[0]) * stride_x + (y - low[1]) * stride_y + theta % n_theta

    keys = key(*bins.T)
    wanted = key(*(bins[:, :, None] + _NEIGHBOURS.T).transpose(1, 0, 2))  # (K, 13)
    place = np.searchsorted(keys, wanted).clip(max=len(keys) - 1)
    one, direction = np.nonzero(keys[place] == wanted)
    return one, place[one, direction]


_NEIGHBOURS = np.array([step for step in product((-1, 0, 1), repeat=3) if step > (0, 0, 0)])  # half of the 26: pairs count once
