"""Which of the hypotheses is the walls: the most wall-like one in the light of the doors."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.core.drawing import Door
from priorlab.drawing.runs import run_lengths
from priorlab.drawing.weight import HATCHED, IN_COLOUR, STRAIGHT_CELLS, Hypothesis

DOORS_ALONE = 0.3
"""Weight of the walls grown from doors alone beside those of line weight: they know no insides and follow any line."""

HOLLOW = 0.5
"""Walls are drawn hollow when bodies that end at jambs and go on in line make up so much of the best other hypothesis."""

HATCHING_COVERS = 0.5
"""Hatching is taken when it makes up so much of the best hypothesis, and holds as many jambs, or is worth so much of it."""

SOLID_COVERS = 0.5
"""Solid walls are preferred when they make up so much of the best hypothesis."""

NEAR_JAMB = 0.15
"""A jamb stands on a wall that is within so many door widths of it."""

JAMBLESS = 0.25
"""Worth of walls on which no jamb stands, beside the same walls with all jambs on them."""

NEARLY = 0.95
"""Of hypotheses that are nearly as good as the best, the heaviest is taken: it holds the least furniture."""

NEARLY_SOLID = 0.75
"""The same where walls are solid: lighter strokes are worth more for windows, which are added later."""

OTHER_STYLE = 0.25
"""Heavy strokes are not all walls when hatching, or cells between lines, make up more than this share of them."""

WALL_LENGTH = 0.1
"""The longest straight stroke of a building is at least this share of the drawing's long side; letters are shorter."""


def worths_of(hypotheses: Sequence[Hypothesis], doors: Sequence[Door], symbols: NDArray[np.bool_]) -> list[float]:
    """How far to trust each hypothesis, in the light of the doors: jambs stand on walls, leaves and arcs are none.

    Solid strokes that are the faces of long cells are no walls by themselves.
    """
    in_colour = any(h.name.startswith("hue") for h in hypotheses)
    doors_alone = DOORS_ALONE * (IN_COLOUR if in_colour else 1.0)
    trust = [doors_alone if h.name == "doors" else 1.0 for h in hypotheses]
    insides = next((h.walls for h in hypotheses if h.name == STRAIGHT_CELLS), np.zeros_like(symbols))
    trust = [t * (1 - share_in(h.walls, insides)) if h.solid else t for t, h in zip(trust, hypotheses, strict=True)]
    return [t * h.quality * door_agreement(h.walls, doors, symbols) for t, h in zip(trust, hypotheses, strict=True)]


def share_in(walls: NDArray[np.bool_], part: NDArray[np.bool_]) -> float:
    """Share of the walls that lies in a part; 0 of nothing."""
    return float(part[walls].mean()) if walls.any() else 0.0


def choose(hypotheses: Sequence[Hypothesis], worths: Sequence[float]) -> Hypothesis:
    """The most wall-like hypothesis; the heaviest of those that are nearly as good.

    Where solid strokes make up most of the best one, they are taken: they need no guess about what lies between lines.
    Where none is worth anything and no stroke is as long as a wall, as on a page of text, nothing is a wall.
    """
    pairs = list(zip(hypotheses, worths, strict=True))
    best, most = max(pairs, key=lambda pair: pair[1])
    if not most > 0 and not any(_longest_run(h.walls) >= WALL_LENGTH * max(h.walls.shape) for h in hypotheses):
        return replace(best, walls=np.zeros_like(best.walls))
    if best.weight:
        least = NEARLY_SOLID if best.solid else NEARLY
        best = max((h for h, worth in pairs if worth >= least * most and h.solid >= best.solid), key=lambda h: h.weight)
    if _hatched_is_all(pairs, best, most):
        return next(h for h in hypotheses if h.name == HATCHED)
    solid = [
        (h, w)
        for h, w in pairs
        if h.solid and h.weight >= best.weight and (h.walls & best.walls).sum() >= SOLID_COVERS * best.walls.sum()
    ]
    return max(solid, key=lambda pair: pair[1])[0] if solid else best


def _hatched_is_all(pairs: Sequence[tuple[Hypothesis, float]], best: Hypothesis, most: float) -> bool:
    """Is what is hatched all walls, the rest furniture? Where partitions are drawn otherwise, it misses the jambs of doors."""
    hatched, worth = next(((h, w) for h, w in pairs if h.name == HATCHED), (best, 0.0))
    if not hatched.walls.any() or not worth > 0:
        return False
    trusted = next(w for h, w in pairs if h is best)
    jambs = min(1.0, (worth / hatched.quality) / (trusted / best.quality)) if trusted > 0 else 1.0
    return jambs * share_in(best.walls, hatched.walls) >= HATCHING_COVERS or worth >= HATCHING_COVERS * most


def has_other_style(heavy: NDArray[np.bool_], hypotheses: Sequence[Hypothesis]) -> bool:
    """Are there, beside heavy strokes, so many hatched walls or walls of two lines that heavy strokes cannot be all of them?"""
    others = (h.walls for h in hypotheses if h.name in (HATCHED, STRAIGHT_CELLS))
    return any(np.count_nonzero(walls) > OTHER_STYLE * np.count_nonzero(heavy) for walls in others)


def _longest_run(walls: NDArray[np.bool_]) -> int:
    """Pixels in the longest straight run along either axis."""
    return max(int(run_lengths(walls, axis).max(initial=0)) for axis in (0, 1))


def door_agreement(walls: NDArray[np.bool_], doors: Sequence[Door], symbols: NDArray[np.bool_]) -> float:
    """How well walls and doors fit: jambs on the walls, and no leaf or arc among them; 1 at best and without doors."""
    if not doors:
        return 1.0
    reach = max(4, round(NEAR_JAMB * float(np.median([door.width for door in doors]))))
    near = cv2.dilate(walls.astype(np.uint8), np.ones((2 * reach + 1, 2 * reach + 1), np.uint8)).astype(bool)
    jambs = np.rint([jamb for door in doors for jamb in (door.hinge, door.strike)]).astype(int)
    x, y = np.clip(jambs, 0, [walls.shape[1] - 1, walls.shape[0] - 1]).T
    on_walls = near[y, x].mean()
    mistaken = walls[symbols].mean() if symbols.any() else 0.0
    return float((JAMBLESS + (1 - JAMBLESS) * on_walls) * (1 - 0.8 * mistaken))


def prefer_bodies(best: Hypothesis, bodies: Hypothesis, worth: float, most: float) -> Hypothesis:
    """Bodies of hollow walls in the place of the best other hypothesis; no hue is hollow.

    They make up `HOLLOW` of it; or they are worth as much as the most that any other is worth, and nothing is hatched.
    """
    makes_up = share_in(best.walls, bodies.walls) >= HOLLOW
    outdoes = worth >= most and best.name != HATCHED
    return bodies if best.hue is None and bodies.walls.any() and (makes_up or outdoes) else best
