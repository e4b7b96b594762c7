"""Evidence: all that readings say about every cell, in one pass and whatever the prior (method: S and n of the closed form)."""

from __future__ import annotations

import numpy as np

from priorlab.core.checks import check_record
from priorlab.core.grid import Grid
from priorlab.core.log_odds import log_odds
from priorlab.core.progress import Progress
from priorlab.core.readings import Evidence, Readings
from priorlab.robot.inverse_sensor_model import observe


def gather_evidence(readings: Readings, grid: Grid, progress: Progress | None = None) -> Evidence:
    """Sum what readings say about every cell of a grid.

    For each cell, S = sum of logit(InverseSensorModel) over its readings (eq. 2.15, 4.22) and n = their number. The order of
    the readings does not matter; evidence of two sets of readings adds up, and subtracts again.

    Parameters
    ----------
    readings : ranges from known poses, in pixels; they carry their sensor
    grid : cells of any size over the same drawing, usually `prior_map.grid`
    progress : called with the readings done and the readings to do

    Returns
    -------
    Evidence with total S and looks n, (rows, cols) each. No readings are no evidence.

    Raises
    ------
    ValueError
        When the readings were taken on a drawing of another shape, or a pose lies off the map.

    >>> from priorlab.core.sensor import RangeSensor
    >>> sensor = RangeSensor(max_range=3, half_angle=0.1)
    >>> ahead = Readings([[0.5, 0.5, 0.0]], [[2.0]], [0.0], sensor, image_shape=(1, 6))
    >>> evidence = gather_evidence(ahead, Grid((1, 6)))
    >>> evidence.looks.tolist()
    [[1, 1, 1, 1, 0, 0]]
    >>> evidence.total.round(1).tolist()
    [[2.2, 2.2, -2.2, -2.2, 0.0, 0.0]]
    """
    check_fit(readings, grid)
    rows, cols = grid.shape
    total = np.zeros(rows * cols)
    looks = np.zeros(rows * cols, dtype=np.int64)
    for seen in observe(readings, grid, progress):
        np.add.at(total, seen.cell, log_odds(seen.p_empty))  # costs what was seen, however large the map
        np.add.at(looks, seen.cell, 1)
    return Evidence(total.reshape(rows, cols), looks.reshape(rows, cols), grid, readings.sensor)


def check_fit(readings: Readings, grid: Grid) -> None:
    """Say when readings and grid do not belong to one drawing."""
    check_record("readings", readings, Readings)
    check_record("grid", grid, Grid)
    if tuple(readings.image_shape) != grid.image_shape:
        raise ValueError(f"readings and grid must have one image shape, got {tuple(readings.image_shape)} and {grid.image_shape}")
    outside = np.flatnonzero(~grid.contains(readings.poses))
    if outside.size:
        x, y = readings.poses[outside[0], :2]
        height, width = grid.image_shape
        raise ValueError(f"poses must lie on the map of {width} x {height} pixels, got x, y = {x:g}, {y:g} in row {outside[0]}")
