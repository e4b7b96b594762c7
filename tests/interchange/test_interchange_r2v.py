"""Flats as centre lines: a file written by hand."""

import numpy as np
import pytest

from priorlab.interchange.r2v import read_r2v

HUT = """0\t0\t100\t0\twall\t1\t1\t
100\t0\t100\t60\twall\t1\t1
0\t60\t100\t60\twall\t2\t1

20\t0\t40\t0\tdoor\t3\t1
10\t10\t30\t20\tkitchen\t1\t1
"""


def test_read_r2v_tells_lines_from_boxes(tmp_path):
    (tmp_path / "hut.txt").write_text(HUT)
    flat = read_r2v(tmp_path / "hut.txt")
    np.testing.assert_array_equal(flat.walls, [[0, 0, 100, 0], [100, 0, 100, 60]])
    np.testing.assert_array_equal(flat.rails, [[0, 60, 100, 60]])
    np.testing.assert_array_equal(flat.openings, [[20, 0, 40, 0]])
    assert flat.things == (("kitchen", (10, 10, 30, 20)),)
    assert repr(flat) == "LineFlat(hut: 3 walls, 1 openings, 1 rooms and fixtures)"


def test_read_r2v_without_openings(tmp_path):
    (tmp_path / "box.txt").write_text("0\t0\t9\t0\twall\t1\t1\n")
    assert read_r2v(tmp_path / "box.txt").openings.shape == (0, 4)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("0 0 9 0 wall 1 1\n", r"flat.txt, line 1: it must hold x1 y1 x2 y2 kind and a number, separated by tabs"),
        ("0\t0\t9\t0\twall\t1\t1\n0\tb\t9\t0\twall\t1\t1\n", "flat.txt, line 2: coordinates must be numbers"),
        ("0\tnan\t9\t0\twall\t1\t1\n", "flat.txt, line 1: coordinates must be finite"),
        ("0\t0\t9\t0\tdoor\t1\t1\n", "flat.txt: a flat must have at least one wall, got none"),
    ],
)
def test_read_r2v_says_what_is_wrong(tmp_path, text, sentence):
    (tmp_path / "flat.txt").write_text(text)
    with pytest.raises(ValueError, match=sentence):
        read_r2v(tmp_path / "flat.txt")


def test_read_r2v_of_no_file(tmp_path):
    with pytest.raises(FileNotFoundError, match="a flat must be a file, found none at"):
        read_r2v(tmp_path / "nothing.txt")


def test_read_r2v_of_no_text(tmp_path):
    (tmp_path / "flat.txt").write_bytes(b"\xff\xfe\x00\x81")
    with pytest.raises(ValueError, match="a flat must be text, got something else in"):
        read_r2v(tmp_path / "flat.txt")
