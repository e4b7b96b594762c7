"""How many of other people's flats, drawn in our styles, does a method read as well as the thesis's table 3.1 asks?

from priorlab.drawing.method import ROBUST
from priorlab.study.flats.scores import flats_table, score_flats
print(flats_table(score_flats(folder, {"ROBUST": ROBUST}, every=24)))
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from priorlab.core.score import Score, score_mask
from priorlab.drawing.extraction import Extraction
from priorlab.interchange.r2v import read_r2v
from priorlab.study.drawing_suite import BAR, matched_doors
from priorlab.study.flats.drawing import LOOKS, Look, draw_flat
from priorlab.study.ranking import Ranked, ranking_line
from priorlab.study.real_plans import Reader, found_by, mask_of, ranked_by


@dataclass(frozen=True)
class FlatRow:
    """One method on one drawing of a flat.

    Parameters
    ----------
    flat, number : its name and its place in its folder
    look, method : how it was drawn, and who read it
    score : counts of the walls
    doors_found, doors_true, doors_right : how many doors; none are found by a method that looks for none
    seconds : of one extraction
    ranked : detected pixels by confidence; None of a method that gives none
    """

    flat: str
    number: int
    look: Look
    method: str
    score: Score
    doors_found: int
    doors_true: int
    doors_right: int
    seconds: float
    ranked: Ranked | None = None

    @property
    def meets_bar(self) -> bool:
        """Precision, recall and false positive rate as good as the thesis's table."""
        precision, recall, rate = BAR
        enough = self.score.precision >= precision and self.score.recall >= recall
        return enough and self.score.false_positive_rate <= rate


def flat_files(folder: str | Path) -> list[Path]:
    """The flats of a folder, in the order of their names."""
    folder = Path(folder)
    if not folder.is_dir():
        raise FileNotFoundError(f"folder must hold flats as text files, got {folder}, which does not exist")
    return sorted(folder.glob("*.txt"))


def flat_rng(seed: int, number: int, look: Look) -> np.random.Generator:
    """The dice of one drawing: they depend on nothing else that is drawn."""
    return np.random.default_rng([seed, number, LOOKS.index(look)])


def score_flats(
    folder: str | Path,
    methods: Mapping[str, Reader],
    looks: Sequence[Look] | None = None,
    every: int = 1,
    seed: int = 0,
    progress: Callable[[FlatRow], None] | None = None,
) -> list[FlatRow]:
    """Draw flats and score methods on them.

    Parameters
    ----------
    folder : of text files as `read_r2v` reads them
    methods : name -> `Method`, or a function that makes a mask of a drawing
    looks : every flat in each of them; one look for each flat, by turns, when left out
    every : only every so many flats
    seed : of all that the files do not say
    progress : called with every row as it is done
    """
    rows = []
    for number, path in list(enumerate(flat_files(folder)))[::every]:
        flat = read_r2v(path)
        for look in looks or (LOOKS[number % len(LOOKS)],):
            drawing, truth = draw_flat(flat, look, flat_rng(seed, number, look))
            for title, reader in methods.items():
                start = time.perf_counter()
                found = found_by(reader, drawing)
                seconds = time.perf_counter() - start
                doors = found.doors if isinstance(found, Extraction) else ()
                right = len(matched_doors(doors, truth.doors))
                score = score_mask(mask_of(found), truth)
                doors_count = (len(doors), len(truth.doors), right)
                ranked = ranked_by(found, truth)
                rows.append(FlatRow(flat.name, number, look, title, score, *doors_count, seconds, ranked))
                if progress:
                    progress(rows[-1])
    return rows


def flats_table(rows: Iterable[FlatRow]) -> str:
    """Rows summed up as text, a line for each method and look: how many meet the bar, and the means, percent."""
    rows = list(rows)
    names = "".join(f"{name:>9}" for name in ("P", "R", "FPR", "worst P", "worst R", "door P", "door R", "s"))
    lines = [f"{'method':<20}{'look':<10}{'meet the bar':>14}{names}"]
    for method in dict.fromkeys(row.method for row in rows):
        for look in (*LOOKS, "all"):
            some = [row for row in rows if row.method == method and look in (row.look, "all")]
            if some:
                lines.append(_line(method, look, some))
        lines.append(ranking_line((row.ranked for row in rows if row.method == method), method))
    return "\n".join(line for line in lines if line)


def _line(method: str, look: str, rows: Sequence[FlatRow]) -> str:
    """One line of the table; a precision that is undefined counts as 0."""
    precision = 100 * np.nan_to_num([row.score.precision for row in rows])
    recall = 100 * np.array([row.score.recall for row in rows])
    false_positives = 100 * np.array([row.score.false_positive_rate for row in rows])
    met = f"{sum(row.meets_bar for row in rows)} of {len(rows)}"
    right, found, true = (sum(getattr(row, f"doors_{kind}") for row in rows) for kind in ("right", "found", "true"))
    door_precision = f"{100 * right / found:>9.1f}" if found else f"{'-':>9}"
    door_recall = f"{100 * right / true:>9.1f}" if true else f"{'-':>9}"
    return (
        f"{method:<20}{look:<10}{met:>14}{precision.mean():>9.1f}{recall.mean():>9.1f}{false_positives.mean():>9.3f}"
        f"{precision.min():>9.1f}{recall.min():>9.1f}{door_precision}{door_recall}{np.mean([row.seconds for row in rows]):>9.2f}"
    )
