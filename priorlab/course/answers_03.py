"""The exercises of notebook 03, priors. Worked out with `math` and by hand; tests hold them against the library."""

from __future__ import annotations

import math

import numpy as np

from priorlab.course.exercise import Exercise, Mistake

FACTOR = 0.9


def exercises(seed: int = 0) -> dict[str, Exercise]:
    """The exercises of notebook 03 with one learner's numbers."""
    rng = np.random.default_rng([3, seed])
    return {"03.effective": _effective(rng, seed), "03.limit": _limit(rng, seed), "03.any": _any(rng, seed)}


def _logit(p: float) -> float:
    """eq. 2.16."""
    return math.log(p / (1 - p))


def _effective(rng: np.random.Generator, seed: int) -> Exercise:
    """Slider, factor, log odds."""
    p = 0.7 if seed == 0 else float(rng.choice([0.62, 0.66, 0.74, 0.78, 0.84]))
    return Exercise(
        asks=(
            f"The slider p_space stands at {p:g}. With which log odds l0 does a space cell start? Three decimals.\n"
            "(Mind the factor 0.9.)"
        ),
        answer=lambda: _logit(p * FACTOR),
        because="first the factor, then the logarithm: l0 = ln(0.9 p / (1 - 0.9 p)).",
        mistakes=(
            Mistake(lambda: _logit(p), "the factor 0.9 is missing: the slider shows the value before it."),
            Mistake(lambda: FACTOR * _logit(p), "the factor belongs to the probability, not to the log odds."),
            Mistake(lambda: _logit(p * FACTOR) / math.log(10), "that is log10; log odds here are natural, math.log."),
            Mistake(lambda: -_logit(p * FACTOR), "the sign is turned round (convention flipped): P(empty) belongs on top."),
            Mistake(lambda: p * FACTOR, "that is the effective probability; now its log odds."),
            Mistake(lambda: math.exp(_logit(p * FACTOR)), "those are the odds; their logarithm is missing."),
            Mistake(lambda: math.log(p * FACTOR), "that is the logarithm of p alone; the odds are p / (1 - p)."),
            Mistake(lambda: _logit(p * FACTOR) / math.log(2), "that is log2; log odds here are natural, math.log."),
        ),
        hints=("the effective value is 0.9 times the slider's.", "l0 = math.log(p / (1 - p)) with the effective p."),
        tolerance=1e-3,
    )


def _limit(rng: np.random.Generator, seed: int) -> Exercise:
    """Where eq. 2.22 ends, on the slider."""
    p_free = 0.8 if seed == 0 else float(rng.choice([0.7, 0.72, 0.75, 0.85]))
    return Exercise(
        asks=(
            f"A weaker sensor calls a cell that it saw free {p_free:g}. Below which value must the SLIDER p_space stay, so that "
            "eq. 2.22 holds?\nThree decimals."
        ),
        answer=lambda: p_free / FACTOR,
        because="the effective p_space = 0.9 x slider must stay below p_free, so the slider below p_free / 0.9.",
        mistakes=(
            Mistake(lambda: p_free, "that is the bound of the effective value; the slider shows it before the factor 0.9."),
            Mistake(lambda: p_free * FACTOR, "you multiplied; the slider's value TIMES 0.9 must stay below p_free."),
            Mistake(lambda: (1 - p_free) / FACTOR, "that is the bound for p_wall (convention flipped)."),
            Mistake(lambda: 1 - p_free, "that is P(wall) (convention flipped)."),
            Mistake(lambda: _logit(p_free), "those are log odds; the slider shows a probability."),
            Mistake(lambda: 100 * p_free / FACTOR, "that is in per cent; the slider runs from 0 to 1."),
        ),
        hints=("eq. 2.22 compares p_free with the effective p_space.", "0.9 x slider < p_free."),
        tolerance=1e-3,
    )


def _any(rng: np.random.Generator, seed: int) -> Exercise:
    """Cells of a small drawing by the rule "any"."""
    pixels, rules = _small_drawing(rng)
    while not _tells_mistakes_apart(rules):
        pixels, rules = _small_drawing(rng)
    if seed == 0:
        pixels = np.array(
            [
                [0, 0, 0, 0, 1, 0, 0, 0, 0],
                [0, 0, 0, 0, 1, 0, 0, 1, 1],
                [0, 0, 0, 0, 1, 0, 0, 1, 1],
                [0, 0, 0, 0, 0, 0, 0, 1, 1],
                [1, 0, 0, 0, 0, 0, 1, 1, 1],
                [0, 0, 0, 0, 0, 0, 0, 0, 0],
            ]
        )
        rules = _by_rule(pixels)
    shown = "\n".join("  " + " ".join(".#"[pixel] for pixel in row) for row in pixels)
    return Exercise(
        asks=(
            f"A drawing of 6 x 9 pixels, # = wall:\n{shown}\n"
            "Cells of 3 x 3 pixels. Which are wall when any of their pixels is? Answer two rows of three, 1 = wall."
        ),
        answer=lambda: rules["any"],
        because="one dark pixel is enough: thin walls stay on a coarse map.",
        mistakes=(
            Mistake(lambda: rules["majority"], "that is the majority rule; here one pixel is enough."),
            Mistake(lambda: 1 - rules["any"], "1 and 0 are swapped (convention flipped): 1 means wall here."),
            Mistake(lambda: rules["any"][::-1], "the rows stand upside down: row 0 is at the top."),
            Mistake(lambda: rules["any"][:, ::-1], "left and right are swapped: column 0 is at the left."),
            Mistake(lambda: rules["any"].T, "rows and columns are swapped: asked are two rows of three."),
            Mistake(lambda: rules["any"].ravel(), "that is one list of six: asked are two lists, one for each row of cells."),
            Mistake(lambda: rules["pixels"], "those are the numbers of wall pixels; a cell that holds any is 1."),
        ),
        hints=("draw two lines down and one across: six cells.", "a cell is 1 when it holds at least one #."),
    )


def _small_drawing(rng: np.random.Generator) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """6 x 9 pixels: some cells empty, some with a pixel or two, some mostly wall."""
    pixels = np.zeros((6, 9), dtype=np.int64)
    for row in (0, 3):
        for col in (0, 3, 6):
            filled = int(rng.choice([0, 1, 3, 6, 8]))
            cell = np.zeros(9, dtype=np.int64)
            cell[rng.permutation(9)[:filled]] = 1
            pixels[row : row + 3, col : col + 3] = cell.reshape(3, 3)
    return pixels, _by_rule(pixels)


def _by_rule(pixels: np.ndarray) -> dict[str, np.ndarray]:
    """(2, 3) cells of both rules, and how many wall pixels each holds."""
    counts = pixels.reshape(2, 3, 3, 3).sum(axis=(1, 3))
    return {"any": (counts > 0).astype(int), "majority": (counts > 4.5).astype(int), "pixels": counts}


def _tells_mistakes_apart(rules: dict[str, np.ndarray]) -> bool:
    """True when the right answer and each mistake differ."""
    any_rule = rules["any"]
    answers = [any_rule, rules["majority"], 1 - any_rule, any_rule[::-1], any_rule[:, ::-1]]
    return len({answer.tobytes() for answer in answers}) == len(answers)
