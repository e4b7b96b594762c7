"""The prior map: what the extracted walls make us believe before the robot has moved (thesis 4.2)."""

from __future__ import annotations

import numpy as np

from priorlab.core.checks import check_positive, check_record
from priorlab.core.drawing import Walls
from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.log_odds import log_odds


def build_prior_map(
    walls: Walls, prior: Prior | None = None, cell_size: float | None = None, cell_size_m: float | None = None
) -> GridMap:
    """Give every cell its prior log odds l_0: low where the plan shows a wall, high where it shows space.

    A cell counts as wall when any of its pixels is wall.

    Parameters
    ----------
    walls : extracted from a drawing
    prior : the two probabilities; `Prior()` by default. `Prior.uninformed()` gives exactly 0.5 everywhere
    cell_size : side of a cell, pixels; 1 when no size is given
    cell_size_m : the same in metres, for a drawing whose scale is known; only one of the two

    Returns
    -------
    GridMap of natural log odds of P(empty)

    Raises
    ------
    ValueError
        When both sizes are given, a size is not positive or exceeds the drawing, or metres are asked of a drawing
        without a scale.

    >>> walls = Walls(np.array([[0, 0, 0, 1], [0, 0, 0, 0]], dtype=np.uint8))
    >>> build_prior_map(walls, Prior(p_wall=0.2, p_space=0.9), cell_size=2).p_empty.round(2).tolist()
    [[0.81, 0.18]]
    """
    prior = Prior() if prior is None else prior
    check_record("walls", walls, Walls)
    check_record("prior", prior, Prior)
    grid = _grid_over(walls, cell_size, cell_size_m)
    at_wall, at_space = log_odds([prior.effective_p_wall, prior.effective_p_space])
    return GridMap(np.where(grid.any_in_cells(walls.mask), at_wall, at_space), grid, prior)


def _grid_over(walls: Walls, cell_size: float | None, cell_size_m: float | None) -> Grid:
    """The grid of the size asked for, in pixels or metres."""
    if cell_size is not None and cell_size_m is not None:
        raise ValueError(f"only one of cell_size and cell_size_m may be given, got {cell_size:g} px and {cell_size_m:g} m")
    if cell_size_m is None:
        return Grid(walls.shape, 1 if cell_size is None else cell_size, walls.metres_per_pixel)
    size_m = check_positive("cell_size_m", cell_size_m)
    scale = Grid(walls.shape, 1, walls.metres_per_pixel).scale  # a sentence when it is not known
    height_m, width_m = (side * scale for side in walls.shape)
    if size_m > min(height_m, width_m):
        raise ValueError(f"cell_size_m must not exceed the drawing's {width_m:.4g} x {height_m:.4g} m, got {size_m:g}")
    return Grid(walls.shape, round(size_m / scale, 9), scale)  # 0.15 / 0.05 is 3, not 2.9999999999999996
