"""TUM text: the quaternion is checked against the rotation that it stands for."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from priorlab.interchange.trajectories import read_tum, write_tum

POSES = np.array([[0.0, 0.0, 0.0], [1.5, -2.0, np.pi / 2], [3.0, 0.25, -3.0]])


def test_write_tum_writes_eight_numbers_a_line(tmp_path):
    path = write_tum(tmp_path / "a.tum", POSES, stamps=[10, 10.5, 11])
    rows = [line.split() for line in path.read_text().splitlines() if not line.startswith("#")]
    assert [len(row) for row in rows] == [8, 8, 8]
    stamp, x, y, z, qx, qy, qz, qw = map(float, rows[1])
    assert (stamp, x, y, z, qx, qy) == (10.5, 1.5, -2.0, 0, 0, 0)
    rotation = np.array([[1 - 2 * qz**2, -2 * qz * qw], [2 * qz * qw, 1 - 2 * qz**2]])
    np.testing.assert_allclose(rotation @ [1, 0], [0, 1], atol=1e-9)  # a quarter turn to the left


def test_write_tum_is_what_evo_asks_for(tmp_path):
    """Eight columns parted by one blank, no header but comments, unit quaternions (0, 0, z, w), 1e-9 m kept.

    evo itself was asked once: `evo_ape tum` and `evo_rpe tum`, without -a, gave the ATE and the RPE of `Run` to all six digits.
    """
    rng = np.random.default_rng(4)
    poses = np.column_stack([rng.uniform(-50, 50, (200, 2)), rng.uniform(-7, 7, 200)])
    path = write_tum(tmp_path / "a.tum", poses)
    rows = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    assert all(line.count(" ") == 7 and line == line.strip() for line in rows)
    stamps, x, y, z, qx, qy, qz, qw = np.loadtxt(path).T
    assert (np.diff(stamps) > 0).all() and not (z.any() or qx.any() or qy.any())
    np.testing.assert_allclose(qz**2 + qw**2, 1, atol=1e-11)
    np.testing.assert_allclose(np.column_stack([x, y]), poses[:, :2], atol=1e-9)
    ahead = np.column_stack([1 - 2 * qz**2, 2 * qz * qw])  # the first column of the quaternion's rotation matrix
    np.testing.assert_allclose(ahead, np.column_stack([np.cos(poses[:, 2]), np.sin(poses[:, 2])]), atol=1e-10)


@settings(max_examples=40, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(poses=arrays(float, st.tuples(st.integers(0, 6), st.just(3)), elements=st.floats(-100, 100)))
def test_read_tum_reads_what_was_written(tmp_path, poses):
    stamps, again = read_tum(write_tum(tmp_path / "a.tum", poses, force=True))
    np.testing.assert_array_equal(stamps, np.arange(len(poses)))
    np.testing.assert_allclose(again[:, :2], poses[:, :2], atol=1e-8)
    np.testing.assert_allclose(np.exp(1j * again[:, 2]), np.exp(1j * poses[:, 2]), atol=1e-9)
    assert (again[:, 2] >= -np.pi).all() and (again[:, 2] < np.pi).all()


def test_read_tum_accepts_unnormalized_quaternions_height_and_comments(tmp_path):
    (tmp_path / "a.tum").write_text("# a comment\n\n5 1 2 0.7 0 0 2 2\n")
    stamps, poses = read_tum(tmp_path / "a.tum")
    assert stamps.tolist() == [5]
    np.testing.assert_allclose(poses, [[1, 2, np.pi / 2]])


@pytest.mark.parametrize("line", ["1 2 3", "0 0 0 0 0 0 0 one", "0 0 0 0 0 0 0 nan", "0 0 0 0 0 0 0 0", "0 0 0 0 0.5 0 0 0.8"])
def test_read_tum_says_which_line_is_wrong(tmp_path, line):
    (tmp_path / "a.tum").write_text(f"0 0 0 0 0 0 0 1\n{line}\n")
    with pytest.raises(ValueError, match="in line 2"):
        read_tum(tmp_path / "a.tum")


def test_tum_says_what_is_wrong_with_files_and_arrays(tmp_path):
    with pytest.raises(FileNotFoundError, match="found none"):
        read_tum(tmp_path / "missing.tum")
    (tmp_path / "a.tum").write_bytes(b"\xff\xff\x00")
    with pytest.raises(ValueError, match="must be text"):
        read_tum(tmp_path / "a.tum")
    with pytest.raises(FileExistsError, match="exists already"):
        write_tum(tmp_path / "a.tum", POSES)
    with pytest.raises(ValueError, match="stamps must be 3 finite numbers"):
        write_tum(tmp_path / "b.tum", POSES, stamps=[1, 2])
    with pytest.raises(ValueError, match="poses must be finite"):
        write_tum(tmp_path / "b.tum", [[0, 0, np.nan]])
