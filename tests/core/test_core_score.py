"""The score against a loop over pixels."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from priorlab.core.building import Truth
from priorlab.core.drawing import EMPTY, WALL, WINDOW, Walls
from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap
from priorlab.core.score import Score, score_map, score_mask, score_walls

SHAPE = (6, 8)
masks = st.integers(0, 2**48 - 1).map(lambda bits: np.array([bits >> i & 1 for i in range(48)], dtype=bool).reshape(SHAPE))


def count_by_hand(detected, walls, ignore):
    """tp, fp, fn, tn, pixel by pixel."""
    counts = {(True, True): 0, (True, False): 0, (False, True): 0, (False, False): 0}
    for is_detected, is_wall, is_ignored in zip(detected.flat, walls.flat, ignore.flat, strict=True):
        if not is_ignored:
            counts[bool(is_detected), bool(is_wall)] += 1
    return counts[True, True], counts[True, False], counts[False, True], counts[False, False]


@given(masks, masks, masks)
def test_score_mask_equals_a_loop(detected, walls, ignore):
    score = score_mask(detected, Truth(walls, ignore))
    assert (score.tp, score.fp, score.fn, score.tn) == count_by_hand(detected, walls, ignore)


@given(masks, masks, masks)
def test_score_walls_is_the_score_of_their_mask(detected, walls, ignore):
    truth = Truth(walls, ignore)
    assert score_walls(Walls(detected.astype(np.uint8)), truth) == score_mask(detected, truth)


@given(st.integers(0, 2**32 - 1), masks, masks, st.sampled_from([0.2, 0.5]), st.sampled_from([1, 2, 2.5]))
def test_score_map_equals_a_loop(seed, walls, ignore, threshold, cell_size):
    grid = Grid(SHAPE, cell_size)
    p = np.random.default_rng(seed).choice([0.05, 0.2, 0.5, 0.81], grid.shape)
    detected = np.zeros(SHAPE, dtype=bool)
    for row, col in np.ndindex(SHAPE):
        up, right = math.floor((SHAPE[0] - row - 0.5) / cell_size), math.floor((col + 0.5) / cell_size)
        here = p[grid.shape[0] - 1 - up, right]
        detected[row, col] = here <= threshold and here < 0.5  # not known is not wall
    score = score_map(GridMap(np.log(p / (1 - p)), grid), Truth(walls, ignore), threshold)
    assert (score.tp, score.fp, score.fn, score.tn) == count_by_hand(detected, walls, ignore)
    assert score.threshold == threshold


@given(*[st.integers(1, 99)] * 4, st.floats(0.3, 4))
def test_measures_follow_their_definitions(tp, fp, fn, tn, beta):
    score = Score(tp, fp, fn, tn, beta)
    precision, recall = tp / (tp + fp), tp / (tp + fn)
    assert score.precision == precision and score.recall == recall
    assert score.false_positive_rate == fp / (fp + tn)
    assert score.iou == tp / (tp + fp + fn)
    expected = (1 + beta**2) * precision * recall / (beta**2 * precision + recall)  # eq. 5.1
    assert score.f_beta == pytest.approx(expected, rel=1e-12)


def test_f2_weighs_recall_more_than_precision():
    assert Score(tp=50, fp=50, fn=0, tn=0).f_beta > Score(tp=50, fp=0, fn=50, tn=0).f_beta


def test_nothing_detected_has_no_precision_and_no_f2():
    score = Score(tp=0, fp=0, fn=7, tn=3)
    assert math.isnan(score.precision) and score.recall == 0 and score.f_beta == 0


def test_nothing_at_all_has_no_measure():
    score = Score(0, 0, 0, 0)
    assert math.isnan(score.recall) and math.isnan(score.false_positive_rate) and score.f_beta == 0


def test_a_cell_at_a_half_is_not_detected():
    truth = Truth(np.ones(SHAPE, bool), np.zeros(SHAPE, bool))
    assert score_map(GridMap(np.zeros(SHAPE), Grid(SHAPE)), truth).tp == 0


def test_score_says_when_shapes_differ():
    truth = Truth(np.ones(SHAPE, bool), np.zeros(SHAPE, bool))
    with pytest.raises(ValueError, match=r"map and truth must have one shape, got \(2, 2\) and \(6, 8\)"):
        score_mask(np.ones((2, 2)), truth)
    with pytest.raises(ValueError, match=r"map and truth must have one shape, got \(8, 6\) and \(6, 8\)"):
        score_map(GridMap(np.zeros((8, 6)), Grid((8, 6))), truth)


@pytest.mark.parametrize(("keywords", "sentence"), [({"beta": 0}, "beta must be"), ({"threshold": 1.0}, "got 1")])
def test_score_map_says_what_is_wrong(keywords, sentence):
    truth = Truth(np.ones(SHAPE, bool), np.zeros(SHAPE, bool))
    with pytest.raises(ValueError, match=sentence):
        score_map(GridMap(np.zeros(SHAPE), Grid(SHAPE)), truth, **keywords)


def test_score_walls_takes_windows_for_what_the_truth_took_them_for():
    found = Walls(np.array([[WALL, WALL, WINDOW, WINDOW, WALL, EMPTY]], dtype=np.uint8))
    is_wall = np.array([[1, 1, 1, 0, 0, 1]], dtype=bool)  # the third pixel is a window's ink, the last two of them are mistakes
    pane = np.array([[0, 0, 1, 0, 0, 0]], dtype=bool)
    truth = Truth(is_wall, np.zeros_like(is_wall), windows=pane)

    def counts(windows):
        score = score_walls(found, truth, windows=windows)
        return score.tp, score.fp, score.fn, score.tn

    assert counts("wall") == (3, 2, 1, 0)
    assert counts("empty") == (2, 1, 1, 2)  # of the truth's walls two and the last; found are three
    assert counts("ignore") == (2, 1, 1, 0)  # neither the truth's window nor what was called one
    unmarked = Truth(is_wall, np.zeros_like(is_wall))
    assert score_walls(found, unmarked, windows="empty").fn == 2  # nobody knows that the third is a window
    with pytest.raises(ValueError, match="windows must be"):
        score_walls(found, truth, windows="glass")
