"""The likelihood field of the map that grows, some way behind the robot.

Most of what a robot sees was written by its own last scans. When it localizes in them, it agrees with itself: an error of
heading becomes the map, and the next scan confirms it. So a scan waits until the robot has left the place where it was taken.
"""

from __future__ import annotations

from collections import deque

import numpy as np
from numpy.typing import NDArray

from priorlab.slam.likelihood_field import LikelihoodField
from priorlab.slam.map_update import SeenCells, update_seen
from priorlab.slam.parameters import Parameters


class LaggingField:
    """A map without the scans of the last `parameters.lag_m` metres, and its likelihood field; 0 lags by none, as printed.

    Parameters
    ----------
    plan : the field of m_0
    prior_log_odds : (rows, cols) m_0
    parameters : `lag_m`, and those of the update

    Attributes
    ----------
    field : of the map as far as it has come; `add` writes into it
    """

    def __init__(self, plan: LikelihoodField, prior_log_odds: NDArray[np.float64], parameters: Parameters) -> None:
        self.field = plan.copy()
        self._log_odds, self._prior, self._parameters = prior_log_odds.copy(), prior_log_odds, parameters
        self._waiting: deque[tuple[float, SeenCells]] = deque()

    def add(self, seen: SeenCells, way_m: float) -> None:
        """Take what a scan saw after `way_m` metres of way, and put those scans into the map that the robot has left behind."""
        self._waiting.append((way_m, seen))
        while self._waiting and self._waiting[0][0] <= way_m - self._parameters.lag_m:
            _, left = self._waiting.popleft()
            update_seen(self._log_odds, self._prior, left, self._parameters)
            self.field.refresh(self._log_odds, left.rows, left.cols)
