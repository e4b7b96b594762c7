"""Where the plan lets no robot drive: the motion model with a map (Thrun, Burgard, Fox 2005, section 5.5).

Wheels say nothing of walls: algorithm 6.3 moves particles straight through them. But the map speaks of the robot's place as well
as of its beams,

    p(x_k | u_k, x_{k-1}, m) ~ p(x_k | u_k, x_{k-1}) p(x_k | x_{k-1}, m),

where p(x_k | x_{k-1}, m) is 1, but `p_through_wall` for a step that takes the robot into a wall of the plan. A particle that
drives through a doorway keeps its weight, one that drives into the wall beside it loses nine tenths. Not all of it: the plan may
wall up a doorway that is there. Then every particle near the truth pays the same, once, and nothing is lost.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import check_record
from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap
from priorlab.slam.likelihood_field import obstacles_of
from priorlab.slam.parameters import TUNED, Parameters


@dataclass(frozen=True, eq=False)
class Impassable:
    """The cells where the centre of a robot cannot be, by the plan.

    Parameters
    ----------
    cells : (rows, cols) bool, row 0 at the top; True within `robot_radius_m` of an obstacle, centre to centre
    grid : the cells
    p_through_wall : the share of its weight that a particle keeps when it drives into one of them
    """

    cells: NDArray[np.bool_]
    grid: Grid
    p_through_wall: float

    @classmethod
    def of(cls, grid_map: GridMap, parameters: Parameters = TUNED) -> Impassable:
        """The cells in and near a map's obstacles, those with P(empty) below `parameters.occupied_below`."""
        check_record("grid_map", grid_map, GridMap)
        check_record("parameters", parameters, Parameters)
        free = ~obstacles_of(grid_map.log_odds, parameters)
        far = cv2.distanceTransform(free.astype(np.uint8), cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
        reach = parameters.robot_radius_m / grid_map.grid.cell_size_m
        return cls(np.square(far) <= reach**2 + 1e-3, grid_map.grid, parameters.p_through_wall)  # squares of cells are whole

    def holds(self, poses: NDArray[np.float64]) -> NDArray[np.bool_]:
        """(N,) True where one of the (N, 3) `poses` stands in such a cell; off the map there are none."""
        xy = self.grid.metres_to_xy(poses[:, :2])
        on_map = self.grid.contains(xy)
        rows, cols = self.grid.xy_to_cell(np.where(on_map[:, None], xy, 0.0)).T
        return on_map & self.cells[rows, cols]

    def log_weights(self, before: NDArray[np.float64], after: NDArray[np.float64]) -> NDArray[np.float64]:
        """(N,) log p(x_k | x_{k-1}, m): 0, or log(p_through_wall) where a step from free ground ends in a wall.

        Parameters
        ----------
        before, after : (N, 3) the particles before and after a step; metres
        """
        entered = self.holds(after)
        entered[entered] = ~self.holds(before[entered])
        return np.where(entered, math.log(self.p_through_wall), 0.0)
