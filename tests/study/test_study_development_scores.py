"""The score of the development drawings: perfect and empty answers, the table's counts."""

import numpy as np
import pytest

from priorlab.study.development_drawings import development_case
from priorlab.study.development_scores import development_table, main, score_development

SMALL = 96  # a filled flat of some 300 pixels


def test_score_development_the_truth_meets_the_bar_and_blank_paper_does_not():
    truth = development_case(SMALL).truth
    perfect, blank = (score_development([SMALL], lambda _, mask=mask: mask)[0] for mask in (truth.walls, truth.walls & False))
    assert perfect.meets_bar and perfect.walls.recall == 1 and perfect.style == "filled"
    assert not blank.meets_bar and blank.walls.recall == 0


def test_development_table_has_a_line_for_each_style_and_one_for_all():
    lines: list[str] = []
    rows = score_development([SMALL, SMALL], lambda drawing: drawing.grey < 128, progress=lines.append)
    table = development_table(rows).splitlines()
    assert [line.split()[0] for line in table] == ["style", "filled", "all"] and len(lines) == 2
    assert table[1].split()[1:] == table[2].split()[1:] and table[1].split()[1:4] == ["0", "of", "2"]
    assert np.isclose(float(table[1].split()[5]), 100 * rows[0].walls.recall, atol=0.05)


@pytest.mark.parametrize(("arguments", "message"), [(["all"], "invalid choice"), (["work", "0"], "at least 1, got 0")])
def test_main_refuses_unknown_halves_and_no_drawings(arguments, message, capsys):
    with pytest.raises(SystemExit):
        main(arguments)
    assert message in capsys.readouterr().err
