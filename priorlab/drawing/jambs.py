"""Exact jambs: corners lie a few pixels off, the opening itself is white from jamb to jamb and can be measured."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from priorlab.core.drawing import Door

DEEPEST = 6
"""Lines through the opening that are looked at, pixels away from the leaf."""

BOUNDS = (0.75, 1.3)
"""A measured opening is believed when it is within these shares of the one between the corners."""


def with_measured_jambs(door: Door, walls: NDArray[np.bool_]) -> Door:
    """The door with hinge and strike at the ends of its white opening, measured inside the wall; as it was when none is found.

    Parameters
    ----------
    door : in the pixels of `walls`
    walls : (height, width) bool, ink of walls

    >>> wall = np.zeros((12, 60), dtype=bool); wall[0:6, :10] = wall[0:6, 50:] = True
    >>> with_measured_jambs(Door(hinge=(12, 6), strike=(52, 5), tip=(12, 46)), wall).width
    40.0
    """
    hinge, strike, tip = door.points
    axis = int(np.abs(strike - hinge).argmax())  # 0: the opening lies along x
    middle = (hinge + strike) / 2
    away = -np.sign(tip[1 - axis] - middle[1 - axis]) or 1.0
    spans, depths = [], []
    for depth in range(DEEPEST + 1):
        across = int(round(middle[1 - axis] + away * depth))
        if not 0 <= across < walls.shape[axis]:  # rows when the opening lies along x
            continue
        line = walls[across] if axis == 0 else walls[:, across]
        span = _white_span(line, int(round(middle[axis])))
        if span and BOUNDS[0] * door.width <= span[1] - span[0] <= BOUNDS[1] * door.width:
            spans.append(span)
            depths.append(across)
    if not spans:
        return door
    low, high = np.median(np.array(spans), axis=0)
    first, last = (low, high) if hinge[axis] < strike[axis] else (high, low)
    new_hinge, new_strike = hinge.copy(), strike.copy()
    new_hinge[axis], new_strike[axis] = first, last
    lies = float(np.clip(middle[1 - axis], min(depths), max(depths)))  # between wall and wall
    new_hinge[1 - axis] = new_strike[1 - axis] = lies
    return replace(
        door,
        hinge=(float(new_hinge[0]), float(new_hinge[1])),
        strike=(float(new_strike[0]), float(new_strike[1])),
    )


def _white_span(line: NDArray[np.bool_], middle: int) -> tuple[float, float] | None:
    """Borders of the white run round the middle of a line; None when ink lies there or one end is open."""
    if not 0 <= middle < line.size or line[middle]:
        return None
    before, after = np.flatnonzero(line[:middle]), np.flatnonzero(line[middle:])
    if not before.size or not after.size:
        return None
    return float(before[-1]) + 0.5, float(middle + after[0]) - 0.5
