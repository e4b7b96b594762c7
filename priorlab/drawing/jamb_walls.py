"""What stands at the jambs of a door: a wall on either side of its opening, and the same wall on both."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.drawing.symbol import Symbols, look_up, points_between

BESIDE = 0.025
"""Distance between the lines along which a jamb's wall is looked for, as a share of the open side; a pixel at least."""

PROFILE_REACH = 0.4
"""A wall is at most so thick, as a share of the open side, to either side of the jamb."""

LEVEL = 3
"""The corners at the two jambs may lie so many pixels apart across the wall."""

WALL_REACH = 0.4
"""So far beyond its jambs a wall at an angle goes on, as a share of the opening: it tells the opening's direction."""

PAIR_REACH = 0.15
"""The strikes of a double door are one within this share of its wider leaf."""


@dataclass(frozen=True, eq=False)
class Jambs:
    """What stands at the jambs of (K,) candidates.

    Parameters
    ----------
    hinge_support, strike_support : share of wall ink just beyond each jamb, away from the opening
    common : thickness of the ink that the walls at both jambs have in common, pixels (of a hollow wall, its two lines)
    leaf : thickness of the leaf's line, pixels
    wall_length : longer side of what stands at the jambs, of the shorter piece, pixels
    """

    hinge_support: NDArray[np.float64]
    strike_support: NDArray[np.float64]
    common: NDArray[np.float64]
    leaf: NDArray[np.float64]
    wall_length: NDArray[np.float64]

    @property
    def support(self) -> NDArray[np.float64]:
        """Share of wall ink beyond the weaker jamb."""
        return np.minimum(self.hinge_support, self.strike_support)

    @property
    def heavier(self) -> NDArray[np.float64]:
        """How many times as thick as the leaf's line the wall on both sides is."""
        return self.common / np.maximum(self.leaf, 1.0)

    def __getitem__(self, keep: NDArray[np.bool_] | NDArray[np.int64]) -> Jambs:
        return Jambs(**{name: getattr(self, name)[keep] for name in self.__dataclass_fields__})


def read_jambs(lines: NDArray[np.bool_], walls: NDArray[np.bool_], symbols: Symbols) -> Jambs:
    """Look at the walls of candidates.

    Parameters
    ----------
    lines : (height, width) bool, all ink
    walls : (height, width) bool, ink that may be wall
    symbols : the candidates
    """
    at_hinge = _profile(walls, symbols.hinge, symbols.strike)
    at_strike = _profile(walls, symbols.strike, symbols.hinge)[:, ::-1]
    length = component_lengths(lines)
    ends = (jamb_points(symbols.hinge, symbols.strike), jamb_points(symbols.strike, symbols.hinge))
    return Jambs(
        hinge_support=jamb_support(walls, symbols.hinge, symbols.strike),
        strike_support=jamb_support(walls, symbols.strike, symbols.hinge),
        common=_in_common(at_hinge, at_strike),
        leaf=line_thickness(lines, symbols.hinge, symbols.tip),
        wall_length=np.minimum(*(_largest(length, end) for end in ends)),
    )


def component_lengths(ink: NDArray[np.bool_]) -> NDArray[np.int32]:
    """(height, width) longer side of the component that each pixel of ink belongs to; 0 on paper."""
    _, labels, stats, _ = cv2.connectedComponentsWithStats(ink.astype(np.uint8), connectivity=8)
    lengths = np.maximum(stats[:, cv2.CC_STAT_WIDTH], stats[:, cv2.CC_STAT_HEIGHT])
    lengths[0] = 0
    return np.asarray(lengths[labels], dtype=np.int32)


def meets_other_leaf(symbols: Symbols, jambs: Jambs, least: float) -> NDArray[np.bool_]:
    """Where the strike meets the strike of a leaf that comes from the other side: a double door.

    Parameters
    ----------
    symbols, jambs : candidates
    least : share of wall ink that counts as a wall, at the hinges
    """
    hung = np.flatnonzero((jambs.hinge_support >= least) & symbols.has_arc)
    paired = np.zeros(len(symbols.leaf), dtype=bool)
    if hung.size:
        strike, hinge, width = symbols.strike[hung], symbols.hinge[hung], symbols.width[hung]
        apart = np.abs(strike[:, None, :] - strike[None, :, :]).max(axis=2)
        out = (hinge - strike) / np.maximum(width, 1e-9)[:, None]
        opposite = out @ out.T < -0.9
        meet = opposite & (apart <= PAIR_REACH * np.maximum(width[:, None], width[None, :]))
        paired[hung] = meet.any(axis=1)
    return paired


def jamb_support(walls: NDArray[np.bool_], jamb: NDArray[np.float64], other: NDArray[np.float64]) -> NDArray[np.float64]:
    """(K,) share of wall ink in a short stretch beyond each jamb, away from the other; the best of five parallel lines."""
    return np.asarray(look_up(walls, jamb_points(jamb, other)).mean(axis=2).max(axis=1))


def in_line_with_walls(
    walls: NDArray[np.bool_], one: NDArray[np.float64], other: NDArray[np.float64], least: float = 0.9
) -> NDArray[np.bool_]:
    """(K,) where walls leave both ends of an opening in its own direction, for a good part of its width.

    Parameters
    ----------
    walls : (height, width) bool, ink that may be wall
    one, other : (K, 2) ends of openings
    least : share of ink on the best of five parallel lines that counts as a wall
    """
    found = np.ones(len(one), dtype=bool)
    for jamb, far in ((one, other), (other, one)):
        some = np.flatnonzero(found)
        few = jamb_points(jamb[some], far[some], WALL_REACH, np.s_[1::5])
        dark = np.asarray(look_up(walls, few).all(axis=2)).any(axis=1)  # most fail at once
        found[some[~dark]] = False
        some = some[dark]
        found[some] = look_up(walls, jamb_points(jamb[some], far[some], WALL_REACH)).mean(axis=2).max(axis=1) >= least
    return found


def jamb_points(
    jamb: NDArray[np.float64], other: NDArray[np.float64], far: float = 0.10, steps: slice = np.s_[:]
) -> NDArray[np.float64]:
    """(K, 5, 12, 2) points of five parallel lines that leave each jamb, away from the other, for a share of the opening.

    `steps` picks some of the twelve.
    """
    out, side, length = _directions(jamb, other)
    reach = np.linspace(0.0, 1.0, 12)[None, steps] * np.maximum(4.0, far * length) + 1.0  # (K, steps)
    aside = np.arange(-2, 3) * np.maximum(1.0, BESIDE * length)  # (K, 5)
    begins = jamb.T[..., None] + aside * side.T[..., None]  # (2, K, 5)
    return np.moveaxis(begins[..., None] + (reach * out.T[..., None])[:, :, None, :], 0, -1)


def line_thickness(
    ink: NDArray[np.bool_], start: NDArray[np.float64], end: NDArray[np.float64], most: int = 8
) -> NDArray[np.float64]:
    """(K,) thickness of the line of ink from start to end: the middle one of the runs across it; 0 where there is none."""
    _, side, _ = _directions(start, end)
    along = points_between(start, end, 0.25)[:, ::4]
    across = np.arange(-most, most + 1)
    dark = look_up(ink, along[:, :, None, :] + across[:, None] * side[:, None, None, :])
    on_line = dark[:, :, most - 1 : most + 2]  # it may lie a pixel beside
    middle = most - 1 + on_line.argmax(axis=2)
    place = np.arange(2 * most + 1)
    after, before = place >= middle[..., None], place <= middle[..., None]
    ahead = np.cumprod(dark | ~after, axis=2) * after
    behind = np.cumprod((dark | ~before)[:, :, ::-1], axis=2)[:, :, ::-1] * before
    run = ahead.sum(axis=2) + behind.sum(axis=2) - 1
    return np.asarray(np.median(np.where(on_line.any(axis=2), run, 0), axis=1), dtype=np.float64)


def _in_common(one: NDArray[np.float64], other: NDArray[np.float64]) -> NDArray[np.float64]:
    """(K,) ink that two profiles have in common, one of them moved by a few pixels: jambs are seldom exactly level."""
    best = np.zeros(len(one))
    for shift in range(-LEVEL, LEVEL + 1):
        best = np.maximum(best, np.minimum(one, np.roll(other, shift, axis=1)).sum(axis=1))
    return best


def _largest(values: NDArray[np.int32], points: NDArray[np.float64]) -> NDArray[np.float64]:
    """(K,) largest value of an image at (K, ..., 2) points x, y; 0 outside."""
    xy = np.rint(points).astype(np.int64).reshape(len(points), int(np.prod(points.shape[1:-1])), 2)
    height, width = values.shape
    inside = (xy >= 0).all(axis=-1) & (xy < [width, height]).all(axis=-1)
    clipped = np.clip(xy, 0, [width - 1, height - 1])
    found = np.where(inside, values[clipped[..., 1], clipped[..., 0]], 0)
    return np.asarray(found.max(axis=1, initial=0), dtype=np.float64)


def _profile(walls: NDArray[np.bool_], jamb: NDArray[np.float64], other: NDArray[np.float64]) -> NDArray[np.float64]:
    """(K, 2 n + 1) share of ink on lines that leave the jamb, from one side of the wall to the other, in steps of a pixel.

    Lines farther off than `PROFILE_REACH` of the open side count as white.
    """
    out, side, length = _directions(jamb, other)
    n = int(np.ceil(PROFILE_REACH * float(length.max(initial=1.0))))
    across = np.arange(-n, n + 1)
    reach = np.linspace(0.25, 1.0, 5)[None, :] * np.maximum(6.0, 0.15 * length)
    points = (
        jamb[:, None, None, :] + reach[:, None, :, None] * out[:, None, None, :] + across[:, None, None] * side[:, None, None, :]
    )
    share = look_up(walls, points).mean(axis=2)
    return np.where(np.abs(across)[None, :] <= PROFILE_REACH * length, share, 0.0)


def _directions(jamb: NDArray[np.float64], other: NDArray[np.float64]) -> tuple[NDArray, NDArray, NDArray]:
    """(K, 2) away from the other point, (K, 2) across that, and (K, 1) the distance between them."""
    along = other - jamb
    length = np.maximum(np.hypot(along[:, 0], along[:, 1]), 1e-9)[:, None]
    out = -along / length
    return out, np.stack([-out[:, 1], out[:, 0]], axis=1), length
