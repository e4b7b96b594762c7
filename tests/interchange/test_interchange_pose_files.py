"""Surveys from files: every kind holds the same poses, every mistake gets its sentence."""

import numpy as np
import pytest

from priorlab.core.building import Truth
from priorlab.interchange.pose_files import read_poses
from priorlab.interchange.trajectories import write_tum
from priorlab.robot.explore import explore

POSES = np.array([[1.5, 2.25, 0.0], [3.0, 4.5, np.pi / 2], [7.0, 1.0, 3 * np.pi / 2]])


@pytest.mark.parametrize("between", [",", ", ", ";", " ", "\t"])
@pytest.mark.parametrize("head", ["", "x;y;theta\n", "# a comment\n\n"])
def test_read_poses_reads_text_however_it_is_set_apart(tmp_path, between, head):
    lines = [between.join(repr(float(value)) for value in pose) for pose in POSES]
    (tmp_path / "survey.txt").write_text(head + "\n".join(lines) + "\n\n")
    assert (read_poses(tmp_path / "survey.txt") == POSES).all()


def test_read_poses_reads_numpy_and_tum_too(tmp_path):
    np.save(tmp_path / "a.npy", POSES)
    (tmp_path / "a.npy").rename(tmp_path / "survey.any")
    assert (read_poses(tmp_path / "survey.any") == POSES).all()
    from_tum = read_poses(write_tum(tmp_path / "survey.tum", POSES), metres_per_pixel=0.05)
    np.testing.assert_allclose(from_tum[:, :2], POSES[:, :2] / 0.05)
    np.testing.assert_allclose(np.exp(1j * from_tum[:, 2]), np.exp(1j * POSES[:, 2]))


def test_read_poses_turns_metres_into_pixels_and_leaves_the_heading(tmp_path):
    np.save(tmp_path / "a.npy", POSES)
    np.testing.assert_allclose(read_poses(tmp_path / "a.npy", 0.5), POSES * [2, 2, 1])


def test_a_survey_from_a_file_explores_like_the_array(tmp_path):
    walls = np.pad(np.zeros((8, 10), bool), 1, constant_values=True)
    (tmp_path / "a.csv").write_text("\ufeffx,y,theta\n" + "\n".join(",".join(map(str, pose)) for pose in POSES.tolist()))
    truth = Truth(walls, walls & False)
    assert (explore(truth, read_poses(tmp_path / "a.csv")).ranges == explore(truth, POSES).ranges).all()


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("1 2 0\n1 2\n", "a line must hold three finite numbers x, y, theta, got '1 2' in line 2"),
        ("1 2 0\n1 2 nan\n", "got '1 2 nan' in line 2"),
        ("x,y\n1,2\n", "got '1 2' in line 2"),
        ("1 2 0\n\n# so far\n1 two 0\n", "got '1 two 0' in line 4"),
        ("1,5;2,5;0\n", "got '1 5 2 5 0' in line 1"),
        ("1 2 90\n", "theta must be in radians, got 90 in pose 0: that looks like degrees"),
        ("", "the file must hold at least one pose x, y, theta, got none"),
        ("x y theta\n", "the file must hold at least one pose"),
        ("0 1 2 0 0 0 0 1\n", "metres_per_pixel must be given to read TUM text, which is in metres, got None"),
    ],
)
def test_read_poses_says_what_is_wrong_with_text(tmp_path, text, sentence):
    (tmp_path / "a.csv").write_text(text)
    with pytest.raises(ValueError, match=sentence):
        read_poses(tmp_path / "a.csv")


def test_read_poses_says_what_is_wrong_with_files(tmp_path):
    with pytest.raises(FileNotFoundError, match="the poses must be a file, found none at"):
        read_poses(tmp_path / "missing.csv")
    for array, sentence in (
        (np.zeros((4, 2)), r"poses must have shape \(N, 3\)"),
        (np.array([["a", "b", "c"]]), "must hold numbers, got <U1"),
        (np.array([[1, 2, {}]]), "must hold one array of numbers"),
        (np.array([[1, 2, np.inf]]), "poses must be finite numbers"),
    ):
        np.save(tmp_path / "a.npy", array, allow_pickle=True)
        with pytest.raises(ValueError, match=sentence):
            read_poses(tmp_path / "a.npy")
    (tmp_path / "a.npy").write_bytes(b"\x93NUMPY")
    with pytest.raises(ValueError, match="must hold one array of numbers"):
        read_poses(tmp_path / "a.npy")
    (tmp_path / "a.txt").write_bytes(b"\xff\xff\x00\x80")
    with pytest.raises(ValueError, match="must be text or a NumPy array"):
        read_poses(tmp_path / "a.txt")
    (tmp_path / "b.txt").write_text("1 2 0\n")
    with pytest.raises(ValueError, match="metres_per_pixel must be a finite number above 0, got 0"):
        read_poses(tmp_path / "b.txt", metres_per_pixel=0)
