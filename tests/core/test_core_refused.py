"""Records refuse what is no number, and chance must come as a Generator."""

import numpy as np
import pytest

import priorlab as pl
from priorlab.core.checks import check_rng, check_whole

GRID = pl.Grid((2, 2))


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: pl.Drawing(np.ones((3, 3))), "grey must hold uint8 from 0"),
        (lambda: pl.Drawing(np.ones((3, 3), dtype=bool)), "grey must hold uint8 from 0"),
        (lambda: pl.Walls(np.full((3, 3), -1)), "labels must be whole numbers from 0 to 255"),
        (lambda: pl.Walls(np.full((3, 3), np.nan)), "labels must be whole numbers from 0 to 255"),
        (lambda: pl.Walls(np.zeros((3, 3), dtype=np.uint8), metres_per_pixel=-1), "metres_per_pixel must be"),
        (lambda: pl.GridMap(np.full((2, 2), np.nan), GRID), "log_odds must be finite numbers, got nan"),
        (lambda: pl.Evidence(np.full((2, 2), np.nan), np.ones((2, 2)), GRID, pl.RangeSensor()), "total must be finite"),
        (lambda: pl.Evidence(np.zeros((2, 2)), -np.ones((2, 2)), GRID, pl.RangeSensor()), "looks must not be negative, got -1"),
        (lambda: pl.Readings([[1, 1, 0]], [[1.0]], [np.nan], pl.RangeSensor(), (2, 2)), "bearings must be one row of finite"),
        (lambda: pl.Readings([[1, 1, 0]], np.empty((1, 0)), [], pl.RangeSensor(), (2, 2)), "bearings must be one row of finite"),
        (lambda: pl.Scanner(range_noise_m=float("nan")), "range_noise_m must be a finite number"),
        (lambda: pl.Scanner(n_beams=2.5), "n_beams must be a whole number"),
        (lambda: pl.Grid((1000, 1000), 0.01), "cell_size must leave at most 200,000,000 cells"),
        (lambda: pl.RangeSensor(max_range="far"), "max_range must be a number, got 'far'"),
        (lambda: pl.RangeSensor(p_free=None), "p_free must be a number, got None"),
        (lambda: pl.RangeSensor(max_range="20"), "max_range must be a number, got '20'"),
        (lambda: pl.Grid((9, 9), "big"), "cell_size must be a number, got 'big'"),
        (lambda: pl.Prior("0.2", 0.9), "p_wall must be a number, got '0.2'"),
        (
            lambda: pl.Prior(0.2, 0.9, factor=float("nan")),
            "the effective p_wall must lie strictly between 0 and 1, got 0.2 x nan",
        ),
        (lambda: check_whole("repeats", 1.5), "repeats must be a whole number of at least 1, got 1.5"),
        (lambda: check_whole("repeats", float("inf")), "repeats must be a whole number of at least 1, got inf"),
        (lambda: check_rng(0), "rng must be a numpy Generator.*got 0"),
        (lambda: check_rng(None), "rng must be a numpy Generator.*got None"),
    ],
)
def test_record_refuses(make, sentence):
    with pytest.raises(ValueError, match=sentence):
        make()


def test_evidence_cannot_lose_what_it_never_had():
    none = pl.Evidence.none(GRID)
    one = pl.Evidence(np.ones((2, 2)), np.ones((2, 2)), GRID, pl.RangeSensor())
    assert (one - one).looks.sum() == 0
    with pytest.raises(ValueError, match="more was taken away than was there"):
        none - one
