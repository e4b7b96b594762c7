"""A map as what differs from its prior, in square tiles that are never written into: copies share what they have in common."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

TILE = 64
"""Cells along a tile's side: 3.2 m at 5 cm, the reach of a Kinect, so that a scan touches four to nine tiles."""

Place = tuple[int, int]
Window = tuple[slice, slice]


@dataclass(frozen=True, eq=False)
class TiledMap:
    """Log odds of the cells of a map. A change makes a new map, which shares all other tiles with the old one.

    Parameters
    ----------
    prior : (rows, cols) m_0, for all cells in no tile
    tiles : by row and column of the tile, the log odds of its cells; the last ones are cut at the rim

    >>> flat = TiledMap(np.zeros((100, 100)), {})
    >>> changed = flat.changed((slice(10, 12), slice(60, 70)), np.ones((2, 10)))
    >>> changed.whole().sum(), flat.whole().sum(), sorted(changed.tiles)
    (np.float64(20.0), np.float64(0.0), [(0, 0), (0, 1)])
    """

    prior: NDArray[np.float64]
    tiles: dict[Place, NDArray[np.float64]]

    def read(self, window: Window) -> NDArray[np.float64]:
        """A window of the map, an array of its own."""
        cells = self.prior[window].copy()
        for place, in_window, in_tile in _tiles_of(window):
            if place in self.tiles:
                cells[in_window] = self.tiles[place][in_tile]
        return cells

    def changed(self, window: Window, change: NDArray[np.float64]) -> TiledMap:
        """The map with numbers added in a window; only tiles in which one of them is not 0 are new."""
        tiles = dict(self.tiles)
        for place, in_window, in_tile in _tiles_of(window):
            if change[in_window].any():
                tile = tiles[place].copy() if place in tiles else self._prior_of(place)
                tile[in_tile] += change[in_window]
                tile.flags.writeable = False
                tiles[place] = tile
        return TiledMap(self.prior, tiles)

    def whole(self) -> NDArray[np.float64]:
        """(rows, cols) log odds of all cells, an array of its own."""
        return self.read((slice(0, self.prior.shape[0]), slice(0, self.prior.shape[1])))

    def _prior_of(self, place: Place) -> NDArray[np.float64]:
        """The cells of a tile as they were at first."""
        row, col = (TILE * index for index in place)
        return self.prior[row : row + TILE, col : col + TILE].copy()


def _tiles_of(window: Window) -> Iterator[tuple[Place, Window, Window]]:
    """The tiles that a window touches: which, where in the window, and where in the tile."""
    along_sides = [
        [(index, *_overlap(side, index * TILE)) for index in range(side.start // TILE, -(-side.stop // TILE))] for side in window
    ]
    for (row, row_in_window, row_in_tile), (col, col_in_window, col_in_tile) in product(*along_sides):
        yield (row, col), (row_in_window, col_in_window), (row_in_tile, col_in_tile)


def _overlap(side: slice, first: int) -> tuple[slice, slice]:
    """What a side of a window and a tile that begins at `first` have in common, as cells of the one and of the other."""
    start, stop = max(side.start, first), min(side.stop, first + TILE)
    return slice(start - side.start, stop - side.start), slice(start - first, stop - first)
