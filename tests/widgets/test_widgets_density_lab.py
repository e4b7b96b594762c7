"""The labs of notebook 06: every number is the library's own, the sign of the gain is told, time goes both ways."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import priorlab as pl
from priorlab.core.survey import look_around
from priorlab.widgets import DensityLab, TimeLab

WALKS = [((12, 14), (78, 14)), ((12, 40), (36, 40)), ((60, 20), (60, 50))]


@pytest.fixture(scope="module")
def rooms():
    labels = np.zeros((60, 90), dtype=np.uint8)
    labels[:3] = labels[-3:] = labels[:, :3] = labels[:, -3:] = 1
    labels[3:35, 44:47] = 1
    truth = pl.Truth(walls=labels.astype(bool), ignore=np.zeros(labels.shape, dtype=bool))
    return pl.Walls(labels, name="rooms"), truth, pl.Grid(labels.shape, 3)


@pytest.fixture(scope="module")
def surveys(rooms):
    _, truth, _ = rooms
    return [pl.explore(truth, look_around(WALKS, spacing), pl.RangeSensor(max_range=30)) for spacing in (20, 6, 2)]


@pytest.fixture
def lab(rooms, surveys):
    walls, truth, grid = rooms
    halved = walls.labels.copy()
    halved[:, 44:47] = 0
    plans = {"right": walls, "half": replace(walls, labels=halved)}
    return DensityLab(plans, [pl.gather_evidence(one, grid) for one in surveys], truth)


@pytest.mark.parametrize("lam", [1.0, 0.0, 0.35])
def test_density_lab_numbers_are_those_of_three_lines(lab, rooms, surveys, lam):
    walls, truth, grid = rooms
    lab.set(p_wall=0.21, p_space=0.7, lam=lam, survey=2)
    start, nothing = (pl.build_prior_map(walls, prior, 3) for prior in (pl.Prior(0.21, 0.7), pl.Prior.uninformed()))
    for k, readings in enumerate(surveys):
        evidence = pl.gather_evidence(readings, grid)
        informed, none = (pl.score_map(pl.update_map(one, evidence, lam), truth).f_beta for one in (start, nothing))
        assert lab.with_plan[k] == pytest.approx(informed) and lab.without[k] == pytest.approx(none)
        assert lab.gain_percent[k] == pytest.approx(100 * (informed - none) / none)
    assert lab.alone == pl.score_map(start, truth).f_beta and lab.gain_here == lab.gain_percent[1]


def test_density_lab_says_where_the_gain_turns(lab):
    lab.without = np.array([0.4, 0.6, 0.99])
    lab.set(p_wall=0.2)
    assert lab.turns_between == (lab.looks[1], lab.looks[2])
    assert f"turns between {lab.looks[1]:.2f} and {lab.looks[2]:.2f} looks" in lab.readout.value
    assert "the plan does harm" in lab.pictures[0].image.decode()
    lab.without = np.full(3, 0.01)
    lab.refresh()
    assert lab.turns_between is None and "the plan pays for every survey" in lab.readout.value
    lab.without = np.full(3, 0.9999)
    lab.refresh()
    assert lab.turns_between is None and "does harm from the first look" in lab.readout.value


def test_density_lab_another_plan_presets_and_reset(lab):
    start, said = repr(lab), set()
    for button in lab.buttons.values():
        lab.reset()
        button.click()
        said.add(repr(lab))
    assert len(said) == len(lab.buttons) - 1
    lab.reset()
    lab.plan.value = "half"
    assert repr(lab).startswith("DensityLab(half, ") and lab.alone < 0.95
    lab.reset()
    assert repr(lab) == start


def test_density_lab_one_survey_is_told(rooms, surveys):
    walls, truth, grid = rooms
    with pytest.raises(ValueError, match="evidence must hold at least 2 surveys, got 1"):
        DensityLab({"right": walls}, [pl.gather_evidence(surveys[0], grid)], truth)


@pytest.fixture
def time_lab(rooms, surveys):
    walls, truth, _ = rooms
    starts = {"with": pl.build_prior_map(walls, None, 3), "without": pl.build_prior_map(walls, pl.Prior.uninformed(), 3)}
    return TimeLab(surveys[1], starts, truth)


def test_time_lab_every_step_is_the_maps_own_score(time_lab, rooms, surveys):
    walls, truth, grid = rooms
    readings = surveys[1]
    for k in (0, 3, len(readings), 5):  # also back in time
        time_lab.k.value = k
        evidence = pl.gather_evidence(readings[:k], grid)
        posterior = pl.update_map(pl.build_prior_map(walls, None, 3), evidence)
        assert time_lab.f2["with"] == pytest.approx(pl.score_map(posterior, truth).f_beta)
        assert np.abs(time_lab.maps["with"].log_odds - posterior.log_odds).max() < 1e-9
        assert f"{k} of {len(readings)}" in time_lab.readout.value


def test_time_lab_buttons_words_and_too_many_maps(time_lab, rooms, surveys):
    walls, truth, _ = rooms
    time_lab.buttons["all"].click()
    assert repr(time_lab).startswith(f"TimeLab({len(surveys[1])} readings, ")
    assert "F2 with" in time_lab.pictures[0].alt and "The map without" in time_lab.pictures[2].alt
    start = pl.build_prior_map(walls, None, 3)
    with pytest.raises(ValueError, match="prior_maps must hold 1 to 4 maps, got 5"):
        TimeLab(surveys[0], {f"{i}": start for i in range(5)}, truth)
