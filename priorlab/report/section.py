"""What a section of the report is: a title, sentences, pictures, tables."""

from __future__ import annotations

from dataclasses import dataclass

from priorlab.core.score import Score
from priorlab.report.pictures import Picture


@dataclass(frozen=True)
class Table:
    """Rows of words under a head; the first column names the row."""

    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    caption: str = ""


@dataclass(frozen=True)
class Section:
    """One stage."""

    title: str
    text: tuple[str, ...]
    pictures: tuple[Picture, ...] = ()
    tables: tuple[Table, ...] = ()
    warnings: tuple[str, ...] = ()


def score_table(scores: dict[str, Score | None], caption: str) -> Table:
    """Precision, recall, F2 and false positive rate, one row a map."""
    rows = tuple(
        (name, percent(score.precision), percent(score.recall), f"{score.f_beta:.3f}", percent(score.false_positive_rate, 2))
        for name, score in scores.items()
        if score is not None
    )
    return Table(("", "precision", "recall", "F2", "false positive rate"), rows, caption)


def percent(share: float, digits: int = 1) -> str:
    """A share in percent; nan says why."""
    return f"{100 * share:.{digits}f} %" if share == share else "nothing detected"
