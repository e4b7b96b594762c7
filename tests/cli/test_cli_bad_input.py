"""Bad input: exit code 2, one sentence on stderr, no traceback, nothing left behind."""

import os
import signal
import subprocess
import sys

import cv2
import numpy as np
import pytest

from priorlab.cli import main
from priorlab.core.files import MAX_PIXELS


def said_for(capsys, *arguments) -> tuple[int, str]:
    """Exit code and what was said on stderr."""
    try:
        code = main([str(argument) for argument in arguments])
    except SystemExit as left:  # argparse
        code = left.code
    return code, capsys.readouterr().err


@pytest.fixture
def room(tmp_path):
    """A drawing that would do: one room."""
    image = np.full((80, 100), 255, dtype=np.uint8)
    cv2.rectangle(image, (10, 10), (90, 70), 0, 4)
    path = tmp_path / "room.png"
    cv2.imwrite(str(path), image)
    return path


def huge_png(path):
    """The header of a PNG of more than 200 megapixels, and nothing behind it."""
    side = int(np.sqrt(MAX_PIXELS)) + 10
    header = side.to_bytes(4, "big") * 2 + bytes([8, 0, 0, 0, 0])
    import zlib

    chunk = b"IHDR" + header
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + len(header).to_bytes(4, "big") + chunk + zlib.crc32(chunk).to_bytes(4, "big"))
    path.write_bytes(path.read_bytes() + b"\x00\x00\x00\x00IDAT" + zlib.crc32(b"IDAT").to_bytes(4, "big"))


def write_bad(kind, path):
    """A file that is no drawing."""
    one_colour = np.full((40, 40), 255, dtype=np.uint8)
    if kind == "not an image":
        path.write_text("this is no image")
    elif kind == "empty file":
        path.write_bytes(b"")
    elif kind == "one colour":
        cv2.imwrite(str(path), one_colour)
    elif kind == "transparent":  # black ink that nobody sees: over white nothing is left
        cv2.imwrite(str(path), np.zeros((40, 40, 4), dtype=np.uint8))
    elif kind == "one pixel":
        cv2.imwrite(str(path), one_colour[:1, :1])
    elif kind == "too large":
        huge_png(path)
    elif kind == "cut off":
        noise = np.random.default_rng(0).integers(0, 256, (60, 60), dtype=np.uint8)
        path.write_bytes(cv2.imencode(".png", noise)[1].tobytes()[:1000])
    elif kind == "a folder":
        path.mkdir()


@pytest.mark.parametrize(
    ("kind", "words"),
    [
        ("not an image", "image"),
        ("empty file", "empty"),
        ("one colour", "one colour"),
        ("transparent", "one colour"),
        ("one pixel", "1 x 1"),
        ("too large", "200 megapixels"),
        ("cut off", "broken or cut-off"),
        ("a folder", "folder"),
        ("nothing there", "nothing"),
    ],
)
def test_run_refuses_what_is_no_drawing(kind, words, tmp_path, capsys):
    path = tmp_path / "drawing.png"
    write_bad(kind, path)
    code, said = said_for(capsys, "run", path, "--out", tmp_path / "out")
    assert code == 2
    assert words in said and said.startswith("priorlab: ")
    assert said.count("\n") == 1 and "Traceback" not in said
    assert sorted(item.name for item in tmp_path.iterdir()) in (["drawing.png"], [])


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--p-wall", "0"], ["p_wall", "between 0 and 1", "0"]),
        (["--p-space", "1.2"], ["p_space", "between 0 and 1", "1.2 x 0.9 = 1.08"]),
        (["--cell-size", "500"], ["--cell-size", "100 x 80", "500"]),
        (["--cell-size", "-1"], ["--cell-size", "above 0", "-1"]),
        (["--cell-size", "nan"], ["--cell-size", "nan"]),
        (["--metres-per-pixel", "0"], ["--metres-per-pixel", "above 0", "0"]),
        (["--metres-per-pixel", "inf"], ["--metres-per-pixel", "inf"]),
        (["--seed", "-3"], ["seed", "-3"]),
        (["--seed", "many"], ["--seed", "many"]),
        (["--method", "magic"], ["--method", "magic"]),
    ],
)
def test_run_refuses_a_wrong_option(options, words, room, tmp_path, capsys):
    code, said = said_for(capsys, "run", room, "--out", tmp_path / "out", *options)
    assert code == 2
    assert all(word in said for word in words), said
    assert said.count("\n") == 1
    assert [item.name for item in tmp_path.iterdir()] == ["room.png"]


def test_run_needs_a_place(room, capsys):
    code, said = said_for(capsys, "run", room)
    assert code == 2 and "--out" in said and said.count("\n") == 1


def test_run_overwrites_nothing_and_says_so_before_it_computes(room, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("priorlab.pipeline.run_pipeline", lambda *_, **__: pytest.fail("it computed"))
    out = tmp_path / "out"
    out.mkdir()
    (out / "mine.txt").write_text("mine")
    code, said = said_for(capsys, "run", room, "--out", out)
    assert code == 2 and "exists already" in said and "--force" in said
    assert (out / "mine.txt").read_text() == "mine"


@pytest.mark.parametrize("place", [".", ".."])
def test_force_never_removes_the_drawing(place, room, tmp_path, capsys, monkeypatch):
    (tmp_path / "below").mkdir()
    monkeypatch.chdir(tmp_path if place == "." else tmp_path / "below")
    code, said = said_for(capsys, "run", room, "--out", place, "--force")
    assert code == 2 and "must not hold" in said and "--force would remove it" in said and room.exists()


def test_run_says_at_once_that_a_place_cannot_be_written(room, tmp_path, capsys):
    (tmp_path / "a_file").write_text("mine")
    code, said = said_for(capsys, "run", room, "--out", tmp_path / "a_file" / "out")
    assert code == 2 and "must lie where one can write" in said
    assert (tmp_path / "a_file").read_text() == "mine"


def test_demo_names_the_nearest_building(tmp_path, capsys):
    code, said = said_for(capsys, "demo", "--building", "smal_flat", "--out", tmp_path / "out")
    assert code == 2 and "did you mean 'small_flat'" in said and said.count("\n") == 1
    assert not (tmp_path / "out").exists()


def test_figures_names_the_nearest_figure(tmp_path, capsys):
    code, said = said_for(capsys, "figures", "fig-2-99", "--out", tmp_path / "out")
    assert code == 2 and "did you mean 'fig-2-9'" in said
    assert not (tmp_path / "out").exists()


def test_without_a_command_the_help_is_named(capsys):
    code, said = said_for(capsys)
    assert code == 2 and "--help" in said and said.count("\n") == 1


def test_version_is_told(capsys):
    with pytest.raises(SystemExit) as left:
        main(["--version"])
    assert left.value.code == 0
    assert capsys.readouterr().out.split()[0] == "priorlab"


def test_control_c_says_one_line_and_leaves_nothing(tmp_path):
    out = tmp_path / "out"
    process = subprocess.Popen(
        [sys.executable, "-m", "priorlab.cli", "demo", "--building", "small_flat", "--out", str(out)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | {"PYTHONUNBUFFERED": "1"},
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # a CI in the background is deaf to Ctrl-C
    )
    while "walls" not in process.stdout.readline():  # it has begun
        assert process.poll() is None
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=30)
    assert process.returncode == 130
    assert said == "priorlab: interrupted; nothing was left half written\n"
    assert list(tmp_path.iterdir()) == []
