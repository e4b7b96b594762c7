"""The figure of the matcher: the same function on a short tour, and what the kept one says."""

import json
from pathlib import Path

import pytest

from priorlab.figures.figure import verdict_of
from priorlab.figures.registry import FIGURES
from priorlab.figures.scan_matching import FACTOR, floors_of, matching_outcome

KEPT = Path(__file__).resolve().parents[2] / "figures" / "study-scan-matching.json"


@pytest.fixture(scope="module")
def outcome():
    return matching_outcome(floors_of("small_flat", (0, 1), 0.5))


def test_matching_outcome_computes_its_verdict(outcome):
    numbers = outcome.numbers
    wheels, matched = (numbers[name]["by_seed"] for name in ("ate_m_wheels", "ate_m_matched"))
    assert numbers["factor"] == pytest.approx([w / m for w, m in zip(wheels, matched, strict=True)])
    assert outcome.verdict == verdict_of([w >= FACTOR * m for w, m in zip(wheels, matched, strict=True)])
    assert max(matched) < 0.2 and f"{numbers['ate_m_matched']['mean']:.2f}" in outcome.says
    assert len(outcome.figure.axes) == 3


def test_kept_figure_is_of_five_seeds_and_agrees():
    kept = json.loads(KEPT.read_text())
    assert kept["verdict"] == "agrees" and min(kept["numbers"]["factor"]) >= FACTOR
    assert len(kept["numbers"]["ate_m_matched"]["by_seed"]) == 5 and "study-scan-matching" in FIGURES
