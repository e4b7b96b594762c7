"""A Pareto front: priors of which none is beaten in precision and recall at once (thesis 4.4, fig. 4.2 and 4.7)."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.checks import check_number
from priorlab.optimize.plateaus import Plateau

BOUNDS = (0.1, 1.0)
"""Eq. 4.19: p_wall and p_space, before the factor 0.9."""

FLOOR = 0.4
"""Eq. 4.19: 1/precision and 1/recall below 2.5, so both above 40 %."""


def bounds_for(factor: float) -> tuple[float, float]:
    """Eq. 4.19's bounds for priors with another factor.

    They are (0.1, 1) as long as a factor keeps 1 below certainty; with a factor of 1 or more they are those that give the same
    effective priors as the thesis's, 0.09 to 0.9.

    >>> bounds_for(0.9), bounds_for(1.0)
    ((0.1, 1.0), (0.09, 0.9))
    """
    if factor < 1:
        return BOUNDS
    return round(0.9 * BOUNDS[0] / factor, 12), round(0.9 * BOUNDS[1] / factor, 12)


def check_floor(floor: float) -> float:
    """The floor of precision and recall, or a sentence when it is none."""
    floor = check_number("floor", floor)
    if not 0 <= floor < 1:
        raise ValueError(f"floor must lie in [0, 1), got {floor:g}")
    return floor


@dataclass(frozen=True, eq=False)
class Front:
    """Priors and what they reach, from the highest precision to the highest recall.

    Parameters
    ----------
    p_wall, p_space : (N,) P(empty) before the factor; one pair for each pair of objectives
    precision, recall : (N,)
    name : "exact" or how it was searched
    note : a sentence when the front is empty, else ""
    ranges : for each point all its plateaus, when they are known: the pair above is the middle of the largest
    overruled : (N,) True where the prior breaks eq. 2.22 with the sensor (`overruled_readings`); None when nobody asked
    """

    p_wall: NDArray[np.float64]
    p_space: NDArray[np.float64]
    precision: NDArray[np.float64]
    recall: NDArray[np.float64]
    name: str = "front"
    note: str = ""
    ranges: tuple[tuple[Plateau, ...], ...] = field(default=(), repr=False)
    overruled: NDArray[np.bool_] | None = field(default=None, repr=False)

    def __len__(self) -> int:
        return len(self.p_wall)

    @property
    def priors(self) -> NDArray[np.float64]:
        """(N, 2) pairs p_wall, p_space."""
        return np.column_stack([self.p_wall, self.p_space])

    @property
    def hypervolume(self) -> float:
        """The area of (precision, recall) that the front dominates, from (0, 0); 0 when it is empty."""
        return hypervolume(self.precision, self.recall)

    def __repr__(self) -> str:
        if not len(self):
            return f"Front({self.name}: empty; {self.note})"
        priors = "1 prior" if len(self) == 1 else f"{len(self)} priors"
        return (
            f"Front({self.name}: {priors}, precision {self.precision.min():.3f} to {self.precision.max():.3f}, "
            f"recall {self.recall.min():.3f} to {self.recall.max():.3f}, hypervolume {self.hypervolume:.4f})"
        )

    def _repr_html_(self) -> str:
        if not len(self):
            return f"<p>{self.name} front: empty; {self.note}</p>"
        names = ("p_wall", "p_space", "precision", "recall")
        known = self.overruled is not None
        head = "".join(f"<th scope='col'>{name}</th>" for name in (*names, *(["eq. 2.22"] if known else [])))
        shown = np.unique(np.linspace(0, len(self) - 1, min(len(self), 12)).round().astype(int))
        cells = [[f"{getattr(self, name)[i]:.3f}" for name in names] for i in shown]
        if self.overruled is not None:
            cells = [[*row, "broken" if self.overruled[i] else "kept"] for row, i in zip(cells, shown, strict=True)]
        rows = "".join("<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in cells)
        caption = f"{self.name} front: {len(shown)} of {len(self)} priors, hypervolume {self.hypervolume:.4f}"
        return f"<table><caption>{caption}</caption><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>"


def non_dominated(precision: ArrayLike, recall: ArrayLike) -> NDArray[np.int64]:
    """Which points no other dominates: at least as good in both and better in one (thesis 4.4).

    Equal points stay together. The answer is sorted from the highest precision to the highest recall.

    >>> non_dominated([0.9, 0.5, 0.5, 0.4], [0.2, 0.6, 0.5, 0.6]).tolist()
    [0, 1]
    """
    precision, recall = np.asarray(precision, dtype=np.float64), np.asarray(recall, dtype=np.float64)
    order = np.lexsort((-recall, -precision))
    if not order.size:
        return order
    best, best_of = recall[order], precision[order]
    leads = best > np.maximum.accumulate(np.concatenate([[-np.inf], best[:-1]]))
    leader = np.maximum.accumulate(np.where(leads, np.arange(len(order)), 0))
    return order[(best == best[leader]) & (best_of == best_of[leader])]


def hypervolume(precision: ArrayLike, recall: ArrayLike) -> float:
    """Area of the union of the rectangles from (0, 0) to each (precision, recall).

    >>> hypervolume([0.5, 1.0], [1.0, 0.5])
    0.75
    """
    precision, recall = np.asarray(precision, dtype=np.float64), np.asarray(recall, dtype=np.float64)
    order = np.argsort(-precision)
    highest = np.maximum.accumulate(recall[order]) if order.size else recall
    return float((precision[order] * np.diff(highest, prepend=0.0)).sum())
