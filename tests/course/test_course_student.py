"""Student copies: solutions out, stubs in, everything else the same - and the copy runs before anything is solved."""

from __future__ import annotations

from pathlib import Path

import nbformat
import pytest

from priorlab.course.student import STUB, clear_solutions, student_copy

NOTEBOOKS = sorted((Path(__file__).parents[2] / "notebooks").glob("*.ipynb"))
IDS = [path.stem for path in NOTEBOOKS]


def notebook_of(*sources):
    return nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(source) for source in sources])


def test_clear_solutions_leaves_the_stub_with_its_indent():
    cleared = clear_solutions(
        notebook_of("def f(p):\n    ### BEGIN SOLUTION\n    answer = p\n    ### END SOLUTION\n    return answer")
    )
    assert cleared.cells[0].source == f"def f(p):\n    {STUB}\n    return answer"


def test_clear_solutions_does_not_touch_its_argument():
    notebook = notebook_of("### BEGIN SOLUTION\nanswer = 1\n### END SOLUTION")
    clear_solutions(notebook)
    assert "answer = 1" in notebook.cells[0].source


def test_student_copy_writes_seed_and_refuses_to_overwrite(tmp_path):
    source, out = tmp_path / "course", tmp_path / "students"
    source.mkdir()
    nbformat.write(notebook_of("SEED = 0  # yours", "### BEGIN SOLUTION\nanswer = 1\n### END SOLUTION"), source / "a.ipynb")
    written = student_copy(source, out, seed=7)
    assert written == [out / "a.ipynb"]
    cells = nbformat.read(written[0], as_version=4).cells
    assert cells[0].source == "SEED = 7  # yours" and cells[1].source == STUB
    with pytest.raises(FileExistsError, match="exists already"):
        student_copy(source, out)
    assert student_copy(source, out, force=True) == written


def test_student_copy_of_an_empty_folder_is_told(tmp_path):
    with pytest.raises(ValueError, match="at least one .ipynb"):
        student_copy(tmp_path, tmp_path / "out")
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("path", NOTEBOOKS, ids=IDS)
def test_student_copy_keeps_step_with_the_teachers(path):
    teacher = nbformat.read(path, as_version=4)
    student = clear_solutions(teacher)
    assert [cell.cell_type for cell in student.cells] == [cell.cell_type for cell in teacher.cells]
    changed = [cell.source for cell, old in zip(student.cells, teacher.cells, strict=True) if cell.source != old.source]
    solved = [cell.source for cell in teacher.cells if "### BEGIN SOLUTION" in cell.source]
    assert len(changed) == len(solved) >= 2
    assert all(STUB in source and "SOLUTION" not in source for source in changed)
    assert not any(cell.get("outputs") for cell in student.cells)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=IDS)
def test_student_copy_runs_from_top_to_bottom_unsolved(path, tmp_path):
    from priorlab.course.execute import execute, text_of

    student = execute(clear_solutions(nbformat.read(path, as_version=4)), tmp_path)
    checks = [text_of(cell) for cell in student.cells if cell.cell_type == "code" and cell.source.startswith("check(")]
    assert len(checks) >= 2
    assert all(said.startswith("Not yet") for said in checks), checks
