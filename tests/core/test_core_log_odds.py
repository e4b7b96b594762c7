"""Log odds against the definition in plain Python, and the one rule for ties."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from priorlab.core.log_odds import TIE, detected_as_wall, log_odds, probability

probabilities = st.floats(1e-6, 1 - 1e-6)


@given(probabilities)
def test_log_odds_is_the_logarithm_of_the_odds(p):
    assert log_odds(p).item() == pytest.approx(math.log(p) - math.log1p(-p), abs=1e-9)


@given(probabilities)
def test_probability_brings_log_odds_back(p):
    assert probability(log_odds(p)).item() == pytest.approx(p, rel=1e-9)


def test_log_odds_has_the_signs_of_equation_2_17():
    assert np.sign(log_odds([0.1, 0.5, 0.9])).tolist() == [-1, 0, 1]


def test_log_odds_of_a_half_is_exactly_nothing():
    assert log_odds(0.5).item() == 0.0 and probability(0.0).item() == 0.5


def test_probability_does_not_overflow():
    assert probability([-1e4, 1e4]).tolist() == [0.0, 1.0]


@given(st.lists(probabilities, min_size=2, max_size=9))
def test_log_odds_keeps_the_order(values):
    assert (np.diff(log_odds(sorted(values))) >= 0).all()


@pytest.mark.parametrize("p", [0.0, 1.0, -0.1, 1.5, float("nan")])
def test_log_odds_refuses_what_would_be_infinite(p):
    with pytest.raises(ValueError, match=f"a probability must lie strictly between 0 and 1, got {p:g}"):
        log_odds([0.5, p])


@given(st.floats(0.01, 0.5), st.floats(-1, 1))
def test_detected_as_wall_is_a_comparison_of_probabilities(threshold, off):
    level = math.log(threshold / (1 - threshold))
    if abs(off) > 2 * TIE:
        assert detected_as_wall(level + off, threshold).item() == (off < 0)


@pytest.mark.parametrize("n", [1, 2, 3, 7])
def test_detected_as_wall_decides_ties_for_the_wall(n):
    """Readings that add up to 0.2 by another way than logit(0.2) still lie on the threshold."""
    detour = sum([math.log(0.3 / 0.7)] * n) + math.log(0.2 / 0.8) + sum([math.log(0.7 / 0.3)] * n)
    assert detected_as_wall(detour, 0.2)


def test_detected_as_wall_never_takes_what_it_does_not_know_for_a_wall():
    unknown_wall_free = log_odds([0.5, 0.49, 0.51])
    assert detected_as_wall(unknown_wall_free, threshold=0.5).tolist() == [False, True, False]
    assert detected_as_wall(log_odds([0.5 - 1e-12]), threshold=0.5).tolist() == [False]


@pytest.mark.parametrize("threshold", [0.0, 0.51, 1.0, float("nan")])
def test_detected_as_wall_refuses_a_threshold(threshold):
    with pytest.raises(ValueError, match=r"threshold must lie above 0 and be at most 0\.5"):
        detected_as_wall([0.0], threshold)
