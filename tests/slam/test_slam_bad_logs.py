"""Whatever a log holds, the filter says what is wrong in one sentence or gives finite poses and maps; it never gives nan."""

import warnings

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap
from priorlab.core.readings import RobotLog
from priorlab.core.sensor import Scanner
from priorlab.slam.fastslam import FastSLAM

SCANNER = Scanner(n_beams=4)


def small_map():
    """A room of 4 x 3 m with a wall all round."""
    walls = np.zeros((30, 40), dtype=bool)
    walls[:2], walls[-2:], walls[:, :2], walls[:, -2:] = True, True, True, True
    return GridMap(np.where(walls, -1.0, 0.94), Grid(walls.shape, 1, 0.1))


anything = st.floats(allow_nan=True, allow_infinity=True)
usual_range = st.one_of(st.floats(0, 4), st.sampled_from([np.nan, np.inf, 0.0, 3.0, 1e308, 5e-324]))
ranges = st.one_of(*[st.lists(usual_range, min_size=4, max_size=4)] * 9, st.lists(anything, min_size=4, max_size=4))
usual = st.tuples(st.floats(-0.3, 0.3), st.floats(-0.3, 0.3), st.floats(-1, 1))
wild = st.tuples(anything, anything, anything)
far = st.tuples(*[st.floats(-1e5, 1e5)] * 3)
scans = st.lists(st.tuples(st.one_of(*[usual] * 6, far, far, wild), ranges), min_size=1, max_size=6)
alphas = st.tuples(*[st.one_of(st.just(0.0), st.floats(0, 1e4))] * 4)
settings_of_filter = st.fixed_dictionaries(
    {
        "localize_in": st.sampled_from(["static", "updated", "own"]),
        "alphas": alphas,
        "temper": st.floats(1e-6, 1.0),
        "lam": st.floats(0, 1),
        "start_variances": st.tuples(*[st.floats(0, 1e3)] * 3),
        "estimate": st.sampled_from(["cluster", "mean", "best"]),
        "resampling": st.sampled_from(["systematic", "stratified", "multinomial"]),
        "free_on_no_return": st.booleans(),
        "lag_m": st.floats(0, 2),
        "sigma_hit_m": st.floats(1e-3, 10.0),
        "z_random": st.floats(1e-6, 1 - 1e-6),
    }
)


def test_fastslam_says_when_the_wheels_tell_of_a_drive_round_the_world():
    log = RobotLog(np.array([[0, 0, 0], [2e6, 0, 0]]), np.ones((2, 4)), SCANNER.bearings, SCANNER, np.array([2.0, 1.5, 0.0]))
    with pytest.raises(ValueError, match=r"odometry must stay within 1e.06 m, got poses 2e.06 m apart"):
        FastSLAM().run(small_map(), log, np.random.default_rng(0))


@given(scans, st.one_of(*[st.just((2.0, 1.5, 0.0))] * 5, wild), settings_of_filter)
@settings(max_examples=80, deadline=None)
@example([((1e300, 0.0, 0.0), [1.0] * 4)], (2.0, 1.5, 0.0), {})
@example([((1e12, -1e12, 1e9), [1.0] * 4), ((0.0, 0.0, 0.0), [1.0] * 4)], (2.0, 1.5, 0.0), {"localize_in": "updated"})
@example([((0.0, 0.0, 0.0), [1.0] * 4), ((1e8, 0.0, 0.0), [1.0] * 4)], (2.0, 1.5, 0.0), {"localize_in": "own"})
@example([((0.0, 0.0, 0.0), [1.0] * 4)], (0.0, 1.7e307, 0.0), {})
def test_fastslam_gives_finite_numbers_or_a_sentence(steps, start, changes):
    fast_slam = FastSLAM(**{"particle_limits": (5, 20), **changes})
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            poses, found = (np.array([step[part] for step in steps], dtype=float) for part in (0, 1))
            with np.errstate(all="ignore"):
                odometry = np.cumsum(poses, axis=0)
            log = RobotLog(odometry, found, SCANNER.bearings, SCANNER, np.array(start))
            run = fast_slam.run(small_map(), log, np.random.default_rng(0))
        except ValueError as told:
            assert any(f"{name} must" in str(told) for name in ("odometry", "ranges", "start"))
            return
    for numbers in (run.trajectory, run.map.log_odds, run.ess, run.sample):
        assert np.isfinite(numbers).all()
    assert len(run) == len(steps)
