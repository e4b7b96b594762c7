"""The exercises of notebook 09, FastSLAM. Worked out by hand; tests hold them against the library."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from priorlab.course.exercise import Exercise, Mistake

FACTOR = 0.9
"""Of the prior: effective = chosen times this."""


def exercises(seed: int = 0) -> dict[str, Exercise]:
    """The exercises of notebook 09 with one learner's numbers."""
    rng = np.random.default_rng([9, seed])
    return {
        "09.doorway": _doorway(rng, seed),
        "09.alpha": _alpha(rng, seed),
        "09.honest": _honest(),
        "09.added": _added(rng, seed),
    }


def _logit(p: float) -> float:
    """Log odds."""
    return math.log(p / (1 - p))


def _p(log_odds: float) -> float:
    """And back."""
    return 1 / (1 + math.exp(-log_odds))


def _doorway(rng: np.random.Generator, seed: int) -> Exercise:
    """Two scans through a wall that is none."""
    p_wall, p_free = (0.3, 0.8) if seed == 0 else (float(rng.choice([0.25, 0.3, 0.35])), float(rng.choice([0.7, 0.75, 0.8])))
    l_0, free = _logit(FACTOR * p_wall), _logit(p_free)

    def after(lam: float = 1.0, start: float = l_0) -> float:
        """P(empty) after two scans."""
        return _p(start + 2 * free - 2 * lam * start)

    return Exercise(
        asks=(
            f"The plan walls up a doorway: p_wall = {p_wall:g}, times the factor 0.9. Two scans see through it,\n"
            f"p_free = {p_free:g}. What is P(empty) of such a cell then, by eq. 6.2 as printed? Three decimals."
        ),
        answer=after,
        because="l_2 = l_0 + 2 (logit(p_free) - l_0): a wall of the plan that is seen through loses its l_0 twice.",
        mistakes=(
            Mistake(lambda: after(lam=0.0), "that is lam = 0; eq. 6.2 takes l_0 off with every scan."),
            Mistake(lambda: after(start=_logit(p_wall)), "the factor 0.9 belongs to p_wall first."),
            Mistake(lambda: _p(2 * free - 2 * l_0), "the start is missing: l_0 stands there before the first scan."),
            Mistake(lambda: _p(2 * free), "l_0 comes off with EACH of the two scans, not once."),
            Mistake(
                lambda: _p(free), "that is after one scan: the first takes the prior's place (eq. 2.18), the second goes on."
            ),
            Mistake(lambda: _p(l_0 + 2 * free + 2 * l_0), "eq. 6.2 takes l_0 off; here it was added."),
            Mistake(lambda: l_0 + 2 * free - 2 * l_0, "those are the log odds; turn them into a probability."),
            Mistake(lambda: 1 - after(), "that is the occupancy; here every probability is P(empty) (convention flipped)."),
        ),
        hints=(
            "in log odds: l_0 = logit(0.9 p_wall), then eq. 6.2 twice.",
            "l = l_0 + 2 logit(p_free) - 2 l_0, and P = 1 / (1 + e^-l).",
        ),
        tolerance=6e-4,
    )


def _alpha(rng: np.random.Generator, seed: int) -> Exercise:
    """0.2 is a variance."""
    alpha, step = (0.2, 0.1) if seed == 0 else (float(rng.choice([0.15, 0.3, 0.4])), float(rng.choice([0.1, 0.2, 0.3])))
    return Exercise(
        asks=(
            f"alpha_3 = {alpha:g}, and the wheels report {step:g} m straight ahead. In algorithm 6.3 sample(b) draws with\n"
            "the VARIANCE b. What is the standard deviation of the particles' step, in cm? One decimal."
        ),
        answer=lambda: 100 * math.sqrt(alpha * step**2),
        because="b = alpha_3 trans^2 is a variance; its root is sqrt(alpha_3) times the step.",
        mistakes=(
            Mistake(lambda: 100 * alpha * step**2, "that is b itself, taken for a deviation (variance for standard deviation)."),
            Mistake(lambda: 100 * alpha * step, "alpha times the step: take the root of alpha, it belongs to a variance."),
            Mistake(lambda: math.sqrt(alpha * step**2), "those look like metres; asked are centimetres."),
            Mistake(lambda: 100 * math.sqrt(alpha), "that is for a step of one metre."),
            Mistake(lambda: 100 * math.sqrt(alpha * step), "the step stands squared in b = alpha_3 trans^2."),
            Mistake(lambda: 1e4 * alpha * step**2, "those are square centimetres, the variance; take the root."),
        ),
        hints=("b = alpha_3 trans^2 is in square metres.", "100 sqrt(alpha_3 trans^2)."),
        tolerance=0.051,
    )


def _honest() -> Exercise:
    """Which gains may be shown?"""

    def right(gains: Sequence[float], worst_m: Sequence[float]) -> float:
        """The mean over the runs that were not lost."""
        return float(np.mean([gain for gain, off in zip(gains, worst_m, strict=True) if off <= 1]))

    def wrong(rule: Callable[[Sequence[float], Sequence[float]], Any], says: str) -> Mistake:
        """Another rule."""
        return Mistake(lambda: rule, says)

    def picked(gains: Sequence[float], worst_m: Sequence[float], keep: Callable[[float], bool]) -> float:
        """The mean over some runs; 0 for none."""
        kept = [gain for gain, off in zip(gains, worst_m, strict=True) if keep(off)]
        return float(np.mean(kept)) if kept else 0.0

    return Exercise(
        asks=(
            "Write a function of two lists, the gains of some runs (per cent) and how far each was off at worst (metres), that\n"
            "returns the mean gain of the runs that were not lost: those that were at most 1 m off."
        ),
        answer=lambda: right,
        because="a lost robot leaves its walls unseen, so the plan keeps them and the gain grows: it must not count.",
        mistakes=(
            wrong(lambda gains, worst_m: float(np.mean(gains)), "the lost runs are in it, and theirs are the largest gains."),
            wrong(lambda gains, worst_m: picked(gains, worst_m, lambda off: off > 1), "those are the LOST runs: turned round."),
            wrong(lambda gains, worst_m: float(np.median(gains)), "the median hides lost runs, it does not leave them out."),
            wrong(
                lambda gains, worst_m: picked(gains, worst_m, lambda off: off <= 1) * np.mean([off <= 1 for off in worst_m]),
                "divided by the number of ALL runs; only those that count make the mean.",
            ),
            wrong(lambda gains, worst_m: picked(gains, worst_m, lambda off: off < 1), "'at most 1 m' holds at 1 m itself."),
            wrong(lambda gains, worst_m: float(max(gains)), "that is the largest gain, most likely of a lost robot."),
            wrong(lambda gains, worst_m: sum(off <= 1 for off in worst_m), "that counts the runs; asked is their mean gain."),
        ),
        hints=(
            "keep the gains of those at most 1 m off, then take the mean.",
            "np.mean([gain for gain, off in zip(gains, worst_m) if off <= 1]).",
        ),
        inputs=(
            ([60.0, 70.0, 1000.0], [0.1, 0.2, 15.0]),
            ([50.0, 62.0, 55.0, 340.0], [0.3, 1.0, 0.2, 4.0]),
            ([48.0, 8000.0], [0.1, 21.0]),
            ([66.0, 44.0], [0.2, 0.1]),
        ),
        tolerance=1e-6,
    )


def _added(rng: np.random.Generator, seed: int) -> Exercise:
    """What it brought, less what it spoilt."""
    right, wrong = (9600, 400) if seed == 0 else (100 * int(rng.integers(80, 120)), 10 * int(rng.integers(30, 60)))
    kept, found = (9120, 300) if seed == 0 else (right - 10 * int(rng.integers(45, 80)), wrong - 10 * int(rng.integers(6, 15)))
    return Exercise(
        asks=(
            f"Of the cells that a robot saw, the plan shows {right} rightly and {wrong} wrongly (furniture, a doorway).\n"
            f"After the drive the map shows {kept} of the first and {found} of the second rightly.\n"
            "How many more cells does the map show rightly than the plan did?"
        ),
        answer=lambda: found - (right - kept),
        because="what it found in the changed cells, less what it turned wrong in the others. It may be negative.",
        mistakes=(
            Mistake(lambda: found, "that is what it found; it also turned cells wrong that the plan had right."),
            Mistake(lambda: -(right - kept), "that is what it spoilt; it also found something."),
            Mistake(lambda: right - kept, "that is how many cells it spoilt; take them off what it found."),
            Mistake(lambda: (right - kept) - found, "the sign is turned round: what it found counts FOR the robot."),
            Mistake(lambda: kept + found, "that is all that the map shows rightly; take off what the plan alone did."),
            Mistake(lambda: found - wrong, "those are the changed cells that it missed."),
            Mistake(lambda: found + (right - kept), "spoilt cells count against it."),
        ),
        hints=("how many cells did it turn from wrong to right, how many from right to wrong?", f"{found} - ({right} - {kept})."),
    )
