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


def test_teaching_page_has_every_exercise():
    assert list(KEY) == list(exercises())


@pytest.mark.parametrize("name", ["00.occupancy", "00.f2", "04.one_cell", "04.flip"])
def test_teaching_page_numbers_are_the_computed_ones(name):
    assert float(KEY[name]) == pytest.approx(answer_key()[name], abs=6e-4)


def test_teaching_page_cell_is_the_computed_one():
    assert KEY["00.darkest"] == str(answer_key()["00.darkest"])


def test_teaching_page_names_every_notebook_and_its_minutes():
    for path in (DOCS.parent / "notebooks").glob("*.ipynb"):
        number, *words = path.stem.split("_")
        minutes = re.search(rf"^\| {number} {' '.join(words)} \| (\d+) \|", PAGE, flags=re.MULTILINE)
        assert minutes and f"about {minutes[1]} minutes" in path.read_text(encoding="utf-8")


def test_teaching_page_links_lead_somewhere():
    for link in re.findall(r"\]\(([^)#:]+)\)", PAGE):
        assert (DOCS / link).exists(), link
