"""The graph search against the literal triple loop, and doors drawn by hand."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from priorlab.core.drawing import Door, Drawing
from priorlab.drawing.candidates import TESTS, literal_triples, wedges
from priorlab.drawing.corners import detect_corners
from priorlab.drawing.doors import detect_doors, search_doors
from priorlab.drawing.jambs import with_measured_jambs
from priorlab.drawing.method import ROBUST, THESIS
from priorlab.drawing.overlap import dark_share, shared_area
from priorlab.drawing.preprocessing import prepare


def _triples(connected: np.ndarray) -> set[frozenset[int]]:
    """The thesis's way: every three corners, of which exactly two pairs are connected."""
    found = set()
    for a, b, c in itertools.combinations(range(len(connected)), 3):
        if int(connected[a, b]) + int(connected[b, c]) + int(connected[c, a]) == 2:
            found.add(frozenset((a, b, c)))
    return found


@settings(max_examples=50, deadline=None)
@given(st.integers(0, 10_000), st.integers(0, 14), st.floats(0.05, 0.9))
def test_wedges_with_an_open_side_are_the_triples_of_two_connected_sides(seed, n, density):
    upper = np.triu(np.random.default_rng(seed).random((n, n)) < density, k=1)
    connected = upper | upper.T
    found = wedges(connected)
    open_ones = found[~connected[found[:, 1], found[:, 2]]]
    as_sets = [frozenset(map(int, wedge)) for wedge in open_ones]
    assert len(as_sets) == len(set(as_sets))
    assert set(as_sets) == _triples(connected)
    assert sorted(literal_triples(connected).tolist()) == sorted(open_ones.tolist())


@pytest.mark.parametrize("method", [ROBUST])
def test_detect_doors_finds_the_one_door(room, method):
    corners = detect_corners(room.drawing, method=method)
    doors = detect_doors(room.drawing, corners, method)
    assert len(doors) == 1
    assert np.allclose([doors[0].hinge, doors[0].strike], room.jambs, atol=4)  # within the wall, rows 190 to 197
    assert np.allclose(doors[0].tip, room.tip, atol=6)
    assert doors[0].width == pytest.approx(49, abs=0.5)  # columns 151 to 199 are white
    assert doors[0].kind == "arc"


def test_detect_doors_thesis_finds_the_door_from_its_three_corners(room):
    house = [(50, 50), (449, 349)]  # the outer walls run through these
    doors = detect_doors(room.drawing, [*house, *room.jambs, room.tip], THESIS)
    assert len(doors) == 1
    assert {doors[0].hinge, doors[0].strike, doors[0].tip} == {*room.jambs, room.tip}


def test_detect_doors_a_closed_triangle_is_none(room):
    grey = room.grey.copy()
    grey[190:198, 150:201] = 0  # wall instead of the opening
    assert detect_doors(Drawing(grey), detect_corners(Drawing(grey))) == ()


def test_search_doors_every_candidate_has_one_fate(room):
    corners = detect_corners(room.drawing)
    search = search_doors(prepare(room.drawing, ROBUST), corners, ROBUST)
    counts = list(search.funnel.values())
    assert counts == sorted(counts, reverse=True)
    assert counts[0] == len(search.candidates)
    assert counts[-1] == len(search.doors)
    assert sum(len(search.rejected_by(test)) for test in TESTS) + len(search.doors) == len(search.candidates)


def test_search_doors_rejects_an_unknown_test(room):
    search = search_doors(prepare(room.drawing, ROBUST), np.empty((0, 2)), ROBUST)
    with pytest.raises(ValueError, match="test must be one of"):
        search.rejected_by("colour")


def test_detect_doors_rejects_corners_of_another_shape(room):
    with pytest.raises(ValueError, match="corners must be"):
        detect_doors(room.drawing, np.zeros((4, 3)))


def test_dark_share_of_half_a_triangle():
    ink = np.zeros((100, 100), dtype=bool)
    ink[:, :50] = True
    assert dark_share(ink, [(10, 10), (90, 10), (50, 90)]) == pytest.approx(0.5, abs=0.03)


def test_shared_area_is_a_share_of_the_smaller():
    big, small = [(0, 0), (40, 0), (0, 40)], [(0, 0), (10, 0), (0, 10)]
    assert shared_area(big, small) == pytest.approx(1)
    assert shared_area([(0, 0), (10, 0), (0, 10)], [(5, 0), (15, 0), (5, 10)]) == pytest.approx(0.25, abs=0.01)


@pytest.mark.parametrize("swap", [False, True])
def test_with_measured_jambs_upright_opening(swap):
    walls = np.zeros((80, 30), dtype=bool)
    walls[:20, 10:16] = walls[60:, 10:16] = True  # white rows 20 to 59
    hinge, strike = ((16, 23), (17, 57)) if not swap else ((17, 57), (16, 23))
    measured = with_measured_jambs(Door(hinge, strike, (50, hinge[1])), walls)
    assert measured.width == 40
    assert abs(measured.hinge[1] - hinge[1]) < 5


def test_with_measured_jambs_keeps_a_door_without_walls():
    door = Door((10, 10), (30, 10), (10, 30))
    assert with_measured_jambs(door, np.zeros((40, 40), dtype=bool)) == door
