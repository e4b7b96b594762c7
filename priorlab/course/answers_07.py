"""The exercises of notebook 07, depth camera.

The answers are worked out with `math` alone, but for the last one, which is judged by mapping the notebook's arena.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from priorlab.course.exercise import Exercise, Mistake, as_numbers

ROWS, COLUMNS, FULL_ANGLE = 480, 640, math.radians(58)
SURVEY_SEED, USUAL_LOSS, ENOUGH = 0, 0.05, 0.03


def exercises(seed: int = 0) -> dict[str, Exercise]:
    """The exercises of notebook 07 with one learner's numbers."""
    rng = np.random.default_rng([7, seed])
    return {"07.range": _range(rng), "07.strip": _strip(rng), "07.row": _row(rng), "07.loss": _loss()}


def _focal_length(half_angle: float = FULL_ANGLE / 2) -> float:
    """Pixels."""
    return COLUMNS / 2 / math.tan(half_angle)


def _range(rng: np.random.Generator) -> Exercise:
    """Depth and column -> range."""
    columns = [0, int(rng.integers(60, 200)), 320, int(rng.integers(440, 600))]
    depths = [float(depth) for depth in rng.choice([0.8, 1.2, 1.6, 2.0, 2.4, 2.8], 4, replace=False)]

    def across(column: float, focal: float) -> float:
        """Tangent of the bearing of a column's centre."""
        return (column + 0.5 - COLUMNS / 2) / focal

    def with_focal(focal: float) -> Callable[[float, float], float]:
        """The right formula with some focal length."""
        return lambda depth, column: depth / math.cos(math.atan(across(column, focal)))

    right = with_focal(_focal_length())
    return Exercise(
        asks=(
            "Write a function of depth (metres) and column (0 to 639, left to right) that gives the range, metres.\n"
            "The camera sees 58 degrees from the left edge of its image to the right one."
        ),
        answer=lambda: right,
        because="range = depth / cos(bearing), with tan(bearing) = (column + 0.5 - 320) / 577.3.",
        mistakes=(
            Mistake(lambda: lambda depth, column: depth, "that is the depth taken for the range: 1 / cos(bearing) is missing."),
            Mistake(
                lambda: lambda depth, column: depth * math.cos(math.atan(across(column, _focal_length()))),
                "times cos(bearing) makes it shorter than the depth; the range is the LONGER side: divide.",
            ),
            Mistake(
                lambda: with_focal(_focal_length(FULL_ANGLE)),
                "half angle for full angle: 58 degrees is the whole field, so the edge lies at 29.",
            ),
            Mistake(
                lambda: with_focal(_focal_length(FULL_ANGLE / 4)),
                "58 degrees was halved twice: the edge of the image lies at 29.",
            ),
            Mistake(
                lambda: lambda depth, column: depth / math.cos((column + 0.5 - COLUMNS / 2) / COLUMNS * FULL_ANGLE),
                "columns are not evenly spread over the angle: a flat image has evenly spread TANGENTS.",
            ),
            Mistake(
                lambda: lambda depth, column: depth / math.cos(math.atan((column + 0.5) / _focal_length())),
                "columns were counted from the left edge: the optical axis passes through the image's middle, column 320.",
            ),
            Mistake(
                lambda: with_focal(COLUMNS / 2 / math.tan(29)),
                "degrees went into math.tan, which wants radians: math.radians(29).",
            ),
            Mistake(
                lambda: lambda depth, column: depth / math.cos(math.degrees(math.atan(across(column, _focal_length())))),
                "degrees went into math.cos, which wants radians.",
            ),
            Mistake(
                lambda: lambda depth, column: depth * across(column, _focal_length()),
                "that is how far to the side the thing lies, not how far away.",
            ),
            Mistake(lambda: lambda depth, column: 1000 * right(depth, column), "that is in millimetres; asked for are metres."),
        ),
        hints=(
            "first the focal length in pixels: half the width / tan(half the angle) = 320 / tan(29 degrees).",
            "tan(bearing) = (column + 0.5 - 320) / focal length; then depth / cos(bearing).",
        ),
        inputs=tuple(zip(depths, columns, strict=True)),
        tolerance=1e-3,
    )


def _strip(rng: np.random.Generator) -> Exercise:
    """A strip of millimetres -> depths in metres."""
    strips = []
    for _ in range(2):
        strip = rng.integers(900, 1100, (4, 6)) + 400 * np.arange(6)
        strip[0, 1] = strip[1, 1] = strip[2, 3] = strip[1, 5] = 0
        strip[:, 2] = 0
        strips.append(strip)

    def mean(values: list[int], n: int) -> float:
        """Metres; inf for no reading."""
        return sum(values) / n / 1000 if n else math.inf

    def right(strip: Any) -> list[float]:
        """Zeros left out."""
        columns = [[int(v) for v in column if v > 0] for column in np.transpose(strip)]
        return [mean(column, len(column)) for column in columns]

    def diluted(strip: Any) -> list[float]:
        """Zeros averaged in, but a column of nothing else is no reading."""
        return [value or math.inf for value in with_zeros(strip)]

    def with_zeros(strip: Any) -> list[float]:
        """Zeros averaged in."""
        return [mean([int(v) for v in column], len(column)) for column in np.transpose(strip)]

    return Exercise(
        asks=(
            "Write a function that takes a strip (rows x columns, millimetres, 0 = nothing measured) and\n"
            "returns the mean depth of every column in METRES, numpy.inf where a column has no reading."
        ),
        answer=lambda: right,
        because="a zero is no distance but a missing one: averaged in, it would put a wall where there is none.",
        mistakes=(
            Mistake(lambda: with_zeros, "the zeros were averaged in: divide by the number of pixels that HAVE a depth."),
            Mistake(lambda: diluted, "the zeros were averaged in: divide by the number of pixels that HAVE a depth, not by all."),
            Mistake(
                lambda: lambda strip: [value for value in right(strip) if math.isfinite(value)],
                "a column without any depth was left out: the answer has one number for each column, numpy.inf there.",
            ),
            Mistake(
                lambda: lambda strip: [0.0 if math.isinf(value) else value for value in right(strip)],
                "a column without any depth came out as 0 m, a wall at the lens; it must be numpy.inf, no reading.",
            ),
            Mistake(lambda: lambda strip: right(np.transpose(strip)), "rows and columns swapped: average DOWN each column."),
            Mistake(lambda: lambda strip: with_zeros(np.transpose(strip)), "rows and columns swapped, and zeros averaged in."),
            Mistake(
                lambda: lambda strip: [1000 * value for value in right(strip)], "that is in millimetres; asked for are metres."
            ),
            Mistake(
                lambda: lambda strip: [max(int(v) for v in column) / 1000 or math.inf for column in np.transpose(strip)],
                "that is the farthest pixel of each column, not the mean.",
            ),
        ),
        hints=(
            "measured = strip > 0; count = measured.sum(axis=0).",
            "sum over the rows (axis=0), divide by the count where it is above 0, by 1000 for metres; numpy.inf elsewhere.",
        ),
        inputs=tuple((strip,) for strip in strips),
    )


def _row(rng: np.random.Generator) -> Exercise:
    """Where the top of a wall appears."""
    lens, height = 0.3, float(rng.choice([0.45, 0.5, 0.55]))
    depth = float(rng.choice([1.5, 2.0, 2.5]))
    focal = _focal_length()
    rise = (height - lens) / depth
    return Exercise(
        asks=(
            f"A wall {height:g} m high stands square to the camera at a depth of {depth:g} m; the lens is\n{lens:g} m above the "
            "floor. In which row (0 at the top, 480 rows, the axis between 239 and 240)\ndoes its top edge appear? To 1 row."
        ),
        answer=lambda: ROWS / 2 - focal * rise,
        because="577.3 x (height - lens) / depth rows above the middle; a higher strip looks over it.",
        mistakes=(
            Mistake(lambda: ROWS / 2 + focal * rise, "rows are counted from the TOP: what is higher has a smaller row."),
            Mistake(lambda: ROWS / 2 - focal * height / depth, "the lens stands above the floor: take its height off."),
            Mistake(
                lambda: ROWS / 2 - _focal_length(FULL_ANGLE) * rise,
                "half angle for full angle in the focal length: it is 320 / tan(29 degrees).",
            ),
            Mistake(
                lambda: ROWS / 2 - COLUMNS / 2 / math.tan(29) * rise,
                "degrees went into math.tan, which wants radians: math.radians(29).",
            ),
            Mistake(lambda: focal * rise, "that is how far above the middle; the middle is row 240."),
            Mistake(lambda: ROWS / 2 + focal * lens / depth, "that is where the wall meets the FLOOR, not its top."),
        ),
        hints=(
            "the top edge lies (height - lens) above the axis, at a known depth: similar triangles with the focal length.",
            "row = 240 - focal length x (height - lens) / depth, focal length 577.3.",
        ),
        tolerance=1.0,
    )


def _loss() -> Exercise:
    """A worse camera, a better map."""
    return Exercise(
        asks=(
            f"Find a share of the image (0 to 0.9) that the camera may LOSE so that the map with the plan\n"
            f"scores at least {ENOUGH:g} HIGHER in F2 than with the usual loss of {USUAL_LOSS:g} "
            "(one image a pose, cells of 2 px)."
        ),
        answer=lambda: 0.6,
        because="the plan is perfect, every look can only argue against it; who says less does less harm.",
        hints=("what could the map be like if the camera saw nothing at all?", "try 0.6, and look at 'readings alone' too."),
        accept=_is_better,
    )


def _is_better(answer: Any) -> str | None:
    """None when the map got better, otherwise the numbers."""
    value = as_numbers(answer)
    if value is not None and value.shape == () and 1 < value <= 90:
        return f"that looks like per cent; as a share it is {value / 100:g}."
    if value is None or value.shape != () or not 0 <= value <= 0.9:
        return "one number between 0 and 0.9 is asked for."
    usual, lossy = _f2_of(USUAL_LOSS), _f2_of(float(value))
    if lossy >= usual + ENOUGH:
        return None
    return f"with {float(value):g} of the image lost the map scores F2 {lossy:.3f}, with {USUAL_LOSS:g} {usual:.3f}."


@cache
def _f2_of(loss: float) -> float:
    """F2 of the notebook's map when so much of every image is lost."""
    from dataclasses import replace

    from priorlab.core.grid_map import Prior
    from priorlab.core.score import score_map
    from priorlab.mapping.evidence import gather_evidence
    from priorlab.mapping.prior import build_prior_map
    from priorlab.mapping.update import update_map
    from priorlab.robot.depth_noise import DepthNoise

    survey = _survey()
    prior_map = build_prior_map(survey.arena.walls, Prior(), cell_size=2)
    readings = survey.readings(1, replace(DepthNoise(), hole_rate=loss))
    return score_map(update_map(prior_map, gather_evidence(readings, prior_map.grid)), survey.arena.truth).f_beta


@cache
def _survey() -> Any:
    """The notebook's survey."""
    from priorlab.study.arena import build_arena
    from priorlab.study.depth_survey import survey_arena

    return survey_arena(build_arena(), np.random.default_rng(SURVEY_SEED))
