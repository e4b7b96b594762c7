"""Hatched walls: drawn stroke by stroke, so that every pixel of their bodies is known."""

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from priorlab.drawing.cell_shapes import across_strokes, cell_shapes
from priorlab.drawing.faces import thin_cells
from priorlab.drawing.filled_walls import with_filled
from priorlab.drawing.hatch_families import hatch_families
from priorlab.drawing.hatching import hatched_walls
from priorlab.drawing.network import of_network
from priorlab.drawing.wall_choice import choose
from priorlab.drawing.wall_sizes import WallSizes
from priorlab.drawing.weight import HATCHED, Hypothesis

SIZES = WallSizes(300, 24.0)


def _room(thickness=14, degrees=45.0, spacing=6.0, line=2, pen=1.0, shape=(260, 300)):
    """Darkness of a room with four hatched walls and a partition with an opening, and the bodies of those walls."""
    body = np.zeros(shape, np.uint8)
    cv2.rectangle(body, (30, 30), (shape[1] - 31, shape[0] - 31), 1, -1)
    cv2.rectangle(body, (30 + thickness, 30 + thickness), (shape[1] - 31 - thickness, shape[0] - 31 - thickness), 0, -1)
    cv2.rectangle(body, (120, 30), (119 + thickness, 110), 1, -1)
    cv2.rectangle(body, (120, 160), (119 + thickness, shape[0] - 31), 1, -1)
    inside = cv2.erode(body, np.ones((2 * line + 1, 2 * line + 1), np.uint8))
    return np.where(_strokes(shape, degrees, spacing, pen) & (inside > 0) | (body > inside), 255, 0).astype(np.uint8), body > 0


def _strokes(shape, degrees, spacing, pen):
    """Parallel strokes all over a sheet."""
    y, x = np.mgrid[: shape[0], : shape[1]]
    across = x * np.sin(np.radians(degrees)) - y * np.cos(np.radians(degrees))
    return across % spacing < pen


def _found(darkness, sizes=SIZES):
    """Hatched walls of a sheet of this darkness."""
    ink = darkness > 110
    return hatched_walls(ink, thin_cells(ink, sizes), sizes)[0]


def _agrees(found, body):
    """Share of the body found, and share of what was found that is body."""
    return (found & body).sum() / body.sum(), (found & body).sum() / max(found.sum(), 1)


@pytest.mark.parametrize("degrees", [45.0, 135.0, 60.0, 120.0, 30.0])
@pytest.mark.parametrize(("thickness", "spacing"), [(14, 6.0), (20, 9.0), (9, 5.0)])
def test_hatched_walls_any_angle_whole_to_the_faces(degrees, thickness, spacing):
    darkness, body = _room(thickness, degrees, spacing, pen=1.4)
    recall, precision = _agrees(_found(darkness), body)
    assert recall > 0.97
    assert precision > 0.999


def test_hatched_walls_four_pixels_apart():
    darkness, body = _room(10, 45.0, 4.0, line=1)
    recall, precision = _agrees(_found(darkness), body)
    assert recall > 0.95
    assert precision > 0.999


def test_hatched_walls_thin_partition_too_flat_to_slant():
    darkness, body = _room(16, 45.0, 6.0, pen=1.4)
    thin = np.zeros_like(body)
    thin[180:187, 134:254] = True
    darkness[thin] = 0
    darkness[[180, 181, 185, 186], 134:254] = 255
    darkness[thin & _strokes(body.shape, 45.0, 6.0, 1.4)] = 255
    found = _found(darkness)
    assert (found & thin).sum() > 0.85 * thin.sum()


@pytest.mark.parametrize("harm", ["blur", "noise", "jpeg"])
def test_hatched_walls_through_harm(harm):
    darkness, body = _room(16, 45.0, 8.0, pen=2.0)
    rng = np.random.default_rng(3)
    if harm == "blur":
        darkness = cv2.GaussianBlur(darkness, (0, 0), 0.9)
    elif harm == "noise":
        darkness = np.clip(darkness + rng.normal(0, 25, darkness.shape), 0, 255).astype(np.uint8)
    else:
        darkness = cv2.imdecode(cv2.imencode(".jpg", darkness, [cv2.IMWRITE_JPEG_QUALITY, 60])[1], 0)
    recall, precision = _agrees(_found(darkness), body)
    assert recall > 0.9
    assert precision > 0.99


def test_hatched_walls_not_the_closet_beside_them():
    darkness, body = _room()
    cv2.rectangle(darkness, (60, 44), (80, 110), 255, 1)  # on the face of the upper wall, as wide as a wall
    found = _found(darkness)
    assert not found[50:105, 63:78].any()
    assert (found & body).sum() > 0.97 * body.sum()


def test_hatched_walls_nothing_upright():
    darkness = np.zeros((200, 300), np.uint8)
    for y in range(20, 180, 9):  # treads
        cv2.rectangle(darkness, (20, y), (60, y + 9), 255, 1)
    for x in range(90, 280, 18):  # panes, and cupboards with one diagonal
        cv2.rectangle(darkness, (x, 40), (x + 12, 58), 255, 1)
        cv2.line(darkness, (x, 90), (x + 12, 102), 255, 1)
        cv2.rectangle(darkness, (x, 90), (x + 12, 102), 255, 1)
    assert not _found(darkness).any()
    assert not _found(np.zeros_like(darkness)).any()


def test_hatch_families_two_hatchings_with_their_spacings():
    darkness, body = _room(16, 45.0, 8.0, pen=1.4)
    darkness[:, 120:136][body[:, 120:136]] = 0
    inner = np.zeros_like(body)
    inner[60:200, 120:136] = True
    rim = inner & ~cv2.erode(inner.astype(np.uint8), np.ones((3, 3), np.uint8)).astype(bool)
    darkness[rim | (inner & _strokes(body.shape, 120.0, 5.0, 1.4))] = 255
    ink = darkness > 110
    cells = thin_cells(ink, SIZES)
    pairs = np.vstack([across_strokes(cells, ink, 8, axis)[:, :2] for axis in (0, 1)])
    first, second = hatch_families(cell_shapes(cells), np.unique(pairs, axis=0), SIZES.thickness)
    assert abs(first.degrees - 45) <= 3
    assert abs(first.spacing - 8.0) < 0.4
    assert abs(second.degrees - 120) <= 4
    assert abs(second.spacing - 5.0) < 0.4


def test_cell_shapes_parallelogram_against_its_formulas():
    cells = np.zeros((30, 60), np.int32)
    for row in range(12):
        cells[5 + row, 10 + 2 * row : 17 + 2 * row] = 1
    shapes = cell_shapes(cells)
    assert shapes.area[1] == 12 * 7
    assert shapes.drift(1)[1] == pytest.approx(2.0)
    assert shapes.fullness[1] == pytest.approx(1.0, abs=0.05)
    assert shapes.breadth(0)[1] == pytest.approx(12.0)
    assert (shapes.x[1], shapes.y[1]) == (10 + 3 + 11, 5 + 5.5)


def test_cell_shapes_triangle_is_less_full():
    cells = np.tril(np.ones((40, 40), np.int32))
    assert cell_shapes(cells).fullness[1] == pytest.approx(np.sqrt(3) / 2, abs=0.03)


@given(sheet=arrays.arrays(np.int8, (7, 9), elements=st.integers(0, 3)), reach=st.integers(1, 4), axis=st.sampled_from([0, 1]))
@settings(max_examples=60, deadline=None)
def test_across_strokes_equals_a_walk_along_every_line(sheet, reach, axis):
    ink, wide = sheet == 0, sheet == 1
    cells = np.where(ink | wide, 0, cv2.connectedComponents((~ink & ~wide).astype(np.uint8), connectivity=4)[1]).astype(np.int32)
    walked = []
    for line, dark in zip(*((cells, ink) if axis == 1 else (cells.T, ink.T)), strict=True):
        for i in range(len(line)):
            stop = i + 1
            while stop < len(line) and dark[stop]:
                stop += 1
            gap = stop - i - 1
            if line[i] and 1 <= gap <= reach and stop < len(line) and line[stop] and line[stop] != line[i]:
                walked.append([line[i], line[stop], gap])
    assert across_strokes(cells, ink, reach, axis).tolist() == walked


def test_of_network_asks_for_ink_between_pieces():
    walls = np.zeros((200, 300), dtype=bool)
    walls[20:30, 20:280] = True
    walls[60:66, 100:106] = walls[60:66, 200:206] = True  # one of them hangs on a line
    ink = np.zeros_like(walls)
    ink[30:60, 203] = True
    kept = of_network(walls, (), SIZES, ink)
    assert not kept[60:66, 100:106].any()
    assert np.array_equal(kept[:, 150:], walls[:, 150:])


def test_with_filled_takes_no_leaf_and_no_stove():
    walls = np.zeros((160, 300), dtype=bool)
    walls[20:34, 20:280] = walls[126:140, 20:280] = True
    ink = np.zeros_like(walls)
    ink[34:126, 90:95] = True  # a partition
    ink[34:90, 150:155] = True  # a thick leaf
    ink[100:126, 200:230] = True  # a stove
    ink[34:126, 250:252] = True  # a line as thick as a face
    assert np.array_equal(with_filled(walls, 2, ink, (), SIZES) & ~walls, ink & (np.arange(300) < 100))


def test_choose_takes_hatching_that_makes_up_the_best():
    best, hatched = (np.zeros((50, 100), dtype=bool) for _ in range(2))
    best[10:40] = True
    hatched[10:30] = True
    both = (Hypothesis("lines", best, 1.0, weight=2.0), Hypothesis(HATCHED, hatched, 0.1))
    assert choose(both, (1.0, 0.1)).name == HATCHED
    assert choose(both[::-1], (0.1, 1.0)).name == HATCHED
    hatched[15:30] = False  # a cupboard
    assert choose(both, (1.0, 0.1)).name == "lines"
    assert choose(both, (1.0, 0.6)).name == HATCHED


def test_choose_takes_no_hatching_beside_which_the_doors_stand():
    best, hatched = (np.zeros((50, 100), dtype=bool) for _ in range(2))
    best[10:40] = True
    hatched[10:30] = True
    both = (Hypothesis("lines", best, 1.0, weight=2.0), Hypothesis(HATCHED, hatched, 0.2))
    assert choose(both, (1.0 * 0.8, 0.2 * 0.7)).name == HATCHED  # jambs stand on both alike: worth over quality
    assert choose(both, (1.0 * 0.8, 0.2 * 0.3)).name == "lines"
