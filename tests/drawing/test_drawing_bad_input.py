"""What is no drawing, or hardly one: a result that says so in a sentence, never an exception, never a map made up."""

import cv2
import numpy as np
import pytest

from priorlab.buildings.floor_plans import load_floor_plan
from priorlab.core.drawing import Drawing
from priorlab.drawing.extraction import extract_walls, why_unfit
from priorlab.drawing.method import ROBUST, THESIS
from priorlab.drawing.photograph import continuous_share, is_photograph, paper_share

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
