"""Surveys drawn from a dense one: on its lanes, at equal steps, looking to both sides by turns."""

import numpy as np
import pytest

from priorlab.core.survey import look_around
from priorlab.study.surveys import lanes_of, part_of, thinned

SEGMENTS = [((10.5, 5.5), (90.5, 5.5)), ((10.5, 25.5), (90.5, 25.5)), ((20.5, 3.5), (20.5, 63.5)), ((60.5, 3.5), (60.5, 63.5))]


def dense():
    """Two horizontal and two vertical lanes, a pose every 2 px."""
    return look_around(SEGMENTS, 2.0)


def test_lanes_are_the_segments_they_were_made_of():
    lanes = lanes_of(dense())
    assert [tuple(lane[0, :2]) for lane in lanes] == [start for start, _ in SEGMENTS]
    assert [tuple(lane[-1, :2]) for lane in lanes] == [end for _, end in SEGMENTS]


def test_a_lane_that_goes_on_in_line_after_a_gap_is_another_lane():
    survey = look_around([((0, 0), (10, 0)), ((20, 0), (30, 0))], 2.0)
    assert [len(lane) for lane in lanes_of(survey)] == [6, 6]


@pytest.mark.parametrize("seed", range(5))
def test_thinned_keeps_equal_steps_and_turns_from_side_to_side(seed):
    every = 6
    survey = thinned(dense(), every, np.random.default_rng(seed))
    known = {tuple(pose) for pose in dense()[:, :2].round(6).tolist()}
    assert {tuple(pose) for pose in survey[:, :2].round(6).tolist()} <= known
    for start, end in SEGMENTS:
        axis = 0 if start[1] == end[1] else 1
        own = survey[np.abs(survey[:, 1 - axis] - start[1 - axis]) < 1e-9]
        own = own[np.isclose(np.abs(np.cos(own[:, 2])), axis)]  # on a horizontal lane it looks up and down
        assert np.allclose(np.diff(own[:, axis]), 2.0 * every)
        assert np.allclose(np.abs(np.diff(own[:, 2])) % (2 * np.pi), np.pi)


def test_thinned_by_one_keeps_all_poses_and_on_average_a_share():
    rng = np.random.default_rng(0)
    assert len(thinned(dense(), 1, rng)) == len(dense())
    mean = np.mean([len(thinned(dense(), 5, rng)) for _ in range(300)])
    assert mean == pytest.approx(len(dense()) / 5, rel=0.02)


def test_thinned_depends_on_the_seed_alone():
    one, same, other = (thinned(dense(), 4, np.random.default_rng(seed)) for seed in (1, 1, 2))
    assert np.array_equal(one, same) and not np.array_equal(one[: len(other)], other[: len(one)])
    with pytest.raises(ValueError, match="every must be a whole number of at least 1, got 0"):
        thinned(dense(), 0, np.random.default_rng(0))


def test_part_of_is_the_nearest_share():
    survey = dense()
    part = part_of(survey, 0.25, np.random.default_rng(4))
    assert len(part) == round(0.25 * len(survey))
    rest = np.array([pose for pose in survey.tolist() if pose not in part.tolist()])
    farthest = [np.hypot(*(part[:, :2] - pose[:2]).T).max() for pose in part]
    middle = part[int(np.argmin(farthest)), :2]
    assert np.hypot(*(part[:, :2] - middle).T).max() < np.hypot(*(rest[:, :2] - middle).T).max()
    assert np.array_equal(part_of(survey, 1.0, np.random.default_rng(0)), survey)
    with pytest.raises(ValueError, match=r"share must lie in \(0, 1\], got 0"):
        part_of(survey, 0, np.random.default_rng(0))


def test_surveys_refuse_a_seed_in_place_of_a_generator():
    poses = [[0.0, 0.0, np.pi / 2], [2.0, 0.0, -np.pi / 2], [4.0, 0.0, np.pi / 2]]
    for draw in (lambda: thinned(poses, 2, 7), lambda: part_of(poses, 0.5, 7)):
        with pytest.raises(ValueError, match="rng must be a numpy Generator.*got 7"):
            draw()
