"""How well a confidence ranks: cases that can be counted on fingers, and all pairs in a double loop."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from priorlab.core.building import Truth
from priorlab.study.ranking import rank_pixels, ranking_auc, ranking_line


def test_ranking_auc_perfect_reversed_and_blind():
    assert ranking_auc([0.9, 0.8, 0.2, 0.1], [True, True, False, False]) == 1.0
    assert ranking_auc([0.9, 0.8, 0.2, 0.1], [False, False, True, True]) == 0.0
    assert ranking_auc([0.5, 0.5, 0.5], [True, False, True]) == 0.5


def test_ranking_auc_counts_pairs():
    # right: .7 and .4; wrong: .6 and .1; of four pairs only (.4, .6) is the wrong way round
    assert ranking_auc([0.7, 0.4, 0.6, 0.1], [True, True, False, False]) == 0.75


def test_ranking_auc_weighs_by_area():
    # the same pairs with areas 3, 1 and 1, 1: 8 pairs of pixels, one of them the wrong way round
    assert ranking_auc([0.7, 0.4, 0.6, 0.1], [True, True, False, False], weight=[3, 1, 1, 1]) == 0.875


def test_ranking_auc_of_half_right_pieces_ties_with_itself():
    assert ranking_auc([0.4], [0.5], weight=[10]) == 0.5


@pytest.mark.parametrize("right", [[True, True], [False, False]])
def test_ranking_auc_of_one_kind_is_undefined(right):
    assert math.isnan(ranking_auc([0.1, 0.9], right))


def test_ranking_auc_of_nothing_is_undefined():
    assert math.isnan(ranking_auc([], []))


pieces = st.lists(st.tuples(st.integers(0, 4), st.booleans(), st.integers(0, 5)), min_size=1, max_size=12)


@given(pieces)
def test_ranking_auc_equals_the_double_loop(rows):
    better, pairs = 0.0, 0
    for c, ok, w in rows:
        for d, also_ok, v in rows:
            if ok and not also_ok:
                pairs += w * v
                better += w * v * (1.0 if c > d else 0.5 if c == d else 0.0)
    found = ranking_auc(*np.array([(c, ok, w) for c, ok, w in rows], dtype=float).T)
    assert math.isnan(found) if pairs == 0 else found == pytest.approx(better / pairs)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (([0.5, 0.5], [True]), "of one length"),
        (([np.nan], [True]), "confidence must hold finite numbers"),
        (([0.5], [1.5]), "right must lie between 0 and 1"),
        (([0.5], [True], [-1.0]), "weight must be finite and at least 0"),
    ],
)
def test_ranking_auc_says_what_is_wrong(arguments, sentence):
    with pytest.raises(ValueError, match=sentence):
        ranking_auc(*arguments)


@pytest.fixture
def ranked():
    """Three pieces: 4 px at 0.9, one of them wrong; 2 px at 0.5, wrong; 3 px at 0.2, right, one of them not counted."""
    detected = np.array([[1, 1, 1, 1, 0], [1, 1, 0, 0, 0], [1, 1, 1, 0, 0]], dtype=bool)
    confidence = np.array([[0.9] * 5, [0.5] * 5, [0.2] * 5])
    walls = np.array([[1, 1, 1, 0, 1], [0, 0, 0, 0, 1], [1, 1, 1, 0, 0]], dtype=bool)
    ignore = np.zeros((3, 5), dtype=bool)
    ignore[2, 0] = True
    return rank_pixels(confidence, detected, Truth(walls, ignore))


def test_rank_pixels_counts_levels(ranked):
    assert ranked.confidence.tolist() == [0.2, 0.5, 0.9]
    assert ranked.right.tolist() == [2, 0, 3]
    assert ranked.wrong.tolist() == [0, 2, 1]


def test_ranked_auc_counts_pairs_of_pixels(ranked):
    # 5 right x 3 wrong: the three at .9 beat the two at .5 and tie with the one at .9; the two at .2 lose
    assert ranked.auc == pytest.approx((3 * 2 + 3 * 0.5) / 15)


def test_ranked_precision_between_levels(ranked):
    assert ranked.precision(0.6) == 0.75
    assert ranked.precision(0.4, 0.6) == 0.0
    assert math.isnan(ranked.precision(0.95))


def test_ranked_adds_up(ranked):
    both = ranked + ranked
    assert both.auc == pytest.approx(ranked.auc)
    assert both.right.sum() == 10


def test_rank_pixels_refuses_other_shapes():
    empty = np.zeros((2, 3), dtype=bool)
    with pytest.raises(ValueError, match="must have the truth's shape"):
        rank_pixels(np.zeros((3, 2)), empty, Truth(empty, empty))


def test_ranking_line_pools_and_is_empty_without_confidence(ranked):
    assert ranking_line([None, ranked, ranked], "ours") == (
        "Confidence of ours: AUC 0.50, of pixels below 0.5 100.0 % are right, of pixels from 0.5 50.0 % are right"
    )
    assert ranking_line([None], "ours") == ""
