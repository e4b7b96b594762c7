"""One candidate, test by test: what was measured, what was asked, and the pixels that were looked at."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from priorlab.drawing.candidates import DOOR, TESTS, DoorSearch
from priorlab.drawing.connectivity import snap_to_ink, walk
from priorlab.drawing.door_tests import ASK, Measure, Scene, Shortlist, passed
from priorlab.drawing.doors import walkable
from priorlab.drawing.extraction import Extraction
from priorlab.drawing.jamb_walls import jamb_points
from priorlab.drawing.outer_walls import extreme_corners
from priorlab.drawing.overlap import shared_area, triangle_pixels
from priorlab.drawing.symbol import arc_points, points_between

QUESTIONS: Mapping[str, str] = {
    "connectivity": "Are two sides drawn, and the third open?",
    "geometry": "Is the triangle isosceles and shaped like a door?",
    "orientation": "Does the open side lie along a wall?",
    "symbol": "Is there ink where a leaf and its swing would be?",
    "open side": "Is the open side white?",
    "jamb support": "Do walls stand at both jambs?",
    "dark share": "Is the inside mostly white?",
    "overlap": "Is no better door in the same place?",
    "size mode": "Is it about as wide as the other doors?",
    "kind": "Is it drawn like the other doors?",
    "outer walls": "Do its corners keep off the outer walls?",
}
"""What each test asks."""


@dataclass(frozen=True)
class Reading:
    """One number that a test measured, and the bounds that a door keeps; None where there is no bound."""

    name: str
    value: float
    at_least: float | None
    at_most: float | None
    passed: bool

    def __str__(self) -> str:
        bounds = [f"at least {self.at_least:.3g}" if self.at_least is not None else ""]
        bounds.append(f"at most {self.at_most:.3g}" if self.at_most is not None else "")
        asked = " and ".join(bound for bound in bounds if bound) or "anything"
        return f"{self.name}: {self.value:.3g} (asked: {asked}) {'yes' if self.passed else 'no'}"


@dataclass(frozen=True, eq=False)
class TestResult:
    """What one test said about one candidate.

    Parameters
    ----------
    test : its name, one of `TESTS`
    question : what it asks
    readings : what it measured; passed when all of them are
    passed : the verdict
    asked : False for a test after the one that rejected the candidate: the search did not go so far
    pixels : name -> (P, 2) points x, y in pixels of the drawing that the test looked at, for a picture
    """

    __test__ = False  # pytest: no test of ours

    test: str
    question: str
    readings: tuple[Reading, ...]
    passed: bool
    asked: bool
    pixels: Mapping[str, NDArray[np.float64]]

    @property
    def decisive(self) -> Reading:
        """The reading that failed, or the first one when none did."""
        return next((reading for reading in self.readings if not reading.passed), self.readings[0])

    def __str__(self) -> str:
        return f"{self.test}: {'passed' if self.passed else 'FAILED'}. {self.decisive}"


def explain_candidate(seen: DoorSearch | Extraction, candidate: int | Sequence[int]) -> tuple[TestResult, ...]:
    """Every test of a candidate, in order, those after the rejection too: a learner may want to know.

    The verdicts are the search's own: its tests are asked again, among the same competitors.

    Parameters
    ----------
    seen : a search for doors, or the extraction that holds it
    candidate : row of `DoorSearch.candidates`, or any three corners by their indices; which of them is the tip is found out

    Returns
    -------
    one result for each test that can reject under the method
    """
    search = seen.door_search if isinstance(seen, Extraction) else seen
    triple, row = _triple(search, candidate)
    scene = scene_of(search)
    results: list[TestResult] = []
    asked = True
    for test in search.tests:
        some, place = _competitors(search, scene, test, triple, row)
        readings = tuple(_reading(measure, place) for measure in ASK[test](some))
        fine = all(reading.passed for reading in readings)
        pixels = {name: search.sheet.points_to_input(points) for name, points in _pixels(test, some, place).items()}
        results.append(TestResult(test, QUESTIONS[test], readings, fine, asked, pixels))
        asked &= fine
    return tuple(results)


def scene_of(search: DoorSearch) -> Scene:
    """What the candidates of a search were held against."""
    connected = np.zeros((len(search.corners),) * 2, dtype=bool)
    connected[search.edges[:, 0], search.edges[:, 1]] = True
    return Scene(search.sheet, search.method, search.sheet.points_to_work(search.corners), connected | connected.T, True)


def _triple(search: DoorSearch, candidate: int | Sequence[int]) -> tuple[NDArray[np.int64], int | None]:
    """Tip and the two ends of the open side, and the row of the candidates that holds them."""
    if isinstance(candidate, int | np.integer):
        if not 0 <= candidate < len(search.candidates):
            raise ValueError(f"candidate must lie between 0 and {len(search.candidates) - 1}, got {candidate}")
        return search.candidates[candidate], int(candidate)
    corners = np.asarray(candidate, dtype=np.int64)
    if corners.shape != (3,) or len(set(corners.tolist())) < 3 or not ((corners >= 0) & (corners < len(search.corners))).all():
        raise ValueError(f"candidate must be three different corners of {len(search.corners)}, got {candidate}")
    rows = np.flatnonzero((np.sort(search.candidates, axis=1) == np.sort(corners)).all(axis=1))
    if rows.size:  # of a closed triangle's three wedges any will do
        return search.candidates[rows[0]], int(rows[0])
    return _by_longest_side(search.corners, corners), None


def _by_longest_side(points: NDArray[np.float64], corners: NDArray[np.int64]) -> NDArray[np.int64]:
    """Three corners that are no wedge: the one opposite the side that stands out is called the tip."""
    a, b, c = points[corners]
    sides = np.array([np.hypot(*(b - c)), np.hypot(*(c - a)), np.hypot(*(a - b))])
    tip = int(np.abs(sides - np.median(sides)).argmax())
    return np.array([corners[tip], *np.sort(np.delete(corners, tip))])


def _competitors(
    search: DoorSearch, scene: Scene, test: str, triple: NDArray[np.int64], row: int | None
) -> tuple[Shortlist, int]:
    """The candidates that this test compared, the one in question among them, and its place."""
    if test not in ("open side", "jamb support", "overlap", "size mode", "kind"):
        return Shortlist(scene, triple[None, :]), 0
    reached = (search.reasons == DOOR) | (search.reasons >= TESTS.index(test))
    rows = np.flatnonzero(reached)
    inside = row is not None and bool(reached[row])
    triples = search.candidates[rows] if inside else np.vstack([search.candidates[rows], triple])
    place = int(np.flatnonzero(rows == row)[0]) if inside else len(rows)
    some = Shortlist(scene, triples)
    if test in ("overlap", "size mode", "kind") and search.method.keep_best:
        order = np.argsort(-some.quality, kind="stable")
        some, place = some[order], int(np.flatnonzero(order == place)[0])
    return some, place


def _reading(measure: Measure, place: int) -> Reading:
    """One candidate's part of a measure."""
    bounds = [
        None if bound is None else float(np.broadcast_to(bound, len(measure.values))[place])
        for bound in (measure.at_least, measure.at_most)
    ]
    low, high = (None if bound is None or np.isinf(bound) else bound for bound in bounds)
    return Reading(measure.name, float(measure.values[place]), low, high, bool(measure.passed[place]))


def _pixels(test: str, some: Shortlist, place: int) -> dict[str, NDArray[np.float64]]:
    """What a test looked at, by name, in working pixels."""
    scene = some.scene
    tip, first, second = some.triangles[place]
    one = some[np.array([place])]
    if test == "connectivity":
        ink = walkable(scene.sheet, scene.method)
        ends = {"tip to first end": (tip, first), "tip to second end": (tip, second), "open side": (first, second)}
        return {name: _path(ink, *points, scene.method.reach) for name, points in ends.items()}
    if test == "geometry":
        return {"triangle": some.triangles[place]}
    if test in ("orientation", "size mode"):
        return {"open side": np.array([first, second])}
    symbols = one.symbols
    if test in ("symbol", "kind"):
        swing = (
            arc_points(symbols.hinge, symbols.tip, symbols.strike)
            if symbols.has_arc[0]
            else points_between(symbols.tip, symbols.strike)
        )
        return {"leaf": points_between(symbols.hinge, symbols.tip)[0], "swing": swing[0]}
    if test == "open side":
        return {"open side": points_between(symbols.hinge, symbols.strike, 0.12)[0]}
    if test == "jamb support":
        hinge, strike = symbols.hinge, symbols.strike
        return {
            "beyond the hinge": jamb_points(hinge, strike).reshape(-1, 2),
            "beyond the strike": jamb_points(strike, hinge).reshape(-1, 2),
        }
    if test == "dark share":
        return _inside(some, place)
    if test == "overlap":
        return _rivals(some, place)
    return _outer_lines(scene.corners, some.triangles[place])


def _path(ink: NDArray[np.bool_], start: NDArray[np.float64], goal: NDArray[np.float64], reach: int) -> NDArray[np.float64]:
    """Where the walk between two corners went; of the two directions the one that arrives, else the longer way."""
    (ax, ay), (bx, by) = snap_to_ink(ink, np.array([start, goal]), reach).tolist()
    ways = (walk(ink, (ax, ay), (bx, by), reach), walk(ink, (bx, by), (ax, ay), reach))
    best = max(ways, key=lambda way: (way.reached, len(way.path)))
    return np.array(best.path, dtype=np.float64)


def _inside(some: Shortlist, place: int) -> dict[str, NDArray[np.float64]]:
    """Pixels inside the triangle, and those of them that are ink."""
    ink = some.scene.sheet.lines
    image, left, top = triangle_pixels(some.triangles[place], erode=True)
    rows, cols = np.nonzero(image)
    rows, cols = rows + top, cols + left
    on_sheet = (rows >= 0) & (cols >= 0) & (rows < ink.shape[0]) & (cols < ink.shape[1])
    rows, cols = rows[on_sheet], cols[on_sheet]
    pixels = np.column_stack([cols, rows]).astype(np.float64)
    return {"inside": pixels, "ink inside": pixels[ink[rows, cols]]}


def _rivals(some: Shortlist, place: int) -> dict[str, NDArray[np.float64]]:
    """The triangle, and the kept one before it that shares most with it."""
    own = some.triangles[place]
    before = np.flatnonzero(passed(ASK["overlap"](some))[:place])
    shares = [shared_area(own, some.triangles[k]) for k in before]
    if not shares or max(shares) == 0:
        return {"triangle": own}
    return {"triangle": own, "door kept before": some.triangles[before[int(np.argmax(shares))]]}


def _outer_lines(corners: NDArray[np.float64], triangle: NDArray[np.float64]) -> dict[str, NDArray[np.float64]]:
    """The rectangle through the extreme corners (eq. 3.11), closed, and the triangle."""
    x_min, x_max, y_min, y_max = extreme_corners(corners)
    frame = np.array([(x_min, y_min), (x_max, y_min), (x_max, y_max), (x_min, y_max), (x_min, y_min)])
    return {"triangle": triangle, "outer walls": frame}
