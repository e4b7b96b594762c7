"""How well a beam's end fits the map, worked out once for every cell (the field of algorithm 6.4).

A beam is likely when it ends near an obstacle: log(z_hit prob(dist, sigma_hit) + z_random / z_max). `dist` is measured to
the BOUNDARY of the occupied regions. Measured to the regions themselves it would be 0 all through a thick wall, and
particles would hide in there.
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
from priorlab.core.log_odds import log_odds, probability
from priorlab.slam.parameters import TUNED, Parameters

_LARGEST_SIDE = 32_766  # cv2.remap counts in 16 bits


def distance_to_boundary(occupied: NDArray[np.bool_], max_distance: float) -> NDArray[np.float32]:
    """Distance of every cell to the nearest boundary cell of an occupied region, in cells, at most `max_distance`.

    A boundary cell is occupied and has a free cell above, below, left or right; beyond the rim nothing is free.

    >>> thick = np.zeros((1, 8), bool); thick[0, 2:7] = True
    >>> distance_to_boundary(thick, 9).round(1).tolist()
    [[2.0, 1.0, 0.0, 1.0, 2.0, 1.0, 0.0, 1.0]]
    """
    filled = occupied.astype(np.uint8)
    inner = cv2.erode(filled, _CROSS, borderType=cv2.BORDER_CONSTANT, borderValue=1)
    not_boundary = 1 - (filled - inner)
    distance = cv2.distanceTransform(not_boundary, cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
    distance = np.sqrt(np.rint(np.square(distance)))  # squares of cells are whole; OpenCV's last digit hangs on the window
    return np.minimum(distance, np.float32(max_distance))


def obstacles_of(log_odds_map: NDArray[np.float64], parameters: Parameters = TUNED) -> NDArray[np.bool_]:
    """True where a cell is an obstacle: P(empty) below `parameters.occupied_below`; a cell on the threshold is none."""
    return log_odds_map < log_odds(parameters.occupied_below) - 1e-9


def log_likelihood_of(distance_m: NDArray, parameters: Parameters = TUNED) -> NDArray[np.float32]:
    """log(z_hit prob(dist, sigma_hit) + z_random / z_max) of algorithm 6.4; prob is the normalized Gaussian, z_max the range.

    >>> sure = Parameters(z_random=1e-9, sigma_hit_m=1.0)
    >>> round(log_likelihood_of(np.array(0.0), sure).item(), 4)             # the logarithm of 1 / sqrt(2 pi)
    -0.9189
    """
    sigma = parameters.sigma_hit_m
    hit = np.exp(-0.5 * np.square(distance_m / sigma)) / (sigma * math.sqrt(2 * math.pi))
    z_hit = 1.0 - parameters.z_random
    return np.log(z_hit * hit + parameters.z_random / parameters.max_range_m).astype(np.float32)


@dataclass(frozen=True, eq=False)
class LikelihoodField:
    """The logarithm of a beam's likelihood for an end in every cell.

    Parameters
    ----------
    image : (rows, cols) float32, row 0 at the top; `refresh` writes into it
    grid : the cells
    parameters : those that it was made with
    """

    image: NDArray[np.float32]
    grid: Grid
    parameters: Parameters

    @classmethod
    def of(cls, grid_map: GridMap, parameters: Parameters = TUNED) -> LikelihoodField:
        """The field of a map's obstacles, the cells with P(empty) below `parameters.occupied_below`.

        Raises
        ------
        ValueError
            When the map has no obstacle (an uninformed prior, or too high an effective p_wall), no scale, or too many cells.
        """
        check_record("grid_map", grid_map, GridMap)
        check_record("parameters", parameters, Parameters)
        if max(grid_map.grid.shape) > _LARGEST_SIDE:
            raise ValueError(f"a side of the map must be at most {_LARGEST_SIDE} cells for the field, got {grid_map.grid.shape}")
        field = cls(np.empty(grid_map.grid.shape, dtype=np.float32), grid_map.grid, parameters)
        if not field.occupied(grid_map.log_odds).any():
            lowest = probability(grid_map.log_odds.min())
            raise ValueError(
                f"the map must hold walls to localize in: cells with P(empty) below {parameters.occupied_below:g}, "
                f"got a lowest P(empty) of {lowest:.3g}"
            )
        field.refresh(grid_map.log_odds, slice(0, grid_map.grid.shape[0]), slice(0, grid_map.grid.shape[1]))
        return field

    def occupied(self, log_odds_map: NDArray[np.float64]) -> NDArray[np.bool_]:
        """`obstacles_of` the map, by the parameters that the field was made with."""
        return obstacles_of(log_odds_map, self.parameters)

    @property
    def far(self) -> float:
        """The log likelihood far from every obstacle, and of every end off the map."""
        return float(log_likelihood_of(np.array(self.parameters.max_distance_m), self.parameters))

    def copy(self) -> LikelihoodField:
        """A field of its own, for a map that will grow."""
        return LikelihoodField(self.image.copy(), self.grid, self.parameters)

    def refresh(self, log_odds_map: NDArray[np.float64], rows: slice, cols: slice) -> None:
        """Work the field out again where a change of the map in `rows`, `cols` can be felt; the rest stands.

        A change is felt up to the maximum distance away; to know the distance there, the obstacles as far again are needed.
        """
        cell_m = self.grid.cell_size_m
        reach = math.ceil(self.parameters.max_distance_m / cell_m)
        felt = grown(rows, cols, reach, self.grid.shape)
        needed = grown(rows, cols, 2 * reach, self.grid.shape)
        distance = distance_to_boundary(self.occupied(log_odds_map[needed]), self.parameters.max_distance_m / cell_m)
        inside = tuple(slice(f.start - n.start, f.stop - n.start) for f, n in zip(felt, needed, strict=True))
        self.image[felt] = log_likelihood_of(distance[inside] * cell_m, self.parameters)


_CROSS = cv2.getStructuringElement(cv2.MORPH_CROSS, (3, 3))


def grown(rows: slice, cols: slice, by: int, shape: tuple[int, int]) -> tuple[slice, slice]:
    """A window with `by` cells more on every side, cut at the rim."""
    row, col = (slice(max(side.start - by, 0), min(side.stop + by, n)) for side, n in zip((rows, cols), shape, strict=True))
    return row, col
