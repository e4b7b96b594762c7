"""Walls as fine masks: the solid bodies, the ink that a drawing gives them, and what lies between their lines."""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.buildings.geometry import Points
from priorlab.buildings.layout import Layout
from priorlab.buildings.paper import FINER, fine_mask
from priorlab.buildings.parts import WallStyle


@dataclass(frozen=True, eq=False)
class WallMasks:
    """Fine masks, 4 x 4 per pixel.

    Parameters
    ----------
    bodies : per style, the solid wall without doors and windows
    ink : per style, what is drawn black (or in the style's colour)
    band : between the lines of hollow and hatched walls
    """

    bodies: dict[str, NDArray[np.bool_]]
    ink: dict[str, NDArray[np.bool_]]
    band: NDArray[np.bool_]

    @property
    def body(self) -> NDArray[np.bool_]:
        """All solid walls together."""
        return union(self.bodies)

    @property
    def all_ink(self) -> NDArray[np.bool_]:
        """All ink of walls together."""
        return union(self.ink)


def wall_bodies(layout: Layout, openings: list[Points]) -> dict[str, NDArray[np.bool_]]:
    """Per style, the solid walls of a layout with these gaps cut out; where two meet, the style that is named first wins."""
    taken = fine_mask(layout.frame, [_widened(gap) for gap in openings])
    bodies: dict[str, NDArray[np.bool_]] = {}
    for name in layout.description.styles:
        bodies[name] = fine_mask(layout.frame, [piece.outline for piece in layout.pieces if piece.style == name]) & ~taken
        taken |= bodies[name]
    return bodies


def wall_masks(layout: Layout, openings: list[Points]) -> WallMasks:
    """The walls of a layout with these gaps cut out, as a drawing shows them.

    Walls of one look and ink flow into each other; between others the outline goes on.
    """
    styles, bodies = layout.description.styles, wall_bodies(layout, openings)
    ink: dict[str, NDArray[np.bool_]] = {}
    band = np.zeros_like(next(iter(bodies.values())))
    for name, style in styles.items():
        if style.look in ("hollow", "hatched"):
            alike = {key: bodies[key] for key, other in styles.items() if (other.look, other.ink) == (style.look, style.ink)}
            inside = _eroded(union(alike), style.line) & bodies[name]
            ink[name] = bodies[name] & ~inside
            band |= inside
        else:
            ink[name] = bodies[name]
    return WallMasks(bodies, ink, band)


def hatching(band: NDArray[np.bool_], style: WallStyle, line: float, metres_per_pixel: float) -> NDArray[np.bool_]:
    """Parallel lines of `line` pixels within a band (fine mask)."""
    rows, cols = np.nonzero(band)
    angle = math.radians(style.hatch_angle)
    across = rows * round(math.cos(angle), 9) + cols * round(math.sin(angle), 9)  # rounded: the same on every machine
    step = max(2.0 * line, style.hatch / metres_per_pixel) * FINER
    lines = np.zeros_like(band)
    lines[rows, cols] = across % step < line * FINER
    return lines


def union(masks: dict[str, NDArray[np.bool_]]) -> NDArray[np.bool_]:
    """True where any mask is."""
    union = np.zeros_like(next(iter(masks.values())))
    for mask in masks.values():
        union |= mask
    return union


def _eroded(mask: NDArray[np.bool_], line: float) -> NDArray[np.bool_]:
    """What is left of a mask inside a rim of `line` pixels."""
    rim = max(1, round(line * FINER))
    kernel = np.ones((2 * rim + 1, 2 * rim + 1), np.uint8)
    return cv2.erode(mask.view(np.uint8), kernel, borderValue=0).astype(bool)


def _widened(gap: Points) -> Points:
    """A gap that surely cuts both faces of its wall: 1 mm deeper on either side."""
    across = (gap[3] - gap[0]) / np.linalg.norm(gap[3] - gap[0])
    return gap + 1e-3 * np.array([-across, -across, across, across])
