"""A notebook on a copy of priorlab in which one thing was changed."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import nbformat
import pytest

ROOT = Path(__file__).parents[2]


@pytest.fixture
def run_changed(tmp_path):
    """Strict nbval over a notebook, on a copy of priorlab where `wrong` stands for `right` in one file.

    The function it gives returns the finished process and the code cells that ran; with `last_tag`, none after that tag.
    """

    def run(stem, file, right, wrong, last_tag=None):
        shutil.copytree(ROOT / "priorlab", tmp_path / "priorlab", ignore=shutil.ignore_patterns("__pycache__"))
        (tmp_path / "data").symlink_to(ROOT / "data")
        patched = tmp_path / "priorlab" / file
        source = patched.read_text()
        assert source.count(right) == 1, f"the change of {right!r} no longer fits {file}"
        patched.write_text(source.replace(right, wrong))
        notebook = nbformat.read(ROOT / "notebooks" / f"{stem}.ipynb", as_version=4)
        if last_tag:
            last = max(i for i, cell in enumerate(notebook.cells) if last_tag in cell.metadata.get("tags", []))
            notebook.cells = notebook.cells[: last + 1]
        nbformat.write(notebook, tmp_path / f"{stem}.ipynb")
        done = subprocess.run(
            [sys.executable, "-m", "pytest", "-x", "-q", "--color=no", "-p", "no:cacheprovider", "--rootdir", str(tmp_path)]
            + ["--nbval", "--nbval-current-env", "--nbval-cell-timeout=120", f"{stem}.ipynb"],
            cwd=tmp_path,
            env={**os.environ, "PYTHONPATH": str(tmp_path)},
            capture_output=True,
            text=True,
            timeout=300,
            check=False,
        )
        return done, [cell for cell in notebook.cells if cell.cell_type == "code"]

    return run
