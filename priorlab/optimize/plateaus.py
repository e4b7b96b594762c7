"""Between two critical values nothing changes: ranges of priors that give one and the same map score."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from priorlab.core.log_odds import log_odds, probability
from priorlab.optimize.steps import NOISE, Steps


@dataclass(frozen=True)
class Range:
    """Values from `low` to `high`, each end in it or not; P(empty) before the factor.

    >>> Range(0.1, 0.25, includes_high=False)
    [0.1, 0.25)
    >>> 0.25 in Range(0.1, 0.25, includes_high=False)
    False
    """

    low: float
    high: float
    includes_low: bool = True
    includes_high: bool = True

    def __contains__(self, p: float) -> bool:
        above = p >= self.low if self.includes_low else p > self.low
        below = p <= self.high if self.includes_high else p < self.high
        return above and below

    @property
    def middle(self) -> float:
        """A value well inside."""
        return (self.low + self.high) / 2

    @property
    def width(self) -> float:
        """From end to end."""
        return self.high - self.low

    @property
    def is_point(self) -> bool:
        """True when both ends are the same to four digits: a tie, one value on the edge of a cliff."""
        return f"{self.low:.4g}" == f"{self.high:.4g}"

    def __repr__(self) -> str:
        if self.is_point:
            return f"{self.low:.4g}"
        return f"{'[' if self.includes_low else '('}{self.low:.4g}, {self.high:.4g}{']' if self.includes_high else ')'}"


@dataclass(frozen=True)
class Plateau:
    """All pairs of a range of p_wall and a range of p_space: they reach the same value of what was asked for."""

    p_wall: Range
    p_space: Range

    def __repr__(self) -> str:
        ranges = {"p_wall": self.p_wall, "p_space": self.p_space}
        return ", ".join(f"{name} {'=' if r.is_point else 'in'} {r!r}" for name, r in ranges.items())


@dataclass(frozen=True, eq=False)
class Pieces:
    """The ranges between which a class's counts change, in order, and its counts on each.

    Parameters
    ----------
    tp, fp : (N,) true and false pixels detected on each piece
    edges : (E,) values of P(empty), before the factor, at which pieces may end
    first, last : (N,) a piece's ends: 2 i is the value edges[i] itself, 2 i + 1 the open range after it
    """

    tp: NDArray[np.int64]
    fp: NDArray[np.int64]
    edges: NDArray[np.float64]
    first: NDArray[np.int64]
    last: NDArray[np.int64]

    def __len__(self) -> int:
        return len(self.tp)

    def range(self, piece: int) -> Range:
        """Where a piece lies."""
        first, last = int(self.first[piece]), int(self.last[piece])
        return Range(
            low=float(self.edges[first // 2]),
            high=float(self.edges[(last + 1) // 2]),
            includes_low=first % 2 == 0,
            includes_high=last % 2 == 0,
        )

    def counting(self, tp: NDArray[np.int64], fp: NDArray[np.int64]) -> Pieces:
        """The same ranges with other counts; neighbours that now count the same are joined."""
        starts = np.flatnonzero(np.diff(tp, prepend=tp[0] - 1).astype(bool) | np.diff(fp, prepend=fp[0] - 1).astype(bool))
        ends = np.append(starts[1:], len(tp)) - 1
        return Pieces(tp[starts], fp[starts], self.edges, self.first[starts], self.last[ends])

    def chosen(self, which: NDArray) -> Pieces:
        """Some of the pieces."""
        return Pieces(self.tp[which], self.fp[which], self.edges, self.first[which], self.last[which])

    def undominated(self) -> Pieces:
        """The pieces that no other beats: none detects more true pixels with no more false ones, or as many with fewer."""
        order = np.lexsort((-self.tp, self.fp))
        tp, fp = self.tp[order], self.fp[order]
        most_before = np.maximum.accumulate(np.concatenate([[-1], tp[:-1]]))
        better = tp > most_before
        leader = np.maximum.accumulate(np.where(better, np.arange(len(tp)), -1))  # equals of the last that was better stay
        return self.chosen(order[(tp == tp[leader]) & (fp == fp[leader])])


def pieces_of(steps: Steps, bounds: tuple[float, float], factor: float) -> Pieces:
    """Cut the range of a class's prior at its critical values; counts are exact on every piece.

    Parameters
    ----------
    steps : the class
    bounds : lowest and highest P(empty), before the factor
    factor : of the prior
    """
    low, high = log_odds(np.array(bounds) * factor)
    inside = steps.breaks[(steps.breaks > low + NOISE) & (steps.breaks < high - NOISE)]
    edges = np.concatenate([[low], inside, [high]])
    places = np.empty(2 * len(edges) - 1)
    places[0::2] = edges
    places[1::2] = (edges[:-1] + edges[1:]) / 2
    edges_p = probability(edges) / factor
    edges_p[[0, -1]] = bounds
    tp, fp = steps.counts(places)
    everywhere = np.arange(len(places))
    return Pieces(tp, fp, edges_p, everywhere, everywhere).counting(tp, fp)
