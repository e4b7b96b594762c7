"""The answers of notebook 08, worked out by hand there, are what the library gives."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
from filterpy.monte_carlo import resampling as upstream

from priorlab.course.checking import check, exercises
from priorlab.slam.likelihood_field import log_likelihood_of
from priorlab.slam.motion import motion_parts
from priorlab.slam.parameters import TABLE_6_1
from priorlab.slam.particles import Particles

SEEDS = range(6)


def asked(name, seed):
    """The numbers of the question in order, and the right answer."""
    exercise = exercises(seed)[name]
    return [float(number) for number in re.findall(r"\d+\.?\d*", exercise.asks)], exercise.answer()


def test_08_parts_are_those_of_the_motion_model():
    exercise = exercises()["08.parts"]
    for before, after in exercise.inputs:
        assert exercise.answer()(before, after) == pytest.approx(motion_parts(before, after))


@pytest.mark.parametrize("seed", SEEDS)
def test_08_beam_is_what_the_field_holds(seed):
    (distance, sigma, z_random, z_max, *_), answer = asked("08.beam", seed)
    parameters = replace(TABLE_6_1, sigma_hit_m=sigma, z_random=z_random, max_range_m=z_max)
    assert answer == pytest.approx(float(log_likelihood_of(np.array(distance), parameters)), abs=1e-5)


@pytest.mark.parametrize("seed", SEEDS)
def test_08_ess_is_the_effective_number(seed):
    raw, answer = asked("08.ess", seed)
    assert answer == pytest.approx(Particles(np.zeros((4, 3)), np.log(raw)).effective_number)


def test_08_residual_pays_everybody_their_due_and_filterpy_does_not(monkeypatch):
    exercise = exercises()["08.residual"]
    monkeypatch.setattr(upstream, "random", np.random.default_rng(0).random)  # in place of NumPy's global generator
    for (weights,) in exercise.inputs:
        n, shares = len(weights), np.array(exercise.answer()(weights))
        whole = np.floor(n * np.array(weights))
        assert whole + (n - whole.sum()) * shares == pytest.approx(n * np.array(weights))  # owed = sure + raffled on average
        paid = np.mean([np.bincount(upstream.residual_resample(np.array(weights)), minlength=n) for _ in range(500)], axis=0)
        assert np.abs(paid - n * np.array(weights)).max() > 0.3  # upstream's bug: issue 290


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("written_in", [4, 5, 6, 7, 9])
def test_08_residual_wants_the_number_of_particles_and_not_one_that_is_written_in(written_in, seed):
    def hard_coded(weights):
        left_over = np.array(weights) * written_in % 1
        return left_over / left_over.sum()

    assert not check("08.residual", hard_coded, seed).right


@pytest.mark.parametrize("seed", range(40))
def test_08_residual_asks_what_can_be_answered(seed):
    for (weights,) in exercises(seed)["08.residual"].inputs:
        owed = len(weights) * np.array(weights)
        assert sum(weights) == pytest.approx(1) and min(weights) > 0
        assert np.abs(owed - np.rint(owed)).min() > 0.009  # no N w that rounding could push over a whole number
    right = exercises(seed)["08.residual"].answer()
    assert check("08.residual", right, seed).right


def test_08_residual_filterpys_line_is_told_by_name():
    def as_in_filterpy(weights):
        residual = np.array(weights) - np.floor(len(weights) * np.array(weights))
        return residual / residual.sum()

    assert "filterpy's line" in check("08.residual", as_in_filterpy).says
