"""The posterior map, in closed form (thesis eq. 2.15 and 4.11, summed over all readings)."""

from __future__ import annotations

from priorlab.core.checks import check_number, check_record
from priorlab.core.grid_map import GridMap
from priorlab.core.readings import Evidence
from priorlab.mapping.overruled import warn_when_overruled


def update_map(prior_map: GridMap, evidence: Evidence, lam: float = 1.0) -> GridMap:
    """The map after all readings: l = l_0 + S - lam n l_0.

    The recursion l_k = logit(ISM) + l_{k-1} - l_0 (eq. 4.11) starts at l_0 and takes l_0 off with every reading, so after n
    readings with the sum S it stands at l_0 + S - n l_0. A cell that was never seen (n = 0) keeps its prior.

    Parameters
    ----------
    prior_map : l_0 of every cell
    evidence : S and n of every cell, on the same grid
    lam : how much of l_0 each reading takes off: 1 is the thesis's update, 0 is Bayes' rule for a sensor model that was made
        with the prior 0.5

    Returns
    -------
    GridMap on the same grid

    Raises
    ------
    ValueError
        When map and evidence lie on different grids, or lam is not a finite number.

    Warns
    -----
    OverruledSensorWarning
        When the prior is so sure that a confirming reading carries no information (eq. 2.22).

    >>> import numpy as np
    >>> from priorlab.core.grid import Grid
    >>> from priorlab.core.log_odds import log_odds
    >>> from priorlab.core.sensor import RangeSensor
    >>> grid = Grid((1, 3))
    >>> prior_map = GridMap(np.full((1, 3), log_odds(0.8)), grid)
    >>> looks = np.array([[0, 1, 2]])                                     # never, once, twice seen free
    >>> evidence = Evidence(looks * log_odds(0.9), looks, grid, RangeSensor())
    >>> update_map(prior_map, evidence).p_empty.round(3).tolist()
    [[0.8, 0.9, 0.953]]
    """
    check_record("prior_map", prior_map, GridMap)
    check_record("evidence", evidence, Evidence)
    if prior_map.grid != evidence.grid:
        raise ValueError(f"map and evidence must lie on one grid, got {prior_map.grid} and {evidence.grid}")
    lam = check_number("lam", lam)
    warn_when_overruled(prior_map.prior, evidence.sensor.p_free, evidence.sensor.p_occupied, lam)
    l_0, total, looks = prior_map.log_odds, evidence.total, evidence.looks
    return GridMap(l_0 + total - lam * looks * l_0, prior_map.grid, prior_map.prior)
