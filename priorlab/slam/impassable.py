"""Where the plan lets no robot drive: a motion model with a map, after Thrun, Burgard and Fox 2005, section 5.5.

Wheels say nothing of walls: algorithm 6.3 moves particles straight through them. But the map speaks of the robot's place as well
as of its beams, p(x_k | u_k, x_{k-1}, m) = eta p(x_k | u_k, x_{k-1}) p(x_k | m): a pose in a wall is not likely. What stands here
differs from the book in two ways.

- Only the way INTO a wall counts, p(x_k | x_{k-1}, m): `p_through_wall` for a step from free ground into a wall, else 1. A plan
  may wall up a doorway that is there; all particles near the truth then pay the same within a few steps, and nothing is lost but
  a few centimetres for as long as they are inside.
- eta is left out, so the factor weighs particles against one another as a reading does: one that comes through a doorway keeps
  its weight, one that drives into the wall beside it loses nine tenths.

Walls that are widened by the robot's radius are what planners call inflated obstacles. Only where a step ends is looked at, as in
the book: over steps longer than a wall is thick, radius and all (about 0.4 m), a particle can leap over one.
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
    cells : (rows, cols) bool, row 0 at the top; True within `robot_radius_m` of an obstacle, centre of cell to centre: a radius
        smaller than a cell adds nothing to the walls
    grid : the cells
    p_through_wall : the share of its weight that a particle keeps when it drives into one of them

    Notes
    -----
    A particle that begins in such a cell pays when it comes back to one, not before.
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
        squares = np.rint(np.square(far))  # of cells, so they are whole
        return cls(squares <= reach**2 + 1e-6, grid_map.grid, parameters.p_through_wall)

    def holds(self, poses: NDArray[np.float64]) -> NDArray[np.bool_]:
        """(N,) True where one of the (N, 3) `poses` stands in such a cell; off the map there are none."""
        return self.grid.at_metres(self.cells, poses, outside=False)

    def log_weights(self, before: NDArray[np.float64], after: NDArray[np.float64]) -> NDArray[np.float64]:
        """(N,) log p(x_k | x_{k-1}, m): 0, or log(p_through_wall) where a step from free ground ends in a wall.

        Parameters
        ----------
        before, after : (N, 3) the particles before and after a step; metres
        """
        entered = self.holds(after)
        entered[entered] = ~self.holds(before[entered])
        return np.where(entered, math.log(self.p_through_wall), 0.0)
