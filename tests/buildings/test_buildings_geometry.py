"""Pieces of wall, openings and leaves against positions worked out by hand."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from priorlab.buildings.geometry import leaves_of, opening_in, pieces_of, turned
from priorlab.buildings.layout import chairs_of, place
from priorlab.buildings.parts import DoorPart, Furniture, Wall, WallStyle, WindowPart

STYLE = WallStyle(thickness=0.2)


def area(polygon):
    x, y = np.asarray(polygon).T
    return abs(float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))) / 2


@pytest.mark.parametrize("order", [1, -1])
def test_pieces_of_outline_lie_inside_it(order):
    outline = ((0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 3.0))[::order]
    pieces = pieces_of(Wall("w", outline=outline), STYLE, 0.01)
    assert len(pieces) == 4
    assert sum(area(piece.outline) for piece in pieces) == pytest.approx(4 * 3 - 3.6 * 2.6)
    corners = np.concatenate([piece.outline for piece in pieces])
    assert corners.min(axis=0).tolist() == [0, 0] and corners.max(axis=0).tolist() == [4, 3]


def test_pieces_of_path_are_mitred_at_a_right_angle():
    pieces = pieces_of(Wall("w", path=((0.0, 0.0), (2.0, 0.0), (2.0, 1.0))), STYLE, 0.01)
    # 2 m and 1 m of wall, 0.2 m thick, that share the corner's square: its outer half and inner half are cut by the mitre
    assert sum(area(piece.outline) for piece in pieces) == pytest.approx(0.2 * (2 + 1))
    assert np.allclose(pieces[0].outline[[1, 2]], [[2.1, -0.1], [1.9, 0.1]])


def test_pieces_of_single_line_are_as_thick_as_the_line():
    (piece,) = pieces_of(Wall("w", path=((0.0, 0.0), (1.0, 0.0))), WallStyle(look="single", line=2.0), 0.05)
    assert piece.thickness == pytest.approx(0.1)


def test_opening_in_snaps_to_the_centre_line():
    pieces = pieces_of(Wall("w", path=((0.0, 0.0), (4.0, 0.0))), STYLE, 0.01)
    opening = opening_in(pieces, WindowPart(at=(1.5, 0.08), width=1.0), "windows 1")
    assert np.allclose(sorted(opening.outline.tolist()), [[1, -0.1], [1, 0.1], [2, -0.1], [2, 0.1]])


@pytest.mark.parametrize(
    ("hinge", "opens", "points"),
    [
        ("west", "north", [(1.6, 0.1), (2.4, 0.1), (1.6, 0.9)]),
        ("east", "north", [(2.4, 0.1), (1.6, 0.1), (2.4, 0.9)]),
        ("west", "south", [(1.6, -0.1), (2.4, -0.1), (1.6, -0.9)]),
        ("east", "south", [(2.4, -0.1), (1.6, -0.1), (2.4, -0.9)]),
    ],
)
@pytest.mark.parametrize("path", [((0.0, 0.0), (4.0, 0.0)), ((4.0, 0.0), (0.0, 0.0))])
def test_leaves_of_hinge_and_swing_by_compass(hinge, opens, points, path):
    door = DoorPart(at=(2.0, 0.0), width=0.8, hinge=hinge, opens=opens)
    opening = opening_in(pieces_of(Wall("w", path=path), STYLE, 0.01), door, "doors 1")
    (leaf,) = leaves_of(door, opening)
    assert np.allclose([leaf.hinge, leaf.strike, leaf.tip(90)], points)
    assert np.allclose(leaf.tip(0), leaf.strike)


def test_leaves_of_unequal_double_door_meet():
    door = DoorPart(at=(2.0, 0.0), width=1.2, hinge="west", opens="north", kind="double", share=0.75)
    opening = opening_in(pieces_of(Wall("w", path=((0.0, 0.0), (4.0, 0.0))), STYLE, 0.01), door, "doors 1")
    wide, narrow = leaves_of(door, opening)
    assert np.allclose([wide.strike, narrow.strike], [(2.3, 0.1), (2.3, 0.1)])
    assert np.allclose([wide.tip(90), narrow.tip(90)], [(1.4, 1.0), (2.6, 0.4)])


@given(st.floats(0, 360), st.floats(-5, 5), st.floats(-5, 5))
def test_turned_keeps_lengths_and_turns_back(degrees, x, y):
    there = turned(np.array([x, y]), degrees)
    assert np.hypot(*there) == pytest.approx(np.hypot(x, y))
    assert np.allclose(turned(there, -degrees), [x, y])


@pytest.mark.parametrize(("back", "middle"), [("north", (2, 0)), ("south", (2, 2)), ("east", (1, 1)), ("west", (3, 1))])
def test_place_against_a_wall_puts_the_middle_half_a_depth_before_it(back, middle):
    bed = place(Furniture("bed", against=(2.0, 1.0), back=back, size=(1.6, 2.0)))
    assert np.allclose(bed.middle, middle)
    assert np.allclose(bed.at(np.array([0.0, 1.0])), (2.0, 1.0))  # the middle of its back


@pytest.mark.parametrize("n_chairs", [1, 2, 3, 4, 6, 8])
def test_chairs_of_table_are_as_many_as_said_and_stand_apart(n_chairs):
    chairs = chairs_of(place(Furniture("table", at=(0.0, 0.0), size=(2.4, 0.9), chairs=n_chairs)))
    middles = np.array([chair.middle for chair in chairs])
    assert len(chairs) == n_chairs
    apart = np.linalg.norm(middles[:, None] - middles, axis=2) + 9 * np.eye(n_chairs)
    assert apart.min() > 0.5
