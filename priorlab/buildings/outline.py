"""A house from outside: a rectangle, an L, or a rectangle with a wing at an angle."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from priorlab.buildings.cells import Block, Box
from priorlab.buildings.parts import Point
from priorlab.buildings.recipe import Recipe


@dataclass(frozen=True)
class Outline:
    """The house from outside, metres: corners of its main part, and of a wing that stands at an angle."""

    main: tuple[Point, ...]
    wing: tuple[Point, ...] = ()
    wing_block: Block = Block()
    wing_box: Box = (0.0, 0.0, 0.0, 0.0)

    @property
    def bounds(self) -> Box:
        """Left, bottom, right, top."""
        points = np.array(self.main + self.wing)
        return (*points.min(axis=0).tolist(), *points.max(axis=0).tolist())


def outline_of(recipe: Recipe, rng: np.random.Generator) -> Outline:
    """The outer faces, which do not depend on the thickness of the walls."""
    width, depth = recipe.size
    square = ((0.0, 0.0), (width, 0.0), (width, depth), (0.0, depth))
    if recipe.kind == "wing":
        left, low = round(width * float(rng.uniform(0.52, 0.6)), 2), -round(depth * float(rng.uniform(0.55, 0.7)), 2)
        return Outline(((0.0, 0.0), (left, 0.0), (left, low), (width, low), (width, depth), (0.0, depth)))
    if recipe.kind == "diagonal":
        turn = float(rng.choice([-1, 1])) * round(float(rng.uniform(20, 32)), 1)
        across, length = 0.5 * depth, 0.62 * width
        foot = 0.42 * depth if turn < 0 else 0.08 * depth
        block = Block((width, foot), turn)
        cos, sin = float(np.cos(np.radians(turn))), float(np.sin(np.radians(turn)))
        # across the main house's wall the wing begins askew: its upper side starts `sin` further along its axis
        wing = (block.out(0, 0), block.out(length, 0), block.out(length, across * cos), block.out(across * sin, across * cos))
        return Outline(square, wing, block, (max(0.0, across * sin), 0.0, length, across * cos))
    return Outline(square)
