"""What a figure made anew is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

Verdict = Literal["agrees", "partly", "differs"]


@dataclass(frozen=True, eq=False)
class Outcome:
    """A figure of ours.

    Parameters
    ----------
    figure : the picture
    numbers : what it shows, as plain data
    verdict : whether the thesis's claim holds here; computed from `numbers`
    says : why, in one sentence with the numbers
    alt : what the picture shows, for who cannot see it
    """

    figure: Figure
    numbers: dict[str, Any]
    verdict: Verdict
    says: str
    alt: str


@dataclass(frozen=True)
class Entry:
    """A figure or table of the thesis.

    Parameters
    ----------
    name : as in "fig-4-7"
    title : what it shows
    claim : what the thesis says of it, in our words
    make : computes it; randomness is the argument
    """

    name: str
    title: str
    claim: str
    make: Callable[[np.random.Generator], Outcome] = field(repr=False)


def sheet(rows: int, cols: int, width: float = 4.2, height: float = 3.4) -> tuple[Figure, list[Axes]]:
    """A new figure of rows x cols axes, each so many inches; pyplot's list of open figures is left alone."""
    figure = Figure(figsize=(cols * width, rows * height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure, [figure.add_subplot(rows, cols, i + 1) for i in range(rows * cols)]


def verdict_of(holds: list[bool]) -> Verdict:
    """All, some or none of the claims hold.

    >>> verdict_of([True, True]), verdict_of([True, False]), verdict_of([False])
    ('agrees', 'partly', 'differs')
    """
    return "agrees" if all(holds) else "partly" if any(holds) else "differs"
