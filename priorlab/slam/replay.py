"""The map after any step of a drive, without a map per step: what blocks of steps changed is kept, and pasted in a row.

A milometer tells 1,234 by four wheels. In the same way the map after 1,234 steps is the first map, then what one block of 1,024
steps changed, three of 64, one of 16, and at last two single steps, drawn again. Only cells that were seen are kept, with the
values that they had at the end of the block, so a map comes back to the last bit.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from priorlab.slam.map_update import UNSEEN, SeenCells

STEPS_PER_BLOCK = 4
"""Steps in the smallest block, and blocks in the next larger one: at most three of a kind have to be pasted or drawn."""

Draw = Callable[[NDArray[np.float64], int], SeenCells]
"""Puts the scan of a step into a map, and says what was seen."""

Change = tuple[NDArray[np.int32], NDArray[np.float64]]
"""Cells, as numbers in the flat map, and their log odds at the end of a block."""


class Replay:
    """A drive whose maps can be had in any order.

    Parameters
    ----------
    first_map : (rows, cols) log odds before the first step
    draw : puts the scan of a step into a map
    n_steps : of the drive, which is driven once to make this

    Attributes
    ----------
    first_seen : (rows, cols) int32, the step that saw a cell first; `n_steps` where none did
    """

    def __init__(self, first_map: NDArray[np.float64], draw: Draw, n_steps: int) -> None:
        self._first_map, self._draw = first_map, draw
        self.first_seen = np.full(first_map.shape, n_steps, dtype=np.int32)
        seen_at, log_odds_map = self.first_seen.reshape(-1), first_map.copy()
        smallest, cells = [], []
        for k in range(n_steps):
            cells.append(_cells_of(draw(log_odds_map, k), first_map.shape[1]))
            seen_at[cells[-1]] = np.minimum(seen_at[cells[-1]], k)
            if len(cells) == STEPS_PER_BLOCK:
                together = np.unique(np.concatenate(cells))
                smallest.append((together, log_odds_map.reshape(-1)[together]))
                cells = []
        self._changes = [smallest]  # by size of the blocks: 4 steps, 16, 64, ...
        while len(self._changes[-1]) >= STEPS_PER_BLOCK:
            self._changes.append(_joined(self._changes[-1], log_odds_map.reshape(-1)))  # a map that nobody needs any more

    def after(self, n_steps: int) -> NDArray[np.float64]:
        """(rows, cols) log odds after so many steps, an array of its own."""
        log_odds_map = self._first_map.copy()
        flat, done = log_odds_map.reshape(-1), 0
        for size in reversed(range(len(self._changes))):
            steps = STEPS_PER_BLOCK ** (size + 1)
            while done + steps <= n_steps:
                cells, values = self._changes[size][done // steps]
                flat[cells] = values
                done += steps
        for k in range(done, n_steps):
            self._draw(log_odds_map, k)
        return log_odds_map

    @property
    def nbytes(self) -> int:
        """Memory of what is kept, beside the first map."""
        kept = sum(cells.nbytes + values.nbytes for changes in self._changes for cells, values in changes)
        return kept + self.first_seen.nbytes


def _cells_of(seen: SeenCells, width: int) -> NDArray[np.int32]:
    """The cells that a scan says something about, as numbers in the flat map."""
    rows, cols = np.nonzero(seen.labels != UNSEEN)
    return ((rows + seen.rows.start) * width + cols + seen.cols.start).astype(np.int32)


def _joined(changes: list[Change], scratch: NDArray[np.float64]) -> list[Change]:
    """Blocks four times as long: a cell keeps the value that it had last."""
    joined = []
    for first in range(0, len(changes) - STEPS_PER_BLOCK + 1, STEPS_PER_BLOCK):
        group = changes[first : first + STEPS_PER_BLOCK]
        for cells, values in group:
            scratch[cells] = values
        together = np.unique(np.concatenate([cells for cells, _ in group]))
        joined.append((together, scratch[together]))
    return joined
