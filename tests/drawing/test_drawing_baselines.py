"""The simple filters: peers of one kind, and each at its best ink threshold."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from priorlab.core.building import Truth
from priorlab.core.drawing import Drawing
from priorlab.drawing.baselines import BASELINES, adaptive_opening, best_darkness, dilation, opening, run_length


def _grey_walls() -> tuple[Drawing, Truth]:
    """Grey walls of 8 px (darkness 100) and a pale patch (darkness 40) that is none."""
    grey = np.full((200, 360), 255, dtype=np.uint8)
    walls = np.zeros(grey.shape, dtype=bool)
    walls[20:28, 20:240] = walls[172:180, 20:240] = walls[20:180, 20:28] = walls[20:180, 232:240] = True
    grey[walls] = 155
    grey[80:120, 80:200] = 215
    return Drawing(grey), Truth(walls, np.zeros_like(walls))


@pytest.mark.parametrize("name", BASELINES)
def test_best_darkness_finds_grey_walls(name):
    drawing, truth = _grey_walls()
    assert not BASELINES[name](drawing).any()  # at the usual threshold there is no ink
    darkness, score = best_darkness(BASELINES[name], drawing, truth)
    assert 40 <= darkness < 100
    assert score.precision == 1
    assert score.recall > 0.3  # 4 px of dilation leave 4 or 5 of 8


def test_best_darkness_is_the_best_of_a_loop():
    drawing, truth = _grey_walls()
    for darkness in (10, 50, 90):
        mask = opening(drawing, darkness=darkness)
        iou = (mask & truth.walls).sum() / (mask | truth.walls).sum()
        assert best_darkness(opening, drawing, truth, (10, 50, 90))[1].iou >= iou


def test_best_darkness_without_thresholds():
    drawing, truth = _grey_walls()
    with pytest.raises(ValueError, match="darknesses must hold at least one threshold, got none"):
        best_darkness(opening, drawing, truth, ())


def _covered_by_squares(ink: np.ndarray, side: int) -> np.ndarray:
    """Opening by hand: every square of ink, painted."""
    found = np.zeros_like(ink)
    for y in range(ink.shape[0] - side + 1):
        for x in range(ink.shape[1] - side + 1):
            if ink[y : y + side, x : x + side].all():
                found[y : y + side, x : x + side] = True
    return found


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 10_000), st.integers(2, 5))
def test_opening_paints_every_square_of_ink_for_even_sides_too(seed, side):
    rng = np.random.default_rng(seed)
    ink = rng.random((14, 17)) < 0.85
    ink[:2] = ink[:, :2] = False
    ink[5:9, 4] = False
    drawing = Drawing(np.where(ink, 0, 255).astype(np.uint8))
    if ink.mean() < 0.5:  # else the ink would be the paper
        return
    light = np.full((40, 40), 255, dtype=np.uint8)  # on a sheet with more paper than ink
    light[5:19, 5:22] = drawing.grey
    found = opening(Drawing(light), side)
    wanted = np.zeros((40, 40), dtype=bool)
    wanted[5:19, 5:22] = _covered_by_squares(ink, side)
    assert np.array_equal(found, wanted)


@pytest.mark.parametrize("side", [2, 4])
def test_dilation_takes_side_minus_one_from_every_wall(side):
    grey = np.full((60, 80), 255, dtype=np.uint8)
    grey[20:32, 10:70] = 0
    found = dilation(Drawing(grey), side)
    rows, cols = np.nonzero(found)
    assert found.sum() == (12 - side + 1) * (60 - side + 1)
    assert rows.min() >= 20 and rows.max() <= 31 and cols.min() >= 10 and cols.max() <= 69


def test_adaptive_opening_drops_short_pieces_and_thin_lines():
    grey = np.full((300, 300), 255, dtype=np.uint8)
    grey[100:108, 20:280] = 0
    grey[200, 20:280] = 0  # thin
    grey[40:46, 40:46] = 0  # short
    found = adaptive_opening(Drawing(grey))
    assert found[100:108, 20:280].all()
    assert found.sum() == 8 * 260


def test_run_length_keeps_long_thick_runs():
    grey = np.full((200, 200), 255, dtype=np.uint8)
    grey[50:56, 10:190] = 0
    grey[100:104, 10:14] = 0
    assert run_length(Drawing(grey)).sum() == 6 * 180
