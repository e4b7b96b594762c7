"""The teacher's page keeps step with the exercises and the notebooks."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from priorlab.course import answer_key
from priorlab.course.checking import exercises

DOCS = Path(__file__).parents[2] / "docs"
PAGE = (DOCS / "teaching.md").read_text(encoding="utf-8")
KEY = dict(re.findall(r"^\| (\d\d\.\w+) \| (.+?) \|", PAGE, flags=re.MULTILINE))
NUMBERS = [
    "00.occupancy",
    "00.f2",
    "03.effective",
    "03.limit",
    "04.one_cell",
    "04.flip",
    "05.threshold",
    "06.turn",
    "08.beam",
    "08.ess",
]
NUMBERS += ["09.doorway", "09.added"]


def test_teaching_page_has_every_exercise():
    assert list(KEY) == list(exercises())


@pytest.mark.parametrize("name", NUMBERS)
def test_teaching_page_numbers_are_the_computed_ones(name):
    assert float(KEY[name]) == pytest.approx(answer_key()[name], abs=6e-4)


def test_teaching_page_gain_is_the_computed_one():
    assert float(KEY["06.gain"]) == pytest.approx(answer_key()["06.gain"], abs=0.06)


@pytest.mark.parametrize("name", ["00.darkest", "05.front", "05.row"])
def test_teaching_page_answers_of_several_numbers_are_the_computed_ones(name):
    assert KEY[name] == str(answer_key()[name])


def test_teaching_page_names_every_notebook_and_its_minutes():
    for path in (DOCS.parent / "notebooks").glob("*.ipynb"):
        number, *words = path.stem.split("_")
        minutes = re.search(rf"^\| {number} {' '.join(words)} \| (\d+) \|", PAGE, flags=re.MULTILINE)
        assert minutes and f"about {minutes[1]} minutes" in path.read_text(encoding="utf-8")


def test_teaching_page_links_lead_somewhere():
    for link in re.findall(r"\]\(([^)#:]+)\)", PAGE):
        assert (DOCS / link).exists(), link
