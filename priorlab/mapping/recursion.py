"""The update as the thesis writes it: one reading after the other, one cell after the other (eq. 2.15, 4.11).

This is the slow way, to be read and stepped through. `update_map` gives the same map in one array expression.
"""

from __future__ import annotations

from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap
from priorlab.core.log_odds import log_odds
from priorlab.core.readings import Readings
from priorlab.robot.inverse_sensor_model import observe


def one_step(previous: float, prior: float, p_empty: float, lam: float = 1.0) -> float:
    """The log odds of a cell after one more reading: l_k = logit(ISM) + l_{k-1} - lam l_0, eq. 2.15 and 4.11.

    Parameters
    ----------
    previous : l_{k-1}, log odds before the reading; the first time the prior
    prior : l_0, log odds of the prior
    p_empty : what the inverse sensor model says of the cell, eq. 4.22, in (0, 1)
    lam : 1 is the thesis's update, 0 leaves the prior in

    >>> from priorlab.core.log_odds import probability
    >>> l_0 = float(log_odds(0.8))
    >>> once = one_step(l_0, l_0, 0.9)                 # the first reading takes the prior's place
    >>> round(float(probability(once)), 3)
    0.9
    """
    return float(log_odds(p_empty)) + previous - lam * prior


def update_step_by_step(prior_map: GridMap, readings: Readings, lam: float = 1.0) -> GridMap:
    """The map after all readings, by the recursion: the thesis's algorithm 6.5 with known poses.

    Parameters
    ----------
    prior_map : where every cell starts
    readings : in the order in which they were taken
    lam : as in `one_step`
    """
    cells = prior_map.log_odds.copy()
    for k in range(len(readings)):
        for row, col, p_empty in cells_seen(readings, k, prior_map.grid):
            cells[row, col] = one_step(cells[row, col], prior_map.log_odds[row, col], p_empty, lam)
    return GridMap(cells, prior_map.grid, prior_map.prior)


def cells_seen(readings: Readings, k: int, grid: Grid) -> list[tuple[int, int, float]]:
    """Row, column and P(empty) of every cell that reading `k` saw."""
    n_cols = grid.shape[1]
    return [
        (int(cell) // n_cols, int(cell) % n_cols, float(p_empty))
        for looks in observe(readings[k : k + 1], grid)
        for cell, p_empty in zip(looks.cell, looks.p_empty, strict=True)
    ]
