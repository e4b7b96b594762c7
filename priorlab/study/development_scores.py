"""How a method reads the development drawings: a line for each, and a line for each style.

python -m priorlab.study.development_scores work 48
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence

from priorlab.drawing.method import ROBUST, Method
from priorlab.study.development_drawings import development_case, development_numbers
from priorlab.study.drawing_suite import Found, SuiteRow, by_style, score_case, summary, told


def score_development(
    numbers: Sequence[int],
    method: Method | str | Callable[..., Found] = ROBUST,
    progress: Callable[[str], None] | None = None,
) -> list[SuiteRow]:
    """Score a method on development drawings.

    Parameters
    ----------
    numbers : which drawings; `development_numbers` names those for work and those held back
    method : as `score_case` takes it
    progress : called with a line for each drawing
    """
    rows = []
    for number in numbers:
        rows.append(score_case(development_case(number), method))
        if progress is not None:
            progress(told(rows[-1]))
    return rows


def development_table(rows: Sequence[SuiteRow]) -> str:
    """Rows summed up as text, a line for each style and one for all: how many meet the bar, and the means, percent.

    Raises
    ------
    ValueError
        Without rows.
    """
    lines = [f"{'style':<12}{'meet the bar':>14}{'P':>9}{'R':>9}{'FPR':>9}{'door P':>9}{'door R':>9}"]
    for style, sums in {**by_style(rows), "all": summary(rows)}.items():
        met = f"{sums['meet_bar']} of {sums['drawings']}"
        lines.append(
            f"{style:<12}{met:>14}{sums['precision']:>9.1f}{sums['recall']:>9.1f}{sums['false_positive_rate']:>9.3f}"
            f"{sums['door_precision']:>9.1f}{sums['door_recall']:>9.1f}"
        )
    return "\n".join(lines)


def main(arguments: Sequence[str] | None = None) -> None:
    """Score ROBUST on the drawings for work, or on those held back, and print the table."""
    parser = argparse.ArgumentParser(prog="python -m priorlab.study.development_scores", description=main.__doc__)
    parser.add_argument("half", choices=["work", "held_back"])
    parser.add_argument("count", type=int, nargs="?", default=48, help="how many drawings (default 48)")
    asked = parser.parse_args(arguments)
    if asked.count < 1:
        parser.error(f"count must be at least 1, got {asked.count}")

    def tell(line: str) -> None:
        print(line, file=sys.stderr, flush=True)

    print(development_table(score_development(development_numbers(asked.half, asked.count), progress=tell)))


if __name__ == "__main__":
    main()
