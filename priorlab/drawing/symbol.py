"""How much a triangle looks like a door: leaf, swing and open side, each as a share of ink along a line.

Every measure is taken for many triangles at once by looking up sample points in a mask.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

BARE = 0.26
"""Less ink than this, along arc and chord alike, is none of a swing: the leaf stands alone."""

ARC_LEAD = 0.4
"""An arc holds so much more ink than its chord."""

WORTH = 0.5
"""A leaf with less ink than this is none, and its arc is not looked at."""

N_SAMPLES = 32
"""Points looked up along a side or an arc."""


@dataclass(frozen=True, eq=False)
class Symbols:
    """Triangles read as doors, (K,) values each.

    Parameters
    ----------
    hinge, strike, tip : (K, 2) x, y pixels; hinge to tip is the leaf, hinge to strike the open side
    leaf : share of ink along the leaf
    arc : share of ink along the quarter arc from tip to strike
    chord : share of ink along the straight line from tip to strike (a folding door)
    equal : shorter over longer of leaf and open side
    open_ink : share of ink on the open side, its ends left out, or on a line just beside it where that has less: a sill
    crossed : the same where it has most
    beyond : share of ink beyond the tip where leaf or arc would go on, less the ink beside that: a table's circle, a crossing
    """

    hinge: NDArray[np.float64]
    strike: NDArray[np.float64]
    tip: NDArray[np.float64]
    leaf: NDArray[np.float64]
    arc: NDArray[np.float64]
    chord: NDArray[np.float64]
    equal: NDArray[np.float64]
    open_ink: NDArray[np.float64]
    crossed: NDArray[np.float64]
    beyond: NDArray[np.float64]

    @property
    def width(self) -> NDArray[np.float64]:
        """Length of the open side."""
        return np.asarray(np.hypot(*(self.strike - self.hinge).T))

    @property
    def opening_deg(self) -> NDArray[np.float64]:
        """Angle at the hinge between leaf and open side: how far the door is drawn open."""
        leaf, side = self.tip - self.hinge, self.strike - self.hinge
        cosine = (leaf * side).sum(axis=1) / np.maximum(np.hypot(*leaf.T) * np.hypot(*side.T), 1e-9)
        return np.asarray(np.degrees(np.arccos(np.clip(cosine, -1, 1))))

    @property
    def swing(self) -> NDArray[np.float64]:
        """Share of ink from tip to strike: along the arc where there is one, else along the chord."""
        return np.where(self.has_arc, self.arc, self.chord)

    @property
    def has_arc(self) -> NDArray[np.bool_]:
        """Where the ink follows the arc and leaves the chord; on a flat triangle the two lie too close to tell."""
        return np.asarray(self.arc >= self.chord + ARC_LEAD)

    @property
    def is_alone(self) -> NDArray[np.bool_]:
        """Where a leaf has neither arc nor chord."""
        return np.asarray(np.maximum(self.arc, self.chord) < BARE)

    @property
    def quality(self) -> NDArray[np.float64]:
        """Product of what a symbol should have; 1 at best. An arc counts for more than a chord, a chord for more than none."""
        swing = np.where(self.has_arc, self.arc, np.where(self.is_alone, 0.6, 0.8 * self.chord))
        return self.leaf * swing * self.equal * (1 - self.open_ink) * (1 - 0.5 * self.beyond)

    def __getitem__(self, keep: NDArray[np.bool_] | NDArray[np.int64]) -> Symbols:
        return Symbols(**{name: getattr(self, name)[keep] for name in self.__dataclass_fields__})


def read_symbols(
    lines: NDArray[np.bool_], triangles: NDArray[np.float64], min_leaf: float = 0.0, min_swing: float = 0.0
) -> Symbols:
    """Measure triangles as doors; of the two ends of the open side the likelier one becomes the hinge.

    Parameters
    ----------
    lines : (height, width) bool, all ink, widened by a pixel so that corners may lie beside it
    triangles : (K, 3, 2) tip and the two ends of the open side
    min_leaf, min_swing : with less ink along the leaf, or along arc and chord unless that is bare, a triangle is hopeless: what
        comes after it in `Symbols` is not measured and stays 0
    """
    tip, first, second = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    one, other = (look_up(lines, points_between(end, tip)).mean(axis=1) for end in (first, second))
    is_first = one + _alike(tip, first, second) >= other + _alike(tip, second, first)
    some = np.flatnonzero(np.maximum(one, other) >= min_leaf)
    is_first[some] = _likeness(lines, one[some], tip[some], first[some], second[some]) >= _likeness(
        lines, other[some], tip[some], second[some], first[some]
    )
    hinge, strike = np.where(is_first[:, None], first, second), np.where(is_first[:, None], second, first)
    leaf = np.where(is_first, one, other)
    unread = {name: np.zeros(len(tip)) for name in ("arc", "chord", "open_ink", "crossed", "beyond")}
    found = Symbols(hinge=hinge, strike=strike, tip=tip, leaf=leaf, equal=_alike(tip, hinge, strike), **unread)
    some = np.flatnonzero(leaf >= min_leaf)
    found.arc[some] = _best_arc(lines, hinge[some], tip[some], strike[some])
    found.chord[some] = look_up(lines, points_between(tip[some], strike[some])).mean(axis=1)
    some = some[((found.swing >= min_swing) | found.is_alone)[some]]
    _read_surroundings(lines, found, some)
    return found


def _alike(tip: NDArray, hinge: NDArray, strike: NDArray) -> NDArray:
    """(K,) shorter over longer of leaf and open side."""
    leaf, opening = np.hypot(*(tip - hinge).T), np.hypot(*(strike - hinge).T)
    return np.asarray(np.minimum(leaf, opening) / np.maximum(np.maximum(leaf, opening), 1e-9))


def _likeness(lines: NDArray[np.bool_], leaf: NDArray, tip: NDArray, hinge: NDArray, strike: NDArray) -> NDArray:
    """(K,) how likely this end of the open side is the hinge: leaf, equal lengths and arc, each 0 to 1."""
    likely = leaf + _alike(tip, hinge, strike)
    some = np.flatnonzero(leaf >= WORTH)
    likely[some] += look_up(lines, arc_points(hinge[some], tip[some], strike[some])).mean(axis=1)
    return likely


def _read_surroundings(lines: NDArray[np.bool_], found: Symbols, some: NDArray[np.intp]) -> None:
    """Fill in the open side, and what goes on beyond the tip, of some symbols."""
    hinge, tip, strike = found.hinge[some], found.tip[some], found.strike[some]
    found.open_ink[some] = _open_lanes(lines, hinge, strike).min(axis=0)
    found.crossed[some] = _open_lanes(lines, hinge, strike, 0.22).max(axis=0)  # a leaf half open leaves the hinge between them
    ways = (arc_beyond, leaf_beyond)
    found.beyond[some] = np.maximum(*(_goes_on(lines, way, hinge, tip, strike) for way in ways))


def is_box(lines: NDArray[np.bool_], symbols: Symbols, least: float = 0.8) -> NDArray[np.bool_]:
    """Where a triangle is half of a drawn box, or its leaf goes on beyond the tip: a cupboard with a diagonal, a cross.

    Parameters
    ----------
    lines : (height, width) bool, all ink, widened by a pixel
    symbols : candidates without an arc
    least : share of ink that counts as a line
    """
    vertices = (symbols.hinge, symbols.strike, symbols.tip)
    boxed = np.zeros(len(symbols.leaf), dtype=bool)
    for k in range(3):
        one, other = vertices[(k + 1) % 3], vertices[(k + 2) % 3]
        fourth = one + other - vertices[k]  # completes the parallelogram
        sides = [look_up(lines, points_between(end, fourth)).mean(axis=1) for end in (one, other)]
        boxed |= np.minimum(*sides) >= least
    beyond = symbols.tip + 0.3 * (symbols.tip - symbols.hinge)
    crossing = symbols.tip + 0.3 * (symbols.tip - symbols.strike)
    for end in (beyond, crossing):
        boxed |= look_up(lines, points_between(symbols.tip, end, 0.2)).mean(axis=1) >= least
    return boxed


def ink_beside(lines: NDArray[np.bool_], symbols: Symbols) -> NDArray[np.float64]:
    """(K,) share of ink on the lines that run along the leaf on either side of it, where it has most; its ends left out.

    A leaf stands in the white: one that is read into the lines of a window has others beside it.
    """
    left = np.stack([symbols.hinge[:, 1] - symbols.tip[:, 1], symbols.tip[:, 0] - symbols.hinge[:, 0]], axis=1)
    asides = (BESIDE_LEAF * left, -BESIDE_LEAF * left)
    lanes = [look_up(lines, points_between(symbols.hinge + a, symbols.tip + a, 0.25)).mean(axis=1) for a in asides]
    return np.asarray(np.maximum(*lanes), dtype=np.float64)


BESIDE_LEAF = 0.16
"""Distance of the lines along which a leaf's surroundings are looked at, as a share of its length."""


def points_between(start: NDArray, end: NDArray, margin: float = 0.05) -> NDArray:
    """(K, N_SAMPLES, 2) points from start to end, a margin left out at both ends."""
    share = np.linspace(margin, 1 - margin, N_SAMPLES)
    return _xy_last(start.T[..., None] + share * (end - start).T[..., None])


def arc_points(centre: NDArray, start: NDArray, end: NDArray) -> NDArray:
    """(K, N_SAMPLES, 2) points on the shorter arc from start to end round the centre; the radius changes evenly."""
    first, last = start - centre, end - centre
    begin = np.arctan2(first[:, 1], first[:, 0])
    turn = (np.arctan2(last[:, 1], last[:, 0]) - begin + np.pi) % (2 * np.pi) - np.pi
    share = np.linspace(0.05, 0.95, N_SAMPLES)[None, :]
    angle = begin[:, None] + share * turn[:, None]
    radius = (1 - share) * np.hypot(*first.T)[:, None] + share * np.hypot(*last.T)[:, None]
    return _xy_last(centre.T[..., None] + radius * np.stack([np.cos(angle), np.sin(angle)]))


def arc_beyond(hinge: NDArray, tip: NDArray, strike: NDArray, aside: float = 0.0) -> NDArray:
    """(K, N_SAMPLES, 2) points where the circle of an arc goes on before the tip; `aside` is a share of its radius outwards."""
    first, last = tip - hinge, strike - hinge
    begin = np.arctan2(first[:, 1], first[:, 0])
    turn = (np.arctan2(last[:, 1], last[:, 0]) - begin + np.pi) % (2 * np.pi) - np.pi
    angle = begin[:, None] - np.sign(turn)[:, None] * np.radians(np.linspace(*BEYOND_ARC, N_SAMPLES))[None, :]
    radius = (1 + aside) * np.hypot(*first.T)[:, None]
    return _xy_last(hinge.T[..., None] + radius * np.stack([np.cos(angle), np.sin(angle)]))


def leaf_beyond(hinge: NDArray, tip: NDArray, strike: NDArray, aside: float = 0.0) -> NDArray:
    """(K, N_SAMPLES, 2) points where the line of a leaf goes on beyond its tip; `aside` is a share of its length to the left."""
    share = np.linspace(*BEYOND_LEAF, N_SAMPLES)
    leaf = tip - hinge
    left = np.stack([-leaf[:, 1], leaf[:, 0]], axis=1)
    return _xy_last((hinge + aside * left).T[..., None] + share * leaf.T[..., None])


def _xy_last(points: NDArray) -> NDArray:
    """(2, K, N) points, as they are quickest to reckon with, as (K, N, 2)."""
    return np.moveaxis(points, 0, -1)


def _best_arc(lines: NDArray[np.bool_], hinge: NDArray, tip: NDArray, strike: NDArray) -> NDArray:
    """(K,) share of ink along the arc; its ends may lie a little nearer to the hinge or farther off than the corners do."""
    first, last = tip - hinge, strike - hinge
    best = look_up(lines, arc_points(hinge, tip, strike)).mean(axis=1)
    some = np.flatnonzero((best >= WORTH) & (best < 1))
    hinge, first, last = hinge[some], first[some], last[some]
    off = np.maximum(OFF_ARC * np.hypot(*last.T), 1.5)[:, None]
    for nearer, farther in ((-1, -1), (-1, 0), (-1, 1), (0, -1), (0, 1), (1, -1), (1, 0), (1, 1)):
        one = tip[some] + nearer * off * first / np.maximum(np.hypot(*first.T), 1e-9)[:, None]
        other = strike[some] + farther * off * last / np.maximum(np.hypot(*last.T), 1e-9)[:, None]
        best[some] = np.maximum(best[some], MOVED * look_up(lines, arc_points(hinge, one, other)).mean(axis=1))
    return best


MOVED = 0.94
"""An arc that does not begin and end at the corners is worth so much of one that does."""

OFF_ARC = 0.03
"""The ends of an arc may lie so far off, as a share of its radius."""


def _open_lanes(lines: NDArray[np.bool_], hinge: NDArray, strike: NDArray, margin: float = 0.12) -> NDArray:
    """(3, K) share of ink on the open side and on a line to either side of it, a margin left out at the jambs."""
    along = strike - hinge
    across = OPEN_ASIDE * np.stack([-along[:, 1], along[:, 0]], axis=1)
    lanes = [points_between(hinge + k * across, strike + k * across, margin) for k in (-1, 0, 1)]
    return np.stack([look_up(lines, lane).mean(axis=1) for lane in lanes])


OPEN_ASIDE = 0.08
"""Distance between the lines along which an opening is looked through, as a share of its width."""


def _goes_on(lines: NDArray[np.bool_], points: Callable[..., NDArray], hinge: NDArray, tip: NDArray, strike: NDArray) -> NDArray:
    """(K,) share of ink on a line beyond the tip, less the ink beside it: in the middle of a wall no line goes on."""
    on = look_up(lines, points(hinge, tip, strike)).mean(axis=1)
    beside = [look_up(lines, points(hinge, tip, strike, aside)).mean(axis=1) for aside in (-ASIDE, ASIDE)]
    return np.maximum(on - np.maximum(*beside), 0.0)


ASIDE = 0.14
"""A line that goes on has white beside it, so far off as a share of the leaf."""

BEYOND_ARC = (10.0, 32.0)
"""Where the circle is looked at beyond the tip, degrees."""

BEYOND_LEAF = (1.12, 1.32)
"""Where the line is looked at beyond the tip, lengths of the leaf."""


def look_up(mask: NDArray[np.bool_], points: NDArray) -> NDArray[np.bool_]:
    """Values of a mask at (..., 2) points x, y; False outside."""
    height, width = mask.shape
    x, y = (np.floor(points[..., k] + 0.5).astype(np.int32) for k in (0, 1))
    inside = (x >= 0) & (x < width) & (y >= 0) & (y < height)
    if inside.all():
        return np.asarray(mask.ravel()[y * np.int32(width) + x])
    place = np.where(inside, y * np.int32(width) + x, 0)
    return np.asarray(inside & mask.ravel()[place])
