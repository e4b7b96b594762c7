"""Algorithm 6.5: what one scan from one pose says about the map (eq. 6.1), and the update of the log odds (eq. 6.2)."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.core.grid import Grid
from priorlab.core.log_odds import log_odds
from priorlab.slam.parameters import TUNED, Parameters
from priorlab.slam.scan import Scan

UNSEEN, FREE, OCCUPIED = 0, 1, 2

MOST_CELLS = 10**9
"""The window that a scan's rays span, a byte for each: 1.5 km at cells of 0.05 m."""


@dataclass(frozen=True, eq=False)
class SeenCells:
    """A window of the map and what a scan says about each cell in it.

    Parameters
    ----------
    rows, cols : the window
    labels : uint8, `UNSEEN`, `FREE` or `OCCUPIED`
    """

    rows: slice
    cols: slice
    labels: NDArray[np.uint8]


def see_cells(grid: Grid, pose: NDArray[np.float64], scan: Scan, parameters: Parameters = TUNED) -> SeenCells:
    """The cells in the perceptual field of a scan (eq. 6.1): free up to the hit, occupied from the hit to `thickening_m` behind.

    Rays go from cell to cell as Bresenham has it. A cell is updated once per scan, however many beams cross it, and occupied
    wins over free. Beams without a return say nothing, unless `free_on_no_return`.

    Parameters
    ----------
    grid : the map's cells
    pose : (3,) x, y, theta of the robot; metres
    scan : the beams

    Raises
    ------
    ValueError
        When the rays are so long that their cells would not fit into memory.
    """
    x, y, theta = pose
    cos, sin = np.cos(theta), np.sin(theta)
    dx, dy = scan.offset
    eye = np.array([x + dx * cos - dy * sin, y + dx * sin + dy * cos])
    hits = _along(eye, theta + scan.bearings, scan.ranges)
    behind = _along(eye, theta + scan.bearings, scan.ranges + parameters.thickening_m)
    if parameters.free_on_no_return:
        open_ends = _along(eye, theta + scan.open_bearings, np.full(len(scan.open_bearings), parameters.max_range_m))
    else:
        open_ends = np.empty((0, 2))

    cells = grid.xy_to_cell(grid.metres_to_xy(np.vstack([eye, hits, behind, open_ends])))
    first = cells.min(axis=0)  # the window may stick out of the map: a ray cut at the rim would take other cells
    window = cells.max(axis=0) - first + 1
    if window[0] * float(window[1]) > MOST_CELLS:
        raise ValueError(
            f"max_range_m and thickening_m must let a scan reach over at most {MOST_CELLS:,} cells, got {window[0]:,} x "
            f"{window[1]:,} from ranges of up to {np.max(scan.ranges, initial=0.0):g} m"
        )
    labels = np.zeros(window, dtype=np.uint8)
    points = (cells - first)[:, ::-1].astype(np.int32)  # cv2 wants col, row
    n = len(scan)
    eye_cell, hit_cells, behind_cells, open_cells = points[:1], points[1 : n + 1], points[n + 1 : 2 * n + 1], points[2 * n + 1 :]
    _draw(labels, np.broadcast_to(eye_cell, open_cells.shape), open_cells, FREE)
    _draw(labels, np.broadcast_to(eye_cell, hit_cells.shape), hit_cells, FREE)
    _draw(labels, hit_cells, behind_cells, OCCUPIED)  # after the free ones: occupied wins

    low = np.clip(first, 0, grid.shape)
    high = np.clip(first + labels.shape, low, grid.shape)
    inside = labels[low[0] - first[0] : high[0] - first[0], low[1] - first[1] : high[1] - first[1]]
    return SeenCells(slice(int(low[0]), int(high[0])), slice(int(low[1]), int(high[1])), inside)


def update_seen(
    log_odds_map: NDArray[np.float64], prior_log_odds: NDArray[np.float64], seen: SeenCells, parameters: Parameters = TUNED
) -> None:
    """l_{k,i} = logit(ISM) + l_{k-1,i} - lam l_{0,i} for the cells that were seen (eq. 6.2); writes into `log_odds_map`.

    "p_previous" of eq. 6.1 means that a cell behind the hit is left alone.
    """
    log_odds_map[seen.rows, seen.cols] += change_of(seen, prior_log_odds, parameters)


def change_of(seen: SeenCells, prior_log_odds: NDArray[np.float64], parameters: Parameters = TUNED) -> NDArray[np.float64]:
    """logit(ISM) - lam l_{0,i} for the cells of the window (eq. 6.2), 0 for those that were not seen."""
    said = np.zeros(3)
    said[FREE], said[OCCUPIED] = log_odds([parameters.p_free, parameters.p_occupied])
    looked = (seen.labels != UNSEEN).astype(np.float64)
    return said[seen.labels] - parameters.lam * looked * prior_log_odds[seen.rows, seen.cols]  # eq. 6.2


def _along(eye: NDArray, angles: NDArray, ranges: NDArray) -> NDArray[np.float64]:
    """(B, 2) ends of rays, metres."""
    return eye + ranges[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])


def _draw(labels: NDArray[np.uint8], starts: NDArray, ends: NDArray, value: int) -> None:
    """Straight lines of cells from every start to its end."""
    cv2.polylines(labels, list(np.stack([starts, ends], axis=1)), isClosed=False, color=value)
