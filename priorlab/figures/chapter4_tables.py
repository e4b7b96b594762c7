"""Tables 4.1 and 4.2: the priors of the highest precision and of the highest recall, and what decides them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from priorlab import plot
from priorlab.core.measures import Measure
from priorlab.figures.case import cases
from priorlab.figures.figure import Entry, Outcome, sheet, verdict_of
from priorlab.optimize.table import Table
from priorlab.study.recall_reasons import recall_reasons

CELL_SIZES = (3, 5, 10)
LETTERS = "abcde"

THESIS_PRECISION = (
    *((98.49, 0.3, 0.3), (99.42, 0.3, 0.3), (91.77, 0.3, 0.3), (95.56, 0.1, 0.3), (93.77, 0.3, 0.3)),
    *((75.00, 0.3, 0.3), (95.36, 0.3, 0.3), (79.00, 0.3, 0.3), (84.94, 0.1, 0.3), (90.51, 0.1, 0.3)),
    *((48.00, 0.5, 0.6), (89.14, 0.1, 0.3), (77.42, (0.1, 0.2), (0.3, 0.5)), (92.06, 0.1, 0.3), (92.68, 0.1, 0.3)),
)
THESIS_RECALL = (
    *((80.08, 1, 0.2), (82.77, 0.2, (0.1, 0.2)), (69.43, 0.1, 1), (82.70, (0.7, 1), 1), (83.05, (0.5, 1), 1)),
    *((66.09, 1, 1), (79.71, 0.2, 0.2), (72.05, 1, 1), (86.00, (0.4, 1), 1), (88.68, (0.9, 1), 1)),
    *((66.53, 1, 1), (73.42, 0.2, 1), (86.91, 1, 1), (91.69, (0.4, 0.9), 1), (95.41, 0.2, 1)),
)
"""Percent, p_wall and p_space as printed, rows 3 x 3, 5 x 5, 10 x 10 of drawings a to e: other drawings than ours."""


def as_printed(pairs: NDArray[np.float64]) -> str:
    """Pairs of a 10 x 10 table as the thesis prints them, "(0.1:0.2, 0.3:0.5)"; an ellipsis when they fill no rectangle.

    >>> as_printed(np.array([[0.1, 0.3], [0.2, 0.3]]))
    '(0.1:0.2, 0.3)'
    """
    sides = [np.unique(pairs[:, i].round(1)) for i in (0, 1)]
    full = len(pairs) == len(sides[0]) * len(sides[1])
    told = [f"{side[0]:g}" if len(side) == 1 else f"{side[0]:g}:{side[-1]:g}" for side in sides]
    return f"({', '.join(told)})" + ("" if full else "...")


def _told(printed: tuple[object, ...]) -> str:
    """A row of the thesis as it stands there."""
    value, *sides = printed
    told = [f"{low:g}:{high:g}" if low < high else f"{low:g}" for low, high in map(_ends, sides)]
    return f"{value:.2f} at ({', '.join(told)})"


def _ends(printed: object) -> tuple[float, float]:
    """Lowest and highest of a range, or of one number."""
    low, high = printed if isinstance(printed, tuple) else (printed, printed)
    return float(low), float(high)


def decided_by(printed: object) -> str:
    """Which cells make a printed optimum of recall, from the closed form; "?" where none can.

    Never-seen cells want any value up to 0.2 / 0.9 and those seen twice or more a higher one, so an optimum must hold 0.2 (the
    last of the table before the cliff) or 1.

    >>> decided_by(0.2), decided_by((0.7, 1.0)), decided_by((0.4, 0.9)), decided_by(0.1)
    ('n = 0', 'n >= 2', '?', '?')
    """
    low, high = _ends(printed)
    return "n = 0" if low <= 0.2 <= high else "n >= 2" if high == 1 else "?"


def _best_of(table: Table, measure: Measure) -> tuple[float, NDArray[np.float64]]:
    """The highest value of a 10 x 10 table and where it is."""
    return float(np.nanmax(getattr(table, measure))), table.best(measure)


def _precision(rng: np.random.Generator) -> Outcome:
    """Table 4.1: 15 rows; is the thesis's corner, p_wall 0.1 to 0.3 with p_space 0.3, among the best?"""
    rows: list[tuple[str, ...]] = []
    numbers: list[dict[str, Any]] = []
    in_corner = []
    for size in CELL_SIZES:
        for letter, one in zip(LETTERS, cases(size), strict=True):
            sweep = one.experiment.sweep()
            value, pairs = _best_of(sweep.grid(), "precision")
            exact = sweep.best("precision")
            corner = (np.abs(pairs[:, 1] - 0.3) < 1e-9) & (pairs[:, 0] < 0.3 + 1e-9)
            in_corner.append(bool(corner.any()))
            rows.append(
                (
                    f"{size} x {size}",
                    f"{letter} {one.plan.name}",
                    f"{100 * value:.2f}",
                    as_printed(pairs),
                    _told(THESIS_PRECISION[len(rows)]),
                )
            )
            numbers.append(
                {
                    "cell_size": size,
                    "drawing": one.plan.name,
                    "max_precision": value,
                    "at": as_printed(pairs),
                    "thesis_corner_among_them": in_corner[-1],
                    "exact_max_precision": exact.value,
                    "exact_at": [repr(where) for where in exact.plateaus[:3]],
                    "mean_looks": one.experiment.evidence.mean_looks,
                }
            )
    figure, (ax,) = sheet(1, 1, 9.6, 5.0)
    columns = ("cells, px", "drawing", "max precision, %", "at (p_wall, p_space), ours", "thesis, its drawings")
    plot.number_table(rows, columns, ax, "highest precision on the 10 x 10 priors", (0.1, 0.24, 0.16, 0.25, 0.25), group=5)
    whole = sum(":" in row["at"] for row in numbers)
    wide = [row["drawing"] + f" {row['cell_size']}" for row in numbers if not row["thesis_corner_among_them"]]
    return Outcome(
        figure,
        {"rows": numbers},
        verdict_of(in_corner),
        f"p_wall 0.1 to 0.3 with p_space 0.3 is among the maxima in {sum(in_corner)} of {len(rows)} rows"
        + (f" (not {', '.join(wide)})" if wide else "")
        + f"; precision reaches {min(row['max_precision'] for row in numbers):.2f} to "
        f"{max(row['max_precision'] for row in numbers):.2f}; {whole} maxima are regions of more "
        f"than one prior, of which a table would show a corner",
        "Table of 15 rows: cell size, drawing, highest precision and the priors that reach it, ours beside the thesis's.",
    )


def _recall(rng: np.random.Generator) -> Outcome:
    """Table 4.2: 15 rows, each with the class of cells that decides it."""
    rows: list[tuple[str, ...]] = []
    numbers: list[dict[str, Any]] = []
    intuitive, explained = [], []
    for size in CELL_SIZES:
        for letter, one in zip(LETTERS, cases(size), strict=True):
            experiment = one.experiment
            sweep = experiment.sweep()
            value, pairs = _best_of(sweep.grid(), "recall")
            reasons = recall_reasons(experiment)
            exact = sweep.best("recall")
            foreseen = sum(reason.found for reason in reasons) / sweep.positives
            holds = any(reasons[0].best in where.p_wall and reasons[1].best in where.p_space for where in exact.plateaus)
            explained.append(holds and abs(foreseen - exact.value) < 1e-12)
            intuitive.append(bool(((pairs[:, 0] <= 0.3 + 1e-9) & (pairs[:, 1] >= 0.7 - 1e-9)).any()))
            told = (f"{size}", f"{letter} {one.plan.name}", f"{100 * value:.2f}", as_printed(pairs))
            printed = THESIS_RECALL[len(rows)]
            decided = " / ".join(map(decided_by, printed[1:]))
            best = f"({reasons[0].best:.3g}, {reasons[1].best:.3g})"
            rows.append((*told, best, *(reason.sentence for reason in reasons), _told(printed), decided))
            numbers.append(
                {
                    "cell_size": size,
                    "drawing": one.plan.name,
                    "max_recall": value,
                    "at": as_printed(pairs),
                    "exact_max_recall": exact.value,
                    "exact_at": [repr(where) for where in exact.plateaus[:3]],
                    "why": [reason.sentence for reason in reasons],
                    "true_wall_pixels_by_looks": {
                        reason.name: {
                            "never_seen": reason.unseen,
                            "seen_once_and_detected": reason.once,
                            "seen_more_detected_at_the_cliff": reason.at_cliff,
                            "seen_more_detected_at_1": reason.at_bound,
                        }
                        for reason in reasons
                    },
                    "thesis": _told(printed),
                    "thesis_decided_by": [decided_by(side) for side in printed[1:]],
                    "table_misses_it": bool(value < exact.value - 1e-12),
                    "closed_form_foresees_it": explained[-1],
                    "low_wall_high_space_among_them": intuitive[-1],
                    "mean_looks": experiment.evidence.mean_looks,
                }
            )
    doubtful = [
        f"{LETTERS[i % 5]} {CELL_SIZES[i // 5]}x{CELL_SIZES[i // 5]}"
        for i, row in enumerate(numbers)
        if "?" in row["thesis_decided_by"]
    ]
    figure, (ax,) = sheet(1, 1, 18.0, 5.4)
    why = ("why this p_wall", "why this p_space")
    columns = ("cells", "drawing", "max recall, %", "10 x 10", "exact", *why, "thesis, its drawings", "decided by")
    widths = (0.03, 0.1, 0.075, 0.075, 0.06, 0.22, 0.24, 0.115, 0.085)
    title = "highest recall, ours: on the 10 x 10 priors and exact, and which cells decide; n = looks at a cell"
    plot.number_table(rows, columns, ax, title, widths, group=5)
    return Outcome(
        figure,
        {"rows": numbers},
        verdict_of([sum(intuitive) > len(rows) / 2]),
        f"a low p_wall (up to 0.3) with a high p_space (from 0.7) is among the maxima in {sum(intuitive)} of {len(rows)} rows; "
        f"the closed form foresees {sum(explained)} of {len(rows)}: p_wall and p_space are each low where never-seen cells hold "
        f"the wall pixels, and high where cells seen twice or more do; the 10 x 10 priors miss the exact maximum in "
        f"{sum(row['table_misses_it'] for row in numbers)} rows, having none between 0.2 and 0.222; of the thesis's own "
        f"rows {', '.join(doubtful)} cannot follow "
        f"from eq. 4.11, where recall never falls from p_wall 0.1 to 0.2 nor from 0.3 to 1",
        "Table of 15 rows: cell size, drawing, highest recall, the priors that reach it, ours and the thesis's, and which cells "
        "decide p_wall and p_space.",
    )


TABLE_4_1 = Entry(
    "table-4-1",
    "highest precision, and the priors that reach it",
    "Whatever the drawing and the cell size, precision is highest at p_wall 0.1 to 0.3 and p_space 0.3 (one exception in 15).",
    _precision,
)
TABLE_4_2 = Entry(
    "table-4-2",
    "highest recall, the priors that reach it, and why",
    "In most cases recall is highest where one would expect it: at a high p_space and a lower p_wall.",
    _recall,
)
