"""The student's copies never take the teacher's notebooks with them."""

import pytest

from priorlab.cli import main
from priorlab.course.student import student_copy


@pytest.fixture
def notebooks(tmp_path):
    folder = tmp_path / "nb"
    folder.mkdir()
    nbformat = pytest.importorskip("nbformat")
    cell = nbformat.v4.new_code_cell("### BEGIN SOLUTION\nanswer = 1\n### END SOLUTION")
    nbformat.write(nbformat.v4.new_notebook(cells=[cell]), folder / "00.ipynb")
    return folder


@pytest.mark.parametrize("out", ["nb", "."])
def test_student_keeps_the_notebooks(notebooks, out, monkeypatch, capsys):
    monkeypatch.chdir(notebooks.parent)
    assert main(["student", out, "--notebooks", "nb", "--force"]) == 2
    said = capsys.readouterr().err
    assert said.startswith("priorlab: ") and said.count("\n") == 1
    assert "BEGIN SOLUTION" in (notebooks / "00.ipynb").read_text()


def test_student_copy_refuses_the_notebooks_own_folder(notebooks):
    with pytest.raises(ValueError, match="--force would remove it"):
        student_copy(notebooks, notebooks, force=True)
