"""The ink that doors explain: their leaves and arcs are no walls."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.core.drawing import Door
from priorlab.drawing.preprocessing import Sheet
from priorlab.drawing.strokes import opened

LEAF_THICKNESS = 0.12
"""Thickest leaf, share of a door's width."""


def scaled_doors(doors: Sequence[Door], scale: float) -> tuple[Door, ...]:
    """Doors in other pixels.

    >>> scaled_doors([Door(hinge=(1, 2), strike=(5, 2), tip=(1, 6))], 2)[0].strike
    (10, 4)
    """
    return tuple(
        replace(
            door,
            hinge=(door.hinge[0] * scale, door.hinge[1] * scale),
            strike=(door.strike[0] * scale, door.strike[1] * scale),
            tip=(door.tip[0] * scale, door.tip[1] * scale),
        )
        for door in doors
    )


def door_ink(sheet: Sheet, doors: Sequence[Door]) -> NDArray[np.bool_]:
    """Ink of leaves and swings, in working pixels; solid ink, thicker than a leaf can be, stays out.

    Parameters
    ----------
    sheet : the drawing made ready
    doors : doors in working pixels
    """
    region = np.zeros(sheet.lines.shape, dtype=np.uint8)
    for door in doors:
        cv2.fillPoly(region, [_sector(door)], 1)
        start, end = _leaf(door)
        cv2.line(region, start, end, 1, max(3, round(2 * LEAF_THICKNESS * door.width)))
    if not region.any():
        return region.astype(bool)
    leaf_thickness = max(4, round(LEAF_THICKNESS * float(np.median([door.width for door in doors]))))
    return sheet.lines & region.astype(bool) & ~opened(sheet.lines, leaf_thickness)


def _leaf(door: Door) -> tuple[tuple[int, int], tuple[int, int]]:
    """Where the leaf begins, its thickness off the hinge, and where it ends."""
    hinge, _, tip = door.points
    start = hinge + (2 * LEAF_THICKNESS * door.width) * (tip - hinge) / max(float(np.hypot(*(tip - hinge))), 1e-9)
    return (round(start[0]), round(start[1])), (round(tip[0]), round(tip[1]))


def _sector(door: Door, margin: float = 3.0) -> NDArray[np.int32]:
    """Outline of what the leaf sweeps over, a margin wider at the tip and a margin off the wall at the jambs."""
    hinge, strike, tip = door.points
    first, last = tip - hinge, strike - hinge
    begin = np.arctan2(first[1], first[0])
    turn = (np.arctan2(last[1], last[0]) - begin + np.pi) % (2 * np.pi) - np.pi
    radius = max(np.hypot(*first), np.hypot(*last)) + margin
    off_wall = min(1.0, margin / max(radius, 1e-9))  # radians: about a margin at the strike
    over = -np.sign(turn) * LEAF_THICKNESS  # begin outside the leaf
    angles = np.linspace(begin + over, begin + turn - np.sign(turn) * off_wall, 24)
    arc = hinge + radius * np.column_stack([np.cos(angles), np.sin(angles)])
    away = np.array([np.cos(begin), np.sin(begin)]) * margin  # off the wall at the hinge
    return np.rint(np.vstack([hinge + away, arc])).astype(np.int32)
