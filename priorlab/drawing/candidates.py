"""Candidates for doors, and the tests that decide about them one after the other: every rejection keeps its reason."""

from __future__ import annotations

import bisect
import itertools
import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from priorlab.core.drawing import Door
from priorlab.drawing.method import Method
from priorlab.drawing.preprocessing import Sheet

TESTS = (
    "connectivity",
    "geometry",
    "orientation",
    "symbol",
    "open side",
    "jamb support",
    "dark share",
    "overlap",
    "size mode",
    "kind",
    "outer walls",
)
"""Names of the tests, in their order. A candidate's reason is the position of the test that it failed; -1 = a door."""

DOOR = -1
"""Reason of a candidate that is a door."""


def asked_tests(method: Method) -> tuple[str, ...]:
    """The tests of `TESTS` that can reject under a method, in their order.

    >>> from priorlab.drawing.method import THESIS
    >>> asked_tests(THESIS)
    ('connectivity', 'geometry', 'dark share', 'overlap', 'outer walls')
    """
    can_reject = {
        "connectivity": True,
        "geometry": True,
        "orientation": method.max_tilt < 45,
        "symbol": method.min_leaf > 0 or method.min_arc > 0,
        "open side": method.max_open_ink < 1,
        "jamb support": method.min_support > 0,
        "dark share": method.max_dark < 1,
        "overlap": method.max_overlap < 1,
        "size mode": method.size_mode_factor is not None,
        "kind": method.one_kind,
        "outer walls": method.drop_on_outer_walls,
    }
    return tuple(test for test in TESTS if can_reject[test])


@dataclass(frozen=True, eq=False)
class DoorSearch:
    """Everything the search for doors saw, in pixels of the drawing.

    Parameters
    ----------
    corners : (N, 2) x, y
    n_tried : how many of them, from the first, doors were looked for among: all, unless they are of too regular a pattern
    edges : (E, 2) indices of connected corners, each pair once
    candidates : (K, 3) indices of corners: the tip, and the two ends of the side that is open
    reasons : (K,) position in `TESTS` of the test that a candidate failed, `DOOR` for a door
    doors : the doors
    sheet : the drawing made ready, whose pixels may be finer
    method : how it was read
    """

    corners: NDArray[np.float64]
    n_tried: int
    edges: NDArray[np.int64]
    candidates: NDArray[np.int32]
    reasons: NDArray[np.int8]
    doors: tuple[Door, ...]
    sheet: Sheet
    method: Method

    @property
    def tests(self) -> tuple[str, ...]:
        """The tests that were asked, in their order."""
        return asked_tests(self.method)

    @property
    def n_triples(self) -> int:
        """How many unique combinations of three corners there are, nCr = n! / (r! (n - r)!) of 3.3.1 with r = 3."""
        return math.comb(len(self.corners), 3)

    @property
    def funnel(self) -> Mapping[str, int]:
        """How many candidates each test leaves, in order; first all wedges of two connected sides.

        Tests that are switched off under the method are left out.
        """
        left = {"wedges": len(self.candidates)}
        alive = np.ones(len(self.reasons), dtype=bool)
        for name in self.tests:
            alive &= self.reasons != TESTS.index(name)
            left[name] = int(alive.sum())
        return left

    def rejected_by(self, test: str) -> NDArray[np.float64]:
        """(R, 3, 2) triangles that failed one test, by its name.

        Raises
        ------
        ValueError
            When no test has this name.
        """
        if test not in TESTS:
            raise ValueError(f"test must be one of {', '.join(TESTS)}, got {test!r}")
        return self.corners[self.candidates[self.reasons == TESTS.index(test)]]


MOST_WEDGES = 10_000_000
"""More are not tried: they come from a regular pattern, and memory is finite."""


def wedges(connected: NDArray[np.bool_]) -> NDArray[np.int32]:
    """All wedges of a graph: a corner and two others connected to it.

    Parameters
    ----------
    connected : (N, N) symmetric bool

    Returns
    -------
    (K, 3) tip and two ends, ends in ascending order

    >>> graph = np.zeros((3, 3), dtype=bool)
    >>> graph[0, 1] = graph[1, 0] = graph[1, 2] = graph[2, 1] = True
    >>> wedges(graph).tolist()
    [[1, 0, 2]]
    """
    degree = connected.sum(axis=0)
    found = np.empty((_n_wedges(connected), 3), dtype=np.int32)
    begin = 0
    for tip in np.flatnonzero(degree > 1):
        ends = np.flatnonzero(connected[tip])
        first, second = np.triu_indices(ends.size, k=1)
        rows = found[begin : begin + first.size]
        rows[:, 0], rows[:, 1], rows[:, 2] = tip, ends[first], ends[second]
        begin += first.size
    return found


def first_corners(connected: NDArray[np.bool_], most: int = MOST_WEDGES) -> int:
    """How many of the corners, the strongest first, have at most so many wedges together.

    A drawing has one or two million; on graph paper each corner is connected with hundreds, and 1,600 have 200 million.

    >>> graph = ~np.eye(4, dtype=bool)                          # every two connected: 3 wedges of 3 corners, 12 of 4
    >>> first_corners(graph, 12), first_corners(graph, 11), first_corners(graph, 2)
    (4, 3, 2)
    """
    return bisect.bisect_right(range(1, len(connected) + 1), most, key=lambda n: _n_wedges(connected[:n, :n]))


def _n_wedges(connected: NDArray[np.bool_]) -> int:
    """How many pairs of sides meet at a corner."""
    degree = connected.sum(axis=0, dtype=np.int64)
    return int((degree * (degree - 1) // 2).sum())


def literal_triples(connected: NDArray[np.bool_]) -> NDArray[np.int64]:
    """The thesis's way to the same candidates: look at every three corners, keep those with exactly two connected pairs.

    It takes n (n - 1) (n - 2) / 6 steps; `wedges` takes as many as there are wedges.

    Parameters
    ----------
    connected : (N, N) symmetric bool

    Returns
    -------
    (K, 3) tip, where the two connected sides meet, and two ends in ascending order

    >>> graph = np.zeros((3, 3), dtype=bool)
    >>> graph[0, 1] = graph[1, 0] = graph[1, 2] = graph[2, 1] = True
    >>> literal_triples(graph).tolist()
    [[1, 0, 2]]
    """
    found = []
    for a, b, c in itertools.combinations(range(len(connected)), 3):
        ab, bc, ca = connected[a, b], connected[b, c], connected[c, a]
        if int(ab) + int(bc) + int(ca) == 2:
            found.append((a, b, c) if not bc else (b, a, c) if not ca else (c, a, b))
    return np.array(found, dtype=np.int64).reshape(-1, 3)
