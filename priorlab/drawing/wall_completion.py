"""From the chosen hypothesis to the walls: what it lacks is added, what belongs to no building is taken off."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from priorlab.drawing.faces import thin_cells, without_lone_bars
from priorlab.drawing.filled_walls import THICKER, walls_round, with_filled
from priorlab.drawing.joined import HEAVY, with_edges, with_heavy_ink, with_others, without_thin_outside
from priorlab.drawing.network import of_network, without_blocks
from priorlab.drawing.strokes import common_weight, half_covered, line_weights
from priorlab.drawing.valleys import narrow_gaps
from priorlab.drawing.wall_bodies import BODIES, hollow_walls
from priorlab.drawing.wall_choice import share_in
from priorlab.drawing.wall_scene import WallScene
from priorlab.drawing.wall_sizes import wall_sizes
from priorlab.drawing.weight import HATCHED, STRAIGHT_CELLS, Hypothesis, of_hue
from priorlab.drawing.window_search import find_windows
from priorlab.drawing.windows import window_panes

DRAWN_SOLID = 0.8
"""Walls of which so much is ink are drawn solid, with windows between them."""

OUTWEIGH = 2.0
"""Hollow walls round solid ones cover so many times as much: outer walls are thick, partitions thin."""


def completed(
    best: Hypothesis, hypotheses: Sequence[Hypothesis], worths: Sequence[float], scene: WallScene, guided: NDArray[np.bool_]
) -> NDArray[np.bool_]:
    """The best hypothesis with the solid walls that it lacks, each style in its own way; without leaves and arcs.

    Parameters
    ----------
    best, hypotheses, worths : what was chosen, among what, and how far each is trusted
    scene : the ink
    guided : (height, width) bool, walls grown from doors: they may lie on a door's ink
    """
    walls, outlines = best.walls, scene.outlines()
    if best.name == HATCHED:  # no leaf or arc is hatched
        walls = with_filled(walls, best.weight, scene.without_doors, scene.doors, scene.sizes)
        return with_edges(walls, half_covered(scene.sheet.darkness, scene.ink))
    if best.name == BODIES:  # partitions among hollow walls are drawn solid
        faces = line_weights(scene.sheet.darkness, outlines)
        walls = with_filled(walls, HEAVY / THICKER * common_weight(faces, walls), scene.without_doors, scene.doors, scene.sizes)
    if best.solid or share_in(walls, scene.ink) >= DRAWN_SOLID:
        parted = outlines & scene.sheet.walls
        weights = np.where(scene.lines(), line_weights(scene.sheet.darkness, parted), 0.0)
        walls = with_heavy_ink(with_others(best, hypotheses, worths, scene.sizes, scene.doors, weights), parted)
        walls = without_thin_outside(walls)
        walls = with_edges(walls, scene.ink) if best.solid else walls
        hatched = next((h.walls for h in hypotheses if h.name == HATCHED), np.zeros_like(walls))
        walls = walls | walls_round(hatched & ~scene.symbols, walls, outlines)
        walls = walls | hollow_round(hypotheses, walls, scene)
    return walls & ~(scene.symbols & ~guided)


def hollow_round(hypotheses: Sequence[Hypothesis], walls: NDArray[np.bool_], scene: WallScene) -> NDArray[np.bool_]:
    """The hollow walls round solid ones: they outweigh these, which are the partitions; all that goes on in line with them."""
    found = np.zeros_like(walls)
    for other in (h.walls for h in hypotheses if h.name in (BODIES, STRAIGHT_CELLS)):
        found |= walls_round(other, walls, scene.outlines())
    if found.sum() < OUTWEIGH * walls.sum() or not found.any():
        return np.zeros_like(walls)
    return found | hollow_walls(scene.outlines(), scene.doors, scene.sizes, found).walls


def of_the_building(walls: NDArray[np.bool_], best: Hypothesis, scene: WallScene) -> NDArray[np.bool_]:
    """Walls without panes, lone bars, frames and blocks; the ink between two strokes of one wall is given back."""
    outlines, sizes = scene.outlines(), scene.sizes
    if best.name != BODIES:
        walls = walls & ~window_panes(thin_cells(outlines, sizes), sizes)
    if best.name == HATCHED:
        walls = of_network(walls, scene.doors, sizes, outlines)
    else:
        lines = outlines if best.solid else None
        walls = of_network(without_lone_bars(walls, wall_sizes(scene.sheet.long_side)), scene.doors, sizes, lines=lines)
    walls = without_blocks(walls, scene.sheet.walls, scene.doors)
    return walls | (narrow_gaps(walls) & scene.drawn & ~scene.sheet.walls)


def windows_of(walls: NDArray[np.bool_], best: Hypothesis, scene: WallScene) -> NDArray[np.bool_]:
    """Boxes of the windows; where a hue tells the walls, their lines have another one."""
    if best.hue is None:
        return find_windows(walls, scene.drawn, scene.sizes, best.weight)
    return find_windows(walls, scene.drawn & ~of_hue(scene.sheet.hue, best.hue), scene.sizes, np.inf, fewest=3)
