"""One experiment: how well do the walls of a plan and the readings of a robot map the truth, for any prior? (thesis 4.5)"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from priorlab.core.building import Truth
from priorlab.core.checks import check_number, check_positive, check_record
from priorlab.core.drawing import Walls
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.log_odds import DETECTED_WALL, detection_limit, log_odds
from priorlab.core.readings import Evidence
from priorlab.core.score import Score, score_map
from priorlab.mapping.update import update_map
from priorlab.optimize.steps import Steps
from priorlab.optimize.sweep import Sweep


@dataclass(frozen=True, eq=False)
class Experiment:
    """Walls that were extracted, evidence that was gathered, the truth that scores: everything but the prior.

    Parameters
    ----------
    walls : what chapter 3 found in the drawing; a cell is a wall cell when any of its pixels is wall
    evidence : S and n of every cell; its grid is the map's
    truth : walls and don't-care pixels of the building
    lam : weight of the prior in the update, as in `update_map`
    threshold : P(empty) at or below which a cell is a detected wall
    beta : weight of recall in F-beta
    factor : of the priors (thesis 4.6)

    Raises
    ------
    ValueError
        When the shapes of walls, evidence and truth differ, or a number is out of range.

    >>> from priorlab.core.grid import Grid
    >>> walls = Walls(np.array([[1, 1, 0, 0]], dtype=np.uint8))                     # the plan shows two walls,
    >>> truth = Truth(np.array([[True, False, False, False]]), np.zeros((1, 4)))    # one of them stands
    >>> experiment = Experiment(walls, Evidence.none(Grid((1, 4))), truth)          # and nobody looks
    >>> experiment.score(Prior(p_wall=0.2, p_space=0.9))
    Score(precision 0.500, recall 1.000, F2 0.833, false positive rate 0.333 at P(empty) <= 0.2)
    >>> experiment.sweep().best("f_beta")                                           # 0.2222 = 0.2 / 0.9
    Best(f_beta 0.8333 at p_wall in [0.1, 0.2222], p_space in (0.2222, 1])
    """

    walls: Walls
    evidence: Evidence
    truth: Truth
    lam: float = 1.0
    threshold: float = DETECTED_WALL
    beta: float = 2.0
    factor: float = 0.9

    def __post_init__(self) -> None:
        for name, kind in (("walls", Walls), ("evidence", Evidence), ("truth", Truth)):
            check_record(name, getattr(self, name), kind)
        shapes = {"walls": self.walls.shape, "evidence": self.evidence.grid.image_shape, "truth": self.truth.shape}
        if len(set(shapes.values())) > 1:
            told = ", ".join(f"{name} {width} x {height}" for name, (height, width) in shapes.items())
            raise ValueError(f"walls, evidence and truth must lie on one drawing, got {told} pixels")
        check_number("lam", self.lam)
        detection_limit(self.threshold)  # a sentence when it is none
        check_positive("beta", self.beta)
        check_positive("factor", self.factor)

    @cached_property
    def wall_cells(self) -> NDArray[np.bool_]:
        """(rows, cols) True where the plan shows a wall: there p_wall rules, elsewhere p_space."""
        return self.evidence.grid.any_in_cells(self.walls.mask)

    @cached_property
    def pixels(self) -> NDArray[np.int32]:
        """(2, rows, cols) counted true-wall pixels and counted empty pixels of every cell; don't-care is in neither."""
        counted, grid = ~self.truth.ignore, self.evidence.grid
        pixels = np.empty((2, *grid.shape), dtype=np.int32)  # an image has at most 200 million pixels
        pixels[0] = grid.sum_in_cells(self.truth.walls & counted)
        pixels[1] = grid.sum_in_cells(counted) - pixels[0]
        return pixels

    def map(self, prior: Prior) -> GridMap:
        """The posterior map for one prior."""
        at_wall, at_space = log_odds([prior.effective_p_wall, prior.effective_p_space])
        prior_map = GridMap(np.where(self.wall_cells, at_wall, at_space), self.evidence.grid, prior)
        return update_map(prior_map, self.evidence, self.lam)

    def score(self, prior: Prior) -> Score:
        """The score of one prior the long way: build the map, update it, count its pixels. `sweep()` knows all of them."""
        return score_map(self.map(prior), self.truth, self.threshold, self.beta)

    def sweep(self) -> Sweep:
        """Every prior at once, exactly: one sort of the cells, then look-ups."""
        slope = self.lam * self.evidence.looks.astype(np.float64) - 1.0
        wall, space = (self._steps(cells, slope) for cells in (self.wall_cells, ~self.wall_cells))
        positives, negatives = (int(count) for count in self.pixels.sum(axis=(1, 2)))
        return Sweep(
            wall=wall,
            space=space,
            positives=positives,
            negatives=negatives,
            threshold=self.threshold,
            beta=self.beta,
            factor=self.factor,
            is_wall=self.wall_cells,
            total=self.evidence.total,
            slope=slope,
            lam=self.lam,
            sensor=self.evidence.sensor,
        )

    def _steps(self, cells: NDArray[np.bool_], slope: NDArray[np.float64]) -> Steps:
        """The step functions of one class of cells; those without a reading, usually many, are taken together."""
        pixels = self.pixels.reshape(2, -1)
        cells = cells.ravel() & pixels.any(axis=0)
        seen = self.evidence.seen.ravel()
        unseen = np.flatnonzero(cells & ~seen)
        chosen = np.append(np.flatnonzero(cells & seen), unseen[:1])
        weights = pixels[:, chosen]
        if unseen.size:
            weights[:, -1] = pixels[:, unseen].sum(axis=1)
        return Steps.of_cells(self.evidence.total.ravel()[chosen], slope.ravel()[chosen], weights, self.threshold)

    def __repr__(self) -> str:
        cells = f"cells of {self.evidence.grid.cell_size:g} px, {self.evidence.mean_looks:.2f} looks each"
        return f"Experiment({self.walls.name}: {cells}, lam {self.lam:g}, threshold {self.threshold:g})"
