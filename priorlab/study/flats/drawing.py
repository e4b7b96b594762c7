"""A flat of centre lines -> our drawing of it and its exact truth.

What the file does not say comes from a seed: which way doors open, line or rectangle leaves, thickness of walls, weight of
lines, dimension lines or none.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal

import numpy as np

from priorlab.buildings.floor_plans import draw_plan
from priorlab.buildings.parts import Compass, Description, Dimension, Sheet, Wall, WallStyle, WindowPart
from priorlab.core.building import Truth
from priorlab.core.drawing import Drawing
from priorlab.interchange.r2v import LineFlat
from priorlab.study.flats.furniture import furnish
from priorlab.study.flats.lines import Points, WallLine, with_closed_corners
from priorlab.study.flats.plan import DOOR_M, plan_of
from priorlab.study.flats.swings import hang_doors

Look = Literal["filled", "hollow", "hatched"]

LOOKS: tuple[Look, ...] = ("filled", "hollow", "hatched")

DOOR_PIXELS = 45
"""Width of the median swinging door in the drawing."""


def draw_flat(flat: LineFlat, look: Look, rng: np.random.Generator) -> tuple[Drawing, Truth]:
    """The drawing of a flat and its truth; windows are wall, the space between their lines is not counted."""
    return draw_plan(describe_flat(flat, look, rng))


def describe_flat(
    flat: LineFlat, look: Look, rng: np.random.Generator, thickness: Mapping[str, float] | None = None
) -> Description:
    """A flat as a description that `buildings` draws.

    Parameters
    ----------
    flat : lines in the pixels of its file
    look : of all its walls
    rng : for everything that the file does not say
    thickness : metres of an "outer", an "inner" wall and a "rail"; by chance when left out
    """
    by_chance = {"outer": float(rng.uniform(0.2, 0.3)), "inner": float(rng.uniform(0.11, 0.15)), "rail": 0.1}
    thickness = by_chance if thickness is None else thickness
    plan = plan_of(flat, thickness)
    free = plan.rooms.labels > 0
    doors = hang_doors(plan, free, rng)
    furniture, stairs, notes = furnish(plan, free, rng)
    line, hatch, angle = float(rng.uniform(1.4, 2.0)), float(rng.uniform(0.1, 0.16)), float(rng.choice([45.0, 135.0]))
    return Description(
        name=f"{flat.name}_{look}",
        metres_per_pixel=DOOR_M / DOOR_PIXELS,
        walls=tuple(Wall(wall.style, path=(_point(wall.start), _point(wall.end))) for wall in with_closed_corners(plan.walls)),
        styles={name: WallStyle(value, look, line=line, hatch=hatch, hatch_angle=angle) for name, value in thickness.items()},
        doors=tuple(doors),
        windows=tuple(WindowPart(_point(gap.middle), gap.width, max(1, round(gap.width / 0.9))) for gap in plan.windows),
        stairs=stairs,
        furniture=furniture,
        notes=notes,
        dimensions=tuple(_dimensions(plan.walls)) if rng.random() < 0.5 else (),
        sheet=Sheet(margins=(1.3, 1.3, 1.3, 1.3), line=float(rng.uniform(1.0, 1.4))),
    )


def _dimensions(walls: Sequence[WallLine], least: float = 0.8) -> list[Dimension]:
    """Chains over the outer walls, above and to the left; marks are at least so many metres apart."""
    outer = [wall for wall in walls if wall.style == "outer"] or list(walls)
    chains = []
    sides: tuple[tuple[Compass, int], ...] = (("north", 0), ("west", 1))
    for side, axis in sides:
        marks: list[float] = []
        for value in sorted(float(end[axis]) for wall in outer for end in (wall.start, wall.end)):
            if not marks or value - marks[-1] > least:
                marks.append(value)
        if len(marks) > 1:
            chains.append(Dimension(side, tuple(marks)))
    return chains


def _point(xy: Points) -> tuple[float, float]:
    """A point as a description has it."""
    return float(xy[0]), float(xy[1])
