"""An exercise: the right answer as code that computes it, the typical mistakes, the hints, and how answers are compared."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Mistake:
    """A wrong answer that has a reason.

    Parameters
    ----------
    answer : computes what somebody gets who makes this mistake (returns a function, when the exercise asks for one)
    says : one sentence that names the mistake
    """

    answer: Callable[[], Any]
    says: str


@dataclass(frozen=True)
class Exercise:
    """One question of a notebook.

    Parameters
    ----------
    asks : the question, with its numbers
    answer : computes the right answer; returns a function, when the exercise asks for one
    because : said when the answer is right
    mistakes : the first that gives the learner's answer is named
    hints : told one after the other, one for each wrong try
    inputs : arguments with which a function that was asked for is called
    tolerance : how far a number may lie from the right one
    ordered : whether the order of several numbers counts
    accept : judges answers that are not unique: None when right, otherwise the sentence that says what is missing
    """

    asks: str
    answer: Callable[[], Any]
    because: str
    mistakes: tuple[Mistake, ...] = ()
    hints: tuple[str, ...] = ()
    inputs: tuple[tuple[Any, ...], ...] = ()
    tolerance: float = 1e-6
    ordered: bool = True
    accept: Callable[[Any], str | None] | None = None

    def values(self, answer: Any) -> Any:
        """What is compared: the answer itself, or what the function that was asked for returns on the inputs."""
        return [answer(*arguments) for arguments in self.inputs] if self.inputs else answer

    def other_kind(self, given: Any) -> str | None:
        """What an answer is instead of what was asked for: no numbers, or too many of them; None when it is of the right kind."""
        for seen, asked in self._pairs(given, self.values(self.answer())):
            one, right = as_numbers(seen), as_numbers(asked)
            if right is None or (one is not None and one.shape == right.shape):
                continue
            if one is None:
                return f"that is no number but {type(seen).__name__}."
            return f"asked is {_shape(right.shape)}, you gave {_shape(one.shape)}."
        return None

    def agree(self, first: Any, second: Any) -> bool:
        """True when two answers are one; of functions, when they return the same on every input."""
        return all(self._same(one, other) for one, other in self._pairs(first, second))

    def _pairs(self, first: Any, second: Any) -> list[tuple[Any, Any]]:
        """What is held against each other: of functions what they return on each input, which may differ in length."""
        return list(zip(first, second, strict=True)) if self.inputs else [(first, second)]

    def _same(self, first: Any, second: Any) -> bool:
        """True for numbers of one shape that lie within the tolerance."""
        one, other = as_numbers(first), as_numbers(second)
        if one is None or other is None or one.shape != other.shape:
            return False
        if not self.ordered:
            one, other = np.sort(one, axis=None), np.sort(other, axis=None)
        return bool(np.allclose(one, other, rtol=0.0, atol=self.tolerance))


def as_numbers(answer: Any) -> np.ndarray | None:
    """The answer as an array of floats, or None when it is no such thing.

    >>> as_numbers((1, 2)).tolist(), as_numbers("wall")
    ([1.0, 2.0], None)
    """
    try:
        return np.asarray(answer, dtype=np.float64)
    except (TypeError, ValueError):
        return None


def _shape(shape: tuple[int, ...]) -> str:
    """In words."""
    if len(shape) > 1:
        return " x ".join(map(str, shape)) + " numbers"
    return "one number" if not shape else f"a list of {shape[0]} number" + "s" * (shape[0] != 1)
