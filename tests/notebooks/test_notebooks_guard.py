"""What keeps strict nbval from passing without looking: every cell was run, in order, and prints something to compare."""

from __future__ import annotations

import json
import re
from pathlib import Path

import nbformat
import pytest

from priorlab.course.checking import exercises
from priorlab.course.execute import WIDGET_VIEW, text_of

FOLDER = Path(__file__).parents[2] / "notebooks"
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))
MARKS = re.compile(r"NBVAL_|PYTEST_VALIDATE|nbval-|raises-exception|skip-execution", re.IGNORECASE)
MAY_IGNORE: dict[str, int] = {}  # notebook -> number of cells that nbval may leave unchecked; each with its reason here
MACHINE = re.compile(r"/home/|/root/|/tmp/|/work/|/Users/|[A-Z]:\\\\|site-packages|ipykernel_\d+")
HEADINGS = (
    "**When you are done you can**",
    "**Builds on**",
    "**Time** about",
    "Predict, then move",
    "## Summary",
    "## What next",
)


def test_notebooks_are_there():
    assert {"00_start_here", "04_log_odds"} <= {path.stem for path in NOTEBOOKS}


@pytest.fixture(params=NOTEBOOKS, ids=lambda path: path.stem)
def path(request):
    return request.param


@pytest.fixture
def notebook(path):
    return nbformat.read(path, as_version=4)


@pytest.fixture
def code(notebook):
    return [cell for cell in notebook.cells if cell.cell_type == "code"]


def test_notebook_is_valid(notebook):
    nbformat.validate(notebook)


def test_notebook_every_code_cell_was_executed_in_order(code):
    assert [cell.execution_count for cell in code] == list(range(1, len(code) + 1))


def test_notebook_no_cell_failed_or_warned(code):
    outputs = [output for cell in code for output in cell.outputs]
    assert not [output for output in outputs if output.output_type == "error"]
    assert not [output for output in outputs if output.get("name") == "stderr"]


def test_notebook_enough_cells_are_compared(code):
    compared = [cell for cell in code if re.search(r"\d", text_of(cell)) or text_of(cell).startswith("Right")]
    assert len(compared) >= 0.6 * len(code)


def test_notebook_figures_and_widgets_come_with_numbers(code):
    for cell in code:
        if "plt.show()" in cell.source or any("image/png" in output.get("data", {}) for output in cell.outputs):
            assert re.search(r"\d\.\d|\d+", text_of(cell).replace("<Figure size", "")), cell.source


def test_notebook_ignore_marks_are_on_the_list(path, notebook):
    marked = [cell for cell in notebook.cells if MARKS.search(cell.source) or MARKS.search(json.dumps(cell.metadata))]
    assert len(marked) == MAY_IGNORE.get(path.stem, 0)


def test_notebook_numbers_are_rounded(code):
    for cell in code:
        assert not re.search(r"\d\.\d{7,}|np\.float|float64\(", text_of(cell)), cell.source


def test_notebook_holds_no_widget_state_and_nothing_volatile(path, notebook):
    assert set(notebook.metadata) == {"kernelspec", "language_info"}
    assert "version" not in notebook.metadata.language_info
    assert WIDGET_VIEW not in path.read_text()
    assert all(set(cell.metadata) <= {"tags"} for cell in notebook.cells)


def test_notebook_names_no_machine(notebook):
    for cell in notebook.cells:
        texts = [cell.source, *(text_of(cell).splitlines() if cell.cell_type == "code" else [])]
        assert not [text for text in texts if MACHINE.search(text)]


def test_notebook_is_small(path):
    assert path.stat().st_size < 1_500_000


def test_notebook_has_the_skeleton(path, notebook):
    first, text = notebook.cells[0].source, "\n".join(cell.source for cell in notebook.cells if cell.cell_type == "markdown")
    assert first.startswith(f"# {path.stem[:2]} · ")
    assert 3 <= len(re.findall(r"^\d\. ", first, flags=re.MULTILINE)) <= 5
    assert not [heading for heading in HEADINGS if heading not in text]
    assert len(re.findall(r"eq\. \d\.\d+", text)) >= 4
    assert any("Lab(" in cell.source for cell in notebook.cells if cell.cell_type == "code")


def test_notebook_every_objective_has_a_compared_number(notebook, code):
    wanted = {f"objective-{n}" for n in range(1, 1 + len(re.findall(r"^\d\. ", notebook.cells[0].source, flags=re.MULTILINE)))}
    found = {tag for cell in code for tag in cell.metadata.get("tags", []) if re.search(r"\d", text_of(cell))}
    assert wanted <= found


def test_notebook_exercises_are_asked_solved_and_checked(path, code):
    names = [name for name in exercises() if name.startswith(path.stem[:2])]
    assert 2 <= len(names) <= 4
    sources = [cell.source for cell in code]
    for name in names:
        at = next(i for i, source in enumerate(sources) if source.startswith(f'ask("{name}"'))
        assert "### BEGIN SOLUTION" in sources[at + 1] and "### END SOLUTION" in sources[at + 1]
        assert sources[at + 2].startswith(f'check("{name}"')
        assert text_of(code[at + 2]).startswith("Right: ")


def test_notebook_relative_links_lead_somewhere(notebook):
    for cell in notebook.cells:
        for link in re.findall(r"\]\(([^)#:]+?)\)", cell.source if cell.cell_type == "markdown" else ""):
            assert (FOLDER / link).exists(), link
