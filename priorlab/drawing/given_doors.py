"""Doors that somebody sets by hand: are they doors of this drawing?"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import check_record
from priorlab.core.drawing import Door

OFF_SHEET = 0.2
"""A leaf may stand so far off a drawing that was cut close, as a share of its width or height."""


def check_doors(doors: Sequence[Door], shape: tuple[int, int]) -> None:
    """Say which door cannot be one of a drawing of this height and width.

    >>> check_doors([Door((1, 1), (9, 1), (1, 9)), Door((5, 5), (95, 5), (5, 95))], (100, 120))
    Traceback (most recent call last):
    ValueError: doors[1] must be at most half as wide as the drawing, 60 pixels, got 90
    """
    height, width = shape
    check_record("doors", doors, Sequence)
    for number, door in enumerate(doors):
        name = f"doors[{number}]"
        check_record(name, door, Door)
        points = (door.hinge, door.strike, door.tip)
        try:
            x, y = door.points.T
        except (TypeError, ValueError):
            raise ValueError(f"{name} must have three points of two numbers, got {points}") from None
        if not (np.isfinite(door.points).all() and _within(x, width) and _within(y, height)):
            raise ValueError(f"{name} must lie on the drawing, {width} x {height} pixels, got {points}")
        if not door.width > 0:
            raise ValueError(f"{name} must have hinge and strike apart, got {points}")
        if door.width > max(shape) / 2:
            raise ValueError(f"{name} must be at most half as wide as the drawing, {max(shape) / 2:g} pixels, got {door.width:g}")


def _within(places: NDArray[np.float64], length: int) -> bool:
    """Between the edges of a drawing, or so little beyond them as a leaf may be that opens out of it."""
    return bool(places.min() >= -OFF_SHEET * length and places.max() <= (1 + OFF_SHEET) * length)
