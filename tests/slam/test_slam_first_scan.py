"""A map without a plan begins with the first scan."""

from dataclasses import replace

import numpy as np
import pytest

from priorlab.core.grid import Grid
from priorlab.core.readings import RobotLog
from priorlab.core.sensor import Scanner
from priorlab.slam.first_scan import map_of_first_scan
from priorlab.slam.parameters import Parameters

PARAMETERS = Parameters(n_beams=1, thickening_m=0.0)


def log_of(ranges, xs):
    """A robot that looks east along a strip of cells of 0.1 m."""
    poses = np.array([[x, 0.05, 0.0] for x in xs])
    scanner = Scanner(n_beams=1, field_of_view=0.1, min_range_m=0.1)
    return RobotLog(poses - [7, 0, 0], np.array(ranges)[:, None], np.zeros(1), scanner, poses[0], poses)


def test_map_of_first_scan_holds_that_scan_and_nothing_else():
    first = map_of_first_scan(Grid((1, 10), 1, 0.1), log_of([0.5, 0.1], [0.15, 0.55]), PARAMETERS)
    np.testing.assert_allclose(first.p_empty, [[0.5, 0.8, 0.8, 0.8, 0.8, 0.8, 0.2, 0.5, 0.5, 0.5]])


def test_map_of_first_scan_waits_for_a_return_while_the_robot_stands():
    first = map_of_first_scan(Grid((1, 10), 1, 0.1), log_of([np.inf, 0.5, 0.1], [0.15, 0.15, 0.55]), PARAMETERS)
    assert first.p_empty[0, 6] == pytest.approx(0.2)


def test_map_of_first_scan_says_that_it_saw_nothing():
    log = log_of([np.inf, 0.5], [0.15, 0.25])
    with pytest.raises(ValueError, match="the first scan must meet an obstacle"):
        map_of_first_scan(Grid((1, 10), 1, 0.1), log, PARAMETERS)
    with pytest.raises(ValueError, match="the first scan must meet an obstacle"):
        map_of_first_scan(Grid((1, 10), 1, 0.1), replace(log, ranges=np.array([[np.nan], [np.nan]])), PARAMETERS)
