"""Walls: grown from doors, or chosen by line weight, or both with each correcting the other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.core.drawing import EMPTY, WALL, WINDOW, Door, Drawing, Walls
from priorlab.drawing.corners import corners_of
from priorlab.drawing.door_ink import door_ink
from priorlab.drawing.faces import thin_cells, without_lone_bars
from priorlab.drawing.filled_walls import hatched_round, with_filled
from priorlab.drawing.joined import between_ends, with_edges, with_heavy_ink, with_others, without_thin_outside
from priorlab.drawing.method import ROBUST, Method
from priorlab.drawing.network import of_network, without_blocks
from priorlab.drawing.outer_walls import outer_walls
from priorlab.drawing.pieces import WallPiece, wall_pieces
from priorlab.drawing.preprocessing import large_components, prepare
from priorlab.drawing.runs import run_lengths
from priorlab.drawing.sheet import Sheet
from priorlab.drawing.strokes import strip_strokes
from priorlab.drawing.sweeps import HORIZONTAL, VERTICAL, jamb_runs, orientation, sweep_walls
from priorlab.drawing.valleys import narrow_gaps, valleys
from priorlab.drawing.wall_bodies import hollow_walls
from priorlab.drawing.wall_sizes import WallSizes, wall_sizes
from priorlab.drawing.weight import (
    HATCHED,
    IN_COLOUR,
    STRAIGHT_CELLS,
    Hypothesis,
    judged,
    of_hue,
    weight_hypotheses,
)
from priorlab.drawing.window_search import find_windows
from priorlab.drawing.windows import window_bridges, window_panes

DOORS_ALONE = 0.3
"""Weight of the walls grown from doors alone beside those of line weight: they know no insides and follow any line."""


HOLLOW = 0.5
"""Walls are drawn hollow when bodies that end at jambs and go on in line make up so much of the best other hypothesis."""

FEWEST_FOR_A_SCALE = 3
"""Doors that are needed to tell how thick a wall can be."""

DRAWN_SOLID = 0.8
"""Walls of which so much is ink are drawn solid, with windows between them."""

HATCHING_COVERS = 0.5
"""Hatching is taken when it makes up so much of the best hypothesis, or is worth so much of it."""

SOLID_COVERS = 0.5
"""Solid walls are preferred when they make up so much of the best hypothesis."""


OUTLINES = 0.02
"""Components shorter than this share of M bound no inside of a wall."""

HALF = 0.45
"""Of a pixel that a line covers half, so much of full darkness is left at least."""

NEAR_JAMB = 0.15
"""A jamb stands on a wall that is within so many door widths of it."""

JAMBLESS = 0.25
"""Worth of walls on which no jamb stands, beside the same walls with all jambs on them."""

NEARLY = 0.95
"""Of hypotheses that are nearly as good as the best, the heaviest is taken: it holds the least furniture."""

NEARLY_SOLID = 0.75
"""The same where walls are solid: lighter strokes are worth more for windows, which are added later."""

WALL_LENGTH = 0.1
"""The longest straight stroke of a building is at least this share of the drawing's long side; letters are shorter."""


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
    """
    sheet = prepare(drawing, method)
    found = search_walls(sheet, doors, corners_of(sheet, method.n_corners, method), method)
    return as_walls(drawing, found.walls, found.windows)


def search_walls(sheet: Sheet, doors: Sequence[Door], corners: NDArray[np.float64], method: Method = ROBUST) -> WallSearch:
    """`detect_walls`, with everything it saw. `corners` are in working pixels, `doors` in the drawing's own."""
    scaled = sheet.doors_to_work(doors)
    drawn = sheet.walls
    if method.sources == "both":
        sheet = replace(sheet, walls=drawn & ~valleys(sheet.darkness))
    large = method.component_share > 0
    ink = large_components(sheet.walls, method.component_share * sheet.long_side) if large else sheet.walls
    outer = outer_walls(ink, corners, method.outer_tolerance)
    symbols = door_ink(sheet, scaled) if method.sources == "both" else np.zeros_like(ink)
    seeds = outer if method.sources == "doors" and scaled else np.zeros_like(ink)  # without a door the search never begins
    sweeps = sweeps_from(ink & ~symbols, seeds, scaled, method)
    guided = strip_strokes(sweeps[-1], method.strip_share) if method.strip_share else sweeps[-1]
    glass: NDArray[np.bool_] | None = None
    if method.sources == "doors":
        hypotheses: tuple[Hypothesis, ...] = (Hypothesis("doors", guided, float(guided.any())),)
        chosen, walls, worths = "doors", guided, [1.0]
    else:
        width = float(np.median([door.width for door in scaled])) if len(scaled) >= FEWEST_FOR_A_SCALE else None
        sizes = wall_sizes(sheet.long_side, width)
        outlines = large_components(drawn, OUTLINES * sheet.long_side)
        hypotheses = (judged("doors", guided, sizes), *weight_hypotheses(sheet, ink & ~symbols, outlines, sizes))
        bodies = hollow_walls(outlines, scaled, sizes)
        worths = worths_of(hypotheses, scaled, symbols)
        best = choose(hypotheses, worths)
        if best.hue is None and _share(best.walls, bodies.walls) >= HOLLOW:
            best = bodies
        hypotheses, worths = (*hypotheses, bodies), [*worths, *worths_of([bodies], scaled, symbols)]
        joined = best.walls
        drawn_solid = best.solid or _share(joined, ink) >= DRAWN_SOLID
        if best.name == HATCHED:
            joined = with_filled(joined, best.weight, ink & ~symbols, scaled, sizes)
            joined = with_edges(joined, half_covered(sheet.darkness, ink))
        elif drawn_solid:
            parted = outlines & sheet.walls
            joined = with_heavy_ink(with_others(best, hypotheses, worths, sizes, scaled, parted), parted)
            joined = without_thin_outside(joined)
            joined = with_edges(joined, ink) if best.solid else joined
        chosen = best.name
        if drawn_solid and chosen != HATCHED:
            hatched = next((h.walls for h in hypotheses if h.name == HATCHED), np.zeros_like(joined))
            joined = joined | hatched_round(hatched & ~symbols, joined, outlines)
        walls = joined if chosen == HATCHED else joined & ~(symbols & ~guided)  # no leaf or arc is hatched
    if method.bridge_widths and scaled and walls.any():
        longest = method.bridge_widths * float(np.median([door.width for door in scaled]))
        walls = walls | (window_bridges(walls, sheet.lines, longest) & ~symbols)
    if method.sources == "both":
        if best is not bodies:
            walls = walls & ~window_panes(thin_cells(outlines, sizes), sizes)
        if chosen == HATCHED:
            walls = of_network(walls, scaled, sizes, outlines)
        else:
            walls = of_network(without_lone_bars(walls, wall_sizes(sheet.long_side)), scaled, sizes)
        walls = without_blocks(walls, sheet.walls, scaled)
        walls = walls | (narrow_gaps(walls) & drawn & ~sheet.walls)
        glass = windows_of(replace(sheet, walls=drawn), walls, best, sizes)
        walls = walls | (between_ends(glass, walls) & drawn & ~symbols)  # not what stands along the wall beside it
    found = sheet.to_input(walls)
    windows = None if glass is None else sheet.to_input(glass)
    as_input = tuple(replace(h, walls=sheet.to_input(h.walls)) for h in hypotheses)
    return WallSearch(
        outer=sheet.to_input(outer),
        sweeps=tuple(sheet.to_input(stage) for stage in sweeps),
        hypotheses=as_input,
        chosen=chosen,
        walls=found,
        pieces=wall_pieces(found, as_input, worths, windows),
        windows=windows,
    )


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


def worths_of(hypotheses: Sequence[Hypothesis], doors: Sequence[Door], symbols: NDArray[np.bool_]) -> list[float]:
    """How far to trust each hypothesis, in the light of the doors: jambs stand on walls, leaves and arcs are none.

    Solid strokes that are the faces of long cells are no walls by themselves.
    """
    in_colour = any(h.name.startswith("hue") for h in hypotheses)
    doors_alone = DOORS_ALONE * (IN_COLOUR if in_colour else 1.0)
    trust = [doors_alone if h.name == "doors" else 1.0 for h in hypotheses]
    insides = next((h.walls for h in hypotheses if h.name == STRAIGHT_CELLS), np.zeros_like(symbols))
    trust = [t * (1 - _share(h.walls, insides)) if h.solid else t for t, h in zip(trust, hypotheses, strict=True)]
    return [t * h.quality * door_agreement(h.walls, doors, symbols) for t, h in zip(trust, hypotheses, strict=True)]


def _share(walls: NDArray[np.bool_], part: NDArray[np.bool_]) -> float:
    """Share of the walls that lies in a part; 0 of nothing."""
    return float(part[walls].mean()) if walls.any() else 0.0


def choose(hypotheses: Sequence[Hypothesis], worths: Sequence[float]) -> Hypothesis:
    """The most wall-like hypothesis; the heaviest of those that are nearly as good.

    Where solid strokes make up most of the best one, they are taken: they need no guess about what lies between lines.
    Where none is worth anything and no stroke is as long as a wall, as on a page of text, nothing is a wall.
    """
    pairs = list(zip(hypotheses, worths, strict=True))
    best, most = max(pairs, key=lambda pair: pair[1])
    if not most > 0 and not any(_longest_run(h.walls) >= WALL_LENGTH * max(h.walls.shape) for h in hypotheses):
        return replace(best, walls=np.zeros_like(best.walls))
    if best.weight:
        least = NEARLY_SOLID if best.solid else NEARLY
        best = max((h for h, worth in pairs if worth >= least * most and h.solid >= best.solid), key=lambda h: h.weight)
    hatched, worth = next(((h, w) for h, w in pairs if h.name == HATCHED), (best, 0.0))
    covers = (hatched.walls & best.walls).sum() >= HATCHING_COVERS * best.walls.sum()
    if hatched.walls.any() and (covers or worth >= HATCHING_COVERS * most):
        return hatched
    solid = [
        (h, w)
        for h, w in pairs
        if h.solid and h.weight >= best.weight and (h.walls & best.walls).sum() >= SOLID_COVERS * best.walls.sum()
    ]
    return max(solid, key=lambda pair: pair[1])[0] if solid else best


def _longest_run(walls: NDArray[np.bool_]) -> int:
    """Pixels in the longest straight run along either axis."""
    return max(int(run_lengths(walls, axis).max(initial=0)) for axis in (0, 1))


def door_agreement(walls: NDArray[np.bool_], doors: Sequence[Door], symbols: NDArray[np.bool_]) -> float:
    """How well walls and doors fit: jambs on the walls, and no leaf or arc among them; 1 at best and without doors."""
    if not doors:
        return 1.0
    reach = max(4, round(NEAR_JAMB * float(np.median([door.width for door in doors]))))
    near = cv2.dilate(walls.astype(np.uint8), np.ones((2 * reach + 1, 2 * reach + 1), np.uint8)).astype(bool)
    jambs = np.rint([jamb for door in doors for jamb in (door.hinge, door.strike)]).astype(int)
    x, y = np.clip(jambs, 0, [walls.shape[1] - 1, walls.shape[0] - 1]).T
    on_walls = near[y, x].mean()
    mistaken = walls[symbols].mean() if symbols.any() else 0.0
    return float((JAMBLESS + (1 - JAMBLESS) * on_walls) * (1 - 0.8 * mistaken))


def windows_of(sheet: Sheet, walls: NDArray[np.bool_], best: Hypothesis, sizes: WallSizes) -> NDArray[np.bool_]:
    """Boxes of the windows; where a hue tells the walls, their lines have another one."""
    if best.hue is None:
        return find_windows(walls, sheet.walls, sizes, best.weight)
    return find_windows(walls, sheet.walls & ~of_hue(sheet.hue, best.hue), sizes, np.inf, fewest=3)


def half_covered(darkness: NDArray[np.uint8], ink: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Pixels about half as dark as full ink: half of them, or more, is covered by a line."""
    return darkness >= (HALF * np.percentile(darkness[ink], 98) if ink.any() else 255)


def as_walls(drawing: Drawing, mask: NDArray[np.bool_], windows: NDArray[np.bool_] | None = None) -> Walls:
    """A mask as the record of a drawing's walls, of which some may be windows."""
    labels = np.where(mask, WALL, EMPTY).astype(np.uint8)
    if windows is not None:
        labels[mask & windows] = WINDOW
    return Walls(labels, metres_per_pixel=drawing.metres_per_pixel, name=drawing.name)
