"""Where a ray meets the first obstacle: an exact walk from pixel to pixel, all rays at once.

A ray visits every pixel that it crosses (Amanatides and Woo, 1987). At a corner it would slip between two obstacle pixels
that touch only diagonally; there both sides are looked at and the gap counts as closed.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.checks import as_numbers, check_image, check_positive
from priorlab.core.grid import Grid
from priorlab.core.progress import Progress

RAYS_AT_ONCE = 20_000
"""Rays that walk together: enough for speed, little for memory."""

FREE, OBSTACLE, OUTSIDE = 0, 1, 2
AT_THE_CORNER = 1e-9
"""Crossings of a column and of a row that lie this close together (pixels) are one: the ray goes through the corner."""


def cast_rays(
    obstacles: ArrayLike, origins_xy: ArrayLike, angles: ArrayLike, max_range: float, progress: Progress | None = None
) -> NDArray[np.float64]:
    """Distance from each origin to the first obstacle pixel along its ray.

    Parameters
    ----------
    obstacles : (height, width) bool, row 0 at the top, True where a ray ends
    origins_xy : (N, 2) x, y in pixels, y up
    angles : (N,) radians, counter-clockwise from +x
    max_range : pixels; what lies farther away is not met
    progress : called with the rays done and the rays to do

    Returns
    -------
    (N,) pixels to the near side of the obstacle pixel; inf when none stands within `max_range` or on the map;
    0 for an origin in an obstacle.

    Raises
    ------
    ValueError
        When an origin is not a finite point of the map.

    >>> room = np.zeros((5, 9), dtype=bool)
    >>> room[:, 7] = True
    >>> cast_rays(room, [[2.5, 2.5], [2.5, 2.5]], [0.0, np.pi], max_range=20).tolist()
    [4.5, inf]
    """
    obstacles = check_image("obstacles", obstacles)
    check_positive("max_range", max_range)
    origins, angles = as_numbers("origins_xy", origins_xy), as_numbers("angles", angles)
    _check_rays(obstacles, origins, angles)

    # A rim of OUTSIDE pixels round the map ends every walk; rows counted from the bottom make "up" a positive step.
    height, width = obstacles.shape
    kind = np.full((height + 2, width + 2), OUTSIDE, dtype=np.uint8)
    kind[1:-1, 1:-1] = Grid(obstacles.shape).to_ros(obstacles)
    ranges = np.empty(len(angles))
    for first in range(0, len(angles), RAYS_AT_ONCE):
        some = slice(first, first + RAYS_AT_ONCE)
        ranges[some] = _walk(kind.ravel(), width + 2, origins[some], angles[some], max_range)
        if progress:
            progress(min(first + RAYS_AT_ONCE, len(angles)), len(angles))
    return ranges


def _walk(kind: NDArray, stride: int, origins: NDArray, angles: NDArray, max_range: float) -> NDArray[np.float64]:
    """Walk some rays from pixel to pixel until each has met an obstacle or left."""
    col, row = np.floor(origins.T).astype(np.int64)
    pixel = (row + 1) * stride + col + 1
    direction = np.stack([np.cos(angles), np.sin(angles)])
    direction[np.abs(direction) < 1e-12] = 0.0  # cos(pi/2) is not 0 in floats
    forward = direction > 0
    with np.errstate(divide="ignore", invalid="ignore"):
        per_pixel = 1.0 / np.abs(direction)  # path length from one column (row) to the next; inf: never
        first = np.where(forward, np.stack([col, row]) + 1 - origins.T, origins.T - np.stack([col, row])) * per_pixel
    first[np.isnan(first)] = np.inf  # 0 * inf: on a border and parallel to it
    next_x, next_y = first
    per_col, per_row = per_pixel
    step_x = np.where(forward[0], 1, -1)
    step_y = np.where(forward[1], stride, -stride)

    ranges = np.full(len(angles), np.inf)
    ranges[kind[pixel] == OBSTACLE] = 0.0
    ray = np.flatnonzero(kind[pixel] == FREE)
    pixel, next_x, next_y = pixel[ray], next_x[ray], next_y[ray]
    per_col, per_row, step_x, step_y = per_col[ray], per_row[ray], step_x[ray], step_y[ray]
    while ray.size:
        travelled = np.minimum(next_x, next_y)
        cross_x = next_x <= next_y + AT_THE_CORNER
        cross_y = next_y <= next_x + AT_THE_CORNER
        closed = _closed_corner(kind, pixel, step_x, step_y, cross_x & cross_y)
        pixel += step_x * cross_x + step_y * cross_y
        np.add(next_x, per_col, out=next_x, where=cross_x)
        np.add(next_y, per_row, out=next_y, where=cross_y)

        entered = kind[pixel]
        entered[closed] = OBSTACLE
        within = travelled <= max_range
        met = (entered == OBSTACLE) & within
        ranges[ray[met]] = travelled[met]
        on = (entered == FREE) & within
        ray, pixel, next_x, next_y = ray[on], pixel[on], next_x[on], next_y[on]
        per_col, per_row, step_x, step_y = per_col[on], per_row[on], step_x[on], step_y[on]
    return ranges


def _closed_corner(kind: NDArray, pixel: NDArray, step_x: NDArray, step_y: NDArray, at_corner: NDArray) -> NDArray[np.int64]:
    """The rays at a corner whose two sides are both obstacles: no gap, however thin the diagonal."""
    ray = np.flatnonzero(at_corner)
    sides = (kind[pixel[ray] + step_x[ray]] == OBSTACLE) & (kind[pixel[ray] + step_y[ray]] == OBSTACLE)
    return ray[sides]


def _check_rays(obstacles: NDArray, origins: NDArray, angles: NDArray) -> None:
    """Say when rays do not start on the map."""
    if angles.ndim != 1:
        raise ValueError(f"angles must be one row of finite numbers, got shape {angles.shape}")
    if origins.shape != (len(angles), 2):
        raise ValueError(f"origins_xy must have shape {(len(angles), 2)}, one per angle, got {origins.shape}")
    if not np.isfinite(angles).all():
        raise ValueError(f"angles must be finite numbers, got {angles[~np.isfinite(angles)][0]:g}")
    inside = Grid(obstacles.shape).contains(origins)  # False for NaN
    if not inside.all():
        x, y = origins[~inside][0]
        height, width = obstacles.shape
        raise ValueError(f"a ray must start on the map of {width} x {height} pixels, got x, y = {x:g}, {y:g}")
