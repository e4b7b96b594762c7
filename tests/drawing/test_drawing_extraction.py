"""A whole drawing: what comes out, in which pixels, and what is said when nothing does."""

import cv2
import numpy as np
import pytest

from priorlab.core.building import Truth
from priorlab.core.drawing import Drawing, Walls
from priorlab.core.score import score_mask, score_walls
from priorlab.drawing.baselines import BASELINES, dilation, opening
from priorlab.drawing.corners import detect_corners, harris_response
from priorlab.drawing.extraction import extract_walls
from priorlab.drawing.method import ROBUST, THESIS, Method
from priorlab.drawing.walls import detect_walls


def _square() -> np.ndarray:
    grey = np.full((60, 80), 255, dtype=np.uint8)
    grey[20:40, 30:60] = 0
    return grey


def test_detect_corners_a_square_has_four():
    corners = detect_corners(Drawing(_square()))
    nearest = [np.abs(corners - c).max(axis=1).min() for c in [(30, 20), (59, 20), (30, 39), (59, 39)]]
    assert len(corners) == 4
    assert max(nearest) <= 1.5


def test_harris_response_is_large_at_corners_negative_at_edges_zero_on_paper():
    response = harris_response(_square())
    assert response[20, 30] > 0 > response[20, 45]
    assert response[5, 5] == 0


def test_detect_corners_thesis_stops_at_its_budget(room):
    assert len(detect_corners(room.drawing, method=THESIS)) <= 200
    assert len(detect_corners(room.drawing, n_corners=10)) == 10


def test_detect_corners_rejects_no_budget(room):
    with pytest.raises(ValueError, match="n_corners must be at least 1, got 0"):
        detect_corners(room.drawing, n_corners=0)


def test_extract_walls_finds_the_walls_and_no_text(room):
    found = extract_walls(room.drawing)
    score = score_walls(found.walls, Truth(room.walls, np.zeros_like(room.walls)))
    assert score.precision > 0.97
    assert score.recall > 0.97
    assert not found.walls.mask[room.text].any()
    assert found.lost_at is None
    assert found.door_width == pytest.approx(50, abs=5)


def test_detect_walls_thesis_grows_walls_from_the_door(room):
    walls = detect_walls(room.drawing, [room.door], THESIS)
    score = score_walls(walls, Truth(room.walls, np.zeros_like(room.walls)))
    assert score.recall > 0.95
    assert not walls.mask[room.text].any()


def test_detect_walls_thesis_without_doors_finds_none(room):
    assert not detect_walls(room.drawing, (), THESIS).mask.any()


def test_steps_alone_equal_the_whole(room):
    whole = extract_walls(room.drawing)
    walls = detect_walls(room.drawing, whole.doors)
    assert isinstance(walls, Walls)
    assert np.array_equal(walls.mask, whole.walls.mask)


@pytest.mark.parametrize("method", [THESIS, ROBUST])
def test_extract_walls_inverted_drawing_gives_the_same(room, method):
    upright = extract_walls(room.drawing, method)
    inverted = extract_walls(Drawing(255 - room.grey), method)
    assert np.array_equal(upright.walls.mask, inverted.walls.mask)
    assert any("light on dark" in note for note in inverted.notes)


def test_extract_walls_dark_surroundings_are_not_paper():
    grey = np.zeros((300, 400), dtype=np.uint8)  # a map: all unknown is black
    grey[100:160, 100:200] = grey[100:160, 210:300] = 255
    found = extract_walls(Drawing(grey))
    assert not found.walls.mask[110:150, 110:190].any()


def test_extract_walls_hollow_walls_are_filled():
    grey = np.full((500, 600), 255, dtype=np.uint8)
    for inset in (50, 60):  # two lines, 10 px apart
        cv2.rectangle(grey, (inset, inset), (599 - inset, 499 - inset), 0, 2)
    cv2.rectangle(grey, (200, 200), (300, 260), 90, 1)  # a table
    truth = np.zeros(grey.shape, dtype=bool)
    truth[49:451, 49:551] = True
    truth[62:438, 62:538] = False
    score = score_mask(extract_walls(Drawing(grey)).walls.mask, Truth(truth, np.zeros_like(truth)))
    assert score.precision > 0.95
    assert score.recall > 0.95


def test_extract_walls_colour_tells_walls_from_furniture():
    colour = np.full((500, 600, 3), 255, dtype=np.uint8)
    for inset in (50, 60):
        cv2.rectangle(colour, (inset, inset), (599 - inset, 499 - inset), (0, 220, 0), 1)
    for x in range(120, 440, 80):
        cv2.rectangle(colour, (x, 200), (x + 60, 280), (255, 0, 255), 1)
    drawing = Drawing(cv2.cvtColor(colour, cv2.COLOR_RGB2GRAY), colour)
    found = extract_walls(drawing)
    assert found.walls.mask[55, 100:500].mean() > 0.95
    assert not found.walls.mask[190:290, 110:450].any()
    assert "hue 120" in found.wall_search.chosen


@pytest.mark.parametrize("method", [THESIS, ROBUST])
@pytest.mark.parametrize("shape", [(1, 1), (1, 40), (2, 2), (40, 60)])
@pytest.mark.parametrize("value", [0, 130, 255])
def test_extract_walls_one_colour_says_that_there_is_no_ink(method, shape, value):
    found = extract_walls(Drawing(np.full(shape, value, dtype=np.uint8), name="sheet"), method)
    assert not found.walls.mask.any()
    assert found.lost_at == "ink"
    assert found.notes[0].startswith("sheet shows no ink")
    assert found.door_width is None


@pytest.mark.parametrize("method", [THESIS, ROBUST])
def test_extract_walls_noise_is_no_exception(method):
    grey = np.random.default_rng(0).integers(0, 256, (120, 90)).astype(np.uint8)
    found = extract_walls(Drawing(grey), method)
    assert found.walls.shape == (120, 90)
    assert (found.lost_at is None) == bool(found.walls.mask.any())


def test_extract_walls_text_alone_is_lost_with_a_sentence():
    grey = np.full((400, 600), 255, dtype=np.uint8)
    cv2.putText(grey, "a", (100, 100), cv2.FONT_HERSHEY_SIMPLEX, 0.5, 0, 1)
    found = extract_walls(Drawing(grey))
    assert found.lost_at is not None
    assert any("No wall was found" in note for note in found.notes)


def test_extract_walls_small_drawing_answers_in_its_own_pixels(room):
    small = cv2.resize(room.grey, (250, 200), interpolation=cv2.INTER_AREA)
    found = extract_walls(Drawing(small))
    assert found.walls.shape == (200, 250)
    assert all(stage.shape == (200, 250) for stage in (*found.sweeps, found.outer))
    assert found.corners.max() < 250
    assert found.walls.mask[30, 100] or found.walls.mask[27, 100]  # the upper wall, rows 25 to 28
    assert any("small" in note for note in found.notes)


def test_extract_walls_tells_its_progress(room):
    steps: list[tuple[str, float]] = []
    extract_walls(room.drawing, progress=lambda step, done: steps.append((step, done)))
    shares = [done for _, done in steps]
    assert shares == sorted(shares) and shares[0] == 0 and shares[-1] == 1


def test_extract_walls_twice_is_the_same(room):
    first, second = extract_walls(room.drawing), extract_walls(room.drawing)
    assert np.array_equal(first.walls.labels, second.walls.labels)
    assert first.doors == second.doors


def test_method_rejects_unknown_sources():
    with pytest.raises(ValueError, match="sources must be 'doors' or 'both', got 'magic'"):
        Method(sources="magic")  # type: ignore[arg-type]


def test_baselines_dilation_of_paper_erodes_ink(room):
    eroded = dilation(room.drawing, 4)
    assert not eroded[room.grey > 127].any()
    assert eroded[room.text].mean() < 0.01
    assert 0.3 < eroded[room.walls].mean() < 0.7  # 8 px walls lose 3


def test_baselines_opening_gives_the_walls_back(room):
    found = opening(room.drawing, 4)
    assert not found[room.grey > 127].any()
    assert found[room.text].mean() < 0.02
    assert found[room.walls].all()


@pytest.mark.parametrize("name", BASELINES)
def test_baselines_find_filled_walls(room, name):
    found = BASELINES[name](room.drawing)
    assert found.shape == room.walls.shape
    assert found[room.walls].mean() > 0.3
    assert not BASELINES[name](Drawing(np.full((30, 30), 255, dtype=np.uint8))).any()
