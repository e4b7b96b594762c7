"""The exercises of notebook 05, Pareto sweep. Worked out by hand or with `math`; tests hold them against the library."""

from __future__ import annotations

from typing import Any

import numpy as np

from priorlab.course.exercise import Exercise, Mistake

FACTOR = 0.9


def exercises(seed: int = 0) -> dict[str, Exercise]:
    """The exercises of notebook 05 with one learner's numbers."""
    rng = np.random.default_rng([5, seed])
    return {"05.front": _front(rng, seed), "05.threshold": _threshold(rng, seed), "05.row": _row(rng, seed)}


def _front(rng: np.random.Generator, seed: int) -> Exercise:
    """Which of five points are Pareto optimal."""
    points = [(0.95, 0.40), (0.90, 0.38), (0.80, 0.70), (0.80, 0.60), (0.60, 0.85)]
    order = np.arange(5) if seed == 0 else rng.permutation(5)
    points = [points[i] for i in order]
    names = {
        name: int(np.flatnonzero(order == i)[0]) for i, name in enumerate(("precise", "second", "middle", "weak", "complete"))
    }
    shown = "\n".join(f"  {i}: precision {precision:.2f}, recall {recall:.2f}" for i, (precision, recall) in enumerate(points))

    def picked(*which: str) -> list[int]:
        """Their numbers in order."""
        return sorted(names[name] for name in which)

    return Exercise(
        asks=f"Five priors:\n{shown}\nWhich are Pareto optimal? Answer a list of their numbers.",
        answer=lambda: picked("precise", "middle", "complete"),
        because="each of the others is beaten in one measure by a prior that is not worse in the other.",
        mistakes=(
            Mistake(
                lambda: picked("precise", "complete"), "the best of each measure alone are not all: who beats the one between?"
            ),
            Mistake(
                lambda: picked("precise", "middle", "weak", "complete"),
                "equal precision and less recall is beaten, too: better in one and not worse in the other is enough.",
            ),
            Mistake(lambda: picked("second", "weak"), "those are the ones that are beaten."),
            Mistake(lambda: picked("middle"), "that is the best compromise (F2 or so); the front holds all that nobody beats."),
            Mistake(lambda: picked("precise", "second", "middle", "complete"), "one of them has less of both than another."),
            Mistake(lambda: list(range(5)), "two of the five are beaten."),
            Mistake(
                lambda: [1 + i for i in picked("precise", "middle", "complete")], "counted from 1: the first prior is number 0."
            ),
            Mistake(
                lambda: [i in picked("precise", "middle", "complete") for i in range(5)],
                "that is a yes or no for each; asked are the numbers of those that remain.",
            ),
        ),
        hints=("take each prior in turn: does any other have at least as much of both?", "three of the five remain."),
        ordered=False,
    )


def _threshold(rng: np.random.Generator, seed: int) -> Exercise:
    """Where the cliff is."""
    threshold = 0.35 if seed == 0 else float(rng.choice([0.3, 0.25, 0.4, 0.15]))
    return Exercise(
        asks=(
            f"Somebody scores maps at the threshold P(empty) <= {threshold:g} instead of 0.2. Up to which value of the slider\n"
            "p_wall do the plan's walls still count in places that nobody looked at? Three decimals."
        ),
        answer=lambda: threshold / FACTOR,
        because="an unseen cell keeps its prior, and 0.9 x slider <= threshold. The optimum moves with it.",
        mistakes=(
            Mistake(lambda: threshold, "that is the effective value; the slider shows it before the factor 0.9."),
            Mistake(lambda: threshold * FACTOR, "you multiplied; slider times 0.9 must stay at or below the threshold."),
            Mistake(lambda: 0.2 / FACTOR, "that is the cliff of the threshold 0.2: it moves."),
            Mistake(lambda: 1 - threshold, "that is P(wall) (convention flipped)."),
            Mistake(lambda: (1 - threshold) / FACTOR, "that is P(wall) (convention flipped), over 0.9."),
            Mistake(lambda: 100 * threshold / FACTOR, "that is in per cent; the slider runs from 0 to 1."),
        ),
        hints=("no reading: l = l0, P(empty) = effective p_wall.", "0.9 x slider = threshold."),
        tolerance=1e-3,
    )


def _row(rng: np.random.Generator, seed: int) -> Exercise:
    """A row of Table 4.2 from three counts."""
    unseen, once, twice = (300, 200, 450) if seed == 0 else (int(n) for n in 10 * rng.choice(np.arange(11, 60), 3, replace=False))

    def pair(low: int, high: int) -> Any:
        """Detected at 0.2 and at 1.0."""
        return (low, high)

    return Exercise(
        asks=(
            f"A plan's walls: {unseen} pixels lie in cells that were never seen, {once} in cells seen once, as wall, and\n"
            f"{twice} in cells seen twice, once free and once as wall. Sensor 0.9 and 0.1, lam = 1, threshold 0.2.\n"
            "How many are detected with p_wall = 0.2, how many with p_wall = 1.0 (before the factor)? Answer two numbers."
        ),
        answer=lambda: pair(unseen + once, once + twice),
        because="unseen cells want a low prior; cells seen once do not care; contradicting looks end at -l0 and want a high one.",
        mistakes=(
            Mistake(
                lambda: pair(unseen + once + twice, once), "that is what one would expect: low is wall. With n = 2 it is turned."
            ),
            Mistake(
                lambda: pair(unseen + once + twice, 0), "that is lam = 0: there one free and one wall reading leave the prior."
            ),
            Mistake(lambda: pair(once + twice, unseen + once), "the two numbers are swapped: p_wall = 0.2 comes first."),
            Mistake(lambda: pair(unseen, twice), "cells seen once as wall are walls with every prior: add them to both."),
            Mistake(
                lambda: pair(unseen + once, unseen + once + twice),
                "an unseen cell at 0.9 x 1.0 is no wall: there the prior alone decides.",
            ),
            Mistake(
                lambda: pair(unseen + once + twice, unseen + once + twice),
                "that is every wall of the plan; with each prior one kind of cell is lost.",
            ),
        ),
        hints=("l = l0 + S - n l0, class by class; S = 0 for one free and one wall.", "never: l0. once: S. twice: -l0."),
    )
