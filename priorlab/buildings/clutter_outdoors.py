"""Round a house: terraces, cars, trees. `free` is where the next thing on the right may begin, metres."""

from __future__ import annotations

import numpy as np

from priorlab.buildings.parts import Furniture, Line
from priorlab.buildings.site import Site, Surroundings


def _terrace(site: Site, around: Surroundings, boards: bool) -> None:
    """A terrace before the southern wall: boards, or square slabs."""
    width = site.recipe.size[0]
    left, right, low, high = 0.15 * width, 0.15 * width + min(0.6 * width, 7.0), site.bounds[1] - 2.4, site.bounds[1]
    weight = site.recipe.line
    around.lines.append(Line(((left, high), (left, low), (right, low), (right, high)), weight=weight))
    step = 0.24 if boards else 0.6
    for y in np.arange(high - step, low + 0.1, -step):
        around.lines.append(Line(((left, float(y)), (right, float(y))), weight=weight))
    for x in np.arange(left + step, right - 0.1, step) if not boards else ():
        around.lines.append(Line(((float(x), low), (float(x), high)), weight=weight))


def add_paving(site: Site, around: Surroundings, free: float) -> None:
    """Slabs."""
    _terrace(site, around, boards=False)


def add_decking(site: Site, around: Surroundings, free: float) -> None:
    """Boards."""
    _terrace(site, around, boards=True)


def add_cars(site: Site, around: Surroundings, free: float) -> None:
    """A few cars on the right, free on the forecourt."""
    _, low, _, high = site.bounds
    for y in np.arange(low + 1.3, high - 1.0, 3.1):
        turn = float(site.rng.uniform(-6, 6))
        around.furniture.append(Furniture("car", at=(free + 2.7, float(y)), back="west", turn=turn))


def add_parking(site: Site, around: Surroundings, free: float) -> None:
    """Stalls on the right, most of them taken."""
    _, low, _, high = site.bounds
    levels = np.arange(low + 0.3, high, 2.6)
    for y in levels:
        around.lines.append(Line(((free + 0.4, float(y)), (free + 5.4, float(y))), weight=site.recipe.line))
    for y in levels[:-1]:
        if site.rng.random() < 0.7:
            around.furniture.append(Furniture("car", at=(free + 2.9, float(y) + 1.3), back="west"))


def _row_of_trees(site: Site, around: Surroundings, size: tuple[float, float], free: float) -> None:
    """Trees in a row on the right."""
    _, low, _, high = site.bounds
    y = low + size[0] / 2
    while y < high:
        across = float(site.rng.uniform(*size))
        around.furniture.append(Furniture("tree", at=(free + 1.1, y), size=(across, across)))
        y += across + 0.3


def add_trees(site: Site, around: Surroundings, free: float) -> None:
    """A few large ones."""
    _row_of_trees(site, around, (1.6, 2.2), free)


def add_hedge(site: Site, around: Surroundings, free: float) -> None:
    """Many smaller ones."""
    _row_of_trees(site, around, (1.1, 1.5), free)
