"""The closed form against the recursion, and what the two updates do to a prior."""

import ast
import inspect
import math
import warnings

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import priorlab.mapping.recursion as recursion
from priorlab.core.drawing import Walls
from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.readings import Evidence
from priorlab.core.sensor import RangeSensor
from priorlab.mapping.evidence import gather_evidence
from priorlab.mapping.overruled import OverruledSensorWarning, is_overruled, overruled_readings
from priorlab.mapping.prior import build_prior_map
from priorlab.mapping.update import update_map

probabilities = st.floats(0.05, 0.95)
lams = st.sampled_from([0.0, 1.0]) | st.floats(-0.5, 2.0)
seeds = st.integers(0, 2**32 - 1)


def strip_map(*p_empty):
    p = np.array([p_empty])
    return GridMap(np.log(p / (1 - p)), Grid(p.shape))


def update_quietly(prior_map, evidence, lam=1.0):
    """The update of a prior that is meant to break eq. 2.22."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", OverruledSensorWarning)
        return update_map(prior_map, evidence, lam)


# --- the closed form is the recursion --------------------------------------------------------------------------------


def test_the_recursion_imports_nothing_from_what_it_checks():
    imported = set()
    for node in ast.walk(ast.parse(inspect.getsource(recursion))):
        if isinstance(node, ast.ImportFrom):
            imported.add(node.module)
        elif isinstance(node, ast.Import):
            imported |= {alias.name for alias in node.names}
    assert "priorlab.core.log_odds" in imported
    assert not any(name.startswith(("priorlab.mapping", "priorlab.optimize")) for name in imported)


@settings(max_examples=60)
@given(seeds, probabilities, probabilities, lams, st.sampled_from([1, 2, 3, 2.5]), st.sampled_from(["thickness", "all"]))
def test_update_map_equals_the_recursion(small_survey, seed, p_wall, p_space, lam, cell_size, beyond):
    walls, readings = small_survey(seed, beyond=beyond)
    prior_map = build_prior_map(walls, Prior(p_wall, p_space), cell_size)
    closed = update_quietly(prior_map, gather_evidence(readings, prior_map.grid), lam)
    step_by_step = recursion.update_step_by_step(prior_map, readings, lam)
    np.testing.assert_allclose(closed.log_odds, step_by_step.log_odds, rtol=0, atol=1e-9)
    assert closed.prior == step_by_step.prior == Prior(p_wall, p_space)


@given(probabilities, st.lists(probabilities, max_size=12), lams)
def test_one_step_after_another_equals_the_odds_form(p_prior, p_readings, lam):
    """Eq. 2.14 in odds, without a logarithm: odds_k = odds(ISM) odds_{k-1} / odds_0^lam."""
    l_0 = math.log(p_prior / (1 - p_prior))
    cell, odds = l_0, p_prior / (1 - p_prior)
    for p in p_readings:
        cell = recursion.one_step(cell, l_0, p, lam)
        odds *= p / (1 - p) / (p_prior / (1 - p_prior)) ** lam
    assert cell == pytest.approx(math.log(odds), abs=1e-9)


@given(probabilities, st.lists(st.tuples(st.booleans(), probabilities), max_size=10))
def test_lam_0_is_bayes_rule_for_two_hypotheses(p_prior, readings):
    """Independent sensors with P(z | empty) = p and P(z | wall) = 1 - p: the posterior by enumeration."""
    values = [p if free else 1 - p for free, p in readings]
    empty = p_prior * math.prod(values)
    wall = (1 - p_prior) * math.prod(1 - p for p in values)
    total = sum(math.log(p / (1 - p)) for p in values)
    evidence = Evidence([[total]], [[len(values)]], Grid((1, 1)), RangeSensor())
    assert update_map(strip_map(p_prior), evidence, lam=0).p_empty.item() == pytest.approx(empty / (empty + wall), abs=1e-9)


# --- what the updates do (method page, section 4) -----------------------------------------------------------------------


@given(st.lists(probabilities, min_size=1, max_size=9), lams)
def test_a_cell_that_was_never_seen_keeps_its_prior(p_empty, lam):
    prior_map = strip_map(*p_empty)
    after = update_map(prior_map, Evidence.none(prior_map.grid), lam)
    assert (after.log_odds == prior_map.log_odds).all()


@given(probabilities, probabilities, probabilities)
def test_seen_once_the_thesis_update_forgets_the_prior(strip, p_reading, one, other):
    looks = strip(p_reading, [1, 1])
    after = update_map(strip_map(one, other), looks).p_empty[0]
    np.testing.assert_allclose(after, p_reading, atol=1e-9)


@given(probabilities, st.lists(probabilities, min_size=2, max_size=6, unique=True), st.integers(0, 6))
def test_bayes_update_never_turns_a_higher_prior_into_more_wall(strip, p_reading, priors, n):
    priors = sorted(priors)
    after = update_map(strip_map(*priors), strip(p_reading, [n] * len(priors)), lam=0).log_odds[0]
    assert (np.diff(after) >= 0).all()


@given(probabilities, st.lists(probabilities, min_size=2, max_size=6, unique=True), st.integers(2, 6))
def test_thesis_update_of_a_cell_seen_twice_makes_a_higher_prior_more_wall(strip, p_reading, priors, n):
    priors = sorted(priors)
    after = update_map(strip_map(*priors), strip(p_reading, [n] * len(priors))).log_odds[0]
    assert (np.diff(after) <= 0).all()


def test_a_surer_prior_makes_a_wall_of_free_space():
    """The sensor 0.8 / 0.2 and p_space 1: five free readings make a wall (eq. 2.22 broken)."""
    prior = Prior(0.2, 1.0)
    prior_map = build_prior_map(Walls(np.zeros((1, 1), np.uint8)), prior)
    sensor = RangeSensor(p_free=0.8, p_occupied=0.2)
    evidence = Evidence([[5 * math.log(4)]], [[5]], prior_map.grid, sensor)
    assert update_quietly(prior_map, evidence).detected().all()
    assert not update_map(prior_map, evidence, lam=0).detected().any()


@given(st.integers(0, 30))
def test_prior_1_times_09_never_changes_on_free_readings_of_09(n):
    prior_map = build_prior_map(Walls(np.zeros((1, 1), np.uint8)), Prior(0.2, 1.0))
    evidence = Evidence([[n * math.log(9)]], [[n]], prior_map.grid, RangeSensor())
    assert update_quietly(prior_map, evidence).p_empty.item() == pytest.approx(0.9, abs=1e-9)


def test_prior_1_times_09_counts_a_wall_reading_twice():
    prior_map = build_prior_map(Walls(np.zeros((1, 1), np.uint8)), Prior(0.2, 1.0))
    evidence = Evidence([[-math.log(9)]], [[1]], prior_map.grid, RangeSensor())
    moved = update_quietly(prior_map, evidence).log_odds - prior_map.log_odds
    assert moved.item() == pytest.approx(-2 * math.log(9))


# --- eq. 2.22 ------------------------------------------------------------------------------------------------------------


def test_the_default_prior_and_sensor_go_together(strip):
    prior_map = build_prior_map(Walls(np.zeros((1, 1), np.uint8)))
    assert update_map(prior_map, strip(0.9, [2])).prior == Prior(0.2, 0.9)  # a warning would be an error


@pytest.mark.parametrize(
    ("prior", "sensor", "words"),
    [
        (Prior(0.2, 0.9), RangeSensor(p_free=0.8, p_occupied=0.1), "p_space 0.81 .* p_free 0.8 .* makes space less free"),
        (Prior(0.2, 1.0), RangeSensor(), "p_space 0.9 must lie below the p_free 0.9 .* says nothing"),
        (Prior(0.2, 0.8), RangeSensor(p_free=0.8, p_occupied=0.2), "p_wall 0.18 .* p_occupied 0.2 .* makes walls less of a wall"),
        (Prior(0.2, 0.9), RangeSensor(p_free=0.8, p_occupied=0.2), "p_space 0.81 .*; the effective p_wall 0.18"),
    ],
)
def test_update_map_warns_when_the_prior_is_surer_than_the_sensor(strip, prior, sensor, words):
    prior_map = build_prior_map(Walls(np.zeros((1, 1), np.uint8)), prior)
    with pytest.warns(OverruledSensorWarning, match=words) as caught:
        update_map(prior_map, strip(0.8, [1], sensor))
    assert len(caught) == 1 and caught[0].filename == __file__
    update_map(prior_map, strip(0.8, [1], sensor), lam=0)  # Bayes' rule has no such fault


@given(st.floats(0.02, 1.05), st.floats(0.02, 1.05), st.floats(0.55, 0.95), st.floats(0.05, 0.45))
def test_overruled_readings_is_equation_2_22(p_wall, p_space, p_free, p_occupied):
    prior = Prior(p_wall, p_space)
    gaps = p_free - prior.effective_p_space, prior.effective_p_wall - p_occupied
    if min(map(abs, gaps)) > 1e-6:
        assert (overruled_readings(prior, p_free, p_occupied) is None) == (min(gaps) > 0)


@pytest.mark.parametrize(("p_wall", "p_space"), [(0.1, 0.5), (0.5, 0.9)])
def test_a_prior_as_sure_as_the_sensor_breaks_eq_2_22(p_wall, p_space):
    """On the border a reading that agrees adds exactly nothing."""
    prior = Prior(p_wall, p_space, factor=1.0)
    assert "says nothing" in overruled_readings(prior, 0.9, 0.1)
    assert is_overruled(p_wall, p_space, 0.9, 0.1)


@pytest.mark.parametrize(("lam", "broken"), [(0.5, False), (0.7, True), (1.0, True)])
def test_the_sentence_of_eq_2_22_is_true_for_every_lam(lam, broken):
    """With lam = 0.5 a p_space above p_free is no fault yet, so the sentence must not say that it has to lie below."""
    told = overruled_readings(Prior(0.5, 0.9, factor=1.0), 0.8, 0.1, lam)
    assert (lam * math.log(9) >= math.log(4)) == broken == (told is not None)
    if told:
        assert told.startswith("the effective p_space 0.9" if lam == 1 else "0.7 times the log odds of the effective p_space 0.9")


def test_update_map_says_what_is_wrong(strip):
    with pytest.raises(ValueError, match="map and evidence must lie on one grid"):
        update_map(strip_map(0.5, 0.5), strip(0.9, [1]))
    with pytest.raises(ValueError, match="lam must be a finite number, got nan"):
        update_map(strip_map(0.5), strip(0.9, [1]), lam=math.nan)
