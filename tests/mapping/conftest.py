"""Random little surveys and evidence."""

import numpy as np
import pytest

from priorlab.core.building import Truth
from priorlab.core.drawing import Walls
from priorlab.core.grid import Grid
from priorlab.core.readings import Evidence
from priorlab.core.sensor import RangeSensor
from priorlab.robot.explore import explore


@pytest.fixture(scope="session")
def small_survey():
    """Walls and readings of a map of scattered obstacles, by seed."""

    def make(seed, n_poses=8, shape=(12, 15), **sensor):
        rng = np.random.default_rng(seed)
        obstacles = rng.random(shape) < 0.08
        free = np.argwhere(~obstacles)
        chosen = free[rng.integers(0, len(free), n_poses)]
        xy = np.column_stack([chosen[:, 1], shape[0] - 1 - chosen[:, 0]]) + 0.5
        poses = np.column_stack([xy, rng.integers(0, 4, n_poses) * np.pi / 2])
        readings = explore(Truth(obstacles, obstacles & False), poses, RangeSensor(max_range=6, **sensor))
        walls = obstacles ^ (rng.random(shape) < 0.05)  # the plan errs here and there
        return Walls(walls.astype(np.uint8)), readings

    return make


@pytest.fixture(scope="session")
def strip():
    """Evidence on a strip of cells: n readings of one value in each."""

    def make(p_reading, looks, sensor=None):
        looks = np.atleast_2d(looks)
        p = np.asarray(p_reading, dtype=float)
        return Evidence(looks * np.log(p / (1 - p)), looks, Grid(looks.shape), sensor or RangeSensor())

    return make
