"""Figures 4.5, 4.7 and 4.8: the sweep, the fronts, the clusters, of the bundled buildings."""

from __future__ import annotations

import numpy as np

from priorlab import plot
from priorlab.figures.case import cases
from priorlab.figures.figure import Entry, Outcome, sheet, verdict_of
from priorlab.optimize.clusters import cluster
from priorlab.optimize.interpolation import interpolate
from priorlab.optimize.pareto import pareto_front


def _colour_maps(rng: np.random.Generator) -> Outcome:
    """Precision and recall of every prior, exact; is there a prior that is best in both?"""
    ours = cases()
    figure, axes = sheet(len(ours), 2, 4.6, 3.6)
    numbers, conflict, low_space = {}, [], []
    errors: list[float] = []
    for i, one in enumerate(ours):
        sweep = one.experiment.sweep()
        for ax, measure in zip(axes[2 * i : 2 * i + 2], ("precision", "recall"), strict=True):
            plot.sweep(sweep, measure, ax, title=f"{one.plan.name}: {measure}")
        precision, recall = sweep.best("precision"), sweep.best("recall")
        at_best = [sweep.at(where.p_wall.middle, where.p_space.middle) for where in precision.plateaus]
        conflict.append(all(score.recall < recall.value - 1e-9 for score in at_best))
        low_space.append(any(0.3 in where.p_space for where in precision.plateaus))
        errors.append(interpolate(sweep).error(sweep, "precision").largest)
        numbers[one.plan.name] = {
            "max_precision": precision.value,
            "max_precision_at": [str(where) for where in precision.plateaus[:3]],
            "max_recall": recall.value,
            "max_recall_at": [str(where) for where in recall.plateaus[:3]],
            "largest_error_of_the_interpolated_table": errors[-1],
            "mean_looks": one.experiment.evidence.mean_looks,
        }
    return Outcome(
        figure,
        numbers,
        verdict_of([*conflict, *low_space]),
        f"no prior is best in both measures on {sum(conflict)} of {len(ours)} buildings; p_space = 0.3 is among the "
        f"precision optima on "
        f"{sum(low_space)}; straight lines between the thesis's 10 x 10 priors err by up to {max(errors):.2f}",
        "Colour maps of precision (left) and recall (right) over p_wall and p_space, one row for each bundled building.",
    )


def _fronts(rng: np.random.Generator) -> Outcome:
    """The true fronts of all buildings, and what NSGA-II finds of each."""
    ours = cases()
    figure, (ax, beside) = sheet(1, 2, 5.8, 4.4)
    exact = {one.plan.name: one.experiment.sweep().front() for one in ours}
    found = {one.plan.name: pareto_front(one.experiment, child) for one, child in zip(ours, rng.spawn(len(ours)), strict=True)}
    plot.front(exact, ax, title="exact")
    plot.front(found, beside, title="as NSGA-II finds them")
    ratio = {name: found[name].hypervolume / front.hypervolume if len(front) else float("nan") for name, front in exact.items()}
    has = [len(front) > 0 for front in exact.values()]
    many = [len(front) > 1 for front in exact.values()]
    numbers = {
        name: {
            "exact_priors": len(exact[name]),
            "searched_priors": len(found[name]),
            "hypervolume_ratio": None if np.isnan(ratio[name]) else ratio[name],
        }
        for name in exact
    }
    worst = min((value for value in ratio.values() if not np.isnan(value)), default=float("nan"))
    return Outcome(
        figure,
        numbers,
        verdict_of([*has, *many]),
        f"{sum(has)} of {len(ours)} buildings have priors above 40 % in both measures, {sum(many)} a front of more than "
        f"one point; NSGA-II "
        f"reaches at least {100 * worst:.1f} % of the true hypervolume",
        "Pareto fronts in recall and precision for every bundled building: exact on the left, searched on the right.",
    )


def _clusters(rng: np.random.Generator) -> Outcome:
    """The priors of all searched fronts in three groups."""
    ours = cases()
    *search, rng_means = rng.spawn(len(ours) + 1)
    groups = cluster([pareto_front(one.experiment, child) for one, child in zip(ours, search, strict=True)], rng=rng_means)
    figure, axes = sheet(1, 2, 4.8, 4.4)
    axes[0].plot(groups.priors[:, 0], groups.priors[:, 1], "k.")
    axes[0].set(xlim=(0.05, 1.05), ylim=(0.05, 1.05), aspect="equal", title="all priors")
    axes[0].set(xlabel="p_wall, before the factor", ylabel="p_space, before the factor")
    plot.clusters(groups, axes[1], title="in clusters")
    proposed = [bool(len(groups.priors)) and bool(np.hypot(*(groups.priors - [0.2, 0.9]).T).min() < 0.1)]
    low_wall = [bool((centre[0] < 0.25) and (centre[1] > 0.5)) for centre in groups.centres]
    numbers = {"centres": groups.centres.tolist(), "priors": len(groups.priors), "note": groups.note}
    said = "; ".join(f"({w:.2f}, {s:.2f})" for w, s in groups.centres.tolist())
    return Outcome(
        figure,
        numbers,
        verdict_of([any(low_wall), *proposed]),
        f"{len(groups.priors)} priors, centres at {said or 'none'}; the thesis's third cluster (p_wall about 0.2, p_space "
        f"above 0.58) is "
        f"{'there' if any(low_wall) else 'not there'}",
        "The priors of all Pareto fronts over p_wall and p_space: as points, and in clusters with a cross at each centre.",
    )


FIGURE_4_5 = Entry(
    "fig-4-5",
    "precision and recall of every prior",
    "High precision and high recall exclude each other; the highest precision lies at p_space = 0.3.",
    _colour_maps,
)
FIGURE_4_7 = Entry(
    "fig-4-7", "Pareto fronts of all buildings", "All drawings have solutions above 40 % in both measures.", _fronts
)
FIGURE_4_8 = Entry(
    "fig-4-8",
    "clusters of the Pareto optimal priors",
    "Three clusters; the best maps come from p_wall 0.18 to 0.21 and p_space 0.58 to 1, with (0.2, 0.9) proposed.",
    _clusters,
)
