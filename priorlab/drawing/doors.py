"""Doors: isosceles triangles of two connected sides and an open one (thesis 3.3.1, fig. 3.5).

The search walks over the connectivity graph: only wedges, two connected sides that meet, are candidates. That finds the same
triangles as the thesis's loop over all triples of corners, and a thousand corners take less than a second instead of a minute.
"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.drawing import Door, Drawing
from priorlab.drawing.candidates import DOOR, TESTS, DoorSearch, asked_tests, first_corners, wedges
from priorlab.drawing.connectivity import connect
from priorlab.drawing.door_tests import ASK, ON_ITS_OWN, Scene, Shortlist, passed
from priorlab.drawing.folding import folding_doors
from priorlab.drawing.geometry import tilts
from priorlab.drawing.jamb_walls import meets_other_leaf
from priorlab.drawing.jambs import with_measured_jambs
from priorlab.drawing.leaves import leaf_candidates, straight_pairs
from priorlab.drawing.method import ROBUST, Method
from priorlab.drawing.preprocessing import Sheet, prepare


def detect_doors(drawing: Drawing, corners: ArrayLike, method: Method = ROBUST) -> tuple[Door, ...]:
    """The doors among the triangles of a drawing's corners.

    Parameters
    ----------
    drawing : the drawing
    corners : (N, 2) x, y in pixels of the drawing, as `detect_corners` gives them
    method : its tests and thresholds

    Returns
    -------
    doors with hinge, strike and tip, best first
    """
    return search_doors(prepare(drawing, method), corners, method).doors


def search_doors(sheet: Sheet, corners: ArrayLike, method: Method = ROBUST) -> DoorSearch:
    """`detect_doors`, with everything it saw: connected pairs, candidates, and the test that each one failed."""
    points = np.asarray(corners, dtype=np.float64)
    if points.size == 0:
        points = np.empty((0, 2))
    if points.ndim != 2 or points.shape[1] != 2 or not np.isfinite(points).all():
        raise ValueError(f"corners must be finite numbers of shape (N, 2) for x, y, got shape {points.shape}")
    xy = sheet.points_to_work(points)
    longest = method.max_side_share * float(np.sqrt(sheet.lines.size))
    ink = walkable(sheet, method)
    connected = connect(ink, xy, method.min_side / 2, longest * np.sqrt(2), method.reach)
    n_tried = first_corners(connected)
    connected[n_tried:] = connected[:, n_tried:] = False
    candidates = wedges(connected)
    if method.lone_leaves:
        near_ink = cv2.dilate(ink.astype(np.uint8), np.ones((3, 3), np.uint8)).astype(bool)
        straight = straight_pairs(near_ink, xy, connected, method.min_side, longest, method.min_leaf)
        candidates = np.vstack([candidates, leaf_candidates(straight, connected, xy, method.isosceles_ratio)])
    scene = Scene(sheet, method, xy, connected)
    reasons = asked_one_by_one(scene, candidates)
    alive = np.flatnonzero(reasons == DOOR)
    some = Shortlist(scene, candidates[alive])
    for test in asked_tests(method):
        if test in ON_ITS_OWN:
            continue
        if test == "overlap" and method.keep_best:
            order = np.argsort(-some.quality, kind="stable")
            alive, some = alive[order], some[order]
        keep = passed(ASK[test](some))
        reasons[alive[~keep]] = TESTS.index(test)
        alive, some = alive[keep], some[keep]
    doors = _as_doors(some, sheet, method)
    if method.folding:
        near_ink = cv2.dilate(ink.astype(np.uint8), np.ones((3, 3), np.uint8)).astype(bool)
        doors += sheet.doors_to_input(folding_doors(scene, near_ink, some.triangles))
    return DoorSearch(
        corners=points,
        n_tried=n_tried,
        edges=np.argwhere(np.triu(connected)),
        candidates=candidates,
        reasons=reasons,
        doors=doors,
        sheet=sheet,
        method=method,
    )


def asked_one_by_one(scene: Scene, candidates: NDArray[np.int32]) -> NDArray[np.int8]:
    """(K,) what each candidate fails of the tests `ON_ITS_OWN`, or `DOOR`; a block at a time, as there may be millions."""
    reasons = np.full(len(candidates), DOOR, dtype=np.int8)
    for begin in range(0, len(candidates), BLOCK):
        alive = np.arange(begin, min(begin + BLOCK, len(candidates)))
        for test in (test for test in asked_tests(scene.method) if test in ON_ITS_OWN):
            keep = passed(ASK[test](Shortlist(scene, candidates[alive])))
            reasons[alive[~keep]] = TESTS.index(test)
            alive = alive[keep]
    return reasons


BLOCK = 250_000
"""Candidates that are measured at once."""


def walkable(sheet: Sheet, method: Method) -> NDArray[np.bool_]:
    """Ink that walks may follow: all of it, or only what is thin enough for a leaf or an arc."""
    if method.thin_share == 0:
        return sheet.lines
    side = max(7, round(method.thin_share * sheet.long_side)) | 1  # odd, so that the square has a centre
    solid = cv2.morphologyEx(sheet.lines.astype(np.uint8), cv2.MORPH_OPEN, np.ones((side, side), np.uint8))
    return sheet.lines & ~solid.astype(bool)


def _as_doors(some: Shortlist, sheet: Sheet, method: Method) -> tuple[Door, ...]:
    """Doors in pixels of the drawing that came in."""
    symbols, quality = some.symbols, some.quality
    paired = meets_other_leaf(symbols, some.jambs, method.min_support)  # no wall ends the opening where two leaves meet
    kinds = np.where(symbols.has_arc, "arc", np.where(symbols.is_alone, "leaf", "straight"))
    found = []
    for k in range(len(kinds)):
        hinge, strike, tip = ((float(p[k, 0]), float(p[k, 1])) for p in (symbols.hinge, symbols.strike, symbols.tip))
        door = Door(hinge, strike, tip, kind=str(kinds[k]), quality=round(float(quality[k]), 4))
        level = tilts(symbols.hinge[k], symbols.strike[k]) <= method.max_tilt  # rows and columns measure no wing at an angle
        found.append(with_measured_jambs(door, sheet.walls) if method.measure_jambs and level and not paired[k] else door)
    return sheet.doors_to_input(found)
