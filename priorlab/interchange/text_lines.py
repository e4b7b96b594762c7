"""The lines of a text file that hold something, with their numbers."""

from __future__ import annotations

import os
from pathlib import Path


def numbered_lines(path: str | os.PathLike[str], what: str) -> list[tuple[int, str]]:
    """(number from 1, line) of every line that is neither empty nor a comment after #.

    Parameters
    ----------
    path : the file
    what : what it should hold, for the sentence: "the trajectory"

    Raises
    ------
    FileNotFoundError
        When there is no file.
    ValueError
        When it is no text.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = Path(folder, "a.txt").write_text("# x y\\n\\n1 2\\n")
    ...     numbered_lines(f"{folder}/a.txt", "the table")
    [(3, '1 2')]
    """
    path = Path(path)
    if not path.is_file():
        raise FileNotFoundError(f"{what} must be a file, found none at {path}")
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except UnicodeDecodeError:
        raise ValueError(f"{what} must be text, got something else in {path}") from None
    return [(number, line) for number, line in enumerate(lines, 1) if line.strip() and not line.lstrip().startswith("#")]
