"""Doors of every kind, drawn by hand into one wall of a house: found with their jambs, and nothing else is."""

import cv2
import numpy as np
import pytest

from priorlab.core.drawing import Door, Drawing
from priorlab.drawing.corners import detect_corners
from priorlab.drawing.doors import detect_doors

TOP, BOTTOM = 196, 204
"""Rows of the inner wall."""


def _house() -> np.ndarray:
    """A house of two rooms whose inner wall has no opening yet."""
    grey = np.full((420, 560), 255, dtype=np.uint8)
    grey[40:380, 40:520] = 0
    grey[50:TOP, 50:510] = grey[BOTTOM:370, 50:510] = 255
    return grey


def _opening(grey: np.ndarray, left: int, right: int) -> None:
    """White columns left to right - 1 in the inner wall."""
    grey[TOP:BOTTOM, left:right] = 255


def _line(grey: np.ndarray, a: tuple[float, float], b: tuple[float, float]) -> None:
    cv2.line(grey, tuple(round(v) for v in a), tuple(round(v) for v in b), 0, 1)


def _arc(grey: np.ndarray, left: int, right: int, panel: bool = False) -> None:
    """A leaf that hangs at the left and opens downwards, and its arc."""
    width = right - left
    cv2.ellipse(grey, (left, BOTTOM), (width, width), 0, 0, 90, 0, 1)
    if panel:
        cv2.rectangle(grey, (left, BOTTOM), (left + 3, BOTTOM + width), 0, 1)
    else:
        _line(grey, (left, BOTTOM), (left, BOTTOM + width))


def _arc_left(grey: np.ndarray, left: int, right: int) -> None:
    """The same, hung at the right."""
    width = right - left
    cv2.ellipse(grey, (right, BOTTOM), (width, width), 0, 90, 180, 0, 1)
    _line(grey, (right, BOTTOM), (right, BOTTOM + width))


def _drawn(kind: str) -> tuple[np.ndarray, list[tuple[int, int]]]:
    """A house with a door of this kind, and the columns of its jambs, one pair for each leaf."""
    grey = _house()
    if kind in ("arc", "arc_panel"):
        _opening(grey, 200, 246)
        _arc(grey, 200, 246, kind == "arc_panel")
        return grey, [(200, 246)]
    if kind in ("double", "double_unequal"):
        middle = 250 if kind == "double" else 234
        _opening(grey, 200, 300 if kind == "double" else 290)
        right = 300 if kind == "double" else 290
        _arc(grey, 200, middle)
        _arc_left(grey, middle, right)
        return grey, [(200, middle), (middle, right)]
    if kind.startswith("leaf"):
        angle = np.radians(float(kind.split("_")[1]))
        _opening(grey, 200, 246)
        _line(grey, (200, BOTTOM), (200 + 46 * np.cos(angle), BOTTOM + 46 * np.sin(angle)))
        return grey, [(200, 246)]
    _opening(grey, 200, 297)  # folding: two pairs of panels take 60 of 96 columns
    for k in range(2):
        _line(grey, (200 + 30 * k, 200), (215 + 30 * k, 220))
        _line(grey, (215 + 30 * k, 220), (230 + 30 * k, 200))
    return grey, [(200, 297)]


def _is_at(door: Door, jambs: tuple[int, int], tolerance: float = 5.0) -> bool:
    """Are the columns of the jambs right, and the rows within the wall?"""
    columns = sorted((door.hinge[0], door.strike[0]))
    rows = (door.hinge[1], door.strike[1])
    return max(abs(columns[0] - jambs[0]), abs(columns[1] - jambs[1])) <= tolerance and all(
        TOP - 6 <= y <= BOTTOM + 6 for y in rows
    )


@pytest.mark.parametrize(
    ("kind", "turned"),
    [
        (kind, turned)
        for kind in ("arc", "arc_panel", "double", "double_unequal", "leaf_90", "leaf_45")
        for turned in (False, True)
    ]
    + [("folding", False)],
)
def test_detect_doors_of_each_kind(kind, turned):
    grey, leaves = _drawn(kind)
    drawing = Drawing(np.ascontiguousarray(grey.T) if turned else grey)
    doors = detect_doors(drawing, detect_corners(drawing))
    if turned:
        doors = tuple(Door(d.hinge[::-1], d.strike[::-1], d.tip[::-1], d.kind) for d in doors)
    assert len(doors) == len(leaves)
    for jambs in leaves:
        assert any(_is_at(door, jambs) for door in doors)


@pytest.mark.parametrize(("kind", "named"), [("arc", "arc"), ("leaf_90", "leaf"), ("leaf_45", "leaf"), ("folding", "folding")])
def test_detect_doors_names_the_kind(kind, named):
    drawing = Drawing(_drawn(kind)[0])
    assert {door.kind for door in detect_doors(drawing, detect_corners(drawing))} == {named}


def test_detect_doors_a_bare_opening_is_none():
    grey = _house()
    _opening(grey, 200, 246)
    assert detect_doors(Drawing(grey), detect_corners(Drawing(grey))) == ()


def test_detect_doors_furniture_is_none():
    grey = _house()
    cv2.rectangle(grey, (100, 260), (160, 300), 0, 1)  # a table
    cv2.circle(grey, (300, 300), 30, 0, 1)  # a round one
    cv2.rectangle(grey, (400, 60), (460, 120), 0, 1)  # a shower, its diagonals and drain
    _line(grey, (400, 60), (460, 120))
    _line(grey, (460, 60), (400, 120))
    cv2.circle(grey, (430, 90), 5, 0, 1)
    for x in range(60, 180, 12):  # a flight of stairs
        _line(grey, (x, 60), (x, 110))
    _line(grey, (60, 110), (180, 110))
    assert detect_doors(Drawing(grey), detect_corners(Drawing(grey))) == ()


@pytest.mark.parametrize("degrees", [15.0, 30.0])
def test_detect_doors_in_a_wing_at_an_angle(degrees):
    grey, ((left, right),) = _drawn("arc")
    height, width = grey.shape
    matrix = cv2.getRotationMatrix2D(((width - 1) / 2, (height - 1) / 2), degrees, 1.0)
    turned = cv2.warpAffine(grey, matrix, (width, height), flags=cv2.INTER_CUBIC, borderValue=255)
    sheet = np.full((height, width + 300), 255, dtype=np.uint8)
    sheet[:, 300:] = turned
    cv2.rectangle(sheet, (20, 60), (240, 360), 0, 9)  # the straight house beside it: the sheet is not askew
    doors = detect_doors(Drawing(sheet), detect_corners(Drawing(sheet)))
    wanted = np.array([(left, BOTTOM), (right, BOTTOM)]) @ matrix[:, :2].T + matrix[:, 2] + (300, 0)
    assert len(doors) == 1
    jambs = doors[0].points[:2]
    assert min(np.abs(jambs - wanted).max(), np.abs(jambs[::-1] - wanted).max()) < 8
