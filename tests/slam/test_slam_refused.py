"""What is of the wrong kind, or so large that no number could hold its square, is told in one sentence and never gone on with."""

import re
import warnings

import numpy as np
import pytest

import priorlab as pl
from priorlab.core.building import World
from priorlab.robot.drive import true_path
from priorlab.robot.odometry import report_odometry
from priorlab.robot.rays import cast_rays
from priorlab.slam.counting import counted_map
from priorlab.slam.estimate import estimate_pose
from priorlab.slam.likelihood_field import LikelihoodField
from priorlab.slam.localization import choose, predict, weigh
from priorlab.slam.map_update import see_cells
from priorlab.slam.matched_mapping import Slip
from priorlab.slam.motion import motion_parts, sample_motion
from priorlab.slam.parameters import Parameters
from priorlab.slam.particles import Particles, start_particles
from priorlab.slam.resampling import resample
from priorlab.slam.run_evidence import evidence_of_run
from priorlab.slam.scan import Scan, choose_beams
from priorlab.slam.trajectory_error import dead_reckoning, relative_pose_error_m

WALLS = np.zeros((30, 40), dtype=bool)
WALLS[:2], WALLS[-2:], WALLS[:, :2], WALLS[:, -2:] = True, True, True, True
ROOM = pl.GridMap(np.where(WALLS, -1.0, 0.94), pl.Grid(WALLS.shape, 1, 0.1))
WORLD = World(WALLS, 0.1)
LOG = pl.RobotLog(np.zeros((2, 3)), np.ones((2, 12)), pl.Scanner(n_beams=12).bearings, pl.Scanner(n_beams=12), [2.0, 1.5, 0.0])
FEW = {"particle_limits": (5, 20)}


def rng():
    return np.random.default_rng(0)


def particles():
    return start_particles([2.0, 1.5, 0.0], 5, (0, 0, 0), rng())


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"free_on_no_return": "yes"}, "free_on_no_return must be True or False, got 'yes'"),
        ({"free_on_no_return": None}, "free_on_no_return must be True or False, got None"),
        ({"alphas": (1e300,) * 4}, "alphas must be at most 1e+06, got 1e+300"),
        ({"alphas": (0, 0, 0, 10**400)}, "alphas must be 4 finite numbers of at least 0"),
        ({"start_variances": (0, 0, 1e300)}, "start_variances must be at most 1e+12, got 1e+300"),
        ({"sensor_offset_m": (1e300, 0)}, "sensor_offset_m must be at most 1e+06"),
        ({"sigma_hit_m": 1e-300}, "sigma_hit_m must lie between 1e-06 and 1e+06, got 1e-300"),
        ({"max_distance_m": 1e300}, "max_distance_m must lie between 1e-06 and 1e+06, got 1e+300"),
        ({"kld_bin_theta": 1e-300}, "kld_bin_theta must lie between 1e-06 and 1e+06, got 1e-300"),
        ({"max_range_m": 10**400}, "max_range_m must be a number, got a number of 1329 bits"),
        ({"z_random": 1e-300}, "z_random must be at least 1e-12, got 1e-300"),
        ({"thickening_m": 1e300}, "thickening_m must be at most 1e+06, got 1e+300"),
        ({"lag_m": [3.0, 4.0]}, "lag_m must be a number, got [3.0, 4.0]"),
        ({"n_beams": 1e300}, "n_beams must be at most 10,000,000, got 1e+300"),
        ({"resampling_interval": 10**400}, "resampling_interval must be a number, got a number of 1329 bits"),
        ({"particle_limits": (1, 1e300)}, "particle_limits must be at most 10,000,000, got 1e+300"),
        ({"estimate": np.zeros(2)}, "estimate must be one of cluster, mean, best, got array([0., 0.])"),
        ({"localize_in": ["own"]}, "localize_in must be one of updated, static, own, got ['own']"),
    ],
)
def test_parameters_refuse_what_no_filter_can_use(changes, sentence):
    with pytest.raises(ValueError, match=re.escape(sentence)):
        Parameters(**changes)


@pytest.mark.parametrize("localize_in", ["static", "updated", "own"])
@pytest.mark.parametrize(
    "changes",
    [
        {"alphas": (1e6,) * 4, "start_variances": (1e12,) * 3},
        {"alphas": (1e6,) * 4, "noise": "std", "kld_bin_m": 1e-6, "kld_bin_theta": 1e-6},
        {"sigma_hit_m": 1e-6, "z_random": 1e-12, "max_distance_m": 1e6},
        {"sigma_hit_m": 1e6, "kld_epsilon": 1e-6, "kld_quantile": 1e6, "max_distance_m": 1e-6},
        {"max_range_m": 1e6, "n_beams": 10_000_000, "sensor_offset_m": (1e6, -1e6), "lag_m": 1e6},
    ],
)
def test_fastslam_gives_finite_numbers_at_the_ends_of_what_parameters_take(changes, localize_in):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        run = pl.FastSLAM(**FEW, localize_in=localize_in, **changes).run(ROOM, LOG, rng())
    assert all(np.isfinite(numbers).all() for numbers in (run.trajectory, run.ess, run.map.log_odds))


def test_see_cells_says_when_rays_span_more_than_memory():
    scan = Scan(np.array([1.0]), np.array([0.5]), np.array([0.7]))
    endless = Parameters(free_on_no_return=True, max_range_m=1e6)
    with pytest.raises(ValueError, match="max_range_m and thickening_m must let a scan reach over at most 1,000,000,000 cells"):
        see_cells(ROOM.grid, np.array([2.0, 1.5, 0.0]), scan, endless)


FIELD = LikelihoodField.of(ROOM, Parameters())


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda: pl.FastSLAM("tuned"), "parameters must be a Parameters, got str"),
        (lambda: pl.FastSLAM(**FEW).run(WALLS, LOG, rng()), "prior_map must be a GridMap, got ndarray"),
        (
            lambda: resample([0.5, 0.5], 2, None),
            "rng must be a numpy Generator, as numpy.random.default_rng(0) makes it, got None",
        ),
        (lambda: resample([0.5, 0.5], 2, 7), "rng must be a numpy Generator, as numpy.random.default_rng(0) makes it, got 7"),
        (lambda: resample(["half", "half"], 2, rng()), "weights must be numbers, got ['half', 'half']"),
        (lambda: resample([0.5, 0.5], 1e300, rng()), "n_draws must be at most 10,000,000, got 1e+300"),
        (lambda: resample([0.5, 0.5], 2, rng(), None), "resampling must be one of systematic, stratified, multinomial, got None"),
        (lambda: start_particles([1, 2], 3, (0, 0, 0), rng()), "start must be three finite numbers x, y, theta, got [1.0, 2.0]"),
        (lambda: start_particles([1, 2, np.inf], 3, (0, 0, 0), rng()), "start must be three finite numbers x, y, theta"),
        (lambda: start_particles([1, 2, 0], 3, (-1, 0, 0), rng()), "variances must be three finite numbers of at least 0"),
        (lambda: start_particles([1, 2, 0], 1.5, (0, 0, 0), rng()), "n_particles must be a whole number of at least 1, got 1.5"),
        (lambda: start_particles([1, 2, 0], 3, (0, 0, 0), 0), "rng must be a numpy Generator"),
        (lambda: Particles([[1, 2, 3]], ["heavy"]), "log_weights must be numbers, got ['heavy']"),
        (lambda: motion_parts([0, 0], [1, 0, 0]), "before must be three finite numbers x, y, theta, got [0.0, 0.0]"),
        (lambda: motion_parts([0, 0, 0], [np.nan, 0, 0]), "after must be three finite numbers x, y, theta, got [nan, 0.0, 0.0]"),
        (lambda: sample_motion(np.zeros((2, 2)), [0, 0, 0], [1, 0, 0], rng()), "poses must have shape (N, 3)"),
        (lambda: sample_motion(np.zeros((2, 3)), [0, 0, 0], [1, 0, 0], None), "rng must be a numpy Generator"),
        (lambda: predict(np.zeros((2, 3)), [0, 0, 0], [1, 0, 0], rng()), "particles must be a Particles, got ndarray"),
        (
            lambda: predict(particles(), [0, 0, 0], [1, 0, 0], rng(), Parameters(), FIELD),
            "impassable must be an Impassable, got LikelihoodField",
        ),
        (lambda: weigh(particles(), LOG, FIELD), "scan must be a Scan, got RobotLog"),
        (lambda: weigh(particles(), choose_beams(LOG, 0, Parameters()), ROOM), "field must be a LikelihoodField, got GridMap"),
        (lambda: choose(np.zeros((2, 3)), rng()), "particles must be a Particles, got ndarray"),
        (lambda: estimate_pose(np.zeros((2, 3))), "particles must be a Particles, got ndarray"),
        (lambda: choose_beams(LOG, 1.5, Parameters()), "step must be a whole number below the 2 scans of the log, got 1.5"),
        (lambda: choose_beams(LOG, 2, Parameters()), "step must be a whole number below the 2 scans of the log, got 2"),
        (lambda: choose_beams(LOG, 0, None), "parameters must be a Parameters, got NoneType"),
        (lambda: LikelihoodField.of(WALLS), "grid_map must be a GridMap, got ndarray"),
        (lambda: dead_reckoning(np.zeros((2, 3))), "log must be a RobotLog, got ndarray"),
        (
            lambda: relative_pose_error_m(np.zeros((3, 3)), np.zeros((3, 3)), 1.5),
            "delta must be at least 1 and below the 3 poses",
        ),
        (lambda: relative_pose_error_m(np.zeros((3, 3)), np.zeros((3, 3)), "1"), "delta must be a number, got '1'"),
        (lambda: pl.map_by_matching(ROOM), "log must be a RobotLog, got GridMap"),
        (lambda: pl.map_by_matching(LOG, slip=0.1), "slip must be a Slip, got float"),
        (lambda: pl.map_by_matching(LOG, cell_m=1e300), "cell_m must lie between 1e-06 and 1e+06, got 1e+300"),
        (lambda: pl.map_by_matching(LOG, insert_after_m=np.nan), "insert_after_m must be a finite number of at least 0, got nan"),
        (lambda: Slip(per_m="far"), "per_m must be a number, got 'far'"),
        (lambda: pl.drive(WALLS, [(1, 1), (2, 1)], rng=rng()), "world must be a World, got ndarray"),
        (lambda: pl.drive(WORLD, [(1, 1), (2, 1)], pl.RangeSensor(), rng=rng()), "scanner must be a Scanner, got RangeSensor"),
        (lambda: pl.drive(WORLD, [(1, 1), (2, 1)], odometry=0.1, rng=rng()), "odometry must be an Odometry, got float"),
        (lambda: pl.drive(WORLD, "round", rng=rng()), "tour must be numbers, got 'round'"),
        (lambda: pl.explore(WALLS, [[9, 9, 0]]), "building must be a Truth or a World, got ndarray"),
        (lambda: pl.explore(WORLD, [[9, 9, 0]], pl.KINECT), "sensor must be a RangeSensor, got Scanner"),
        (lambda: pl.explore(WORLD, [[9, 9, 0]], noise=0.1, rng=rng()), "noise must be a RangeNoise, got float"),
        (lambda: pl.explore(WORLD, [[9, 9, 0]], repeats=1e300), "repeats must be at most 100,000, got 1e+300"),
        (lambda: pl.depth_image(WALLS, [9, 9, 0]), "relief must be a Relief, got ndarray"),
        (lambda: pl.strip_ranges([[1, 2], [3]]), "a depth image must have 480 x 640 pixels, got uneven rows"),
        (lambda: pl.strip_ranges([[1, 2]], "kinect"), "camera must be a DepthCamera, got str"),
        (lambda: report_odometry(np.zeros((0, 3)), pl.ODOMETRY, rng()), "truth must hold at least one pose, got none"),
        (lambda: cast_rays(WALLS, [[9, 9]], 0.0, 5), "angles must be one row of finite numbers, got shape ()"),
    ],
)
def test_a_thing_of_the_wrong_kind_is_told(call, sentence):
    with pytest.raises(ValueError, match=re.escape(sentence)):
        call()


def test_a_run_names_the_record_that_belongs_there():
    fast_slam = pl.FastSLAM(**FEW)
    run = fast_slam.run(ROOM, LOG, rng())
    for call, sentence in (
        (lambda: run.summary(log=ROOM), "log must be a RobotLog, got GridMap"),
        (lambda: run.ate_m(ROOM), "log must be a RobotLog, got GridMap"),
        (lambda: run.remap(WALLS), "prior_map must be a GridMap, got ndarray"),
        (lambda: evidence_of_run(LOG), "run must be a Run, got RobotLog"),
        (lambda: evidence_of_run(run, "as before"), "parameters must be a Parameters, got str"),
        (lambda: counted_map(run).score(WALLS), "truth must be a Truth, got ndarray"),
        (lambda: fast_slam.step(LOG), "state must be a State, got RobotLog"),
    ):
        with pytest.raises(ValueError, match=sentence):
            call()


def test_run_at_takes_whole_steps_only():
    run = pl.FastSLAM(**FEW).run(ROOM, LOG, rng())
    for step in (1.5, "1", None):
        with pytest.raises(ValueError, match="step must be a whole number, got"):
            run.at(step)
    np.testing.assert_array_equal(run.at(np.int64(-1)).log_odds, run.map.log_odds)


def test_true_path_makes_at_least_one_step_on_every_leg():
    assert true_path([[0, 0], [1, 0]], step_m=1e300).tolist() == [[0, 0, 0], [1, 0, 0]]
