"""The development set: the same every time, clean of the scored half's hands, its truth untouched by stray ink."""

import numpy as np
import pytest

from priorlab.buildings.floor_plans import draw_plan
from priorlab.study.development_drawings import (
    STYLES,
    described,
    development_case,
    development_numbers,
    development_recipe,
    false_ink,
    kinds_of_ink,
)

SMALL = 18  # a filled flat of some 300 pixels


@pytest.fixture(scope="module")
def case():
    return development_case(SMALL)


def test_development_numbers_halves_share_none():
    work, held = development_numbers("work"), development_numbers("held_back")
    assert not set(work) & set(held) and sorted(work + held) == development_numbers("both", 40)


def test_development_recipe_every_style_stands_in_both_halves():
    for half in ("work", "held_back"):
        assert {development_recipe(number).style for number in development_numbers(half, 12)} == set(STYLES)


def test_development_recipe_keeps_to_the_hands_of_the_tuned_half():
    for number in range(40):
        recipe = development_recipe(number)
        hand = (recipe.symbols, recipe.door_symbol, recipe.window, recipe.stairs, recipe.dimension, recipe.font)
        assert set(hand) <= {"plain", "soft", "slab", "box", "line", "cut", "tick", "dot", "sans", "mono", "oblique"}
        assert not set(recipe.clutter) & {"axes", "border", "cloud", "compass", "hedge", "levels", "parking", "ruler", "stamps"}


def test_development_case_is_the_same_every_time(case):
    again = development_case(SMALL)
    assert np.array_equal(case.drawing.grey, again.drawing.grey) and np.array_equal(case.truth.walls, again.truth.walls)


def test_development_case_stray_ink_is_no_wall():
    recipe = development_recipe(24)
    plain, truth = draw_plan(described(recipe))
    strewn = development_case(24)
    more = plain.grey.astype(int) - strewn.drawing.grey > 40
    assert recipe.degradations == () and more.sum() > 100
    assert not (more & (truth.walls | truth.ignore)).any()


def test_false_ink_tells_letters_from_edges(case):
    kinds = kinds_of_ink(case)
    wrong = kinds["letters"] & ~case.truth.ignore
    counts = false_ink(case, wrong)
    assert counts["letters"] >= 0.9 * (wrong & ~case.truth.walls).sum() > 0
    rim = np.roll(case.truth.walls, 2, axis=0)
    assert false_ink(case, rim)["letters"] == 0 < false_ink(case, rim)["edge"]
