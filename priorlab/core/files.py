"""Writing that never leaves a half: a file or a folder is made beside its place and renamed into it."""

from __future__ import annotations

import contextlib
import os
import shutil
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path

MAX_PIXELS = 200_000_000
"""Images above this are refused from their header alone."""

WORKING_PIXELS = 16_000_000
"""Images above this are reduced when read, and said so."""


MARK = ".priorlab"
"""A file in every folder that priorlab made: only such a folder, or an empty one, is ever replaced."""


@contextlib.contextmanager
def new_folder(path: str | Path, force: bool = False, keep: Sequence[str | Path] = ()) -> Iterator[Path]:
    """A folder to fill; it appears under `path` only when the block ends well.

    Parameters
    ----------
    path : where it will stand; an empty folder there is taken
    force : replace a folder that stands there and that priorlab made
    keep : what must not go with the folder that is replaced; the working folder never goes

    Raises
    ------
    FileExistsError, ValueError
        As `check_place` says, before the block and, should something have come up in the meantime, after it.

    >>> with tempfile.TemporaryDirectory() as somewhere:
    ...     with new_folder(Path(somewhere) / "out") as folder:
    ...         _ = (folder / "a.txt").write_text("a")
    ...     (Path(somewhere) / "out" / "a.txt").read_text()
    'a'
    """
    check_place(path, force, keep)
    path = Path(path).absolute()
    path.parent.mkdir(parents=True, exist_ok=True)
    beside = Path(tempfile.mkdtemp(prefix=f".{path.name[:50]}-", dir=path.parent))
    os.chmod(beside, 0o755)
    try:
        yield beside
        (beside / MARK).write_text("Made by priorlab; --force may replace this folder.\n")
        check_place(path, force, keep)
        _put_in_place(beside, path)
    finally:
        shutil.rmtree(beside, ignore_errors=True)


def _put_in_place(beside: Path, path: Path) -> None:
    """Rename a folder into its place; what stood there goes only when the new one stands."""
    if not os.path.lexists(path):
        beside.rename(path)
        return
    aside = Path(tempfile.mkdtemp(prefix=f".{path.name[:50]}-old-", dir=path.parent))
    try:
        path.rename(aside / "old")
        try:
            beside.rename(path)
        except OSError:
            (aside / "old").rename(path)
            raise
    finally:
        shutil.rmtree(aside, ignore_errors=True)


def check_place(path: str | Path, force: bool = False, keep: Sequence[str | Path] = ()) -> None:
    """Say when a folder of results cannot be put at `path`, or would take with it what is still needed.

    Raises
    ------
    FileExistsError
        When something else than an empty folder stands there and `force` is not given, or stands there that priorlab did
        not make.
    ValueError
        When it holds the working folder or something of `keep`, when a disk is mounted there, or when nothing can be written
        there.
    """
    if not str(path):
        raise ValueError("the folder for the results must have a name, got ''")
    if not _is_empty_folder(path):
        check_free(path, force)
    place = Path(path).resolve()
    if os.path.lexists(path):
        for needed in (Path.cwd(), *(Path(one).resolve() for one in keep)):
            if needed == place or place in needed.parents:
                how = "--force would remove it" if force else "it would be replaced"
                raise ValueError(f"the folder for the results must not hold {needed}, got {path}: {how}")
        if os.path.ismount(place):  # it cannot be renamed, and that would come out after all the work
            raise ValueError(f"the folder for the results must not be a mounted disk, got {path}: choose a folder on it")
        if not place.is_dir() or (any(place.iterdir()) and not (place / MARK).exists()):
            raise FileExistsError(f"{path} is not a folder that priorlab made: --force replaces no other, choose another place")
    standing = next(folder for folder in place.parents if folder.exists())
    if not standing.is_dir() or not os.access(standing, os.W_OK):
        raise ValueError(f"the folder for the results must lie where one can write, got {path} below {standing}")


def _is_empty_folder(path: str | Path) -> bool:
    """Whether a folder without anything in it stands at `path` itself: a link to one leads elsewhere, and would be replaced."""
    return os.path.isdir(path) and not os.path.islink(path) and not os.listdir(path)


def check_free(path: str | Path, force: bool = False) -> None:
    """Say so when something stands at `path` already and may not be replaced."""
    if os.path.lexists(path) and not force:
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
