"""Where the data lies that the project ships: beside the package in a checkout, inside it when installed from a wheel."""

from __future__ import annotations

import difflib
from pathlib import Path


def data_folder(package: Path | None = None) -> Path:
    """The folder with the building descriptions.

    Parameters
    ----------
    package : folder of the installed package; this one by default

    Raises
    ------
    FileNotFoundError
        When the installation holds no data.
    """
    package = package or Path(__file__).resolve().parents[1]
    for place in (package / "data", package.parent / "data"):
        if any(place.glob("*.toml")):
            return place
    raise FileNotFoundError(f"the shipped data must lie in {package}/data or beside it, found neither: install priorlab again")


def nearest_name(kind: str, name: str, known: list[str]) -> str:
    """`name` when it is known; otherwise a sentence with the nearest match.

    >>> nearest_name("building", "smal_flat", ["office_wing", "small_flat"])
    Traceback (most recent call last):
    ValueError: building must be one of office_wing, small_flat, got 'smal_flat'; did you mean 'small_flat'?
    """
    if name in known:
        return name
    close = difflib.get_close_matches(str(name), known, n=1, cutoff=0.0)
    hint = f"; did you mean {close[0]!r}?" if close else ""
    raise ValueError(f"{kind} must be one of {', '.join(known)}, got {name!r}{hint}")
