"""Folding doors: panels in zigzag along the opening, two equal isosceles wedges in a row that begin at a jamb (fig. 3.5).

Each fold is one of the thesis's triangles, too small and too many to be a door by itself; together they point along the opening,
which goes on, white, to the wall on the other side.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from priorlab.core.drawing import Door
from priorlab.drawing.door_tests import Scene
from priorlab.drawing.geometry import tilts
from priorlab.drawing.jamb_walls import component_lengths, jamb_support
from priorlab.drawing.leaves import straight_pairs
from priorlab.drawing.symbol import look_up, points_between

LEAST_INK = 0.85
"""Share of ink along a panel."""

APEX = (35.0, 115.0)
"""Angle between two panels, degrees."""

ALIKE = 0.75
"""Shorter over longer of two panels, and of two folds."""

OFF = 0.35
"""Folds meet within this share of a panel."""

OPENING = (1.15, 2.3)
"""The opening is so many times as long as the two folds."""

BEFORE = (0.0, 0.06, 0.12)
"""The jamb lies so far before the first corner of the folds, as shares of their length."""

NARROWEST = 0.8
"""A folding door is no narrower than this share of the middle one of the other doors."""

LONG_WALL = 4.0
"""The wall at the hinge is so many times as long as the opening; furniture is not."""


def folding_doors(scene: Scene, ink: NDArray[np.bool_], taken: NDArray[np.float64]) -> tuple[Door, ...]:
    """The folding doors of a drawing, in working pixels.

    Parameters
    ----------
    scene : corners, the pairs that walks connect, and the sheet
    ink : (height, width) bool, thin ink, widened a little
    taken : (D, 3, 2) triangles of doors found already: no fold lies in one

    Returns
    -------
    doors from jamb to jamb, whose tip is the top of the first fold
    """
    folds = _folds(scene, ink)
    if len(folds) < 2:
        return ()
    lengths = component_lengths(scene.sheet.lines)
    widths = np.hypot(*(taken[:, 2] - taken[:, 1]).T)
    least = max(NARROWEST * float(np.median(widths)) if len(widths) else 0.0, 2 * scene.method.min_side)
    found: list[Door] = []
    for tip, start, end in _rows(folds):
        door = _door(scene, lengths, tip, start, end)
        middles = [d.points[:2].mean(axis=0) for d in found] + [t[1:].mean(axis=0) for t in taken]
        if (
            door
            and door.width >= least
            and all(np.hypot(*(door.points[:2].mean(axis=0) - m)) > 0.5 * door.width for m in middles)
        ):
            found.append(door)
    return tuple(found)


def _folds(scene: Scene, ink: NDArray[np.bool_]) -> NDArray[np.float64]:
    """(K, 3, 2) tip and ends of isosceles wedges of two straight panels whose base is open and lies along an axis."""
    method, points = scene.method, scene.corners
    straight = straight_pairs(ink, points, scene.connected, method.min_side / 2, scene.longest / 2, LEAST_INK)
    found = [np.empty((0, 3, 2))]
    for tip in np.flatnonzero(straight.sum(axis=1) >= 2):
        ends = np.flatnonzero(straight[tip])
        one, other = np.triu_indices(ends.size, k=1)
        a, b = points[ends[one]], points[ends[other]]
        away_a, away_b = a - points[tip], b - points[tip]
        long_a, long_b = np.hypot(*away_a.T), np.hypot(*away_b.T)
        apex = np.degrees(np.arccos(np.clip((away_a * away_b).sum(axis=1) / (long_a * long_b), -1, 1)))
        keep = (np.minimum(long_a, long_b) >= ALIKE * np.maximum(long_a, long_b)) & (apex >= APEX[0]) & (apex <= APEX[1])
        keep &= (tilts(a, b) <= method.max_tilt) & ~straight[ends[one], ends[other]]
        found.append(np.stack([np.broadcast_to(points[tip], a.shape), a, b], axis=1)[keep])
    folds = np.concatenate(found)
    base = look_up(ink, points_between(folds[:, 1], folds[:, 2], 0.3)).mean(axis=1)
    return folds[base < 0.5]


def _rows(folds: NDArray[np.float64]) -> list[tuple[NDArray, NDArray, NDArray]]:
    """Top of the first fold, start and end of every row of two folds, the evenest first; each row both ways round."""
    both = np.concatenate([folds, folds[:, [0, 2, 1]]])  # from left to right and back
    tip, start, end = both[:, 0], both[:, 1], both[:, 2]
    base = end - start
    length = np.hypot(*base.T)
    height = np.abs(base[:, 0] * (tip - start)[:, 1] - base[:, 1] * (tip - start)[:, 0]) / np.maximum(length, 1e-9)
    side = np.sign(base[:, 0] * (tip - start)[:, 1] - base[:, 1] * (tip - start)[:, 0])
    rows = []
    order = np.argsort(start[:, 0], kind="stable")  # there may be tens of thousands: look only in the same columns
    first = np.searchsorted(start[order, 0], end[:, 0] - OFF * length - 1)
    last = np.searchsorted(start[order, 0], end[:, 0] + OFF * length + 1)
    for k in range(len(both)):
        some = np.sort(order[first[k] : last[k]])
        near = np.hypot(*(start[some] - end[k]).T) <= OFF * length[k]
        some = some[near]
        near = np.minimum(length[some], length[k]) >= ALIKE * np.maximum(length[some], length[k])
        near &= np.minimum(height[some], height[k]) >= ALIKE * np.maximum(height[some], height[k])
        near &= (base[some] @ base[k] > 0.95 * length[some] * length[k]) & (side[some] == side[k])
        for other in some[near]:
            gap = float(np.hypot(*(start[other] - end[k]))) / length[k] + abs(length[other] - length[k]) / length[k]
            rows.append((gap, tip[k], start[k], end[other]))
    return [row[1:] for row in sorted(rows, key=lambda row: row[0])]


def _door(scene: Scene, lengths: NDArray[np.int32], tip: NDArray, start: NDArray, end: NDArray) -> Door | None:
    """A row of folds from its jamb to the other one; None when no wall stands at either."""
    walls = scene.sheet.walls
    folded = float(np.hypot(*(end - start)))
    along = (end - start) / max(folded, 1e-9)
    starts = np.array([start - share * folded * along for share in BEFORE])  # a corner lies a little inside its fold
    supports = jamb_support(walls, starts, np.broadcast_to(end, starts.shape))
    if supports.max() < scene.method.min_support:
        return None
    start = starts[int((supports >= scene.method.min_support).argmax())]
    reach = np.arange(1.1 * folded, OPENING[1] * folded)
    across = np.array([-along[1], along[0]])
    best = None
    for aside in (-2, -1, 0, 1, 2):
        line = look_up(walls, start + aside * across + reach[:, None] * along)
        if line.any() and (best is None or int(line.argmax()) < best):
            best = int(line.argmax())
    if best is None or not OPENING[0] * folded <= reach[best] <= OPENING[1] * folded:
        return None
    strike = start + reach[best] * along
    if jamb_support(walls, strike[None], start[None])[0] < scene.method.min_support:
        return None
    x, y = np.clip(np.rint(start - 3 * along).astype(int), 0, [walls.shape[1] - 1, walls.shape[0] - 1])
    patch = lengths[max(y - 2, 0) : y + 3, max(x - 2, 0) : x + 3]
    if patch.max(initial=0) < LONG_WALL * reach[best]:
        return None
    hinge, far, top = ((float(point[0]), float(point[1])) for point in (start, strike, tip))
    return Door(hinge, far, top, kind="folding", quality=0.5)
