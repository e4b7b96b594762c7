"""The answers of notebooks 03, 05 and 06, worked out by hand there, are what the library gives."""

from __future__ import annotations

import re

import numpy as np
import pytest

import priorlab as pl
from priorlab.core.sensor import RangeSensor
from priorlab.course.checking import exercises
from priorlab.mapping.overruled import overruled_readings
from priorlab.optimize.front import non_dominated
from priorlab.study.worth import gain_percent

SEEDS = range(6)


def asked(name, seed):
    """The question, its numbers in order, and the right answer."""
    exercise = exercises(seed)[name]
    return exercise.asks, [float(number) for number in re.findall(r"\d+\.?\d*", exercise.asks)], exercise.answer()


@pytest.mark.parametrize("seed", SEEDS)
def test_03_effective_is_the_log_odds_of_the_prior(seed):
    _, (p_space, *_), answer = asked("03.effective", seed)
    assert answer == pytest.approx(float(pl.log_odds(pl.Prior(0.2, p_space).effective_p_space)))


@pytest.mark.parametrize("seed", SEEDS)
def test_03_limit_is_where_eq_2_22_breaks(seed):
    _, (p_free, *_), answer = asked("03.limit", seed)
    assert overruled_readings(pl.Prior(0.5, answer - 1e-6), p_free, 0.1) is None
    assert "p_space" in overruled_readings(pl.Prior(0.5, answer + 1e-6), p_free, 0.1)


@pytest.mark.parametrize("seed", SEEDS)
def test_03_any_is_the_rule_of_the_grid(seed):
    text, _, answer = asked("03.any", seed)
    drawing = np.array([[mark == "#" for mark in line.split()] for line in re.findall(r"^ {2}([.#][ .#]*)$", text, re.MULTILINE)])
    assert drawing.shape == (6, 9)
    assert (pl.Grid((6, 9), 3).any_in_cells(drawing) == np.array(answer)).all()


@pytest.mark.parametrize("seed", SEEDS)
def test_05_front_is_what_nothing_dominates(seed):
    text, _, answer = asked("05.front", seed)
    points = np.array(re.findall(r"precision (\S+), recall (\S+)$", text, re.MULTILINE), dtype=float)
    assert sorted(non_dominated(*points.T).tolist()) == answer


def test_05_front_may_be_given_in_any_order():
    exercise = exercises()["05.front"]
    assert exercise.agree([4, 0, 2], exercise.answer()) and not exercise.agree([4, 0], exercise.answer())


@pytest.mark.parametrize("seed", SEEDS)
def test_05_threshold_is_the_cliff_of_the_sweep(seed):
    _, (threshold, *_), answer = asked("05.threshold", seed)
    wall = pl.Walls(np.ones((1, 1), dtype=np.uint8))
    truth = pl.Truth(wall.mask, ~wall.mask)
    sweep = pl.Experiment(wall, pl.Evidence.none(pl.Grid((1, 1))), truth, threshold=threshold).sweep()
    assert sweep.at(answer - 1e-6, 0.9).recall == 1 and sweep.at(answer + 1e-6, 0.9).recall == 0
    assert sweep.critical().item() == pytest.approx(answer)


@pytest.mark.parametrize("seed", SEEDS)
def test_05_row_is_what_the_sweep_counts(seed):
    text, _, answer = asked("05.row", seed)
    counts = [int(number) for number in re.findall(r"(\d+)(?= pixels lie| in cells)", text)]
    assert len(counts) == 3
    looks = np.repeat([0, 1, 2], counts)[None]
    total = np.where(looks == 1, pl.log_odds(0.1), 0.0)  # once as wall; once free and once as wall cancel
    grid = pl.Grid(looks.shape)
    walls = pl.Walls(np.ones(looks.shape, dtype=np.uint8))
    truth = pl.Truth(walls.mask, ~walls.mask)
    sweep = pl.Experiment(walls, pl.Evidence(total, looks, grid, RangeSensor()), truth).sweep()
    assert (sweep.at(0.2, 0.9).tp, sweep.at(1.0, 0.9).tp) == answer


@pytest.mark.parametrize("seed", SEEDS)
def test_06_gain_is_that_of_the_study(seed):
    _, (precision, recall, precision_without, recall_without, *_), answer = asked("06.gain", seed)
    scores = []
    for p, r in ((precision, recall), (precision_without, recall_without)):
        tp = 1_000_000
        scores.append(pl.Score(tp=tp, fp=round(tp / p) - tp, fn=round(tp / r) - tp, tn=0).f_beta)
    assert answer == pytest.approx(gain_percent(*scores), abs=1e-3)


@pytest.mark.parametrize("seed", SEEDS)
def test_06_turn_is_where_the_two_lines_cross(seed):
    text, _, answer = asked("06.turn", seed)
    rows = np.array(re.findall(r"(\S+) looks: F2 (\S+) with the plan, (\S+) without", text), dtype=float)
    assert len(rows) == 4
    with_plan, without = (np.interp(answer, rows[:, 0], column) for column in rows.T[1:])
    assert with_plan == pytest.approx(without)
    assert (np.diff(np.sign(rows[:, 1] - rows[:, 2])) != 0).sum() == 1
