"""Gaps between beams on one surface, by geometry."""

import numpy as np

from priorlab.slam.connected_scan import connect_beams
from priorlab.slam.scan import Scan

NONE = np.empty(0)


def test_connect_beams_fills_a_wall_seen_along_it_and_leaves_the_rest():
    bearings = np.radians(np.arange(10, 90, 2.0))
    wall = Scan(1.0 / np.sin(bearings), bearings, NONE, (0.1, -0.2))  # the wall y = 1 - 0.2, seen from the scanner
    filled = connect_beams(wall, 0.05, bridged_m=0.5)
    np.testing.assert_allclose(filled.points[:, 1], 0.8, atol=1e-12)  # all on the wall
    np.testing.assert_array_equal(filled.ranges[: len(wall)], wall.ranges)
    x = np.sort(filled.points[:, 0])
    gaps = np.diff(x)
    wide = np.abs(np.diff(np.sort(wall.points[:, 0]))) >= 0.5  # far along the wall
    assert gaps[gaps < 0.5].max() <= 0.05 + 1e-9 and (gaps >= 0.5).sum() == wide.sum() > 0


def test_connect_beams_does_not_bridge_a_jump_or_a_missing_beam():
    jump = Scan(np.array([1.0, 3.0, 3.0]), np.array([0.0, 0.1, 0.2]), NONE)
    near = connect_beams(jump, 0.1, bridged_m=0.5)
    assert (np.abs(near.ranges - 3.0) < 0.01).sum() == len(near) - 1
    bearings = np.array([0.0, 0.1, 0.2, 0.4, 0.5])  # the one at 0.3 is lost
    lost = connect_beams(Scan(np.full(5, 2.0), bearings, NONE), 0.05)
    assert not ((lost.bearings > 0.2 + 1e-9) & (lost.bearings < 0.4 - 1e-9)).any() and len(lost) > 5


def test_connect_beams_of_one_beam_or_none_is_the_scan():
    assert len(connect_beams(Scan(NONE, NONE, NONE), 0.05)) == 0
    assert connect_beams(Scan(np.ones(1), np.zeros(1), NONE), 0.05).ranges.tolist() == [1.0]
