"""NSGA-II against the exact front, which it is not told."""

import dataclasses
import subprocess
import sys

import numpy as np
import pytest

from priorlab.core.building import Truth
from priorlab.core.drawing import Walls
from priorlab.core.grid import Grid
from priorlab.core.readings import Evidence
from priorlab.optimize.experiment import Experiment
from priorlab.optimize.front import non_dominated
from priorlab.optimize.pareto import pareto_front


@pytest.fixture(scope="module")
def flat(noisy_flat):
    return noisy_flat()


@pytest.mark.parametrize("seed", [0, 1])
def test_pareto_front_comes_close_to_the_exact_one_and_never_beats_it(flat, seed):
    exact = flat.sweep().front()
    found = pareto_front(flat, np.random.default_rng(seed))
    assert 0.97 * exact.hypervolume <= found.hypervolume <= exact.hypervolume + 1e-12
    assert len(found) > 3
    for precision, recall in zip(found.precision, found.recall, strict=True):
        assert ((exact.precision >= precision) & (exact.recall >= recall)).any()


def test_pareto_front_keeps_the_constraints_of_eq_4_19(flat):
    found = pareto_front(flat, np.random.default_rng(3), population=20, generations=5)
    assert ((found.priors >= 0.1) & (found.priors <= 1.0)).all()
    assert (found.precision > 0.4).all() and (found.recall > 0.4).all()
    assert len(np.unique(np.column_stack([found.precision, found.recall]), axis=0)) == len(found)
    assert len(non_dominated(found.precision, found.recall)) == len(found)
    sweep = flat.sweep()
    for i, (p_wall, p_space) in enumerate(found.priors):
        score = sweep.at(p_wall, p_space)
        assert (score.precision, score.recall) == (found.precision[i], found.recall[i])


def test_pareto_front_repeats_itself_with_one_seed_and_leaves_the_global_generator_alone(flat):
    np.random.seed(5)  # noqa: NPY002
    expected = np.random.random()  # noqa: NPY002
    np.random.seed(5)  # noqa: NPY002
    first = pareto_front(flat, np.random.default_rng(7), population=20, generations=4)
    assert np.random.random() == expected  # noqa: NPY002
    second = pareto_front(flat, np.random.default_rng(7), population=20, generations=4)
    np.testing.assert_array_equal(first.priors, second.priors)
    other = pareto_front(flat, np.random.default_rng(8), population=20, generations=4)
    assert first.priors.shape != other.priors.shape or (first.priors != other.priors).any()


def test_pareto_front_puts_the_global_generator_back_after_a_pymoo_that_seeds_it(flat, monkeypatch):
    from pymoo import optimize

    minimize = optimize.minimize

    def as_older_ones_did(*args, seed, **options):
        np.random.seed(seed)  # noqa: NPY002
        return minimize(*args, seed=seed, **options)

    monkeypatch.setattr(optimize, "minimize", as_older_ones_did)
    np.random.seed(5)  # noqa: NPY002
    expected = np.random.random()  # noqa: NPY002
    np.random.seed(5)  # noqa: NPY002
    pareto_front(flat, np.random.default_rng(7), population=10, generations=2)
    assert np.random.random() == expected  # noqa: NPY002


def test_pareto_front_without_a_feasible_prior_is_empty_and_says_so(flat):
    found = pareto_front(flat, np.random.default_rng(0), population=10, generations=3, floor=0.99)
    assert len(found) == 0 and "above 99 % (eq. 4.19)" in found.note


def test_pareto_front_of_walls_that_nobody_detects_is_empty(noisy_flat):
    some = noisy_flat(seed=2)
    blank = Truth(some.truth.walls & False, some.truth.ignore)
    found = pareto_front(Experiment(some.walls, some.evidence, blank), np.random.default_rng(0), population=10, generations=3)
    assert len(found) == 0 and found.note


def test_pareto_front_says_how_far_it_is_and_can_be_interrupted(flat):
    told = []
    search = dict(population=10, generations=4)
    quiet = pareto_front(flat, np.random.default_rng(7), **search)
    loud = pareto_front(flat, np.random.default_rng(7), **search, progress=lambda done, to_do: told.append((done, to_do)))
    assert told == [(1, 4), (2, 4), (3, 4), (4, 4)]
    np.testing.assert_array_equal(loud.priors, quiet.priors)

    def interrupt(done, to_do):
        raise KeyboardInterrupt

    state = np.random.get_state()[1].tolist()  # noqa: NPY002
    with pytest.raises(KeyboardInterrupt):
        pareto_front(flat, np.random.default_rng(7), **search, progress=interrupt)
    assert np.random.get_state()[1].tolist() == state  # noqa: NPY002
    np.testing.assert_array_equal(pareto_front(flat, np.random.default_rng(7), **search).priors, quiet.priors)


def test_pareto_front_with_another_factor_searches_the_same_effective_priors(flat):
    found = pareto_front(dataclasses.replace(flat, factor=1.0), np.random.default_rng(3), population=20, generations=5)
    assert len(found) and ((found.priors >= 0.09) & (found.priors <= 0.9)).all()
    with pytest.raises(ValueError, match=r"the effective bounds must lie strictly between 0 and 1, got 1\.2 x 0\.9 = 1\.08"):
        pareto_front(flat, np.random.default_rng(0), bounds=(0.1, 1.2))


@pytest.fixture(scope="module")
def unseen():
    """Nobody looks: p_wall up to 0.222 finds one of two walls, p_space up to 0.222 the other with two false pixels."""
    walls = Walls(np.array([[1, 0, 0, 0]], dtype=np.uint8))
    truth = Truth(np.array([[True, True, False, False]]), np.zeros((1, 4), dtype=bool))
    return Experiment(walls, Evidence.none(Grid((1, 4))), truth)


def test_pareto_front_wants_both_measures_above_the_floor(unseen):
    found = pareto_front(unseen, np.random.default_rng(0), population=10, generations=5, floor=0.45)
    assert list(zip(found.precision, found.recall, strict=True)) == [(1.0, 0.5), (0.5, 1.0)]
    assert unseen.sweep().front(floor=0.45).hypervolume == found.hypervolume == 0.75
    none = pareto_front(unseen, np.random.default_rng(0), population=10, generations=5, floor=0.7)  # either alone reaches 0.7
    assert len(none) == 0 and "above 70 %" in none.note


def test_pareto_front_never_leaves_its_bounds(unseen):
    """Just below 0.3 there is a front; a search that may not go there finds none."""
    found = pareto_front(unseen, np.random.default_rng(0), population=20, generations=20, bounds=(0.3, 1.0))
    assert len(found) == 0 == len(unseen.sweep().front(bounds=(0.3, 1.0)))


def test_pareto_front_refuses_a_search_of_nobody(flat):
    with pytest.raises(ValueError, match="population must be a whole number of at least 2, got 1"):
        pareto_front(flat, np.random.default_rng(0), population=1)
    with pytest.raises(ValueError, match="population must be a whole number of at least 2, got 10.5"):
        pareto_front(flat, np.random.default_rng(0), population=10.5)
    with pytest.raises(ValueError, match="generations must be a whole number of at least 1, got 0"):
        pareto_front(flat, np.random.default_rng(0), generations=0)


@pytest.mark.parametrize(
    ("floor", "got"), [(float("nan"), "got nan"), (2, r"in \[0, 1\), got 2"), (-0.1, r"in \[0, 1\), got -0.1")]
)
def test_pareto_front_refuses_a_floor_that_the_exact_front_refuses(flat, floor, got):
    for search in (lambda: pareto_front(flat, np.random.default_rng(0), floor=floor), lambda: flat.sweep().front(floor=floor)):
        with pytest.raises(ValueError, match=f"floor must .*{got}"):
            search()


def test_optimize_loads_pymoo_and_scikit_learn_only_when_used():
    code = (
        "import sys, priorlab.optimize.pareto, priorlab.optimize.clusters, priorlab.optimize.interpolation; "
        "print([name for name in ('pymoo', 'sklearn', 'matplotlib', 'scipy') if name in sys.modules])"
    )
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.strip() == "[]"
