"""The checks of the exercises: right answers, typical wrong ones, dots, hints - for several learners' seeds."""

from __future__ import annotations

import math
from collections import Counter

import numpy as np
import pytest

from priorlab.core.grid_map import Prior
from priorlab.core.log_odds import log_odds, probability
from priorlab.core.score import Score
from priorlab.course import answer_key, ask, check
from priorlab.course.checking import exercises

SEEDS = range(12)
UNIQUE = [name for name, exercise in exercises().items() if exercise.accept is None]


@pytest.mark.parametrize("name", UNIQUE)
def test_check_right_answer_is_right_for_every_seed(name):
    for seed in SEEDS:
        verdict = check(name, exercises(seed)[name].answer(), seed)
        assert verdict.right and repr(verdict).startswith("Right: ")


@pytest.mark.parametrize("name", UNIQUE)
def test_check_names_each_typical_mistake(name):
    for seed in SEEDS:
        for mistake in exercises(seed)[name].mistakes:
            verdict = check(name, mistake.answer(), seed)
            assert not verdict.right
            assert verdict.says == f"Not quite: {mistake.says}", (seed, verdict.says)


@pytest.mark.parametrize("name", exercises())
def test_check_dots_are_not_yet(name):
    assert repr(check(name, ...)).startswith("Not yet: replace the dots")
    assert not check(name, ...).right


def test_check_function_that_returns_dots_is_not_yet():
    assert "replace the dots" in check("04.log_odds", lambda p: ...).says


def test_check_number_where_a_function_is_asked():
    assert check("04.log_odds", 2.2).says == "Not yet: 04.log_odds asks for a function, got float."


def test_check_function_that_raises_tells_what():
    assert "ZeroDivisionError" in check("04.log_odds", lambda p: 1 / 0).says


def test_check_hints_come_one_after_the_other(monkeypatch):
    monkeypatch.setattr("priorlab.course.checking._tries", Counter())
    said = [check("04.one_cell", 0.123456).says for _ in range(3)]
    assert "Hint 1 of 2" in said[0] and "Hint 2 of 2" in said[1] and said[2] == said[1]


def test_check_unknown_name_gives_the_nearest():
    with pytest.raises(ValueError, match="did you mean '04.one_cell'"):
        check("04.one_sell", 0.5)


@pytest.mark.parametrize("wrong", ["wall", None, [1, 2, 3], np.nan, object()])
def test_check_nonsense_is_told_in_a_sentence(wrong):
    assert not check("04.flip", wrong).right


def test_exercises_mistakes_differ_from_the_answer_and_from_each_other():
    for seed in SEEDS:
        for name, exercise in exercises(seed).items():
            answers = [exercise.values(mistake.answer()) for mistake in exercise.mistakes]
            answers += [exercise.values(exercise.answer())] if exercise.accept is None else []
            for i, one in enumerate(answers):
                for other in answers[i + 1 :]:
                    assert not exercise.agree(one, other), (seed, name, one, other)


def test_exercises_have_hints_and_are_asked(capsys):
    for name, exercise in exercises().items():
        assert exercise.hints and exercise.because
        ask(name)
        assert capsys.readouterr().out.strip() == exercise.asks


def test_seed_changes_the_numbers_but_not_the_names():
    assert exercises(0).keys() == exercises(5).keys()
    assert len({exercises(seed)["04.one_cell"].asks for seed in SEEDS}) > 3


def test_answer_key_agrees_with_the_library():
    key = answer_key()
    assert key["04.log_odds"] == pytest.approx(log_odds([0.5, 0.9, 0.1, 0.72]).tolist())
    asked = exercises()["04.one_cell"].asks
    assert asked.startswith("A cell starts at P(empty) = 0.81. It is seen free 4 times and as wall 2 times")
    l_0 = log_odds(0.81)
    assert key["04.one_cell"] == pytest.approx(float(probability(l_0 + 2 * log_odds(0.9) - 6 * l_0)))
    assert key["00.f2"] == pytest.approx(Score(tp=710, fp=100, fn=400, tn=0).f_beta)


def test_flip_answer_stands_exactly_on_the_threshold():
    for seed in SEEDS:
        asks = exercises(seed)["04.flip"].asks.split()
        looks, p_free = int(asks[asks.index("free") + 1]), float(asks[asks.index("that") + 1].rstrip(","))
        l_0 = log_odds(exercises(seed)["04.flip"].answer())
        assert l_0 + looks * log_odds(p_free) - looks * l_0 == pytest.approx(math.log(0.2 / 0.8))


def test_worse_judges_by_running_the_map(monkeypatch):
    f2 = {Prior(0.2, 0.9): 0.7, Prior(0.9, 0.2): 0.1, Prior.uninformed(): 0.4}
    monkeypatch.setattr("priorlab.course.answers_00._f2_of", f2.__getitem__)
    assert check("00.worse", (0.9, 0.2)).right
    assert "F2 0.700, without a prior 0.400" in check("00.worse", (0.2, 0.9)).says
    assert "two numbers" in check("00.worse", 0.5).says
    assert "effective p_wall must lie strictly between 0 and 1" in check("00.worse", (0, 0.5)).says


def test_worse_really_runs_the_notebooks_map():
    assert check("00.worse", (0.9, 0.2)).right
    assert "without a prior 0." in check("00.worse", (0.2, 1.0)).says  # breaks eq. 2.22, which is no reason to warn here


def test_check_tells_an_answer_of_another_kind():
    assert "asked is one number, you gave a list of 3 numbers" in check("04.one_cell", [1.0, 2.0, 3.0]).says
    assert "that is no number but str" in check("04.one_cell", "wall").says


def test_check_misses_the_return():
    assert "is `return` missing?" in check("04.closed_form", lambda *arguments: None).says
