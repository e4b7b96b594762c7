"""Sweeps: walls grow from the jambs of doors along rows and columns (thesis eq. 3.15-3.19, fig. 3.8).

Read literally the equations are an erosion. Meant is this: a sweep adds every maximal dark run along its axis that meets
the walls found so far. First come the runs that leave each jamb away from the other one, then h, v, h, v.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from priorlab.core.drawing import Door
from priorlab.drawing.connectivity import snap_to_ink
from priorlab.drawing.runs import grow_along

HORIZONTAL, VERTICAL = 1, 0
"""Axis of a sweep."""


def orientation(door: Door) -> str:
    """ "h" or "v": along which axis the open side lies; "" when its x and y differences are equal (eq. 3.15).

    >>> orientation(Door(hinge=(0, 0), strike=(40, 2), tip=(0, 40)))
    'h'
    """
    across, down = abs(door.hinge[0] - door.strike[0]), abs(door.hinge[1] - door.strike[1])
    return "h" if across > down else "v" if down > across else ""


def jamb_runs(ink: NDArray[np.bool_], doors: Sequence[Door], reach: int = 2) -> NDArray[np.bool_]:
    """The dark runs that leave each jamb, away from the other one, until the first white pixel.

    Parameters
    ----------
    ink : (height, width) bool
    doors : doors in the same pixels
    reach : a jamb may lie so many pixels beside its wall

    >>> wall = np.zeros((3, 12), dtype=bool); wall[1, :4] = wall[1, 8:] = True
    >>> door = Door(hinge=(3, 1), strike=(8, 1), tip=(3, 6))
    >>> jamb_runs(wall, [door])[1].astype(int).tolist()
    [1, 1, 1, 1, 0, 0, 0, 0, 1, 1, 1, 1]
    """
    found = np.zeros_like(ink)
    for door in doors:
        way = orientation(door)
        if not way:
            continue
        for jamb, other in ((door.hinge, door.strike), (door.strike, door.hinge)):
            x, y = snap_to_ink(ink, [jamb], reach)[0]
            if not (0 <= x < ink.shape[1] and 0 <= y < ink.shape[0] and ink[y, x]):
                continue
            if way == "h":
                sign = 1 if jamb[0] > other[0] else -1
                row = ink[y, x:] if sign > 0 else ink[y, x::-1]
                stop = _first_white(row)
                found[y, x : x + stop] |= sign > 0
                found[y, max(0, x - stop + 1) : x + 1] |= sign < 0
            else:
                sign = 1 if jamb[1] > other[1] else -1
                column = ink[y:, x] if sign > 0 else ink[y::-1, x]
                stop = _first_white(column)
                found[y : y + stop, x] |= sign > 0
                found[max(0, y - stop + 1) : y + 1, x] |= sign < 0
    return found


def sweep_walls(
    ink: NDArray[np.bool_], start: NDArray[np.bool_], first: int = HORIZONTAL, n_sweeps: int = 4
) -> tuple[NDArray[np.bool_], ...]:
    """Sweep h, v, h, v from the walls found so far: what is wall after the start and after each sweep.

    Parameters
    ----------
    ink : (height, width) bool
    start : (height, width) bool, walls to begin with
    first : axis of the first sweep
    n_sweeps : how many

    >>> ink = np.array([[1, 1, 1], [0, 0, 1], [1, 0, 1]], dtype=bool)
    >>> start = np.zeros_like(ink); start[0, 0] = True
    >>> [int(stage.sum()) for stage in sweep_walls(ink, start, n_sweeps=2)]
    [1, 3, 5]
    """
    stages = [start & ink]
    axis = first
    for _ in range(n_sweeps):
        stages.append(stages[-1] | grow_along(stages[-1], ink, axis))  # eq. 3.16-3.17 along h, 3.18-3.19 along v
        axis = HORIZONTAL if axis == VERTICAL else VERTICAL
    return tuple(stages)


def _first_white(line: NDArray[np.bool_]) -> int:
    """How many dark pixels a line begins with."""
    white = np.flatnonzero(~line)
    return int(white[0]) if white.size else len(line)
