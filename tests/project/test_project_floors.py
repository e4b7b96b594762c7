"""The floors of the house: an import goes down, never up, never sideways between siblings."""

import ast
from pathlib import Path

import pytest

PACKAGE = Path(__file__).resolve().parents[2] / "priorlab"
FLOORS = [
    {"core"},
    {"drawing", "buildings", "robot", "interchange"},
    {"mapping"},
    {"optimize", "slam"},
    {"pipeline"},
    {"plot", "study"},
    {"figures", "report", "widgets"},
    {"course"},
    {"cli"},
]
FLOOR_OF = {room: number for number, rooms in enumerate(FLOORS) for room in rooms}
MODULES = sorted(path for path in PACKAGE.rglob("*.py") if path.parent != PACKAGE or path.stem not in ("__init__", "__main__"))


def room_of(path: Path) -> str:
    """The first name below priorlab/: a folder, or a file that stands alone."""
    return path.relative_to(PACKAGE).parts[0].removesuffix(".py")


def imported_rooms(source: str) -> set[str]:
    """Rooms of priorlab that a module imports, wherever in the file; the package itself counts as '(all)'."""
    names = []
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            names += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, "inside priorlab imports are absolute"
            names += [f"{node.module}.{alias.name}" for alias in node.names] if node.module == "priorlab" else [node.module]
    ours = [name.split(".") for name in names if name and name.split(".")[0] == "priorlab"]
    return {parts[1] if len(parts) > 1 else "(all)" for parts in ours}


def broken_arrows(room: str, imported: set[str]) -> set[str]:
    """The imports that go up or sideways."""
    return {other for other in imported - {room} if FLOOR_OF.get(other, len(FLOORS)) >= FLOOR_OF[room]}


def test_every_room_has_a_floor():
    assert {room_of(path) for path in MODULES} <= set(FLOOR_OF)


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(PACKAGE)))
def test_imports_go_down(path):
    assert broken_arrows(room_of(path), imported_rooms(path.read_text())) == set()


@pytest.mark.parametrize(
    ("room", "source"),
    [
        ("core", "from priorlab.drawing.corners import detect_corners"),  # up
        ("slam", "def f():\n    from priorlab.optimize import sweep"),  # sideways, hidden in a function
        ("mapping", "import priorlab as pl"),  # everything
        ("drawing", "from priorlab import robot"),
    ],
)
def test_broken_arrows_are_found(room, source):
    assert broken_arrows(room, imported_rooms(source))


def test_floors_of_one_file_are_short():
    too_long = {path.name: n for path in MODULES if (n := len(path.read_text().splitlines())) > 400}
    assert too_long == {}
