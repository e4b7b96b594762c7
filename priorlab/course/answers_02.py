"""The exercises of notebook 02, walls.

The answers are worked out with plain loops: the library does not mark its own work. Tests hold the two against each other.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from priorlab.course.exercise import Exercise, Mistake

Function = Callable[..., Any]


def exercises(seed: int = 0) -> dict[str, Exercise]:
    """The exercises of notebook 02 with one learner's numbers."""
    rng = np.random.default_rng([2, seed])
    return {"02.sweep": _sweep(rng), "02.score": _score(rng), "02.dilation": _dilation(rng)}


def _grown(wall: Any, ink: Any, ways: tuple[int, ...] = (-1, 1), across: bool = True, gaps: bool = False) -> list[list[int]]:
    """A sweep by loops: from every wall pixel along a row (or a column) as long as there is ink."""
    ink, found = np.asarray(ink), np.array(wall)
    for row, col in np.argwhere(np.asarray(wall)):
        for way in ways:
            y, x = int(row), int(col)
            while 0 <= y < ink.shape[0] and 0 <= x < ink.shape[1] and (gaps or ink[y, x]):
                found[y, x] = ink[y, x]
                y, x = (y, x + way) if across else (y + way, x)
    return found.astype(int).tolist()


def _sweep(rng: np.random.Generator) -> Exercise:
    """One horizontal sweep."""
    inputs = []
    for _ in range(2):
        ink = np.zeros((5, 9), dtype=int)
        ink[1, [0, 1, 2, 3, 4, 7, 8]] = 1
        ink[0:5, 2] = 1
        ink[3, 1:8] = 1
        ink[4, int(rng.integers(4, 8))] = 1
        wall = np.zeros_like(ink)
        wall[1, 2] = wall[3, int(rng.integers(3, 6))] = 1
        inputs.append((wall, ink))

    def eroded(wall: Any, ink: Any) -> list[list[int]]:
        """Eq. 3.16 to the letter: dark, and dark to the left and above."""
        ink = np.asarray(ink)
        found = np.zeros_like(ink)
        found[1:, 1:] = ink[1:, 1:] & ink[1:, :-1] & ink[:-1, 1:]
        return (found | np.asarray(wall)).tolist()

    return Exercise(
        asks=(
            "Write a function of wall and ink (arrays of 0 and 1, one shape) that returns the wall after ONE horizontal sweep:\n"
            "the wall, and every ink pixel that is reached from it along its row without crossing white."
        ),
        answer=lambda: _grown,
        because="a sweep adds every maximal dark run along its axis that meets the wall found so far (eq. 3.16, 3.17).",
        mistakes=(
            Mistake(lambda: lambda wall, ink: _grown(wall, ink, across=False), "that went along columns: a vertical sweep."),
            Mistake(lambda: lambda wall, ink: _grown(wall, ink, (1,)), "that went to the right only; eq. 3.16 is the left half."),
            Mistake(
                lambda: lambda wall, ink: _grown(wall, ink, (-1,)), "that went to the left only; eq. 3.17 is the right half."
            ),
            Mistake(
                lambda: lambda wall, ink: _grown(wall, ink, gaps=True), "that jumped over white: a run ends at the first one."
            ),
            Mistake(lambda: eroded, "that is the equations to the letter, an erosion; a sweep must START at the wall and grow."),
            Mistake(lambda: lambda wall, ink: np.asarray(ink).tolist(), "that is all the ink, reached or not."),
            Mistake(lambda: lambda wall, ink: np.asarray(wall).tolist(), "nothing grew: that is the wall you started from."),
        ),
        hints=(
            "from each wall pixel go left while there is ink, then right while there is ink.",
            "for every row, col of np.argwhere(wall): col -= 1 while ink[row, col]; set found[row, col] = 1; the same with + 1.",
        ),
        inputs=tuple(inputs),
    )


def _score(rng: np.random.Generator) -> Exercise:
    """Precision, recall and false positive rate with don't-care."""
    inputs = []
    for _ in range(2):
        detected, truth, ignore = np.zeros((3, 6, 8), dtype=int)
        truth[1, :7] = 1
        detected[1, : int(rng.integers(4, 6))] = 1
        detected[1, 6] = detected[4, 2] = detected[5, 7] = detected[0, 5] = detected[3, 0] = 1
        ignore[3, :3] = ignore[1, 6] = 1
        detected[3, 1 : 1 + int(rng.integers(1, 3))] = 1
        inputs.append((detected, truth, ignore))

    def counted(detected: Any, truth: Any, ignore: Any) -> tuple[int, int, int, int]:
        """tp, fp, fn, tn by a loop."""
        tally = {(1, 1): 0, (1, 0): 0, (0, 1): 0, (0, 0): 0}
        for d, t, i in zip(np.ravel(detected), np.ravel(truth), np.ravel(ignore), strict=True):
            if not i:
                tally[int(d), int(t)] += 1
        return tally[1, 1], tally[1, 0], tally[0, 1], tally[0, 0]

    def right(detected: Any, truth: Any, ignore: Any) -> list[float]:
        """Precision, recall, false positive rate."""
        tp, fp, fn, tn = counted(detected, truth, ignore)
        return [tp / (tp + fp), tp / (tp + fn), fp / (fp + tn)]

    def of(measures: Callable[[int, int, int, int], list[float]]) -> Function:
        """Other measures of the same counts."""
        return lambda detected, truth, ignore: measures(*counted(detected, truth, ignore))

    return Exercise(
        asks=(
            "Write a function of detected, truth and ignore (arrays of 0 and 1) that returns\n"
            "[precision, recall, false positive rate]; pixels with ignore = 1 count in none of them."
        ),
        answer=lambda: right,
        because="don't-care pixels are neither right nor wrong: they leave all four counts, the true negatives too.",
        mistakes=(
            Mistake(
                lambda: lambda detected, truth, ignore: right(detected, truth, np.zeros_like(ignore)),
                "the don't-care pixels were counted: leave out every pixel with ignore = 1.",
            ),
            Mistake(
                lambda: of(lambda tp, fp, fn, tn: [tp / (tp + fn), tp / (tp + fp), fp / (fp + tn)]),
                "precision and recall are swapped: precision is of what was DETECTED, recall of what is TRUE.",
            ),
            Mistake(
                lambda: of(lambda tp, fp, fn, tn: [tp / (tp + fp), tp / (tp + fn), fp / (tp + fp)]),
                "the third is 1 - precision; the false positive rate is a share of all EMPTY pixels.",
            ),
            Mistake(
                lambda: of(lambda tp, fp, fn, tn: [tp / (tp + fp), tp / (tp + fn), fp / (tp + fp + fn + tn)]),
                "the false positive rate was divided by all pixels; only the empty ones can be false positives.",
            ),
            Mistake(
                lambda: lambda detected, truth, ignore: right(np.asarray(detected) & (1 - np.asarray(ignore)), truth, 0 * ignore),
                "don't-care became 'not detected': then a wall under it counts as missed. Take it out of the truth's side, too.",
            ),
        ),
        hints=(
            "counted = ignore == 0; work with detected[counted] and truth[counted] only.",
            "tp = sum of both, fp = detected and not true, fn = true and not detected, tn = the rest.",
        ),
        inputs=tuple(inputs),
    )


def _dilation(rng: np.random.Generator) -> Exercise:
    """What dilating the paper leaves of a wall."""
    thick, side = int(rng.integers(6, 10)), int(rng.choice([3, 4]))
    left = thick - (side - 1)
    return Exercise(
        asks=(
            f"A long straight wall is {thick} px thick. The white paper round it is dilated by a square of side {side} px\n"
            "(the baseline of fig. 3.15). What share of the wall's pixels is left - its recall, far from its ends?"
        ),
        answer=lambda: left / thick,
        because=f"the paper takes side - 1 = {side - 1} px of the thickness: dilating the paper ERODES the ink.",
        mistakes=(
            Mistake(
                lambda: (thick + side - 1) / thick, "the INK was dilated; the thesis dilates the white paper, the ink shrinks."
            ),
            Mistake(lambda: (thick - side) / thick, "a square of side s takes s - 1 px, not s: side 1 would change nothing."),
            Mistake(lambda: 1.0, "that would be an opening, which gives the thickness back; dilation of the paper does not."),
            Mistake(lambda: (thick - 2 * (side - 1)) / thick, "s - 1 px go in all, not on each side."),
            Mistake(lambda: float(left), "that is how many px are left; asked for is their share of the thickness."),
        ),
        hints=(
            "a pixel stays ink when the WHOLE square on it is ink.",
            f"in how many places does {side} px fit into {thick} px?",
        ),
        tolerance=1e-3,
    )
