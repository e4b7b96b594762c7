"""Doors: isosceles triangles of two connected sides and an open one (thesis 3.3.1, fig. 3.5).

The search walks over the connectivity graph: only wedges, two connected sides that meet, are candidates. That finds the same
triangles as the thesis's loop over all triples of corners, and a thousand corners take less than a second instead of a minute.
"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.drawing import Door, Drawing
from priorlab.drawing.candidates import DOOR, TESTS, DoorSearch, wedges
from priorlab.drawing.connectivity import connect
from priorlab.drawing.door_ink import scaled_doors
from priorlab.drawing.geometry import passes_geometry
from priorlab.drawing.jambs import with_measured_jambs
from priorlab.drawing.method import ROBUST, Method
from priorlab.drawing.outer_walls import extreme_corners
from priorlab.drawing.overlap import dark_share, without_overlap
from priorlab.drawing.preprocessing import Sheet, prepare
from priorlab.drawing.symbol import Symbols, is_box, read_symbols, supported

SURE_SUPPORT = 0.9
"""Share of wall ink beyond both jambs of a door without an arc."""

SLACK_SHARE = 0.001
"""Ink counts as on a line of a symbol within this share of M, and at least within a pixel."""

SURE_INK = 0.9
"""Share of ink along both sides of a door without an arc."""

FEWEST_FOR_A_MODE = 3
"""Doors that must agree on a size before others are dropped for theirs."""


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
    xy = points * sheet.scale
    longest = method.max_side_share * float(np.sqrt(sheet.lines.size))
    connected = connect(_walkable(sheet, method), xy, method.min_side / 2, longest * np.sqrt(2), method.reach)
    candidates = wedges(connected)
    reasons = np.full(len(candidates), DOOR, dtype=np.int8)

    ends_joined = connected[candidates[:, 1], candidates[:, 2]]
    _reject(reasons, "connectivity", np.arange(len(candidates)), ~ends_joined)  # exactly two sides connected

    alive = np.flatnonzero(reasons == DOOR)
    open_side = np.hypot(*(xy[candidates[alive, 1]] - xy[candidates[alive, 2]]).T)
    shaped = (open_side >= method.min_side) & (open_side <= longest)
    shaped[shaped] = passes_geometry(xy[candidates[alive[shaped]]], method)
    _reject(reasons, "geometry", alive, shaped)

    alive = np.flatnonzero(reasons == DOOR)
    across = np.abs(xy[candidates[alive, 1]] - xy[candidates[alive, 2]])
    tilt = np.degrees(np.arctan2(across.min(axis=1), across.max(axis=1)))
    _reject(reasons, "orientation", alive, (tilt <= method.max_tilt) & (across[:, 0] != across[:, 1]))  # eq. 3.15

    alive = np.flatnonzero(reasons == DOOR)
    slack = 2 * max(1, round(SLACK_SHARE * sheet.long_side)) + 1  # corners lie a little beside the ink
    widened = cv2.dilate(sheet.lines.astype(np.uint8), np.ones((slack, slack), np.uint8)).astype(bool)
    symbols = read_symbols(widened, sheet.walls, xy[candidates[alive]])
    looks = (symbols.leaf >= method.min_leaf) & (symbols.swing >= method.min_arc) & _leaf_fits(symbols, method)
    if method.min_leaf > 0:
        looks &= symbols.has_arc | ~is_box(widened, symbols)
    _reject(reasons, "symbol", alive, looks)
    _reject(reasons, "open side", alive, symbols.open_ink <= method.max_open_ink)
    _reject(reasons, "jamb support", alive, _at_walls(symbols, looks & (symbols.open_ink <= method.max_open_ink), method))

    symbols, alive = _still(symbols, alive, reasons)
    dark = np.array([dark_share(sheet.lines, xy[candidates[k]]) for k in alive])
    _reject(reasons, "dark share", alive, dark < method.max_dark)

    symbols, alive = _still(symbols, alive, reasons)
    if method.keep_best:
        order = np.argsort(-symbols.quality, kind="stable")
        symbols, alive = symbols[order], alive[order]
    _reject(reasons, "overlap", alive, without_overlap(xy[candidates[alive]], method.max_overlap))

    symbols, alive = _still(symbols, alive, reasons)
    _reject(reasons, "size mode", alive, _near_mode(symbols, method.size_mode_factor))

    symbols, alive = _still(symbols, alive, reasons)
    if method.one_kind:
        arcs = symbols.has_arc
        _reject(reasons, "kind", alive, arcs | (arcs.sum() < FEWEST_FOR_A_MODE))

    symbols, alive = _still(symbols, alive, reasons)
    if method.drop_on_outer_walls and alive.size:
        _reject(reasons, "outer walls", alive, ~_on_outer_wall(xy[candidates[alive]], xy, method.outer_tolerance))
        symbols, alive = _still(symbols, alive, reasons)

    return DoorSearch(
        corners=points,
        edges=np.argwhere(np.triu(connected)),
        candidates=candidates,
        reasons=reasons,
        doors=_as_doors(symbols, sheet, method),
    )


def _walkable(sheet: Sheet, method: Method) -> NDArray[np.bool_]:
    """Ink that walks may follow: all of it, or only what is thin enough for a leaf or an arc."""
    if method.thin_share == 0:
        return sheet.lines
    side = max(7, round(method.thin_share * sheet.long_side)) | 1  # odd, so that the square has a centre
    solid = cv2.morphologyEx(sheet.lines.astype(np.uint8), cv2.MORPH_OPEN, np.ones((side, side), np.uint8))
    return sheet.lines & ~solid.astype(bool)


def _leaf_fits(symbols: Symbols, method: Method) -> NDArray[np.bool_]:
    """Where the leaf is as long as the opening it closes; asked only by methods that look at the leaf."""
    return symbols.equal > method.isosceles_ratio - 0.1 if method.min_leaf > 0 else np.ones(len(symbols.equal), dtype=bool)


def _at_walls(symbols: Symbols, alive: NDArray[np.bool_], method: Method) -> NDArray[np.bool_]:
    """Where the jambs are at walls, among the candidates still alive; straight doors need a surer wall than arcs."""
    passed = np.zeros(len(alive), dtype=bool)
    some = np.flatnonzero(alive)
    left = symbols[some]
    passed[some] = supported(left, method.min_support)
    if method.min_support > 0:
        sure = (left.support >= SURE_SUPPORT) & (left.leaf >= SURE_INK) & (left.chord >= SURE_INK) & (left.open_ink < 0.1)
        passed[some] &= left.has_arc | sure
    return passed


def _reject(reasons: NDArray[np.int8], test: str, alive: NDArray[np.int64], passed: NDArray[np.bool_]) -> None:
    """Write the name of a test onto the candidates that fail it and failed none before."""
    failed = alive[~np.asarray(passed, dtype=bool)]
    reasons[failed[reasons[failed] == DOOR]] = TESTS.index(test)


def _still(symbols: Symbols, alive: NDArray[np.int64], reasons: NDArray[np.int8]) -> tuple[Symbols, NDArray[np.int64]]:
    """What is left of the candidates after a test."""
    keep = reasons[alive] == DOOR
    return symbols[keep], alive[keep]


def _near_mode(symbols: Symbols, factor: float | None) -> NDArray[np.bool_]:
    """Where the open side lies within a factor of the commonest length; everywhere when fewer than three agree."""
    widths = symbols.width
    if factor is None or len(widths) == 0:
        return np.ones(len(widths), dtype=bool)
    close = np.maximum(widths[:, None], widths[None, :]) <= np.sqrt(factor) * np.minimum(widths[:, None], widths[None, :])
    votes = close @ symbols.quality
    mode = widths[votes.argmax()]
    if close[votes.argmax()].sum() < FEWEST_FOR_A_MODE:
        return np.ones(len(widths), dtype=bool)
    straight = ~symbols.has_arc  # these are easily mistaken: they must agree more closely
    allowed = np.where(straight, np.sqrt(factor), factor)
    return np.asarray(np.maximum(widths, mode) <= allowed * np.minimum(widths, mode))


def _on_outer_wall(triangles: NDArray[np.float64], corners: NDArray[np.float64], tolerance: float) -> NDArray[np.bool_]:
    """Where a vertex lies on a line through the extreme corners, eq. 3.11."""
    x_min, x_max, y_min, y_max = extreme_corners(corners)
    x, y = triangles[..., 0], triangles[..., 1]
    on = np.minimum(np.abs(x - x_min), np.abs(x - x_max)) <= tolerance
    on |= np.minimum(np.abs(y - y_min), np.abs(y - y_max)) <= tolerance
    return np.asarray(on.any(axis=1))


def _as_doors(symbols: Symbols, sheet: Sheet, method: Method) -> tuple[Door, ...]:
    """Doors in pixels of the drawing that came in."""
    kinds = np.where(symbols.has_arc, "arc", "straight")
    found = []
    for k in range(len(kinds)):
        hinge, strike, tip = ((float(p[k, 0]), float(p[k, 1])) for p in (symbols.hinge, symbols.strike, symbols.tip))
        door = Door(hinge, strike, tip, kind=str(kinds[k]), quality=round(float(symbols.quality[k]), 4))
        found.append(with_measured_jambs(door, sheet.walls) if method.measure_jambs else door)
    return scaled_doors(found, 1 / sheet.scale)
