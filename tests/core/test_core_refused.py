"""Records refuse what is no number, and chance must come as a Generator."""

import numpy as np
import pytest

import priorlab as pl
from priorlab.core.checks import check_rng, check_whole

GRID = pl.Grid((2, 2))
ONE_BEAM = pl.Scanner(n_beams=1)


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
        (lambda: pl.Scanner(n_beams="many"), "n_beams must be a number, got 'many'"),
        (lambda: pl.Scanner(n_beams=float("inf")), "n_beams must be a whole number of at least 1, got inf"),
        (lambda: pl.Scanner(n_beams=1e300), "n_beams must be at most 1,000,000, got 1e.300"),
        (lambda: pl.Scanner(min_range_m=None), "min_range_m must be a number, got None"),
        (lambda: pl.Scanner(outlier_rate="half"), "outlier_rate must be a number, got 'half'"),
        (lambda: pl.Scanner(max_range_m=10**400), "max_range_m must be a number, got a number of 1329 bits"),
        (lambda: pl.Odometry("none"), "alphas must be numbers, got 'none'"),
        (lambda: pl.Odometry(0.1), "alphas must be four finite numbers of at least 0, got 0.1"),
        (lambda: pl.Odometry((0, 0, 0, 1e300)), "alphas must be at most 1e.06, got 1e.300"),
        (lambda: pl.RangeNoise(deviation="little"), "deviation must be a number, got 'little'"),
        (lambda: pl.RangeNoise(dropout_rate=None), "dropout_rate must be a number, got None"),
        (lambda: pl.DepthCamera(rows=float("nan")), "rows must be a whole number of at least 1, got nan"),
        (lambda: pl.DepthCamera(strip_row="middle"), "strip_row must be a number, got 'middle'"),
        (lambda: pl.DepthCamera(min_depth_m=[]), r"min_depth_m must be a number, got \[\]"),
        (lambda: pl.Grid(None), "image_shape must be numbers|image_shape must be a height and a width in pixels, got None"),
        (lambda: pl.Grid((3, 4, 5)), "image_shape must be a height and a width in pixels"),
        (lambda: pl.GridMap([[1, 2], [3]], GRID), "log_odds must be numbers"),
        (lambda: pl.GridMap(np.zeros((2, 2)), (2, 2)), "grid must be a Grid, got tuple"),
        (lambda: pl.GridMap(np.zeros((2, 2)), GRID, 0.3), "prior must be a Prior, got float"),
        (
            lambda: pl.Readings([[1, 1, 0]], [["far"]], [0.0], pl.RangeSensor(), (2, 2)),
            r"ranges must be numbers, got \[\['far'\]\]",
        ),
        (lambda: pl.Readings([[1, 1, 0]], [[1.0]], [0.0], 40.0, (2, 2)), "sensor must be a RangeSensor, got float"),
        (lambda: pl.RobotLog([[0, 0, 0]], [[1.0]], [0.0], None, [0, 0, 0]), "scanner must be a Scanner, got NoneType"),
        (lambda: pl.RobotLog([[0, 0, 0]], [[1.0]], 0.0, ONE_BEAM, [0, 0, 0]), "bearings must be one row of finite angles"),
        (lambda: pl.RobotLog([[0, 0, 0]], [[1.0]], [0.0], ONE_BEAM, [0, 0, 0], stamps=["noon"]), "stamps must be numbers"),
        (lambda: pl.log_odds("likely"), "p must be numbers, got 'likely'"),
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
