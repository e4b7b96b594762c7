"""Relations between poses: trajectories by hand whose errors one sees, and an oracle that multiplies matrices."""

import os
from pathlib import Path

import numpy as np
import pytest

from priorlab.interchange.carmen import read_carmen
from priorlab.interchange.relations import Relations, read_relations
from priorlab.slam.relations import relation_errors

SQUARE = np.array([[0, 0, 0], [1, 0, np.pi / 2], [1, 1, np.pi], [0, 1, -np.pi / 2], [0, 0, 0]], dtype=float)
"""Round a square metre, turning left at each corner, a second a side."""


def matrix(pose):
    x, y, theta = pose
    return np.array([[np.cos(theta), -np.sin(theta), x], [np.sin(theta), np.cos(theta), y], [0, 0, 1]])


@pytest.fixture
def sides():
    """The four sides of the square as relations, and the way right across it."""
    return Relations([[0, 1], [1, 2], [2, 3], [3, 4], [0, 2]], [[1, 0, np.pi / 2]] * 4 + [[1, 1, np.pi]])


def test_relation_errors_of_the_true_path_are_zero_in_every_frame(sides):
    turn = matrix([40, -7, 2.5])
    moved = np.array([[*(turn @ [x, y, 1])[:2], theta + 2.5] for x, y, theta in SQUARE])
    for path in (SQUARE, moved):
        errors = relation_errors(path, np.arange(5), sides)
        np.testing.assert_allclose(errors.translation_m, 0, atol=1e-12)
        np.testing.assert_allclose(errors.rotation, 0, atol=1e-12)
        assert len(errors) == errors.n_relations == 5


def test_relation_errors_by_hand(sides):
    path = SQUARE.copy()
    path[2, 0] += 0.3  # the second corner lies 30 cm too far right: two sides and the way across are wrong
    path[4, 2] = 0.2  # and at the end it looks 0.2 rad too far left
    errors = relation_errors(path, np.arange(5), sides)
    np.testing.assert_allclose(errors.translation_m, [0, 0.3, 0.3, 0, 0.3], atol=1e-12)
    np.testing.assert_allclose(errors.rotation, [0, 0, 0, 0.2, 0], atol=1e-12)
    assert errors.mean_square_m2 == pytest.approx(3 * 0.09 / 5) and errors.mean_square_rotation == pytest.approx(0.04 / 5)


def test_relation_errors_agree_with_matrices():
    rng = np.random.default_rng(5)
    path = np.column_stack([rng.uniform(-5, 5, (30, 2)), rng.uniform(-np.pi, np.pi, 30)])
    pairs = rng.integers(0, 30, (50, 2))
    steps = np.column_stack([rng.uniform(-5, 5, (50, 2)), rng.uniform(-np.pi, np.pi, 50)])
    errors = relation_errors(path, np.arange(30) / 4, Relations(pairs / 4 + 77, steps), behind_s=77)
    for (i, j), step, along, turn in zip(pairs, steps, errors.translation_m, errors.rotation, strict=True):
        left = np.linalg.inv(matrix(step)) @ np.linalg.inv(matrix(path[i])) @ matrix(path[j])
        assert along == pytest.approx(np.linalg.norm(left[:2, 2]), abs=1e-9)
        assert np.cos(turn) == pytest.approx(left[0, 0], abs=1e-9) and 0 <= turn <= np.pi


def test_relation_errors_between_two_poses_the_path_is_straight():
    path = [[0, 0, 3.0], [2, 0, -3.0]]  # turns through pi, not through 0
    halfway = Relations([[0, 0.5]], [[np.cos(3.0), -np.sin(3.0), np.pi - 3.0]])
    errors = relation_errors(path, [0, 1], halfway)
    np.testing.assert_allclose([errors.translation_m[0], errors.rotation[0]], 0, atol=1e-12)


def test_relation_errors_leave_out_what_the_trajectory_does_not_cover(sides):
    errors = relation_errors(SQUARE[:3], [0, 1, 2], sides)
    assert len(errors) == 3 and errors.n_relations == 5
    gap = relation_errors(SQUARE, [0, 1, 2, 10, 11], sides)  # nobody knows where it was from 2 to 10 s
    assert len(gap) == 3


@pytest.mark.parametrize(
    ("path", "stamps", "sentence"),
    [
        (SQUARE, [0, 1], "stamps must be 5 finite numbers that rise"),
        (SQUARE, [0, 1, 2, 1, 4], "stamps must be 5 finite numbers that rise"),
        (SQUARE, [0, 1, 2, 3, np.nan], "stamps must be 5 finite numbers that rise"),
        (SQUARE, np.arange(5) + 100, "at least one relation must lie within the trajectory, from 100 to 104 s"),
        (SQUARE[:1], [0], "at least two poses, got 1"),
        (SQUARE * np.nan, np.arange(5), "trajectory must be finite"),
    ],
)
def test_relation_errors_say_what_is_wrong(sides, path, stamps, sentence):
    with pytest.raises(ValueError, match=sentence):
        relation_errors(path, stamps, sides)


@pytest.mark.skipif("PRIORLAB_REAL_DATA" not in os.environ, reason="PRIORLAB_REAL_DATA is not set")
def test_relation_errors_real_corrected_poses():
    folder = Path(os.environ["PRIORLAB_REAL_DATA"]) / "robot_logs"
    log = read_carmen(folder / "freiburg-079-corrected.log.gz")
    errors = relation_errors(log.truth, log.stamps, read_relations(folder / "fr079.relations"), behind_s=1211.36)
    assert errors.translation_m.mean() == pytest.approx(0.050, abs=0.002)  # as the page beside the data has it
    assert errors.translation_m.std() == pytest.approx(0.032, abs=0.002) and len(errors) > 1670
