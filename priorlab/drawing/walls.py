"""Walls: grown from doors, or chosen by line weight, or both with each correcting the other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import check_record
from priorlab.core.drawing import EMPTY, WALL, WINDOW, Door, Drawing, Walls
from priorlab.drawing.corners import corners_of
from priorlab.drawing.door_ink import door_ink
from priorlab.drawing.given_doors import check_doors
from priorlab.drawing.heavy_strokes import ALL_HEAVY, heavy_strokes, is_furnished, without_leaves
from priorlab.drawing.joined import between_ends
from priorlab.drawing.method import ROBUST, Method
from priorlab.drawing.network import without_blocks, without_marks
from priorlab.drawing.outer_walls import outer_walls
from priorlab.drawing.pieces import WallPiece, wall_pieces
from priorlab.drawing.preprocessing import prepare
from priorlab.drawing.sheet import Sheet
from priorlab.drawing.strokes import strip_strokes
from priorlab.drawing.sweeps import HORIZONTAL, VERTICAL, jamb_runs, orientation, sweep_walls
from priorlab.drawing.wall_bodies import hollow_walls
from priorlab.drawing.wall_choice import choose, has_other_style, prefer_bodies, worths_of
from priorlab.drawing.wall_completion import completed, of_the_building, windows_of
from priorlab.drawing.wall_scene import WallScene, scene_of
from priorlab.drawing.weight import Hypothesis, judged, weight_hypotheses
from priorlab.drawing.windows import window_bridges


@dataclass(frozen=True, eq=False)
class WallSearch:
    """Everything the search for walls saw; all masks in pixels of the drawing.

    Parameters
    ----------
    outer : (height, width) bool, outer walls (eq. 3.12)
    sweeps : walls after the jambs' runs and after each sweep
    hypotheses : what doors, weights and hues each take for walls
    chosen : name of the hypothesis that was taken
    walls : (height, width) bool, the result
    pieces : its straight stretches and its windows, each with a confidence
    windows : (height, width) bool, boxes of the windows, white between their lines too; None when they were not looked for
    """

    outer: NDArray[np.bool_]
    sweeps: tuple[NDArray[np.bool_], ...]
    hypotheses: tuple[Hypothesis, ...]
    chosen: str
    walls: NDArray[np.bool_]
    pieces: tuple[WallPiece, ...] = ()
    windows: NDArray[np.bool_] | None = None


def detect_walls(drawing: Drawing, doors: Sequence[Door], method: Method = ROBUST) -> Walls:
    """The walls of a drawing, from its doors (`THESIS`), or from its doors and the weight of its lines (`ROBUST`).

    Parameters
    ----------
    drawing : the drawing
    doors : as `detect_doors` gives them, in pixels of the drawing
    method : its sources and thresholds

    Returns
    -------
    labels in the drawing's own pixels; all empty when there is nothing to begin with

    Raises
    ------
    ValueError
        When something else stands among the doors, or a door that is not on the drawing, or wider than half of it.
    """
    check_record("drawing", drawing, Drawing)
    check_doors(doors, drawing.shape)
    sheet = prepare(drawing, method)
    found = search_walls(sheet, doors, corners_of(sheet, method.n_corners, method), method)
    return as_walls(drawing, found.walls, found.windows)


def search_walls(sheet: Sheet, doors: Sequence[Door], corners: NDArray[np.float64], method: Method = ROBUST) -> WallSearch:
    """`detect_walls`, with everything it saw. `corners` are in working pixels, `doors` in the drawing's own."""
    if not sheet.lines.any():
        return _nothing(sheet, method)
    scene = scene_of(sheet, doors, method)
    outer = outer_walls(scene.ink, corners, method.outer_tolerance)
    by_doors_alone = method.sources == "doors"
    seeds = outer if by_doors_alone and scene.doors else np.zeros_like(outer)  # without a door the search never begins
    sweeps = sweeps_from(scene.without_doors, seeds, scene.doors, method)
    guided = strip_strokes(sweeps[-1], method.strip_share) if method.strip_share else sweeps[-1]
    glass: NDArray[np.bool_] | None = None
    if by_doors_alone:
        best = Hypothesis("doors", guided, float(guided.any()))
        hypotheses: tuple[Hypothesis, ...] = (best,)
        worths, walls = [1.0], guided
    else:
        hypotheses, worths, best = _chosen(scene, guided)
        walls = best.walls if best.name == ALL_HEAVY else completed(best, hypotheses, worths, scene, guided)
    if method.bridge_widths and scene.doors and walls.any() and best.name != ALL_HEAVY:
        walls = walls | (window_bridges(walls, scene.sheet.lines, method.bridge_widths * scene.door_width) & ~scene.symbols)
    if not by_doors_alone:
        walls = walls if best.name == ALL_HEAVY else of_the_building(walls, best, scene)
        glass = windows_of(walls, best, scene)
        walls = walls | (between_ends(glass, walls) & scene.drawn & ~scene.symbols)  # not what stands along the wall beside it
    found = sheet.to_input(walls)
    windows = None if glass is None else sheet.to_input(glass)
    as_input = tuple(replace(h, walls=sheet.to_input(h.walls)) for h in hypotheses)
    return WallSearch(
        outer=sheet.to_input(outer),
        sweeps=tuple(sheet.to_input(stage) for stage in sweeps),
        hypotheses=as_input,
        chosen=best.name,
        walls=found,
        pieces=wall_pieces(found, as_input, worths, windows),
        windows=windows,
    )


def _nothing(sheet: Sheet, method: Method) -> WallSearch:
    """What a sheet without ink has."""
    empty = np.zeros(sheet.input_shape, dtype=bool)
    return WallSearch(
        outer=empty,
        sweeps=(empty,) * (method.n_sweeps + 1),
        hypotheses=(Hypothesis("doors", empty, 0.0),),
        chosen="doors",
        walls=empty,
        windows=None if method.sources == "doors" else empty,
    )


def _chosen(scene: WallScene, guided: NDArray[np.bool_]) -> tuple[tuple[Hypothesis, ...], list[float], Hypothesis]:
    """All hypotheses, how far each is trusted, and the best: walls by doors, weight, hue, hatching, cells and hollow bodies.

    Where nothing but walls is heavy, all heavy strokes are taken, whatever the others are worth.
    """
    sizes, outlines = scene.sizes, scene.outlines()
    hypotheses = (judged("doors", guided, sizes), *weight_hypotheses(scene.sheet, scene.without_doors, outlines, sizes))
    worths = worths_of(hypotheses, scene.doors, scene.symbols)
    bodies = hollow_walls(outlines, scene.doors, sizes)
    (worth,) = worths_of([bodies], scene.doors, scene.symbols)
    best = prefer_bodies(choose(hypotheses, worths), bodies, worth, max(worths))
    hypotheses, worths = (*hypotheses, bodies), [*worths, worth]
    heavy = heavy_strokes(scene.sheet.darkness, scene.drawn)
    if heavy is None or has_other_style(heavy, hypotheses):
        return hypotheses, worths, best
    heavy = without_leaves(heavy, (door_ink(scene.sheet, [door]) for door in scene.doors))
    heavy = without_marks(heavy, sizes)
    heavy = without_blocks(heavy, scene.drawn, scene.doors) if is_furnished(heavy, scene.drawn) else heavy
    best = judged(ALL_HEAVY, heavy, sizes, solid=True)
    return (*hypotheses, best), [*worths, max(best.quality, *worths)], best


def sweeps_from(
    ink: NDArray[np.bool_], outer: NDArray[np.bool_], doors: Sequence[Door], method: Method
) -> tuple[NDArray[np.bool_], ...]:
    """Walls after the jambs' runs and after every sweep, from all doors at once.

    Horizontal doors begin with a horizontal sweep, vertical ones with a vertical one (3.3.1); the outer walls join the jambs'
    runs at the start.
    """
    stages = [outer & ink] * (method.n_sweeps + 1)
    for way, first in (("h", HORIZONTAL), ("v", VERTICAL)):
        some = [door for door in doors if orientation(door) == way]
        if some:
            grown = sweep_walls(ink, outer | jamb_runs(ink, some, method.reach), first, method.n_sweeps)
            stages = [stage | more for stage, more in zip(stages, grown, strict=True)]
    return tuple(stages)


def as_walls(drawing: Drawing, mask: NDArray[np.bool_], windows: NDArray[np.bool_] | None = None) -> Walls:
    """A mask as the record of a drawing's walls, of which some may be windows."""
    labels = np.where(mask, WALL, EMPTY).astype(np.uint8)
    if windows is not None:
        labels[mask & windows] = WINDOW
    return Walls(labels, metres_per_pixel=drawing.metres_per_pixel, name=drawing.name)
