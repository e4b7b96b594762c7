"""Leaves on their own: doors without an arc, and doors whose arc a scan has broken (beyond the thesis's wedges).

A wedge needs two connected sides. Here one is enough: a straight leaf from hinge to tip. Any corner that is about as far from
the hinge as the tip may be the strike; the tests that follow ask for walls at both jambs and for a white opening.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from priorlab.drawing.symbol import look_up, points_between

LEAST_ANGLE, LARGEST_ANGLE = 35.0, 105.0
"""How far a door is drawn open, degrees."""


def straight_pairs(
    ink: NDArray[np.bool_], points: NDArray[np.float64], walked: NDArray[np.bool_], shortest: float, longest: float, least: float
) -> NDArray[np.bool_]:
    """(N, N) symmetric bool: connected corners with a straight line of ink between them, as leaves are drawn.

    Parameters
    ----------
    ink : (height, width) bool, widened a little
    points : (N, 2) x, y
    walked : (N, N) symmetric bool, corners that a walk connects
    shortest, longest : lengths that are looked at, pixels
    least : share of ink along the line
    """
    start, end = np.nonzero(np.triu(walked))
    length = np.hypot(*(points[start] - points[end]).T)
    fits = (length >= shortest) & (length <= longest)
    start, end = start[fits], end[fits]
    joined = np.zeros_like(walked)
    joined[start, end] = look_up(ink, points_between(points[start], points[end])).mean(axis=1) >= least
    return joined | joined.T


def leaf_candidates(
    straight: NDArray[np.bool_], walked: NDArray[np.bool_], points: NDArray[np.float64], ratio: float
) -> NDArray[np.int32]:
    """Tips and the two ends of the open side, of leaves with one side drawn: (K, 3).

    Parameters
    ----------
    straight : (N, N) bool, corners joined by a straight line of ink, as `straight_pairs` finds them
    walked : (N, N) bool, corners that a walk connects; two such sides are a wedge, which is none of these
    points : (N, 2) x, y
    ratio : leaf and open side are equal above this ratio

    >>> points = np.array([(0.0, 0.0), (40.0, 0.0), (0.0, 40.0)])
    >>> line = np.zeros((3, 3), dtype=bool); line[0, 2] = line[2, 0] = True
    >>> sorted(leaf_candidates(line, line, points, 0.9).tolist())
    [[2, 0, 1]]
    """
    found = [np.empty((0, 3), dtype=np.int32)]
    for hinge in range(len(points)):
        tips = np.flatnonzero(straight[hinge])
        if not tips.size:
            continue
        away = points - points[hinge]
        length = np.hypot(away[:, 0], away[:, 1])
        in_reach = (length > ratio * length[tips].min()) & (length < length[tips].max() / ratio)
        strikes = np.flatnonzero(in_reach & ~walked[hinge])
        shorter = np.minimum(length[tips][:, None], length[strikes][None, :])
        longer = np.maximum(length[tips][:, None], length[strikes][None, :])
        cosine = (away[tips] @ away[strikes].T) / (length[tips][:, None] * length[strikes][None, :])
        opened = (cosine <= np.cos(np.radians(LEAST_ANGLE))) & (cosine >= np.cos(np.radians(LARGEST_ANGLE)))
        wedge = walked[hinge, tips][:, None] & walked[np.ix_(tips, strikes)]
        fits = (shorter > ratio * longer) & opened & ~wedge
        tip, strike = np.nonzero(fits)
        found.append(np.column_stack([tips[tip], np.full(tip.size, hinge), strikes[strike]]).astype(np.int32))
    return np.concatenate(found)
