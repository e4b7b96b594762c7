"""The true Pareto front and the true optima over every prior, from the pieces of both classes.

Pixels detected are a sum: those of wall cells, which p_wall decides, and those of space cells, which p_space decides.
Whatever is beaten within its class is beaten in every sum, so only the undominated pieces of each class are paired.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from priorlab.core.measures import Measure, f_beta_of, share
from priorlab.optimize.front import Front, non_dominated
from priorlab.optimize.plateaus import Pieces, Plateau

_PAIRS = 4_000_000
"""Pairs weighed at a time, so that a very large drawing stays in memory."""


@dataclass(frozen=True)
class Best:
    """The highest value of a measure and all the priors that reach it: an optimum is a plateau, not a point.

    Parameters
    ----------
    measure : its name
    value : what it reaches; 0 when no prior detects a true wall
    plateaus : where, the largest first; none when the value is 0
    """

    measure: str
    value: float
    plateaus: tuple[Plateau, ...]

    def __repr__(self) -> str:
        if not self.plateaus:
            return f"Best({self.measure}: no prior detects a true wall)"
        more = f" and {len(self.plateaus) - 1} more" if len(self.plateaus) > 1 else ""
        return f"Best({self.measure} {self.value:.4f} at {self.plateaus[0]!r}{more})"


def best_priors(wall: Pieces, space: Pieces, positives: int, measure: Measure, beta: float) -> Best:
    """The optimum of one measure over all pairs of pieces."""
    wall, space = _contenders(wall, space, measure)
    tp, fp = np.add.outer(wall.tp, space.tp), np.add.outer(wall.fp, space.fp)
    if measure == "recall":
        value = share(tp, positives)
    elif measure == "precision":
        value = share(tp, tp + fp)
    else:
        value = f_beta_of(tp, fp, positives, beta)
    if not tp.any():
        return Best(measure, 0.0, ())
    highest = float(np.nanmax(value))
    return Best(measure, highest, _plateaus(wall, space, np.argwhere(value == highest)))


def _contenders(wall: Pieces, space: Pieces, measure: Measure) -> tuple[Pieces, Pieces]:
    """The pieces that an optimum can be made of, joined where they differ in nothing that the measure looks at."""
    if measure == "recall":  # only true pixels count
        wall, space = (pieces.counting(pieces.tp, np.zeros_like(pieces.fp)) for pieces in (wall, space))
    elif measure == "precision" and _can_be_pure(wall, space):  # any number of true pixels is as good as another
        wall, space = (pieces.counting(1 * (pieces.tp > 0), 1 * (pieces.fp > 0)) for pieces in (wall, space))
        return wall.chosen(wall.fp == 0), space.chosen(space.fp == 0)
    return wall.undominated(), space.undominated()  # more true or fewer false pixels are strictly better


def _can_be_pure(wall: Pieces, space: Pieces) -> bool:
    """True when some prior detects true walls and nothing else."""
    if not ((wall.fp == 0).any() and (space.fp == 0).any()):
        return False
    return bool(wall.tp[wall.fp == 0].any() or space.tp[space.fp == 0].any())


def exact_front(wall: Pieces, space: Pieces, positives: int, floor: float) -> Front:
    """The Pareto front of precision and recall over all pairs of pieces, both above `floor`."""
    wall, space = wall.undominated(), space.undominated()
    block = max(1, _PAIRS // len(space))
    found = [_block_front(wall, space, slice(start, start + block), positives, floor) for start in range(0, len(wall), block)]
    pairs, precision, recall = (np.concatenate(parts) for parts in zip(*found, strict=True))
    kept = non_dominated(precision, recall)
    if not kept.size:
        nothing = np.empty(0)
        return Front(nothing, nothing, nothing, nothing, "exact", _why_empty(wall, space, positives, floor))
    pairs, precision, recall = pairs[kept], precision[kept], recall[kept]
    starts = np.flatnonzero(np.diff(precision, prepend=np.inf) != 0)  # sorted: equal objectives stand together
    ranges = tuple(_plateaus(wall, space, group) for group in np.split(pairs, starts[1:]))
    middles = np.array([(plateaus[0].p_wall.middle, plateaus[0].p_space.middle) for plateaus in ranges])
    return Front(middles[:, 0], middles[:, 1], precision[starts], recall[starts], name="exact", ranges=ranges)


def _block_front(
    wall: Pieces, space: Pieces, rows: slice, positives: int, floor: float
) -> tuple[NDArray[np.int64], NDArray[np.float64], NDArray[np.float64]]:
    """Pairs (i, j) of pieces that none of the block beats, with their precision and recall."""
    tp = np.add.outer(wall.tp[rows], space.tp)
    fp = np.add.outer(wall.fp[rows], space.fp)
    precision, recall = share(tp, tp + fp), share(tp, positives)
    row, col = np.nonzero((precision > floor) & (recall > floor))
    precision, recall = precision[row, col], recall[row, col]
    kept = non_dominated(precision, recall)
    return np.column_stack([row[kept] + rows.start, col[kept]]), precision[kept], recall[kept]


def _why_empty(wall: Pieces, space: Pieces, positives: int, floor: float) -> str:
    """How close the best prior comes."""
    pairs, precision, recall = _block_front(wall, space, slice(0, None), positives, 0.0)
    wanted = f"no prior has precision and recall above {100 * floor:g} % (eq. 4.19)"
    if not len(pairs):
        return f"{wanted}: none detects a true wall"
    nearest = int(np.argmax(np.minimum(precision, recall)))
    return f"{wanted}: the nearest has {100 * precision[nearest]:.1f} and {100 * recall[nearest]:.1f} %"


def _plateaus(wall: Pieces, space: Pieces, pairs: NDArray[np.int64]) -> tuple[Plateau, ...]:
    """The plateaus of pairs (i, j) of pieces, the largest first."""
    plateaus = [Plateau(wall.range(i), space.range(j)) for i, j in pairs.tolist()]
    return tuple(sorted(plateaus, key=lambda one: -one.p_wall.width * one.p_space.width))
