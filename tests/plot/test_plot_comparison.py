"""Lines and bars over seeds, and tables: what was handed in is what is drawn."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from priorlab import plot

RUNS = {"with the plan": [[0.9, 0.8, 1.0], [0.7, 0.6, 0.75]], "without (0.5)": [[0.1, 0.0, 0.2], [0.5, 0.4, 0.6]]}


@pytest.fixture
def ax():
    return Figure().add_subplot()


def test_interval_lines_draw_means_and_shade_from_lowest_to_highest(ax):
    plot.interval_lines([1, 3], RUNS, ax)
    for line, shade, values in zip(ax.lines, ax.collections, RUNS.values(), strict=True):
        mean, low, high = np.array(values).T
        assert line.get_ydata().tolist() == mean.tolist() and line.get_xdata().tolist() == [1, 3]
        corners = shade.get_paths()[0].vertices
        for x, bottom, top in zip((1, 3), low, high, strict=True):
            at = corners[corners[:, 0] == x, 1]
            assert (at.min(), at.max()) == (bottom, top)
    assert len({line.get_linestyle() for line in ax.lines}) == len({line.get_marker() for line in ax.lines}) == 2


def test_interval_lines_take_an_x_for_each_name(ax):
    plot.interval_lines({"with the plan": [1, 2], "without (0.5)": [5, 6]}, RUNS, ax)
    assert [line.get_xdata().tolist() for line in ax.lines] == [[1, 2], [5, 6]]


def test_interval_bars_are_as_long_as_their_means_and_say_them(ax):
    plot.interval_bars(["a", "b"], RUNS, ax)
    assert [bar.get_width() for bar in ax.patches] == [0.9, 0.7, 0.1, 0.5]
    assert [text.get_text().strip() for text in ax.texts] == ["0.90", "0.70", "0.10", "0.50"]
    assert [label.get_text() for label in ax.get_yticklabels()] == ["a", "b"]
    (plan, *_, none) = ax.patches
    assert plan.get_facecolor() != none.get_facecolor() and plan.get_hatch() != none.get_hatch()


def test_gains_mark_zero_and_the_twenty_percent_of_the_thesis(ax):
    plot.looks_axis(plot.gains([1.2, 6.0], {"flat": [[200, 150, 250], [-10, -12, -8]]}, ax), 1.2, 6.0)
    levels = {line.get_ydata()[0] for line in ax.lines[1:]}
    assert levels == {0, 20}
    low, high = ax.get_ylim()
    assert low < -12 and high > 250
    assert [label.get_text() for label in ax.get_xticklabels()] == ["1.2", "1.5", "2", "3", "4", "6"]


def test_number_table_holds_every_cell(ax):
    plot.number_table([(3, "flat", 0.5), (5, "office", 0.25)], ("cells", "drawing", "value"), ax, title="so")
    (made,) = ax.tables
    cells = made.get_celld()
    assert [[cells[row, col].get_text().get_text() for col in range(3)] for row in range(3)] == [
        ["cells", "drawing", "value"],
        ["3", "flat", "0.5"],
        ["5", "office", "0.25"],
    ]
    assert ax.get_title() == "so"
