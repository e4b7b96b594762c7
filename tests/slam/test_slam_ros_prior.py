"""From here to a robot and back: a map that was exported for ROS and read again is a prior that a robot localizes in."""

import numpy as np
import pytest

from priorlab.core.drawing import WALL, Walls
from priorlab.core.grid_map import Prior
from priorlab.core.readings import RobotLog
from priorlab.interchange.ros_map import read_ros_map, write_ros_map
from priorlab.slam.fastslam import FastSLAM

TABLE_6_1 = Prior(0.3, 0.8)


@pytest.fixture(scope="module")
def log(drive_log):
    log, n = drive_log, 90
    return RobotLog(log.odometry[:n], log.ranges[:n], log.bearings, log.scanner, log.start, log.truth[:n])


@pytest.fixture(scope="module")
def here(slam_prior, log):
    return FastSLAM().run(slam_prior, log, np.random.default_rng(0))


def test_walls_exported_in_trinary_localize_as_they_do_here(tmp_path, floor, log, here):
    walls = Walls((floor[0] * WALL).astype(np.uint8), metres_per_pixel=0.05)
    exported = read_ros_map(write_ros_map(tmp_path / "floor.yaml", walls))
    run = FastSLAM().run(exported.to_prior_map(TABLE_6_1), log, np.random.default_rng(0))
    assert not run.lost and run.ate_m() < 0.3
    np.testing.assert_array_equal(run.trajectory, here.trajectory)
    np.testing.assert_array_equal(run.map.log_odds, here.map.log_odds)


@pytest.mark.parametrize("mode", ["scale", "raw"])
def test_a_prior_map_exported_in_percents_localizes_as_it_does_here(tmp_path, slam_prior, log, here, mode):
    exported = read_ros_map(write_ros_map(tmp_path / "floor.yaml", slam_prior, mode, image_format="png"))
    run = FastSLAM().run(exported.to_prior_map(TABLE_6_1), log, np.random.default_rng(0))
    np.testing.assert_array_equal(run.trajectory, here.trajectory)


def test_a_map_that_a_robot_made_starts_the_next_robot(tmp_path, log, here):
    """Trinary: what no scan saw is unknown, but the walls are there."""
    with pytest.warns(UserWarning, match="of the space becomes unknown"):
        path = write_ros_map(tmp_path / "made.yaml", here.map)
    made = read_ros_map(path)
    assert set(np.unique(made.occupancy)) == {-1, 0, 100}
    run = FastSLAM().run(made.to_prior_map(TABLE_6_1), log, np.random.default_rng(1))
    assert not run.lost and run.ate_m() < 0.3
