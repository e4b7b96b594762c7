"""What is no drawing, or hardly one: a result that says so in a sentence, never an exception, never a map made up."""

import cv2
import numpy as np
import pytest

from priorlab.buildings.floor_plans import load_floor_plan
from priorlab.core.drawing import Door, Drawing
from priorlab.drawing.candidates import TESTS, first_corners, wedges
from priorlab.drawing.extraction import extract_walls, why_unfit
from priorlab.drawing.method import ROBUST, THESIS
from priorlab.drawing.photograph import continuous_share, is_photograph, paper_share
from priorlab.drawing.pieces import WallPiece
from priorlab.drawing.remarks import WHAT_FAILED, about_walls
from priorlab.drawing.walls import detect_walls

BOTH = pytest.mark.parametrize("method", [THESIS, ROBUST], ids=["THESIS", "ROBUST"])


def _photograph() -> np.ndarray:
    """Clouds of several sizes: tones as a camera sees them."""
    rng = np.random.default_rng(1)
    sky = np.zeros((400, 600), dtype=np.float32)
    for size in (4, 16, 64):
        grain = rng.normal(size=(400 // size, 600 // size)).astype(np.float32)
        sky += size * cv2.resize(grain, (600, 400), interpolation=cv2.INTER_CUBIC)
    return np.clip(120 + 0.8 * sky, 0, 255).astype(np.uint8)


def _page() -> np.ndarray:
    """A page of text and nothing else."""
    page, rng = np.full((900, 700), 255, dtype=np.uint8), np.random.default_rng(0)
    for line in range(60, 860, 24):
        words = "".join(rng.choice(list("abcdefgh ijklmno pqrstuv wxyz "), 55))
        cv2.putText(page, words, (40, line), cv2.FONT_HERSHEY_SIMPLEX, 0.55, 0, 1, cv2.LINE_AA)
    return page


@BOTH
def test_extract_walls_of_a_photograph_is_empty_and_says_so(method):
    found = extract_walls(Drawing(_photograph(), name="holiday"), method)
    assert not found.walls.mask.any() and not found.doors and not len(found.corners)
    assert found.lost_at == "ink"
    assert found.notes[0].startswith("holiday looks like a photograph")


@BOTH
@pytest.mark.parametrize("across", [True, False])
def test_extract_walls_of_a_grey_ramp_is_empty(method, across):
    ramp = np.tile(np.linspace(0, 255, 500).astype(np.uint8), (300, 1))
    found = extract_walls(Drawing(ramp if across else np.ascontiguousarray(ramp.T)), method)
    assert found.lost_at == "ink" and not found.walls.mask.any() and found.notes


def test_is_photograph_takes_drawings_for_drawings():
    for name in ("small_flat", "busy_flat", "office_wing"):
        grey = load_floor_plan(name).drawing.grey
        shade = np.linspace(0.75, 1.0, grey.shape[1])[None, :]  # a scan lit from one side
        grain = np.random.default_rng(2).normal(0, 9, grey.shape)
        scan = np.clip(cv2.GaussianBlur(grey, (0, 0), 0.8) * shade + grain, 0, 255).astype(np.uint8)
        assert not is_photograph(grey) and not is_photograph(255 - grey) and not is_photograph(scan)


def test_is_photograph_takes_filled_rooms_for_a_drawing():
    plan = np.full((300, 400), 255, dtype=np.uint8)
    for k, tone in enumerate((200, 170, 140, 110)):  # floors in flat tones
        cv2.rectangle(plan, (20 + 90 * k, 40), (100 + 90 * k, 250), tone, -1)
    assert not is_photograph(plan)
    assert continuous_share(plan) < 0.05


def test_paper_share_of_two_tones():
    image = np.full((10, 10), 250, dtype=np.uint8)
    image[:3] = 10
    assert paper_share(image) == pytest.approx(0.7)


@BOTH
@pytest.mark.parametrize("shape", [(5, 5), (3, 500), (500, 7)])
def test_extract_walls_too_few_pixels_are_named(method, shape):
    grey = np.random.default_rng(0).integers(0, 256, shape).astype(np.uint8)
    found = extract_walls(Drawing(grey, name="stamp"), method)
    assert found.lost_at == "ink" and not found.walls.mask.any()
    assert found.notes == (f"stamp is {shape[1]} x {shape[0]} pixels: too small to show a wall and a door.",)


def test_extract_walls_of_a_page_of_text_has_no_walls():
    found = extract_walls(Drawing(_page(), name="letter"))
    assert not found.walls.mask.any() and not found.doors
    assert found.lost_at is not None
    assert any("No wall was found" in note for note in found.notes)


def test_extract_walls_says_when_doors_are_too_small(room):
    small = cv2.resize(room.grey, None, fx=0.15, fy=0.15, interpolation=cv2.INTER_AREA)
    found = extract_walls(Drawing(small, name="stamp"))
    assert not found.doors
    assert any("too small to be told" in note for note in found.notes)


def test_extract_walls_wide_margins_change_nothing(room):
    wide = np.pad(room.grey, ((700, 500), (900, 300)), constant_values=255)
    near, far = extract_walls(room.drawing), extract_walls(Drawing(wide))
    inner = far.walls.mask[700:1100, 900:1400]
    assert far.walls.mask.sum() == inner.sum()
    assert (inner != near.walls.mask).mean() < 0.002
    assert len(far.doors) == 1
    assert np.allclose(far.doors[0].points, near.doors[0].points + (900, 700), atol=2)
    assert far.corners[:, 0].min() > 900


def test_extract_walls_upside_down_finds_the_same(room):
    found = extract_walls(Drawing(np.ascontiguousarray(room.grey[::-1, ::-1])))
    upright = extract_walls(room.drawing)
    assert (found.walls.mask[::-1, ::-1] != upright.walls.mask).mean() < 0.002
    assert len(found.doors) == 1


def test_why_unfit_is_silent_about_a_drawing(room):
    assert why_unfit(room.drawing) == ""


def test_extract_walls_of_stripes_finds_nothing_and_says_where_it_was_lost():
    y, x = np.mgrid[:100, :1500]
    found = extract_walls(Drawing(np.where((x + y) % 12 < 2, 0, 255).astype(np.uint8), name="stripes"))
    assert not found.walls.mask.any()
    assert found.notes[0].endswith("0 corners, there is no corner of long lines ('corners').")
    assert found.notes[1].startswith("No wall was found, lost at 'corners'")


def test_about_walls_doubts_that_a_building_has_so_much():
    assert about_walls("stripes", 0.26, [])[0].startswith("26 % of stripes was taken for wall, more than any building has")
    assert about_walls("stripes", 0.24, []) == []


def test_about_walls_doubts_what_is_unsure():
    mask = np.ones((4, 30), dtype=bool)
    unsure, sure = (WallPiece((0, 0, 30, 4), mask, confidence, 1.0, 1.0, 1.0) for confidence in (0.41, 0.85))
    assert about_walls("attic", 0.1, [unsure]) == [
        "No piece of wall in attic is sure, the surest is 0.41: look at the picture before you use them."
    ]
    assert about_walls("attic", 0.1, [unsure, sure]) == []


def test_every_stage_of_the_search_has_a_sentence():
    assert set(WHAT_FAILED) == {"corners", "wedges", *TESTS}


def test_extract_walls_says_why_there_is_no_door_in_words():
    box = np.full((300, 400), 255, dtype=np.uint8)
    cv2.rectangle(box, (40, 40), (360, 260), 0, 8)
    assert extract_walls(Drawing(box, name="box")).notes[0] == (
        "No door was found: of 0 candidates at 16 corners, no two lines meet in a corner as a leaf and its swing do ('wedges')."
    )


def test_extract_walls_of_graph_paper_says_that_not_all_corners_were_tried(monkeypatch):
    paper = np.full((300, 400), 255, dtype=np.uint8)
    paper[::10] = paper[:, ::10] = 0
    everything = extract_walls(Drawing(paper, name="graph paper"))
    assert everything.door_search.n_tried == len(everything.corners)
    monkeypatch.setattr("priorlab.drawing.doors.first_corners", lambda connected: first_corners(connected, 2_000))
    bounded = extract_walls(Drawing(paper, name="graph paper"))
    n_tried = bounded.door_search.n_tried
    assert 3 <= n_tried < len(bounded.corners) == len(everything.corners)
    assert bounded.door_search.funnel["wedges"] < 20_000 and bounded.door_search.edges.max() < n_tried
    assert any(f"among the {n_tried} strongest of {len(bounded.corners)} corners" in note for note in bounded.notes)


@pytest.mark.parametrize("most", [0, 1, 40, 500, 10**6])
def test_first_corners_are_as_many_as_the_bound_lets(most):
    graph = np.random.default_rng(4).random((40, 40)) < 0.3
    graph = np.triu(graph, 1) | np.triu(graph, 1).T
    n = first_corners(graph, most)
    assert len(wedges(graph[:n, :n])) <= most
    assert n == 40 or len(wedges(graph[: n + 1, : n + 1])) > most


@pytest.mark.parametrize(
    ("door", "words"),
    [
        ("x", "must be a Door, got str"),
        (Door((np.nan, 1), (20, 1), (1, 20)), "must lie on the drawing"),
        (Door((1e12, 1), (20, 1), (1, 20)), "must lie on the drawing"),
        (Door((5, 5), (5, 5), (5, 5)), "must have hinge and strike apart"),
        (Door((0, 0), (400, 0), (0, 400)), "must be at most half as wide"),
        (Door(("a", 1), (20, 1), (1, 20)), "must have three points of two numbers"),
    ],
)
@BOTH
def test_detect_walls_names_the_door_that_is_none(room, method, door, words):
    fine = Door((100, 100), (140, 100), (100, 140))
    with pytest.raises(ValueError, match=rf"doors\[1\] {words}"):
        detect_walls(room.drawing, [fine, door], method)


def test_detect_walls_asks_for_doors_in_a_row(room):
    with pytest.raises(ValueError, match="doors must be a Sequence, got NoneType"):
        detect_walls(room.drawing, None)
