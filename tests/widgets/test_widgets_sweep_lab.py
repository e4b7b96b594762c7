"""The lab of notebook 05: score, front and optimum are the library's, and the threshold moves the optimum."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import priorlab as pl
from priorlab.core.survey import look_around
from priorlab.optimize.front import Front
from priorlab.widgets import SweepLab

THRESHOLDS = st.integers(10, 50).map(lambda percent: percent / 100)
SLIDER = st.integers(10, 100).map(lambda percent: percent / 100)


@pytest.fixture(scope="module")
def experiment():
    labels = np.zeros((60, 90), dtype=np.uint8)
    labels[:3] = labels[-3:] = labels[:, :3] = labels[:, -3:] = 1
    labels[3:35, 45:48] = 1
    truth = pl.Truth(walls=labels.astype(bool), ignore=np.zeros(labels.shape, dtype=bool))
    plan = labels.copy()
    plan[3:12, 45:48], plan[40:43, 20:60] = 0, 1  # a piece missing, a piece too many
    readings = pl.explore(truth, look_around([((12, 14), (78, 14)), ((12, 40), (36, 40))], 4), pl.RangeSensor(max_range=30))
    return pl.Experiment(pl.Walls(plan, name="rooms"), pl.gather_evidence(readings, pl.Grid(labels.shape, 3)), truth)


@pytest.fixture(scope="module")
def lab(experiment):
    return SweepLab(experiment)


@settings(max_examples=30, deadline=None)
@given(p_wall=SLIDER, p_space=SLIDER, threshold=THRESHOLDS, lam=st.sampled_from([0.0, 0.5, 1.0]))
def test_sweep_lab_score_is_the_maps_own(experiment, lab, p_wall, p_space, threshold, lam):
    lab.set(p_wall=p_wall, p_space=p_space, threshold=threshold, lam=lam)
    slow = replace(experiment, threshold=threshold, lam=lam)
    assert lab.score == pl.score_map(lab.map, experiment.truth, threshold=threshold)
    assert lab.front.hypervolume == slow.sweep().front().hypervolume
    assert lab.best.value == slow.sweep().best().value and lab.score.f_beta <= lab.best.value + 1e-12


def test_sweep_lab_place_counts_who_is_better(lab):
    lab.reset()
    front, score = lab.front, lab.score
    better = sum(
        p >= score.precision and r >= score.recall and (p, r) != (score.precision, score.recall)
        for p, r in zip(front.precision, front.recall, strict=True)
    )
    assert lab.beaten_by == better


def test_sweep_lab_on_the_front_is_said(lab):
    lab.reset()
    inside = np.round(lab.front.priors, 2)
    for p_wall, p_space in inside:
        lab.set(p_wall=p_wall, p_space=p_space)
        assert repr(lab).endswith("on the front)") == (lab.beaten_by == 0 and min(lab.score.precision, lab.score.recall) > 0.4)
    lab.set(p_wall=0.9, p_space=0.2)  # every cell of the plan is turned round
    assert not repr(lab).endswith("on the front)")
    lab.reset()


def test_sweep_lab_threshold_moves_the_cliff(lab):
    lab.reset()
    for threshold in (0.1, 0.2, 0.31, 0.44):
        lab.threshold.value = threshold
        assert f"{threshold / 0.9:.4f}" in lab.readout.value
        just_below, just_above = 0.01 * np.floor(100 * threshold / 0.9), 0.01 * np.ceil(100 * threshold / 0.9)
        lab.p_wall.value = max(0.1, just_below)
        found = lab.score.recall
        lab.p_wall.value = just_above
        assert lab.score.recall < found
        lab.p_wall.value = 0.2
    lab.reset()


def test_sweep_lab_other_fronts_show_only_while_they_answer_the_same_question(experiment):
    found = Front(np.array([0.2]), np.array([0.9]), np.array([0.9]), np.array([0.8]), name="searched")
    lab = SweepLab(experiment, {"searched": found})
    assert "searched" in lab.pictures[2].image.decode() and "searched" in lab.readout.value
    lab.threshold.value = 0.3
    assert "searched" not in lab.pictures[2].image.decode() and "searched" not in lab.readout.value


def test_sweep_lab_presets_differ_and_reset_returns(lab):
    lab.reset()
    start = repr(lab)
    said = {}
    for name, button in lab.buttons.items():
        lab.reset()
        button.click()
        said[name] = repr(lab)
    lab.reset()
    assert repr(lab) == start == said["reset"] == said["the thesis's prior"]
    assert len(set(said.values())) == len(said) - 1


def test_sweep_lab_pictures_have_words_and_no_warning(lab):
    lab.set(p_space=1.0)
    assert "must lie below" in lab.readout.value
    lab.reset()
    assert all(picture.alt for picture in lab.pictures) and "precision of every prior" in lab.pictures[0].alt
