"""A flat worked out: its walls in metres, which of its openings are doors, and the scale that makes its doors 0.9 m wide."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from priorlab.interchange.r2v import Box, LineFlat
from priorlab.study.flats.lines import Gap, Points, WallLine, gap_of, joined
from priorlab.study.flats.rooms import RoomPicture, picture_rooms

DOOR_M = 0.9
"""Width that the median swinging door is given, metres."""

UNKNOWN_SCALE = 0.02
"""Metres per pixel of a flat without openings."""


@dataclass(frozen=True, eq=False)
class FlatPlan:
    """A flat in metres, x right, y up.

    Parameters
    ----------
    walls : centre lines, each with its style (outer, inner or rail) and thickness
    rooms : what lies where
    doors, windows : gaps in the walls; a door lies between two rooms or beside the entrance
    things : kind and box (left, low, right, high) of room labels and fixtures
    """

    walls: tuple[WallLine, ...]
    rooms: RoomPicture
    doors: tuple[Gap, ...]
    windows: tuple[Gap, ...]
    things: tuple[tuple[str, Box], ...]


def plan_of(flat: LineFlat, thickness: Mapping[str, float]) -> FlatPlan:
    """Work a flat out.

    Which openings are doors depends on the scale only by tolerances, so the scale is found in a few steps: all openings first,
    then the doors among them.

    Parameters
    ----------
    flat : lines in the pixels of its file
    thickness : metres of an "outer", an "inner" wall and a "rail"
    """
    lengths = np.hypot(*(flat.openings[:, 2:] - flat.openings[:, :2]).T)
    scale = DOOR_M / _usual(lengths) if lengths.size else UNKNOWN_SCALE
    plan = _plan_at(flat, thickness, scale)
    for _ in range(4):
        width = usual_width(plan.doors)
        if width is None or abs(width / DOOR_M - 1) < 0.01:
            break
        scale *= DOOR_M / width
        plan = _plan_at(flat, thickness, scale)
    return plan


def usual_width(doors: Sequence[Gap]) -> float | None:
    """The median width of the doors that can swing, metres; None without doors."""
    return _usual(np.array([gap.width for gap in doors])) if doors else None


def _usual(widths: NDArray[np.float64]) -> float:
    """The median, sliding fronts left out: widths of more than 1.8 times the lower quartile."""
    return float(np.median(widths[widths <= 1.8 * np.quantile(widths, 0.25)]))


def _plan_at(flat: LineFlat, thickness: Mapping[str, float], scale: float) -> FlatPlan:
    """The plan at a scale, metres per pixel of the file."""
    walls = _walls(flat, thickness, scale)
    rooms = picture_rooms(walls)
    things = tuple((kind, _box(box, scale)) for kind, box in flat.things)
    gaps: list[Gap] = []
    for row in flat.openings:
        gap = gap_of(*_ends(row, scale), walls)
        if gap and not any(one.overlaps(gap) for one in gaps):
            gaps.append(gap)
    to_outside = [1 in rooms.beside(gap.wall, (gap.low + gap.high) / 2) for gap in gaps]
    fronts = [gap for gap, outside in zip(gaps, to_outside, strict=True) if outside]
    entrances = [_nearest(box, fronts) for kind, box in things if kind == "entrance"]
    windows = [gap for gap in fronts if not any(gap is one for one in entrances)]
    doors = [gap for gap in gaps if not any(gap is one for one in windows)]
    return FlatPlan(tuple(walls), rooms, tuple(doors), tuple(windows), things)


def _walls(flat: LineFlat, thickness: Mapping[str, float], scale: float) -> list[WallLine]:
    """Walls at a scale: outer ones where one side is outdoors (balconies are), rails round balconies."""
    lines = [WallLine(*_ends(row, scale), "wall") for row in flat.walls]
    lines += [WallLine(*_ends(row, scale), "rail") for row in flat.rails]
    whole = joined(lines)
    rooms = picture_rooms([wall for wall in whole if wall.style == "wall"])
    styled = []
    for wall in whole:
        style = wall.style
        if style == "wall":
            outdoors = [1 in rooms.beside(wall, share) for share in np.linspace(0.1, 0.9, 5) * wall.length]
            style = "outer" if sum(outdoors) >= 3 else "inner"
        styled.append(replace(wall, style=style, thickness=thickness[style]))
    return styled


def _nearest(box: Box, gaps: Sequence[Gap], within: float = 0.6) -> Gap | None:
    """The gap beside a box: the nearest within so many metres."""

    def away(gap: Gap) -> float:
        x, y = gap.middle
        return math.hypot(max(box[0] - x, 0, x - box[2]), max(box[1] - y, 0, y - box[3]))

    near = [gap for gap in gaps if away(gap) < within]
    return min(near, key=away) if near else None


def _ends(row: NDArray[np.float64], scale: float) -> tuple[Points, Points]:
    """Ends of a line of the file in metres, y up."""
    flip = np.array([scale, -scale])
    return row[:2] * flip, row[2:] * flip


def _box(box: Box, scale: float) -> Box:
    """A box of the file as left, low, right, high in metres, y up."""
    (left, right), (low, high) = sorted((box[0] * scale, box[2] * scale)), sorted((-box[1] * scale, -box[3] * scale))
    return left, low, right, high
