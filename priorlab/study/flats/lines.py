"""Centre lines of a flat put in order: one line a wall, corners closed, openings cut to fit."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]

TOUCH = 0.06
"""Lines nearer than this (metres) touch."""


@dataclass(frozen=True, eq=False)
class WallLine:
    """A straight wall: (2,) ends of its centre line, metres, y up, and its style's name and thickness."""

    start: Points
    end: Points
    style: str
    thickness: float = 0.0

    @property
    def length(self) -> float:
        """From end to end."""
        return float(np.linalg.norm(self.end - self.start))

    @property
    def along(self) -> Points:
        """Unit vector from start to end."""
        return (self.end - self.start) / self.length

    @property
    def across(self) -> Points:
        """Unit vector to the left."""
        return np.array([-self.along[1], self.along[0]])

    def at(self, share: float) -> Points:
        """The point `share` metres from the start."""
        return self.start + share * self.along

    def offset(self, point: Points) -> tuple[float, float]:
        """How far along from the start, and how far to the left, a point lies."""
        away = point - self.start
        return float(away @ self.along), float(away @ self.across)


@dataclass(frozen=True, eq=False)
class Gap:
    """An opening in a wall, from `low` to `high` metres along it."""

    wall: WallLine
    low: float
    high: float

    @property
    def middle(self) -> Points:
        """On the centre line."""
        return self.wall.at((self.low + self.high) / 2)

    @property
    def width(self) -> float:
        """Metres."""
        return self.high - self.low

    def overlaps(self, other: Gap) -> bool:
        """Do two gaps of one wall leave no wall between them?"""
        return self.wall is other.wall and self.low < other.high + 0.05 and other.low < self.high + 0.05


def joined(walls: Sequence[WallLine]) -> list[WallLine]:
    """Lines of one style that continue each other, or lie upon each other, become one."""
    left, whole = [wall for wall in walls if wall.length > TOUCH], []
    while left:
        wall = left.pop(0)
        grew = True
        while grew:
            grew = False
            for other in left:
                if other.style == wall.style and _continues(wall, other):
                    shares = [0.0, wall.length, wall.offset(other.start)[0], wall.offset(other.end)[0]]
                    wall = replace(wall, start=wall.at(min(shares)), end=wall.at(max(shares)))
                    left = [one for one in left if one is not other]
                    grew = True
                    break
        whole.append(wall)
    return whole


def _continues(wall: WallLine, other: WallLine) -> bool:
    """Do two lines lie on one line and touch?"""
    (a, off_a), (b, off_b) = wall.offset(other.start), wall.offset(other.end)
    on_line = max(abs(off_a), abs(off_b)) <= TOUCH
    return on_line and max(a, b) >= -TOUCH and min(a, b) <= wall.length + TOUCH


def with_closed_corners(walls: Sequence[WallLine]) -> list[WallLine]:
    """Walls that meet end to end, each made longer until the outer corner is closed: by t/2 tan(bend/2)."""
    return [
        replace(wall, start=wall.at(-_reach(wall, wall.start, walls)), end=wall.at(wall.length + _reach(wall, wall.end, walls)))
        for wall in walls
    ]


def _reach(wall: WallLine, end: Points, walls: Sequence[WallLine]) -> float:
    """How much further an end must go to close its corner."""
    longest = 0.0
    for other in walls:
        if other is wall or min(np.linalg.norm(end - other.start), np.linalg.norm(end - other.end)) > 2 * TOUCH:
            continue
        inwards = wall.along if np.allclose(end, wall.start) else -wall.along
        away = other.along if np.linalg.norm(end - other.start) < np.linalg.norm(end - other.end) else -other.along
        bend = math.acos(float(np.clip(-inwards @ away, -1, 1)))
        longest = max(longest, other.thickness / 2 * math.tan(min(bend, math.pi / 2) / 2))
    return longest


def gap_of(start: Points, end: Points, walls: Sequence[WallLine], narrowest: float = 0.35) -> Gap | None:
    """The gap that an opening's centre line makes in its wall, clear of walls that meet it; None if none is left."""
    middle = (start + end) / 2
    best, least = None, 0.2
    for wall in walls:
        share, off = wall.offset(middle)
        parallel = abs(float((end - start) @ wall.across)) <= 0.2 * float(np.linalg.norm(end - start))
        if parallel and 0 <= share <= wall.length and abs(off) < least:
            best, least = wall, abs(off)
    if best is None:
        return None
    low, high = sorted(best.offset(point)[0] for point in (start, end))
    low, high = max(low, 0.05), min(high, best.length - 0.05)
    for other in walls:
        place = _meets(best, other)
        if other is best or place is None:
            continue
        clear = other.thickness / 2 + 0.05
        if place + clear <= low or place - clear >= high:
            continue
        if place - low < high - place:
            low = place + clear
        else:
            high = place - clear
    return Gap(best, low, high) if high - low >= narrowest else None


def _meets(wall: WallLine, other: WallLine) -> float | None:
    """Where along a wall another one meets or crosses it."""
    (a, off_a), (b, off_b) = wall.offset(other.start), wall.offset(other.end)
    if min(abs(off_a), abs(off_b)) > wall.thickness / 2 + TOUCH and off_a * off_b > 0:
        return None
    if abs(off_a - off_b) < 1e-6:
        return None
    share = a + (b - a) * float(np.clip(off_a / (off_a - off_b), 0, 1))
    return share if -TOUCH <= share <= wall.length + TOUCH else None
