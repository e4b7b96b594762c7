"""Layout -> world: what a robot would meet there today."""

from __future__ import annotations

import numpy as np

from priorlab.buildings.geometry import Points
from priorlab.buildings.layout import Layout, PlacedDoor, footprints
from priorlab.buildings.paper import coverage, fine_mask
from priorlab.buildings.symbols_openings import LEAF, bar, folded
from priorlab.buildings.wall_masks import union, wall_bodies
from priorlab.core.building import World


def world_of(layout: Layout) -> World:
    """Solid walls and windows, stairs, all furniture (also what only the world holds), and door leaves as far open as said.

    Doorways that the plan walls up are open here.
    """
    gaps = [door.opening.outline for door in layout.doors] + [window.opening.outline for window in layout.windows]
    solid = union(wall_bodies(layout, gaps))
    things = [window.opening.outline for window in layout.windows]
    for piece in (*layout.furniture, *layout.stairs):
        things += footprints(piece)
    for door in layout.doors:
        things += _leaf_outlines(door, max(LEAF, 1.5 * layout.frame.metres_per_pixel))
    solid |= fine_mask(layout.frame, things)
    return World(coverage(solid) >= 0.5, layout.frame.metres_per_pixel)


def _leaf_outlines(door: PlacedDoor, thickness: float) -> list[Points]:
    """Slim rectangles where the leaves stand; a leaf of 1.5 pixels or more has no gap in the picture."""
    outlines = []
    for leaf in door.leaves:
        path = folded(leaf) if door.part.kind == "folding" else np.array([leaf.hinge, leaf.tip(door.part.open)])
        for start, end in zip(path, path[1:], strict=False):
            length = float(np.linalg.norm(end - start))
            outlines.append(bar((start + end) / 2, (end - start) / length, length, thickness))
    return outlines
