"""The numbers of a result as plain data: for numbers.json, for the page and for the table in the terminal."""

from __future__ import annotations

import math
from typing import Any

from priorlab.core.score import Score
from priorlab.optimize.front import Front
from priorlab.pipeline import DOOR_M, SLAM_PRIOR, Drive, Mapping, PipelineResult, Search


def numbers_of(result: PipelineResult) -> dict[str, Any]:
    """Everything that was measured, unrounded; what does not exist is None (nan has no place in JSON)."""
    extraction, scale = result.extraction, result.scale.metres_per_pixel
    return {
        "drawing": {
            "name": result.drawing.name,
            "width_px": result.drawing.shape[1],
            "height_px": result.drawing.shape[0],
            "reduced_by": result.drawing.reduced_by,
            "metres_per_pixel": scale,
            "scale": result.scale.sentence,
            "assumed_door_m": DOOR_M if result.scale.assumed else None,
        },
        "walls": {
            "corners": len(extraction.corners),
            "doors": len(extraction.doors),
            "wall_pixels": int(result.walls.mask.sum()),
            "wall_share": float(result.walls.mask.mean()),
            "funnel": dict(extraction.funnel),
            "lost_at": extraction.lost_at,
            "score": score_numbers(result.walls_score),
        },
        "prior": _prior_numbers(result.prior),
        "mapping": None if result.mapping is None else _mapping_numbers(result.mapping),
        "search": None if result.search is None else _search_numbers(result.search),
        "fastslam": None if result.drive is None else _drive_numbers(result.drive),
        "share_indoors": result.share_indoors,
        "stopped": result.stopped,
        "notes": list(result.notes),
        "seed": result.seed,
        "method": result.method.name,
        "cell_size_px": result.cell_size,
        "seconds": dict(result.seconds),
    }


def score_numbers(score: Score | None) -> dict[str, Any] | None:
    """A score as a table's row."""
    if score is None:
        return None
    return {
        "precision": _finite(score.precision),
        "recall": _finite(score.recall),
        "f2": _finite(score.f_beta),
        "false_positive_rate": _finite(score.false_positive_rate),
        "tp": score.tp,
        "fp": score.fp,
        "fn": score.fn,
        "tn": score.tn,
    }


def _prior_numbers(prior: Any) -> dict[str, float]:
    """Before the factor and after it."""
    return {
        "p_wall": prior.p_wall,
        "p_space": prior.p_space,
        "factor": prior.factor,
        "effective_p_wall": prior.effective_p_wall,
        "effective_p_space": prior.effective_p_space,
    }


def _mapping_numbers(mapping: Mapping) -> dict[str, Any]:
    """Chapters 4 and 5."""
    return {
        "poses": len(mapping.readings),
        "max_range_px": mapping.readings.sensor.max_range,
        "cells": list(mapping.prior_map.grid.shape),
        "seen_share": float(mapping.evidence.seen.mean()),
        "mean_looks": mapping.evidence.mean_looks,
        "cells_opened": int(mapping.disagreement.opened.sum()),
        "cells_blocked": int(mapping.disagreement.blocked.sum()),
        "prior_alone": score_numbers(mapping.score_prior),
        "with_plan": score_numbers(mapping.score_informed),
        "without_plan": score_numbers(mapping.score_uninformed),
        "gain_percent": mapping.gain_percent,
    }


def _search_numbers(search: Search) -> dict[str, Any]:
    """Chapters 4.3 to 4.6."""
    best = {measure: search.sweep.best(measure) for measure in ("f_beta", "precision", "recall")}
    ratio = search.searched.hypervolume / search.exact.hypervolume if search.exact.hypervolume else None
    return {
        "best": {
            measure: {"value": _finite(one.value), "plateaus": [str(where) for where in one.plateaus[:3]]}
            for measure, one in best.items()
        },
        "exact_front": _front_numbers(search.exact),
        "searched_front": _front_numbers(search.searched),
        "hypervolume_ratio": ratio,
        "cluster_centres": search.clusters.centres.tolist(),
        "cluster_sizes": [int((search.clusters.labels == i).sum()) for i in range(len(search.clusters.centres))],
    }


def _front_numbers(front: Front) -> dict[str, Any]:
    """A front in four numbers."""
    return {"priors": len(front), "hypervolume": front.hypervolume, "note": front.note}


def _drive_numbers(drive: Drive) -> dict[str, Any]:
    """Chapter 6."""
    run = drive.run
    return {
        "prior": _prior_numbers(SLAM_PRIOR),
        "steps": len(run),
        "cell_size_m": run.map.grid.cell_size_m,
        "particles_min": int(run.n_particles.min()),
        "particles_max": int(run.n_particles.max()),
        "ate_m": run.ate_m(drive.log),
        "heading_error_deg": run.heading_error_deg(drive.log),
        "lost_because": run.lost_because,
        "prior_alone": score_numbers(drive.score_prior),
        "with_plan": score_numbers(drive.score_informed),
        "without_plan": score_numbers(drive.score_uninformed),
        "gain_percent": drive.gain_percent,
    }


def _finite(value: float) -> float | None:
    """nan and inf have no place in JSON."""
    return float(value) if math.isfinite(value) else None
