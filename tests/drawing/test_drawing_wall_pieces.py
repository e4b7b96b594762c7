"""Insides, windows, wings, what is no wall, and how far each piece is trusted, on drawings made by hand."""

import cv2
import numpy as np
import pytest

from priorlab.core.drawing import Drawing
from priorlab.drawing.extraction import extract_walls
from priorlab.drawing.joined import inside_of, with_heavy_ink, without_thin_outside
from priorlab.drawing.long_cells import long_cells
from priorlab.drawing.method import THESIS
from priorlab.drawing.pieces import wall_pieces
from priorlab.drawing.wall_choice import choose
from priorlab.drawing.wall_sizes import WallSizes
from priorlab.drawing.walls import detect_walls
from priorlab.drawing.weight import Hypothesis, of_own_hue, slenderness
from priorlab.drawing.windows import window_bridges, window_panes

SIZES = WallSizes(600, 14)


def _house(shape=(500, 600), inset=60, thick=10) -> np.ndarray:
    """Grey paper with filled outer walls."""
    grey = np.full(shape, 255, dtype=np.uint8)
    low, right, bottom = inset + thick - 1, shape[1] - inset, shape[0] - inset
    cv2.rectangle(grey, (inset, inset), (right, bottom), 0, -1)
    cv2.rectangle(grey, (low + 1, low + 1), (right - thick, bottom - thick), 255, -1)
    return grey


def _hollow(grey: np.ndarray, start: tuple[int, int], end: tuple[int, int]) -> None:
    cv2.rectangle(grey, start, end, 0, 1)


def _cells(ink: np.ndarray) -> np.ndarray:
    return np.logical_or.reduce([cells.labels > 0 for cells in long_cells(ink, SIZES)])


def test_long_cells_take_a_hollow_wall_and_no_square_cupboard():
    grey = np.full((400, 600), 255, dtype=np.uint8)
    _hollow(grey, (50, 50), (450, 60))
    _hollow(grey, (50, 100), (75, 112))
    inside = _cells(grey < 128)
    assert inside[51:60, 51:450].all()
    assert not inside[90:].any()


def test_long_cells_see_through_hatching():
    grey = np.full((400, 600), 255, dtype=np.uint8)
    for x in range(40, 460, 9):
        cv2.line(grey, (x, 62), (x + 12, 50), 0, 1)
    grey[40:50] = grey[63:] = 255
    _hollow(grey, (50, 50), (450, 62))
    grey[45:66, 451:] = grey[45:66, :50] = 255
    assert _cells(grey < 128)[51:62, 60:440].mean() > 0.6  # the rest is hatching


def test_long_cells_of_other_faces_are_left():
    grey = np.full((400, 600), 255, dtype=np.uint8)
    _hollow(grey, (50, 50), (450, 60))
    _hollow(grey, (50, 150), (450, 160))
    ink = grey < 128
    faces = ink.copy()
    faces[100:] = False
    walls = long_cells(ink, SIZES)[0].walls(faces)
    assert walls[55, 100:400].all()
    assert not walls[100:].any()


def test_of_own_hue_parts_a_shaft_from_its_wall_and_forgives_one_covered_face():
    walls, own, other = np.zeros((3, 160, 300), dtype=bool)
    walls[20:30, 10:290] = walls[30:150, 100:110] = True  # a wall, and the side of a shaft that its inside flows into
    own[[20, 29], 10:290] = True
    own[29, 101:109] = False
    other[30:150, [100, 109]] = True
    other[29, 200:280], own[29, 200:280] = True, False  # furniture drawn over its lower face
    kept = of_own_hue(walls, own, other, WallSizes(600, 14))
    assert kept[20:30, 10:95].all() and kept[20:30, 115:290].all()
    assert not kept[50:].any()


def test_window_panes_go_and_a_hollow_wall_stays():
    cells = np.zeros((60, 200), dtype=np.int32)
    cells[10:14, 20:80], cells[15:19, 20:80] = 1, 2  # two panes
    cells[10:19, 82:180] = 3  # the wall beside them
    panes = window_panes(cells, SIZES)
    assert panes[10:14, 20:80].all() and panes[15:19, 20:80].all()
    assert not panes[:, 82:].any()


def test_window_bridges_take_two_lines_and_no_lone_one():
    walls = np.zeros((120, 200), dtype=bool)
    walls[10:22, :60] = walls[10:22, 120:] = walls[80:92, :60] = walls[80:92, 120:] = True
    ink = walls.copy()
    ink[12, 60:120] = ink[19, 60:120] = True  # a window
    ink[86, 60:120] = True  # a threshold
    found = window_bridges(walls, ink, 100)
    assert found[12, 60:120].all() and found[19, 60:120].all()
    assert not found[60:].any()


def test_window_bridges_take_no_flight_of_stairs():
    walls = np.zeros((200, 200), dtype=bool)
    walls[:, 50:62] = walls[:, 120:132] = True
    ink = walls.copy()
    ink[40:160:9, 62:120] = True
    assert not window_bridges(walls, ink, 100).any()
    ink[67:160] = walls[67:160]  # four of them are as thick as walls
    ink[[40, 45], 62:120] = True
    ink[49:67] = walls[49:67]
    assert window_bridges(walls, ink, 100)[[40, 45], 62:120].all()


def test_without_thin_outside_keeps_a_partition_that_faces_an_opening():
    walls = _house() < 128
    walls[200:260, 60:70] = False  # an opening in the left wall
    walls[230:232, 300:530] = True  # a partition from the right wall, seen through it
    walls[200:210, 540:580] = walls[200:202, 541:] = True  # a terrace
    found = without_thin_outside(walls)
    assert found[230:232, 300:530].all()
    assert not found[:, 585:].any()


def test_with_heavy_ink_keeps_a_diagonal_wing_and_no_scale_bar():
    ink = np.zeros((400, 600), dtype=bool)
    ink[50:60, 50:300] = ink[50:300, 50:60] = True
    walls = ink.copy()
    wing = np.zeros(ink.shape, np.uint8)
    cv2.line(wing, (295, 55), (450, 200), 1, 10)
    ink |= wing.astype(bool)
    ink[350:360, 400:550] = True  # a scale bar
    found = with_heavy_ink(walls, ink)
    assert found[wing.astype(bool)].mean() > 0.9
    assert not found[340:].any()


def test_inside_of_a_ring():
    ring = np.zeros((9, 9), dtype=bool)
    ring[1:8, 1:8] = True
    ring[2:7, 2:7] = False
    ring[1, 4] = False  # a gap seen by one column
    inside = inside_of(ring)
    assert inside[4, 2] and not inside[4, 4] and not inside[0].any()


def test_without_thin_outside_drops_a_terrace_and_keeps_a_partition():
    walls = _house() < 128
    house = walls.copy()
    walls[70:430, 300:302] = True  # a partition
    walls[441:480, 200:202] = walls[478:480, 200:400] = True  # a terrace
    found = without_thin_outside(walls)
    assert found[house].all() and found[70:430, 300:302].all()
    assert not found[442:].any()


def test_slenderness_of_a_bar_and_of_a_block():
    bar, block = np.zeros((40, 90), dtype=bool), np.zeros((40, 90), dtype=bool)
    bar[5:10, 5:85], block[5:35, 5:45] = True, True
    assert slenderness(bar) == 1.0
    assert slenderness(block) == slenderness(block & False) == 0.0


def test_extract_walls_hollow_ring_and_filled_inner_walls_are_both_there():
    grey = np.full((700, 900), 255, dtype=np.uint8)
    for inset in (60, 72):
        cv2.rectangle(grey, (inset, inset), (899 - inset, 699 - inset), 0, 2)
    grey[74:626, 440:448] = 0
    grey[340:348, 74:440] = 0
    for x in (560, 660):
        cv2.rectangle(grey, (x, 300), (x + 60, 350), 0, 1)  # tables
    mask = extract_walls(Drawing(grey)).walls.mask
    assert mask[66, 100:800].mean() > 0.95 and mask[100:600, 66].mean() > 0.95
    assert mask[100:600, 444].mean() > 0.95 and mask[344, 100:430].mean() > 0.95
    assert not mask[290:360, 550:730].any()


def test_extract_walls_diagonal_wing_stays():
    grey = _house()
    wing = np.zeros_like(grey)
    cv2.line(wing, (300, 65), (430, 200), 1, 10)
    grey[wing > 0] = 0
    assert extract_walls(Drawing(grey)).walls.mask[wing > 0].mean() > 0.9


def test_extract_walls_cars_and_title_blocks_are_none():
    grey = np.full((600, 900), 255, dtype=np.uint8)
    grey[:, :700] = _house((600, 700))
    for y in (120, 260):
        cv2.rectangle(grey, (740, y), (840, y + 60), 0, 1)
        cv2.rectangle(grey, (765, y + 6), (815, y + 54), 0, 1)
    for y in range(400, 500, 20):
        cv2.rectangle(grey, (730, y), (880, y + 20), 0, 1)
    mask = extract_walls(Drawing(grey)).walls.mask
    assert mask[100:500, 636].mean() > 0.95
    assert not mask[:, 700:].any()


@pytest.mark.parametrize("thick", [2, 3])
def test_extract_walls_thin_single_lines_survive(thick):
    grey = np.full((500, 600), 255, dtype=np.uint8)
    cv2.rectangle(grey, (60, 60), (540, 440), 0, thick)
    cv2.line(grey, (300, 60), (300, 440), 0, thick)
    mask = extract_walls(Drawing(grey)).walls.mask
    assert mask[grey < 128].mean() > 0.9


def test_wall_pieces_trust_what_hypotheses_share():
    walls = np.zeros((120, 300), dtype=bool)
    walls[10:18, 10:290], walls[60:68, 100:140] = True, True
    sure, doubtful = walls.copy(), walls.copy()
    sure[50:] = False
    pieces = wall_pieces(walls, [Hypothesis("a", sure, 1.0), Hypothesis("b", doubtful, 0.2)], [1.0, 0.2])
    upper, lower = sorted(pieces, key=lambda piece: piece.box[1])
    assert upper.box == (10, 10, 280, 8) and upper.mask.all()
    assert upper.agreement == pytest.approx(1) and lower.agreement == pytest.approx(1 / 6)
    assert upper.confidence > lower.confidence > 0
    assert repr(upper).startswith("WallPiece(wall, 280 x 8 px at 10, 10, confidence ")


def test_wall_pieces_doubt_a_thickness_that_no_wall_has():
    walls = np.zeros((400, 400), dtype=bool)
    walls[10:30, 10:390] = walls[10:390, 10:30] = walls[10:390, 370:390] = True  # walls of 20 px
    walls[200:219, 30:370] = True  # one of 19 px, which is as thick
    walls[300:304, 30:370] = True  # the front of a cupboard
    pieces = wall_pieces(walls, [Hypothesis("all", walls, 1.0)], [1.0])
    wall, front = ([piece for piece in pieces if piece.box[1] == top and piece.box[2] > 300][0] for top in (200, 300))
    assert wall.commonness == pytest.approx(1) and front.commonness < 0.1
    assert front.confidence < 0.75 < wall.confidence


def test_wall_pieces_doubt_a_short_one():
    walls = np.zeros((100, 400), dtype=bool)
    walls[10:18, 10:390] = walls[60:68, 100:120] = True
    long, short = sorted(wall_pieces(walls, [Hypothesis("all", walls, 1.0)], [1.0]), key=lambda piece: piece.box[1])
    assert (long.length, short.length) == (1.0, pytest.approx(20 / (380 / 8)))
    assert short.confidence < long.confidence == pytest.approx(1)


def test_wall_pieces_window_is_as_thick_as_its_wall():
    walls = np.zeros((60, 400), dtype=bool)
    walls[20:32, 10:390] = True
    windows = np.zeros_like(walls)
    windows[20:32, 150:230] = True
    walls[22:30, 150:230] = False
    pieces = wall_pieces(walls, [Hypothesis("all", walls, 1.0)], [1.0], windows)
    assert [piece.kind for piece in pieces] == ["wall", "wall", "window"]
    assert pieces[2].box == (150, 20, 80, 12) and pieces[2].mask.sum() == 4 * 80
    assert pieces[2].commonness == pytest.approx(1)


def test_wall_pieces_split_at_a_corner():
    walls = np.zeros((100, 100), dtype=bool)
    walls[10:16, 10:90] = walls[10:90, 10:16] = True
    pieces = wall_pieces(walls, [Hypothesis("all", walls, 1.0)], [1.0])
    assert len(pieces) == 2
    assert sum(int(piece.mask.sum()) for piece in pieces) == walls.sum()
    assert wall_pieces(walls & False, [], []) == ()


def test_detect_walls_thesis_finds_none_without_doors():
    grey = np.full((300, 400), 255, dtype=np.uint8)
    for k, y in enumerate(range(40, 260, 30)):
        cv2.putText(grey, f"LINE {k} OF TEXT", (30, y), cv2.FONT_HERSHEY_SIMPLEX, 0.9, 0, 2)
    assert not detect_walls(Drawing(grey), (), THESIS).mask.any()


def test_choose_takes_nothing_where_strokes_are_as_short_as_letters():
    letters, frame = np.zeros((2, 60, 90), dtype=bool)
    letters[10:16, ::12] = True
    frame[10, 5:80] = True
    nothing = Hypothesis("lines", np.zeros((60, 90), dtype=bool), 0.0)
    assert not choose([nothing, Hypothesis("strokes", letters, 0.0, solid=True, weight=4.0)], [0.0, 0.0]).walls.any()
    assert choose([nothing, Hypothesis("strokes", frame, 0.0, solid=True, weight=4.0)], [0.0, 0.0]).walls.any()
