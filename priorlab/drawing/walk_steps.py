"""One walk of algorithm 3.1 with what it saw at every pixel: three neighbours, which are dark, how far from the goal."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from priorlab.drawing.connectivity import Walk, forward_neighbours, walk


@dataclass(frozen=True)
class WalkStep:
    """What a walk saw at one pixel.

    Parameters
    ----------
    at : (x, y) of the pixel
    neighbours : P_n, the three pixels ahead (eq. 3.6-3.9), in the order in which they are tested
    dark : which of them are ink
    distances : d_i of each from the goal, pixels (eq. 3.10)
    chosen : the pixel that comes next; None where the walk ends
    """

    at: tuple[int, int]
    neighbours: tuple[tuple[int, int], ...]
    dark: tuple[bool, ...]
    distances: tuple[float, ...]
    chosen: tuple[int, int] | None

    @property
    def n_dark(self) -> int:
        """n_d: how many of the neighbours are dark."""
        return sum(self.dark)


def walk_steps(
    ink: ArrayLike, origin: tuple[int, int], goal: tuple[int, int], reach: int = 2
) -> tuple[Walk, tuple[WalkStep, ...]]:
    """`walk`, and what it saw at each pixel of its path.

    Parameters
    ----------
    ink, origin, goal, reach : as in `walk`

    Returns
    -------
    the walk, and one step for each pixel of its path; the last one chose nothing

    >>> line = np.zeros((3, 9), dtype=bool); line[1, :6] = True
    >>> way, steps = walk_steps(line, (0, 1), (8, 1), reach=0)
    >>> way.reached, steps[0].neighbours, steps[0].dark, steps[-1].n_dark
    (False, ((1, 1), (1, 0), (1, 2)), (True, False, False), 0)
    """
    ink = np.asarray(ink, dtype=bool)
    height, width = ink.shape
    way = walk(ink, origin, goal, reach)
    ahead = forward_neighbours(way.path[0], goal)
    steps = []
    for place, (x, y) in enumerate(way.path):
        neighbours = tuple((x + dx, y + dy) for dx, dy in ahead)
        dark = tuple(0 <= px < width and 0 <= py < height and bool(ink[py, px]) for px, py in neighbours)
        distances = tuple(float(np.hypot(px - goal[0], py - goal[1])) for px, py in neighbours)  # eq. 3.10
        chosen = way.path[place + 1] if place + 1 < len(way.path) else None
        steps.append(WalkStep((x, y), neighbours, dark, distances, chosen))
    return way, tuple(steps)
