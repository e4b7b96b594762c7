"""Figures: verdicts are computed from the numbers, files hold them, the registry names them."""

import json

import numpy as np
import pytest
from matplotlib.figure import Figure

from priorlab.cli import main
from priorlab.drawing.strokes import opened
from priorlab.figures.figure import Entry, Outcome, verdict_of
from priorlab.figures.registry import FIGURES, NOT_COMPUTABLE, figure_named
from priorlab.figures.writing import write_figures


def entry(name, value):
    """A figure whose only number is `value`."""
    return Entry(
        name, "a title", "a claim", lambda rng: Outcome(Figure(), {"value": value}, verdict_of([value > 0]), "so", "alt")
    )


def test_write_figures_writes_the_picture_and_the_numbers(tmp_path):
    lines = list(write_figures([entry("fig-0-1", 1), entry("fig-0-2", -1)], tmp_path / "figs", seed=7))
    assert lines == ["fig-0-1: agrees: so", "fig-0-2: differs: so"]
    told = json.loads((tmp_path / "figs" / "fig-0-2.json").read_text())
    assert told["verdict"] == "differs" and told["numbers"] == {"value": -1} and told["seed"] == 7
    assert (tmp_path / "figs" / "fig-0-1.png").read_bytes().startswith(b"\x89PNG")


def test_write_figures_overwrites_nothing(tmp_path):
    (tmp_path / "fig-0-2.json").write_text("mine")
    with pytest.raises(FileExistsError, match="--force"):
        list(write_figures([entry("fig-0-1", 1), entry("fig-0-2", 1)], tmp_path))
    assert (tmp_path / "fig-0-2.json").read_text() == "mine" and not (tmp_path / "fig-0-1.png").exists()


def test_registry_holds_the_figures_under_their_numbers():
    assert {"fig-2-9", "table-3-1", "fig-4-5", "fig-4-7", "fig-4-8", "fig-5-9", "fig-6-8"} <= set(FIGURES)
    assert all(name == one.name and one.title and one.claim for name, one in FIGURES.items())
    with pytest.raises(ValueError, match="did you mean 'fig-4-7'"):
        figure_named("fig-4.7")


def test_figure_2_9_measures_the_curve():
    outcome = figure_named("fig-2-9").make(np.random.default_rng(0))
    assert outcome.numbers["slope_at"][0.5] == pytest.approx(4.0)  # dl/dp = 1 / (p (1 - p))
    p = np.linspace(0.2, 0.8, 10_001)
    fit = np.polynomial.Polynomial.fit(p, np.log(p / (1 - p)), 1)
    assert outcome.numbers["deviation_from_line"] == pytest.approx(np.abs(fit(p) - np.log(p / (1 - p))).max(), rel=0.01)
    assert outcome.verdict == "agrees"


def test_cli_figures_lists_and_makes(tmp_path, capsys):
    assert main(["figures", "--list"]) == 0
    assert [line.split()[0] for line in capsys.readouterr().out.splitlines()] == [*FIGURES, *NOT_COMPUTABLE]
    assert main(["figures", "fig-2-9", "--out", str(tmp_path / "made")]) == 0
    assert capsys.readouterr().out.startswith("fig-2-9: agrees: ")
    assert sorted(path.name for path in (tmp_path / "made").iterdir()) == ["fig-2-9.json", "fig-2-9.png"]


def test_opened_keeps_what_holds_a_square():
    rng = np.random.default_rng(1)
    ink = rng.random((30, 40)) < 0.8
    for side in (2, 3, 4):
        kept = np.zeros_like(ink)
        for row in range(ink.shape[0] - side + 1):
            for col in range(ink.shape[1] - side + 1):
                if ink[row : row + side, col : col + side].all():
                    kept[row : row + side, col : col + side] = True
        assert np.array_equal(opened(ink, side)[side:-side, side:-side], kept[side:-side, side:-side]), side
