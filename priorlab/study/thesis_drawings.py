"""The five drawings of chapters 4 and 5, ours: two flats and three sections of an office building, all with thin walls.

A sensor that looks 4 pixels into a wall sees the whole of these walls, from one room or from the other. So a map without a
plan can become as good as one with it, and more looks can turn the gain of a prior round. In the other bundled buildings the
inside of thick walls is never seen and the plan always pays.
"""

from __future__ import annotations

from priorlab.buildings.floor_plans import load_floor_plan, sensor_range
from priorlab.core.building import FloorPlan
from priorlab.core.sensor import RangeSensor

THESIS_DRAWINGS = ("flat_north", "flat_south", "office_section_a", "office_section_b", "office_section_c")
"""In the order of the thesis's drawings a to e (fig. 4.3 and 4.4)."""

QUICK, THOROUGH, DENSE, FINEST = 1.2, 0.3, 0.1, 0.05
"""Distance between the poses of a survey in sensor ranges: about 1.2, 2.3, 6 and 12 looks at a seen cell."""


def thesis_plan(name: str, spacing: float = THOROUGH) -> FloorPlan:
    """One of the buildings, with a survey as dense as that.

    Parameters
    ----------
    name : of any bundled building
    spacing : between the poses, in sensor ranges: `QUICK`, `THOROUGH`, `DENSE`, `FINEST` or any other

    >>> len(thesis_plan("flat_north", QUICK).survey) < len(thesis_plan("flat_north", DENSE).survey) / 5
    True
    """
    plan = load_floor_plan(name)
    return load_floor_plan(name, survey_spacing=spacing * sensor_range(plan.truth))


def sensor_for(plan: FloorPlan, p_free: float = 0.9, p_occupied: float = 0.1) -> RangeSensor:
    """The sensor that the thesis takes for a drawing: it reaches as far as a door is wide (thesis 4.5.2).

    >>> sensor_for(load_floor_plan("flat_north")).max_range
    36.0
    """
    return RangeSensor(max_range=sensor_range(plan.truth), p_free=p_free, p_occupied=p_occupied)
