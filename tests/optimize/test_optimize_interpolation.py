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


def table_of(values):
    """A table whose recall takes these values."""
    values = np.asarray(values, dtype=float)
    rows, cols = values.shape
    return Table(np.linspace(0.1, 1, rows), np.linspace(0.1, 1, cols), values, np.zeros(values.shape), 1, 1)


def test_cubic_interpolation_is_exact_for_parabolas():
    """Keys's cubic convolution reproduces every polynomial of degree 2, to the border."""
    p = np.linspace(0.1, 1, 10)
    parabola = lambda x, y: 2 + x - 3 * y + x * y - x**2 + 0.5 * y**2  # noqa: E731
    between = Interpolation(table_of(parabola(p[:, None], p)), order=3)
    x, y = np.random.default_rng(0).uniform(0.1, 1, (2, 200))
    np.testing.assert_allclose(between.at("recall", x, y), parabola(x, y), atol=1e-12)
    lines = Interpolation(table_of(parabola(p[:, None], p)))
    assert np.abs(lines.at("recall", x, y) - parabola(x, y)).max() > 1e-3


def test_cubic_interpolation_meets_the_table_and_overshoots_at_a_cliff():
    cliff = np.tile([0.0] * 5 + [1.0] * 5, (10, 1))
    between = Interpolation(table_of(cliff), order=3)
    p = between.table.p_space
    np.testing.assert_allclose(between.at("recall", p[:, None], p), cliff, atol=1e-12)
    values = between.at("recall", 0.5, np.linspace(0.1, 1, 500))
    assert values.max() == pytest.approx(1 + 2 / 27, abs=1e-3) and values.min() == pytest.approx(-2 / 27, abs=1e-3)


def test_cubic_interpolation_does_not_know_what_lies_beside_nothing_detected():
    tp = np.ones((6, 6))
    tp[0, 0] = 0
    p = np.linspace(0.1, 1, 6)
    between = Interpolation(Table(p, p, tp, np.zeros((6, 6)), 1, 1), order=3)
    assert np.isnan(between.at("precision", 0.2, 0.2)) and np.isnan(between.at("precision", 0.4, 0.4))
    assert between.at("precision", 0.7, 0.7) == pytest.approx(1) and between.at("precision", 1.0, 0.2) == pytest.approx(1)


def test_cubic_interpolation_hardly_matters(noisy_flat):
    """The thesis expects little of a higher order (its chapter 7): the cliff is as far off, and the mean error is no better."""
    sweep = noisy_flat().sweep()
    for measure in ("recall", "f_beta"):
        lines, cubic = (interpolate(sweep, order=order).error(sweep, measure) for order in (1, 3))
        assert cubic.mean > 0.8 * lines.mean and cubic.largest > 0.9 * lines.largest


def test_interpolation_refuses_orders_and_tables_that_do_not_fit():
    with pytest.raises(ValueError, match="order must be 1 .* or 3 .*, got 2"):
        Interpolation(table_of(np.eye(4)), order=2)
    with pytest.raises(ValueError, match="p_wall must be at least 3 values, evenly spread, for order 3, got 2 values"):
        Interpolation(table_of(np.eye(2)), order=3)


def test_interpolation_refuses_priors_outside_the_table(noisy_flat):
    with pytest.raises(ValueError, match=r"p_wall must lie in the table's range \[0\.1, 1\], got 0\.05"):
        interpolate(noisy_flat().sweep()).at("recall", 0.05, 0.5)
