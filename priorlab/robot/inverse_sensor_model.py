"""The inverse sensor model: what one reading says about the cells in its cone (thesis 4.5.2, eq. 4.22).

A cell is seen when its centre lies inside the cone and not in the shadow behind an obstacle; then ALL its pixels count:
those nearer than the range along their bearing are in front of the obstacle, the others are not. Which cells behind the
obstacle are still seen is the sensor's `beyond`: "thickness" takes those whose centre lies at most a wall's thickness behind
the hit (and never less than half a cell, so that the cell that was hit is among them), "hit_cell" only the cell that was hit
(eq. 6.1), "all" the whole shadow. Along a bearing without a usable reading (`Readings.valid`) nothing is known: no cell whose
centre lies there is seen, and no pixel there counts.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.grid import Grid
from priorlab.core.progress import Progress
from priorlab.core.readings import Readings
from priorlab.core.sensor import RangeSensor

CANDIDATES_AT_ONCE = 250_000
"""Cells (and pixels) that are looked at in one go: enough for speed, little for memory."""

ON_THE_EDGE = 1e-9
"""A centre this close to the edge of what is seen (pixels) lies inside: symmetric cones see symmetric cells."""


class Looks(NamedTuple):
    """What some readings said: reading `reading[k]` gave P(empty) `p_empty[k]` to the cell with flat index `cell[k]`."""

    reading: NDArray[np.int64]
    cell: NDArray[np.int64]
    p_empty: NDArray[np.float64]


def inverse_sensor_model(n_front: ArrayLike, n_pixels: ArrayLike, sensor: RangeSensor) -> NDArray[np.float64]:
    """P(empty) of a cell of which `n_front` of `n_pixels` pixels lie in front of the obstacle, eq. 4.22.

    The share in front, clamped to [p_occupied, p_free]; the thesis's text says the opposite share, its formula this one.

    >>> inverse_sensor_model([9, 5, 0], 9, RangeSensor()).round(3).tolist()
    [0.9, 0.556, 0.1]
    """
    return np.clip(np.asarray(n_front) / np.asarray(n_pixels), sensor.p_occupied, sensor.p_free)


def observe(readings: Readings, grid: Grid, progress: Progress | None = None) -> Iterator[Looks]:
    """What readings say about the cells of `grid`, a batch of readings at a time, in their order; each pair occurs once.

    `progress` is called with the readings done and the readings to do.
    """
    rows, cols = grid.shape
    reach = readings.sensor.max_range / grid.cell_size
    batch = max(1, int(CANDIDATES_AT_ONCE // min((2 * reach + 2) ** 2, rows * cols)))
    for first in range(0, len(readings), batch):
        beams = _Beams(readings[first : first + batch])
        reading, row, col = _cells_in_cone(beams, grid)
        distance, measured = beams.polar(reading, *grid.cell_to_xy(np.stack([row, col], axis=-1)).T)
        seen = _seen(beams, reading, row, col, distance, measured, grid)
        reading, row, col, in_front = reading[seen], row[seen], col[seen], (distance < measured)[seen]
        share = in_front if grid.cell_size == 1 else _share_in_front(beams, reading, row, col, in_front, grid)
        yield Looks(first + reading, row * cols + col, inverse_sensor_model(share, 1.0, readings.sensor))
        if progress:
            progress(min(first + batch, len(readings)), len(readings))


class _Beams:
    """Readings with the ranges laid out for look-up."""

    def __init__(self, readings: Readings) -> None:
        order = np.argsort(readings.bearings)
        self.sensor = readings.sensor
        self.x, self.y, theta = readings.poses.T
        self.forward = np.stack([np.cos(theta), np.sin(theta)])
        self.bearings = readings.bearings[order]
        known = readings.ranges if readings.valid is None else np.where(readings.valid, readings.ranges, np.nan)
        self.ranges = known[:, order]  # nan: no reading; no comparison with it is ever true
        self.between = (self.bearings[1:] + self.bearings[:-1]) / 2  # a point belongs to the nearest bearing

    def polar(self, reading: NDArray, x: NDArray, y: NDArray) -> tuple[NDArray, NDArray]:
        """Distance of points from the robot, and the range measured along their bearing; nan where there is no reading."""
        dx, dy = x - self.x[reading], y - self.y[reading]
        cos, sin = self.forward[:, reading]
        bearing = np.arctan2(cos * dy - sin * dx, cos * dx + sin * dy)
        beam = np.searchsorted(self.between, bearing)
        return np.hypot(dx, dy), self.ranges[reading, beam]

    def hits(self) -> tuple[NDArray, NDArray]:
        """Reading and (2, M) points x, y a hair inside the obstacles that were met."""
        reading, beam = np.nonzero(self.ranges <= self.sensor.max_range)
        cos, sin = self.forward[:, reading]
        c, s = np.cos(self.bearings[beam]), np.sin(self.bearings[beam])
        far = self.ranges[reading, beam] + 1e-6
        return reading, np.stack([self.x[reading] + far * (cos * c - sin * s), self.y[reading] + far * (sin * c + cos * s)])


def _cells_in_cone(beams: _Beams, grid: Grid) -> tuple[NDArray, NDArray, NDArray]:
    """Reading, row and column of every cell whose centre lies in a reading's cone."""
    size, (rows, cols) = grid.cell_size, grid.shape
    x_low, x_high, y_low, y_high = _cone_box(beams)
    # centres at (col + 0.5) size and (rows - row - 0.5) size
    col_low = np.ceil(x_low / size - 0.5).clip(0).astype(np.int64)
    col_high = np.floor(x_high / size - 0.5).clip(max=cols - 1).astype(np.int64)
    row_low = (rows - 0.5 - np.floor(y_high / size - 0.5) - 0.5).clip(0).astype(np.int64)
    row_high = (rows - 0.5 - np.ceil(y_low / size - 0.5) - 0.5).clip(max=rows - 1).astype(np.int64)
    row = row_low[:, None] + np.arange(max(0, (row_high - row_low).max() + 1))  # (N, box rows)
    col = col_low[:, None] + np.arange(max(0, (col_high - col_low).max() + 1))  # (N, box columns)
    dx = (col + 0.5) * size - beams.x[:, None]
    dy = (rows - row - 0.5) * size - beams.y[:, None]
    cos, sin = beams.forward[:, :, None]
    distance = np.sqrt((dx * dx)[:, None, :] + (dy * dy)[:, :, None])
    ahead = (cos * dx)[:, None, :] + (sin * dy)[:, :, None]
    inside = distance <= beams.sensor.max_range + ON_THE_EDGE
    inside &= ahead >= distance * np.cos(beams.sensor.half_angle) - ON_THE_EDGE
    inside &= (row <= row_high[:, None])[:, :, None] & (col <= col_high[:, None])[:, None, :]
    reading, i, j = np.nonzero(inside)
    return reading, row[reading, i], col[reading, j]


def _cone_box(beams: _Beams) -> tuple[NDArray, NDArray, NDArray, NDArray]:
    """Lowest and highest x, and y, of each cone, with a pixel's edge to spare."""
    half, reach = beams.sensor.half_angle, beams.sensor.max_range
    theta = np.arctan2(beams.forward[1], beams.forward[0])

    def extent(direction: float) -> NDArray:
        """How far the cone reaches towards a direction."""
        off = np.abs((theta - direction + np.pi) % (2 * np.pi) - np.pi)  # angle between heading and direction
        return np.maximum(0.0, reach * np.cos(np.maximum(0.0, off - half))) + 1e-6

    return (
        beams.x - extent(np.pi),
        beams.x + extent(0.0),
        beams.y - extent(-np.pi / 2),
        beams.y + extent(np.pi / 2),
    )


def _seen(
    beams: _Beams, reading: NDArray, row: NDArray, col: NDArray, distance: NDArray, measured: NDArray, grid: Grid
) -> NDArray[np.bool_]:
    """Which cells of the cone are not in the shadow, by the sensor's reading of "beyond" and their centres' distance."""
    sensor = beams.sensor
    if sensor.beyond == "all":
        return ~np.isnan(measured)
    if sensor.beyond == "thickness":
        return distance <= measured + max(sensor.wall_thickness, grid.cell_size / 2) + ON_THE_EDGE
    rows, cols = grid.shape
    hit_reading, hit_xy = beams.hits()
    hit_row, hit_col = grid.xy_to_cell(hit_xy.T).T
    hit = np.isin((reading * rows + row) * cols + col, (hit_reading * rows + hit_row) * cols + hit_col)
    return (distance < measured) | (hit & ~np.isnan(measured))


def _share_in_front(
    beams: _Beams, reading: NDArray, row: NDArray, col: NDArray, centre_in_front: NDArray, grid: Grid
) -> NDArray[np.float64]:
    """Share of each cell's pixels that lie in front of the obstacle; a cell without a pixel is judged at its centre."""
    top, bottom = _borders(grid.row_of_pixel, grid.shape[0])
    left, right = _borders(grid.col_of_pixel, grid.shape[1])
    n_front = np.zeros(len(reading), dtype=np.int64)
    n_pixels = np.zeros(len(reading), dtype=np.int64)
    height = grid.image_shape[0]
    for i in range(int((bottom - top).max())):
        for j in range(int((right - left).max())):
            pixel_row, pixel_col = top[row] + i, left[col] + j
            exists = (pixel_row < bottom[row]) & (pixel_col < right[col])
            distance, measured = beams.polar(reading, pixel_col + 0.5, height - pixel_row - 0.5)
            n_front += exists & (distance < measured)
            n_pixels += exists & ~np.isnan(measured)
    return np.where(n_pixels > 0, n_front / np.maximum(n_pixels, 1), centre_in_front)


def _borders(cell_of_pixel: NDArray[np.int64], n_cells: int) -> tuple[NDArray, NDArray]:
    """First pixel of every cell along one side, and the pixel after its last."""
    edges = np.searchsorted(cell_of_pixel, np.arange(n_cells + 1))
    return edges[:-1], edges[1:]
