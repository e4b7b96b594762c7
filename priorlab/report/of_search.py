"""Section of chapter 4.3 to 4.6: every prior at once, fronts, clusters."""

from __future__ import annotations

from functools import partial

from priorlab import plot
from priorlab.optimize.front import FLOOR
from priorlab.pipeline import PipelineResult, Search
from priorlab.report.pictures import picture
from priorlab.report.section import Section, Table


def search_section(result: PipelineResult, search: Search) -> Section:
    """Chapter 4.3 to 4.6."""
    sweep, best = search.sweep, search.sweep.best("f_beta")
    here = sweep.at(result.prior.p_wall, result.prior.p_space)
    pictures = [
        picture(
            partial(plot.sweep, sweep, measure, prior=result.prior),
            f"Colour map of the {words} of every pair of p_wall and p_space, with a cross at the pair that was used.",
            f"{words.capitalize()} for every prior, exact. Dotted: where a prior times {sweep.factor:g} passes the "
            f"threshold {sweep.threshold:g}.",
            (5.2, 4.2),
        )
        for measure, words in (("precision", "precision"), ("recall", "recall"), ("f_beta", "F2"))
    ]
    pictures.append(
        picture(
            lambda ax: plot.front({"exact": search.exact, "NSGA-II": search.searched}, ax, prior=(here.precision, here.recall)),
            f"Pareto fronts in precision and recall: {len(search.exact)} exact priors and {len(search.searched)} found by "
            f"NSGA-II.",
            "The true front, and what the genetic search of the thesis finds of it.",
            (5.6, 4.2),
        )
    )
    if len(search.searched):
        pictures.append(
            picture(
                lambda ax: plot.clusters(search.clusters, ax),
                f"The priors of the front in {len(search.clusters.centres)} clusters, over p_wall and p_space.",
                "The priors of the searched front in clusters (k-means); a cross at each centre.",
                (5.2, 4.6),
            )
        )
    text = [
        "How much should the drawing be believed? The log odds of every cell are linear in the prior's, so precision and "
        "recall of EVERY prior "
        "follow from one sort; nothing is interpolated.",
        f"Highest F2 {best.value:.3f}" + (f", at {best.plateaus[0]}." if best.plateaus else "."),
        "Precision and recall pull apart: a front, not a point."
        if len(search.exact) > 1
        else "One prior is best in both at once: here the front is a single point."
        if len(search.exact)
        else f"No front above {100 * FLOOR:g} %: {search.exact.note}",
    ]
    ratio = search.searched.hypervolume / search.exact.hypervolume if search.exact.hypervolume else None
    if ratio is not None:
        text.append(f"NSGA-II covers {100 * ratio:.1f} % of the true front's hypervolume.")
    centres = tuple((str(i + 1), f"{w:.2f}", f"{s:.2f}") for i, (w, s) in enumerate(search.clusters.centres.tolist()))
    tables = (Table(("cluster", "p_wall", "p_space"), centres, "Centres of the clusters, before the factor"),) if centres else ()
    return Section("Every prior at once", tuple(text), tuple(pictures), tables)
