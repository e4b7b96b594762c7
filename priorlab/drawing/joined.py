"""Walls of several hypotheses together: what one misses, another may add, if it looks like wall where it is added.

Styles mix: an outer ring is hatched and the inner walls are filled, a wing stands askew, partitions are thin. An added piece
must be slender, must not stand along a wall as furniture does, must lie inside the building and must meet walls, or end at
doors, at two places.
"""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.core.drawing import Door
from priorlab.drawing.runs import gaps_between, label_runs, run_lengths
from priorlab.drawing.strokes import common_thickness, common_weight, disc, opened
from priorlab.drawing.wall_sizes import WallSizes
from priorlab.drawing.weight import SLENDER, Hypothesis, with_openings

AS_WORTHY = 0.6
"""Only hypotheses that are worth so much of the best one add to it."""

AS_THICK = 0.6
"""Solid ink so much as thick as walls are is wall wherever it hangs together with them."""

TELLING = 4
"""Below so many pixels thin and thick are not told apart."""

THIN = 0.35
"""Outside the building, strokes thinner than this share of the walls' thickness are none."""

HEAVY = 2.5
"""Partitions without a door are so many times as thick as lines."""

AT_JAMB = 0.15
"""A jamb stands at a piece within so many door widths."""

WIDE = 0.3
"""Gap in the outer walls that still closes a building, share of M: a row of windows."""

EDGE = 2
"""Ragged edges of solid walls, pixels."""

INSIDE = 0.8
"""So much of an added piece lies inside the building."""

OPENING = 10.0
"""Openings up to so many thicknesses long do not let the outside in."""

ALONGSIDE = 0.4
"""No more of it may lie close along a wall."""


def with_heavy_ink(walls: NDArray[np.bool_], ink: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Solid walls with the ink as thick as they are that their lines lead to: diagonal wings, stubs, piers.

    >>> ink = np.zeros((60, 60), dtype=bool); ink[10:18, 5:50] = True; ink[18:50, 30] = True; ink[42:50, 26:34] = True
    >>> walls = ink.copy(); walls[18:] = False
    >>> bool(with_heavy_ink(walls, ink)[46, 30]), bool(with_heavy_ink(walls, ink)[25, 30])
    (True, False)
    """
    side = max(TELLING, int(np.ceil(AS_THICK * common_thickness(walls))))
    thick = cv2.morphologyEx(np.pad(ink, side).astype(np.uint8), cv2.MORPH_OPEN, disc(side))[side:-side, side:-side].astype(bool)
    n_parts, parts = cv2.connectedComponents(ink.astype(np.uint8), connectivity=8)
    held = np.bincount(parts[walls & ink], minlength=n_parts) > 0
    held[0] = False
    return walls | (thick & held[parts])


def with_edges(walls: NDArray[np.bool_], ink: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Solid walls with the ink that goes on from them for `EDGE` pixels: heavy strokes end short of ragged edges and ends.

    >>> ink = np.ones((9, 9), dtype=bool); walls = np.zeros_like(ink); walls[4, 4] = True; ink[:, 5] = False
    >>> with_edges(walls, ink)[4].astype(int).tolist()
    [0, 0, 1, 1, 1, 0, 0, 0, 0]
    """
    cross = cv2.getStructuringElement(cv2.MORPH_CROSS, (3, 3))
    for _ in range(EDGE):
        walls = walls | (ink & cv2.dilate(walls.astype(np.uint8), cross).astype(bool))
    return walls


def between_ends(windows: NDArray[np.bool_], walls: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Rows (or columns) of windows that run from one end of a wall to another one; furniture may stand before a window.

    >>> walls = np.zeros((5, 20), dtype=bool); walls[:3, :5] = walls[:3, 15:] = True
    >>> windows = np.zeros_like(walls); windows[:, 5:15] = True
    >>> between_ends(windows, walls)[:, 10].astype(int).tolist()
    [1, 1, 1, 0, 0]
    """
    solid, kept = (walls & ~windows).astype(np.uint8), np.zeros_like(walls)
    for axis in (0, 1):
        reach = np.ones((2 * EDGE + 1, 1) if axis == 0 else (1, 2 * EDGE + 1), np.uint8)
        near = cv2.dilate(solid, reach).astype(bool) & windows
        labels = label_runs(windows, axis)
        ended = np.zeros((2, int(labels.max()) + 1), dtype=bool)
        for k, step in enumerate((1, -1)):
            rim = windows & ~np.roll(windows, step, axis)
            ended[k, labels[rim]] = near[rim]
        kept |= windows & (ended[0] & ended[1])[labels]
    return kept


def without_thin_outside(walls: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Solid walls without the thin strokes outside what the thick ones enclose: terraces, title blocks, section marks.

    Nothing is taken off where thick walls do not make up most of all, or enclose nothing.
    """
    side = int(np.ceil(THIN * common_thickness(walls)))
    core = opened(walls, side)
    if side < TELLING or 2 * core.sum() < walls.sum():
        return walls
    n_parts, parts = cv2.connectedComponents((walls & ~core).astype(np.uint8), connectivity=8)
    area = np.bincount(parts.ravel(), minlength=n_parts)
    opening = OPENING * common_thickness(walls)
    closed = core | gaps_between(core, opening, 0) | gaps_between(core, opening, 1)
    inside = np.bincount(parts[inside_of(closed)], minlength=n_parts)
    outside = (inside < (1 - INSIDE) * area) & (area >= side**2)
    outside[0] = False
    return walls & ~outside[parts]


def with_others(
    best: Hypothesis,
    hypotheses: Sequence[Hypothesis],
    worths: Sequence[float],
    sizes: WallSizes,
    doors: Sequence[Door],
    weights: NDArray[np.float64],
) -> NDArray[np.bool_]:
    """Solid walls of the best hypothesis, and the solid pieces of the others that belong to them, the worthiest first.

    Of hypotheses that are worth little only those pieces are taken at which a door stands, or which are much heavier than lines:
    thin partitions. `weights` are those of all lines, 0 where there is none (height, width).
    """
    walls = best.walls
    heavy = HEAVY * max(1.0, common_weight(weights, ~walls))
    least = AS_WORTHY * max(worths)
    order = sorted(range(len(worths)), key=lambda k: -worths[k])
    others = [k for k in order if hypotheses[k].solid and hypotheses[k] is not best]
    for k in others:
        if worths[k] >= least:
            walls = walls | _belonging(hypotheses[k].walls, walls, sizes, doors, weights / heavy, True)
    for k in sorted(others, key=lambda k: -hypotheses[k].weight):
        if worths[k] < least:
            walls = walls | _belonging(hypotheses[k].walls, walls, sizes, doors, weights / heavy, False)
    return walls


def inside_of(walls: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Where walls lie to the left and to the right, above and below; a building that is cut off goes on beyond the sheet.

    >>> inside_of(np.pad(np.array([[0, 1, 0], [1, 0, 1], [0, 1, 0]], dtype=bool), 1)).astype(int)[1:-1, 1:-1].tolist()
    [[0, 1, 0], [1, 1, 1], [0, 1, 0]]
    >>> inside_of(np.array([[0, 1, 0, 0], [0, 0, 1, 0], [0, 1, 0, 0], [0, 0, 0, 0]], dtype=bool)).astype(int).tolist()
    [[0, 1, 0, 0], [0, 0, 1, 0], [0, 1, 0, 0], [0, 0, 0, 0]]
    """
    seen = []
    for axis in (0, 1):
        for way in (walls, np.flip(walls, axis)):
            found = np.maximum.accumulate(way, axis=axis) | way.take(0, axis=axis).any()
            seen.append(found if way is walls else np.flip(found, axis))
    return np.logical_and.reduce(seen)


def _belonging(
    more: NDArray[np.bool_],
    walls: NDArray[np.bool_],
    sizes: WallSizes,
    doors: Sequence[Door],
    heaviness: NDArray[np.float64],
    trusted: bool,
) -> NDArray[np.bool_]:
    """Pieces of `more` beside `walls` that belong to the building: they meet walls or hold jambs at two places.

    For pieces with a median heaviness of 1 or more one place is enough; others must hold a jamb or be `trusted`.
    """
    rim = cv2.dilate(walls.astype(np.uint8), np.ones((3, 3), np.uint8)).astype(bool)
    extra = more & ~rim
    n_parts, parts, stats, _ = cv2.connectedComponentsWithStats(extra.astype(np.uint8), connectivity=8)
    found = np.zeros_like(walls)
    large = np.flatnonzero(stats[1:, cv2.CC_STAT_WIDTH : cv2.CC_STAT_HEIGHT + 1].max(axis=1) >= sizes.piece_length) + 1
    if not large.size:
        return found
    closed = with_openings(walls, sizes, WIDE)
    inside = inside_of(closed)
    reach = max(4, round(sizes.thickness / 2))
    square = np.ones((2 * reach + 1, 2 * reach + 1), np.uint8)
    along_opening, along_wall = (cv2.dilate(mask.astype(np.uint8), square).astype(bool) for mask in (closed, walls))
    down, across = (run_lengths(extra, axis) for axis in (0, 1))
    thin, long = np.minimum(down, across), np.maximum(down, across)
    for k in large:
        x, y, width, height, area = stats[k]
        top, left = max(0, y - 3), max(0, x - 3)
        window = np.s_[top : y + height + 3, left : x + width + 3]
        part = parts[window] == k
        slender = (long[window] >= SLENDER * thin[window])[part].mean()
        is_heavy = float(np.median(heaviness[window][part])) >= 1
        within = is_heavy or inside[window][part].mean() >= INSIDE  # no terrace, no dimension is heavy
        close = (along_wall if is_heavy else along_opening)[window][part].mean()
        if slender < 0.6 or close > ALONGSIDE or not within:
            continue
        jambs = jambs_at(part, (left, top), doors)
        if not (is_heavy or jambs or trusted):
            continue
        near = cv2.dilate(part.astype(np.uint8), np.ones((7, 7), np.uint8)).astype(bool) & closed[window]
        if cv2.connectedComponents(near.astype(np.uint8), connectivity=8)[0] - 1 + jambs >= (1 if is_heavy else 2):
            found[window] |= part
            found[window] |= (
                more[window] & rim[window] & cv2.dilate(part.astype(np.uint8), np.ones((5, 5), np.uint8)).astype(bool)
            )
    return found


def jambs_at(part: NDArray[np.bool_], corner: tuple[int, int], doors: Sequence[Door]) -> int:
    """How many jambs of doors stand at a piece, whose window has its upper left corner there."""
    if not doors:
        return 0
    jambs = np.array([jamb for door in doors for jamb in (door.hinge, door.strike)]) - corner
    reach = np.repeat([max(3.0, AT_JAMB * door.width) for door in doors], 2)
    height, width = part.shape
    near = (jambs > -reach[:, None]).all(axis=1) & (jambs < np.array([width, height]) + reach[:, None]).all(axis=1)
    away = cv2.distanceTransform((~part).astype(np.uint8), cv2.DIST_L2, 5)
    x, y = np.clip(np.rint(jambs[near]).astype(int), 0, [width - 1, height - 1]).T
    return int((away[y, x] <= reach[near]).sum())
