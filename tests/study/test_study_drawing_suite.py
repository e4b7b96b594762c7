"""The suite's scores against hand-made results."""

import numpy as np
import pytest

from priorlab.buildings.recipe import Recipe, WallLook
from priorlab.core.drawing import Door, Walls
from priorlab.core.score import Score
from priorlab.drawing.baselines import opening
from priorlab.drawing.method import THESIS
from priorlab.study.drawing_suite import (
    METHODS,
    SuiteRow,
    by_style,
    case_of,
    matched_doors,
    score_case,
    score_suite,
    suite,
    summary,
    told,
)

HOLLOW = WallLook("hollow", px=8, line=1.5)
DOOR = Door((10, 10), (50, 10), (10, 50))


@pytest.fixture(scope="module")
def case():
    return case_of(Recipe("hut", seed=2, style="hollow", size=(8, 6), rooms=4, long_side=400, outer=HOLLOW, inner=HOLLOW))


def row(tp=98, fp=1, fn=2, tn=9000, style="filled", found=2, true=3, right=1):
    return SuiteRow("one", style, "method", Score(tp, fp, fn, tn), 0.5, found, true, right)


def test_score_case_of_the_truth_is_perfect(case):
    scored = score_case(case, Walls(case.truth.walls.astype(np.uint8)))
    assert (scored.walls.precision, scored.walls.recall, scored.walls.false_positive_rate) == (1.0, 1.0, 0.0)
    assert scored.meets_bar and scored.name == "hut" and scored.style == "hollow"
    assert scored.area_recall < 0.6  # only the lines, not what lies between them


def test_score_case_of_the_whole_bodies_has_all_the_area(case):
    scored = score_case(case, case.area)
    assert scored.area_recall == 1.0 and scored.walls.precision == 1.0  # between the lines is don't-care
    missed = case.truth.walls & ~case.area
    assert scored.walls.fn == missed.sum() > 0 and case.truth.windows[missed].all()  # the bodies hold no windows


def test_score_case_of_nothing_meets_nothing(case):
    scored = score_case(case, np.zeros_like(case.truth.walls))
    assert np.isnan(scored.walls.precision) and scored.walls.recall == 0 and not scored.meets_bar
    assert summary([scored])["nothing_found"] == 1 and summary([scored])["precision"] == -1


def test_score_case_runs_methods_by_name_and_by_themselves(case):
    named, itself = score_case(case, "opening 4 px"), score_case(case, opening)
    assert named.walls == itself.walls and named.method == "opening 4 px" and itself.method == "opening"
    assert named.doors_found == 0 and named.doors_true == len(case.truth.doors) >= 4
    thesis = score_case(case, THESIS)
    assert thesis.method == "THESIS" and thesis.doors_right <= min(thesis.doors_found, thesis.doors_true)
    with pytest.raises(ValueError, match="did you mean 'opening 4 px'"):
        score_case(case, "opening 5 px")


@pytest.mark.parametrize(
    ("walls", "meets"),
    [
        (Score(98, 2, 2, 9000), True),
        (Score(97, 3, 2, 9000), False),  # precision
        (Score(610, 1, 390, 9000), True),
        (Score(609, 1, 391, 9000), False),  # recall
        (Score(100_000, 12, 0, 9988), True),
        (Score(100_000, 13, 0, 9987), False),  # false positive rate
    ],
)
def test_bar_is_the_thesis_table(walls, meets):
    assert SuiteRow("a", "filled", "m", walls, 1.0, 0, 0, 0).meets_bar == meets


@pytest.mark.parametrize(
    ("found", "is_same"),
    [
        (Door((10, 10), (50, 10), (10, 50)), True),
        (Door((50, 10), (10, 10), (50, 50)), True),  # hinged at the other jamb
        (Door((21, 10), (61, 10), (21, 50)), True),  # 11 of 40 pixels off
        (Door((23, 10), (63, 10), (23, 50)), False),
        (Door((10, 10), (50, 10), (10, -30)), False),  # swings to the other side
        (Door((10, 10), (10, 50), (50, 10)), False),  # along the leaf
    ],
)
def test_matched_doors_need_both_jambs_and_the_side(found, is_same):
    assert matched_doors([found], [DOOR]) == ([(0, 0)] if is_same else [])


def test_matched_doors_are_one_to_one_and_the_nearest_first():
    shifted = Door((12, 10), (52, 10), (12, 50))
    other = Door((100, 10), (140, 10), (100, 50))
    assert matched_doors([shifted, DOOR, other], [DOOR, other]) == [(1, 0), (2, 1)]
    assert matched_doors([DOOR, DOOR], [DOOR]) == [(0, 0)]


def test_summary_counts_by_hand():
    told_of = summary([row(), row(tp=50, fp=50, fn=50, tn=950, found=0, true=1, right=0)])
    assert told_of["precision"] == pytest.approx(100 * (98 / 99 + 0.5) / 2, abs=1e-3)
    assert told_of["recall"] == pytest.approx(100 * (0.98 + 0.5) / 2, abs=1e-3)
    assert told_of["false_positive_rate"] == pytest.approx(100 * (1 / 9001 + 0.05) / 2, abs=1e-3)
    assert (told_of["drawings"], told_of["meet_bar"]) == (2, 1)
    assert (told_of["door_precision"], told_of["door_recall"]) == (50.0, 25.0)  # 1 of 2 found, 1 of 4 true
    with pytest.raises(ValueError, match="rows must hold at least one drawing"):
        summary([])


def test_by_style_keeps_styles_apart():
    apart = by_style([row(), row(style="hollow", tp=0, fn=100), row()])
    assert list(apart) == ["filled", "hollow"]
    assert apart["filled"]["drawings"] == 2 and apart["hollow"]["recall"] == 0


def test_suite_and_score_suite_take_names():
    (only,) = suite("tuned", ["garden_house"])
    assert only.name == "garden_house" and max(only.drawing.shape) == 320
    lines = []
    (scored,) = score_suite("tuned", "run length", ["garden_house"], progress=lines.append)
    assert scored.walls == score_case(only, "run length").walls
    assert lines == [told(scored)] and lines[0].startswith("garden_house")
    with pytest.raises(ValueError, match="did you mean 'garden_house'"):
        suite("tuned", ["garden_hose"])
    with pytest.raises(ValueError, match="half must be one of tuned, scored"):
        suite("both")  # type: ignore[arg-type]


def test_methods_are_both_presets_and_all_filters():
    assert list(METHODS)[:2] == ["THESIS", "ROBUST"] and len(METHODS) == 7
