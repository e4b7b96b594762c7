"""Priors of every quality for one building, by name: from the true walls to one number for everything (thesis 2.3.5, 5.2.3)."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache

import numpy as np

from priorlab.buildings.floor_plans import load_floor_plan
from priorlab.core.drawing import Walls
from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.shipped import nearest_name
from priorlab.drawing.extraction import Extraction, extract_walls
from priorlab.drawing.method import ROBUST, Method
from priorlab.mapping.other_priors import CLUTTERED, EMPTY, constant_prior, dark_pixels, non_white_pixels
from priorlab.mapping.prior import build_prior_map
from priorlab.study.damaged_walls import poor, with_extra_wall, without_parts

FEW, MANY = 0.3, 0.7
"""Shares of the wall pixels that an incomplete plan lacks: building sections, and a large number of walls."""


@lru_cache(maxsize=32)
def extracted(name: str, method: Method = ROBUST) -> Extraction:
    """The walls of a bundled building, extracted once."""
    return extract_walls(load_floor_plan(name).drawing, method)


def _true_walls(name: str, rng: np.random.Generator) -> Walls:
    """What a perfect extraction would find: the truth's walls, those that do not count included."""
    truth = load_floor_plan(name).truth
    return Walls(truth.obstacles.astype(np.uint8), truth.metres_per_pixel, f"{name}, true walls")


_WALLS: Mapping[str, Callable[[str, np.random.Generator], Walls]] = {
    "extracted": lambda name, rng: extracted(name).walls,
    "true walls": _true_walls,
    "30 % missing": lambda name, rng: without_parts(extracted(name).walls, FEW, rng),
    "70 % missing": lambda name, rng: without_parts(extracted(name).walls, MANY, rng),
    "poor": lambda name, rng: poor(extracted(name).walls, rng),
    "a wall too many": lambda name, rng: with_extra_wall(extracted(name).walls, rng),
    "drawing as it is": lambda name, rng: dark_pixels(load_floor_plan(name).drawing),
    "every non-white pixel": lambda name, rng: non_white_pixels(load_floor_plan(name).drawing),
}
_CONSTANT = {"0.3 everywhere": CLUTTERED, "0.8 everywhere": EMPTY}

QUALITIES = (*_WALLS, *_CONSTANT)
"""Names of all priors that are compared."""


def walls_of_quality(name: str, quality: str, rng: np.random.Generator) -> Walls:
    """The walls that a prior of that quality is made of.

    Raises
    ------
    ValueError
        For a quality that is not known, or one number for all cells, which has no walls.
    """
    return _WALLS[nearest_name("quality of walls", quality, list(_WALLS))](name, rng)


def prior_of_quality(name: str, quality: str, grid: Grid, prior: Prior, rng: np.random.Generator) -> GridMap:
    """The prior map of a building.

    Parameters
    ----------
    name : of a bundled building
    quality : one of `QUALITIES`
    grid : its cells
    prior : p_wall and p_space; one number for all cells does without
    rng : draws the damage
    """
    nearest_name("quality", quality, list(QUALITIES))
    if quality in _CONSTANT:
        return constant_prior(_CONSTANT[quality], grid)
    return build_prior_map(walls_of_quality(name, quality, rng), prior, grid.cell_size)
