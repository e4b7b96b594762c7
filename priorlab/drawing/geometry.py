"""The geometry test: is a triangle isosceles, and shaped like a door (thesis eq. 3.3-3.5)?"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.drawing.method import ROBUST, Method


def side_lengths(triangles: ArrayLike) -> NDArray[np.float64]:
    """AB, BC, CA of triangles.

    Parameters
    ----------
    triangles : (..., 3, 2) vertices A, B, C as x, y

    >>> side_lengths([[0, 0], [3, 0], [3, 4]]).tolist()
    [3.0, 4.0, 5.0]
    """
    vertices = np.asarray(triangles, dtype=np.float64)
    steps = np.roll(vertices, -1, axis=-2) - vertices
    return np.asarray(np.hypot(steps[..., 0], steps[..., 1]))


def angles_deg(sides: ArrayLike) -> NDArray[np.float64]:
    """Angles at A, B, C in degrees, from sides AB, BC, CA by the law of cosines.

    >>> angles_deg([3, 4, 5]).round(1).tolist()
    [53.1, 90.0, 36.9]
    """
    ab, bc, ca = np.moveaxis(np.asarray(sides, dtype=np.float64), -1, 0)
    with np.errstate(divide="ignore", invalid="ignore"):
        cosines = [
            (ab**2 + ca**2 - bc**2) / (2 * ab * ca),
            (ab**2 + bc**2 - ca**2) / (2 * ab * bc),
            (bc**2 + ca**2 - ab**2) / (2 * bc * ca),
        ]
    return np.asarray(np.degrees(np.arccos(np.clip(np.nan_to_num(np.stack(cosines, axis=-1), nan=1.0), -1, 1))))


def nearest_to_equal(sides: ArrayLike, rounding: bool = True) -> NDArray[np.float64]:
    """Shorter over longer of the two sides that are most alike; 1 where two are equal in whole pixels (eq. 3.4).

    >>> nearest_to_equal([[10.2, 10.4, 3], [10, 8, 6]]).tolist()
    [1.0, 0.8]
    """
    lengths = np.asarray(sides, dtype=np.float64)
    other = np.roll(lengths, -1, axis=-1)
    ratio = np.minimum(lengths, other) / np.maximum(np.maximum(lengths, other), 1e-12)
    if rounding:
        ratio = np.where(np.ceil(lengths) == np.ceil(other), 1.0, ratio)  # eq. 3.4
    return np.asarray(ratio.max(axis=-1))


def equal_sides(sides: ArrayLike, ratio: float = 0.9, rounding: bool = True) -> NDArray[np.bool_]:
    """True where at least two sides are about equal (eq. 3.3).

    Equal in whole pixels (eq. 3.4), or min/max above `ratio` for at least one pair (eq. 3.5; as printed it holds a ratio
    and its inverse, so that it would always be true).

    >>> equal_sides([[10.2, 10.4, 3], [10, 9.2, 3], [10, 8, 6]], rounding=False).tolist()
    [True, True, False]
    """
    return np.asarray(nearest_to_equal(sides, rounding) > ratio)  # eq. 3.5


def passes_geometry(triangles: ArrayLike, method: Method = ROBUST) -> NDArray[np.bool_]:
    """True where a triangle may be a door: two sides about equal, its largest angle bounded, no needle.

    Parameters
    ----------
    triangles : (..., 3, 2) vertices as x, y

    >>> passes_geometry([[0, 0], [40, 0], [0, 40]])
    array(True)
    >>> passes_geometry([[0, 0], [40, 0], [80, 1]])
    array(False)
    """
    sides = side_lengths(triangles)
    angles = angles_deg(sides)
    largest = angles.max(axis=-1)
    shaped = (largest >= method.min_largest_angle - 1e-9) & (largest <= method.max_largest_angle)
    shaped &= (angles.min(axis=-1) >= method.min_angle) & (sides.min(axis=-1) > 0)
    return np.asarray(shaped & equal_sides(sides, method.isosceles_ratio, method.rounding))


def tilts(starts: ArrayLike, ends: ArrayLike) -> NDArray[np.float64]:
    """Angles between the lines from starts to ends and the nearer axis, degrees.

    >>> tilts([[0, 0], [0, 0]], [[10, 0], [10, 10]]).round(1).tolist()
    [0.0, 45.0]
    """
    across = np.abs(np.asarray(ends, dtype=np.float64) - np.asarray(starts, dtype=np.float64))
    return np.asarray(np.degrees(np.arctan2(across.min(axis=-1), across.max(axis=-1))))
