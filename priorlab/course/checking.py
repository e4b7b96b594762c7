"""`check(name, answer)`: right, the name of the mistake, or the next hint.

>>> check("00.occupancy", ...)
Not yet: replace the dots by your answer to 00.occupancy.
>>> check("00.occupancy", 0.3)
Not quite: that is the field's occupancy itself; here every probability is P(empty) (convention flipped).
>>> check("00.occupancy", 0.7)
Right: P(empty) = 1 - occupancy; only the border to other software converts.
"""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass
from typing import Any

from priorlab.core.shipped import nearest_name
from priorlab.course import (
    answers_00,
    answers_01,
    answers_02,
    answers_03,
    answers_04,
    answers_05,
    answers_06,
    answers_07,
    answers_08,
    answers_09,
)
from priorlab.course.exercise import Exercise

_tries: Counter[str] = Counter()  # wrong tries so far in this session: decides which hint comes next, nothing else


@dataclass(frozen=True)
class Verdict:
    """What `check` says; `verdict.right` for programs."""

    right: bool
    says: str

    def __repr__(self) -> str:
        return self.says


def exercises(seed: int = 0) -> dict[str, Exercise]:
    """Every exercise of the course by its name: the notebook's number, a dot, a word. A seed changes the numbers."""
    first = (answers_00, answers_01, answers_02, answers_03, answers_04)
    notebooks = (*first, answers_05, answers_06, answers_07, answers_08, answers_09)
    return {name: exercise for notebook in notebooks for name, exercise in notebook.exercises(seed).items()}


def ask(name: str, seed: int = 0) -> None:
    """Print the question of an exercise.

    >>> ask("00.occupancy")
    A ROS map says that a cell has occupancy 0.3. What is its P(empty)?
    """
    print(_find(name, seed).asks)


def answer_key(seed: int = 0) -> dict[str, Any]:
    """For teachers: what each exercise wants; for a function, what it returns on the inputs that are tried."""
    return {name: exercise.values(exercise.answer()) for name, exercise in exercises(seed).items()}


def check(name: str, answer: Any, seed: int = 0) -> Verdict:
    """Compare an answer with the one that is computed here.

    Parameters
    ----------
    name : such as "04.one_cell"
    answer : a number, a tuple, an array or a function, as the exercise asks; `...` while it is not solved
    seed : the learner's own, as in `ask`

    Raises
    ------
    ValueError
        When there is no exercise of that name; the sentence gives the nearest one.
    """
    exercise = _find(name, seed)
    if _is_unsolved(answer):
        return Verdict(False, f"Not yet: replace the dots by your answer to {name}.")
    if exercise.inputs and not callable(answer):
        return Verdict(False, f"Not yet: {name} asks for a function, got {type(answer).__name__}.")
    try:
        given = exercise.values(answer)
    except Exception as error:  # the learner's own function; whatever it raises is their next clue
        return Verdict(False, f"Not yet: your function stopped with {type(error).__name__}: {error}.")
    if exercise.inputs and any(value is None for value in given):
        return Verdict(False, "Not yet: your function returns nothing; is `return` missing?")
    if exercise.inputs and any(_is_unsolved(value) for value in given):
        return Verdict(False, f"Not yet: replace the dots by your answer to {name}.")
    if exercise.accept is not None:
        missing = exercise.accept(given)
        return Verdict(True, f"Right: {exercise.because}") if missing is None else _hint(name, exercise, missing)
    if exercise.agree(given, exercise.values(exercise.answer())):
        return Verdict(True, f"Right: {exercise.because}")
    for mistake in exercise.mistakes:
        if exercise.agree(given, exercise.values(mistake.answer())):
            return Verdict(False, f"Not quite: {mistake.says}")
    return _hint(name, exercise, exercise.other_kind(given) or "that is not it.")


def _find(name: str, seed: int) -> Exercise:
    """The exercise, or a sentence with the nearest name."""
    known = exercises(seed)
    return known[nearest_name("exercise", name, list(known))]


def _is_unsolved(answer: Any) -> bool:
    """True for the student copy's dots, for nothing and for nan."""
    return answer is ... or answer is None or (isinstance(answer, float) and math.isnan(answer))


def _hint(name: str, exercise: Exercise, missing: str) -> Verdict:
    """The next hint; after the last one the last again."""
    if not exercise.hints:
        return Verdict(False, f"Not quite: {missing}")
    step = min(_tries[name], len(exercise.hints) - 1)
    _tries[name] += 1
    return Verdict(False, f"Not quite: {missing} Hint {step + 1} of {len(exercise.hints)}: {exercise.hints[step]}")
