"""The answers of notebook 09, worked out by hand there, are what the library gives."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

import priorlab as pl
from priorlab.course import check
from priorlab.course.checking import exercises
from priorlab.slam.map_update import see_cells, update_seen
from priorlab.slam.motion import motion_deviations
from priorlab.slam.scan import Scan

SEEDS = range(8)


def asked(name, seed):
    """The numbers of a question, in order, and the right answer."""
    exercise = exercises(seed)[name]
    return [float(number) for number in re.findall(r"\d+\.?\d*", exercise.asks)], exercise.answer()


@pytest.mark.parametrize("seed", SEEDS)
def test_09_doorway_is_what_two_scans_write_into_a_map(seed):
    (p_wall, factor, p_free, *_), answer = asked("09.doorway", seed)
    grid = pl.Grid((1, 9), 1, metres_per_pixel=0.1)
    start = np.full((1, 9), float(pl.log_odds(pl.Prior(p_wall, 0.9, factor).effective_p_wall)))
    parameters = replace(pl.TUNED, p_free=p_free, p_occupied=0.1)
    seen = see_cells(grid, np.array([0.05, 0.05, 0.0]), Scan(np.array([0.7]), np.zeros(1), np.array([])), parameters)
    log_odds_map = start.copy()
    for _ in range(2):
        update_seen(log_odds_map, start, seen, parameters)
    assert float(pl.probability(log_odds_map[0, 3])) == pytest.approx(answer)


@pytest.mark.parametrize("seed", SEEDS)
def test_09_alpha_is_the_deviation_of_the_motion_model(seed):
    (_, alpha, step, *_), answer = asked("09.alpha", seed)
    parameters = replace(pl.TABLE_6_1, alphas=(0.0, 0.0, alpha, 0.0))
    assert 100 * motion_deviations(0.0, step, 0.0, parameters)[1] == pytest.approx(answer)


@pytest.mark.parametrize("seed", SEEDS)
def test_09_added_counts_cell_by_cell(seed):
    (n_right, n_wrong, kept, found), answer = asked("09.added", seed)
    plan = np.repeat([True, False], [int(n_right), int(n_wrong)])
    drawn = plan.copy()
    drawn[: int(n_right - kept)] = False
    drawn[int(n_right) : int(n_right + found)] = True
    assert int(drawn.sum()) - int(plan.sum()) == answer


def test_09_honest_takes_any_right_way_to_write_it():
    def by_hand(gains, ates):
        total = n = 0
        for gain, ate in zip(gains, ates, strict=True):
            if not ate > 1:
                total, n = total + gain, n + 1
        return total / n

    assert check("09.honest", by_hand).right
    assert "the lost runs are in it" in check("09.honest", lambda gains, ates: sum(gains) / len(gains)).says
