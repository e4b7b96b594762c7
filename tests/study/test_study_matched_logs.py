"""A log mapped by matching and its table, on a small simulated drive."""

from dataclasses import replace

import numpy as np
import pytest

from priorlab.core.building import World
from priorlab.core.readings import RobotLog
from priorlab.core.sensor import Scanner
from priorlab.interchange.relations import Relations
from priorlab.robot.drive import drive
from priorlab.study.matched_logs import match_log, matching_table

SICK = Scanner(n_beams=121, field_of_view=np.pi, min_range_m=0.1, max_range_m=20.0, outlier_rate=0.0, dropout_rate=0.0)


@pytest.fixture(scope="module")
def log():
    """A straight drive of 5 m through a hall of 8 x 5 m with two pillars."""
    obstacles = np.zeros((100, 160), dtype=bool)
    obstacles[[0, -1]] = obstacles[:, [0, -1]] = True
    obstacles[30:36, 50:56] = obstacles[60:66, 110:116] = True
    simulated = drive(World(obstacles, 0.05), [[1, 1], [6, 1]], SICK, rng=np.random.default_rng(4))
    stamps = np.arange(len(simulated)) / 4
    return RobotLog(simulated.truth, simulated.ranges, simulated.bearings, SICK, simulated.start, simulated.truth, stamps)


def test_match_log_wears_the_wheels_and_matches_them_away(log):
    row, other = match_log(log, seed=1), match_log(log, seed=2)
    assert row.wheels_m != other.wheels_m  # the seed is that of the wheels
    assert row.drive.ate_m() < 0.1 and row.drive.ate_m() < row.wheels_m and row.step_ms > 0
    last = len(log) - 1
    true_step = Relations([[0.0, last / 4]], [[5.0, 0.0, 0.0]])
    matched, wheels = row.relation_errors(true_step)
    assert matched.translation_m[0] == pytest.approx(np.hypot(*_left(row.drive.trajectory)[:2]), abs=1e-6)
    assert wheels.translation_m[0] == pytest.approx(np.hypot(*_left(row.worn.odometry)[:2]), abs=1e-6)
    lines = matching_table("hall", [row, other], true_step).splitlines()
    assert len(lines) == 3 and "relations m: wheels" in lines[0] and f"{row.wheels_m:.2f}" in lines[1]
    assert len({len(line) for line in lines}) == 1  # columns stand below their names
    assert len({len(line) for line in matching_table("hall", [row]).splitlines()}) == 1


def _left(poses):
    """By complex numbers: what is left of the way when 5 m straight ahead are taken off, as the end of the true way sees it."""
    way = complex(*(poses[-1] - poses[0])[:2]) * np.exp(-1j * poses[0, 2])
    return np.array([way.real - 5.0, way.imag])


def test_match_log_says_what_is_missing(log):
    with pytest.raises(ValueError, match="must hold true poses"):
        match_log(replace(log, truth=None), 0)
    with pytest.raises(ValueError, match="must have stamps"):
        match_log(replace(log, stamps=None), 0).relation_errors(Relations([[0.0, 1.0]], [[1.0, 0.0, 0.0]]))
