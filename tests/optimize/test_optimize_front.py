"""Fronts, optima and their ranges against every pair of candidate priors, counted one by one."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from priorlab.core.grid_map import Prior
from priorlab.optimize.front import Front, hypervolume, non_dominated

pytestmark = pytest.mark.filterwarnings("ignore::priorlab.mapping.overruled.OverruledSensorWarning")

cases = dict(
    seed=st.integers(0, 10**6),
    cell_size=st.integers(1, 3),
    lam=st.sampled_from([0.0, 0.5, 1.0]),
    threshold=st.sampled_from([0.2, 0.18, 0.5]),
)


def slow_front(objectives, positives, floor):
    """All undominated (precision, recall), by comparing everybody with everybody."""
    reached = {(tp / (tp + fp), tp / positives) for _, _, tp, fp in objectives if tp}
    allowed = {(p, r) for p, r in reached if p > floor and r > floor}
    return sorted(
        (one for one in allowed if not any(o != one and o[0] >= one[0] and o[1] >= one[1] for o in allowed)), reverse=True
    )


@settings(max_examples=60, deadline=None)
@given(**cases, floor=st.sampled_from([0.0, 0.4]))
def test_front_is_the_brute_force_front(small_case, seed, cell_size, lam, threshold, floor):
    experiment, oracle = small_case(seed, cell_size, lam, threshold, shape=(4, 5))
    sweep = experiment.sweep()
    front = sweep.front(floor=floor)
    expected = slow_front(oracle.objectives(), sweep.positives, floor) if sweep.positives else []
    assert list(zip(front.precision, front.recall, strict=True)) == expected
    assert bool(front.note) == (len(expected) == 0)
    for p_wall, p_space, precision, recall in zip(front.p_wall, front.p_space, front.precision, front.recall, strict=True):
        score = experiment.score(Prior(p_wall, p_space))  # each prior of the front reaches what it promises, the long way
        assert (score.precision, score.recall) == (precision, recall)


def ends_and_middle(span):
    """Values of a range that must be in it, its ends when they are."""
    inside = [span.middle]
    inside += [span.low] if span.includes_low else [span.low + 1e-7] if span.width > 1e-6 else []
    inside += [span.high] if span.includes_high else [span.high - 1e-7] if span.width > 1e-6 else []
    return inside


@settings(max_examples=40, deadline=None)
@given(**cases)
def test_front_ranges_hold_all_priors_of_a_point_and_no_other(small_case, seed, cell_size, lam, threshold):
    experiment, oracle = small_case(seed, cell_size, lam, threshold, shape=(4, 5))
    sweep = experiment.sweep()
    front = sweep.front(floor=0.0)
    assert len(front.ranges) == len(front)
    objectives = oracle.objectives()
    for i, plateaus in enumerate(front.ranges):
        for plateau in plateaus:
            for p_wall in ends_and_middle(plateau.p_wall):
                for p_space in ends_and_middle(plateau.p_space):
                    tp, fp = oracle.counts(p_wall, p_space)
                    assert (tp / (tp + fp), tp / sweep.positives) == (front.precision[i], front.recall[i])
        for p_wall, p_space, tp, fp in objectives:
            reaches = tp > 0 and (tp / (tp + fp), tp / sweep.positives) == (front.precision[i], front.recall[i])
            near = any(_within(p_wall, one.p_wall) and _within(p_space, one.p_space) for one in plateaus)
            assert near or not reaches


def _within(p, span):
    """In a range, but for the last digits of a float."""
    return span.low - 1e-12 <= p <= span.high + 1e-12


@settings(max_examples=60, deadline=None)
@given(**cases, measure=st.sampled_from(["precision", "recall", "f_beta"]))
def test_best_is_the_brute_force_optimum_and_all_its_plateaus(small_case, seed, cell_size, lam, threshold, measure):
    experiment, oracle = small_case(seed, cell_size, lam, threshold, shape=(4, 5))
    sweep = experiment.sweep()
    best = sweep.best(measure)

    def value(tp, fp):
        if not tp:
            return 0.0
        if measure == "precision":
            return tp / (tp + fp)
        return tp / sweep.positives if measure == "recall" else 5 * tp / (tp + fp + 4 * sweep.positives)

    objectives = oracle.objectives()
    highest = max(value(tp, fp) for *_, tp, fp in objectives)
    assert best.value == highest
    assert bool(best.plateaus) == (highest > 0)
    for plateau in best.plateaus:
        for p_wall in ends_and_middle(plateau.p_wall):
            for p_space in ends_and_middle(plateau.p_space):
                assert value(*oracle.counts(p_wall, p_space)) == highest
    for p_wall, p_space, tp, fp in objectives:
        if highest and value(tp, fp) == highest:
            assert any(_within(p_wall, one.p_wall) and _within(p_space, one.p_space) for one in best.plateaus)


def test_best_plateaus_are_joined_where_the_measure_does_not_change(small_case):
    experiment, _ = small_case(2, shape=(6, 6))
    for measure in ("precision", "recall", "f_beta"):
        plateaus = experiment.sweep().best(measure).plateaus
        for first in plateaus:  # no two plateaus lie side by side as one wider range
            for second in plateaus:
                side_by_side = first.p_wall.high == second.p_wall.low and first.p_space == second.p_space
                meet = first.p_wall.includes_high or second.p_wall.includes_low
                assert not (first is not second and side_by_side and meet)


def test_front_of_a_large_drawing_is_found_in_blocks(noisy_flat, monkeypatch):
    sweep = noisy_flat().sweep()
    at_once = sweep.front()
    monkeypatch.setattr("priorlab.optimize.exact_front._PAIRS", 50)
    in_blocks = sweep.front()
    assert len(at_once) > 3
    np.testing.assert_array_equal(in_blocks.priors, at_once.priors)
    assert in_blocks.ranges == at_once.ranges


def test_front_beats_every_prior_of_a_fine_grid(noisy_flat):
    sweep = noisy_flat(seed=3).sweep()
    front, table = sweep.front(floor=0.0), sweep.grid(120)
    for precision, recall in zip(table.precision.ravel(), table.recall.ravel(), strict=True):
        assert np.isnan(precision) or recall == 0 or ((front.precision >= precision) & (front.recall >= recall)).any()


def test_front_floor_is_strict_as_eq_4_19_has_it(noisy_flat):
    sweep = noisy_flat().sweep()
    front = sweep.front()
    lowest = float(front.recall.min())
    assert (sweep.front(floor=lowest).recall > lowest).all()
    assert sweep.front(floor=lowest - 1e-12).recall.min() == lowest


def test_front_that_cannot_be_is_empty_and_says_why(small_case, noisy_flat):
    front = noisy_flat(seed=1).sweep().front(floor=0.97)
    assert len(front) == 0 and front.hypervolume == 0.0 and front.priors.shape == (0, 2)
    assert "above 97 % (eq. 4.19): the nearest has" in front.note
    assert "empty" in repr(front) and front.note in front._repr_html_()
    no_wall = small_case(0)[0]
    no_wall = type(no_wall)(
        no_wall.walls, no_wall.evidence, type(no_wall.truth)(no_wall.truth.walls & False, no_wall.truth.ignore)
    )
    assert no_wall.sweep().front().note.endswith("none detects a true wall")
    assert repr(no_wall.sweep().best()) == "Best(f_beta: no prior detects a true wall)"


@settings(max_examples=100, deadline=None)
@given(st.lists(st.tuples(st.integers(0, 5), st.integers(0, 5)), max_size=12))
def test_non_dominated_agrees_with_comparing_everybody(points):
    precision, recall = [p for p, _ in points], [r for _, r in points]
    kept = non_dominated(precision, recall).tolist()
    slow = [i for i, (p, r) in enumerate(points) if not any(q >= p and s >= r and (q, s) != (p, r) for q, s in points)]
    assert sorted(kept) == slow
    assert [precision[i] for i in kept] == sorted((precision[i] for i in kept), reverse=True)


@settings(max_examples=50, deadline=None)
@given(st.lists(st.tuples(st.integers(0, 20), st.integers(0, 20)), max_size=8))
def test_hypervolume_agrees_with_counting_squares(points):
    covered = {(x, y) for p, r in points for x in range(p) for y in range(r)}
    assert hypervolume([p / 20 for p, _ in points], [r / 20 for _, r in points]) == pytest.approx(len(covered) / 400)


def test_front_shows_itself():
    front = Front(np.array([0.3, 0.2]), np.array([0.4, 0.9]), np.array([0.9, 0.5]), np.array([0.5, 0.8]), name="exact")
    assert repr(front) == ("Front(exact: 2 priors, precision 0.500 to 0.900, recall 0.500 to 0.800, hypervolume 0.6000)")
    assert front._repr_html_().count("<tr>") == 3
