"""The table of the real logs, found where PRIORLAB_REAL_DATA says: `make real DATA=folder` prints it. A missing file fails.

freiburg-079 localized on a map of its own (odd scans on a map of the even ones); freiburg-079 and aces mapped without any plan
from worn wheels, with the scan matcher and without it. Five seeds each; some minutes.
"""

import os
from pathlib import Path

import numpy as np
import pytest

from priorlab.interchange.carmen import read_carmen
from priorlab.interchange.relations import read_relations
from priorlab.slam.relations import relation_errors
from priorlab.study.matched_logs import match_log, matching_table
from priorlab.study.real_logs import localize_on_odd_scans, logs_table

BEHIND_S = 1211.36
"""The clock of the relations against that of the log of freiburg-079, seconds."""

SEEDS = range(5)

pytestmark = pytest.mark.skipif("PRIORLAB_REAL_DATA" not in os.environ, reason="PRIORLAB_REAL_DATA is not set")


@pytest.fixture(scope="module")
def folder():
    return Path(os.environ["PRIORLAB_REAL_DATA"]) / "robot_logs"


@pytest.fixture(scope="module")
def relations(folder):
    return read_relations(folder / "fr079.relations")


@pytest.fixture(scope="module")
def freiburg(folder):
    return read_carmen(folder / "freiburg-079-corrected.log.gz")


def test_localize_on_odd_scans_of_freiburg_reaches_a_tenth_of_a_metre(freiburg, relations):
    rows = [localize_on_odd_scans(freiburg, seed) for seed in SEEDS]
    print("\n\nLocalized on odd scans in a map of the even ones, 4,500 particles\n")
    print(logs_table("freiburg-079", rows, relations, BEHIND_S))
    for row in rows:
        assert row.run.n_particles.min() == 4500 and not row.run.lost
        assert row.run.ate_m() <= 0.10 < row.dead_reckoning_m
        assert row.run.heading_error_deg() <= 1.0
        assert row.relation_errors(relations, BEHIND_S).translation_m.mean() <= 0.10


def test_map_by_matching_of_freiburg_takes_the_error_of_worn_wheels_back(freiburg, relations):
    rows = [match_log(freiburg, seed) for seed in SEEDS]
    corrected = relation_errors(freiburg.truth, freiburg.stamps, relations, BEHIND_S)
    print(f"\n\nThe log's own corrected poses against the relations: {corrected}\n")
    print(matching_table("freiburg-079", rows, relations, BEHIND_S))
    for row in rows:
        assert row.drive.ate_m() <= 0.3 and row.wheels_m > 5 * row.drive.ate_m()
        matched, wheels = row.relation_errors(relations, BEHIND_S)
        assert len(matched) == len(relations)
        assert matched.translation_m.mean() <= 0.07 < wheels.translation_m.mean() / 5


def test_map_by_matching_of_aces_takes_most_of_the_error_back(folder):
    log = read_carmen(folder / "aces-corrected.log.gz")  # 440 scans 1.5 m apart: loops close only within the search window
    rows = [match_log(log, seed) for seed in SEEDS]
    print("\n\n" + matching_table("aces", rows))
    assert all(row.wheels_m > 3 * row.drive.ate_m() for row in rows)
    assert np.median([row.drive.ate_m() for row in rows]) <= 1.0
