"""The thesis's table with straight lines between its points, against SciPy-free arithmetic and the exact sweep."""

import numpy as np
import pytest

from priorlab.optimize.interpolation import Interpolation, interpolate
from priorlab.optimize.table import Table


def test_interpolation_is_bilinear_between_the_points():
    table = Table(np.array([0.0, 1.0]), np.array([0.0, 2.0]), np.array([[0.0, 2.0], [4.0, 10.0]]), np.zeros((2, 2)), 10, 10)
    between = Interpolation(table)
    assert between.at("recall", 0.5, 1.0) == pytest.approx(0.4)  # the mean of 0, .2, .4 and 1.0
    assert between.at("recall", 0.25, 0.5) == pytest.approx(0.75 * (0.75 * 0 + 0.25 * 0.2) + 0.25 * (0.75 * 0.4 + 0.25 * 1.0))


def test_interpolation_is_exact_on_its_own_points(noisy_flat):
    sweep = noisy_flat().sweep()
    between = interpolate(sweep)
    p = between.table.p_wall
    for measure in ("precision", "recall", "f_beta"):
        np.testing.assert_array_equal(between.at(measure, p[:, None], p), getattr(sweep.grid(10), measure))


def test_interpolation_does_not_know_what_lies_beside_nothing_detected():
    tp = np.array([[0.0, 2.0], [4.0, 10.0]])
    between = Interpolation(Table(np.array([0.0, 1.0]), np.array([0.0, 1.0]), tp, np.zeros((2, 2)), 10, 10))
    assert np.isnan(between.at("precision", 0.5, 0.5)) and between.at("precision", 1.0, 0.5) == 1.0


def test_interpolation_error_is_largest_at_the_cliff(noisy_flat):
    sweep = noisy_flat().sweep()
    between = interpolate(sweep)
    error = between.error(sweep, "precision", n=91)
    p = np.linspace(0.1, 1, 91)
    slow = np.array([[abs(float(between.at("precision", a, b)) - sweep.at(a, b).precision) for b in p] for a in p])
    assert error.largest == pytest.approx(np.nanmax(slow)) and error.mean == pytest.approx(np.nanmean(slow))
    assert error.left_out == pytest.approx(np.isnan(slow).mean())
    assert error.largest > 0.2 and 0.2 < max(error.p_wall, error.p_space)
    assert "largest" in repr(error)


def test_interpolation_error_shrinks_with_a_finer_table(noisy_flat):
    sweep = noisy_flat().sweep()
    coarse, fine = (interpolate(sweep, n).error(sweep, "recall", n=181).mean for n in (10, 91))
    assert 0 < fine < coarse


def test_interpolation_refuses_priors_outside_the_table(noisy_flat):
    with pytest.raises(ValueError, match=r"p_wall must lie in the table's range \[0\.1, 1\], got 0\.05"):
        interpolate(noisy_flat().sweep()).at("recall", 0.05, 0.5)
