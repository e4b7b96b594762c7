"""Shortest ways over a coarse net of points in the free space, and a round through many places."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components, dijkstra

DETOUR = 10.0
"""A way that leaves what it should follow counts so many times as long."""

Place = tuple[int, int]
"""A pixel (row, col)."""


class Roads:
    """Points every `step` pixels of the drivable space, each joined to the eight next ones when the way between is drivable.

    Parameters
    ----------
    drivable : (height, width) bool
    distance : (height, width) pixels to the nearest wall; the way along a wall counts longer than the way through the middle
    step : pixels between points
    preferred : (height, width) bool, where the robot should drive if it can; elsewhere a way counts `DETOUR` times as long
    """

    def __init__(
        self,
        drivable: NDArray[np.bool_],
        distance: NDArray[np.float32],
        step: int,
        preferred: NDArray[np.bool_] | None = None,
    ) -> None:
        self.drivable, self.preferred = drivable, drivable if preferred is None else drivable & preferred
        rows, cols = np.nonzero(drivable[::step, ::step])
        self.points = np.column_stack([rows, cols]) * step
        number = np.full(drivable[::step, ::step].shape, -1)
        number[rows, cols] = np.arange(len(rows))
        padded = np.pad(number, ((0, 1), (1, 1)), constant_values=-1)
        dear = 1.0 + step / np.maximum(distance[tuple(self.points.T)], 1e-3)
        dear[~self.preferred[tuple(self.points.T)]] *= DETOUR
        starts, ends, lengths = [], [], []
        for down, right in ((0, 1), (1, 0), (1, 1), (1, -1)):
            end = padded[rows + down, cols + 1 + right]
            start = np.flatnonzero(end >= 0)
            end = end[start]
            open_way = _way_is_free(drivable, self.points[start], self.points[end], 2 * step)
            start, end = start[open_way], end[open_way]
            starts.append(start)
            ends.append(end)
            lengths.append(step * np.hypot(down, right) * (dear[start] + dear[end]) / 2)
        edges = (np.concatenate(starts), np.concatenate(ends))
        self.net = coo_array((np.concatenate(lengths), edges), shape=(len(rows), len(rows))).tocsr()

    @cached_property
    def in_largest_part(self) -> NDArray[np.bool_]:
        """(N,) bool, which points hang together with most others."""
        _, part_of = connected_components(self.net, directed=False)
        return np.asarray(part_of == np.bincount(part_of, minlength=1).argmax())

    def nearest(self, place: Place) -> int:
        """The point next to a place."""
        return int(((self.points - place) ** 2).sum(axis=1).argmin())

    def in_sight(self, start: Place, end: Place) -> bool:
        """True when the straight way between two places is drivable, and preferred, all along."""
        way = max(abs(end[0] - start[0]), abs(end[1] - start[1]))
        return bool(_way_is_free(self.preferred, np.array([start]), np.array([end]), 2 * way + 1)[0])


def shortest_round(roads: Roads, places: Sequence[Place]) -> NDArray[np.int64]:
    """Corners (row, col) of a way through all places in the largest part of the net, in an order that keeps it short."""
    reached = roads.in_largest_part
    stops = np.unique([point for point in map(roads.nearest, places) if reached[point]])
    if stops.size == 0:  # no room's middle lies there: begin anywhere in it
        stops = np.flatnonzero(reached)[:1]
    lengths, before = dijkstra(roads.net, directed=False, indices=stops, return_predecessors=True)
    order = _short_order(lengths[:, stops])
    corners = [_place(roads.points[stops[order[0]]])]
    for here, there in zip(order[:-1], order[1:], strict=True):
        leg = _way_back(before[here], stops[there])[::-1]
        corners += _straighten(roads, [_place(point) for point in roads.points[leg]])[1:]
    return np.array(corners)


def _short_order(lengths: NDArray[np.float64]) -> list[int]:
    """An open round: always the nearest stop next, then stretches are turned round while that makes it shorter."""
    order = [0]
    while len(order) < len(lengths):
        left = np.setdiff1d(np.arange(len(lengths)), order)
        order.append(int(left[lengths[order[-1], left].argmin()]))
    better = True
    while better:
        better = False
        for i in range(1, len(order) - 1):
            for j in range(i + 1, len(order)):
                turned = order[:i] + order[i : j + 1][::-1] + order[j + 1 :]
                if _length(lengths, turned) < _length(lengths, order) - 1e-9:
                    order, better = turned, True
    return order


def _length(lengths: NDArray[np.float64], order: list[int]) -> float:
    """How long a round is."""
    return float(lengths[order[:-1], order[1:]].sum())


def _way_back(before: NDArray[np.int32], end: int) -> list[int]:
    """The points from `end` back to where the search began."""
    way = [int(end)]
    while before[way[-1]] >= 0:
        way.append(int(before[way[-1]]))
    return way


def _straighten(roads: Roads, way: list[Place]) -> list[Place]:
    """The way with only those corners that are needed to see from each to the next."""
    corners, last = [way[0]], 0
    while last < len(way) - 1:
        ahead = last + 1
        while ahead + 1 < len(way) and roads.in_sight(way[last], way[ahead + 1]):
            ahead += 1
        corners.append(way[ahead])
        last = ahead
    return corners


def _way_is_free(drivable: NDArray[np.bool_], start: NDArray, end: NDArray, n_samples: int) -> NDArray[np.bool_]:
    """For (N, 2) starts and ends (row, col): is every pixel along the straight way drivable?"""
    free = np.ones(len(start), dtype=bool)
    for share in np.linspace(0.0, 1.0, n_samples + 1):
        row, col = np.rint(start + share * (end - start)).astype(np.int64).T
        free &= drivable[row, col]
    return free


def _place(point: NDArray) -> Place:
    """A point of the net as plain numbers."""
    return int(point[0]), int(point[1])
