"""How thick and how long walls are on a sheet, in pixels: from its size, and from its doors when there are some."""

from __future__ import annotations

from dataclasses import dataclass

FACE_LENGTH = 0.02
"""Shortest face of a wall, share of the long side M."""

LONGER_THAN_THICK = 1.2
"""A face is so many times longer than the thickest wall."""

PIECE_LENGTH = 0.03
"""Shortest piece of wall that stays, share of M."""

THICKNESS = 0.02
"""Thickest hollow wall, share of M, when no door tells."""

THICKNESS_BOUNDS = (0.015, 0.035)
"""What doors may make of it, shares of M."""

DOORS_PER_THICKNESS = 0.5
"""Thickest wall as a share of a door's width: about 0.45 m beside 0.85 m."""


@dataclass(frozen=True)
class WallSizes:
    """Sizes of walls in working pixels.

    Parameters
    ----------
    long_side : M, the long side of the sheet
    thickness : thickest hollow wall
    """

    long_side: int
    thickness: float

    @property
    def face_length(self) -> float:
        """Shortest face of a wall; longer than walls are thick, or a wall's end would be the face of another one."""
        return max(FACE_LENGTH * self.long_side, LONGER_THAN_THICK * self.thickness)

    @property
    def piece_length(self) -> float:
        """Shortest piece of wall that stays."""
        return PIECE_LENGTH * self.long_side


def wall_sizes(long_side: int, door_width: float | None = None) -> WallSizes:
    """Sizes for a sheet; a known door width (pixels) tells how thick a wall can be.

    >>> wall_sizes(1000).thickness, wall_sizes(1000, door_width=50).thickness, wall_sizes(1000, door_width=200).thickness
    (20.0, 25.0, 35.0)
    """
    if door_width is None:
        return WallSizes(long_side, THICKNESS * long_side)
    low, high = (bound * long_side for bound in THICKNESS_BOUNDS)
    return WallSizes(long_side, min(max(DOORS_PER_THICKNESS * door_width, low), high))
