"""What a user installs: the wheel holds the package, its types and its data, and the data is found there."""

import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from priorlab.core.shipped import data_folder

ROOT = Path(__file__).resolve().parents[2]
LOOK = "import priorlab.core.shipped as s; print(s.__file__); print(sorted(p.stem for p in s.data_folder().glob('*.toml')))"


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    folder = tmp_path_factory.mktemp("wheel")
    from hatchling.builders.wheel import WheelBuilder

    return Path(next(WheelBuilder(str(ROOT)).build(directory=str(folder), versions=["standard"])))


def test_data_is_found_in_a_checkout():
    assert data_folder() == ROOT / "data"


def test_data_is_found_when_installed_from_a_wheel(wheel, tmp_path):
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(tmp_path)
    done = subprocess.run([sys.executable, "-c", LOOK], cwd=tmp_path, capture_output=True, text=True, check=True)
    where, names = done.stdout.splitlines()
    assert Path(where).is_relative_to(tmp_path)
    assert names == str(sorted(path.stem for path in (ROOT / "data").glob("*.toml")))


def test_wheel_holds_types_and_templates(wheel):
    names = set(zipfile.ZipFile(wheel).namelist())
    assert {"priorlab/py.typed", "priorlab/__init__.pyi"} <= names
    shipped = {
        str(path.relative_to(ROOT))
        for path in (ROOT / "priorlab").rglob("*")
        if path.suffix in (".html", ".js", ".css", ".jinja")
    }
    assert shipped <= names


def test_missing_data_is_told(tmp_path):
    with pytest.raises(FileNotFoundError, match="shipped data"):
        data_folder(tmp_path / "priorlab")
