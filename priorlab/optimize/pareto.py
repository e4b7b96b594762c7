"""The Pareto front as the thesis searched for it: with a genetic algorithm (thesis 4.4)."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import check_record, check_rng, check_whole
from priorlab.core.measures import share
from priorlab.core.progress import Progress
from priorlab.optimize.experiment import Experiment
from priorlab.optimize.front import FLOOR, Front, check_floor, non_dominated
from priorlab.optimize.sweep import Sweep

_LEAST = 1e-6
"""Precision or recall below this count as this: 1/pre and 1/rec stay finite where nothing is detected."""


def pareto_front(
    experiment: Experiment,
    rng: np.random.Generator,
    population: int = 60,
    generations: int = 40,
    bounds: tuple[float, float] | None = None,
    floor: float = FLOOR,
    progress: Progress | None = None,
) -> Front:
    """Search the Pareto front of precision and recall with NSGA-II.

    Minimizes 1/precision and 1/recall over p_wall and p_space in `bounds`, both above `floor` (eq. 4.19). The first
    population holds the 10 x 10 grid and as many random pairs as a population; nothing of the exact front is told, so that
    `Sweep.front()` can judge it. This is pymoo's plain NSGA-II: the controlled elitism of the thesis is not reproduced.

    Parameters
    ----------
    experiment : scored exactly for every pair that the search tries
    rng : draws the random pairs and pymoo's seed
    population, generations : size of the search
    bounds : of p_wall and p_space, before the factor; (0.1, 1) with the thesis's factor (`bounds_for`)
    floor : precision and recall must both lie above it
    progress : called with the generations done and the generations to do

    Returns
    -------
    Front, one prior for each pair of objectives; empty, with a sentence in its note, when none was found.
    """
    check_record("experiment", experiment, Experiment)
    population, generations = check_whole("population", population, least=2), check_whole("generations", generations)
    floor, rng = check_floor(floor), check_rng(rng)
    sweep = experiment.sweep()
    bounds = sweep.checked(bounds)
    first = _first_population(rng, population, bounds)
    found = _search(sweep, first, int(rng.integers(2**31)), population, generations, bounds, floor, progress)
    precision, recall = _objectives(sweep, found)
    allowed = (precision > floor) & (recall > floor)
    found, precision, recall = found[allowed], precision[allowed], recall[allowed]
    kept = non_dominated(precision, recall)
    kept = kept[np.diff(precision[kept], prepend=np.inf) != 0]  # sorted by precision: unique by objective
    name = f"NSGA-II {population} x {generations}"
    note = "" if kept.size else f"the search found no prior with precision and recall above {100 * floor:g} % (eq. 4.19)"
    overruled = sweep.overruled(found[kept, 0], found[kept, 1])
    return Front(found[kept, 0], found[kept, 1], precision[kept], recall[kept], name, note, overruled=overruled)


def _first_population(rng: np.random.Generator, population: int, bounds: tuple[float, float]) -> NDArray[np.float64]:
    """The thesis's grid and random pairs: the grid alone never leaves its lattice, random pairs alone can miss a plateau."""
    axis = np.round(np.linspace(*bounds, 10), 12)
    grid = np.stack(np.meshgrid(axis, axis, indexing="ij"), axis=-1).reshape(-1, 2)
    return np.concatenate([grid, rng.uniform(*bounds, size=(population, 2))])


def _search(
    sweep: Sweep,
    first: NDArray[np.float64],
    seed: int,
    population: int,
    generations: int,
    bounds: tuple[float, float],
    floor: float,
    progress: Progress | None,
) -> NDArray[np.float64]:
    """(N, 2) the last population of pymoo's NSGA-II, feasible or not."""
    from pymoo.algorithms.moo.nsga2 import NSGA2  # half a second to import: only who searches waits for it
    from pymoo.core.problem import Problem
    from pymoo.optimize import minimize

    class PriorChoice(Problem):
        """Eq. 4.19."""

        def _evaluate(self, x: NDArray[np.float64], out: dict[str, Any], *_: Any, **__: Any) -> None:
            inverse = 1.0 / np.column_stack(_objectives(sweep, x)).clip(_LEAST)
            out["F"] = inverse
            out["G"] = inverse - 1.0 / max(floor, _LEAST)

    problem = PriorChoice(n_var=2, n_obj=2, n_ieq_constr=2, xl=bounds[0], xu=bounds[1])
    algorithm = NSGA2(pop_size=population, sampling=first)

    def tell(search: NSGA2) -> None:
        """pymoo's call after every generation; what it raises ends the search."""
        if progress:
            progress(search.n_gen, generations)

    with _global_generator_kept():
        result = minimize(problem, algorithm, ("n_gen", generations), seed=seed, verbose=False, callback=tell)
    return np.atleast_2d(result.pop.get("X")).astype(np.float64)


def _objectives(sweep: Sweep, priors: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Precision and recall of (N, 2) pairs; 0 where nothing is detected."""
    tp, fp = sweep.counts(priors[:, 0], priors[:, 1])
    return np.nan_to_num(share(tp, tp + fp)), np.nan_to_num(share(tp, sweep.positives))


@contextlib.contextmanager
def _global_generator_kept() -> Iterator[None]:
    """pymoo before 0.6.1.5 seeds NumPy's global generator: put it back as it was."""
    state = np.random.get_state()  # noqa: NPY002
    try:
        yield
    finally:
        np.random.set_state(state)  # noqa: NPY002
