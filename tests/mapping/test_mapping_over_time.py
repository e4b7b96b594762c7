"""The score over time against maps that are made anew after every reading."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from priorlab.core.building import Truth
from priorlab.core.drawing import Walls
from priorlab.core.grid import Grid
from priorlab.core.grid_map import Prior
from priorlab.core.readings import Readings
from priorlab.core.score import score_map
from priorlab.core.sensor import RangeSensor
from priorlab.mapping.evidence import gather_evidence
from priorlab.mapping.over_time import score_over_time
from priorlab.mapping.overruled import OverruledSensorWarning
from priorlab.mapping.prior import build_prior_map
from priorlab.mapping.timeline import evidence_over_time
from priorlab.mapping.update import update_map

seeds = st.integers(0, 2**32 - 1)
cell_sizes = st.sampled_from([0.5, 1, 2, 3, 2.5])
quiet = pytest.mark.filterwarnings("ignore::priorlab.mapping.overruled.OverruledSensorWarning")


def truth_of(walls, seed):
    """The walls with some that the plan lacks, and some pixels that do not count."""
    rng = np.random.default_rng(seed)
    return Truth(walls.mask ^ (rng.random(walls.shape) < 0.1), rng.random(walls.shape) < 0.1)


def priors_of(walls, cell_size):
    priors = {"plan": Prior(), "none": Prior.uninformed(), "sure": Prior(0.1, 1.0)}
    return {name: build_prior_map(walls, prior, cell_size) for name, prior in priors.items()}


@quiet
@settings(max_examples=40)
@given(seeds, cell_sizes, st.sampled_from([0.0, 0.5, 1.0]), st.sampled_from([0.2, 0.18, 0.5]))
def test_score_over_time_counts_as_maps_made_anew(small_survey, seed, cell_size, lam, threshold):
    walls, readings = small_survey(seed)
    truth, maps = truth_of(walls, seed), priors_of(walls, cell_size)
    curves = score_over_time(readings, maps, truth, lam, threshold)
    assert curves.steps.tolist() == list(range(9))
    for k in curves.steps:
        evidence = gather_evidence(readings[:k], maps["plan"].grid)
        assert curves.seen[k] == pytest.approx(evidence.seen.mean(), abs=1e-12)
        for name, prior_map in maps.items():
            score = score_map(update_map(prior_map, evidence, lam), truth, threshold)
            assert (curves.tp[name][k], curves.fp[name][k]) == (score.tp, score.fp)
            for measure in ("f_beta", "precision", "recall", "false_positive_rate"):
                np.testing.assert_allclose(getattr(curves, measure)[name][k], getattr(score, measure), rtol=1e-14)


@quiet
def test_score_over_time_is_the_same_however_many_looks_are_weighed_at_once(small_survey, monkeypatch):
    walls, readings = small_survey(5)
    truth, maps = truth_of(walls, 5), priors_of(walls, 1)
    at_once = score_over_time(readings, maps, truth)
    monkeypatch.setattr("priorlab.mapping.over_time.LOOKS_AT_ONCE", 1)
    one_by_one = score_over_time(readings, maps, truth)
    for name in maps:
        assert (at_once.tp[name] == one_by_one.tp[name]).all() and (at_once.fp[name] == one_by_one.fp[name]).all()


@quiet
def test_score_over_time_reports_every_so_many_readings_and_the_last(small_survey):
    walls, readings = small_survey(6)
    truth, maps = truth_of(walls, 6), priors_of(walls, 2)
    all_steps, some = (score_over_time(readings, maps, truth, every=every) for every in (1, 3))
    assert some.steps.tolist() == [0, 3, 6, 8]
    assert (some.f_beta["plan"] == all_steps.f_beta["plan"][some.steps]).all()
    assert score_over_time(readings[:0], maps, truth).steps.tolist() == [0]


@quiet
def test_score_over_time_takes_a_timeline_that_was_made_before(small_survey):
    walls, readings = small_survey(7)
    truth, maps = truth_of(walls, 7), priors_of(walls, 2)
    timeline = evidence_over_time(readings, maps["plan"].grid)
    assert (score_over_time(timeline, maps, truth).tp["none"] == score_over_time(readings, maps, truth).tp["none"]).all()
    with pytest.raises(ValueError, match="map and evidence must lie on one grid"):
        score_over_time(timeline, priors_of(walls, 1), truth)


def test_score_over_time_warns_once_for_each_prior_that_breaks_eq_2_22(small_survey):
    walls, readings = small_survey(8)
    with pytest.warns(OverruledSensorWarning, match="p_space 0.9 must lie below") as caught:
        score_over_time(readings, priors_of(walls, 1), truth_of(walls, 8))
    assert len(caught) == 1 and caught[0].filename == __file__  # both faults of "sure" in one sentence; the others are fine


@quiet
@settings(max_examples=25)
@given(seeds, cell_sizes)
def test_evidence_over_time_is_the_evidence_of_the_first_readings(small_survey, seed, cell_size):
    _, readings = small_survey(seed)
    grid = Grid(readings.image_shape, cell_size)
    timeline = evidence_over_time(readings, grid)
    for k in range(len(readings) + 1):
        slow, fast = gather_evidence(readings[:k], grid), timeline.at(k)
        assert (fast.total == slow.total).all() and (fast.looks == slow.looks).all() and fast.sensor == slow.sensor
    assert len(timeline) == 8 and f"8 readings, {slow.looks.sum()} looks" in repr(timeline)


def test_evidence_over_time_takes_readings_in_batches_as_one(small_survey, monkeypatch):
    _, readings = small_survey(9)
    grid = Grid(readings.image_shape)
    at_once = evidence_over_time(readings, grid)
    monkeypatch.setattr("priorlab.robot.inverse_sensor_model.CANDIDATES_AT_ONCE", 100)
    in_batches = evidence_over_time(readings, grid)
    assert (at_once.starts == in_batches.starts).all() and (at_once.at(5).total == in_batches.at(5).total).all()


@pytest.mark.parametrize("work", ["gather", "timeline", "score", "both"])
def test_long_work_says_how_far_it_is_and_can_be_interrupted(small_survey, monkeypatch, work):
    monkeypatch.setattr("priorlab.robot.inverse_sensor_model.CANDIDATES_AT_ONCE", 300)
    monkeypatch.setattr("priorlab.mapping.over_time.LOOKS_AT_ONCE", 20)
    walls, readings = small_survey(10)
    maps, truth = {"none": build_prior_map(walls, Prior.uninformed(), 1)}, truth_of(walls, 10)
    grid = maps["none"].grid
    timeline = evidence_over_time(readings, grid)
    start = {
        "gather": lambda tell: gather_evidence(readings, grid, tell),
        "timeline": lambda tell: evidence_over_time(readings, grid, tell),
        "score": lambda tell: score_over_time(timeline, maps, truth, progress=tell),
        "both": lambda tell: score_over_time(readings, maps, truth, progress=tell),
    }[work]
    told = []
    start(lambda done, to_do: told.append((done, to_do)))
    assert len(told) > 1 and told == sorted(told) and told[-1] == ((16, 16) if work == "both" else (8, 8))

    def interrupt(done, to_do):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        start(interrupt)
    again = []
    start(lambda done, to_do: again.append((done, to_do)))
    assert again == told


def test_over_time_shows_itself(small_survey):
    walls, readings = small_survey(11)
    curves = score_over_time(readings, {"none": build_prior_map(walls, Prior.uninformed(), 1)}, truth_of(walls, 11))
    assert repr(curves).startswith("OverTime(8 readings, F2: none 0.000 to 0.") and curves.names == ("none",)


def test_over_time_says_what_is_wrong(small_survey):
    walls, readings = small_survey(0)
    truth, maps = truth_of(walls, 0), {"none": build_prior_map(walls, Prior.uninformed(), 1)}
    coarse = {**maps, "coarse": build_prior_map(walls, Prior.uninformed(), 2)}
    other = Truth(np.zeros((5, 5), bool), np.zeros((5, 5), bool))
    for wrong, sentence in (
        (dict(prior_maps={}), "prior_maps must hold at least one prior map, got none"),
        (dict(prior_maps=coarse), "prior_maps must lie on one grid, got .* and, for 'coarse', .*cell_size=2"),
        (dict(truth=other), r"map and truth must have one shape, got \(12, 15\) and \(5, 5\)"),
        (dict(lam=np.nan), "lam must be a finite number, got nan"),
        (dict(every=0), "every must be a whole number of at least 1, got 0"),
        (dict(beta=0), "beta must be a finite number above 0, got 0"),
        (dict(threshold=0.7), "threshold must lie above 0 and be at most 0.5, got 0.7"),
    ):
        with pytest.raises(ValueError, match=sentence):
            score_over_time(**{"readings": readings, "prior_maps": maps, "truth": truth, **wrong})
    with pytest.raises(ValueError, match="step must lie between 0 and the 8 readings, got 9"):
        evidence_over_time(readings, maps["none"].grid).at(9)
    with pytest.raises(ValueError, match="step must be a whole number of at least 0, got 1.5"):
        evidence_over_time(readings, maps["none"].grid).at(1.5)
    assert score_over_time(readings, maps, truth, every=4.0).steps.tolist() == [0, 4, 8]
    off = Readings([[1, 1, 0]], [[3.0]], [0.0], RangeSensor(), (5, 8))
    with pytest.raises(ValueError, match="readings and grid must have one image shape"):
        score_over_time(
            off, {"one": build_prior_map(Walls(np.zeros((5, 9), np.uint8)))}, Truth(np.zeros((5, 9)), np.zeros((5, 9)))
        )
