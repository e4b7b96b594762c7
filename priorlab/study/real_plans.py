"""Drawings that somebody else made, with walls that a person marked: how much of them does each method find?

A folder holds, for every plan NAME, three images of one size:

    NAME.png          the drawing
    NAME_walls.png    black where the person marked a wall
    NAME_ignore.png   black where nothing is counted (may be missing)

Everything that is not marked is empty. The people who marked these took windows for empty (`windows="empty"`): what a method
says is a window counts as empty, and one that it calls wall is a mistake. To hold one method against a folder:

    from priorlab.drawing.method import ROBUST
    from priorlab.study.real_plans import plans_table, score_real_plans
    print(plans_table(score_real_plans(folder, {"ROBUST": ROBUST}, names=["my_flat"])))
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.core.building import Truth
from priorlab.core.drawing import Drawing
from priorlab.core.score import Score, score_mask
from priorlab.drawing.baselines import BASELINES, best_darkness
from priorlab.drawing.extraction import Extraction, extract_walls
from priorlab.drawing.method import Method
from priorlab.interchange.images import read_drawing
from priorlab.study.drawing_suite import METHODS, Found
from priorlab.study.ranking import Ranked, rank_pixels, ranking_line

MarkedAs = Literal["wall", "empty"]
"""What the person who marked the walls took windows for; our own truths take their ink for wall."""

Reader = Method | Callable[..., Found]
"""A method of chapter 3, or anything that makes walls, or a (height, width) mask of them, from a drawing."""

MASK_CELLS = 224
"""Cells along the long side of the grid that people's masks were made on: they are right to half a cell."""


@dataclass(frozen=True, eq=False)
class MarkedPlan:
    """A drawing with the walls that a person marked, how far off those marks may be (pixels), and what windows were taken for."""

    drawing: Drawing
    truth: Truth
    tolerance: float
    windows: MarkedAs = "empty"


@dataclass(frozen=True)
class PlanRow:
    """One method on one plan.

    Parameters
    ----------
    plan, method : names
    score : counts, pixel by pixel
    near_precision, near_recall : the same, but a pixel is right when the other mask has wall within the plan's tolerance
    darkness : ink threshold that a simple filter did best with; None for a method that chooses by itself
    seconds : of one extraction
    ranked : detected pixels by confidence; None of a method that gives none
    """

    plan: str
    method: str
    score: Score
    near_precision: float
    near_recall: float
    darkness: int | None
    seconds: float
    ranked: Ranked | None = None

    @property
    def near_iou(self) -> float:
        """Intersection over union with the tolerance: 1 / (1/P + 1/R - 1)."""
        p, r = self.near_precision, self.near_recall
        return p * r / (p + r - p * r) if p * r > 0 else 0.0


def marked_plans(folder: str | Path) -> list[str]:
    """Names of the plans in a folder that have a wall mask."""
    folder = Path(folder)
    if not folder.is_dir():
        raise FileNotFoundError(f"folder must hold drawings and their masks, got {folder}, which does not exist")
    return sorted(path.name.removesuffix("_walls.png") for path in folder.glob("*_walls.png"))


def read_marked_plan(folder: str | Path, name: str, tolerance: float | None = None, windows: MarkedAs = "empty") -> MarkedPlan:
    """A drawing, its wall mask and its ignore mask.

    Parameters
    ----------
    folder, name : where they lie and what the drawing is called, without ".png"
    tolerance : pixels; half a cell of a mask of 224 cells when left out
    windows : what the person who marked the walls took windows for

    Raises
    ------
    FileNotFoundError
        When the drawing or its wall mask is missing.
    ValueError
        When their sizes differ.
    """
    folder = Path(folder)
    drawing = read_drawing(folder / f"{name}.png")
    walls = _mask(folder / f"{name}_walls.png", drawing)
    ignored = folder / f"{name}_ignore.png"
    ignore = _mask(ignored, drawing) if ignored.is_file() else np.zeros_like(walls)
    tolerance = max(walls.shape) / MASK_CELLS / 2 if tolerance is None else tolerance
    return MarkedPlan(drawing, Truth(walls, ignore), tolerance, windows)


def score_real_plans(
    folder: str | Path, methods: Mapping[str, Reader] = METHODS, names: Sequence[str] | None = None
) -> list[PlanRow]:
    """Every method on every plan of a folder; simple filters of `BASELINES` each at the ink threshold that suits them best.

    Parameters
    ----------
    folder : as the module's first lines have it
    methods : name -> `Method`, or a function that makes a mask of a drawing
    names : the plans; all when left out

    Returns
    -------
    A row for each plan and method, in this order.
    """
    rows = []
    for name in names if names is not None else marked_plans(folder):
        plan = read_marked_plan(folder, name)
        rows += [score_plan(plan, title, reader) for title, reader in methods.items()]
    return rows


def found_by(reader: Reader, drawing: Drawing, darkness: int | None = None) -> Found:
    """What a method finds; a simple filter may be told its ink threshold."""
    if isinstance(reader, Method):
        return extract_walls(drawing, reader)
    options: dict[str, Any] = {} if darkness is None else {"darkness": darkness}
    return reader(drawing, **options)


def mask_of(found: Found, windows: MarkedAs = "wall") -> NDArray[np.bool_]:
    """(height, width) walls of what was found, with the ink of its windows or without."""
    if isinstance(found, np.ndarray):
        return found.astype(bool)
    walls = found.walls if isinstance(found, Extraction) else found
    return walls.mask if windows == "wall" else walls.mask & ~walls.windows


def score_plan(plan: MarkedPlan, title: str, reader: Reader) -> PlanRow:
    """One method on one plan."""
    darkness = None
    if title in BASELINES and reader is BASELINES[title]:
        darkness, _ = best_darkness(BASELINES[title], plan.drawing, plan.truth)
    return _row(plan, title, reader, darkness)


def plans_table(rows: Iterable[PlanRow], targets: Mapping[str, float] | None = None) -> str:
    """Rows as text, a block for each plan: precision, recall and IoU in percent, with the tolerance, and whether IoU reached its
    target."""
    targets, rows = targets or {}, list(rows)
    names = "".join(f"{name:>7}" for name in ("P", "R", "F2", "IoU", "P~", "R~", "IoU~"))
    lines = [f"{'% (~ within the tolerance)':<28}{names}{'ink':>6}{'s':>7}{'ranking':>9}"]
    last = None
    for row in rows:
        if row.plan != last:
            aim = targets.get(row.plan)
            lines.append(row.plan + ("" if aim is None else f" (IoU to reach {100 * aim:.0f})"))
            last = row.plan
        lines.append(_line(row, targets.get(row.plan)))
    for method in dict.fromkeys(row.method for row in rows):
        lines.append(ranking_line((row.ranked for row in rows if row.method == method), method))
    return "\n".join(line for line in lines if line)


def _line(row: PlanRow, aim: float | None) -> str:
    """One row of the table; a target concerns what chooses its thresholds by itself."""
    score, own = row.score, row.darkness is None
    f_beta = score.f_beta if score.tp + score.fp else float("nan")
    strict = "".join(_percent(x) for x in (score.precision, score.recall, f_beta, score.iou))
    near = "".join(_percent(x) for x in (row.near_precision, row.near_recall, row.near_iou))
    ink = f"{'own' if own else row.darkness:>6}"
    auc = float("nan") if row.ranked is None else row.ranked.auc
    ranking = f"{auc:>9.2f}" if np.isfinite(auc) else f"{'-':>9}"
    verdict = "" if aim is None or not own else "   reached" if score.iou >= aim else f"   misses {100 * (aim - score.iou):.1f}"
    return f"  {row.method:<26}{strict}{near}{ink}{row.seconds:>7.2f}{ranking}{verdict}"


def _percent(share: float) -> str:
    """A share as it stands in the table; a dash for what is undefined."""
    return f"{100 * share:>7.1f}" if np.isfinite(share) else f"{'-':>7}"


def _row(plan: MarkedPlan, title: str, reader: Reader, darkness: int | None) -> PlanRow:
    """Run and count."""
    start = time.perf_counter()
    found = found_by(reader, plan.drawing, darkness)
    seconds = time.perf_counter() - start
    mask = mask_of(found, plan.windows)
    near_precision, near_recall = near_scores(mask, plan.truth, plan.tolerance)
    ranked = ranked_by(found, plan.truth, plan.windows)
    score = score_mask(mask, plan.truth)
    return PlanRow(plan.drawing.name, title, score, near_precision, near_recall, darkness, seconds, ranked)


def ranked_by(found: Found, truth: Truth, windows: MarkedAs = "wall") -> Ranked | None:
    """The detected pixels by confidence, if what was found has one."""
    return rank_pixels(found.confidence, mask_of(found, windows), truth) if isinstance(found, Extraction) else None


def near_scores(detected: NDArray[np.bool_], truth: Truth, tolerance: float) -> tuple[float, float]:
    """Precision and recall when a pixel counts as right with the other mask's wall within `tolerance` pixels.

    For truths whose edges are not exact: a mask that is shifted by less than the tolerance scores (1, 1) against itself.
    """
    counted = ~truth.ignore
    found, marked = detected & counted, truth.walls & counted
    right = found & (_distance(truth.walls) <= tolerance)
    met = marked & (_distance(detected) <= tolerance)
    return _share(right, found), _share(met, marked)


def _distance(mask: NDArray[np.bool_]) -> NDArray[np.float32]:
    """Distance of every pixel to the next True one; infinite without any."""
    if not mask.any():
        return np.full(mask.shape, np.inf, np.float32)
    return np.asarray(cv2.distanceTransform((~mask).astype(np.uint8), cv2.DIST_L2, cv2.DIST_MASK_PRECISE), np.float32)


def _share(part: NDArray[np.bool_], whole: NDArray[np.bool_]) -> float:
    """Share of True pixels, nan of none."""
    return int(part.sum()) / int(whole.sum()) if whole.any() else float("nan")


def _mask(path: Path, drawing: Drawing) -> NDArray[np.bool_]:
    """True on the black pixels of an image as large as the drawing."""
    mask = read_drawing(path).grey < 128
    if mask.shape != drawing.shape:
        raise ValueError(f"{path.name} must be as large as its drawing, {drawing.shape}, got {mask.shape}")
    return mask
