"""The tests that decide about doors, each as measures with bounds: the search and its explanation ask the same ones."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.drawing.geometry import angles_deg, nearest_to_equal, side_lengths, tilts
from priorlab.drawing.jamb_walls import Jambs, in_line_with_walls, meets_other_leaf, read_jambs
from priorlab.drawing.method import Method
from priorlab.drawing.outer_walls import extreme_corners
from priorlab.drawing.overlap import dark_share, overlap_with_kept
from priorlab.drawing.preprocessing import Sheet
from priorlab.drawing.symbol import Symbols, ink_beside, is_box, read_symbols

SURE_SUPPORT = 0.97
"""Share of wall ink beyond both jambs of a door without an arc."""

SURE_INK = 0.9
"""Share of ink along both sides of a door without an arc."""

CORNER_OFF = 2.0
"""A corner lies so many pixels beside what it stands for: the sides of a small leaf measure that much less equal."""

PAIR_INK = 2.5
"""The open side of a double door's leaf may hold so many times as much ink."""

SURE_EQUAL = 0.87
"""Shorter over longer of leaf and opening, of a leaf on its own."""

ALONE = 0.3
"""Share of ink along either side of a leaf on its own that it stays below."""

SURE_OPEN = 0.1
"""Share of ink that the open side of a door without an arc stays below."""

LONG_WALL = 4.0
"""What stands at the jambs of a door is so many times as long as the door is wide; furniture is not."""

SLACK_SHARE = 0.001
"""Ink counts as on a line of a symbol within this share of M, and at least within a pixel."""

FEWEST_FOR_A_MODE = 3
"""Doors that must agree on a size before others are dropped for theirs."""


@dataclass(frozen=True)
class Measure:
    """One number of every candidate, and the bounds that a door keeps.

    Parameters
    ----------
    name : what is measured
    values : (K,)
    at_least, at_most : bounds, one for all or (K,); None where there is none
    strict : the bounds themselves are outside
    """

    name: str
    values: NDArray[np.float64]
    at_least: float | NDArray[np.float64] | None = None
    at_most: float | NDArray[np.float64] | None = None
    strict: bool = False

    @property
    def passed(self) -> NDArray[np.bool_]:
        """(K,) True within the bounds."""
        within = np.ones(len(self.values), dtype=bool)
        if self.at_least is not None:
            within &= (self.values > self.at_least) if self.strict else (self.values >= self.at_least)
        if self.at_most is not None:
            within &= (self.values < self.at_most) if self.strict else (self.values <= self.at_most)
        return within


@dataclass(frozen=True, eq=False)
class Scene:
    """What candidates are held against, in working pixels.

    Parameters
    ----------
    sheet : the drawing made ready
    method : the bounds
    corners : (N, 2) x, y
    connected : (N, N) bool
    thorough : measure hopeless candidates too, for somebody who wants to see it
    """

    sheet: Sheet
    method: Method
    corners: NDArray[np.float64]
    connected: NDArray[np.bool_]
    thorough: bool = False

    @cached_property
    def widened(self) -> NDArray[np.bool_]:
        """All ink, a little wider: corners lie a little beside it."""
        side = 2 * max(1, round(SLACK_SHARE * self.sheet.long_side)) + 1
        return cv2.dilate(self.sheet.lines.astype(np.uint8), np.ones((side, side), np.uint8)).astype(bool)

    @property
    def longest(self) -> float:
        """Longest open side of a door."""
        return self.method.max_side_share * float(np.sqrt(self.sheet.lines.size))


@dataclass(frozen=True, eq=False)
class Shortlist:
    """Candidates that are still in, (K, 3) corners: the tip and the two ends of the open side."""

    scene: Scene
    triples: NDArray[np.integer]

    @property
    def triangles(self) -> NDArray[np.float64]:
        """(K, 3, 2) vertices in working pixels."""
        return self.scene.corners[self.triples]

    @cached_property
    def symbols(self) -> Symbols:
        """The triangles read as doors."""
        method = self.scene.method
        least = (0.0, 0.0) if self.scene.thorough else (method.min_leaf, method.min_arc)
        return read_symbols(self.scene.widened, self.triangles, *least)

    @cached_property
    def jambs(self) -> Jambs:
        """What stands at their jambs."""
        return read_jambs(self.scene.sheet.lines, self.scene.sheet.walls, self.symbols)

    @property
    def quality(self) -> NDArray[np.float64]:
        """How much of a door each candidate is, 1 at best: its symbol, and the wall (or other leaf) at the weaker jamb."""
        paired = meets_other_leaf(self.symbols, self.jambs, self.scene.method.min_support)
        support = np.where(paired, self.jambs.hinge_support, self.jambs.support)
        return self.symbols.quality * (0.5 + 0.5 * support)

    def __len__(self) -> int:
        return len(self.triples)

    def __getitem__(self, keep: NDArray[np.bool_] | NDArray[np.int64]) -> Shortlist:
        fewer = replace(self, triples=self.triples[keep])
        for seen in ("symbols", "jambs"):
            if seen in self.__dict__:
                fewer.__dict__[seen] = getattr(self, seen)[keep]
        return fewer


def connectivity(some: Shortlist) -> tuple[Measure, ...]:
    """Two sides of a door are connected, the third is open (algorithm 3.1); of a leaf on its own one is."""
    a, b, c = some.triples.T
    connected = some.scene.connected
    n_sides = connected[a, b].astype(float) + connected[b, c] + connected[c, a]
    return (Measure("connected sides", n_sides, 1 if some.scene.method.lone_leaves else 2, 2),)


def geometry(some: Shortlist) -> tuple[Measure, ...]:
    """Two sides are about equal (eq. 3.3-3.5), no angle is too large or too small, the open side fits a door."""
    method, sides = some.scene.method, side_lengths(some.triangles)
    angles, alike = angles_deg(sides), nearest_to_equal(sides, method.rounding)
    bounds = method.min_largest_angle - 1e-9, method.max_largest_angle
    return (
        Measure("open side, px", sides[:, 1], method.min_side, some.scene.longest),
        Measure("ratio of the two sides most alike", alike, method.isosceles_ratio, strict=True),
        Measure("largest angle, degrees", angles.max(axis=1), *bounds),
        Measure("smallest angle, degrees", angles.min(axis=1), max(method.min_angle, 1e-3)),
    )


def orientation(some: Shortlist) -> tuple[Measure, ...]:
    """The open side lies along an axis (eq. 3.15), or, in a wing at an angle, along the walls at its own jambs."""
    tilt = tilts(some.triangles[:, 1], some.triangles[:, 2])
    name = "tilt of the open side, degrees"
    if some.scene.method.wings:
        askew = np.flatnonzero(tilt > some.scene.method.max_tilt)
        tilt[askew[in_line_with_walls(some.scene.sheet.walls, some.triangles[askew, 1], some.triangles[askew, 2])]] = 0.0
        name = "tilt of the open side against the axes, or its walls, degrees"
    return (Measure(name, tilt, None, some.scene.method.max_tilt),)


def symbol(some: Shortlist) -> tuple[Measure, ...]:
    """There is ink where a leaf and its swing would be, the leaf fits the opening, and neither goes on beyond its tip."""
    method, seen = some.scene.method, some.symbols
    alone = seen.is_alone & method.lone_leaves
    slack = np.where(seen.has_arc, CORNER_OFF / np.maximum(seen.width, 1e-9), 0.0)
    least_equal = np.where(alone, SURE_EQUAL, method.min_equal - slack)
    measures = (
        Measure("ink along the leaf", seen.leaf, np.where(alone, np.maximum(SURE_INK, method.min_leaf), method.min_leaf)),
        Measure("ink along the arc or chord", seen.swing, np.where(alone, 0.0, method.min_arc)),
        Measure("ink along the chord of an arc", np.where(seen.has_arc, seen.chord, 0.0), None, method.max_chord),
        Measure("shorter over longer of leaf and open side", seen.equal, least_equal),
        Measure("angle of an arc, degrees", np.where(seen.has_arc, seen.opening_deg, 90.0), method.min_arc_angle),
        Measure("ink beyond the tip", seen.beyond, None, method.max_beyond),
    )
    boxed = np.zeros(len(some))
    worth = np.flatnonzero(~seen.has_arc & (passed(measures) | some.scene.thorough))
    boxed[worth] = is_box(some.scene.widened, seen[worth])
    beside = np.zeros(len(some))
    lone = np.flatnonzero(alone & (passed(measures) | some.scene.thorough))
    beside[lone] = ink_beside(some.scene.widened, seen[lone])
    return (
        *measures,
        Measure("lines that make it a box", boxed, None, 0),
        Measure("ink beside a leaf on its own", beside, None, ALONE),
    )


def open_side(some: Shortlist) -> tuple[Measure, ...]:
    """The side that people walk through is white; at the strike of a double door the other leaf's arc ends."""
    method, open_ink = some.scene.method, some.symbols.open_ink
    paired = meets_other_leaf(some.symbols, some.jambs, method.min_support) & (method.min_support > 0)
    return (
        Measure("ink on the open side", open_ink, None, np.where(paired, PAIR_INK * method.max_open_ink, method.max_open_ink)),
    )


def jamb_support(some: Shortlist) -> tuple[Measure, ...]:
    """Both jambs stand at walls, or the strike at another leaf's; a door without an arc must be surer of all it has.

    A door that meets no other leaf must be as equal as the symbol asks, even where it is small.
    """
    least, seen, jambs = some.scene.method.min_support, some.symbols, some.jambs
    paired = meets_other_leaf(seen, jambs, least)
    at_strike = np.where(paired, 1.0, jambs.strike_support)
    length = jambs.wall_length / np.maximum(seen.width, 1e-9)
    arc = seen.has_arc
    support = np.where(arc, least, np.maximum(least, SURE_SUPPORT))
    sides = np.minimum(seen.leaf, np.where(seen.is_alone, 1.0, seen.chord))
    equal = np.where(paired | ~arc, 1.0, seen.equal)
    return (
        Measure("shorter over longer of leaf and open side, without another leaf", equal, some.scene.method.min_equal),
        Measure("wall beyond the hinge", jambs.hinge_support, support),
        Measure("wall or leaf beyond the strike", at_strike, support),
        Measure("length of what stands at the jambs, in widths", length, np.where(paired, 0.0, LONG_WALL)),
        Measure("ink along leaf and chord, without an arc", sides, np.where(arc, 0.0, SURE_INK)),
        Measure("ink beside the open side, without an arc", seen.crossed, None, np.where(arc, np.inf, SURE_OPEN), strict=True),
    )


def dark(some: Shortlist) -> tuple[Measure, ...]:
    """Less than 40 % of the inside is dark (3.3.1, first check)."""
    shares = np.array([dark_share(some.scene.sheet.lines, triangle) for triangle in some.triangles])
    return (Measure("share of ink inside", shares, None, some.scene.method.max_dark, strict=True),)


def overlap(some: Shortlist) -> tuple[Measure, ...]:
    """No door covers another (3.3.1, second check): each is compared with those kept before it."""
    shared = overlap_with_kept(some.triangles, some.scene.method.max_overlap)
    return (Measure("area shared with a door kept before", shared, None, some.scene.method.max_overlap),)


def size_mode(some: Shortlist) -> tuple[Measure, ...]:
    """The open side is about as long as most; doors without an arc, easily mistaken, must agree more closely.

    The smaller leaf of a double door is as wide as it likes.
    """
    method, widths = some.scene.method, some.symbols.width
    factor = method.size_mode_factor
    mode = commonest(widths, some.quality, factor) if factor is not None else None
    if factor is None or mode is None:
        return (Measure("longer over shorter of open side and the commonest", np.ones(len(widths))),)
    ratio = np.maximum(widths, mode) / np.maximum(np.minimum(widths, mode), 1e-9)
    allowed = np.where(some.symbols.has_arc, factor, np.sqrt(factor))
    allowed = np.where(meets_other_leaf(some.symbols, some.jambs, method.min_support), np.inf, allowed)
    return (Measure("longer over shorter of open side and the commonest", ratio, None, allowed),)


def kind(some: Shortlist) -> tuple[Measure, ...]:
    """Where at least three doors have an arc, a closed triangle is furniture."""
    arcs, alone = some.symbols.has_arc, some.symbols.is_alone
    least = 1.0 if arcs.sum() >= FEWEST_FOR_A_MODE else 0.0
    return (Measure("has an arc, or nothing at all", (arcs | alone).astype(float), least),)


def outer_walls(some: Shortlist) -> tuple[Measure, ...]:
    """No vertex lies on an outer wall (3.3.1, third check): on a line through the extreme corners, eq. 3.11."""
    if not len(some):
        return (Measure("distance from an outer wall, px", np.empty(0)),)
    x_min, x_max, y_min, y_max = extreme_corners(some.scene.corners)
    x, y = some.triangles[..., 0], some.triangles[..., 1]
    away = np.minimum.reduce([np.abs(x - x_min), np.abs(x - x_max), np.abs(y - y_min), np.abs(y - y_max)]).min(axis=1)
    return (Measure("distance from an outer wall, px", away, some.scene.method.outer_tolerance, strict=True),)


def commonest(widths: NDArray[np.float64], quality: NDArray[np.float64], factor: float) -> float | None:
    """The width that most doors have within the root of a factor, the better ones counting more; None when too few agree."""
    if not len(widths):
        return None
    close = np.maximum(widths[:, None], widths[None, :]) <= np.sqrt(factor) * np.minimum(widths[:, None], widths[None, :])
    best = int((close @ quality).argmax())
    return float(widths[best]) if close[best].sum() >= FEWEST_FOR_A_MODE else None


ASK: Mapping[str, Callable[[Shortlist], tuple[Measure, ...]]] = {
    "connectivity": connectivity,
    "geometry": geometry,
    "orientation": orientation,
    "symbol": symbol,
    "open side": open_side,
    "jamb support": jamb_support,
    "dark share": dark,
    "overlap": overlap,
    "size mode": size_mode,
    "kind": kind,
    "outer walls": outer_walls,
}
"""The tests by name, in their order."""


ON_ITS_OWN = ("connectivity", "geometry", "orientation", "symbol")
"""Tests that decide about a candidate whatever the others are; they come before those that compare."""


def passed(measures: tuple[Measure, ...]) -> NDArray[np.bool_]:
    """(K,) True where every measure keeps its bounds."""
    return np.asarray(np.logical_and.reduce([measure.passed for measure in measures]))
