"""The thesis taken at its word, written down again here: every triple of corners, walked pixel by pixel, tested one by one.

Nothing of `priorlab.drawing` that decides is used by the oracle; the search over the graph must find the same triangles.
"""

import itertools
import math

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from priorlab.core.drawing import Drawing
from priorlab.drawing.candidates import DOOR, TESTS
from priorlab.drawing.connectivity import connect, walk, walk_all
from priorlab.drawing.doors import search_doors
from priorlab.drawing.method import THESIS
from priorlab.drawing.preprocessing import prepare

REACH = 2


def _snapped(ink, point):
    """The nearest ink within two pixels, rows before columns among equals; the point itself where there is none."""
    x, y = round(point[0]), round(point[1])
    best = None
    for dy in range(-REACH, REACH + 1):
        for dx in range(-REACH, REACH + 1):
            inside = 0 <= x + dx < ink.shape[1] and 0 <= y + dy < ink.shape[0]
            if inside and ink[y + dy, x + dx] and (best is None or dx * dx + dy * dy < best[0]):
                best = (dx * dx + dy * dy, (x + dx, y + dy))
    return best[1] if best else (x, y)


def _reaches(ink, start, goal):
    """Algorithm 3.1 with our reading of its gaps: forward neighbours, nearest dark one, arrival within two pixels, a cap."""
    (x, y), (gx, gy) = start, goal
    if not (0 <= x < ink.shape[1] and 0 <= y < ink.shape[0]) or not ink[y, x]:
        return False
    right, down = (gx > x) - (gx < x), (gy > y) - (gy < y)
    if right and down:
        steps = [(right, 0), (0, down), (right, down)]  # eq. 3.6-3.9
    elif right:
        steps = [(right, 0), (right, -1), (right, 1)]
    else:
        steps = [(0, down), (-1, down), (1, down)]
    for _ in range(abs(gx - x) + abs(gy - y) + 5):
        if abs(gx - x) <= REACH and abs(gy - y) <= REACH:
            return True
        dark = []
        for dx, dy in steps:
            if 0 <= x + dx < ink.shape[1] and 0 <= y + dy < ink.shape[0] and ink[y + dy, x + dx]:
                dark.append((math.sqrt((x + dx - gx) ** 2 + (y + dy - gy) ** 2), len(dark), (x + dx, y + dy)))  # eq. 3.10
        if not dark:
            return False
        x, y = min(dark)[2]
    return abs(gx - x) <= REACH and abs(gy - y) <= REACH


def _joined(ink, one, other):
    """Connected = a walk arrives in one of the two directions."""
    a, b = _snapped(ink, one), _snapped(ink, other)
    return _reaches(ink, a, b) or _reaches(ink, b, a)


def _is_isosceles(points):
    """Eq. 3.3-3.5 and the bounds of the largest angle, by the dot product."""
    a, b, c = (np.array(p, dtype=float) for p in points)
    sides = [math.dist(a, b), math.dist(b, c), math.dist(c, a)]
    alike = any(math.ceil(p) == math.ceil(q) or min(p, q) / max(p, q) > 0.9 for p, q in itertools.combinations(sides, 2))
    angles = []
    for p, q, r in ((a, b, c), (b, c, a), (c, a, b)):
        u, v = q - p, r - p
        angles.append(math.degrees(math.acos(np.clip(u @ v / math.hypot(*u) / math.hypot(*v), -1, 1))))
    return alike and 60 - 1e-6 <= max(angles) <= 100


def _tangle(seed, size=70):
    """Walls, leaves and arcs laid at random, and corners at their ends, their crossings and in the white."""
    rng = np.random.default_rng(seed)
    image, points = np.zeros((size, size), dtype=np.uint8), []
    for _ in range(5):
        x, y, length = (int(v) for v in rng.integers(8, 34, 3))
        kind = int(rng.integers(0, 3))
        if kind == 0:  # a leaf and its arc
            cv2.line(image, (x, y), (x, y + length), 1, 1)
            cv2.ellipse(image, (x, y), (length, length), 0, 0, 90, 1, 1)
            points += [(x, y), (x, y + length), (x + length, y)]
        elif kind == 1:  # a wedge of two straight sides
            cv2.line(image, (x, y), (x + length, y), 1, 1)
            cv2.line(image, (x, y), (x + length // 2, y + length), 1, 1)
            points += [(x, y), (x + length, y), (x + length // 2, y + length)]
        else:
            cv2.line(image, (x, y), (x + length, y), 1, int(rng.integers(1, 4)))
            points += [(x, y), (x + length, y)]
    points += [tuple(int(v) for v in p) for p in rng.integers(0, size, (3, 2))]
    jitter = rng.integers(-1, 2, (len(points), 2))
    return image > 0, np.unique(np.array(points) + jitter, axis=0).astype(float)


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 100_000))
def test_search_doors_equals_the_literal_triple_loop(seed):
    ink, corners = _tangle(seed)
    grey = np.where(ink, 0, 255).astype(np.uint8)
    drawing = Drawing(grey)
    method = THESIS
    search = search_doors(prepare(drawing, method), corners, method)

    longest = method.max_side_share * math.sqrt(grey.size)
    wanted = set()
    for triple in itertools.combinations(range(len(corners)), 3):
        pairs = list(itertools.combinations(triple, 2))
        apart = {pair: math.dist(corners[pair[0]], corners[pair[1]]) for pair in pairs}
        in_reach = {pair: method.min_side / 2 <= apart[pair] <= longest * math.sqrt(2) for pair in pairs}
        drawn = [pair for pair in pairs if in_reach[pair] and _joined(ink, corners[pair[0]], corners[pair[1]])]
        if len(drawn) != 2:
            continue
        (open_side,) = set(pairs) - set(drawn)
        if method.min_side <= apart[open_side] <= longest and _is_isosceles(corners[list(triple)]):
            wanted.add(frozenset(triple))

    early = [TESTS.index("connectivity"), TESTS.index("geometry")]
    through = search.candidates[~np.isin(search.reasons, early)]
    assert {frozenset(map(int, row)) for row in through} == wanted
    assert len(through) == len(wanted)
    for tip, one, other in through:  # the tip is where the two drawn sides meet
        assert _joined(ink, corners[tip], corners[one]) and _joined(ink, corners[tip], corners[other])
        assert not _joined(ink, corners[one], corners[other]) or math.dist(corners[one], corners[other]) > longest


def test_the_tangles_are_no_empty_promise():
    """The property above is worth something only when triangles pass."""
    passed = 0
    for seed in range(12):
        ink, corners = _tangle(seed)
        search = search_doors(prepare(Drawing(np.where(ink, 0, 255).astype(np.uint8)), THESIS), corners, THESIS)
        early = [TESTS.index("connectivity"), TESTS.index("geometry")]
        passed += int((~np.isin(search.reasons, early)).sum())
    assert passed > 20


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 100_000))
def test_walks_equal_the_one_written_down_here(seed):
    ink, corners = _tangle(seed, size=50)
    start = np.clip(corners.astype(int), 0, 49)
    pairs = [(tuple(map(int, a)), tuple(map(int, b))) for a, b in itertools.permutations(start[:8], 2)]
    here = [_reaches(ink, _snapped(ink, a), b) for a, b in pairs]
    assert [walk(ink, a, b, REACH).reached for a, b in pairs] == here
    assert walk_all(ink, [a for a, _ in pairs], [b for _, b in pairs], REACH).tolist() == here


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 100_000))
def test_connect_equals_the_walks_written_down_here(seed):
    ink, corners = _tangle(seed)
    found = connect(ink, corners)
    for i, j in itertools.combinations(range(len(corners)), 2):
        assert found[i, j] == (math.dist(corners[i], corners[j]) >= 1 and _joined(ink, corners[i], corners[j]))


@pytest.mark.parametrize("seed", range(3))
def test_search_doors_the_order_of_corners_does_not_matter_before_the_overlap(seed):
    ink, corners = _tangle(seed)
    sheet = prepare(Drawing(np.where(ink, 0, 255).astype(np.uint8)), THESIS)
    there = search_doors(sheet, corners, THESIS)
    back = search_doors(sheet, corners[::-1], THESIS)
    late = [TESTS.index("overlap"), TESTS.index("outer walls"), DOOR]

    def triangles(search):
        rows = search.corners[search.candidates[np.isin(search.reasons, late)]]
        return {frozenset(map(tuple, row.tolist())) for row in rows}

    assert triangles(there) == triangles(back)
