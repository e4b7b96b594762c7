"""Every prior at once, exactly: precision, recall, F-beta and false positive rate as look-ups (thesis 4.6, fig. 4.5).

The thesis tries 10 x 10 pairs and interpolates. Here each cell's critical prior is sorted once per class (`Steps`); then
the counts of any pair are two look-ups and a sum, ties included, equal to the map built and scored the long way.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.log_odds import log_odds, probability
from priorlab.core.measures import Measure
from priorlab.core.score import Score
from priorlab.core.sensor import RangeSensor
from priorlab.mapping.overruled import is_overruled
from priorlab.optimize.exact_front import Best, best_priors, exact_front
from priorlab.optimize.front import FLOOR, Front, bounds_for, check_floor
from priorlab.optimize.plateaus import Pieces, pieces_of
from priorlab.optimize.steps import FLAT, Steps
from priorlab.optimize.table import Table

MOST_PAIRS = 50_000_000
"""A table of more pairs fits into no memory of 2 GB."""


@dataclass(frozen=True, eq=False)
class Sweep:
    """All priors of one experiment; made by `Experiment.sweep()`. P(empty) is always given before the factor.

    Parameters
    ----------
    wall, space : step functions of the cells where the plan shows a wall, and where it shows space
    positives, negatives : counted true-wall pixels and counted empty pixels
    threshold : P(empty) at or below which a cell is a detected wall
    beta : weight of recall in F-beta
    factor : of the priors
    is_wall : (rows, cols) the class of every cell
    total, slope : (rows, cols) S and k = lam n - 1 of every cell
    lam : weight of the prior in the update
    sensor : whose readings were taken
    """

    wall: Steps
    space: Steps
    positives: int
    negatives: int
    threshold: float
    beta: float
    factor: float
    is_wall: NDArray[np.bool_] = field(repr=False)
    total: NDArray[np.float64] = field(repr=False)
    slope: NDArray[np.float64] = field(repr=False)
    lam: float = 1.0
    sensor: RangeSensor = RangeSensor()

    @property
    def bounds(self) -> tuple[float, float]:
        """Lowest and highest P(empty), before the factor, that searches and grids cover when nothing else is said."""
        return bounds_for(self.factor)

    def counts(self, p_wall: ArrayLike, p_space: ArrayLike) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """True and false pixels detected for arrays of pairs, which broadcast."""
        tp_wall, fp_wall = self.wall.counts(self._prior_log_odds("p_wall", p_wall))
        tp_space, fp_space = self.space.counts(self._prior_log_odds("p_space", p_space))
        return tp_wall + tp_space, fp_wall + fp_space

    def at(self, p_wall: float, p_space: float) -> Score:
        """The score that the map would get with one prior.

        Raises
        ------
        ValueError
            When an effective value does not lie strictly between 0 and 1.
        """
        tp, fp = (int(count) for count in self.counts(p_wall, p_space))
        return Score(tp, fp, self.positives - tp, self.negatives - fp, beta=self.beta, threshold=self.threshold)

    def grid(self, p_wall: int | ArrayLike = 10, p_space: int | ArrayLike | None = None) -> Table:
        """The measures of every pair of some p_wall and some p_space.

        Parameters
        ----------
        p_wall, p_space : values before the factor, or how many to spread evenly over `bounds`: 10 is the thesis's grid;
            p_space as p_wall when not given
        """
        walls = _spread(p_wall, self.bounds)
        spaces = walls if p_space is None else _spread(p_space, self.bounds)
        if walls.size * spaces.size > MOST_PAIRS:
            raise ValueError(f"a grid must have at most {MOST_PAIRS:,} pairs, got {walls.size:,} x {spaces.size:,}")
        tp_wall, fp_wall = self.wall.counts(self._prior_log_odds("p_wall", walls))
        tp_space, fp_space = self.space.counts(self._prior_log_odds("p_space", spaces))
        # counts of pixels are exact in float64, and quicker to divide
        tp = np.add.outer(tp_wall.astype(np.float64), tp_space.astype(np.float64))
        fp = np.add.outer(fp_wall.astype(np.float64), fp_space.astype(np.float64))
        overruled = self.overruled(walls[:, None], spaces)
        return Table(walls, spaces, tp, fp, self.positives, self.negatives, self.beta, self.factor, overruled)

    def overruled(self, p_wall: ArrayLike, p_space: ArrayLike) -> NDArray[np.bool_]:
        """True for pairs, which broadcast, that break eq. 2.22 with this sensor and lam: see `overruled_readings`."""
        walls, spaces = (np.asarray(p, dtype=np.float64) * self.factor for p in (p_wall, p_space))
        return is_overruled(walls, spaces, self.sensor.p_free, self.sensor.p_occupied, self.lam)

    def critical(self) -> NDArray[np.float64]:
        """(rows, cols) P(empty), before the factor, of its class at which each cell flips; nan where no prior matters.

        Where `direction` is -1 the cell is a detected wall at or below it, where it is 1 at or above it.
        """
        flips = self.direction != 0
        p = np.full(self.total.shape, np.nan)
        p[flips] = probability((self.total[flips] - log_odds(self.threshold)) / self.slope[flips]) / self.factor
        return p

    @property
    def direction(self) -> NDArray[np.int8]:
        """(rows, cols) -1 detected at or below the critical prior, 1 at or above it, 0 whatever the prior."""
        return np.where(np.abs(self.slope) < FLAT, 0, np.sign(self.slope)).astype(np.int8)

    def best(self, measure: Measure = "f_beta", bounds: tuple[float, float] | None = None) -> Best:
        """The highest "f_beta", "precision" or "recall" within bounds, and all the ranges of priors that reach it.

        These are tables 4.1 and 4.2.
        """
        if measure not in ("f_beta", "precision", "recall"):
            raise ValueError(f"measure must be 'f_beta', 'precision' or 'recall', got {measure!r}")
        return best_priors(*self._pieces(bounds), self.positives, measure, self.beta)

    def front(self, bounds: tuple[float, float] | None = None, floor: float = FLOOR) -> Front:
        """The true Pareto front of precision and recall under eq. 4.19: no search, no interpolation.

        Parameters
        ----------
        bounds : of p_wall and p_space, before the factor; (0.1, 1) with the thesis's factor (`bounds_for`)
        floor : precision and recall must both lie above it

        Returns
        -------
        Front with the ranges of every point; empty, with a sentence in its note, when no prior reaches the floor.
        """
        floor = check_floor(floor)
        front = exact_front(*self._pieces(bounds), self.positives, floor)
        return replace(front, overruled=self.overruled(front.p_wall, front.p_space))

    def _pieces(self, bounds: tuple[float, float] | None) -> tuple[Pieces, Pieces]:
        """The pieces of both classes within the bounds."""
        bounds = self.checked(bounds)
        return pieces_of(self.wall, bounds, self.factor), pieces_of(self.space, bounds, self.factor)

    def checked(self, bounds: tuple[float, float] | None) -> tuple[float, float]:
        """The bounds, by default `self.bounds`, or a sentence when they are no two priors."""
        pair = self.bounds if bounds is None else tuple(bounds)
        if len(pair) != 2 or not pair[0] < pair[1]:
            raise ValueError(f"bounds must be a lower and a higher P(empty), got {' and '.join(map(str, pair))}")
        low, high = pair
        self._prior_log_odds("bounds", (low, high))
        return low, high

    def _prior_log_odds(self, name: str, p: ArrayLike) -> NDArray[np.float64]:
        """l_0 of priors before the factor, or a sentence."""
        p = np.asarray(p, dtype=np.float64)
        effective = p * self.factor
        if not ((effective > 0) & (effective < 1)).all():
            wrong = p[~((effective > 0) & (effective < 1))].flat[0]
            raise ValueError(
                f"the effective {name} must lie strictly between 0 and 1, "
                f"got {wrong:g} x {self.factor:g} = {wrong * self.factor:g}"
            )
        return log_odds(effective)

    def __repr__(self) -> str:
        changes = f"{len(self.wall.breaks)} critical values of p_wall, {len(self.space.breaks)} of p_space"
        return f"Sweep({changes}, {self.positives} wall and {self.negatives} empty pixels)"


def _spread(p: int | ArrayLike, bounds: tuple[float, float]) -> NDArray[np.float64]:
    """The values given, or that many between the bounds; 10 of them over (0.1, 1) are .1, .2, ... to the last digit."""
    if isinstance(p, int | np.integer):
        if p < 2:
            raise ValueError(f"a grid must have at least 2 values a side, got {p}")
        return np.round(np.linspace(*bounds, int(p)), 12)
    values = np.asarray(p, dtype=np.float64)
    if values.ndim != 1 or not values.size:
        raise ValueError(f"a grid's values must be one row of numbers, got shape {values.shape}")
    return values
