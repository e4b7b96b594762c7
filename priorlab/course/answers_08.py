"""The exercises of notebook 08, localization. Worked out by hand or with `math`; tests hold them against the library."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from priorlab.course.exercise import Exercise, Mistake

Pose = tuple[float, float, float]


def exercises(seed: int = 0) -> dict[str, Exercise]:
    """The exercises of notebook 08 with one learner's numbers."""
    rng = np.random.default_rng([8, seed])
    return {"08.parts": _parts(), "08.beam": _beam(rng, seed), "08.ess": _ess(rng, seed), "08.residual": _residual(rng)}


# --- algorithm 6.3 ---------------------------------------------------------------------------------------------------

_STEPS: tuple[tuple[Pose, Pose], ...] = (
    ((0.0, 0.0, 0.0), (3.0, 4.0, 1.2)),
    ((1.0, 2.0, 0.5), (2.0, 2.5, 0.9)),
    ((4.0, 1.0, 1.9), (3.6, 1.3, 2.4)),
    ((0.0, 0.0, 3.0), (-1.0, -0.2, -3.1)),  # over the seam: the difference must be wrapped
)


def _wrapped(angle: float) -> float:
    """To [-pi, pi)."""
    return (angle + math.pi) % (2 * math.pi) - math.pi


def _motion(
    wrap: Callable[[float], float] = _wrapped,
    length: Callable[[float, float], float] = math.hypot,
    turned: bool = True,
    swapped: bool = False,
    rest: Callable[[float, float], float] = lambda turn, rot1: turn - rot1,
) -> Callable[[Pose, Pose], list[float]]:
    """The three parts of a step, right unless told otherwise."""

    def parts(before: Pose, after: Pose) -> list[float]:
        dx, dy = after[0] - before[0], after[1] - before[1]
        direction = math.atan2(dx, dy) if swapped else math.atan2(dy, dx)
        rot1 = wrap(direction - (before[2] if turned else 0.0))
        return [rot1, length(dx, dy), wrap(rest(after[2] - before[2], rot1))]

    return parts


def _parts() -> Exercise:
    """delta_rot1, delta_trans, delta_rot2 of a step."""

    def in_degrees(before: Pose, after: Pose) -> list[float]:
        rot1, trans, rot2 = _motion()(before, after)
        return [math.degrees(rot1), trans, math.degrees(rot2)]

    return Exercise(
        asks=(
            "Write a function that takes two odometry poses (x, y, theta), before and after a step, and returns the list\n"
            "[rot1, trans, rot2]: radians between -pi and pi, and metres."
        ),
        answer=_motion,
        because="a turn, a line, and what is left of the turn: rot2 = theta' - theta - rot1, the line that the page lacks.",
        mistakes=(
            Mistake(lambda: _motion(wrap=float), "one of the steps goes over the seam at pi: wrap every angle to -pi ... pi."),
            Mistake(
                lambda: _motion(rest=lambda turn, rot1: turn),
                "rot2 is the whole change of heading there; rot1 has already made a part of it.",
            ),
            Mistake(lambda: _motion(rest=lambda turn, rot1: turn + rot1), "rot1 is taken OFF the change of heading."),
            Mistake(
                lambda: _motion(turned=False),
                "rot1 is the direction of the new place as seen by the robot: take its own heading off.",
            ),
            Mistake(lambda: _motion(swapped=True), "atan2 wants dy first, then dx."),
            Mistake(
                lambda: _motion(length=lambda dx, dy: dx * dx + dy * dy), "that is the square of the way: the root is missing."
            ),
            Mistake(
                lambda: _motion(length=lambda dx, dy: abs(dx) + abs(dy)),
                "that is the way along the axes; the line is the root of the SUM of squares (the page has a comma).",
            ),
            Mistake(lambda: in_degrees, "those are degrees; asked are radians."),
        ),
        hints=(
            "direction = atan2(y' - y, x' - x); rot1 = direction - theta, wrapped.",
            "wrapped: (angle + pi) % (2 pi) - pi. And rot2 = theta' - theta - rot1, wrapped.",
        ),
        inputs=_STEPS,
        tolerance=1e-6,
    )


# --- algorithm 6.4 ---------------------------------------------------------------------------------------------------


def _beam(rng: np.random.Generator, seed: int) -> Exercise:
    """The log likelihood of one beam."""
    distance, sigma, z_random = 0.3, 0.2, 0.05
    if seed:
        distance, sigma, z_random = (float(rng.choice(choices)) for choices in ((0.3, 0.35, 0.4), (0.2, 0.25), (0.05, 0.1, 0.2)))
    z_max = 12.0

    hit = math.exp(-0.5 * (distance / sigma) ** 2)  # not yet normalized
    normal = 1 / (sigma * math.sqrt(2 * math.pi))
    right = (1 - z_random) * normal * hit + z_random / z_max
    return Exercise(
        asks=(
            f"A beam ends {distance:g} m from the nearest wall. sigma_hit = {sigma:g} m, z_random = {z_random:g},\n"
            f"and the sensor sees {z_max:g} m far. What is the natural logarithm of its likelihood? Three decimals."
        ),
        answer=lambda: math.log(right),
        because="ln(z_hit prob(dist, sigma_hit) + z_random / z_max), with z_hit = 1 - z_random and the Gaussian normalized.",
        mistakes=(
            Mistake(lambda: right, "that is the likelihood itself; asked is its logarithm."),
            Mistake(lambda: math.log10(right), "that is log10; here every logarithm is the natural one."),
            Mistake(
                lambda: math.log((1 - z_random) * hit + z_random / z_max),
                "prob() is the normalized Gaussian: the factor 1 / (sigma sqrt(2 pi)) is missing.",
            ),
            Mistake(lambda: math.log(normal * hit + z_random / z_max), "z_hit is missing: 1 - z_random."),
            Mistake(
                lambda: math.log((1 - z_random) * normal * hit + z_random),
                "z_random is spread over the whole range of the sensor: divide it by z_max.",
            ),
            Mistake(lambda: math.log((1 - z_random) * normal * hit), "the readings that nothing explains are missing."),
            Mistake(
                lambda: math.log((1 - z_random) * hit / (sigma**2 * math.sqrt(2 * math.pi)) + z_random / z_max),
                "the Gaussian is divided by sigma, not by the variance.",
            ),
            Mistake(
                lambda: math.log((1 - z_random) * normal * math.exp(-((distance / sigma) ** 2)) + z_random / z_max),
                "the Gaussian's exponent has a half: -d^2 / (2 sigma^2).",
            ),
        ),
        hints=(
            "prob(d, sigma) = exp(-d^2 / (2 sigma^2)) / (sigma sqrt(2 pi)).",
            "z_hit prob + z_random / z_max, then the logarithm.",
        ),
        tolerance=1e-3,
    )


# --- weights ---------------------------------------------------------------------------------------------------------


def _ess(rng: np.random.Generator, seed: int) -> Exercise:
    """The effective number of a handful of particles."""
    raw = [6, 3, 2, 1] if seed == 0 else rng.choice(np.arange(1, 12), 4, replace=False).tolist()
    total = sum(raw)
    weights = [one / total for one in raw]
    squares = sum(one * one for one in weights)
    return Exercise(
        asks=(
            f"Four particles have the weights {', '.join(map(str, raw))}, not normalized.\n"
            "What is their effective number, ESS? Two decimals."
        ),
        answer=lambda: 1 / squares,
        because="1 / (sum of the squares of the normalized weights): 4 when all are equal, 1 when one has everything.",
        mistakes=(
            Mistake(lambda: squares, "that is the sum of squares; ESS is one over it."),
            Mistake(lambda: 1 / sum(one * one for one in raw), "the weights must be normalized first: their sum is 1."),
            Mistake(lambda: total / max(raw), "that is one over the largest weight: it leaves out all others."),
            Mistake(lambda: 4.0, "that is N; the weights are not equal."),
            Mistake(
                lambda: math.exp(-sum(one * math.log(one) for one in weights)), "that is the entropy's number; ESS takes squares."
            ),
            Mistake(lambda: 1 / math.sqrt(squares), "there is no root in it: 1 / sum(w^2)."),
            Mistake(lambda: 1 / (4 * squares), "that is the share ESS / N."),
        ),
        hints=("divide by the sum first.", "1 / sum(w^2)."),
        tolerance=6e-3,
    )


# --- resampling ------------------------------------------------------------------------------------------------------

_NUMBERS_OF_PARTICLES = (5, 4, 6, 7, 9)  # different ones: with one alone, a 5 in place of N would pass


def _weights(rng: np.random.Generator, n: int) -> list[float]:
    """The weights of n particles, in percents. Under every rule below something is left over, and no N w is whole."""
    while True:
        cuts = np.sort(rng.choice(np.arange(1, 100), n - 1, replace=False))
        percents = np.diff(cuts, prepend=0, append=100)
        owed = [n * int(percent) for percent in percents]  # in percents
        floors, rounds = (sum(rule(one / 100) for one in owed) for rule in (math.floor, round))
        if all(one % 50 for one in owed) and floors not in (0, 1, n) and rounds != n:
            return [int(percent) / 100 for percent in percents]


def _left_over(shares: Callable[[int, float], float], normalize: bool = True) -> Callable[[Sequence[float]], list[float]]:
    """The shares of the draws that are left over, by a rule for each weight."""

    def residual(weights: Sequence[float]) -> list[float]:
        rest = [shares(len(weights), weight) for weight in weights]
        total = sum(rest) if normalize else 1.0
        return [one / total for one in rest]

    return residual


def _residual(rng: np.random.Generator) -> Exercise:
    """The line that filterpy has wrong, asked for beliefs of several sizes."""

    def copies(n: int, weight: float) -> int:
        """Whole copies of one particle."""
        return math.floor(n * weight)

    return Exercise(
        asks=(
            "Residual resampling: of N particles each goes on floor(N w) times for sure. Write a function that takes the\n"
            "weights and returns the probabilities with which the draws that are left over are made; their sum is 1."
        ),
        answer=lambda: _left_over(lambda n, weight: n * weight - copies(n, weight)),
        because="N w - floor(N w): what the whole copies have not paid out. filterpy forgets the N.",
        mistakes=(
            Mistake(
                lambda: _left_over(lambda n, weight: weight - copies(n, weight)),
                "that is filterpy's line: N w is what a particle is owed, not w. Some of your shares are negative.",
            ),
            Mistake(
                lambda: _left_over(lambda n, weight: weight), "those are the weights: the whole copies have been paid already."
            ),
            Mistake(
                lambda: _left_over(lambda n, weight: n * weight - copies(n, weight), normalize=False),
                "these do not sum to 1: divide by their sum.",
            ),
            Mistake(
                lambda: _left_over(lambda n, weight: weight - copies(n, weight) / n, normalize=False),
                "nearly: the same shares, not yet divided by their sum.",
            ),
            Mistake(lambda: _left_over(copies), "those are the copies that are made for sure."),
            Mistake(
                lambda: _left_over(lambda n, weight: 1 - (n * weight - copies(n, weight))),
                "turned round: who has most left over must be drawn most.",
            ),
            Mistake(lambda: _left_over(lambda n, weight: n * weight - round(n * weight)), "round down, not to the nearest."),
            Mistake(lambda: _left_over(lambda n, weight: 1.0), "the left-over draws are not equal shares."),
        ),
        hints=(
            "a particle is owed N w copies and has got floor(N w).",
            "residual = N w - floor(N w), divided by its sum.",
        ),
        inputs=tuple((_weights(rng, n),) for n in _NUMBERS_OF_PARTICLES),
        tolerance=1e-6,
    )
