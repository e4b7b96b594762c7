"""A table as a picture."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.transforms import Bbox

from priorlab.plot.style import given_or_new

EVEN, ODD, HEAD = "#f4f4f4", "#ffffff", "#dddddd"


def number_table(
    rows: Sequence[Sequence[object]],
    columns: Sequence[str],
    ax: Axes | None = None,
    title: str | None = None,
    widths: Sequence[float] | None = None,
    group: int = 1,
) -> Axes:
    """Rows of words and numbers; every `group` rows change the shade.

    Parameters
    ----------
    rows : as they are shown
    columns : the head
    widths : shares of the width
    group : rows that belong together
    """
    ax = given_or_new(ax, 9.0, 0.28 * len(rows) + 0.8)
    ax.axis("off")
    shades = [[EVEN if (i // group) % 2 else ODD] * len(columns) for i in range(len(rows))]
    made = ax.table(
        [[str(value) for value in row] for row in rows],
        colLabels=list(columns),
        colWidths=None if widths is None else list(widths),
        cellColours=shades,
        colColours=[HEAD] * len(columns),
        cellLoc="left",
        colLoc="left",
        bbox=Bbox([[0, 0], [1, 1]]),
    )
    made.auto_set_font_size(False)
    made.set_fontsize(8)
    for cell in made.get_celld().values():
        cell.set_linewidth(0.3)
        cell.PAD = 0.02
    if title is not None:
        ax.set_title(title)
    return ax
