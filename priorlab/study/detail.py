"""A detail: a piece cut out of a drawing, with the truth about it, small enough that a slider's move answers at once."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from priorlab.core.building import FloorPlan, Truth
from priorlab.core.drawing import Door, Drawing


@dataclass(frozen=True, eq=False)
class Detail:
    """A piece of a drawing.

    Parameters
    ----------
    drawing : the piece
    truth : of the piece; its doors are those that lie wholly inside
    left, top : where it was cut out, pixels, y down
    """

    drawing: Drawing
    truth: Truth
    left: int
    top: int

    def __repr__(self) -> str:
        height, width = self.drawing.shape
        return f"Detail({self.drawing.name}: {width} x {height} px, {len(self.truth.doors)} doors)"


def cut_detail(plan: FloorPlan, left: int, top: int, width: int, height: int) -> Detail:
    """Cut a rectangle out of a plan.

    Parameters
    ----------
    plan : the plan, whose truth is known
    left, top, width, height : of the rectangle, pixels, y down

    Raises
    ------
    ValueError
        When the rectangle does not lie on the drawing.
    """
    rows, cols = plan.drawing.shape
    if left < 0 or top < 0 or width < 1 or height < 1 or left + width > cols or top + height > rows:
        raise ValueError(
            f"the detail must lie on the drawing of {cols} x {rows} px, got left {left}, top {top}, {width} x {height} px"
        )
    here = np.s_[top : top + height, left : left + width]
    colour, truth = plan.drawing.colour, plan.truth
    return Detail(
        drawing=replace(plan.drawing, grey=plan.drawing.grey[here], colour=None if colour is None else colour[here]),
        truth=Truth(
            walls=truth.walls[here],
            ignore=truth.ignore[here],
            doors=tuple(moved for moved in (_moved(door, left, top) for door in truth.doors) if _is_inside(moved, width, height)),
            metres_per_pixel=truth.metres_per_pixel,
            windows=None if truth.windows is None else truth.windows[here],
        ),
        left=left,
        top=top,
    )


def _moved(door: Door, left: int, top: int) -> Door:
    """A door in the pixels of the detail."""
    hinge, strike, tip = ((float(x) - left, float(y) - top) for x, y in door.points)
    return replace(door, hinge=hinge, strike=strike, tip=tip)


def _is_inside(door: Door, width: int, height: int) -> bool:
    """True when all three points lie on the detail."""
    return bool(((door.points >= 0) & (door.points < [width, height])).all())
