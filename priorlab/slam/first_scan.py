"""A start without any plan: what the robot sees from where it was put down is all that it can localize in."""

from __future__ import annotations

import numpy as np

from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.readings import RobotLog
from priorlab.slam.map_update import OCCUPIED, see_cells, update_seen
from priorlab.slam.parameters import TUNED, Parameters
from priorlab.slam.scan import choose_beams


def map_of_first_scan(grid: Grid, log: RobotLog, parameters: Parameters = TUNED) -> GridMap:
    """A map at 0.5 everywhere but for the first scan that met something, drawn from `log.start`.

    Without a plan a map is empty at first, and in an empty map nobody can localize. Run it with `localize_in="updated"` and
    `lam=0`, so that the scan counts as a scan and not as a prior.

    Parameters
    ----------
    grid : the cells that the map will have
    log : its first scans are taken from `start`; the robot must not have moved on before one of them met something
    parameters : of the map

    Raises
    ------
    ValueError
        When no scan met anything before the robot had moved.
    """
    moved = np.abs(log.odometry - log.odometry[0]).max(axis=1) > 0
    for k in range(int(moved.argmax()) if moved.any() else len(log)):
        scan = choose_beams(log, k, parameters)
        seen = see_cells(grid, log.start, scan, parameters)
        if (seen.labels == OCCUPIED).any():
            first = np.zeros(grid.shape)
            update_seen(first, np.zeros(grid.shape), seen, parameters)
            return GridMap(first, grid, Prior.uninformed())
    raise ValueError("the first scan must meet an obstacle to start a map without a plan, got none before the robot moved")
