"""`priorlab run` on real drawings, where they are at hand (PRIORLAB_REAL_DATA)."""

import json
import os
from pathlib import Path

import pytest

from priorlab.cli import main

REAL = os.environ.get("PRIORLAB_REAL_DATA")
NAMES = ["cvcfp_c2", "cvcfp_c3", "cvcfp_c13", "cvcfp_c14", "mlstruct_f302_crop0", "mlstruct_f302_fifth"]


@pytest.mark.skipif(REAL is None, reason="PRIORLAB_REAL_DATA is not set")
@pytest.mark.parametrize("name", NAMES)
def test_run_says_what_it_found_in_a_real_drawing(name, tmp_path, capsys):
    drawing = Path(REAL) / "plans_real" / f"{name}.png"
    assert drawing.is_file()
    code = main(["run", str(drawing), "--out", str(tmp_path / "out")])
    numbers = json.loads((tmp_path / "out" / "numbers.json").read_text())
    assert code in (0, 3, 4)
    assert (code == 0) == (numbers["stopped"] is None)
    assert numbers["walls"]["wall_pixels"] > 0
    page = (tmp_path / "out" / "report.html").read_text()
    assert "No truth is known" in page and numbers["drawing"]["scale"].split(",")[0] in page
    print(f"{name}: {code}", capsys.readouterr().out.splitlines()[-3])
