"""Figures 4.5, 4.7 and 4.8: the sweep, the fronts, the clusters, of the five drawings."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from priorlab import plot
from priorlab.figures.case import cases, searched_front
from priorlab.figures.figure import Entry, Outcome, sheet, verdict_of
from priorlab.optimize.clusters import Clusters, cluster
from priorlab.optimize.front import Front
from priorlab.study.thesis_drawings import QUICK

PROPOSED = (0.2, 0.9)
"""p_wall and p_space that the thesis proposes for every drawing."""


def _colour_maps(rng: np.random.Generator) -> Outcome:
    """Precision and recall of every prior, exact; is there a prior that is best in both?"""
    ours = cases()
    figure, axes = sheet(len(ours), 2, 4.6, 3.6)
    numbers, conflict, low_space, on_cliff = {}, [], [], []
    for i, one in enumerate(ours):
        sweep = one.experiment.sweep()
        for ax, measure in zip(axes[2 * i : 2 * i + 2], ("precision", "recall"), strict=True):
            plot.sweep(sweep, measure, ax, title=f"{one.plan.name}: {measure}")
        precision, recall = sweep.best("precision"), sweep.best("recall")
        conflict.append(float(sweep.front(floor=0).recall[0]) < recall.value)  # of all that reach the highest precision
        tops = sweep.grid().best("precision")
        low_space.append(bool((np.abs(tops[:, 1] - 0.3) < 1e-9).any()))
        on_cliff.append(bool((np.abs(tops[:, 0] - 0.2) < 1e-9).any()))
        numbers[one.plan.name] = {
            "max_precision": precision.value,
            "max_precision_at": [str(where) for where in precision.plateaus[:3]],
            "max_recall": recall.value,
            "max_recall_at": [str(where) for where in recall.plateaus[:3]],
            "p_space_0.3_among_the_precision_maxima": low_space[-1],
            "p_wall_0.2_among_the_precision_maxima": on_cliff[-1],
            "mean_looks": one.experiment.evidence.mean_looks,
        }
    return Outcome(
        figure,
        numbers,
        verdict_of([*conflict, *low_space, *on_cliff]),
        f"no prior is best in both measures on {sum(conflict)} of {len(ours)} drawings; p_space = 0.3 is among the precision "
        f"maxima of the 10 x 10 priors on {sum(low_space)}, p_wall = 0.2 on {sum(on_cliff)}; the cliffs lie at 0.2 / 0.9 = 0.222 "
        f"(dotted), where a cell that nobody looked at stops being a wall",
        "Colour maps of precision (left) and recall (right) over p_wall and p_space, one row for each drawing.",
    )


def _fronts(rng: np.random.Generator) -> Outcome:
    """The true fronts of all drawings, what NSGA-II finds of each, and how far the fronts overlap."""
    ours, seed = cases(), int(rng.integers(2**32))
    figure, (ax, beside) = sheet(1, 2, 5.8, 4.6)
    exact = {one.plan.name: one.experiment.sweep().front() for one in ours}
    found = {name: searched_front(name, seed) for name in exact}
    plot.front(exact, ax, title="exact")
    plot.front(found, beside, title="as NSGA-II finds them")
    lowest = min((float(front.precision.min()) for front in exact.values() if len(front)), default=0.0)
    for one_ax in (ax, beside):
        one_ax.set(xlim=(0.36, 1.01), ylim=(max(0.36, lowest - 0.1), 1.02))
    ratio = {name: found[name].hypervolume / front.hypervolume if len(front) else float("nan") for name, front in exact.items()}
    has = [len(front) > 0 for front in exact.values()]
    shared = [_in_all(prior, list(exact.values())) for front in exact.values() for prior in front.priors]
    numbers: dict[str, Any] = {
        name: {
            "exact_priors": len(exact[name]),
            "precision": [float(exact[name].precision.min()), float(exact[name].precision.max())] if len(exact[name]) else [],
            "recall": [float(exact[name].recall.min()), float(exact[name].recall.max())] if len(exact[name]) else [],
            "searched_priors": len(found[name]),
            "hypervolume_ratio": None if np.isnan(ratio[name]) else ratio[name],
            "proposed_is_on_the_front": _on(PROPOSED, exact[name]),
        }
        for name in exact
    }
    worst = min((value for value in ratio.values() if not np.isnan(value)), default=float("nan"))
    on_front = sum(told["proposed_is_on_the_front"] for told in numbers.values())
    return Outcome(
        figure,
        {**numbers, "priors_on_every_front": int(sum(shared))},
        verdict_of([*has, any(shared)]),
        f"{sum(has)} of {len(ours)} drawings have priors above 40 % in both measures, with fronts of "
        f"{min(len(front) for front in exact.values())} to {max(len(front) for front in exact.values())} points; "
        f"{sum(shared)} of {len(shared)} optimal priors lie on every drawing's front, (0.2, 0.9) on {on_front} of them; "
        f"NSGA-II reaches at least {100 * worst:.1f} % of the true hypervolume",
        "Pareto fronts in recall and precision for every drawing: exact on the left, searched on the right.",
    )


def _on(prior: tuple[float, float], front: Front) -> bool:
    """Does a prior lie on one of the plateaus that make a front?"""
    return any(prior[0] in where.p_wall and prior[1] in where.p_space for ranges in front.ranges for where in ranges)


def _in_all(prior: NDArray[np.float64], fronts: list[Front]) -> bool:
    """Does a prior lie on every front?"""
    return all(_on((float(prior[0]), float(prior[1])), front) for front in fronts)


def _clusters(rng: np.random.Generator) -> Outcome:
    """The priors of all searched fronts in two, three and four groups."""
    ours, seed = cases(), int(rng.integers(2**32))
    fronts = [searched_front(one.plan.name, seed) for one in ours]
    groups = {m: cluster(fronts, m, rng=child) for m, child in zip((2, 3, 4), rng.spawn(3), strict=True)}
    three = groups[3]
    figure, axes = sheet(1, 4, 4.4, 4.2)
    axes[0].plot(three.priors[:, 0], three.priors[:, 1], "k.")
    axes[0].set(xlim=(0.05, 1.05), ylim=(0.05, 1.05), aspect="equal", title="all priors")
    axes[0].set(xlabel="p_wall, before the factor", ylabel="p_space, before the factor")
    for ax, (m, one) in zip(axes[1:], groups.items(), strict=True):
        plot.clusters(one, ax, title=f"M = {m}")
    low_wall = [bool((centre[0] < 0.25) and (centre[1] > 0.5)) for centre in three.centres]
    near = bool(len(three.priors)) and bool(np.hypot(*(three.priors - PROPOSED).T).min() < 0.1)
    as_thesis = [low_wall.count(True) > 0, any(centre[0] > 0.5 and centre[1] > 0.48 for centre in three.centres)]
    as_thesis.append(any(centre[0] < 0.3 and centre[1] < 0.6 for centre in three.centres))
    said = "; ".join(f"({w:.2f}, {s:.2f})" for w, s in three.centres.tolist())
    quick = np.concatenate([one.experiment.sweep().front().priors for one in cases(spacing=QUICK)])
    low, high = (float(end(quick[:, 0])) if len(quick) else float("nan") for end in (np.min, np.max))
    thesis = dict(zip(("about (0.2, 0.8)", "both high", "both low"), as_thesis, strict=True))
    found = [name for name, there in thesis.items() if there]
    return Outcome(
        figure,
        {
            "priors": len(three.priors),
            "centres": {str(m): one.centres.tolist() for m, one in groups.items()},
            "ranges_of_three": [str(box) for box in three.ranges],
            "spread": {str(m): _spread_of(one) for m, one in groups.items()},
            "thesis_clusters_found": thesis,
            "exact_fronts_after_a_quick_survey": quick.tolist(),
            "note": three.note,
        },
        verdict_of([*as_thesis, near]),
        f"{len(three.priors)} priors, centres at {said or 'none'} for M = 3; of the thesis's three clusters "
        f"{sum(as_thesis)} have one of ours ({', '.join(found) or 'none'}); "
        f"(0.2, 0.9) has {'a' if near else 'no'} prior within 0.1 of it; after a quick survey all {len(quick)} "
        f"points of the exact fronts have p_wall {low:.2f} to {high:.2f}",
        "The priors of all Pareto fronts over p_wall and p_space: as points, and in 2, 3 and 4 clusters with a cross at each "
        "centre.",
    )


def _spread_of(groups: Clusters) -> float:
    """Root mean square distance of the priors to their centres: what eq. 4.23 makes small."""
    if not len(groups.priors):
        return 0.0
    apart = groups.priors - groups.centres[groups.labels]
    return float(np.sqrt((apart**2).sum(axis=1).mean()))


FIGURE_4_5 = Entry(
    "fig-4-5",
    "precision and recall of every prior",
    "High precision and high recall exclude each other; precision is highest for p_wall = 0.2 and p_space = 0.3, because 0.2 is "
    "where the log odds become linear.",
    _colour_maps,
)
FIGURE_4_7 = Entry(
    "fig-4-7",
    "Pareto fronts of all drawings",
    "All drawings have solutions above 40 % in both measures, and some priors are optimal for all of them.",
    _fronts,
)
FIGURE_4_8 = Entry(
    "fig-4-8",
    "clusters of the Pareto optimal priors",
    "Three clusters: both low, both high, and p_wall 0.18 to 0.21 with p_space 0.58 to 1, which holds the proposed (0.2, 0.9).",
    _clusters,
)
