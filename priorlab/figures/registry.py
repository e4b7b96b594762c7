"""Every figure and table of the thesis that is made anew, by its number."""

from __future__ import annotations

from priorlab.core.shipped import nearest_name
from priorlab.figures.chapter2 import FIGURE_2_9
from priorlab.figures.chapter3 import TABLE_3_1
from priorlab.figures.chapter4 import FIGURE_4_5, FIGURE_4_7, FIGURE_4_8
from priorlab.figures.chapter5 import FIGURE_5_8, FIGURE_5_9
from priorlab.figures.chapter6 import FIGURE_6_6, FIGURE_6_8
from priorlab.figures.figure import Entry

FIGURES: dict[str, Entry] = {
    entry.name: entry
    for entry in (FIGURE_2_9, TABLE_3_1, FIGURE_4_5, FIGURE_4_7, FIGURE_4_8, FIGURE_5_8, FIGURE_5_9, FIGURE_6_6, FIGURE_6_8)
}


def figure_named(name: str) -> Entry:
    """The entry of that name, or a sentence with the nearest one.

    >>> figure_named("fig-2-9").title
    'log odds over probability'
    """
    return FIGURES[nearest_name("figure", name, list(FIGURES))]
