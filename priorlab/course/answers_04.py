"""The exercises of notebook 04, log odds.

The answers are worked out with `math` alone: the library does not mark its own work. Tests hold the two against each other.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from priorlab.course.exercise import Exercise, Mistake

Function = Callable[..., Any]


def exercises(seed: int = 0) -> dict[str, Exercise]:
    """The exercises of notebook 04 with one learner's numbers."""
    rng = np.random.default_rng([4, seed])
    return {"04.log_odds": _log_odds(), "04.one_cell": _one_cell(rng), "04.closed_form": _closed_form(), "04.flip": _flip(rng)}


def _logit(p: float) -> float:
    """eq. 2.16."""
    return math.log(p / (1 - p))


def _sigmoid(value: float) -> float:
    """eq. 4.21."""
    return 1 - 1 / (1 + math.exp(value))


def _log_odds() -> Exercise:
    """Write eq. 2.16 as a function."""
    return Exercise(
        asks="Write a function that takes P(empty) and returns its log odds, eq. 2.16.",
        answer=lambda: _logit,
        because="l(0.9) = 2.197, l(0.5) = 0, l(0.1) = -2.197: the sign says empty or wall, the size says how sure.",
        mistakes=(
            Mistake(lambda: lambda p: math.log10(p / (1 - p)), "that is log10; log odds here are natural, math.log."),
            Mistake(lambda: lambda p: math.log2(p / (1 - p)), "that is log2; log odds here are natural, math.log."),
            Mistake(lambda: lambda p: -_logit(p), "the sign is turned round (convention flipped): P(empty) belongs on top."),
            Mistake(lambda: math.log, "that is the logarithm of p alone; the odds are p / (1 - p)."),
            Mistake(lambda: lambda p: p / (1 - p), "those are the odds; their logarithm is missing."),
            Mistake(lambda: lambda p: math.log(p) / (1 - p), "a bracket: the logarithm of the whole quotient p / (1 - p)."),
        ),
        hints=("odds first: how much likelier is empty than wall?", "math.log(p / (1 - p))."),
        inputs=((0.5,), (0.9,), (0.1,), (0.72,)),
        tolerance=1e-3,
    )


def _one_cell(rng: np.random.Generator) -> Exercise:
    """One cell by hand, lam = 1."""
    p = float(rng.choice([0.63, 0.72, 0.81]))
    n_wall = int(rng.integers(1, 3))
    n_free = n_wall + int(rng.integers(1, 3))
    looks, start, total = n_free + n_wall, _logit(p), (n_free - n_wall) * _logit(0.9)

    def ends_at(lam: float) -> float:
        """Log odds at the end."""
        return start + total - lam * looks * start

    return Exercise(
        asks=(
            f"A cell starts at P(empty) = {p:g}. It is seen free {n_free} times and as wall {n_wall} time{'s' * (n_wall > 1)}; "
            "the sensor model says 0.9 and 0.1, lam = 1.\nWhat is P(empty) now, to three decimals?"
        ),
        answer=lambda: _sigmoid(ends_at(1.0)),
        because="l0 + S - n l0, and back through eq. 4.21.",
        mistakes=(
            Mistake(lambda: ends_at(1.0), "those are the log odds; go back to a probability with eq. 4.21."),
            Mistake(lambda: _sigmoid(ends_at(0.0)), "that is lam = 0: l0 must be taken off at every reading (eq. 2.15)."),
            Mistake(lambda: _sigmoid(total - looks * start), "the start is missing: before the first reading l = l0 already."),
            Mistake(lambda: 1 - _sigmoid(ends_at(1.0)), "that is P(wall) (convention flipped)."),
            Mistake(
                lambda: _sigmoid(start - total - looks * start),
                "free and wall readings are swapped (convention flipped): a free one adds, a wall one takes away.",
            ),
            Mistake(
                lambda: _sigmoid(start + total - (looks - 1) * start),
                "l0 is taken off once too little: every reading takes it off, and the start adds it once.",
            ),
            Mistake(lambda: _sigmoid(total), "the prior is missing: that is the end of a cell that starts at 0.5."),
            Mistake(lambda: 100 * _sigmoid(ends_at(1.0)), "that is in per cent; a probability lies between 0 and 1."),
            Mistake(
                lambda: _sigmoid(ends_at(1.0) / math.log(10)), "log10 went in, exp came out: use the natural logarithm (log10)."
            ),
        ),
        hints=(
            "S = (free readings) x logit(0.9) + (wall readings) x logit(0.1).",
            "l = l0 + S - n l0 with n = all readings; then P = 1 - 1 / (1 + exp(l)).",
        ),
        tolerance=1e-3,
    )


def _closed_form() -> Exercise:
    """All readings in one line."""

    def right(start: float, total: float, looks: int, lam: float) -> float:
        """l = l0 + S - lam n l0."""
        return start + total - lam * looks * start

    return Exercise(
        asks="Write a function of l0, S, n and lam that gives the log odds after n readings whose logits sum to S.",
        answer=lambda: right,
        because="the sum forgets the order of the readings, so one pass over the data serves every prior and both updates.",
        mistakes=(
            Mistake(lambda: lambda start, total, n, lam: start + total + lam * n * start, "wrong sign: eq. 2.15 takes l0 OFF."),
            Mistake(
                lambda: lambda start, total, n, lam: total - lam * n * start,
                "the start is missing: without readings the cell must still be at l0.",
            ),
            Mistake(
                lambda: lambda start, total, n, lam: start + total - n * start, "lam is missing: you wrote the case lam = 1."
            ),
            Mistake(
                lambda: lambda start, total, n, lam: start + total - lam * (n - 1) * start,
                "n - 1 is one too few: eq. 2.18 has it because there the start l0 is already counted in; here it stands alone.",
            ),
            Mistake(lambda: lambda start, total, n, lam: start + total, "that is lam = 0; lam n l0 is missing."),
            Mistake(
                lambda: lambda start, total, n, lam: start + n * total - lam * n * start,
                "S is the sum of all readings already: no n before it.",
            ),
            Mistake(lambda: lambda *numbers: _sigmoid(right(*numbers)), "that is the probability; asked are the log odds."),
        ),
        hints=("try n = 0: the answer must be l0.", "write eq. 2.15 three times under each other and add the lines."),
        inputs=((1.4, 0.0, 0, 1.0), (1.4, 4.4, 2, 1.0), (1.4, 4.4, 2, 0.0), (-2.0, 6.6, 3, 0.5)),
        tolerance=1e-3,
    )


def _flip(rng: np.random.Generator) -> Exercise:
    """The prior above which free readings make a wall."""
    p_free = float(rng.choice([0.7, 0.8, 0.85]))
    looks = int(rng.integers(4, 8))
    total, edge = looks * _logit(p_free), _logit(0.2)
    return Exercise(
        asks=(
            f"A cell is seen free {looks} times; the sensor model calls that {p_free:g}, lam = 1.\n"
            "Above which effective prior P(empty) does it nevertheless end as a detected WALL, P(empty) <= 0.2? Three decimals."
        ),
        answer=lambda: _sigmoid((total - edge) / (looks - 1)),
        because="l = S - (n - 1) l0 falls when l0 rises: from there on, believing the cell emptier makes it a wall.",
        mistakes=(
            Mistake(lambda: (total - edge) / (looks - 1), "those are the log odds; go back to a probability with eq. 4.21."),
            Mistake(
                lambda: _sigmoid(total / (looks - 1)), "that is where the cell passes 0.5; a detected wall needs 0.2 or less."
            ),
            Mistake(
                lambda: _sigmoid((total - edge) / looks), "you divided by n: the start counts once with plus, so n - 1 remain."
            ),
            Mistake(lambda: 1 - _sigmoid((total - edge) / (looks - 1)), "that is P(wall) (convention flipped)."),
            Mistake(
                lambda: _sigmoid((total - edge) / (looks - 1) / math.log(10)),
                "log10 went in, exp came out: use the natural logarithm (log10).",
            ),
            Mistake(
                lambda: _sigmoid((total - edge) / (looks - 1)) / 0.9,
                "that is the slider's value; asked is the effective one, after the factor 0.9.",
            ),
            Mistake(lambda: p_free, "that is eq. 2.22's bound: there more readings stop helping; the wall comes a little later."),
        ),
        hints=("set l0 + S - n l0 equal to logit(0.2).", "solve for l0: (S - logit(0.2)) / (n - 1); then eq. 4.21."),
        tolerance=1e-3,
    )
