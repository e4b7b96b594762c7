"""Table 3.1 tells what its rows say, and figures 3.9 to 3.16 hold what they measure."""

from types import SimpleNamespace

import numpy as np
import pytest

from priorlab.buildings.floor_plans import load_floor_plan
from priorlab.core.drawing import Walls
from priorlab.core.score import Score, score_mask
from priorlab.drawing.baselines import dilation
from priorlab.figures import chapter3, chapter3_drawings
from priorlab.figures.registry import FIGURES
from priorlab.study.drawing_suite import METHODS, SuiteRow
from priorlab.study.thesis_drawings import THESIS_DRAWINGS

GOOD, BAD = Score(99, 1, 1, 9000), Score(50, 50, 50, 900)


def rows(method, scores):
    doors = (4, 5, 3) if method in ("THESIS", "ROBUST") else (0, 5, 0)
    return tuple(
        SuiteRow(f"d{n}", ("filled", "hollow")[n % 2], method, score, 0.5, *doors, seconds=1.0) for n, score in enumerate(scores)
    )


@pytest.mark.parametrize(
    ("thesis", "robust", "verdict"),
    [([GOOD] * 4, [GOOD] * 4, "agrees"), ([BAD] * 4, [GOOD] * 4, "partly"), ([BAD] * 4, [GOOD] * 3 + [BAD], "differs")],
)
def test_table_3_1_counts_who_meets_the_bar(monkeypatch, thesis, robust, verdict):
    scores = {"THESIS": thesis, "ROBUST": robust}
    monkeypatch.setattr(chapter3, "suite_rows", lambda half, method: rows(method, scores.get(method, [BAD] * 4)))
    outcome = FIGURES["table-3-1"].make(np.random.default_rng(0))
    assert outcome.verdict == verdict
    told = outcome.numbers["scored"]["ROBUST"]
    assert told["mean"]["meet_bar"] == sum(score is GOOD for score in robust)
    assert told["mean"]["door_precision"] == 75.0 and told["mean"]["door_recall"] == 60.0
    assert told["drawings"]["d0"]["precision"] == 99.0 and told["by_style"]["hollow"]["drawings"] == 2
    assert set(outcome.numbers["tuned"]) == set(METHODS) and "seconds" not in told["mean"]
    assert f"ROBUST {told['mean']['meet_bar']} of 4" in outcome.says


@pytest.mark.parametrize(("share", "verdict"), [(1.0, "agrees"), (0.1, "differs")])
def test_figure_3_16_compares_by_f2(monkeypatch, share, verdict):
    def found(name, method=None):
        """The true walls of the upper part of a drawing."""
        walls = load_floor_plan(name).truth.walls.copy()
        walls[int(share * len(walls)) :] = False
        return SimpleNamespace(walls=Walls(walls.astype(np.uint8)))

    monkeypatch.setattr(chapter3_drawings, "extracted", found)
    outcome = FIGURES["fig-3-16"].make(np.random.default_rng(0))
    assert set(outcome.numbers) == set(THESIS_DRAWINGS) and outcome.verdict == verdict
    plan = load_floor_plan("flat_north")
    score = score_mask(dilation(plan.drawing, 2), plan.truth)
    assert outcome.numbers["flat_north"]["dilation 2 px"]["recall"] == pytest.approx(100 * score.recall, abs=1e-3)
    assert (outcome.numbers["flat_north"]["THESIS"]["recall"] == 100) == (share == 1)


def test_figure_3_10_parts_every_pixel():
    outcome = FIGURES["fig-3-10"].make(np.random.default_rng(0))
    shares = outcome.numbers
    assert shares["positive"] + shares["dont_care"] + shares["negative"] == pytest.approx(100, abs=0.01)
    assert outcome.verdict == "agrees"
