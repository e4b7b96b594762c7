"""Files of relations: what is read, and what is refused."""

import numpy as np
import pytest

from priorlab.interchange.relations import Relations, read_relations

LINE = "1216.63 1217.49 0.408 -0.016 0.0 0.0 0.0 -0.0696\n"


def test_read_relations_takes_the_plane(tmp_path):
    (tmp_path / "a.relations").write_text(f"# t1 t2 dx dy dz roll pitch yaw\n\n{LINE}3 2 1 2 0 0 0 3\n")
    relations = read_relations(tmp_path / "a.relations")
    np.testing.assert_array_equal(relations.stamps, [[1216.63, 1217.49], [3, 2]])
    np.testing.assert_array_equal(relations.steps, [[0.408, -0.016, -0.0696], [1, 2, 3]])
    assert repr(relations) == "Relations(2 steps)"


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (LINE + "1 2 3\n", "a relation must be eight finite numbers, got '1 2 3' in line 2"),
        (LINE + LINE.replace("0.408", "nan"), "eight finite numbers, .* in line 2"),
        (LINE.replace("0.408", "far"), "eight finite numbers, .* in line 1"),
        (LINE.replace("0.0 0.0 0.0", "0.0 0.2 0.0"), r"must stay in the plane .* got \[0.0, 0.2, 0.0\] in line 1"),
        ("# nothing\n", "at least one relation, got none"),
    ],
)
def test_read_relations_says_which_line_is_wrong(tmp_path, text, sentence):
    (tmp_path / "a.relations").write_text(text)
    with pytest.raises(ValueError, match=sentence):
        read_relations(tmp_path / "a.relations")


def test_relations_say_what_is_wrong_with_files_and_arrays(tmp_path):
    with pytest.raises(FileNotFoundError, match="found none"):
        read_relations(tmp_path / "a.relations")
    (tmp_path / "a.relations").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(ValueError, match="must be text"):
        read_relations(tmp_path / "a.relations")
    with pytest.raises(ValueError, match="stamps must be 1 pairs"):
        Relations([[1, 2], [3, 4]], [[0, 0, 0]])
