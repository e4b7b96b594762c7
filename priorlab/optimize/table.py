"""The measures of many priors as tables: p_wall down, p_space across."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

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
    factor : of the priors
    overruled : (A, B) True where the pair breaks eq. 2.22 with the sensor (`overruled_readings`); None when nobody asked
    """

    p_wall: NDArray[np.float64]
    p_space: NDArray[np.float64]
    tp: NDArray[np.float64] = field(repr=False)
    fp: NDArray[np.float64] = field(repr=False)
    positives: int
    negatives: int
    beta: float = 2.0
    factor: float = 0.9
    overruled: NDArray[np.bool_] | None = field(default=None, repr=False)

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

    def records(self) -> list[dict[str, Any]]:
        """A row for each pair, ready for a file or a data frame: the pair, its effective values, the measures, eq. 2.22."""
        walls, spaces = np.meshgrid(self.p_wall, self.p_space, indexing="ij")
        columns: dict[str, NDArray[Any]] = {
            "p_wall": walls,
            "p_space": spaces,
            "effective_p_wall": walls * self.factor,
            "effective_p_space": spaces * self.factor,
            "precision": self.precision,
            "recall": self.recall,
            "false_positive_rate": self.false_positive_rate,
            "f_beta": self.f_beta,
        }
        if self.overruled is not None:
            columns["breaks_eq_2_22"] = self.overruled
        values = [column.ravel().tolist() for column in columns.values()]
        return [dict(zip(columns, row, strict=True)) for row in zip(*values, strict=True)]

    def __repr__(self) -> str:
        rows, cols = self.tp.shape
        tops = f"precision {_top(self.precision):.3f}, recall {_top(self.recall):.3f}, F{self.beta:g} {_top(self.f_beta):.3f}"
        return f"Table({rows} p_wall x {cols} p_space, highest {tops})"

    def _repr_html_(self) -> str:
        rows, cols = self.tp.shape
        if max(rows, cols) > 12:
            return f"<p>{self!r}</p>"
        head = "".join(f"<th scope='col'>{p:.3g}</th>" for p in self.p_space)
        broken = np.zeros((rows, cols), dtype=bool) if self.overruled is None else self.overruled
        body = "".join(
            f"<tr><th scope='row'>{p:.3g}</th>"
            + "".join(f"<td>{value:.2f}{'*' if star else ''}</td>" for value, star in zip(row, stars, strict=True))
            + "</tr>"
            for p, row, stars in zip(self.p_wall, self.f_beta, broken, strict=True)
        )
        caption = f"F{self.beta:g}: p_wall down, p_space across" + ("; * breaks eq. 2.22" if broken.any() else "")
        return f"<table><caption>{caption}</caption><thead><tr><th></th>{head}</tr></thead><tbody>{body}</tbody></table>"


def _top(values: NDArray[np.float64]) -> float:
    """The highest number, nan when there is none."""
    return float(np.max(values, where=~np.isnan(values), initial=-np.inf)) if not np.isnan(values).all() else float("nan")
