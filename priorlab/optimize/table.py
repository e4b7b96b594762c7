"""The measures of many priors as tables: p_wall down, p_space across."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from priorlab.core.measures import Measure, f_beta_of, share


@dataclass(frozen=True, eq=False)
class Table:
    """What every pair of some p_wall and some p_space reaches.

    Parameters
    ----------
    p_wall, p_space : (A,) and (B,) P(empty) before the factor
    tp, fp : (A, B) true and false pixels detected
    positives, negatives : counted true-wall and empty pixels
    beta : of F-beta
    """

    p_wall: NDArray[np.float64]
    p_space: NDArray[np.float64]
    tp: NDArray[np.float64] = field(repr=False)
    fp: NDArray[np.float64] = field(repr=False)
    positives: int
    negatives: int
    beta: float = 2.0

    @cached_property
    def precision(self) -> NDArray[np.float64]:
        """(A, B) TP / (TP + FP); nan where nothing is detected."""
        return share(self.tp, self.tp + self.fp)

    @cached_property
    def recall(self) -> NDArray[np.float64]:
        """(A, B) TP / true wall; nan when there is no wall."""
        return share(self.tp, self.positives)

    @cached_property
    def false_positive_rate(self) -> NDArray[np.float64]:
        """(A, B) FP / true empty; nan when everything is wall."""
        return share(self.fp, self.negatives)

    @cached_property
    def f_beta(self) -> NDArray[np.float64]:
        """(A, B) eq. 5.1; 0 where nothing is detected rightly."""
        return f_beta_of(self.tp, self.fp, self.positives, self.beta)

    def best(self, measure: Measure = "f_beta") -> NDArray[np.float64]:
        """(K, 2) the pairs of the table that reach its highest value: tables 4.1 and 4.2 print them from 10 x 10 pairs."""
        values = getattr(self, measure)
        rows, cols = np.nonzero(values == _top(values))
        return np.column_stack([self.p_wall[rows], self.p_space[cols]])

    def __repr__(self) -> str:
        rows, cols = self.tp.shape
        tops = f"precision {_top(self.precision):.3f}, recall {_top(self.recall):.3f}, F{self.beta:g} {_top(self.f_beta):.3f}"
        return f"Table({rows} p_wall x {cols} p_space, highest {tops})"

    def _repr_html_(self) -> str:
        rows, cols = self.tp.shape
        if max(rows, cols) > 12:
            return f"<p>{self!r}</p>"
        head = "".join(f"<th scope='col'>{p:.3g}</th>" for p in self.p_space)
        body = "".join(
            f"<tr><th scope='row'>{p:.3g}</th>" + "".join(f"<td>{value:.2f}</td>" for value in row) + "</tr>"
            for p, row in zip(self.p_wall, self.f_beta, strict=True)
        )
        caption = f"F{self.beta:g}: p_wall down, p_space across"
        return f"<table><caption>{caption}</caption><thead><tr><th></th>{head}</tr></thead><tbody>{body}</tbody></table>"


def _top(values: NDArray[np.float64]) -> float:
    """The highest number, nan when there is none."""
    return float(np.max(values, where=~np.isnan(values), initial=-np.inf)) if not np.isnan(values).all() else float("nan")
