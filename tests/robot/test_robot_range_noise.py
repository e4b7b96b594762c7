"""The faults of a sensor, each on its own."""

import numpy as np
import pytest

from priorlab.robot.range_noise import RangeNoise, disturb

MANY = np.full(20_000, 2.0)


def noisy(ranges=MANY, max_range=3.0, seed=0, **faults):
    return disturb(np.asarray(ranges, dtype=float), RangeNoise(**faults), max_range, np.random.default_rng(seed))


def test_no_faults_change_nothing():
    assert (noisy([1.0, 2.0, np.inf]) == [1.0, 2.0, np.inf]).all()


def test_deviation_is_the_standard_deviation():
    assert noisy(deviation=0.1).std() == pytest.approx(0.1, rel=0.05)
    assert noisy(deviation=0.1).mean() == pytest.approx(2.0, abs=0.005)


def test_outliers_are_spread_over_the_whole_range():
    measured = noisy(outlier_rate=0.3, min_range=1.0)
    outliers = measured[measured != 2.0]
    assert len(outliers) / len(MANY) == pytest.approx(0.3, abs=0.02)
    assert outliers.min() >= 1.0 and outliers.max() <= 3.0 and outliers.mean() == pytest.approx(2.0, abs=0.03)


def test_outliers_come_where_nothing_stands_too():
    assert np.isfinite(noisy(np.full(100, np.inf), outlier_rate=1.0)).all()


def test_dropouts_are_missing():
    assert np.isnan(noisy(dropout_rate=0.2)).mean() == pytest.approx(0.2, abs=0.02)


def test_blind_zone_is_no_reading_and_far_end_no_return():
    ranges = np.array([0.39, 0.4, 3.0, 3.01])
    np.testing.assert_array_equal(noisy(ranges, min_range=0.4), [np.nan, 0.4, 3.0, np.inf])


def test_noise_never_makes_a_range_negative():
    near = noisy(np.full(1000, 0.01), deviation=1.0)
    assert (near >= 0).all() and (near == 0).mean() == pytest.approx(0.5, abs=0.05)


def test_one_fault_changes_and_the_others_stay():
    few, more = (noisy(deviation=0.1, dropout_rate=rate) for rate in (0.1, 0.3))
    both = np.isfinite(few) & np.isfinite(more)
    assert (few[both] == more[both]).all() and np.isnan(more[np.isnan(few)]).all()


@pytest.mark.parametrize(
    ("faults", "sentence"),
    [
        ({"deviation": -1}, "deviation must be a finite number of at least 0, got -1"),
        ({"min_range": np.nan}, "min_range must be a finite number of at least 0, got nan"),
        ({"outlier_rate": 2}, "outlier_rate must lie between 0 and 1, got 2"),
        ({"dropout_rate": -0.1}, "dropout_rate must lie between 0 and 1, got -0.1"),
    ],
)
def test_range_noise_says_what_is_wrong(faults, sentence):
    with pytest.raises(ValueError, match=sentence):
        RangeNoise(**faults)
