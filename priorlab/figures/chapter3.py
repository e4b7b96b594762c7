"""Table 3.1 and figure 3.16: how well walls are extracted, against simple filters."""

from __future__ import annotations

from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab import plot
from priorlab.buildings.floor_plans import floor_plan_names, load_floor_plan
from priorlab.core.score import Score, score_mask, score_walls
from priorlab.drawing.method import ROBUST, THESIS
from priorlab.figures.case import extracted
from priorlab.figures.figure import Entry, Outcome, sheet, verdict_of


def opened(ink: NDArray[np.bool_], side: int) -> NDArray[np.bool_]:
    """Ink thick enough to hold a square of `side` pixels: what the thesis calls dilation (of the white paper) and its undoing.

    The anchors of erosion and dilation are mirrored, or an even side would leave ink outside of the input.
    """
    square = np.ones((side, side), np.uint8)
    last = (side - 1 - side // 2,) * 2
    thin = cv2.erode(ink.astype(np.uint8), square, anchor=(side // 2, side // 2))
    return cv2.dilate(thin, square, anchor=last).astype(bool) & ink


def _table(rng: np.random.Generator) -> Outcome:
    """Every bundled building: both presets and opening by squares of 2 and 4 pixels."""
    names, scores = floor_plan_names(), {}
    for name in names:
        plan = load_floor_plan(name)
        ink = plan.drawing.grey < 128
        scores[name] = {
            "THESIS": score_walls(extracted(name, THESIS).walls, plan.truth),
            "ROBUST": score_walls(extracted(name, ROBUST).walls, plan.truth),
            "square 2 px": score_mask(opened(ink, 2), plan.truth),
            "square 4 px": score_mask(opened(ink, 4), plan.truth),
        }
    figure, axes = sheet((len(names) + 1) // 2, 2, 5.4, 4.0)
    for ax, name in zip(axes, names, strict=False):
        plot.score_bars(scores[name], ax, title=name)
    for ax in axes[len(names) :]:
        ax.remove()
    met = {method: [_meets(scores[name][method]) for name in names] for method in scores[names[0]]}
    numbers: dict[str, Any] = {name: {method: _row(score) for method, score in one.items()} for name, one in scores.items()}
    numbers["meets_98_61_012"] = {method: f"{sum(ok)} of {len(ok)}" for method, ok in met.items()}
    said = ", ".join(f"{method} {sum(ok)} of {len(ok)}" for method, ok in met.items())
    return Outcome(
        figure,
        numbers,
        verdict_of([*met["THESIS"], *met["ROBUST"]]),
        f"precision above 98 %, recall above 61 % and false positives below 0.12 % at once: {said}",
        "Bars of precision, recall and F2 of four ways to extract walls, one panel for each bundled building.",
    )


def _meets(score: Score) -> bool:
    """The thesis's table: precision over 98 %, recall over 61 %, false positive rate at most 0.12 %."""
    return score.precision > 0.98 and score.recall > 0.61 and score.false_positive_rate <= 0.0012


def _row(score: Score) -> dict[str, float]:
    """Percent, as the table has it; -1 where nothing was detected."""
    values = {"precision": score.precision, "recall": score.recall, "false_positive_rate": score.false_positive_rate}
    return {name: round(100 * value, 3) if np.isfinite(value) else -1.0 for name, value in values.items()}


TABLE_3_1 = Entry(
    "table-3-1",
    "walls of every bundled building: both presets and two simple filters",
    "Precision over 98 %, recall over 61 %, false positive rate at most 0.12 % on all five drawings.",
    _table,
)
