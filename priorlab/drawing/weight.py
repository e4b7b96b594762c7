"""Walls by line weight and hue: the cue that the thesis does not use (method page, section 6).

Walls are drawn heavier than text, dimensions and furniture, or in a hue of their own. Several hypotheses are worked out
("strokes of at least q pixels are faces of walls", "this hue is wall") and the most wall-like result is chosen.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.drawing.faces import long_runs, thin_cells, tidy, walls_between
from priorlab.drawing.hatching import hatched_walls
from priorlab.drawing.long_cells import long_cells
from priorlab.drawing.preprocessing import NO_HUE
from priorlab.drawing.runs import gap_ends, run_lengths
from priorlab.drawing.sheet import Sheet
from priorlab.drawing.strokes import common_weight, line_weights, opened, stroke_widths, thinner_run
from priorlab.drawing.wall_sizes import WallSizes

HEAVIEST = 6
"""Largest q of a hypothesis."""

HEAVIER = (8, 11)
"""Strokes so heavy are walls themselves, not their faces."""

SUBPIXEL_WEIGHTS = (1.5, 2.0, 2.5)
"""Weights of lines too thin for whole pixels to tell apart."""

IN_COLOUR = 0.5
"""Trust in line weights where hues tell the parts of a drawing apart."""

EVEN = 0.4
"""Solid walls are at least so much as thick as the thickest quarter of them."""

HEAVIER_BY = 1.0
"""Solid walls are heavier than the drawing's lines by so many times the weight of these."""

OPENING = 0.12
"""Widest door or window of solid walls, share of M."""

END_WALL = 0.6
"""The walls at the ends of an opening go on for so many of their thicknesses."""

SLENDER = 6.0
"""A wall is longer than so many of its thicknesses; furniture is not."""

HATCHED = "hatching"
"""Name of the hypothesis that takes what is hatched."""

STRAIGHT_CELLS = "long cells of straight lines"
"""Name of the hypothesis that takes what lies between straight lines of any weight."""

OWN_HUE = 0.35
"""So much of the white inside a wall, at least, lies nearer to lines of its hue: half of it where furniture covers one face."""

HUE_BINS = 12
"""Hues that are told apart, each 15 of OpenCV's 180 wide."""


@dataclass(frozen=True, eq=False)
class Hypothesis:
    """Walls under one assumption about how they are drawn.

    Parameters
    ----------
    name : the assumption
    walls : (height, width) bool
    quality : Q, larger is more wall-like
    solid : True when the walls are the strokes themselves, not what lies between them
    weight : least weight of the lines taken, pixels; 0 where weight was not asked
    hue : bin of the hue taken; None where hue was not asked
    """

    name: str
    walls: NDArray[np.bool_]
    quality: float
    solid: bool = False
    weight: float = 0.0
    hue: int | None = None


def weight_hypotheses(
    sheet: Sheet, ink: NDArray[np.bool_], outlines: NDArray[np.bool_], sizes: WallSizes
) -> tuple[Hypothesis, ...]:
    """Walls under every assumption about weight and hue that the drawing offers.

    Parameters
    ----------
    sheet : the drawing made ready
    ink : (height, width) bool, its ink without text and doors
    outlines : (height, width) bool, its ink with doors, which close the insides of walls at the jambs
    sizes : of walls on this sheet
    """
    if not ink.any():
        return ()
    cells = thin_cells(outlines, sizes)
    hues = _hues(sheet, ink)
    trust = IN_COLOUR if hues else 1.0
    found: list[Hypothesis] = []
    widths, weights = stroke_widths(ink, HEAVIEST), line_weights(sheet.darkness, ink)
    lines = common_weight(weights, ink)
    faces = {f"strokes of at least {q} px": widths >= q for q in range(2, HEAVIEST + 1)}
    faces |= {f"lines of at least {w} px": ink & (weights >= w) for w in SUBPIXEL_WEIGHTS}
    for (name, heavy), least in zip(faces.items(), (*range(2, HEAVIEST + 1), *SUBPIXEL_WEIGHTS), strict=True):
        if heavy.any():
            walls, solid = walls_between(heavy, ink, cells, sizes)
            heavier = above_lines(common_weight(weights, walls), lines) if solid else 1.0
            found.append(judged(name, walls, sizes, solid, trust * heavier, least))
    for side in HEAVIER:
        block = opened(ink, side)
        if not block.any():
            break
        strokes = tidy(long_runs(block, sizes.face_length, 0) | long_runs(block, sizes.face_length, 1), sizes, within=ink)
        heavier = above_lines(common_weight(weights, strokes), lines)
        found.append(judged(f"solid strokes of at least {side} px", strokes, sizes, True, trust * heavier, side))
    loose, *strict = long_cells(outlines, sizes)
    narrow = {"long cells": loose.walls(), STRAIGHT_CELLS: np.logical_or.reduce([c.walls() for c in strict])}
    found += [judged(name, tidy(walls, sizes), sizes, False, trust) for name, walls in narrow.items()]
    hatched, face = hatched_walls(outlines, cells, sizes)
    found.append(judged(HATCHED, hatched, sizes, weight=face))
    for hue in hues:
        coloured = ink & of_hue(sheet.hue, hue)
        walls, solid = walls_between(coloured, coloured, cells, sizes)
        walls = walls if solid else walls | tidy(loose.walls(outlines & of_hue(sheet.hue, hue)), sizes)
        walls = of_own_hue(walls, coloured, outlines & (sheet.hue != NO_HUE) & ~of_hue(sheet.hue, hue), sizes)
        found.append(replace(judged(f"hue {hue * 180 // HUE_BINS * 2} degrees", walls, sizes, solid), hue=hue))
    return tuple(found)


def above_lines(weight: float, lines: float) -> float:
    """Trust in solid walls of a weight: 1 where they are twice as heavy as the drawing's lines, 0 where they are lines like all.

    >>> above_lines(4.0, 1.0), above_lines(3.0, 2.0), above_lines(1.0, 1.0)
    (1.0, 0.5, 0.0)
    """
    return float(np.clip((weight / lines - 1) / HEAVIER_BY, 0.0, 1.0)) if lines > 0 else 1.0


def centre_line(walls: NDArray[np.bool_], sizes: WallSizes) -> tuple[float, float]:
    """Length of the horizontal and of the vertical centre lines, pixels: thin cross-sections of long pieces, counted."""
    lengths = []
    for axis in (1, 0):
        long = long_runs(walls, 0.05 * sizes.long_side, axis)
        across = run_lengths(long, 1 - axis)
        thin = long & (across <= 1.5 * sizes.thickness)
        lengths.append(float((1.0 / across[thin]).sum()))
    return lengths[0], lengths[1]


def purity(walls: NDArray[np.bool_], sizes: WallSizes) -> float:
    """Share of the walls that lies in long thin runs; 0 of nothing."""
    if not walls.any():
        return 0.0
    across, down = run_lengths(walls, 1), run_lengths(walls, 0)
    thin, long = 1.5 * sizes.thickness, 0.05 * sizes.long_side
    pure = ((across >= long) & (down <= thin)) | ((down >= long) & (across <= thin))
    return float(pure[walls].mean())


def slenderness(walls: NDArray[np.bool_]) -> float:
    """Share of the walls that lies in runs at least `SLENDER` times longer than they are thick there; 0 of nothing."""
    if not walls.any():
        return 0.0
    across, down = run_lengths(walls, 1)[walls], run_lengths(walls, 0)[walls]
    return float((np.maximum(across, down) >= SLENDER * np.minimum(across, down)).mean())


def with_openings(walls: NDArray[np.bool_], sizes: WallSizes, widest: float = OPENING) -> NDArray[np.bool_]:
    """Solid walls with their doors and windows walled up: the piers between them are no longer than thick, the wall is.

    A gap that ends at a wall which runs across it is a part of a room.

    >>> walls = np.zeros((30, 100), dtype=bool); walls[10:16, :40] = walls[10:16, 50:] = True
    >>> bool(with_openings(walls, WallSizes(100, 6.0))[10:16].all())
    True
    """
    whole = walls.copy()
    for axis in (0, 1):
        ends = gap_ends(walls, widest * sizes.long_side, axis)
        across = run_lengths(ends > 0, 1 - axis)
        narrow = np.nonzero((across > 0) & (across <= 1.5 * sizes.thickness))
        whole[narrow] |= ends[narrow] >= END_WALL * across[narrow]
    return whole


def evenness(walls: NDArray[np.bool_]) -> float:
    """Share of the walls' length that is about as thick as walls are: in solid walls, thin strokes are lines; 0 of nothing.

    >>> walls = np.zeros((60, 80), dtype=bool); walls[5:15, 10:70] = True; walls[40, 10:70] = True
    >>> round(evenness(walls), 2)
    0.5
    """
    thickness = thinner_run(walls)[walls]
    if not thickness.size:
        return 0.0
    by_length = 1.0 / thickness
    return float(by_length[thickness >= EVEN * np.percentile(thickness, 75)].sum() / by_length.sum())


def judged(
    name: str, walls: NDArray[np.bool_], sizes: WallSizes, solid: bool = False, trust: float = 1.0, weight: float = 0.0
) -> Hypothesis:
    """A hypothesis with Q = sqrt(horizontal x vertical centre line) / M x purity^3 x slenderness^2.

    The page has purity^2 and no slenderness: then furniture that stands along walls is taken for a second layer of them.
    """
    whole = with_openings(walls, sizes) if solid else walls
    across, down = centre_line(whole, sizes)
    quality = trust * np.sqrt(across * down) / sizes.long_side * purity(whole, sizes) ** 3 * slenderness(whole) ** 2
    if solid:
        quality *= evenness(walls) ** 4
    return Hypothesis(name, walls, float(quality), solid, weight)


def _hues(sheet: Sheet, ink: NDArray[np.bool_]) -> list[int]:
    """Bins of hue that hold at least 5 % of the ink, when at least 30 % of it is coloured."""
    hues = sheet.hue[ink]
    coloured = hues[hues != NO_HUE]
    if coloured.size < 0.3 * hues.size:
        return []
    counts = np.bincount(coloured.astype(int) * HUE_BINS // 180, minlength=HUE_BINS)
    return [int(k) for k in np.flatnonzero(counts >= 0.05 * hues.size)]


def of_own_hue(walls: NDArray[np.bool_], own: NDArray[np.bool_], other: NDArray[np.bool_], sizes: WallSizes) -> NDArray[np.bool_]:
    """Walls without the parts that lie nearer to lines of other hues: insides flow into each other where no line parts them.

    >>> walls, own, other = np.zeros((3, 20, 60), dtype=bool); walls[5:12] = True
    >>> own[[5, 11], :30] = other[[5, 11], 30:] = True
    >>> kept = of_own_hue(walls, own, other, WallSizes(300, 8)); kept[8, [5, 20, 40, 55]].tolist()
    [True, True, False, False]
    """
    if not own.any() or not other.any():
        return walls
    to_own, to_other = (cv2.distanceTransform((~mask).astype(np.uint8), cv2.DIST_C, 3) for mask in (own, other))
    side = int(sizes.thickness) | 1
    inside = walls & ~own & ~other
    nearer = cv2.blur((inside & (to_own <= to_other)).astype(np.float32), (side, side))
    return walls & (nearer >= OWN_HUE * cv2.blur(inside.astype(np.float32), (side, side)))


def of_hue(hue: NDArray[np.uint8], which: int) -> NDArray[np.bool_]:
    """Pixels whose hue lies in one bin."""
    return (hue != NO_HUE) & (hue.astype(int) * HUE_BINS // 180 == which)
