"""What lies outside a building that is known: where something much wider than a door can come from the edge of the drawing."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from priorlab.core.building import Truth, World
from priorlab.robot.free_space import draw_sills, swept_from_outside

WIDEST_OPENING = 2.0
"""Openings in the outer wall are at most so many door widths wide; with a wider one nobody can tell in from out."""


def outdoors(building: Truth | World) -> NDArray[np.bool_] | None:
    """The free pixels outside a building, (height, width), or None when nobody can tell.

    Only a truth with doors says how wide an opening may be: of a world, or of walls without doors, nobody can tell.

    >>> walls = np.pad(np.zeros((3, 3), dtype=bool), 1, constant_values=True)
    >>> outdoors(Truth(np.pad(walls, 1), np.zeros((7, 7), dtype=bool))) is None
    True
    """
    if isinstance(building, World) or not building.doors:
        return None
    shut = building.obstacles | draw_sills(building.shape, building.doors)
    gap = WIDEST_OPENING * float(np.median([door.width for door in building.doors]))
    return swept_from_outside(shut, gap) & ~shut
