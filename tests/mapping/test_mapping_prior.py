"""The prior map, cell by cell."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from priorlab.core.drawing import Walls
from priorlab.core.grid_map import Prior
from priorlab.mapping.prior import build_prior_map

SHAPE = (6, 9)


def speckled_walls(seed, scale=None):
    return Walls((np.random.default_rng(seed).random(SHAPE) < 0.15).astype(np.uint8), scale)


@given(st.integers(0, 99), st.integers(1, 4), st.floats(0.1, 1), st.floats(0.1, 1))
def test_build_prior_map_makes_a_cell_wall_when_any_pixel_is(seed, cell_size, p_wall, p_space):
    walls = speckled_walls(seed)
    prior_map = build_prior_map(walls, Prior(p_wall, p_space), cell_size)
    rows, cols = prior_map.grid.shape
    for row in range(rows):
        bottom = SHAPE[0] - (rows - 1 - row) * cell_size  # rows of cells are counted from below
        for col in range(cols):
            block = walls.mask[max(0, bottom - cell_size) : bottom, col * cell_size : (col + 1) * cell_size]
            p = 0.9 * (p_wall if block.any() else p_space)
            assert prior_map.log_odds[row, col] == pytest.approx(math.log(p / (1 - p)), abs=1e-9)


@given(st.integers(0, 99), st.sampled_from([1, 2.5, 4]))
def test_build_prior_map_uninformed_is_exactly_a_half(seed, cell_size):
    prior_map = build_prior_map(speckled_walls(seed), Prior.uninformed(), cell_size)
    assert (prior_map.log_odds == 0.0).all() and (prior_map.p_empty == 0.5).all()


def test_build_prior_map_has_the_thesis_prior_and_pixels_by_default():
    prior_map = build_prior_map(Walls(np.eye(2, dtype=np.uint8)))
    assert prior_map.grid.cell_size == 1 and prior_map.prior == Prior(0.2, 0.9)
    np.testing.assert_allclose(prior_map.p_empty, [[0.18, 0.81], [0.81, 0.18]])


@pytest.mark.parametrize(("scale", "metres", "pixels"), [(0.05, 0.15, 3), (0.025, 0.05, 2), (0.1, 0.25, 2.5), (0.03, 0.03, 1)])
def test_build_prior_map_takes_metres(scale, metres, pixels):
    grid = build_prior_map(speckled_walls(0, scale), cell_size_m=metres).grid
    assert grid.cell_size == pixels and grid.metres_per_pixel == scale


@pytest.mark.parametrize(
    ("scale", "sizes", "sentence"),
    [
        (0.05, {"cell_size": 1, "cell_size_m": 0.05}, "only one of cell_size and cell_size_m may be given, got 1 px and 0.05 m"),
        (None, {"cell_size_m": 0.05}, "metres_per_pixel must be known to speak of metres, got None"),
        (0.05, {"cell_size_m": 0.31}, "cell_size_m must not exceed the drawing's 0.45 x 0.3 m, got 0.31"),
        (0.05, {"cell_size": 7}, "cell_size must not exceed the drawing's 9 x 6 pixels, got 7"),
        (0.05, {"cell_size": 0}, "cell_size must be a finite number above 0, got 0"),
        (0.05, {"cell_size_m": -1}, "cell_size_m must be a finite number above 0, got -1"),
        (0.05, {"cell_size": math.nan}, "cell_size must be a finite number above 0, got nan"),
    ],
)
def test_build_prior_map_says_what_is_wrong(scale, sizes, sentence):
    with pytest.raises(ValueError, match=sentence):
        build_prior_map(speckled_walls(0, scale), **sizes)
