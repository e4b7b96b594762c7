"""Copies of the notebooks for students: nbgrader's own preprocessor takes the solutions out, a stub stays behind."""

from __future__ import annotations

import copy
import re
from pathlib import Path
from typing import Any

from priorlab.core.files import new_folder

STUB = "answer = ..."
"""Stands where a solution stood; `check` answers "not yet" to it, and the copy runs from top to bottom."""


def clear_solutions(notebook: Any) -> Any:
    """A copy of a notebook (nbformat node) without solutions and without outputs.

    What lies between `### BEGIN SOLUTION` and `### END SOLUTION` becomes `answer = ...`; the cell's other lines stay.
    """
    from nbgrader.preprocessors import ClearSolutions
    from traitlets.config import Config

    config = Config()
    config.ClearSolutions.code_stub = {"python": STUB}
    config.ClearSolutions.enforce_metadata = False  # solutions are marked in the text alone; no grading database
    cleared, _ = ClearSolutions(config=config).preprocess(copy.deepcopy(notebook), {})
    for cell in cleared.cells:
        if cell.cell_type == "code":
            cell.outputs, cell.execution_count = [], None
    return cleared


def student_copy(source: str | Path, out: str | Path, force: bool = False, seed: int = 0) -> list[Path]:
    """Write the student's copy of every notebook of a folder.

    Parameters
    ----------
    source : folder with the teacher's notebooks
    out : folder for the copies; it must not exist unless `force`
    seed : the student's own; it replaces the 0 in the line `SEED = 0` and so changes the numbers of the exercises

    Returns
    -------
    The notebooks that were written, in the order of the course.

    Raises
    ------
    FileExistsError
        When `out` exists and `force` is not given.
    ValueError
        When `source` holds no notebook.
    """
    import nbformat

    notebooks = sorted(Path(source).glob("*.ipynb"))
    if not notebooks:
        raise ValueError(f"--notebooks must name a folder with at least one .ipynb, got {source}")
    with new_folder(out, force, keep=[source]) as folder:
        for notebook in notebooks:
            copied = clear_solutions(nbformat.read(notebook, as_version=4))
            for cell in copied.cells:
                cell.source = re.sub(r"^SEED = 0\b", f"SEED = {seed:d}", cell.source, flags=re.MULTILINE)
            nbformat.write(copied, folder / notebook.name)
    return [Path(out) / notebook.name for notebook in notebooks]
