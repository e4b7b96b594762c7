"""The exercises of notebook 01, doors.

The answers are worked out with `math` alone: the library does not mark its own work. Tests hold the two against each other.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from priorlab.course.exercise import Exercise, Mistake

Function = Callable[..., Any]
Point = tuple[float, float]


def exercises(seed: int = 0) -> dict[str, Exercise]:
    """The exercises of notebook 01 with one learner's numbers."""
    rng = np.random.default_rng([1, seed])
    return {
        "01.angle": _angle(rng),
        "01.neighbours": _neighbours(rng),
        "01.overlap": _overlap(rng),
        "01.triples": _triples(rng),
    }


def _angles(a: Point, b: Point, c: Point) -> list[float]:
    """Inner angles of a triangle, radians, by the law of cosines."""
    sides = [math.dist(b, c), math.dist(c, a), math.dist(a, b)]
    found = []
    for k in range(3):
        opposite, one, other = sides[k], sides[(k + 1) % 3], sides[(k + 2) % 3]
        found.append(math.acos((one**2 + other**2 - opposite**2) / (2 * one * other)))
    return found


def _angle(rng: np.random.Generator) -> Exercise:
    """The largest angle of a triangle."""
    leaf = float(rng.integers(30, 50))
    lean = float(rng.integers(4, 12))

    def right(a: Point, b: Point, c: Point) -> float:
        """Degrees."""
        return math.degrees(max(_angles(a, b, c)))

    def at_first(a: Point, b: Point, c: Point) -> float:
        """The angle at the first vertex."""
        return math.degrees(_angles(a, b, c)[0])

    return Exercise(
        asks=(
            "Write a function of three vertices, each (x, y), that returns the LARGEST angle of their triangle in degrees.\n"
            "The text asks for 60 to 100."
        ),
        answer=lambda: right,
        because="the three angles sum to 180, so the largest is never below 60: the text's lower bound rejects nothing.",
        mistakes=(
            Mistake(lambda: lambda a, b, c: max(_angles(a, b, c)), "that is in radians; the bounds 60 and 100 are degrees."),
            Mistake(lambda: lambda a, b, c: math.degrees(min(_angles(a, b, c))), "that is the smallest angle, not the largest."),
            Mistake(lambda: at_first, "that is the angle at the first vertex; the largest may be at any of the three."),
            Mistake(lambda: lambda a, b, c: math.cos(max(_angles(a, b, c))), "that is the cosine; math.acos is missing."),
            Mistake(lambda: lambda a, b, c: math.radians(max(_angles(a, b, c))), "math.radians goes the wrong way: use degrees."),
        ),
        hints=(
            "the largest angle lies opposite the longest side; math.dist gives the sides.",
            "law of cosines: cos(angle) = (p*p + q*q - longest*longest) / (2*p*q); then math.degrees(math.acos(...)).",
        ),
        inputs=(
            ((0.0, 0.0), (leaf, 0.0), (0.0, leaf)),
            ((0.0, leaf), (lean, 0.0), (leaf, lean)),
            ((leaf, 2.0), (0.0, 0.0), (2 * leaf, 0.0)),
        ),
        tolerance=1e-3,
    )


def _neighbours(rng: np.random.Generator) -> Exercise:
    """The three pixels that a walk tests."""
    starts = rng.integers(20, 40, (4, 2)).tolist()
    ways = ((1, -1), (-1, -1), (1, 1), (-1, 1))
    far = rng.integers(5, 15, (4, 2)).tolist()
    inputs = tuple(((x, y), (x + sx * dx, y + sy * dy)) for (x, y), (dx, dy), (sx, sy) in zip(starts, far, ways, strict=True))

    def steps(start: Point, goal: Point, turn: tuple[int, int] = (1, 1)) -> list[list[float]]:
        """Pixels along x, along y, along both; sorted, the order does not count."""
        x, y = start
        dx = turn[0] * (1 if goal[0] > x else -1)
        dy = turn[1] * (1 if goal[1] > y else -1)
        return sorted([[x + dx, y], [x, y + dy], [x + dx, y + dy]])

    def with_turn(turn: tuple[int, int]) -> Function:
        """A function that goes another way."""
        return lambda start, goal: steps(start, goal, turn)

    def swapped(start: Point, goal: Point) -> list[list[float]]:
        """Row, column in place of x, y."""
        return sorted([[y, x] for x, y in steps(start, goal)])

    def around(start: Point, goal: Point) -> list[list[float]]:
        """All eight neighbours."""
        x, y = start
        return [[x + dx, y + dy] for dx in (-1, 0, 1) for dy in (-1, 0, 1) if dx or dy]

    return Exercise(
        asks=(
            "Write a function of start and goal, each (x, y) with y DOWN, that returns the three pixels P_n of eq. 3.6-3.9\n"
            "as a sorted list of [x, y]. Start and goal share neither row nor column."
        ),
        answer=lambda: steps,
        because="a step towards the goal in x, one in y, and both: a walk can never turn round, so it cannot wander off.",
        mistakes=(
            Mistake(lambda: with_turn((1, -1)), "y is upside down: here it grows DOWNWARDS, a goal further up has a smaller y."),
            Mistake(lambda: with_turn((-1, 1)), "x is the wrong way round: a goal further right has a larger x."),
            Mistake(lambda: with_turn((-1, -1)), "these lead away from the goal."),
            Mistake(lambda: swapped, "x and y are swapped (row, column): the thesis writes (x, y)."),
            Mistake(lambda: around, "those are all eight neighbours; only the three towards the goal are tested."),
        ),
        hints=(
            "one sign for x and one for y: +1 when the goal's coordinate is larger, else -1.",
            "sorted([[x + dx, y], [x, y + dy], [x + dx, y + dy]]).",
        ),
        inputs=inputs,
    )


def _overlap(rng: np.random.Generator) -> Exercise:
    """The area two triangles share, of the smaller one."""
    small, factor = float(rng.integers(2, 4) * 20), float(rng.choice([1.5, 2.0, 2.5]))
    large, shift = factor * small, float(rng.choice([0.25, 0.4, 0.5])) * small
    shared, first, second = (small - shift) ** 2 / 2, small**2 / 2, large**2 / 2
    fate = "more than 0.30: one of the two must go" if shared / first > 0.3 else "at most 0.30: both stay"
    return Exercise(
        asks=(
            "Two candidates are right-angled triangles; both have their right angle at the lower left and their legs along x\n"
            f"and y. The first has legs of {small:g} px and its right angle at (0, 0), the second legs of {large:g} px and its\n"
            f"right angle at ({shift:g}, 0), to the right of it. What share of the SMALLER one do they\nhave in common, 0 to 1?"
        ),
        answer=lambda: shared / first,
        because=f"a triangle with legs of {small - shift:g} px is common; {fate}.",
        mistakes=(
            Mistake(
                lambda: shared / (first + second - shared),
                "that is intersection over UNION; the 30 % are of the smaller area: a small triangle inside a large one must go.",
            ),
            Mistake(lambda: shared / second, "that is the share of the LARGER triangle."),
            Mistake(lambda: 1 - shift / small, "that is the share of the leg; areas go with its square."),
            Mistake(lambda: shared, "that is the common area in square pixels; divide by the smaller triangle's."),
            Mistake(lambda: 100 * shared / first, "that is in per cent; a share lies between 0 and 1."),
            Mistake(lambda: 1 - shared / first, "that is the share of the smaller one that is NOT covered."),
        ),
        hints=(
            "draw them: what they share is again a right-angled triangle, with its corner at the second one's.",
            f"its legs are {small:g} - {shift:g} px, and an area is half the product of the legs.",
        ),
        tolerance=1e-3,
    )


def _triples(rng: np.random.Generator) -> Exercise:
    """How many triangles n corners make."""
    sizes = sorted(int(n) for n in rng.choice(np.arange(20, 400), 3, replace=False))

    def wrong(bottom: Callable[[int], float]) -> Function:
        """n! over something else."""
        return lambda n: n * (n - 1) * (n - 2) / bottom(n)

    return Exercise(
        asks="Write a function of n that gives how many different triangles n corners make: nCr of 3 out of n.",
        answer=lambda: _n_triangles,
        because="n! / (3! (n - 3)!): 1,313,400 for 200 corners. The page prints r for r!, which makes it twice as many.",
        mistakes=(
            Mistake(lambda: wrong(lambda n: 3), "that is n! / (r (n-r)!), as the page prints it: the r in front must be r! = 6."),
            Mistake(lambda: wrong(lambda n: 1), "you counted each triangle six times, once for every order of its corners."),
            Mistake(lambda: lambda n: n**3, "n * n * n counts every order, and triangles whose corners are one point."),
            Mistake(lambda: lambda n: n * (n - 1) / 2, "that is how many PAIRS there are; a triangle has three corners."),
        ),
        hints=("how many ordered triples are there? In how many orders can one triangle be named?", "n (n-1) (n-2) / 6."),
        inputs=tuple((n,) for n in sizes),
    )


def _n_triangles(n: int) -> int:
    """nCr with r = 3."""
    return math.comb(n, 3)
