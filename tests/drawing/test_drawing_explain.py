"""One candidate, test by test: the explanation says what the search decided."""

import itertools

import numpy as np
import pytest

from priorlab.drawing.candidates import DOOR, TESTS, asked_tests
from priorlab.drawing.corners import detect_corners
from priorlab.drawing.doors import search_doors
from priorlab.drawing.explain import QUESTIONS, explain_candidate
from priorlab.drawing.extraction import extract_walls
from priorlab.drawing.method import ROBUST, THESIS
from priorlab.drawing.preprocessing import prepare


@pytest.fixture(scope="module", params=[THESIS, ROBUST], ids=["THESIS", "ROBUST"])
def search(request, room):
    method = request.param
    corners = np.vstack([detect_corners(room.drawing, method=method), room.jambs, [room.tip]])
    return search_doors(prepare(room.drawing, method), corners, method)


def test_explain_candidate_agrees_with_every_kind_of_verdict(search):
    for reason in np.unique(search.reasons):
        for row in np.flatnonzero(search.reasons == reason)[:6]:
            results = explain_candidate(search, int(row))
            failed = [result.test for result in results if result.asked and not result.passed]
            assert failed == ([] if reason == DOOR else [TESTS[reason]])
            assert [result.test for result in results] == list(asked_tests(search.method))


def test_explain_candidate_asks_nothing_after_the_rejection(search):
    row = int(np.flatnonzero(search.reasons == TESTS.index("geometry"))[0])
    results = explain_candidate(search, row)
    assert [result.asked for result in results] == [True, True] + [False] * (len(results) - 2)
    assert results[1].decisive.passed is False


def test_explain_candidate_readings_repeat_the_bounds(search):
    results = {result.test: result for result in explain_candidate(search, 0)}
    sides = results["connectivity"].readings[0]
    a, b, c = search.candidates[0]
    edges = {frozenset(edge) for edge in search.edges.tolist()}
    assert sides.value == sum(frozenset((int(p), int(q))) in edges for p, q in ((a, b), (b, c), (c, a)))
    ratio = next(reading for reading in results["geometry"].readings if "alike" in reading.name)
    points = search.corners[search.candidates[0]]
    lengths = [np.hypot(*(p - q)) for p, q in itertools.combinations(points, 2)]
    ratios = [min(p, q) / max(p, q) for p, q in itertools.combinations(lengths, 2)]
    whole = len({int(np.ceil(length)) for length in lengths}) < 3
    assert ratio.value == pytest.approx(1.0 if search.method.rounding and whole else max(ratios))
    assert ratio.at_least == search.method.isosceles_ratio


def test_explain_candidate_of_the_door_shows_its_pixels(room):
    found = extract_walls(room.drawing)
    row = int(np.flatnonzero(found.door_search.reasons == DOOR)[0])
    results = {result.test: result for result in explain_candidate(found, row)}
    assert all(result.passed and result.asked for result in results.values())
    ink = room.grey < 200
    for name in ("tip to first end", "tip to second end"):
        path = results["connectivity"].pixels[name].astype(int)
        assert ink[path[:, 1], path[:, 0]].all()  # a walk never leaves the ink
        assert np.abs(np.diff(path, axis=0)).max() == 1
        assert len(path) > 30
    inside = results["dark share"].pixels["inside"].astype(int)
    dark = results["dark share"].pixels["ink inside"]
    assert results["dark share"].readings[0].value == pytest.approx(len(dark) / len(inside))
    white = results["open side"].pixels["open side"].round().astype(int)
    assert not ink[white[:, 1], white[:, 0]].any()


def test_explain_candidate_takes_any_three_corners(search):
    n = len(search.corners)
    results = explain_candidate(search, (n - 1, n - 3, n - 2))  # the true door's own points
    assert results[0].test == "connectivity"
    far = explain_candidate(search, (0, 1, 2))
    assert len(far) == len(results)
    assert all(str(result).startswith(result.test) for result in far)


def test_explain_candidate_rejects_what_is_none(search):
    with pytest.raises(ValueError, match="candidate must lie between 0 and"):
        explain_candidate(search, len(search.candidates))
    with pytest.raises(ValueError, match="candidate must be three different corners"):
        explain_candidate(search, (1, 1, 2))


def test_every_test_has_a_question():
    assert tuple(QUESTIONS) == TESTS
