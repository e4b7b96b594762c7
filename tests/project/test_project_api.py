"""The public names: they stay as they are, they are imported lazily, and all of them exist."""

import importlib.util
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parent
HEAVY = ["matplotlib", "sklearn", "pymoo", "filterpy", "scipy", "ipywidgets", "anywidget", "jinja2", "IPython", "pandas"]


def test_public_api_is_the_snapshot():
    spec = importlib.util.spec_from_file_location("public_api", HERE / "public_api.py")
    public_api = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(public_api)
    assert public_api.public_api() == (HERE / "public_api.txt").read_text().rstrip("\n")


def test_import_loads_nothing_heavy():
    code = f"import sys, priorlab; print([name for name in {HEAVY} if name in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_import_of_the_records_loads_nothing_heavy():
    code = f"import sys, priorlab as pl; pl.Prior(); pl.Grid((9, 9)); print([name for name in {HEAVY} if name in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
