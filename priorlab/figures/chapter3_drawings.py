"""Figures 3.9 to 3.16 on our counterparts of the thesis's drawings: two flats and three sections of an office building."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from priorlab import plot
from priorlab.buildings.floor_plans import load_floor_plan
from priorlab.core.drawing import Walls
from priorlab.core.score import Score, score_mask, score_walls
from priorlab.drawing.baselines import dilation
from priorlab.drawing.extraction import Extraction
from priorlab.drawing.method import ROBUST, THESIS
from priorlab.figures.case import extracted
from priorlab.figures.figure import Entry, Outcome, sheet, verdict_of
from priorlab.study.drawing_suite import BAR, matched_doors
from priorlab.study.thesis_drawings import THESIS_DRAWINGS

FLATS, SECTIONS = THESIS_DRAWINGS[:2], THESIS_DRAWINGS[2:]
PRESETS = (THESIS, ROBUST)
DON_T_CARE = (0.72, 0.80, 0.92)


def _steps(rng: np.random.Generator) -> Outcome:
    """Figure 3.9: drawing, corners, doors, doors with walls, result; a row for each preset."""
    name = SECTIONS[1]
    plan = load_floor_plan(name)
    figure, axes = sheet(2, 5, 3.6, 3.4 * plan.drawing.shape[0] / plan.drawing.shape[1] + 0.7)
    numbers: dict[str, Any] = {"drawing": name}
    for row, method in enumerate(PRESETS):
        found, one = extracted(name, method), axes[5 * row : 5 * row + 5]
        plot.drawing(plan.drawing, one[0], f"{method.name}: the drawing")
        plot.corners(found.corners, plan.drawing, one[1], f"{len(found.corners)} corners")
        plot.doors(found.doors, plan.drawing, one[2], f"{len(found.doors)} doors")
        _overlay(found, one[3], "doors and walls")
        plot.walls(found.walls, plan.truth, one[4], f"result: {_short(score_walls(found.walls, plan.truth))}")
        numbers[method.name] = {"corners": len(found.corners), **_numbers(found, name)}
    thesis = numbers["THESIS"]
    wrong = thesis["doors_found"] - thesis["doors_right"]
    return Outcome(
        _bare(figure, axes),
        numbers,
        verdict_of([thesis["recall"] > 50, wrong > 0]),
        f"{name}: {thesis['recall']:.1f} % of the walls with THESIS ({wrong} of {thesis['doors_found']} doors are none), "
        f"{numbers['ROBUST']['recall']:.1f} % with ROBUST",
        "A drawing, its corners, the doors, the walls that grow from them and the result, for both presets.",
    )


def _classes(rng: np.random.Generator) -> Outcome:
    """Figure 3.10: what every pixel counts as."""
    name = FLATS[0]
    plan = load_floor_plan(name)
    truth = plan.truth
    figure, axes = sheet(1, 2, 5.2, 5.0 * plan.drawing.shape[0] / plan.drawing.shape[1] + 0.5)
    plot.drawing(plan.drawing, axes[0], name)
    image = np.ones((*truth.shape, 3))
    image[truth.ignore] = DON_T_CARE
    image[truth.walls & ~truth.ignore] = (0, 0, 0)
    axes[1].imshow(image, interpolation="nearest")
    axes[1].set_title("black: positive; blue: don't care; white: negative")
    positive, ignored = truth.walls & ~truth.ignore, truth.ignore
    ink = plan.drawing.grey < 128
    shares = {
        "positive": float(positive.mean()),
        "dont_care": float(ignored.mean()),
        "negative": float((~positive & ~ignored).mean()),
        "ink_that_is_negative": float((ink & ~positive & ~ignored).sum() / ink.sum()),
    }
    numbers = {key: round(100 * value, 3) for key, value in shares.items()}
    leaves = [(door.points[0] + door.points[2]) / 2 for door in truth.doors]
    doors_ignored = all(truth.ignore[int(y) - 1 : int(y) + 2, int(x) - 1 : int(x) + 2].any() for x, y in leaves)
    return Outcome(
        _bare(figure, axes),
        {"drawing": name, **numbers},
        verdict_of([doors_ignored, bool(ink[positive].mean() > 0.95), shares["ink_that_is_negative"] > 0]),
        f"{name}: {numbers['positive']:.1f} % of the pixels are positive, {numbers['dont_care']:.1f} % don't care, "
        f"{numbers['negative']:.1f} % negative; {numbers['ink_that_is_negative']:.1f} % of the ink is text and furniture",
        "A floor plan, and beside it its walls and windows in black, doors, stairs and fixtures in blue, all else white.",
    )


def _results(names: Sequence[str], rng: np.random.Generator) -> Outcome:
    """Figures 3.13 and 3.14: drawing, doors and walls as found by THESIS, its result, and the result of ROBUST."""
    shape = load_floor_plan(names[0]).drawing.shape
    figure, axes = sheet(len(names), 4, 3.8, 3.8 * shape[0] / shape[1] + 0.4)
    numbers: dict[str, Any] = {}
    for row, name in enumerate(names):
        plan, one = load_floor_plan(name), axes[4 * row : 4 * row + 4]
        plot.drawing(plan.drawing, one[0], name)
        _overlay(extracted(name, THESIS), one[1], "THESIS: doors and walls")
        for ax, method in zip(one[2:], PRESETS, strict=True):
            walls = extracted(name, method).walls
            plot.walls(walls, plan.truth, ax, f"{method.name}: {_short(score_walls(walls, plan.truth))}")
        numbers[name] = {method.name: _numbers(extracted(name, method), name) for method in PRESETS}
    precise = [row["THESIS"]["precision"] >= 100 * BAR[0] for row in numbers.values()]
    told = "; ".join(
        f"{name}: THESIS {row['THESIS']['precision']:.1f} / {row['THESIS']['recall']:.1f} with {row['THESIS']['doors_right']} of "
        f"{row['THESIS']['doors_true']} doors, ROBUST {row['ROBUST']['precision']:.1f} / {row['ROBUST']['recall']:.1f}"
        for name, row in numbers.items()
    )
    return Outcome(
        _bare(figure, axes),
        numbers,
        verdict_of(precise),
        f"precision / recall in %: {told}",
        "Drawings, the doors and walls found in them, and the walls of both presets held against the truth.",
    )


def _dilated(rng: np.random.Generator) -> Outcome:
    """Figure 3.15: dilation by squares of 2 and 4 pixels on a section and on a flat, beside the extraction."""
    names = (SECTIONS[0], FLATS[1])
    shape = load_floor_plan(names[0]).drawing.shape
    figure, axes = sheet(2, 3, 4.4, 4.4 * shape[0] / shape[1] + 0.5)
    numbers: dict[str, Any] = {}
    for row, name in enumerate(names):
        plan = load_floor_plan(name)
        masks = {f"dilation {side} px": dilation(plan.drawing, side) for side in (2, 4)}
        masks["ROBUST"] = extracted(name).walls.mask
        for ax, (method, mask) in zip(axes[3 * row :], masks.items(), strict=False):
            score = score_mask(mask, plan.truth)
            plot.walls(_as_walls(mask), plan.truth, ax, f"{name}, {method}: {_short(score)}")
            numbers.setdefault(name, {})[method] = _percent(score)
    too_much = [row["dilation 2 px"]["precision"] < 100 * BAR[0] for row in numbers.values()]
    too_little = [row["dilation 4 px"]["recall"] < 100 * BAR[1] for row in numbers.values()]
    told = "; ".join(
        f"{name}: {row['dilation 2 px']['precision']:.1f} % of what 2 px keep is wall, "
        f"4 px keep {row['dilation 4 px']['recall']:.1f} % of the walls"
        for name, row in numbers.items()
    )
    return Outcome(
        _bare(figure, axes),
        numbers,
        verdict_of([*too_much, *too_little]),
        told,
        "Walls by dilation with two sizes of square and by the extraction, of an office section and of a flat.",
    )


def _compared(rng: np.random.Generator) -> Outcome:
    """Figure 3.16: precision, recall and false positive rate of the presets and of dilation, a panel for each drawing."""
    figure, axes = sheet(2, 3, 4.6, 3.4)
    numbers: dict[str, Any] = {}
    better: list[bool] = []
    for ax, name in zip(axes, THESIS_DRAWINGS, strict=False):
        plan = load_floor_plan(name)
        scores = {method.name: score_walls(extracted(name, method).walls, plan.truth) for method in PRESETS}
        scores |= {f"dilation {side} px": score_mask(dilation(plan.drawing, side), plan.truth) for side in (2, 4)}
        plot.score_bars(scores, ax, title=name)
        numbers[name] = {method: _percent(score) for method, score in scores.items()}
        best = max(scores[f"dilation {side} px"].f_beta for side in (2, 4))
        better.append(scores["THESIS"].f_beta > best)
        numbers[name]["robust_better"] = bool(scores["ROBUST"].f_beta > best)
    axes[-1].remove()
    ahead = [name for name, is_better in zip(THESIS_DRAWINGS, better, strict=True) if is_better]
    robust = sum(row["robust_better"] for row in numbers.values())
    return Outcome(
        figure,
        numbers,
        verdict_of(better),
        f"F2 above both dilations: THESIS on {len(ahead)} of {len(better)} drawings"
        f"{' (' + ', '.join(ahead) + ')' if ahead else ''}, ROBUST on {robust}",
        "Bars of precision, recall and F2 of both presets and of dilation with two sizes, one panel for each of five drawings.",
    )


def _numbers(found: Extraction, name: str) -> dict[str, Any]:
    """Walls in percent, doors as numbers."""
    truth = load_floor_plan(name).truth
    right = len(matched_doors(found.doors, truth.doors))
    doors = {"doors_true": len(truth.doors), "doors_found": len(found.doors), "doors_right": right}
    return {**_percent(score_walls(found.walls, truth)), **doors}


def _percent(score: Score) -> dict[str, float]:
    """Percent, as table 3.1 has it; -1 where nothing was detected."""
    values = {"precision": score.precision, "recall": score.recall, "false_positive_rate": score.false_positive_rate}
    return {name: round(100 * value, 3) if np.isfinite(value) else -1.0 for name, value in values.items()}


def _short(score: Score) -> str:
    """Precision and recall in a title."""
    precision = f"{100 * score.precision:.1f}" if np.isfinite(score.precision) else "nothing"
    return f"P {precision}, R {100 * score.recall:.1f} %"


def _overlay(found: Extraction, ax: Axes, title: str) -> None:
    """Walls in green under the doors, as the thesis shows them."""
    plot.doors(found.doors, found.drawing, ax, title)
    image = np.zeros((*found.walls.shape, 4))
    image[found.walls.mask] = (0.0, 0.55, 0.3, 0.75)
    ax.imshow(image, interpolation="nearest")


def _as_walls(mask: NDArray[np.bool_]) -> Walls:
    """A mask as walls."""
    return Walls(mask.astype(np.uint8))


def _bare(figure: Any, axes: Sequence[Axes]) -> Any:
    """Pictures without numbers at their sides."""
    for ax in axes:
        for spine in ax.spines.values():
            spine.set_visible(False)
        ax.set(xticks=[], yticks=[], xlabel="", ylabel="")
    return figure


DRAWING_FIGURES = (
    Entry(
        "fig-3-9",
        "the steps from a drawing to its walls, for both presets",
        "Most walls are found although some of the doors are none.",
        _steps,
    ),
    Entry(
        "fig-3-10",
        "what every pixel of a drawing counts as",
        "Walls and windows are positive; doors, stairs and fixtures don't count; text and furniture are negative.",
        _classes,
    ),
    Entry(
        "fig-3-13",
        "doors and walls found in two flats",
        "The walls that are found are right, though a door is missed or invented here and there.",
        partial(_results, FLATS),
    ),
    Entry(
        "fig-3-14",
        "doors and walls found in three sections of an office building",
        "The walls that are found are right, though a door is missed or invented here and there.",
        partial(_results, SECTIONS),
    ),
    Entry(
        "fig-3-15",
        "walls by dilation with squares of 2 and 4 pixels, beside the extraction",
        "The small square keeps doors and furniture, the large one loses walls; no size does well on both drawings.",
        _dilated,
    ),
    Entry(
        "fig-3-16",
        "extraction against dilation on five drawings",
        "The method does better than dilation with either size on all five drawings.",
        _compared,
    ),
)
