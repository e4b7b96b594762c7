"""Small experiments with known answers, and a slow oracle that shares nothing with the sweep."""

import math
from dataclasses import dataclass, field

import numpy as np
import pytest

from priorlab.core.building import Truth
from priorlab.core.drawing import Walls
from priorlab.core.grid import Grid
from priorlab.core.readings import Evidence
from priorlab.core.sensor import RangeSensor
from priorlab.optimize.experiment import Experiment


@dataclass
class Oracle:
    """Counts the pixels of a map one by one, in plain Python."""

    walls: np.ndarray
    truth: np.ndarray
    ignore: np.ndarray
    total: np.ndarray
    looks: np.ndarray
    cell_size: int
    lam: float
    threshold: float
    factor: float = 0.9
    cells: dict = field(default_factory=dict)

    def __post_init__(self):
        height, width = self.truth.shape
        rows = len(self.total)
        for row in range(height):
            for col in range(width):
                up = (height - 1 - row) // self.cell_size  # cells are counted from the lower left corner
                cell = (rows - 1 - up, col // self.cell_size)
                known = self.cells.setdefault(cell, [False, 0, 0])
                known[0] |= bool(self.walls[row, col])
                if not self.ignore[row, col]:
                    known[1 if self.truth[row, col] else 2] += 1

    def counts(self, p_wall, p_space):
        """TP and FP of the map that starts with one pair."""
        tp = fp = 0
        for (row, col), (is_wall, positive, negative) in self.cells.items():
            p = (p_wall if is_wall else p_space) * self.factor
            l_0 = math.log(p / (1 - p))
            after = l_0 + self.total[row, col] - self.lam * self.looks[row, col] * l_0
            if after <= min(math.log(self.threshold / (1 - self.threshold)) + 1e-9, -1e-9):  # 0.5 is no wall
                tp, fp = tp + positive, fp + negative
        return tp, fp

    def candidates(self, is_wall, bounds=(0.1, 1.0)):
        """P(empty) before the factor at which a cell of one class may flip, the middles between, and the bounds."""
        level = math.log(self.threshold / (1 - self.threshold))
        low, high = (math.log(p * self.factor / (1 - p * self.factor)) for p in bounds)
        places = {low, high}
        for (row, col), (wall, positive, negative) in self.cells.items():
            k = self.lam * self.looks[row, col] - 1
            if wall == is_wall and abs(k) > 1e-9 and positive + negative:
                place = (self.total[row, col] - level) / k
                if low < place < high:
                    places.add(place)
        places = sorted(places)
        apart = [a for a, b in zip(places, [*places[1:], math.inf], strict=True) if b - a > 1e-9]
        middles = [(a + b) / 2 for a, b in zip(apart, apart[1:], strict=False)]
        return [min(1 / (1 + math.exp(-x)) / self.factor, bounds[1]) for x in sorted(apart + middles)]

    def objectives(self, bounds=(0.1, 1.0)):
        """(p_wall, p_space, TP, FP) of every pair of candidates: whatever any prior can reach."""
        walls, spaces = self.candidates(True, bounds), self.candidates(False, bounds)
        return [(pw, ps, *self.counts(pw, ps)) for pw in walls for ps in spaces]


def make_small_case(seed, cell_size=1, lam=1.0, threshold=0.2, shape=(5, 6)):
    """A random little building with readings that tie often, as an Experiment and as an Oracle."""
    rng = np.random.default_rng(seed)
    truth = rng.random(shape) < 0.4
    walls = truth ^ (rng.random(shape) < 0.2)
    ignore = rng.random(shape) < 0.1
    grid = Grid(shape, cell_size)
    looks = rng.integers(0, 4, grid.shape)
    seen = rng.choice([0.1, 0.2, 0.3, 0.7, 0.8, 0.9], size=(*grid.shape, 3))
    logit = np.log(seen / (1 - seen))
    total = np.where(np.arange(3) < looks[..., None], logit, 0.0).sum(axis=-1)
    experiment = Experiment(
        Walls(walls.astype(np.uint8)), Evidence(total, looks, grid, RangeSensor()), Truth(truth, ignore), lam, threshold
    )
    return experiment, Oracle(walls, truth, ignore, total, looks, cell_size, lam, threshold)


def make_noisy_flat(seed=0, shape=(60, 80), cell_size=3, looks=2.0):
    """A drawing of rooms, badly extracted and noisily seen, so that precision and recall pull apart."""
    rng = np.random.default_rng(seed)
    truth = np.zeros(shape, dtype=bool)
    truth[::20] = truth[1::20] = truth[:, ::20] = truth[:, 1::20] = True
    walls = truth & (rng.random(shape) < 0.9) | (rng.random(shape) < 0.002)
    grid = Grid(shape, cell_size)
    here = grid.any_in_cells(truth)
    n = rng.poisson(looks, grid.shape)
    total = np.where(here, -0.6, 1.0) * n + rng.normal(0, 0.8, grid.shape) * np.sqrt(n)
    return Experiment(Walls(walls.astype(np.uint8)), Evidence(total, n, grid, RangeSensor()), Truth(truth, truth & False))


@pytest.fixture(scope="session")
def small_case():
    """The function that makes a small experiment and its oracle."""
    return make_small_case


@pytest.fixture(scope="session")
def noisy_flat():
    """The function that makes a noisy flat."""
    return make_noisy_flat
