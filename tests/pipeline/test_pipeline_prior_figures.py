"""Figures of chapters 4 and 5: verdicts follow the numbers, and what is kept in figures/ is what the code gives."""

import json
from pathlib import Path

import numpy as np
import pytest

from priorlab.core.score import Score
from priorlab.figures import chapter4_tables, chapter5, chapter5_studies
from priorlab.figures.chapter4_tables import THESIS_PRECISION, THESIS_RECALL, as_printed, decided_by
from priorlab.figures.prior_figures import PRIOR_FIGURES
from priorlab.figures.registry import FIGURES, figure_named
from priorlab.figures.row_summary import summary_of
from priorlab.study.conditions import Condition, Row, run
from priorlab.study.worth import Worth

KEPT = Path(__file__).resolve().parents[2] / "figures"
PROMISED = [f"fig-4-{n}" for n in (5, 6, 7, 8, 9, 10, 11)] + [f"fig-5-{n}" for n in range(1, 11)] + ["table-4-1", "table-4-2"]


def score(f2):
    """A score whose F2 is that (precision 1)."""
    tp = 1000
    return Score(tp, 0, round(5 * tp * (1 / f2 - 1) / 4), 10_000)


def fake_runs(informed, uninformed):
    """`run_all` that gives every condition the F2 it is told to have."""

    def run_all(conditions, seeds=(0, 1)):
        rows = []
        for condition in conditions:
            worth = Worth(
                *(score(f(condition)) for f in (informed, uninformed, informed, informed, uninformed, informed)),
                coverage=0.5,
                mean_looks=1.25 if condition.spacing > 1 else 4.0,
            )
            rows += [Row(condition, seed, 10, worth) for seed in seeds]
        return rows

    return run_all


def test_registry_holds_all_that_was_promised():
    assert set(PROMISED) <= set(FIGURES)
    assert len({entry.name for entry in PRIOR_FIGURES}) == len(PRIOR_FIGURES)


def test_kept_figures_are_complete_and_say_what_they_must():
    for entry in PRIOR_FIGURES:
        told = json.loads((KEPT / f"{entry.name}.json").read_text())
        assert told["claim"] == entry.claim and told["title"] == entry.title
        assert told["verdict"] in ("agrees", "partly", "differs") and told["says"] and told["numbers"] and told["alt"]
        assert (KEPT / f"{entry.name}.png").read_bytes().startswith(b"\x89PNG")


def test_kept_rows_of_figure_5_8_are_what_a_run_gives():
    rows = json.loads((KEPT / "fig-5-8.json").read_text())["numbers"]["rows"]
    assert len(rows) == 5 * 8 * 5
    (kept,) = [row for row in rows if (row["building"], row["spacing"], row["seed"]) == ("flat_south", 1.2, 4)]
    now = run(Condition("flat_south"), seed=4).as_numbers()
    for key in ("poses", "coverage", "mean_looks", "f2_without", "f2_with_prior", "f2_prior_alone"):
        assert now[key] == pytest.approx(kept[key], abs=2e-3), f"{key}: make figures again"


def test_kept_table_4_2_is_foreseen_in_every_row():
    told = json.loads((KEPT / "table-4-2.json").read_text())
    rows = told["numbers"]["rows"]
    assert len(rows) == 15 and all(row["closed_form_foresees_it"] and len(row["why"]) == 2 for row in rows)
    intuitive = sum(row["low_wall_high_space_among_them"] for row in rows)
    assert told["verdict"] == ("agrees" if intuitive > 7 else "differs")


@pytest.mark.parametrize(
    ("with_plan", "verdict"), [(lambda c: 0.6, "agrees"), (lambda c: 0.4, "differs"), (lambda c: 0.3 + c.spacing / 4, "partly")]
)
def test_verdict_of_figure_5_8_follows_the_gains(monkeypatch, with_plan, verdict):
    monkeypatch.setattr(chapter5, "run_all", fake_runs(with_plan, lambda c: 0.45))
    outcome = figure_named("fig-5-8").make(np.random.default_rng(0))
    assert outcome.verdict == verdict
    gains = [row["gain_percent"] for row in outcome.numbers["rows"] if row["mean_looks"] < 3]
    assert f"holds for {sum(gain >= 20 for gain in gains)} of {len(gains)} surveys below 3 looks" in outcome.says


@pytest.mark.parametrize(("with_plan", "verdict"), [(0.6, "agrees"), (0.4, "differs")])
def test_verdict_of_the_cell_study_flips(monkeypatch, with_plan, verdict):
    monkeypatch.setattr(chapter5_studies, "run_all", fake_runs(lambda c: with_plan, lambda c: 0.5))
    assert figure_named("study-cells").make(np.random.default_rng(0)).verdict == verdict


def test_verdict_of_the_update_study_flips(monkeypatch):
    good = ("true walls", "extracted")
    monkeypatch.setattr(
        chapter5_studies, "run_all", fake_runs(lambda c: 0.8 if (c.lam == 0) == (c.quality in good) else 0.4, lambda c: 0.5)
    )
    assert figure_named("study-updates").make(np.random.default_rng(0)).verdict == "agrees"
    monkeypatch.setattr(
        chapter5_studies, "run_all", fake_runs(lambda c: 0.4 if (c.lam == 0) == (c.quality in good) else 0.8, lambda c: 0.5)
    )
    assert figure_named("study-updates").make(np.random.default_rng(0)).verdict == "differs"


def test_verdict_of_the_update_study_is_partly_when_the_thesis_wins_on_some_damaged_walls_only(monkeypatch):
    """Some of nine is no agreement."""
    lam_0_wins = ("true walls", "extracted", "poor")
    monkeypatch.setattr(
        chapter5_studies, "run_all", fake_runs(lambda c: 0.8 if (c.lam == 0) == (c.quality in lam_0_wins) else 0.4, lambda c: 0.5)
    )
    outcome = figure_named("study-updates").make(np.random.default_rng(0))
    assert outcome.verdict == "partly" and "higher mean F2 in 6 of 9" in outcome.says


def test_a_prior_that_changes_nothing_is_not_better():
    rows = fake_runs(lambda c: 0.5 + 0.1 * (c.cell_size == 3), lambda c: 0.5)(
        [Condition("flat_north"), Condition("flat_north", cell_size=5)]
    )
    told = summary_of(rows)
    assert (told["better"], told["of"]) == (2, 4) and told["gain_percent"] == pytest.approx([10, 0, 20], abs=0.2)


def test_rows_of_the_thesis_are_fifteen_and_all_but_two_follow_from_the_closed_form():
    assert len(THESIS_PRECISION) == len(THESIS_RECALL) == 15
    doubtful = [i for i, (_, *sides) in enumerate(THESIS_RECALL) if "?" in map(decided_by, sides)]
    assert doubtful == [2, 13]  # (0.1, 1) of c at 3 x 3 and (0.4:0.9, 1) of d at 10 x 10


def test_as_printed_tells_ranges_and_gaps():
    full = np.array([[w, s] for w in (0.1, 0.2) for s in (0.3, 0.4, 0.5)])
    assert as_printed(full) == "(0.1:0.2, 0.3:0.5)"
    assert as_printed(full[:-1]) == "(0.1:0.2, 0.3:0.5)..."
    assert chapter4_tables.CELL_SIZES == (3, 5, 10)
