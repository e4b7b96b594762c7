"""The buildings that the project ships, and a teacher's own: name or file -> `FloorPlan`."""

from __future__ import annotations

import functools
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from priorlab.buildings.description import read_description
from priorlab.buildings.layout import Layout, lay_out
from priorlab.buildings.paper import coverage, fine_mask
from priorlab.buildings.parts import Description
from priorlab.buildings.render import render
from priorlab.buildings.rooms import indoors, room_areas_m2, room_regions
from priorlab.buildings.survey import survey_of
from priorlab.buildings.tour import tour_of
from priorlab.buildings.truth import truth_of
from priorlab.buildings.wall_masks import wall_masks
from priorlab.buildings.world import world_of
from priorlab.core.building import FloorPlan, Truth
from priorlab.core.checks import check_positive
from priorlab.core.drawing import Drawing
from priorlab.core.shipped import data_folder, nearest_name

QUICK_SPACING = 0.3
"""Distance between the poses of the default survey, in sensor ranges: a quick one, 1.2 to 2.6 looks per seen cell."""

USUAL_REACH = 40.0
"""Range of the sensor that a building without doors is surveyed for, pixels."""


def floor_plan_names() -> list[str]:
    """Names of the buildings that the project ships.

    >>> "office_wing" in floor_plan_names()
    True
    """
    return sorted(path.stem for path in data_folder().glob("*.toml") if not path.stem.startswith("suite_"))


def load_floor_plan(name: str | Path, survey_spacing: float | None = None, tour_share: float = 1.0) -> FloorPlan:
    """A building with its drawing, its exact truth, its world, a survey and a tour.

    Parameters
    ----------
    name : a shipped building's name, or the path of an own description (a file that ends in .toml)
    survey_spacing : distance between the survey's poses, pixels; a quick survey when left out, a smaller one is denser
    tour_share : share of the stops that the tour visits: below 1 the exploration stays incomplete

    Raises
    ------
    ValueError
        For an unknown name (with the nearest match), or what is wrong with an own description.
    FileNotFoundError
        When there is no such file.

    >>> load_floor_plan("small_flat").truth.shape == load_floor_plan("small_flat").drawing.shape
    True
    """
    if str(name).endswith(".toml"):
        path = Path(name).resolve()
    else:
        path = data_folder() / f"{nearest_name('building', str(name), floor_plan_names())}.toml"
    changed = path.stat().st_mtime_ns if path.is_file() else 0
    return _load(path, changed, survey_spacing, float(tour_share))


@functools.lru_cache(maxsize=16)
def _load(path: Path, changed: int, survey_spacing: float | None, tour_share: float) -> FloorPlan:
    """Build once; an own file is built again when it has `changed`."""
    return build_floor_plan(read_description(path), survey_spacing, tour_share, path.stem)


def build_floor_plan(
    description: Description, survey_spacing: float | None = None, tour_share: float = 1.0, name: str | None = None
) -> FloorPlan:
    """Everything that follows from a description."""
    layout = lay_out(description)
    drawing, truth, solid = _draw(layout)
    world = world_of(layout)
    regions = room_regions(layout, solid)
    reach = sensor_range(truth)
    blocked = world.obstacles | truth.obstacles
    spacing = round(QUICK_SPACING * reach) if survey_spacing is None else check_positive("survey_spacing", survey_spacing)
    survey = survey_of(list(regions.values()), blocked, description.metres_per_pixel, reach, spacing)
    start, stops = _stops(layout)
    tour = tour_of(start, stops, world.obstacles | ~indoors(layout, solid), description.metres_per_pixel, tour_share)
    for array in (drawing.grey, truth.walls, truth.ignore, world.obstacles, survey, tour):
        array.setflags(write=False)  # they are shared by everybody who loads this building
    return FloorPlan(name or description.name, drawing, truth, world, survey, tour)


def draw_plan(description: Description) -> tuple[Drawing, Truth]:
    """Only the drawing and its truth: for drawings that nobody walks through."""
    drawing, truth, _ = _draw(lay_out(description))
    return drawing, truth


def _draw(layout: Layout) -> tuple[Drawing, Truth, NDArray[np.bool_]]:
    """The drawing, its truth, and (height, width) True on solid walls and windows."""
    shown = [door.opening.outline for door in layout.doors if not door.part.plan_shows_wall]
    panes = [window.opening.outline for window in layout.windows]
    walls = wall_masks(layout, shown + panes)
    solid = coverage(walls.body | fine_mask(layout.frame, panes)) >= 0.5
    areas_m2 = room_areas_m2(layout, room_regions(layout, solid))
    return render(layout, walls, areas_m2), truth_of(layout, walls), solid


def sensor_range(truth: Truth) -> float:
    """The range that the thesis takes for a plan: the length of a door's side, pixels; the middle one of all doors."""
    sides = [float(np.hypot(*(door.points[2] - door.points[0]))) for door in truth.doors]
    return round(float(np.median(sides)), 3) if sides else USUAL_REACH


def _stops(layout: Layout) -> tuple[tuple[float, float], list[tuple[str, tuple[float, float]]]]:
    """Where the tour starts, and the name and place of every stop, in pixels, y down."""
    rooms = layout.description.rooms
    if not rooms:
        raise ValueError(f"rooms must hold at least one room for the robot to stand in, got none in {layout.description.name!r}")
    first = next((room for room in rooms if room.name == layout.description.start), rooms[0])
    stops = [(room.name, _pixel(layout, point)) for room in rooms for point in (room.visit or (room.at,))]
    return _pixel(layout, (first.visit or (first.at,))[0]), stops


def _pixel(layout: Layout, point: tuple[float, float]) -> tuple[float, float]:
    """A point of the description in pixels, y down."""
    x, y = layout.frame.to_image(point)
    return float(x), float(y)
