"""Where the readings contradict the plan: walls that are not there, obstacles that the plan does not show."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap
from priorlab.core.readings import Evidence


@dataclass(frozen=True, eq=False)
class Disagreement:
    """The cells in which plan and readings differ.

    Parameters
    ----------
    opened : (rows, cols) bool, the plan says wall and the readings say empty
    blocked : (rows, cols) bool, the plan says empty and the readings say wall
    grid : the cells
    margin : log odds that the readings had to reach
    """

    opened: NDArray[np.bool_]
    blocked: NDArray[np.bool_]
    grid: Grid
    margin: float

    @property
    def anywhere(self) -> NDArray[np.bool_]:
        """(rows, cols) True where plan and readings differ either way."""
        return self.opened | self.blocked

    def __repr__(self) -> str:
        return f"Disagreement({int(self.opened.sum())} cells opened, {int(self.blocked.sum())} cells blocked)"


def find_disagreement(prior_map: GridMap, evidence: Evidence, margin: float = 2.0) -> Disagreement:
    """Cells whose evidence has the sign opposite to the prior's, by more than a margin.

    The evidence S is the sum of logit(ISM) alone, so the prior cannot talk itself out of it. The default margin is just
    below one clear reading, logit(0.9) = 2.2. A cell whose prior is 0.5 says nothing and is never contradicted.

    Parameters
    ----------
    prior_map : what the plan says
    evidence : what the readings say, on the same grid
    margin : log odds, at least 0

    Raises
    ------
    ValueError
        When map and evidence lie on different grids, or the margin is negative.

    >>> from priorlab.core.sensor import RangeSensor
    >>> grid = Grid((1, 3))
    >>> plan = GridMap(np.array([[-1.5, 1.4, 1.4]]), grid)                # wall, space, space
    >>> evidence = Evidence(np.array([[2.2, -2.2, 2.2]]), np.ones((1, 3)), grid, RangeSensor())
    >>> find_disagreement(plan, evidence)
    Disagreement(1 cells opened, 1 cells blocked)
    """
    if prior_map.grid != evidence.grid:
        raise ValueError(f"map and evidence must lie on one grid, got {prior_map.grid} and {evidence.grid}")
    if not margin >= 0:
        raise ValueError(f"margin must be at least 0, got {margin:g}")
    says_wall, says_space = prior_map.log_odds < 0, prior_map.log_odds > 0
    return Disagreement(
        opened=says_wall & (evidence.total > margin),
        blocked=says_space & (evidence.total < -margin),
        grid=prior_map.grid,
        margin=margin,
    )
