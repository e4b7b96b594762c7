"""The exact sweep against maps built and counted one by one, ties included."""

import ast
import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from priorlab.core.building import Truth
from priorlab.core.drawing import Walls
from priorlab.core.grid import Grid
from priorlab.core.grid_map import Prior
from priorlab.core.log_odds import log_odds
from priorlab.core.readings import Evidence
from priorlab.core.sensor import RangeSensor
from priorlab.mapping.overruled import overruled_readings
from priorlab.optimize.experiment import Experiment

pytestmark = pytest.mark.filterwarnings("ignore::priorlab.mapping.overruled.OverruledSensorWarning")

LAMS = (0.0, 0.5, 1.0)
THRESHOLDS = (0.2, 0.18, 0.5)  # 0.18 = 0.2 x 0.9: a tie on the thesis's own grid
TYING = (0.1, 0.2, 0.2 / 0.9, 0.3, 0.5, 0.8 / 0.9, 0.9, 1.0)
p_values = st.one_of(st.sampled_from(TYING), st.floats(0.05, 1.0))


@settings(max_examples=150, deadline=None)
@given(
    seed=st.integers(0, 10**6),
    cell_size=st.integers(1, 4),
    lam=st.one_of(st.sampled_from(LAMS), st.floats(-0.5, 2.0)),
    threshold=st.one_of(st.sampled_from(THRESHOLDS), st.floats(0.05, 0.5)),
    p_wall=p_values,
    p_space=p_values,
)
def test_sweep_counts_as_brute_force_does(small_case, seed, cell_size, lam, threshold, p_wall, p_space):
    experiment, oracle = small_case(seed, cell_size, lam, threshold)
    score = experiment.sweep().at(p_wall, p_space)
    assert (score.tp, score.fp) == oracle.counts(p_wall, p_space)
    assert score == experiment.score(Prior(p_wall, p_space))


@settings(max_examples=40, deadline=None)
@given(seed=st.integers(0, 10**6), lam=st.sampled_from(LAMS), which=st.integers(0, 10**6))
def test_sweep_decides_a_cell_exactly_on_the_threshold_as_detected(small_case, seed, lam, which):
    experiment, oracle = small_case(seed, lam=lam)
    ties = oracle.candidates(True)
    p_wall = ties[which % len(ties)]  # every second one is a flip value, to the last digit that a float can hold
    score = experiment.sweep().at(p_wall, 0.9)
    assert (score.tp, score.fp) == oracle.counts(p_wall, 0.9)


@pytest.mark.parametrize("cell_size", [0.5, 1.5, 2.7])
def test_sweep_equals_the_long_way_at_fractional_cells(small_case, cell_size):
    experiment, _ = small_case(3, cell_size, shape=(9, 13))
    sweep = experiment.sweep()
    for p_wall, p_space in ((0.2, 0.9), (0.3, 0.3), (1.0, 0.1), (0.5, 1.0)):
        assert sweep.at(p_wall, p_space) == experiment.score(Prior(p_wall, p_space))


def by_hand(looks, total, truth=(True, False, True, False), ignore=(False,) * 4, **options):
    """Four pixels in a row; the plan shows a wall in the first two."""
    grid = Grid((1, 4))
    walls = Walls(np.array([[1, 1, 0, 0]], np.uint8))
    evidence = Evidence(np.array([total], float), np.array([looks]), grid, RangeSensor())
    return Experiment(walls, evidence, Truth(np.array([truth]), np.array([ignore])), **options)


def test_sweep_without_readings_detects_by_the_prior_alone():
    sweep = by_hand([0, 0, 0, 0], [0, 0, 0, 0]).sweep()
    assert repr(sweep.at(0.2, 0.9)) == repr(sweep.at(0.2222, 0.9))  # 0.2 / 0.9 = 0.2222...
    assert (sweep.at(0.2, 0.9).tp, sweep.at(0.2, 0.9).fp) == (1, 1)
    assert (sweep.at(0.2, 0.1).tp, sweep.at(0.2, 0.1).fp) == (2, 2)
    nothing = sweep.at(0.2223, 0.9)
    assert math.isnan(nothing.precision) and nothing.recall == 0 and nothing.f_beta == 0


def test_sweep_with_one_look_does_not_depend_on_the_prior():
    seen = log_odds(0.1).item()  # each pixel seen as wall once, lam = 1
    sweep = by_hand([1, 1, 1, 1], [seen] * 4).sweep()
    table = sweep.grid(30)
    assert (table.tp == 2).all() and (table.fp == 2).all()
    assert np.isnan(sweep.critical()).all() and (sweep.direction == 0).all()


def test_sweep_with_two_looks_makes_more_wall_of_a_higher_prior():
    free = 2 * log_odds(0.8).item()  # seen free twice by a weak sensor
    sweep = by_hand([2, 2, 2, 2], [free] * 4).sweep()
    assert (sweep.direction == 1).all()
    tp, _ = sweep.counts(np.linspace(0.1, 1.0, 50), 0.5)
    assert (np.diff(tp) >= 0).all()
    high = Experiment.sweep(by_hand([2, 2, 2, 2], [free] * 4, factor=0.99))
    assert high.at(1.0, 1.0).recall == 1 and high.at(0.9, 0.9).recall == 0


@pytest.mark.parametrize("seed", range(5))
def test_sweep_with_lam_0_makes_less_wall_of_a_higher_prior(small_case, seed):
    sweep = small_case(seed, lam=0.0)[0].sweep()
    p = np.linspace(0.1, 1, 200)
    for pairs in ((p, 0.5), (0.5, p)):
        tp, fp = sweep.counts(*pairs)
        assert (np.diff(tp) <= 0).all() and (np.diff(fp) <= 0).all()


def test_sweep_leaves_dont_care_pixels_out():
    with_all = by_hand([0] * 4, [0] * 4).sweep()
    without_first = by_hand([0] * 4, [0] * 4, ignore=(True, False, False, False)).sweep()
    assert (with_all.positives, with_all.negatives) == (2, 2)
    assert (without_first.positives, without_first.negatives) == (1, 2)
    assert (without_first.at(0.2, 0.9).tp, without_first.at(0.2, 0.9).fp) == (0, 1)


def test_sweep_grid_holds_what_at_says(small_case):
    sweep = small_case(11, cell_size=2)[0].sweep()
    table = sweep.grid()
    np.testing.assert_array_equal(table.p_wall, [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0])
    for i, p_wall in enumerate(table.p_wall):
        for j, p_space in enumerate(table.p_space):
            score = sweep.at(p_wall, p_space)
            for measure in ("precision", "recall", "f_beta", "false_positive_rate"):
                np.testing.assert_allclose(getattr(table, measure)[i, j], getattr(score, measure), rtol=1e-14, err_msg=measure)


@pytest.mark.parametrize("measure", ["precision", "recall", "f_beta"])
def test_table_best_lists_all_pairs_that_reach_the_highest_value(small_case, measure):
    sweep = small_case(11, cell_size=2)[0].sweep()
    table = sweep.grid()
    slow = {(p, q): getattr(sweep.at(p, q), measure) for p in table.p_wall for q in table.p_space}
    highest = max(value for value in slow.values() if not math.isnan(value))
    assert {tuple(pair) for pair in table.best(measure)} == {pair for pair, value in slow.items() if value == highest}


def test_sweep_grid_takes_any_values(small_case):
    table = small_case(1)[0].sweep().grid([0.2, 0.21], np.linspace(0.3, 1, 7))
    assert table.tp.shape == (2, 7) and table.p_space[-1] == 1
    assert "2 p_wall x 7 p_space" in repr(table) and table._repr_html_().count("<tr>") == 3


def test_sweep_critical_is_where_each_cell_flips(small_case):
    experiment, _ = small_case(5, cell_size=2, shape=(8, 9))
    sweep = experiment.sweep()
    critical = sweep.critical()
    flips = 0
    for row, col in np.argwhere((critical > 0.01) & (critical < 1.09)):
        p, direction = critical[row, col], sweep.direction[row, col]
        at, below, above = (experiment.map(Prior(q, q)).detected()[row, col] for q in (p, p - 1e-6, p + 1e-6))
        assert at and (below, above) == ((True, False) if direction == -1 else (False, True))
        flips += 1
    assert flips > 5
    fixed = np.isnan(critical)
    assert fixed.any()
    np.testing.assert_array_equal(fixed, experiment.evidence.looks == 1)


@settings(max_examples=30, deadline=None)
@given(
    seed=st.integers(0, 10**6),
    lam=st.sampled_from(LAMS),
    p_free=st.sampled_from([0.8, 0.9]),
    p_occupied=st.sampled_from([0.1, 0.2]),
)
def test_sweep_knows_which_priors_break_eq_2_22(small_case, seed, lam, p_free, p_occupied):
    """The column says what the update warns of, pair by pair."""
    experiment, _ = small_case(seed, lam=lam)
    evidence = dataclasses.replace(experiment.evidence, sensor=RangeSensor(p_free=p_free, p_occupied=p_occupied))
    table = dataclasses.replace(experiment, evidence=evidence).sweep().grid()
    expected = [
        [overruled_readings(Prior(p_wall, p_space), p_free, p_occupied, lam) is not None for p_space in table.p_space]
        for p_wall in table.p_wall
    ]
    assert table.overruled.tolist() == expected
    assert table.overruled.any() == (lam > 0.5)  # half the prior taken off is never too much here


def test_overruled_priors_of_the_thesis_grid_are_those_of_eq_2_22(small_case):
    """Effective p_space 0.9 p >= 0.9 only at 1; effective p_wall 0.9 p <= 0.1 only at 0.1; with 0.8 / 0.2 also 0.9 and 0.2."""
    experiment, _ = small_case(0)
    strong = experiment.sweep().grid()
    assert (strong.overruled == ((strong.p_wall[:, None] == 0.1) | (strong.p_space == 1.0))).all()
    weak = dataclasses.replace(experiment.evidence, sensor=RangeSensor(p_free=0.8, p_occupied=0.2))
    weak = dataclasses.replace(experiment, evidence=weak).sweep().grid()
    assert (weak.overruled == ((weak.p_wall[:, None] <= 0.2) | (weak.p_space >= 0.9))).all()
    assert "* breaks eq. 2.22" in strong._repr_html_() and strong._repr_html_().count("*</td>") == 19


@pytest.mark.parametrize("factor", [0.5, 0.97])
def test_the_column_of_eq_2_22_takes_the_factor_and_lam(small_case, factor):
    """A free look of plan space adds logit(0.6) - lam l_0, a wall look of a plan wall logit(0.4) - lam l_0: by hand."""
    for lam in (0.0, 0.3, 1.0, 2.0):
        experiment = dataclasses.replace(small_case(0, lam=lam)[0], factor=factor)
        weak = dataclasses.replace(experiment.evidence, sensor=RangeSensor(p_free=0.6, p_occupied=0.4))
        table = dataclasses.replace(experiment, evidence=weak).sweep().grid()
        space, wall = (lam * np.log(p * factor / (1 - p * factor)) for p in (table.p_space, table.p_wall[:, None]))
        np.testing.assert_array_equal(table.overruled, (math.log(1.5) - space <= 1e-9) | (-math.log(1.5) - wall >= -1e-9))
        assert table.overruled.any() == (lam > 0)


def test_table_records_are_rows_with_everything_that_is_known(small_case):
    table = small_case(11, cell_size=2)[0].sweep().grid([0.2, 0.3], [0.5, 0.8, 1.0])
    rows = table.records()
    assert [(row["p_wall"], row["p_space"]) for row in rows] == [(a, b) for a in (0.2, 0.3) for b in (0.5, 0.8, 1.0)]
    last = rows[-1]
    assert last["effective_p_space"] == 0.9 and last["breaks_eq_2_22"] is True and rows[0]["breaks_eq_2_22"] is False
    for measure in ("precision", "recall", "f_beta", "false_positive_rate"):
        np.testing.assert_equal(last[measure], float(getattr(table, measure)[1, 2]))


def test_front_knows_which_of_its_priors_break_eq_2_22(noisy_flat):
    sweep = noisy_flat().sweep()
    front = sweep.front()
    assert (front.overruled == sweep.overruled(front.p_wall, front.p_space)).all()
    page = front._repr_html_()
    shown = min(len(front), 12)
    assert page.count("<td>kept</td>") + page.count("<td>broken</td>") == shown and "eq. 2.22" in page


@pytest.mark.parametrize("factor", [1.0, 1.2])
def test_sweep_with_another_factor_covers_the_same_effective_priors(noisy_flat, factor):
    """p x factor is what counts: the front, the optimum and the grid are those of the thesis's factor."""
    thesis, other = (dataclasses.replace(noisy_flat(), factor=f).sweep() for f in (0.9, factor))
    assert other.bounds == pytest.approx((0.09 / factor, 0.9 / factor))
    np.testing.assert_array_equal(other.front().precision, thesis.front().precision)
    np.testing.assert_allclose(other.front().priors * factor, thesis.front().priors * 0.9, atol=1e-12)
    for measure in ("precision", "recall", "f_beta"):
        assert other.best(measure).value == thesis.best(measure).value
    np.testing.assert_array_equal(other.grid().tp, thesis.grid().tp)
    with pytest.raises(ValueError, match="the effective bounds must lie strictly between 0 and 1"):
        other.front(bounds=(0.1, 1.0))


def test_sweep_says_what_is_wrong(small_case):
    sweep = small_case(0)[0].sweep()
    with pytest.raises(ValueError, match=r"the effective p_wall must lie strictly between 0 and 1, got 0 x 0\.9 = 0"):
        sweep.at(0.0, 0.5)
    with pytest.raises(ValueError, match=r"the effective p_space must lie .* got 1\.2 x 0\.9 = 1\.08"):
        sweep.grid([0.5], [0.5, 1.2])
    with pytest.raises(ValueError, match="at least 2 values a side, got 1"):
        sweep.grid(1)
    with pytest.raises(ValueError, match="one row of numbers"):
        sweep.grid(np.ones((2, 2)))
    with pytest.raises(ValueError, match="measure must be"):
        sweep.best("accuracy")
    with pytest.raises(ValueError, match="floor must lie"):
        sweep.front(floor=40)
    for bounds in ((1.0, 0.1), (0.5,), (0.1, 0.5, 1.0)):
        with pytest.raises(ValueError, match="a lower and a higher"):
            sweep.front(bounds=bounds)
    with pytest.raises(ValueError, match="a grid must have at most 50,000,000 pairs, got 10,000,000 x 10,000,000"):
        sweep.grid(10_000_000)


def test_experiment_says_what_is_wrong(small_case):
    good = small_case(0)[0]
    other = Truth(np.zeros((5, 7), bool), np.zeros((5, 7), bool))
    with pytest.raises(ValueError, match=r"one drawing, got walls 6 x 5, evidence 6 x 5, truth 7 x 5 pixels"):
        Experiment(good.walls, good.evidence, other)
    for wrong, sentence in (
        (dict(lam=float("nan")), "lam must be a finite number"),
        (dict(lam="1"), "lam must be a number, got '1'"),
        (dict(threshold="low"), "threshold must be a number, got 'low'"),
        (dict(threshold=1.0), "threshold must lie above 0 and be at most 0.5"),
        (dict(beta=0), "beta must be"),
        (dict(factor=-1), "factor must be"),
    ):
        with pytest.raises(ValueError, match=sentence):
            Experiment(good.walls, good.evidence, good.truth, **wrong)


def test_oracle_shares_nothing_with_the_sweep():
    tree = ast.parse((Path(__file__).parent / "conftest.py").read_text())
    oracle = next(node for node in tree.body if isinstance(node, ast.ClassDef) and node.name == "Oracle")
    names = {node.id for node in ast.walk(oracle) if isinstance(node, ast.Name)}
    imported = {
        alias.asname or alias.name
        for node in tree.body
        if isinstance(node, ast.ImportFrom) and node.module.startswith("priorlab")
        for alias in node.names
    }
    assert imported and not names & imported
