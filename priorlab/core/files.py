"""Writing that never leaves a half: a file or a folder is made beside its place and renamed into it."""

from __future__ import annotations

import contextlib
import os
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path

MAX_PIXELS = 200_000_000
"""Images above this are refused from their header alone."""

WORKING_PIXELS = 16_000_000
"""Images above this are reduced when read, and said so."""


@contextlib.contextmanager
def new_folder(path: str | Path, force: bool = False) -> Iterator[Path]:
    """A folder to fill; it appears under `path` only when the block ends well.

    Raises
    ------
    FileExistsError
        When `path` exists and `force` is not given: nothing of the user's is overwritten.

    >>> with tempfile.TemporaryDirectory() as somewhere:
    ...     with new_folder(Path(somewhere) / "out") as folder:
    ...         _ = (folder / "a.txt").write_text("a")
    ...     (Path(somewhere) / "out" / "a.txt").read_text()
    'a'
    """
    path = Path(path)
    check_free(path, force)
    path.parent.mkdir(parents=True, exist_ok=True)
    beside = Path(tempfile.mkdtemp(prefix=f".{path.name}-", dir=path.parent))
    os.chmod(beside, 0o755)
    try:
        yield beside
        if path.exists():  # only with force: out of the way first, gone only when the new one stands
            old = Path(tempfile.mkdtemp(prefix=f".{path.name}-old-", dir=path.parent))
            path.rename(old / path.name)
            beside.rename(path)
            shutil.rmtree(old)
        else:
            beside.rename(path)
    finally:
        shutil.rmtree(beside, ignore_errors=True)


def check_free(path: str | Path, force: bool = False) -> None:
    """Say so when something stands at `path` already and may not be replaced."""
    if Path(path).exists() and not force:
        raise FileExistsError(f"{path} exists already: choose another place, or replace it with --force")


def write_file(path: str | Path, content: bytes | str) -> None:
    """Write a file in one step: readers see the old one or the new one, never half of it."""
    path = Path(path)
    data = content.encode() if isinstance(content, str) else content
    handle, beside = tempfile.mkstemp(prefix=f".{path.name}-", dir=path.parent)
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(data)
        os.chmod(beside, 0o644)
        os.replace(beside, path)
    except BaseException:
        os.unlink(beside)
        raise
