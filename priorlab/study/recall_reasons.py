"""Which prior has the highest recall, and why: every row of Table 4.2 from the closed form, for the thesis's update (lam = 1).

After n looks a cell stands at l = S - (n - 1) l_0 and is a detected wall iff l <= t. So for each class of cells, those where
the plan shows a wall (p_wall rules) and those where it shows space (p_space rules), with p the effective prior:

- n = 0, never seen: detected iff p <= threshold. These want a LOW prior, and every one up to the threshold is as good.
- n = 1, seen once: l = S. No prior matters.
- n >= 2: detected iff l_0 >= (S - t) / (n - 1). These want a HIGH prior.

Hence the highest recall of a class lies at the cliff p = threshold or at the upper bound, and it is enough to count the true
wall pixels that are at stake: those of never-seen cells against those that cells seen twice or more gain from cliff to bound.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from priorlab.core.log_odds import detection_limit, log_odds
from priorlab.optimize.experiment import Experiment
from priorlab.optimize.front import BOUNDS


@dataclass(frozen=True)
class Reason:
    """What decides one of the two numbers of a prior.

    Parameters
    ----------
    name : "p_wall" or "p_space"
    cliff : threshold / factor, before the factor: never-seen cells are detected up to it
    unseen : true wall pixels in never-seen cells of the class: found up to the cliff, lost above
    once : true wall pixels detected in cells seen once, whatever the prior
    at_cliff, at_bound : true wall pixels detected in cells seen twice or more, with the prior at the cliff and at the bound
    """

    name: str
    cliff: float
    unseen: int
    once: int
    at_cliff: int
    at_bound: int

    @property
    def best(self) -> float:
        """The highest recall's value, before the factor: the cliff or the upper bound."""
        return self.cliff if self.is_cliff else BOUNDS[1]

    @property
    def is_cliff(self) -> bool:
        """Do the never-seen cells decide?"""
        return self.unseen + self.at_cliff >= self.at_bound

    @property
    def found(self) -> int:
        """True wall pixels of the class that the best prior detects."""
        return self.once + max(self.unseen + self.at_cliff, self.at_bound)

    @property
    def sentence(self) -> str:
        """Why, in a few words with the pixels."""
        gained = self.at_bound - self.at_cliff
        if not self.unseen and not gained:
            return f"any {self.name} from {self.cliff:.3g}: n = 0 and n >= 2 have no wall to win"
        if self.is_cliff:
            return f"{self.name} up to {self.cliff:.3g}: n = 0 holds {self.unseen} px, n >= 2 would gain {gained}"
        return f"{self.name} high: n >= 2 gains {gained} px, n = 0 holds only {self.unseen}"


def recall_reasons(experiment: Experiment) -> tuple[Reason, Reason]:
    """The reasons for the p_wall and the p_space of the highest recall within eq. 4.19's bounds.

    Raises
    ------
    ValueError
        When the experiment's lam is not 1.
    """
    if experiment.lam != 1:
        raise ValueError(f"lam must be 1, the thesis's update, got {experiment.lam:g}")
    wall = experiment.wall_cells
    return _reason("p_wall", experiment, wall), _reason("p_space", experiment, ~wall)


def _reason(name: str, experiment: Experiment, cells: NDArray[np.bool_]) -> Reason:
    """Count one class."""
    limit = detection_limit(experiment.threshold)
    pixels, n, total = experiment.pixels[0][cells], experiment.evidence.looks[cells], experiment.evidence.total[cells]
    cliff = min(max(experiment.threshold / experiment.factor, BOUNDS[0]), BOUNDS[1])

    def detected_often(p: float) -> int:
        l_0 = log_odds(p * experiment.factor)
        return int(pixels[(n >= 2) & (total - (n - 1) * l_0 <= limit)].sum())

    unseen, once = int(pixels[n == 0].sum()), int(pixels[(n == 1) & (total <= limit)].sum())
    at_cliff, at_bound = detected_often(cliff), detected_often(BOUNDS[1])
    return Reason(name, cliff, unseen, once, at_cliff, at_bound)
