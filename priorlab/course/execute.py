"""Run notebooks again from top to bottom, keep only what is worth keeping, and show what changed.

    python -m priorlab.course.execute notebooks            (make notebooks)

Widget state, run times and the version of Python do not belong in a file that people compare; outputs are never edited by hand.
"""

from __future__ import annotations

import argparse
import copy
import difflib
import os
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from priorlab.core.files import write_file

WIDGET_VIEW = "application/vnd.jupyter.widget-view+json"
METADATA = {
    "kernelspec": {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"},
    "language_info": {"name": "python"},
}


def execute(notebook: Any, folder: str | Path, timeout_s: float = 120.0) -> Any:
    """A copy of a notebook (nbformat node) with fresh outputs and without what is volatile.

    Parameters
    ----------
    folder : where its kernel runs
    timeout_s : for one cell

    Raises
    ------
    nbclient.exceptions.CellExecutionError
        When a cell stops with an error.
    """
    from nbclient import NotebookClient

    fresh = copy.deepcopy(notebook)
    environment = {name: value for name, value in os.environ.items() if name != "MPLBACKEND"}  # figures are drawn inline
    client = NotebookClient(
        fresh, timeout=timeout_s, kernel_name="python3", resources={"metadata": {"path": str(folder)}}, store_widget_state=False
    )
    client.execute(env=environment)
    return tidy(fresh)


def tidy(notebook: Any) -> Any:
    """Take out, in place, what changes from run to run: widget state and models, times, the version of Python."""
    notebook.metadata = type(notebook.metadata)(copy.deepcopy(METADATA))
    for cell in notebook.cells:
        cell.metadata = type(cell.metadata)({"tags": cell.metadata["tags"]} if cell.metadata.get("tags") else {})
        if "outputs" in cell:
            cell.outputs = _whole_streams(cell.outputs)
        for output in cell.get("outputs", []):
            output.get("data", {}).pop(WIDGET_VIEW, None)
            if "metadata" in output:
                output["metadata"] = {}
    return notebook


def _whole_streams(outputs: list[Any]) -> list[Any]:
    """Printed text in one piece, however a busy kernel happened to cut it."""
    whole: list[Any] = []
    for output in outputs:
        if whole and output.output_type == whole[-1].output_type == "stream" and output.name == whole[-1].name:
            whole[-1].text += output.text
        else:
            whole.append(output)
    return whole


def text_of(cell: Any) -> str:
    """All text that a code cell printed or returned: what strict nbval compares."""
    parts = [output.get("text", "") or output.get("data", {}).get("text/plain", "") for output in cell.get("outputs", [])]
    return "\n".join(part.rstrip("\n") for part in parts)


def changes(before: Any, after: Any) -> list[str]:
    """Lines that say which cells print something else now."""
    old = {cell.id: text_of(cell) for cell in before.cells if cell.cell_type == "code"}
    lines: list[str] = []
    for number, cell in enumerate(cell for cell in after.cells if cell.cell_type == "code"):
        was, now = old.get(cell.id, ""), text_of(cell)
        if was != now:
            lines.append(f"  code cell {number}: {cell.source.splitlines()[0] if cell.source else '(empty)'}")
            lines += [f"    {line}" for line in difflib.unified_diff(was.splitlines(), now.splitlines(), lineterm="", n=0)][2:]
    return lines


def main(arguments: Sequence[str] | None = None) -> int:
    """Run all notebooks of a folder, or those that are named, and say what changed."""
    import nbformat
    from nbclient.exceptions import CellExecutionError

    parser = argparse.ArgumentParser(prog="python -m priorlab.course.execute", description=__doc__.splitlines()[0])
    parser.add_argument("paths", nargs="+", type=Path, help="notebooks, or folders that hold some")
    paths = parser.parse_args(arguments).paths
    notebooks = [path for place in paths for path in (sorted(place.glob("*.ipynb")) if place.is_dir() else [place])]
    if not notebooks:
        parser.error(f"there must be at least one notebook, got none in {', '.join(map(str, paths))}")
    failed = 0
    for path in notebooks:
        started = time.perf_counter()
        before = nbformat.read(path, as_version=4)
        try:
            after = execute(before, path.parent)
        except CellExecutionError as error:
            print(f"{path}: stopped, and was left as it is\n{error}")
            failed = 1
            continue
        write_file(path, nbformat.writes(after) + "\n")
        different = changes(before, after)
        print(f"{path}: {time.perf_counter() - started:.1f} s, {path.stat().st_size / 1e6:.2f} MB, ", end="")
        print("nothing changed" if not different else "these cells print something else:")
        print("\n".join(different), end="\n" if different else "")
    return failed


if __name__ == "__main__":
    sys.exit(main())
