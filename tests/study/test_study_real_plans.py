"""Other people's drawings with marked walls: the reader and the counts on a plan made by hand, then the real ones.

The real ones lie where PRIORLAB_REAL_DATA says; `make real DATA=folder` prints their table.
"""

import os
from pathlib import Path

import cv2
import numpy as np
import pytest

from priorlab.core.building import Truth
from priorlab.core.drawing import WINDOW, Walls
from priorlab.drawing.method import ROBUST, THESIS
from priorlab.study.drawing_suite import METHODS
from priorlab.study.real_plans import (
    marked_plans,
    mask_of,
    near_scores,
    plans_table,
    read_marked_plan,
    score_real_plans,
)

TARGET_IOU = {"cvcfp_c14": 0.84, "cvcfp_c2": 0.81, "cvcfp_c13": 0.84, "cvcfp_c3": 0.87, "mlstruct_f302_crop0": 0.65}
IMAGES = ["cvcfp_c14", "cvcfp_c2", "cvcfp_c13", "cvcfp_c3", "mlstruct_f302_crop0", "mlstruct_f302_fifth"]


@pytest.fixture
def folder(tmp_path):
    """A wall of 100 x 8 px and a line of 100 x 2; the mask is 2 px higher than the wall; its left tenth is not counted."""
    drawing = np.full((60, 120), 255, np.uint8)
    drawing[20:28, 10:110] = drawing[50:52, 10:110] = 0
    walls, ignore = np.full((60, 120), 255, np.uint8), np.full((60, 120), 255, np.uint8)
    walls[18:26, 10:110] = 0
    ignore[:, 10:20] = 0
    for name, image in {"hut": drawing, "hut_walls": walls, "hut_ignore": ignore}.items():
        cv2.imwrite(str(tmp_path / f"{name}.png"), image)
    cv2.imwrite(str(tmp_path / "shed.png"), drawing)
    cv2.imwrite(str(tmp_path / "shed_walls.png"), drawing)
    return tmp_path


def ink(drawing):
    return drawing.grey < 128


def test_marked_plans_are_those_with_a_wall_mask(folder):
    assert marked_plans(folder) == ["hut", "shed"]


def test_read_marked_plan_black_is_marked(folder):
    plan = read_marked_plan(folder, "hut")
    assert plan.truth.walls.sum() == 800 and plan.truth.ignore.sum() == 600
    assert plan.tolerance == 120 / 448
    assert not read_marked_plan(folder, "shed").truth.ignore.any()


def test_read_marked_plan_refuses_other_sizes(folder):
    cv2.imwrite(str(folder / "shed_walls.png"), np.eye(30, dtype=np.uint8) * 255)
    with pytest.raises(ValueError, match="shed_walls.png must be as large as its drawing"):
        read_marked_plan(folder, "shed")


def test_marked_plans_without_a_folder(tmp_path):
    with pytest.raises(FileNotFoundError, match="does not exist"):
        marked_plans(tmp_path / "nowhere")


def test_score_real_plans_counts_by_hand(folder):
    (row,) = score_real_plans(folder, {"ink": ink}, names=["hut"])
    assert (row.score.tp, row.score.fp, row.score.fn) == (6 * 90, 2 * 90 + 2 * 90, 2 * 90)
    assert row.darkness is None
    assert row.ranked is None


def test_score_real_plans_windows_count_as_empty(folder):
    def with_a_window(drawing):
        labels = ink(drawing).astype(np.uint8)
        labels[50:52] *= WINDOW  # the line is called a window
        return Walls(labels)

    (row,) = score_real_plans(folder, {"glazier": with_a_window}, names=["hut"])
    assert (row.score.tp, row.score.fp, row.score.fn) == (6 * 90, 2 * 90, 2 * 90)
    walls = with_a_window(read_marked_plan(folder, "hut").drawing)
    assert mask_of(walls).sum() - mask_of(walls, "empty").sum() == 200


def test_score_real_plans_gives_filters_their_best_threshold(folder):
    image = cv2.imread(str(folder / "shed.png"), cv2.IMREAD_GRAYSCALE)
    cv2.imwrite(str(folder / "shed.png"), np.where(image == 0, 200, 255).astype(np.uint8))  # pale ink: 55 from the paper
    (row,) = score_real_plans(folder, {"opening 4 px": METHODS["opening 4 px"]}, names=["shed"])
    assert (row.score.tp, row.score.fp, row.score.fn) == (800, 0, 200)
    assert row.darkness < 55


def test_near_scores_forgive_up_to_the_tolerance(folder):
    plan = read_marked_plan(folder, "hut")
    found = np.zeros((60, 120), bool)
    found[20:28, 10:110] = True
    assert near_scores(found, plan.truth, 1.9) == (7 / 8, 7 / 8)
    assert near_scores(found, plan.truth, 2.0) == (1.0, 1.0)


def test_near_scores_of_nothing():
    empty = np.zeros((5, 5), bool)
    precision, recall = near_scores(empty, Truth(~empty, empty), 3.0)
    assert np.isnan(precision) and recall == 0.0


def test_plans_table_says_whether_the_target_is_reached(folder):
    rows = score_real_plans(folder, {"ink": ink, "opening 4 px": METHODS["opening 4 px"]}, names=["hut"])
    assert rows[0].score.iou == pytest.approx(540 / 1080)
    assert "misses 10.0" in plans_table(rows, {"hut": 0.6})
    assert plans_table(rows, {"hut": 0.5}).count("reached") == 1  # a filter told which threshold to take reaches nothing
    assert "reached" not in plans_table(rows)


@pytest.fixture(scope="module")
def real_folder() -> Path:
    folder = os.environ.get("PRIORLAB_REAL_DATA")
    if not folder:
        pytest.skip("PRIORLAB_REAL_DATA is not set")
    return Path(folder) / "plans_real"


@pytest.fixture(scope="module")
def real_rows(real_folder):
    return score_real_plans(real_folder, METHODS, IMAGES)


def test_real_plans_table(real_rows):
    print("\n\nReal plans (windows count as empty; simple filters at their own best ink threshold)\n")
    print(plans_table(real_rows, TARGET_IOU))
    assert len(real_rows) == len(IMAGES) * len(METHODS)


@pytest.mark.parametrize("name", TARGET_IOU)
def test_real_plan_robust_beats_every_simple_filter(real_rows, name):
    iou = {row.method: row.score.iou for row in real_rows if row.plan == name}
    rivals = [value for method, value in iou.items() if method not in (ROBUST.name, THESIS.name)]
    assert iou[ROBUST.name] >= max(rivals)
