"""A map for a robot that has none: it begins with a few cells and gets more where the robot looks beyond its rim."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import check_positive
from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap, Prior
from priorlab.slam.likelihood_field import LikelihoodField
from priorlab.slam.map_update import see_cells, update_seen
from priorlab.slam.parameters import Parameters
from priorlab.slam.scan import Scan

BLOCK_M = 5.0
"""A map grows by so much at least, so that it seldom does."""

LARGEST_SIDE = 32_766
"""Cells; OpenCV, which looks the field up, counts in 16 bits."""

MARGIN_M = 1.0
"""Room round all that was seen."""


class GrowingMap:
    """An occupancy map and its likelihood field; both change in place.

    Poses are in the frame of the log; `low` is where the lower left corner of the map lies in it.

    Parameters
    ----------
    parameters : of the map update and of the field
    cell_m : side of a cell, metres
    xy : where the first cells are to lie
    """

    def __init__(self, parameters: Parameters, cell_m: float, xy: NDArray[np.float64]) -> None:
        self.parameters, self.cell_m = parameters, check_positive("cell_m", cell_m)
        self._low_cell = np.floor(xy / self.cell_m).astype(np.int64)  # counted in cells, so that growing never rounds
        self.log_odds = np.zeros((1, 1))
        self.field = self._fresh_field()

    @property
    def low(self) -> NDArray[np.float64]:
        """(2,) x, y of the lower left corner in the frame of the log, metres."""
        return self._low_cell.astype(np.float64) * self.cell_m

    @property
    def map(self) -> GridMap:
        """The map as it is now; what nobody saw is 0.5."""
        return GridMap(self.log_odds.copy(), self.field.grid, Prior.uninformed())

    def trim(self) -> None:
        """Cut off what lies more than a metre beyond all that was seen."""
        rows, cols = (np.flatnonzero(self.log_odds.any(axis=axis)) for axis in (1, 0))
        if len(rows) == 0:
            return
        margin, (n_rows, n_cols) = math.ceil(MARGIN_M / self.cell_m), self.log_odds.shape
        top, bottom = max(rows[0] - margin, 0), min(rows[-1] + margin + 1, n_rows)
        left, right = max(cols[0] - margin, 0), min(cols[-1] + margin + 1, n_cols)
        self.log_odds = self.log_odds[top:bottom, left:right].copy()
        self._low_cell = self._low_cell + [left, n_rows - bottom]
        self.field = self._fresh_field()

    def into(self, poses: NDArray[np.float64]) -> NDArray[np.float64]:
        """Poses (..., 3) of the log's frame in the frame of the map."""
        return poses - [*self.low, 0.0]

    def insert(self, pose: NDArray[np.float64], scan: Scan) -> None:
        """Put a scan into the map, from a pose in the log's frame (algorithm 6.5 with nothing known before)."""
        x, y, theta = pose
        cos, sin = math.cos(theta), math.sin(theta)
        ends = scan.points @ np.array([[cos, sin], [-sin, cos]]) + [x, y]
        self._make_room(np.vstack([pose[:2], ends]))
        seen = see_cells(self.field.grid, self.into(pose), scan, self.parameters)
        nothing_known = np.broadcast_to(0.0, self.log_odds.shape)  # takes no memory
        update_seen(self.log_odds, nothing_known, seen, self.parameters)
        self.field.refresh(self.log_odds, seen.rows, seen.cols)

    def _make_room(self, xy: NDArray[np.float64]) -> None:
        """More cells, so that (N, 2) points of the log's frame lie on the map, a metre from its rim."""
        rows, cols = self.log_odds.shape
        margin, block = math.ceil(MARGIN_M / self.cell_m), math.ceil(BLOCK_M / self.cell_m)
        cells = np.floor(xy / self.cell_m).astype(np.int64)
        lacks_low = self._low_cell - (cells.min(axis=0) - margin)
        lacks_high = cells.max(axis=0) + margin + 1 - (self._low_cell + [cols, rows])
        left, below = np.where(lacks_low > 0, np.maximum(lacks_low, block), 0)
        right, above = np.where(lacks_high > 0, np.maximum(lacks_high, block), 0)
        if left or below or right or above:
            shape = int(rows + below + above), int(cols + left + right)
            if max(shape) > LARGEST_SIDE:
                raise ValueError(
                    f"a side of the map must be at most {LARGEST_SIDE} cells of {self.cell_m:g} m, got {max(shape)}: "
                    "does the odometry leap?"
                )
            self.log_odds = np.pad(self.log_odds, ((above, below), (left, right)))
            self._low_cell = self._low_cell - [left, below]
            self.field = self._fresh_field()

    def _fresh_field(self) -> LikelihoodField:
        """The field of the map as it is, which may be empty."""
        shape = self.log_odds.shape
        field = LikelihoodField(np.empty(shape, dtype=np.float32), Grid(shape, 1, self.cell_m), self.parameters)
        field.refresh(self.log_odds, slice(0, shape[0]), slice(0, shape[1]))
        return field
