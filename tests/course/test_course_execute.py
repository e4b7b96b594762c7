"""Running notebooks again: what is kept, what is taken out, what is said."""

from __future__ import annotations

import nbformat
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook, new_output

from priorlab.course.execute import WIDGET_VIEW, changes, main, text_of, tidy


def test_tidy_takes_out_state_times_and_models():
    cell = new_code_cell("lab", metadata={"execution": {"iopub.execute_input": "now"}, "tags": ["objective-1"]})
    cell.outputs = [new_output("execute_result", {"text/plain": "Lab(1)", WIDGET_VIEW: {"model_id": "x"}}, execution_count=1)]
    notebook = new_notebook(
        cells=[cell], metadata={"widgets": {"state": {}}, "language_info": {"name": "python", "version": "3.11.2"}}
    )
    tidy(notebook)
    assert "widgets" not in notebook.metadata and "version" not in notebook.metadata.language_info
    assert notebook.cells[0].metadata == {"tags": ["objective-1"]}
    assert notebook.cells[0].outputs[0].data == {"text/plain": "Lab(1)"}


def test_changes_shows_what_is_printed_differently():
    def notebook(text):
        cell = new_code_cell("print(x)", id="a")
        cell.outputs = [new_output("stream", text=text)]
        return new_notebook(cells=[new_markdown_cell("# A"), cell])

    assert changes(notebook("0.5\n"), notebook("0.5\n")) == []
    assert changes(notebook("0.5\n"), notebook("0.6\n")) == ["  code cell 0: print(x)", "    @@ -1 +1 @@", "    -0.5", "    +0.6"]


def test_main_executes_in_place_and_leaves_a_failing_notebook_alone(tmp_path, capsys):
    good, bad = tmp_path / "a.ipynb", tmp_path / "b.ipynb"
    nbformat.write(new_notebook(cells=[new_code_cell("print(1 + 1)")]), good)
    nbformat.write(new_notebook(cells=[new_code_cell("1 / 0")]), bad)
    before = bad.read_bytes()
    assert main([str(tmp_path)]) == 1
    assert text_of(nbformat.read(good, as_version=4).cells[0]) == "2"
    assert bad.read_bytes() == before
    said = capsys.readouterr().out
    assert "+2" in said and "ZeroDivisionError" in said


def test_tidy_joins_text_that_was_printed_in_pieces():
    cell = new_code_cell("print(1); print(2)")
    cell.outputs = [
        new_output("stream", text="1\n"),
        new_output("stream", text="2\n"),
        new_output("stream", name="stderr", text="!"),
    ]
    tidy(new_notebook(cells=[cell]))
    assert [output.text for output in cell.outputs] == ["1\n2\n", "!"]
