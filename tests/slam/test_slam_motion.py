"""Algorithm 6.3 against a slow reading of it, one particle at a time; geometry against composed poses."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from priorlab.core.pose import compose, relative
from priorlab.slam.motion import motion_deviations, motion_parts, sample_motion
from priorlab.slam.parameters import TABLE_6_1, TUNED, Parameters

EXACT = Parameters(alphas=(0, 0, 0, 0))
angle = st.floats(-math.pi, math.pi)
pose = st.tuples(st.floats(-5, 5), st.floats(-5, 5), angle)


def slow_motion(poses, before, after, rng, alphas, noise, rotation_noise):
    """Algorithm 6.3 with loops, math and its printed signs."""

    def wrap(a):
        return math.atan2(math.sin(a), math.cos(a))

    def small(a):
        return min(abs(a), math.pi - abs(a)) if rotation_noise == "symmetric" else a

    a1, a2, a3, a4 = alphas
    dx, dy = after[0] - before[0], after[1] - before[1]
    trans = math.sqrt(dx * dx + dy * dy)
    rot1 = wrap(math.atan2(dy, dx) - before[2]) if trans >= 0.001 else 0.0
    rot2 = wrap(after[2] - before[2] - rot1)
    out = []
    for x, y, theta in poses:
        drawn = []
        for part, b in (
            (rot1, a1 * small(rot1) ** 2 + a2 * trans**2),
            (trans, a3 * trans**2 + a4 * small(rot1) ** 2 + a4 * small(rot2) ** 2),
            (rot2, a1 * small(rot2) ** 2 + a2 * trans**2),
        ):
            drawn.append(part - rng.standard_normal() * (math.sqrt(b) if noise == "variance" else b))
        turn1, way, turn2 = drawn
        out.append((x + way * math.cos(theta + turn1), y + way * math.sin(theta + turn1), theta + turn1 + turn2))
    return np.array(out)


@pytest.mark.parametrize("noise", ["variance", "std"])
@pytest.mark.parametrize("rotation_noise", ["symmetric", "literal"])
def test_sample_motion_agrees_with_a_slow_loop(noise, rotation_noise):
    rng = np.random.default_rng(3)
    parameters = Parameters(alphas=(0.1, 0.2, 0.3, 0.4), noise=noise, rotation_noise=rotation_noise)
    for _ in range(20):
        before, after = rng.normal(size=3), rng.normal(size=3)
        poses = rng.normal(size=(7, 3))
        seed = int(rng.integers(1_000_000))
        fast = sample_motion(poses, before, after, np.random.default_rng(seed), parameters)
        slow = slow_motion(poses, before, after, np.random.default_rng(seed), parameters.alphas, noise, rotation_noise)
        assert np.allclose(fast[:, :2], slow[:, :2], atol=1e-12)
        assert np.allclose(np.exp(1j * fast[:, 2]), np.exp(1j * slow[:, 2]), atol=1e-12)
        assert (np.abs(fast[:, 2]) <= math.pi).all()


@given(before=pose, after=pose, particle=pose)
def test_sample_motion_without_noise_carries_the_step_along(before, after, particle):
    step = relative(before, after)
    moved = sample_motion(np.array([particle]), before, after, np.random.default_rng(0), EXACT)[0]
    expected = compose(particle, step)
    assert np.allclose(moved[:2], expected[:2], atol=2.1e-3)  # below 1 mm the direction is dropped
    assert math.isclose(math.cos(moved[2] - expected[2]), 1.0, abs_tol=1e-9)


def test_sample_motion_standing_still_moves_nobody():
    poses = np.random.default_rng(0).normal(size=(50, 3))
    moved = sample_motion(poses, [1, 2, 3], [1, 2, 3], np.random.default_rng(1), TABLE_6_1)
    assert np.allclose(moved, poses, atol=1e-12)


def test_sample_motion_spreads_by_the_variances_named():
    parameters = Parameters(alphas=(0.04, 0.01, 0.09, 0.0))
    moved = sample_motion(np.zeros((40_000, 3)), [0, 0, 0], [2, 0, 0], np.random.default_rng(0), parameters)
    assert np.hypot(moved[:, 0], moved[:, 1]).std() == pytest.approx(0.3 * 2, rel=0.02)  # sqrt(alpha_3) trans
    assert np.arctan2(moved[:, 1], moved[:, 0])[moved[:, 0] > 0].std() == pytest.approx(0.1 * 2, rel=0.02)  # sqrt(alpha_2) trans
    assert moved[:, 2].std() == pytest.approx(np.sqrt(2) * 0.1 * 2, rel=0.02)  # two turns


def test_motion_noise_of_a_turn_on_the_spot_is_not_that_of_half_a_turn():
    backwards = motion_parts([0, 0, 0], [-0.002, 0, 0.1])  # the wheels slip back 2 mm while turning
    assert abs(backwards[0]) == pytest.approx(math.pi)
    tenth = replace(TUNED, alphas=(0.01,) * 4)
    symmetric = motion_deviations(*backwards, tenth)
    literal = motion_deviations(*backwards, replace(tenth, rotation_noise="literal"))
    assert symmetric[0] < 0.001 and symmetric[2] < 0.011
    assert literal[0] > 0.3  # sqrt(0.01 pi^2): 18 degrees for nothing


def test_table_6_1_reads_as_metres_of_noise_per_step():
    as_variance = motion_deviations(0.0, 0.1, 0.0, TABLE_6_1)
    as_deviation = motion_deviations(0.0, 0.1, 0.0, replace(TABLE_6_1, noise="std"))
    assert as_variance[1] == pytest.approx(math.sqrt(0.2) * 0.1)  # 45 mm in a step of 100 mm
    assert as_deviation[1] == pytest.approx(0.002)
