"""Between the cells: a paraboloid through the scores round a pose gives the peak and how sharp it is."""

from __future__ import annotations

from itertools import product

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.core.pose import wrap_angle
from priorlab.slam.likelihood_field import LikelihoodField

_ROUNDS = 3  # each with half the spacing of the one before: to a quarter of a cell, which a parabola divides once more

_AROUND = np.array(list(product((-1.0, 0.0, 1.0), repeat=3)))  # (27, 3)
_MIDDLE = 13
_PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
_TERMS = np.column_stack([np.ones(27), _AROUND, *(_AROUND[:, i] * _AROUND[:, j] for i, j in _PAIRS)])
_FIT = np.linalg.pinv(_TERMS)  # (10, 27): scores to the coefficients of the paraboloid, by least squares


def climb(
    pose: NDArray[np.float64],
    points: NDArray[np.float64],
    field: LikelihoodField,
    guess: NDArray[np.float64],
    spread: NDArray[np.float64],
    spacing: NDArray[np.float64],
) -> NDArray[np.float64]:
    """From the best cell to the peak of scan and guess together; never more than a spacing a round, never below the start.

    The paraboloid sees the slopes of 27 poses at once, so a round may well lead down; of all poses on the way the best is taken.

    Parameters
    ----------
    pose : (3,) where the search ended
    points : (B, 2) ends of the beams in the robot's frame, metres
    field : of the map
    guess, spread : (3,) the Gaussian of the pose before the scan
    spacing : (3,) steps of the search in x, y, theta
    """

    def score(poses: NDArray[np.float64]) -> NDArray[np.float64]:
        away = poses - guess
        away[:, 2] = wrap_angle(away[:, 2])
        return smooth_log_likelihoods(poses, points, field) - 0.5 * np.square(away / spread).sum(axis=1)

    best, highest = pose, -np.inf
    for _ in range(_ROUNDS):
        scores = score(pose + _AROUND * spacing)
        if scores[_MIDDLE] > highest:
            best, highest = pose, float(scores[_MIDDLE])
        gradient, hessian = fit_peak(scores)
        bends, axes = np.linalg.eigh(hessian)
        slopes = gradient @ axes
        peaks = np.divide(-slopes, bends, out=np.zeros(3), where=bends < 0)  # where it bends upwards there is no peak: stay
        pose = pose + np.clip(axes @ peaks, -1, 1) * spacing
        spacing = spacing / 2
    if score(pose[None])[0] > highest:
        best = pose
    return np.array([*best[:2], wrap_angle(best[2])])


def information(
    pose: NDArray[np.float64], points: NDArray[np.float64], field: LikelihoodField, spacing: NDArray[np.float64]
) -> NDArray[np.float64]:
    """(3, 3) what the scan alone tells of x, y, theta: minus the curvature of its score; 0 along a ridge, never negative."""
    _, hessian = fit_peak(smooth_log_likelihoods(pose + _AROUND * spacing, points, field))
    values, vectors = np.linalg.eigh(-hessian)
    return (vectors * np.maximum(values, 0.0)) @ vectors.T / np.outer(spacing, spacing)


def fit_peak(scores: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Gradient (3,) and Hessian (3, 3) in the middle of a paraboloid through 3 x 3 x 3 scores, in units of their spacing.

    >>> gradient, hessian = fit_peak(-((_AROUND - [0.5, 0, 0]) ** 2).sum(axis=1))
    >>> np.allclose(gradient, [1, 0, 0]), np.allclose(hessian, -2 * np.eye(3))
    (True, True)
    """
    terms = (_FIT @ scores)[1:]
    hessian = np.zeros((3, 3))
    for (i, j), value in zip(_PAIRS, terms[3:], strict=True):
        hessian[i, j] += value
        hessian[j, i] += value
    return terms[:3], hessian


def smooth_log_likelihoods(
    poses: NDArray[np.float64], points: NDArray[np.float64], field: LikelihoodField
) -> NDArray[np.float64]:
    """(N,) temper * sum of the beams' log likelihoods at (N, 3) poses, linear between the centres of the cells."""
    (per_metre, _, col_1), (_, _, row_1) = field.grid.metres_to_cells
    cos, sin = np.cos(poses[:, 2:]), np.sin(poses[:, 2:])
    cols = per_metre * (poses[:, :1] + points[:, 0] * cos - points[:, 1] * sin) + col_1
    rows = -per_metre * (poses[:, 1:2] + points[:, 0] * sin + points[:, 1] * cos) + row_1
    fits = cv2.remap(
        field.image,
        cols.astype(np.float32),
        rows.astype(np.float32),
        cv2.INTER_LINEAR,
        borderMode=cv2.BORDER_CONSTANT,
        borderValue=field.far,
    )
    return field.parameters.temper * fits.sum(axis=1, dtype=np.float64)
