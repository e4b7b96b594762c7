"""The connectivity test: can one corner be reached from another by following ink (thesis alg. 3.1, eq. 3.6-3.10)?

`walk` is the algorithm as one reads it and returns its path. `walk_all` moves every walk by one pixel per NumPy step
and gives the same answers. Two corners are connected when the walk arrives in one of the two directions.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray

STEP_SLACK = 4
"""Steps allowed beyond |dx| + |dy|: the printed algorithm never ends."""


@dataclass(frozen=True)
class Walk:
    """Where a walk went, as (x, y) pixels, and whether it arrived."""

    path: tuple[tuple[int, int], ...]
    reached: bool


def forward_neighbours(origin: tuple[int, int], goal: tuple[int, int]) -> tuple[tuple[int, int], ...]:
    """The three steps (dx, dy) that lead from origin towards goal, eq. 3.6-3.9.

    The thesis leaves pairs on one row or column open; there the three neighbours ahead are taken.

    >>> forward_neighbours((0, 9), (9, 0))          # up and to the right, y down: eq. 3.6
    ((1, 0), (0, -1), (1, -1))
    >>> forward_neighbours((0, 0), (9, 0))
    ((1, 0), (1, -1), (1, 1))
    """
    dx, dy = int(np.sign(goal[0] - origin[0])), int(np.sign(goal[1] - origin[1]))
    if dy == 0:
        return ((dx, 0), (dx, -1), (dx, 1))
    if dx == 0:
        return ((0, dy), (-1, dy), (1, dy))
    return ((dx, 0), (0, dy), (dx, dy))


def walk(ink: ArrayLike, origin: tuple[int, int], goal: tuple[int, int], reach: int = 2) -> Walk:
    """Follow ink from origin towards goal, always to the dark neighbour nearest to the goal (alg. 3.1).

    Parameters
    ----------
    ink : (height, width) bool
    origin, goal : x, y pixels; the walk starts at the ink nearest to origin within `reach`
    reach : the walk has arrived within so many pixels of the goal, along x and y

    >>> line = np.zeros((3, 9), dtype=bool)
    >>> line[1] = True
    >>> walk(line, (0, 1), (8, 1)).reached
    True
    >>> line[1, 3:5] = False
    >>> walk(line, (0, 1), (8, 1)).path
    ((0, 1), (1, 1), (2, 1))
    """
    ink = np.asarray(ink, dtype=bool)
    height, width = ink.shape
    x, y = (int(v) for v in snap_to_ink(ink, [origin], reach)[0])
    path = [(x, y)]
    if not (0 <= x < width and 0 <= y < height and ink[y, x]):
        return Walk(tuple(path), False)
    steps = forward_neighbours((x, y), goal)  # P_n
    for _ in range(abs(goal[0] - x) + abs(goal[1] - y) + STEP_SLACK):
        if max(abs(goal[0] - x), abs(goal[1] - y)) <= reach:
            return Walk(tuple(path), True)
        ahead = [(x + dx, y + dy) for dx, dy in steps]
        dark = [(px, py) for px, py in ahead if 0 <= px < width and 0 <= py < height and ink[py, px]]
        if not dark:
            break
        x, y = min(dark, key=lambda p: (p[0] - goal[0]) ** 2 + (p[1] - goal[1]) ** 2)  # eq. 3.10
        path.append((x, y))
    return Walk(tuple(path), max(abs(goal[0] - x), abs(goal[1] - y)) <= reach)


def walk_all(ink: ArrayLike, origins: ArrayLike, goals: ArrayLike, reach: int = 2) -> NDArray[np.bool_]:
    """`walk` for many pairs at once: every walk moves one pixel per step of the loop.

    Parameters
    ----------
    ink : (height, width) bool
    origins, goals : (P, 2) x, y pixels

    Returns
    -------
    (P,) bool, True where the walk arrived
    """
    ink = np.asarray(ink, dtype=bool)
    return _walk_from_ink(ink, snap_to_ink(ink, origins, reach), np.asarray(goals, dtype=np.int64).reshape(-1, 2), reach)


def snap_to_ink(ink: NDArray[np.bool_], points: ArrayLike, reach: int = 2) -> NDArray[np.int64]:
    """Move every point to the nearest ink within `reach` pixels; leave it where there is none.

    >>> ink = np.zeros((5, 5), dtype=bool); ink[2, 3] = True
    >>> snap_to_ink(ink, [(2, 2), (0, 0)], reach=1).tolist()
    [[3, 2], [0, 0]]
    """
    rounded = np.rint(np.asarray(points, dtype=np.float64)).astype(np.int64).reshape(-1, 2)
    offsets = np.array([(dx, dy) for dy in range(-reach, reach + 1) for dx in range(-reach, reach + 1)])
    offsets = offsets[np.argsort((offsets**2).sum(axis=1), kind="stable")]
    height, width = ink.shape
    nearby = rounded[:, None, :] + offsets
    inside = (nearby >= 0).all(axis=2) & (nearby < [width, height]).all(axis=2)
    clipped = np.clip(nearby, 0, [width - 1, height - 1])
    dark = inside & ink[clipped[..., 1], clipped[..., 0]]
    nearest = nearby[np.arange(len(rounded)), dark.argmax(axis=1)]
    return np.where(dark.any(axis=1)[:, None], nearest, rounded)


def connect(
    ink: ArrayLike, corners: ArrayLike, min_length: float = 1.0, max_length: float = np.inf, reach: int = 2
) -> NDArray[np.bool_]:
    """Which corners are connected: (N, N) symmetric bool, False between corners nearer or farther than the lengths given."""
    ink = np.asarray(ink, dtype=bool)
    points = np.asarray(corners, dtype=np.float64).reshape(-1, 2)
    near = np.zeros((len(points), len(points)), dtype=bool)
    distance = np.hypot(*(points[:, None, :] - points[None, :, :]).transpose(2, 0, 1))
    start, end = np.nonzero(np.triu((distance >= min_length) & (distance <= max_length), k=1))
    snapped = snap_to_ink(ink, points, reach)
    near_each_other = _meets(ink, snapped, reach)
    meets = near_each_other[start] == near_each_other[end]
    start, end = start[meets], end[meets]
    there = _walk_from_ink(ink, snapped[start], snapped[end], reach)
    near[start[there], end[there]] = True
    start, end = start[~there], end[~there]  # connected = walk(a, b) or walk(b, a)
    back = _walk_from_ink(ink, snapped[end], snapped[start], reach)
    near[start[back], end[back]] = True
    return near | near.T


def _meets(ink: NDArray[np.bool_], points: NDArray[np.int64], reach: int) -> NDArray[np.int64]:
    """(N,) a label for each point: no walk arrives from a point at one with another label, whichever way it turns.

    Walkers stay on their component of ink and arrive within `reach`: components of the ink grown by it.
    """
    side = 2 * reach + 1
    grown = cv2.dilate(np.pad(ink, reach).astype(np.uint8), np.ones((side, side), np.uint8))
    _, labels = cv2.connectedComponents(grown, connectivity=8)
    height, width = grown.shape
    x, y = np.clip(points + reach, 0, [width - 1, height - 1]).T
    return np.asarray(labels[y, x], dtype=np.int64)


def _walk_from_ink(ink: NDArray[np.bool_], origins: NDArray[np.int64], goals: NDArray[np.int64], reach: int) -> NDArray[np.bool_]:
    """`walk_all` for origins that were snapped already; pixels are flat positions in a sheet with a white rim."""
    pad = reach + STEP_SLACK
    padded = np.pad(ink, pad)
    width = padded.shape[1]
    dark = padded.ravel()
    inside = (origins >= 0).all(axis=1) & (origins < [ink.shape[1], ink.shape[0]]).all(axis=1)
    alive = np.flatnonzero(inside)
    alive = alive[ink[origins[alive, 1], origins[alive, 0]]]
    reached = np.zeros(len(goals), dtype=bool)
    away = (goals - origins)[alive].astype(np.int32)  # what is left to go, x and y
    steps = _steps(np.sign(away))  # (3, 2, P)
    at = ((origins[alive, 1] + pad) * width + origins[alive, 0] + pad).astype(np.int32)
    jumps = steps[:, 1] * np.int32(width) + steps[:, 0]  # (3, P)
    left_x, left_y = away[:, 0].copy(), away[:, 1].copy()
    cap = np.abs(away).sum(axis=1) + STEP_SLACK
    while alive.size:
        arrived = (np.abs(left_x) <= reach) & (np.abs(left_y) <= reach)
        reached[alive[arrived]] = True
        best = np.full(alive.size, _FAR)
        choice = np.zeros(alive.size, dtype=np.intp)
        for k in range(3):
            distance = (left_x - steps[k, 0]) ** 2 + (left_y - steps[k, 1]) ** 2  # eq. 3.10
            better = dark[at + jumps[k]] & (distance < best)
            choice[better] = k
            best[better] = distance[better]
        going = np.flatnonzero((best < _FAR) & ~arrived & (cap > 0))
        choice = choice[going]
        alive, cap, steps, jumps = alive[going], cap[going] - 1, steps[:, :, going], jumps[:, going]
        walker = np.arange(going.size)
        at = at[going] + jumps[choice, walker]
        left_x = left_x[going] - steps[choice, 0, walker]
        left_y = left_y[going] - steps[choice, 1, walker]
    return reached


_FAR = np.int32(2**31 - 1)


def _steps(direction: NDArray[np.int32]) -> NDArray[np.int32]:
    """(3, 2, P) forward neighbours of every pair, from the signs of goal minus origin."""
    dx, dy = direction.T
    zero = np.zeros_like(dx)
    diagonal = np.array([[dx, zero], [zero, dy], [dx, dy]])
    level = np.array([[dx, zero], [dx, zero - 1], [dx, zero + 1]])
    upright = np.array([[zero, dy], [zero - 1, dy], [zero + 1, dy]])
    return np.where(dy == 0, level, np.where(dx == 0, upright, diagonal)).astype(np.int32)
