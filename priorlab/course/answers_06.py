"""The exercises of notebook 06, worth it? Worked out by hand; tests hold them against the library."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from priorlab.course.exercise import Exercise, Mistake

CLAIMED = 20.0
"""Per cent that the thesis's 5.2.2 claims for every drawing."""


def exercises(seed: int = 0) -> dict[str, Exercise]:
    """The exercises of notebook 06 with one learner's numbers."""
    rng = np.random.default_rng([6, seed])
    return {"06.gain": _gain(rng, seed), "06.turn": _turn(rng, seed), "06.verdict": _verdict()}


def _f_beta(precision: float, recall: float, weight: float = 4.0) -> float:
    """eq. 5.1 with beta squared."""
    return (1 + weight) * precision * recall / (weight * precision + recall)


def _gain(rng: np.random.Generator, seed: int) -> Exercise:
    """From precision and recall to per cent."""
    with_plan = (0.9, 0.7) if seed == 0 else (float(rng.choice([0.8, 0.85, 0.95])), float(rng.choice([0.65, 0.75, 0.78])))
    without = (1.0, 0.5) if seed == 0 else (1.0, float(rng.choice([0.35, 0.4, 0.45])))

    def gain(first: float, second: float) -> float:
        """Per cent."""
        return 100 * (first / second - 1)

    high, low = _f_beta(*with_plan), _f_beta(*without)
    return Exercise(
        asks=(
            f"With the plan a map has precision {with_plan[0]:g} and recall {with_plan[1]:g}, without it {without[0]:g} and "
            f"{without[1]:g}.\nHow many per cent higher is F2 with the plan? One decimal."
        ),
        answer=lambda: gain(high, low),
        because="per cent of what there was without the plan: 100 (F2 with / F2 without - 1).",
        mistakes=(
            Mistake(lambda: 100 * (high - low), "those are percentage points; asked is the share of the F2 without."),
            Mistake(lambda: gain(high, low) / 100, "as a share; times 100 makes per cent."),
            Mistake(lambda: 100 * high / low, "that is how many per cent it IS of the other; take 100 off."),
            Mistake(lambda: 100 * (1 - low / high), "that is in per cent of the map WITH the plan; the one without is the base."),
            Mistake(lambda: gain(_f_beta(*with_plan, 1.0), _f_beta(*without, 1.0)), "that is F1; in F2 beta squared is 4."),
            Mistake(lambda: gain(_f_beta(*with_plan, 2.0), _f_beta(*without, 2.0)), "beta stands SQUARED in eq. 5.2: 4, not 2."),
            Mistake(lambda: gain(with_plan[1], without[1]), "that is the gain of recall alone; asked is F2."),
            Mistake(
                lambda: gain(_f_beta(*with_plan[::-1]), _f_beta(*without[::-1])), "precision and recall are swapped in eq. 5.2."
            ),
        ),
        hints=("first both F2, eq. 5.2.", "100 (F2 with the plan / F2 without - 1)."),
        tolerance=0.1,
    )


def _turn(rng: np.random.Generator, seed: int) -> Exercise:
    """Where two lines cross."""
    looks = (1.2, 1.5, 2.5, 4.0)
    upper, lower = (0.85, 0.80, 0.70, 0.68), (0.35, 0.60, 0.75, 0.80)
    if seed:
        shift = 0.01 * int(rng.integers(-3, 4))
        lower = (0.35 + shift, 0.60 + shift, 0.75 + shift, 0.80 + shift)
    before, after = upper[1] - lower[1], upper[2] - lower[2]
    shown = "\n".join(
        f"  {n:.1f} looks: F2 {high:.2f} with the plan, {low:.2f} without"
        for n, high, low in zip(looks, upper, lower, strict=True)
    )
    share = before / (before - after)
    return Exercise(
        asks=(
            f"Four surveys:\n{shown}\nAt how many looks does the plan stop paying, if F2 goes in straight lines\n"
            "between surveys? Two decimals."
        ),
        answer=lambda: looks[1] + (looks[2] - looks[1]) * share,
        because="the gain is a straight line between two surveys, and crosses 0 where its two ends balance.",
        mistakes=(
            Mistake(lambda: looks[2], "that is the first survey in which the plan does harm; the lines cross before."),
            Mistake(lambda: looks[1], "that is the last survey in which the plan still pays; the lines cross later."),
            Mistake(lambda: (looks[1] + looks[2]) / 2, "that is the middle; the gains at the two ends are not equally large."),
            Mistake(lambda: looks[2] - (looks[2] - looks[1]) * share, "measured from the wrong end."),
            Mistake(lambda: share, "that is the share of the way between the two surveys; where is that in looks?"),
        ),
        hints=(
            "take the difference of the two columns: where does its sign change?",
            "1.5 + share x (2.5 - 1.5).",
        ),
        tolerance=6e-3,
    )


def _verdict() -> Exercise:
    """The claim as a rule."""

    def right(gains: Sequence[float]) -> bool:
        """At least 20 % on every drawing."""
        return min(gains) >= CLAIMED

    def wrong(rule: Callable[[Sequence[float]], Any], says: str) -> Mistake:
        """Another rule."""
        return Mistake(lambda: rule, says)

    return Exercise(
        asks=(
            "Write a function that takes the gains of all drawings, in per cent, and returns True when the claim\n"
            "'at least 20 % on all of them' holds."
        ),
        answer=lambda: right,
        because="'on all' is about the lowest: one drawing below 20 % and the claim is wrong.",
        mistakes=(
            wrong(lambda gains: sum(gains) / len(gains) >= CLAIMED, "the mean hides a drawing that loses: 'on all' means each."),
            wrong(lambda gains: max(gains) >= CLAIMED, "one drawing that gains is not 'all'."),
            wrong(lambda gains: min(gains) > CLAIMED, "'at least 20' holds at 20 itself."),
            wrong(lambda gains: min(gains) > 0, "that is 'the plan never does harm'; the claim says 20 %."),
            wrong(lambda gains: min(gains) >= CLAIMED / 100, "the gains are in per cent, not shares."),
            wrong(lambda gains: min(gains) < CLAIMED, "that is turned round: True means that the claim holds."),
            wrong(lambda gains: gains[0] >= CLAIMED, "only the first drawing was asked; 'on all' means each."),
            wrong(lambda gains: min(gains), "that is the lowest gain; now say whether it reaches 20."),
            wrong(lambda gains: [gain >= CLAIMED for gain in gains], "that answers for each drawing; asked is one answer."),
        ),
        hints=("which single drawing decides about 'all'?", "min(gains) >= 20."),
        inputs=tuple(
            ([float(gain) for gain in gains],)
            for gains in ((30, 25, 120), (150, 180, -15), (20, 20, 21), (5, 8, 12), (45, 19.9, 60), (30, 5, 10), (0.1, 30, 40))
        ),
    )
