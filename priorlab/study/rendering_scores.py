"""How a method reads renderings of other people's flats, in every look: intersection over union with the walls.

python -m priorlab.study.rendering_scores FOLDER work
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from priorlab.core.building import Truth
from priorlab.core.drawing import Drawing, Walls
from priorlab.core.score import Score, score_walls
from priorlab.drawing.baselines import run_length
from priorlab.drawing.extraction import extract_walls
from priorlab.drawing.method import ROBUST, Method
from priorlab.drawing.walls import as_walls
from priorlab.interchange.r2v import read_r2v
from priorlab.study.flats.drawing import describe_flat
from priorlab.study.flats.scores import flat_files
from priorlab.study.renderings import RENDERING_LOOKS, THIN, RenderingLook, draw_rendering

EVERY = 16
"""Each look is drawn of so many flats less one."""


@dataclass(frozen=True)
class RenderingRow:
    """One rendering: the flat's number, the look, how its walls were read, and how the best simple filter reads them."""

    number: int
    look: str
    score: Score
    simple: Score


def rendering_of(folder: str | Path, number: int, look: RenderingLook) -> tuple[Drawing, Truth]:
    """A flat of a folder as a rendering; the same each time."""
    flat = read_r2v(flat_files(folder)[number])
    pen = {name: sum(THIN) / 2 for name in ("outer", "inner", "rail")} if look.walls == "thin" else None
    rng = np.random.default_rng([number, [one.name for one in RENDERING_LOOKS].index(look.name)])
    return draw_rendering(describe_flat(flat, "filled", rng, pen), look, rng)


def score_renderings(
    folder: str | Path,
    half: Literal["work", "held_back"] = "work",
    method: Method | Callable[[Drawing], Walls] = ROBUST,
    every: int = EVERY,
    progress: Callable[[RenderingRow], None] | None = None,
) -> list[RenderingRow]:
    """Score a method on renderings: each look of its own flats, those with even numbers for work, odd ones held back.

    Parameters
    ----------
    folder : of flats, text files as `read_r2v` reads them
    half : which flats
    method : or a function that gives walls
    every : only every so many flats of the half in each look
    progress : called with every row as it is done
    """
    rows = []
    count = len(flat_files(folder))
    for place, look in enumerate(RENDERING_LOOKS):
        for number in range((2 * place) % (2 * every) + (half == "held_back"), count, 2 * every):
            drawing, truth = rendering_of(folder, number, look)
            walls = extract_walls(drawing, method).walls if isinstance(method, Method) else method(drawing)
            simple = score_walls(as_walls(drawing, run_length(drawing)), truth, windows="empty")
            rows.append(RenderingRow(number, look.name, score_walls(walls, truth, windows="empty"), simple))
            if progress is not None:
                progress(rows[-1])
    return rows


def renderings_table(rows: Iterable[RenderingRow]) -> str:
    """Means of each look and of all, percent; the last column is the run length filter's IoU."""
    rows = list(rows)
    lines = [f"{'look':<34}{'flats':>6}{'IoU':>8}{'worst':>8}{'P':>8}{'R':>8}{'run length':>12}"]
    for look in (*dict.fromkeys(row.look for row in rows), "all"):
        some = [row for row in rows if look in (row.look, "all")]
        iou = 100 * np.array([row.score.iou for row in some])
        precision = 100 * float(np.mean(np.nan_to_num([row.score.precision for row in some])))
        recall = 100 * float(np.mean([row.score.recall for row in some]))
        simple = 100 * float(np.mean([row.simple.iou for row in some]))
        lines.append(f"{look:<34}{len(some):>6}{iou.mean():>8.1f}{iou.min():>8.1f}{precision:>8.1f}{recall:>8.1f}{simple:>12.1f}")
    return "\n".join(lines)


def main(arguments: Sequence[str] | None = None) -> None:
    """Score ROBUST on renderings of flats, those for work or those held back, and print the table."""
    parser = argparse.ArgumentParser(prog="python -m priorlab.study.rendering_scores", description=main.__doc__)
    parser.add_argument("folder", help="of flats, text files of the Raster-to-Vector set")
    parser.add_argument("half", choices=["work", "held_back"])
    parser.add_argument("--every", type=int, default=EVERY, help=f"only every so many flats in each look (default {EVERY})")
    asked = parser.parse_args(arguments)
    if asked.every < 1:
        parser.error(f"--every must be at least 1, got {asked.every}")

    def tell(row: RenderingRow) -> None:
        print(f"{row.number:>3} {row.look:<34}IoU {100 * row.score.iou:5.1f}", file=sys.stderr, flush=True)

    print(renderings_table(score_renderings(asked.folder, asked.half, every=asked.every, progress=tell)))


if __name__ == "__main__":
    main()
