"""What the notebooks of chapter 6 print does not hang on the last digits of the particles' weights."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.mutant

ROOT = Path(__file__).parents[2]
RIGHT = "        return weights / weights.sum()\n"
JITTERED = """        noise = np.random.default_rng(len(weights)).uniform(-1.0, 1.0, len(weights))
        weights = weights * (1.0 + {size:g} * noise)
        return weights / weights.sum()
"""


def strict(stem, folder):
    """nbval over a copy of a notebook, with the copy of priorlab beside it."""
    shutil.copy(ROOT / "notebooks" / f"{stem}.ipynb", folder)
    return subprocess.run(
        [sys.executable, "-m", "pytest", "-x", "-q", "--color=no", "-p", "no:cacheprovider", "--rootdir", str(folder)]
        + ["--nbval", "--nbval-current-env", "--nbval-cell-timeout=120", f"{stem}.ipynb"],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(folder)},
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )


JITTERS = [("08_localization", 1e-12, 0), ("08_localization", 1e-2, 1), ("09_fastslam", 1e-12, 0)]


@pytest.mark.parametrize(("stem", "size", "code"), JITTERS)
def test_notebook_survives_a_jitter_of_the_weights(stem, size, code, tmp_path):
    shutil.copytree(ROOT / "priorlab", tmp_path / "priorlab", ignore=shutil.ignore_patterns("__pycache__"))
    (tmp_path / "data").symlink_to(ROOT / "data")
    particles = tmp_path / "priorlab" / "slam" / "particles.py"
    source = particles.read_text()
    assert source.count(RIGHT) == 1, "the jitter no longer fits slam/particles.py"
    particles.write_text(source.replace(RIGHT, JITTERED.format(size=size)))
    run = strict(stem, tmp_path)
    assert run.returncode == code, run.stdout  # and a jitter of 1 % is noticed: the patch does arrive
