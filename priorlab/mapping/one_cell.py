"""One cell on its own: what n_free free and n_wall wall readings of it add up to."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from priorlab.core.checks import check_probability
from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap
from priorlab.core.log_odds import log_odds
from priorlab.core.readings import Evidence
from priorlab.core.sensor import RangeSensor

ONE_CELL = Grid(image_shape=(1, 1))
"""A building of one pixel."""


def one_cell_map(p_empty: float) -> GridMap:
    """A map of one cell that starts at P(empty) = `p_empty`, the effective prior.

    >>> one_cell_map(0.9).log_odds.round(4).tolist()
    [[2.1972]]
    """
    return GridMap(log_odds([[check_probability("p_empty", p_empty)]]), ONE_CELL)


def one_cell_evidence(seen_free: Sequence[bool], sensor: RangeSensor | None = None) -> Evidence:
    """S and n of one cell after some readings.

    Parameters
    ----------
    seen_free : for each reading True when the cell was seen free, False when it was seen as wall
    sensor : its inverse sensor model, eq. 4.22

    >>> evidence = one_cell_evidence([True, True, False])
    >>> evidence.total.round(4).tolist(), evidence.looks.tolist()      # one free reading is left over
    ([[2.1972]], [[3]])
    """
    sensor = sensor or RangeSensor()
    free = np.asarray(seen_free, dtype=bool)
    total = log_odds(np.where(free, sensor.p_free, sensor.p_occupied)).sum()
    return Evidence(np.array([[total]]), np.array([[free.size]]), ONE_CELL, sensor)
