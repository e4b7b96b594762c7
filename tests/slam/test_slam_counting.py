"""A map that only counts hits and misses, and the evidence of a run that it is made of."""

from dataclasses import replace

import numpy as np
import pytest

from priorlab.core.building import Truth
from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.readings import RobotLog
from priorlab.core.score import score_map
from priorlab.core.sensor import Scanner
from priorlab.mapping.update import update_map
from priorlab.slam.counting import GMAPPING_THRESHOLD, CountedMap, counted_map
from priorlab.slam.fastslam import FastSLAM
from priorlab.slam.map_update import FREE, OCCUPIED, see_cells
from priorlab.slam.parameters import Parameters
from priorlab.slam.recording import Run
from priorlab.slam.run_evidence import evidence_of_run
from priorlab.slam.scan import choose_beams


def run_along_a_corridor(ranges: list[list[float]], thickening_m: float = 0.0) -> Run:
    """A robot that stands at x = 0.25 m in a strip of 12 x 1 cells of 0.1 m, looks east, and knows it."""
    grid, n = Grid((1, 12), 1, 0.1), len(ranges)
    poses = np.tile([0.25, 0.05, 0.0], (n, 1))
    scanner = Scanner(n_beams=1, field_of_view=0.1, min_range_m=0.1, max_range_m=3.0)
    log = RobotLog(poses, np.array(ranges), np.zeros(1), scanner, poses[0], poses)
    prior_map = GridMap(np.zeros((1, 12)), grid, Prior.uninformed())
    parameters = Parameters(thickening_m=thickening_m, n_beams=1)
    return Run(prior_map, log, parameters, prior_map, poses, np.ones(n, int), np.ones(n), np.zeros((n, 1, 3)), np.ones(n))


def test_counted_map_counts_by_hand():
    # two scans end 0.6 m ahead, in cell 8; one ends 0.4 m ahead, in cell 6; one has no return
    counted = counted_map(run_along_a_corridor([[0.6], [0.4], [np.inf], [0.6]]))
    assert counted.hits.tolist() == [[0, 0, 0, 0, 0, 0, 1, 0, 2, 0, 0, 0]]
    assert counted.misses.tolist() == [[0, 0, 3, 3, 3, 3, 2, 2, 0, 0, 0, 0]]
    assert counted.p_empty[0, 6] == pytest.approx(2 / 3)
    assert counted.p_empty[0, 11] == 0.5
    assert np.flatnonzero(counted.detected()).tolist() == [8]
    assert np.flatnonzero(counted.detected(GMAPPING_THRESHOLD)).tolist() == [6, 8]


def test_counted_map_thickens_hits_as_the_other_maps_do():
    counted = counted_map(run_along_a_corridor([[0.6]], thickening_m=0.1))
    assert counted.hits.tolist() == [[0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 0, 0]]


def test_counted_map_of_nothing_knows_nothing():
    counted = counted_map(run_along_a_corridor([[np.inf], [np.nan]]))
    assert not counted.seen.any() and not counted.detected(0.99).any()
    assert (counted.p_empty == 0.5).all()


@pytest.fixture(scope="module")
def run(slam_prior, drive_log):
    return FastSLAM(particle_limits=(200, 200)).run(slam_prior, drive_log, np.random.default_rng(0))


def test_counted_map_agrees_with_a_loop_over_cells(run):
    hits, misses = np.zeros(run.map.grid.shape, int), np.zeros(run.map.grid.shape, int)
    for k in range(len(run)):
        seen = see_cells(run.map.grid, run.trajectory[k], choose_beams(run.log, k, run.parameters), run.parameters)
        for row, col in np.argwhere(seen.labels == FREE) + (seen.rows.start, seen.cols.start):
            misses[row, col] += 1
        for row, col in np.argwhere(seen.labels == OCCUPIED) + (seen.rows.start, seen.cols.start):
            hits[row, col] += 1
    counted = counted_map(run)
    np.testing.assert_array_equal(counted.hits, hits)
    np.testing.assert_array_equal(counted.misses, misses)


def test_counted_map_is_the_uninformed_map_at_even_odds(run):
    uninformed = run.remap(GridMap(np.zeros(run.map.grid.shape), run.map.grid, Prior.uninformed()))
    np.testing.assert_array_equal(counted_map(run).detected(0.5), uninformed.detected(0.5))


def test_counted_map_scores_as_a_map_of_log_odds_does(run):
    counted = counted_map(run)
    walls = np.zeros(run.map.grid.image_shape, bool)
    walls[60:100, 20:200] = True
    truth = Truth(walls, np.zeros_like(walls))
    as_map = GridMap(np.where(counted.detected(), -1.0, 1.0), run.map.grid)
    assert counted.score(truth).f_beta == score_map(as_map, truth, 0.5).f_beta > 0


@pytest.mark.filterwarnings("ignore::priorlab.mapping.overruled.OverruledSensorWarning")
@pytest.mark.parametrize("step", [0, 1, 57, -1])
def test_evidence_of_run_is_what_the_map_was_made_of(run, step):
    done = step + 1 if step >= 0 else len(run)
    again = update_map(run.prior_map, evidence_of_run(run).at(done), run.parameters.lam)
    np.testing.assert_allclose(again.log_odds, run.at(step).log_odds, atol=1e-9)


def test_evidence_of_run_follows_the_path_that_drew_the_map():
    run = run_along_a_corridor([[0.6]])
    moved = replace(run, path=run.trajectory + [0.2, 0.0, 0.0])
    assert np.flatnonzero(counted_map(moved).hits).tolist() == [10]


def test_evidence_of_run_takes_other_parameters_of_the_map():
    run = run_along_a_corridor([[0.6]])
    thick = evidence_of_run(run, Parameters(thickening_m=0.2, p_free=0.9, p_occupied=0.1)).at(1)
    assert np.sign(thick.total).tolist() == [[0, 0, 1, 1, 1, 1, 1, 1, -1, -1, -1, 0]]
    assert thick.total[0, 2] == pytest.approx(np.log(9))


def test_counted_map_tells_what_is_wrong():
    with pytest.raises(ValueError, match="hits must have the grid's shape"):
        CountedMap(np.zeros((2, 2)), np.zeros((1, 4)), Grid((1, 4)))
    with pytest.raises(ValueError, match="misses must not be negative, got -1"):
        CountedMap(np.zeros((1, 4)), np.array([[0, -1, 0, 0]]), Grid((1, 4)))
    with pytest.raises(ValueError, match="threshold"):
        CountedMap(np.zeros((1, 4)), np.zeros((1, 4)), Grid((1, 4))).detected(1.5)
    with pytest.raises(ValueError, match="one shape"):
        CountedMap(np.zeros((1, 4)), np.zeros((1, 4)), Grid((1, 4))).score(Truth(np.zeros((2, 4), bool), np.zeros((2, 4), bool)))
