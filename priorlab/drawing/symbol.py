"""How much a triangle looks like a door: leaf, swing, open side and jambs, each as a share of ink along a line.

Every measure is taken for many triangles at once by looking up sample points in a mask.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

ARC_LEAD = 0.4
"""An arc holds so much more ink than its chord."""

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
    open_ink : share of ink on the open side, its ends left out
    hinge_support, strike_support : share of wall ink just beyond each jamb, away from the opening
    """

    hinge: NDArray[np.float64]
    strike: NDArray[np.float64]
    tip: NDArray[np.float64]
    leaf: NDArray[np.float64]
    arc: NDArray[np.float64]
    chord: NDArray[np.float64]
    equal: NDArray[np.float64]
    open_ink: NDArray[np.float64]
    hinge_support: NDArray[np.float64]
    strike_support: NDArray[np.float64]

    @property
    def support(self) -> NDArray[np.float64]:
        """Share of wall ink beyond the weaker jamb."""
        return np.minimum(self.hinge_support, self.strike_support)

    @property
    def width(self) -> NDArray[np.float64]:
        """Length of the open side."""
        return np.asarray(np.hypot(*(self.strike - self.hinge).T))

    @property
    def swing(self) -> NDArray[np.float64]:
        """Share of ink from tip to strike: along the arc where there is one, else along the chord."""
        return np.where(self.has_arc, self.arc, self.chord)

    @property
    def has_arc(self) -> NDArray[np.bool_]:
        """Where the ink follows the arc and leaves the chord; on a flat triangle the two lie too close to tell."""
        return np.asarray(self.arc >= self.chord + ARC_LEAD)

    @property
    def quality(self) -> NDArray[np.float64]:
        """Product of what a door should have; 1 at best. An arc counts for more than a straight chord."""
        swing = np.where(self.has_arc, self.arc, 0.8 * self.chord)
        return self.leaf * swing * self.equal * (1 - self.open_ink) * (0.5 + 0.5 * self.support)

    def __getitem__(self, keep: NDArray[np.bool_] | NDArray[np.int64]) -> Symbols:
        return Symbols(**{name: getattr(self, name)[keep] for name in self.__dataclass_fields__})


def read_symbols(lines: NDArray[np.bool_], walls: NDArray[np.bool_], triangles: NDArray[np.float64]) -> Symbols:
    """Measure triangles as doors; of the two ends of the open side the likelier one becomes the hinge.

    Parameters
    ----------
    lines : (height, width) bool, all ink, widened by a pixel so that corners may lie beside it
    walls : (height, width) bool, ink that may be wall
    triangles : (K, 3, 2) tip and the two ends of the open side
    """
    tip, first, second = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    one = _measure(lines, walls, tip, first, second)
    other = _measure(lines, walls, tip, second, first)
    better = (one.leaf + one.arc + one.equal) >= (other.leaf + other.arc + other.equal)
    picked = {
        name: np.where(better.reshape(-1, *[1] * (getattr(one, name).ndim - 1)), getattr(one, name), getattr(other, name))
        for name in one.__dataclass_fields__
    }
    return Symbols(**picked)


def meets_other_leaf(symbols: Symbols, least: float, pair_reach: float = 0.15) -> NDArray[np.bool_]:
    """Where the strike stands at no wall but at the strike of a leaf that comes from the other side: a double door.

    Parameters
    ----------
    symbols : candidates
    least : share of wall ink that counts as a wall
    pair_reach : two strikes are one within this share of the door's width
    """
    half = np.flatnonzero((symbols.hinge_support >= least) & (symbols.strike_support < least) & symbols.has_arc)
    paired = np.zeros(len(symbols.leaf), dtype=bool)
    if half.size:
        strike, hinge, width = symbols.strike[half], symbols.hinge[half], symbols.width[half]
        apart = np.abs(strike[:, None, :] - strike[None, :, :]).max(axis=2)
        out = (hinge - strike) / np.maximum(width, 1e-9)[:, None]
        opposite = out @ out.T < -0.9
        meet = opposite & (apart <= pair_reach * np.minimum(width[:, None], width[None, :]))
        paired[half] = meet.any(axis=1)
    return paired


def jamb_support(walls: NDArray[np.bool_], jamb: NDArray[np.float64], other: NDArray[np.float64]) -> NDArray[np.float64]:
    """(K,) share of wall ink in a short stretch beyond each jamb, away from the other; the best of five parallel lines."""
    return np.asarray(_look_up(walls, jamb_points(jamb, other)).mean(axis=2).max(axis=1))


def jamb_points(jamb: NDArray[np.float64], other: NDArray[np.float64]) -> NDArray[np.float64]:
    """(K, 5, 12, 2) points of five parallel lines that leave each jamb, away from the other."""
    along = other - jamb
    length = np.maximum(np.hypot(along[:, 0], along[:, 1]), 1e-9)[:, None]
    out = -along / length
    side = np.stack([-out[:, 1], out[:, 0]], axis=1)
    reach = np.linspace(0.0, 1.0, 12)[None, :] * np.maximum(4.0, 0.10 * length) + 1.0
    lines = [(jamb + shift * side)[:, None, :] + reach[..., None] * out[:, None, :] for shift in (-2, -1, 0, 1, 2)]
    return np.stack(lines, axis=1)


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
        sides = [_look_up(lines, points_between(end, fourth)).mean(axis=1) for end in (one, other)]
        boxed |= np.minimum(*sides) >= least
    beyond = symbols.tip + 0.3 * (symbols.tip - symbols.hinge)
    crossing = symbols.tip + 0.3 * (symbols.tip - symbols.strike)
    for end in (beyond, crossing):
        boxed |= _look_up(lines, points_between(symbols.tip, end, 0.2)).mean(axis=1) >= least
    return boxed


def _measure(lines: NDArray[np.bool_], walls: NDArray[np.bool_], tip: NDArray, hinge: NDArray, strike: NDArray) -> Symbols:
    """All measures for one choice of the hinge."""
    leaf_length = np.hypot(*(tip - hinge).T)
    open_length = np.hypot(*(strike - hinge).T)
    return Symbols(
        hinge=hinge,
        strike=strike,
        tip=tip,
        leaf=_look_up(lines, points_between(hinge, tip)).mean(axis=1),
        arc=_look_up(lines, arc_points(hinge, tip, strike)).mean(axis=1),
        chord=_look_up(lines, points_between(tip, strike)).mean(axis=1),
        equal=np.minimum(leaf_length, open_length) / np.maximum(np.maximum(leaf_length, open_length), 1e-9),
        open_ink=_look_up(lines, points_between(hinge, strike, 0.12)).mean(axis=1),
        hinge_support=jamb_support(walls, hinge, strike),
        strike_support=jamb_support(walls, strike, hinge),
    )


def points_between(start: NDArray, end: NDArray, margin: float = 0.05) -> NDArray:
    """(K, N_SAMPLES, 2) points from start to end, a margin left out at both ends."""
    share = np.linspace(margin, 1 - margin, N_SAMPLES)[None, :, None]
    return start[:, None, :] + share * (end - start)[:, None, :]


def arc_points(centre: NDArray, start: NDArray, end: NDArray) -> NDArray:
    """(K, N_SAMPLES, 2) points on the shorter arc from start to end round the centre; the radius changes evenly."""
    first, last = start - centre, end - centre
    begin = np.arctan2(first[:, 1], first[:, 0])
    turn = (np.arctan2(last[:, 1], last[:, 0]) - begin + np.pi) % (2 * np.pi) - np.pi
    share = np.linspace(0.05, 0.95, N_SAMPLES)[None, :]
    angle = begin[:, None] + share * turn[:, None]
    radius = (1 - share) * np.hypot(*first.T)[:, None] + share * np.hypot(*last.T)[:, None]
    return centre[:, None, :] + radius[..., None] * np.stack([np.cos(angle), np.sin(angle)], axis=2)


def _look_up(mask: NDArray[np.bool_], points: NDArray) -> NDArray[np.bool_]:
    """Values of a mask at (..., 2) points x, y; False outside."""
    xy = np.rint(points).astype(np.int64)
    height, width = mask.shape
    inside = (xy >= 0).all(axis=-1) & (xy < [width, height]).all(axis=-1)
    clipped = np.clip(xy, 0, [width - 1, height - 1])
    return inside & mask[clipped[..., 1], clipped[..., 0]]
