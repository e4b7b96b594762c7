"""Figures become files: NAME.png and NAME.json with our numbers and the verdict."""

from __future__ import annotations

import io
import json
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from priorlab.core.files import check_free, write_file
from priorlab.figures.figure import Entry

DOTS_PER_INCH = 110


def write_figures(entries: Sequence[Entry], out: str | Path, seed: int = 0, force: bool = False) -> Iterator[str]:
    """Make figures and write each as it is done; yields a line for each.

    Raises
    ------
    FileExistsError
        When one of the files exists and `force` is not given; before anything is computed.
    """
    folder = Path(out)
    for entry in entries:
        for suffix in ("png", "json"):
            check_free(folder / f"{entry.name}.{suffix}", force)
    for entry in entries:
        outcome = entry.make(np.random.default_rng(seed))
        picture = io.BytesIO()
        outcome.figure.savefig(picture, format="png", dpi=DOTS_PER_INCH)
        told = {
            "name": entry.name,
            "title": entry.title,
            "claim": entry.claim,
            "verdict": outcome.verdict,
            "says": outcome.says,
            "alt": outcome.alt,
            "seed": seed,
            "numbers": outcome.numbers,
        }
        folder.mkdir(parents=True, exist_ok=True)
        write_file(folder / f"{entry.name}.png", picture.getvalue())
        write_file(folder / f"{entry.name}.json", json.dumps(told, indent=2) + "\n")
        yield f"{entry.name}: {outcome.verdict}: {outcome.says}"
