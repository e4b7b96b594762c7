"""The pipeline against the same steps taken one by one, on the small flat."""

import dataclasses

import numpy as np
import pytest

import priorlab as pl
from priorlab.mapping.overruled import OverruledSensorWarning
from priorlab.pipeline import SLAM_PRIOR, SLAM_THRESHOLD, drive_with_prior, gain_percent, map_with_prior, run_pipeline


@pytest.fixture(scope="module")
def plan():
    return pl.load_floor_plan("small_flat")


@pytest.fixture(scope="module")
def result(plan):
    return run_pipeline(plan.drawing, plan, seed=5)


def test_run_pipeline_equals_the_steps_of_the_readme(plan, result):
    """The example of the README, line by line, with the pipeline's seed."""
    rng_search, rng_world, rng_filter = np.random.default_rng(5).spawn(3)
    walls = pl.extract_walls(plan.drawing).walls
    prior_map = pl.build_prior_map(walls, pl.Prior(0.2, 0.9), cell_size=3)
    evidence = pl.gather_evidence(pl.explore(plan.truth, plan.survey, pl.RangeSensor(max_range=40)), prior_map.grid)
    posterior = pl.update_map(prior_map, evidence)
    assert result.walls_score == pl.score_walls(walls, plan.truth)
    assert result.mapping.score_prior == pl.score_map(prior_map, plan.truth)
    assert result.mapping.score_informed == pl.score_map(posterior, plan.truth)
    front = pl.pareto_front(pl.Experiment(walls, evidence, plan.truth), rng_search)
    assert np.array_equal(front.priors, result.search.searched.priors)
    metric = pl.Walls(walls.labels, plan.metres_per_pixel)
    log = pl.drive(plan.world, plan.tour, pl.KINECT, pl.ODOMETRY, rng_world)
    run = pl.FastSLAM().run(pl.build_prior_map(metric, SLAM_PRIOR, cell_size_m=0.05), log, rng_filter)
    assert np.array_equal(run.trajectory, result.drive.run.trajectory)
    assert result.drive.score_informed == pl.score_map(run.map, plan.truth, SLAM_THRESHOLD)


def test_run_pipeline_sweep_agrees_with_the_map(result):
    here = result.search.sweep.at(0.2, 0.9)
    assert (here.tp, here.fp) == (result.mapping.score_informed.tp, result.mapping.score_informed.fp)


def test_run_pipeline_without_the_plan_starts_from_half(result):
    mapping = result.mapping
    unseen = ~mapping.evidence.seen
    assert (mapping.uninformed.log_odds[unseen] == 0).all() and unseen.any()
    assert np.array_equal(mapping.informed.log_odds[unseen], mapping.prior_map.log_odds[unseen])


def test_run_pipeline_knows_no_wall_where_nothing_was_seen(result):
    drive = result.drive
    unseen = drive.uninformed.log_odds == 0
    assert unseen.any() and not drive.uninformed.detected(SLAM_THRESHOLD)[unseen].any()


def test_run_pipeline_takes_the_time_of_every_stage(result):
    assert list(result.seconds) == ["walls", "map", "search", "drive"]
    assert all(took > 0 for took in result.seconds.values())


def test_run_pipeline_tells_progress(plan):
    told = []
    stop = dataclasses.replace(plan.drawing, grey=np.full((60, 60), 255, dtype=np.uint8))
    result = run_pipeline(stop, progress=told.append)
    assert told[:2] == ["corners, doors and walls of the drawing", "  ink"]
    assert not result.has_walls and "no walls were found" in result.stopped and "'ink'" in result.stopped


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"cell_size": 10_000}, "cell_size must not exceed"),
        ({"metres_per_pixel": -1}, "metres_per_pixel"),
        ({"seed": -1}, "seed"),
    ],
)
def test_run_pipeline_refuses_wrong_numbers_before_it_begins(plan, options, words):
    told = []
    with pytest.raises(ValueError, match=words):
        run_pipeline(plan.drawing, plan, progress=told.append, **options)
    assert told == []


def test_map_with_prior_leaves_an_overruling_prior_to_the_notes(plan):
    walls = pl.Walls(plan.truth.walls.astype(np.uint8), plan.metres_per_pixel)
    sensor = pl.RangeSensor(p_free=0.8, p_occupied=0.2)
    mapping = map_with_prior(walls, plan.truth, plan.survey[:4], pl.Prior(0.2, 1.0), 3, sensor, plan.truth)
    with pytest.warns(OverruledSensorWarning):  # which did not come on the way
        again = pl.update_map(mapping.prior_map, mapping.evidence)
    assert np.array_equal(again.log_odds, mapping.informed.log_odds)


def test_gain_percent_says_nothing_without_something_to_compare():
    half, none = pl.Score(5, 5, 5, 5), pl.Score(0, 0, 5, 5)
    assert gain_percent(half, none) is None and gain_percent(None, half) is None
    assert gain_percent(pl.Score(10, 0, 0, 5), half) == pytest.approx(100.0)


def test_drive_with_prior_never_takes_cells_below_a_pixel():
    labels = np.zeros((60, 80), dtype=np.uint8)
    labels[[5, -6], 5:-5] = labels[5:-5, 5] = labels[5:-5, -6] = 1
    walls = pl.Walls(labels, 0.1)
    tour = np.array([[2.0, 2.0], [5.0, 2.0], [5.0, 4.0]])
    rng_world, rng_filter = np.random.default_rng(0).spawn(2)
    drive = drive_with_prior(walls, pl.World(walls.mask, 0.1), tour, None, rng_world, rng_filter)
    assert drive.run.map.grid.cell_size == 1 and drive.score_informed is None
    assert drive.run.ate_m() < 0.3


@pytest.mark.parametrize("scale", [1e-9, 0.3, 10.0, 1e9])
def test_pipeline_refuses_a_scale_without_doors(scale):
    drawing = pl.Drawing(np.full((500, 600), 255, dtype=np.uint8))
    with pytest.raises(ValueError, match=r"metres_per_pixel must make a door of 0\.85 m 4 to 500 pixels wide, got"):
        run_pipeline(drawing, metres_per_pixel=scale)
