"""The curves of chapter 2.3.4 draw the numbers that they are given."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
import pytest

from priorlab.plot.log_odds import flip_lines, log_odds_curve


@pytest.fixture
def ax():
    figure, ax = plt.subplots()
    yield ax
    plt.close(figure)


def test_log_odds_curve_is_odd_about_one_half_and_names_its_marks(ax):
    assert log_odds_curve(ax, marks=(0.9,)) is ax
    (curve,) = [line for line in ax.lines if len(line.get_xdata()) > 100]
    x, y = curve.get_data()
    assert np.allclose(y, -y[::-1]) and np.all(np.diff(y) > 0)
    assert y[np.argmin(np.abs(x - 0.9))] == pytest.approx(np.log(9), abs=0.02)
    assert [text.get_text() for text in ax.texts] == ["l(0.9) = 2.20"]


def test_flip_lines_draw_each_line_against_the_priors_log_odds(ax):
    p = np.array([0.1, 0.5, 0.9])
    after = {"no reading": np.log(p / (1 - p)), "one": np.full(3, 1.0)}
    flip_lines(p, after, ax, pivot=0.8)
    lines = {line.get_label(): line for line in ax.lines}
    for label, values in after.items():
        assert np.allclose(lines[label].get_xdata(), np.log(p / (1 - p))) and np.allclose(lines[label].get_ydata(), values)
    assert lines["no reading"].get_linestyle() != lines["one"].get_linestyle()
    assert any("P(empty) <= 0.2" in text.get_text() for text in ax.texts)
