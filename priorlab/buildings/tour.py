"""A tour: a path that a robot can drive through every room, along the tree of shortest paths from where it starts."""

from __future__ import annotations

import heapq
import math

import cv2
import numpy as np
from numpy.typing import NDArray

CLEARANCE_M = 0.22
"""The path stays so far from every obstacle, metres."""

STRAIGHT_M = 0.4
"""Straightened pieces stay so far from obstacles, or as far as the searched path did where it is narrower, metres."""

STEP_M = 0.1
"""Side of the cells that the path is searched on, metres."""

WISHED_M = 0.5
"""Nearer to an obstacle than this, a step costs more: the path keeps to the middle of corridors and doorways."""

Cell = tuple[int, int]


class Passable:
    """Where a robot may be: cells that are far enough from every obstacle, and what a step to them costs."""

    def __init__(self, obstacles: NDArray[np.bool_], metres_per_pixel: float) -> None:
        self.scale, self.height = metres_per_pixel, obstacles.shape[0]
        distance = cv2.distanceTransform((~obstacles).view(np.uint8), cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
        self.clearance_m = (distance - 0.5) * metres_per_pixel
        self.step = max(1, round(STEP_M / metres_per_pixel))  # pixels
        at_cells = self.clearance_m[self.step // 2 :: self.step, self.step // 2 :: self.step]
        self.free = at_cells >= CLEARANCE_M
        self.cost = 1.0 + 4.0 * np.maximum(0.0, 1.0 - at_cells / WISHED_M)

    def cell_of(self, x: float, y: float) -> Cell:
        """The cell (row, col) of a pixel position, y down."""
        return int(y) // self.step, int(x) // self.step

    def room_m(self, cell: Cell) -> float:
        """How far the middle of a cell is from the nearest obstacle, metres."""
        row, col = (index * self.step + self.step // 2 for index in cell)
        return float(self.clearance_m[row, col])

    def xy_m(self, cell: Cell) -> tuple[float, float]:
        """The middle of a cell's sampled pixel in metres, y up."""
        row, col = (index * self.step + self.step // 2 + 0.5 for index in cell)
        return col * self.scale, (self.height - row) * self.scale

    def sees(self, start: Cell, end: Cell, keep_m: float) -> bool:
        """Does the straight line between two cells keep so far from every obstacle?"""
        (x0, y0), (x1, y1) = self.xy_m(start), self.xy_m(end)
        n = max(2, math.ceil(2 * math.hypot(x1 - x0, y1 - y0) / self.scale))
        cols = np.linspace(x0, x1, n) / self.scale
        rows = self.height - np.linspace(y0, y1, n) / self.scale
        return bool((self.clearance_m[rows.astype(int), cols.astype(int)] >= keep_m).all())


def tour_of(
    start: tuple[float, float],
    stops: list[tuple[str, tuple[float, float]]],
    obstacles: NDArray[np.bool_],
    metres_per_pixel: float,
    share: float = 1.0,
) -> NDArray[np.float64]:
    """A path from `start` to all stops, going back no further than it must in between.

    Parameters
    ----------
    start : x, y, pixels, y DOWN
    stops : name and x, y of each place to visit
    obstacles : (height, width) True where no robot can go: the world, and outdoors
    metres_per_pixel : scale
    share : of the stops that are visited, in the tour's order; 1 = a complete tour

    Returns
    -------
    (M, 2) corners x, y in metres, y up

    Raises
    ------
    ValueError
        When a stop cannot be reached with `CLEARANCE_M` to every obstacle.
    """
    if not 0 < share <= 1:
        raise ValueError(f"tour_share must lie above 0 and up to 1, got {share:g}")
    ground = Passable(obstacles, metres_per_pixel)
    root = nearest_free(ground, ground.cell_of(*start), ground.free)
    came_from, travelled = _shortest_paths(ground, root)
    reached = np.isfinite(travelled)
    branches = []
    for name, (x, y) in stops:
        wanted = ground.cell_of(x, y)
        cell = nearest_free(ground, wanted, reached)
        if math.dist(cell, wanted) * STEP_M > 1.5:
            raise ValueError(f"room {name!r} must be reachable with {CLEARANCE_M} m to every obstacle, but no path leads there")
        branches.append(_branch(came_from, cell))
    branches = _in_order(branches)
    branches = branches[: max(1, math.ceil(share * len(branches)))]
    return np.array([ground.xy_m(cell) for cell in _walk(ground, root, branches)])


def nearest_free(ground: Passable, cell: Cell, free: NDArray[np.bool_]) -> Cell:
    """The cell of a mask that lies nearest to a cell."""
    rows, cols = np.nonzero(free)
    if not len(rows):
        raise ValueError(f"the world must leave {CLEARANCE_M} m round a robot somewhere, but nowhere does it")
    nearest = int(np.argmin((rows - cell[0]) ** 2 + (cols - cell[1]) ** 2))
    return int(rows[nearest]), int(cols[nearest])


def _shortest_paths(ground: Passable, root: Cell) -> tuple[dict[Cell, Cell], NDArray[np.float64]]:
    """Dijkstra's tree from the root over eight neighbours: where each cell is reached from, and at what cost."""
    steps = [(dr, dc, math.hypot(dr, dc)) for dr in (-1, 0, 1) for dc in (-1, 0, 1) if dr or dc]
    free, cost = np.pad(ground.free, 1).tolist(), np.pad(ground.cost, 1).tolist()  # lists: five times faster than arrays here
    travelled = {root: 0.0}
    came_from: dict[Cell, Cell] = {}
    done: set[Cell] = set()
    queue = [(0.0, root)]
    while queue:
        so_far, cell = heapq.heappop(queue)
        if cell in done:
            continue
        done.add(cell)
        for dr, dc, length in steps:
            row, col = cell[0] + dr, cell[1] + dc
            if not free[row + 1][col + 1]:
                continue
            total = so_far + length * cost[row + 1][col + 1]
            if total < travelled.get((row, col), math.inf) - 1e-12:
                travelled[row, col] = total
                came_from[row, col] = cell
                heapq.heappush(queue, (total, (row, col)))
    reached = np.full(ground.free.shape, np.inf)
    for cell in done:
        reached[cell] = travelled[cell]
    return came_from, reached


def _branch(came_from: dict[Cell, Cell], cell: Cell) -> list[Cell]:
    """The cells from the root to a cell."""
    branch = [cell]
    while branch[-1] in came_from:
        branch.append(came_from[branch[-1]])
    return branch[::-1]


def _in_order(branches: list[list[Cell]]) -> list[list[Cell]]:
    """Branches so that those that part late follow one another, near ones before far ones (a walk round the tree)."""
    if len(branches) < 2:
        return branches
    depth = 0
    while all(len(branch) > depth for branch in branches) and len({branch[depth] for branch in branches}) == 1:
        depth += 1
    groups: dict[Cell | None, list[list[Cell]]] = {}
    for branch in branches:
        groups.setdefault(branch[depth] if len(branch) > depth else None, []).append(branch)
    if len(groups) == 1:
        return branches
    ordered = sorted(groups.values(), key=lambda group: max(len(branch) for branch in group))
    return [branch for group in ordered for branch in _in_order(group)]


def _walk(ground: Passable, root: Cell, branches: list[list[Cell]]) -> list[Cell]:
    """The tour's corners: from stop to stop over where their branches part, straightened wherever the way is free."""
    corners, before = [root], [root]
    for branch in branches:
        shared = 0
        while shared < min(len(before), len(branch)) and before[shared] == branch[shared]:
            shared += 1
        leg = before[max(shared - 1, 0) :][::-1] + branch[shared:]
        corners += _straightened(ground, leg)[1:]
        before = branch
    return corners


def _straightened(ground: Passable, leg: list[Cell]) -> list[Cell]:
    """Fewer corners: each is followed by the farthest cell that it sees without coming nearer to obstacles than need be."""
    corners, at = [leg[0]], 0
    while at < len(leg) - 1:
        ahead = at + 1
        keep_m = min(STRAIGHT_M, ground.room_m(leg[at]), ground.room_m(leg[ahead]))
        while ahead + 1 < len(leg):
            keep_m = min(keep_m, ground.room_m(leg[ahead + 1]))
            if not ground.sees(leg[at], leg[ahead + 1], keep_m):
                break
            ahead += 1
        corners.append(leg[ahead])
        at = ahead
    return corners
