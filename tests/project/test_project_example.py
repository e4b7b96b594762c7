"""The README's example runs as printed, and what it prints is plausible (thesis 3.4, 4.6 and 6.3; method: see the README)."""

import re
from pathlib import Path

import pytest

README = Path(__file__).resolve().parents[2] / "README.md"


@pytest.fixture(scope="module")
def example():
    """The example's variables after it ran, and what it printed."""
    source = next(block for block in re.findall(r"```python\n(.*?)```", README.read_text(), re.DOTALL) if "FastSLAM" in block)
    printed: list[str] = []
    names = {"print": lambda *words: printed.append(" ".join(map(str, words)))}
    exec(compile(source, "README.md", "exec"), names)
    return names, printed


def test_example_prints_a_line_per_chapter(example):
    _, printed = example
    assert [line.split("Score")[0].strip() for line in printed] == ["walls", "prior only", "posterior", "FastSLAM"]


def test_example_extracts_walls(example):
    names, _ = example
    score = names["pl"].score_walls(names["walls"], names["plan"].truth)
    assert score.precision > 0.95 and score.recall > 0.85


def test_example_prior_beats_no_prior(example):
    names, _ = example
    pl = names["pl"]
    none = pl.update_map(pl.build_prior_map(names["walls"], pl.Prior.uninformed(), cell_size=3), names["evidence"])
    gain = pl.score_map(names["posterior"], names["plan"].truth).f_beta / pl.score_map(none, names["plan"].truth).f_beta - 1
    assert 1 <= names["evidence"].mean_looks < 3, "a quick survey"
    assert gain >= 0.2, "the thesis's claim (5.2): at least 20 % in F2 for a quick survey"


def test_example_front_of_the_search_lies_below_the_exact_one(example):
    names, _ = example
    exact, found = names["sweep"].front(), names["front"]
    assert len(found.p_wall) > 0
    for precision, recall in zip(found.precision, found.recall, strict=True):
        assert ((exact.precision >= precision - 1e-12) & (exact.recall >= recall - 1e-12)).any()


def test_example_robot_is_not_lost(example):
    names, _ = example
    assert names["run"].ate_m(names["log"]) < 0.3
    assert names["pl"].score_map(names["run"].map, names["floor"].truth, threshold=0.5).f_beta > 0.6
