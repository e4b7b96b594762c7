"""Algorithm 6.4: how well every particle explains a scan."""

from __future__ import annotations

import math

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.slam.likelihood_field import LikelihoodField, log_likelihood_of
from priorlab.slam.parameters import TUNED, Parameters
from priorlab.slam.scan import Scan

EXPLAINED_M = 0.4
"""A beam is explained by an obstacle no farther from its end than this ..."""

EXPLAINED_SIGMAS = 4.0
"""... and than so many sigma_hit: farther away the field cannot tell distances apart."""

FEWEST_TO_JUDGE = 10
"""With fewer beams the share that is explained means nothing."""

_ENDS_AT_ONCE = 80_000  # small enough for one thread: on a busy machine, waiting for a second one took up to 30 ms
_PARTICLES_AT_ONCE = 32_000  # cv2.remap counts in 16 bits


def beam_log_likelihoods(poses: NDArray[np.float64], scan: Scan, field: LikelihoodField) -> NDArray[np.float32]:
    """(N, B) log likelihood of every beam, would the robot stand at each of the (N, 3) `poses`.

    A beam ends at x + x_b cos(theta) - y_b sin(theta), y + y_b cos(theta) + x_b sin(theta), where (x_b, y_b) is its end in the
    robot's frame (the printed y line has a cosine for a sine). In cells, that is one (N, 3) x (3, B) product per axis.
    """
    (col_x, col_y, col_1), (row_x, row_y, row_1) = field.grid.metres_to_cells
    x, y, theta = poses.T
    cos, sin = np.cos(theta), np.sin(theta)
    ends = np.vstack([scan.points.T, np.ones(len(scan))]).astype(np.float32)  # (3, B)
    cols = np.column_stack([col_x * cos + col_y * sin, col_y * cos - col_x * sin, col_x * x + col_y * y + col_1])
    rows = np.column_stack([row_x * cos + row_y * sin, row_y * cos - row_x * sin, row_x * x + row_y * y + row_1])
    fits = cv2.remap(
        field.image,
        cols.astype(np.float32) @ ends,
        rows.astype(np.float32) @ ends,
        cv2.INTER_NEAREST,
        borderMode=cv2.BORDER_CONSTANT,
        borderValue=field.far,
    )
    return np.asarray(fits, dtype=np.float32)


def log_weights(poses: NDArray[np.float64], scan: Scan, field: LikelihoodField) -> NDArray[np.float64]:
    """Log of the weight of every pose: `scan_exponent` times the sum over the beams of the logarithms of algorithm 6.4.

    The product q of 60 factors becomes a sum of logarithms, which cannot underflow. An end off the map counts as far from
    every obstacle, so particles that all left the map get equal weights. A scan without a return says nothing: zeros.

    Parameters
    ----------
    poses : (N, 3) particles x, y, theta; metres
    scan : the beams that returned
    field : of the map, with the parameters

    Returns
    -------
    (N,) finite numbers
    """
    if len(scan) == 0:
        return np.zeros(len(poses))
    size = max(1, min(_PARTICLES_AT_ONCE, _ENDS_AT_ONCE // len(scan)))
    chunks = [poses[start : start + size] for start in range(0, len(poses), size)]
    sums = [beam_log_likelihoods(chunk, scan, field).sum(axis=1, dtype=np.float64) for chunk in chunks]
    return scan_exponent(len(scan), field.parameters) * np.concatenate(sums)


def scan_exponent(n_returned: int, parameters: Parameters = TUNED) -> float:
    """The exponent of the likelihood of a scan with that many beams: temper * sqrt(n_beams / n_returned), at most 1.

    A full scan has `temper`. One of fewer beams says less, but not in proportion: beams side by side repeat one another, and what
    n readings say grows as the root of n. With temper = 1 every beam counts in full, as printed.

    >>> [round(scan_exponent(n), 3) for n in (60, 15)]
    [0.05, 0.1]
    """
    return min(1.0, parameters.temper * math.sqrt(parameters.n_beams / n_returned))


def share_explained(
    pose: NDArray[np.float64], scan: Scan, field: LikelihoodField, within_sigmas: float = EXPLAINED_SIGMAS
) -> float:
    """Share of a scan's beams that end near an obstacle, seen from one pose; nan for fewer than ten beams.

    Near is within `within_sigmas` times sigma_hit, at most 0.4 m.
    """
    if len(scan) < FEWEST_TO_JUDGE:
        return float("nan")
    near_m = min(EXPLAINED_M, within_sigmas * field.parameters.sigma_hit_m)
    close = log_likelihood_of(np.array(near_m), field.parameters)
    return float((beam_log_likelihoods(pose[None], scan, field) >= close).mean())
