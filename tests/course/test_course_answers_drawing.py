"""The answers of notebooks 01 and 02, worked out by hand, against the library."""

from __future__ import annotations

import math

import numpy as np
import pytest

from priorlab.core.building import Truth
from priorlab.core.drawing import Drawing
from priorlab.core.score import score_mask
from priorlab.course.checking import exercises
from priorlab.drawing.baselines import dilation
from priorlab.drawing.connectivity import forward_neighbours
from priorlab.drawing.geometry import angles_deg, side_lengths
from priorlab.drawing.overlap import shared_area
from priorlab.drawing.sweeps import HORIZONTAL, sweep_walls

SEEDS = range(6)


def numbers_of(text):
    """Every number in a question."""
    cleaned = "".join(letter if letter.isdigit() or letter == "." else " " for letter in text)
    return [float(word.strip(".")) for word in cleaned.split() if word.strip(".")]


@pytest.mark.parametrize("seed", SEEDS)
def test_angle_answer_agrees_with_the_geometry_test(seed):
    exercise = exercises(seed)["01.angle"]
    right = exercise.answer()
    for vertices in exercise.inputs:
        assert right(*vertices) == pytest.approx(angles_deg(side_lengths(np.array(vertices))).max())


@pytest.mark.parametrize("seed", SEEDS)
def test_neighbours_answer_agrees_with_the_walk(seed):
    exercise = exercises(seed)["01.neighbours"]
    right = exercise.answer()
    for start, goal in exercise.inputs:
        ahead = sorted([start[0] + dx, start[1] + dy] for dx, dy in forward_neighbours(tuple(start), tuple(goal)))
        assert right(start, goal) == ahead


@pytest.mark.parametrize("seed", SEEDS)
def test_overlap_answer_agrees_with_the_library(seed):
    exercise = exercises(seed)["01.overlap"]
    _, _, small, _, _, large, shift, *_ = numbers_of(exercise.asks.split("The first")[1].join(["0 0 ", ""]))
    one = [(0, 0), (small, 0), (0, small)]
    other = [(shift, 0), (shift + large, 0), (shift, large)]
    assert exercise.answer() == pytest.approx(shared_area(one, other), abs=1e-5)


def test_triples_answer_is_the_one_of_the_text():
    assert exercises()["01.triples"].answer()(200) == 1_313_400 == math.comb(200, 3)


@pytest.mark.parametrize("seed", SEEDS)
def test_sweep_answer_agrees_with_the_library(seed):
    exercise = exercises(seed)["02.sweep"]
    for wall, ink in exercise.inputs:
        swept = sweep_walls(ink.astype(bool), wall.astype(bool), HORIZONTAL, 1)[-1]
        assert exercise.answer()(wall, ink) == swept.astype(int).tolist()


@pytest.mark.parametrize("seed", SEEDS)
def test_score_answer_agrees_with_the_library(seed):
    exercise = exercises(seed)["02.score"]
    for detected, truth, ignore in exercise.inputs:
        score = score_mask(detected, Truth(truth.astype(bool), ignore.astype(bool)))
        assert exercise.answer()(detected, truth, ignore) == pytest.approx(
            [score.precision, score.recall, score.false_positive_rate]
        )


@pytest.mark.parametrize("seed", SEEDS)
def test_dilation_answer_agrees_with_the_baseline(seed):
    exercise = exercises(seed)["02.dilation"]
    thick, side = (int(number) for number in numbers_of(exercise.asks)[:2])
    grey = np.full((40, 200), 255, dtype=np.uint8)
    grey[10 : 10 + thick] = 0
    middle = dilation(Drawing(grey), side)[:, 100]
    assert exercise.answer() == pytest.approx(middle.sum() / thick)
