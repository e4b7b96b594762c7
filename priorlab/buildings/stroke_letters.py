"""Letters of single strokes, as pens of plotters and drawing offices write them: capitals only, polylines on a 4 x 6 grid."""

from __future__ import annotations

import functools
import unicodedata

import numpy as np
from numpy.typing import NDArray

PEN = 0.11
"""Width of the pen, in heights of a capital letter."""

_GRID = 6.0  # steps that a capital is high
_ADVANCE = 5.6  # from letter to letter, with the gap between them

_STROKES = {
    "A": "00 26 40|12 32",
    "B": "00 06 36 45 44 33 03|33 42 41 30 00",
    "C": "45 36 16 05 01 10 30 41",
    "D": "00 06 26 44 42 20 00",
    "E": "46 06 00 40|03 33",
    "F": "46 06 00|03 33",
    "G": "45 36 16 05 01 10 30 41 43 23",
    "H": "00 06|40 46|03 43",
    "I": "20 26",
    "J": "01 10 20 31 36",
    "K": "00 06|46 02|13 40",
    "L": "06 00 40",
    "M": "00 06 23 46 40",
    "N": "00 06 40 46",
    "O": "10 01 05 16 36 45 41 30 10",
    "P": "00 06 36 45 44 33 03",
    "Q": "10 01 05 16 36 45 41 30 10|22 40",
    "R": "00 06 36 45 44 33 03|23 40",
    "S": "01 10 30 41 42 33 13 04 05 16 36 45",
    "T": "06 46|26 20",
    "U": "06 01 10 30 41 46",
    "V": "06 20 46",
    "W": "06 10 24 30 46",
    "X": "00 46|06 40",
    "Y": "06 23 46|23 20",
    "Z": "06 46 00 40",
    "0": "10 01 05 16 36 45 41 30 10",
    "1": "14 26 20",
    "2": "05 16 36 45 44 00 40",
    "3": "06 46 23 33 42 41 30 10 01",
    "4": "30 36 02 42",
    "5": "46 06 04 34 43 41 30 00",
    "6": "36 16 04 01 10 30 41 42 33 02",
    "7": "06 46 10",
    "8": "13 02 01 10 30 41 42 33 13 04 05 16 36 45 44 33",
    "9": "10 30 42 45 36 16 05 04 13 44",
    ".": "20 21",
    ",": "21 10",
    ":": "20 21|23 24",
    "-": "13 33",
    "+": "13 33|22 24",
    "±": "13 33|22 24|11 31",
    "/": "00 46",
    "=": "12 32|14 34",
    "(": "36 24 22 30",
    ")": "16 24 22 10",
    "²": "05 16 25 03 23",
    "×": "12 34|14 32",
}

_ACCENTS = {"\u0300": "17 28", "\u0301": "28 37", "\u0302": "17 28 37", "\u0308": "17 18|37 38"}


def text_strokes(text: str) -> list[NDArray[np.float64]]:
    """(N, 2) polylines of a line of text: x right, y up, base line at 0, capital letters 1 high; unknown signs stay blank.

    >>> len(text_strokes("H 1"))
    4
    """
    strokes: list[NDArray[np.float64]] = []
    pen = 0.0
    for sign in unicodedata.normalize("NFD", text.upper()):
        if sign in _ACCENTS:
            strokes += [stroke + (pen - _ADVANCE / _GRID, 0.0) for stroke in _parsed(_ACCENTS[sign])]
        else:
            strokes += [stroke + (pen, 0.0) for stroke in _parsed(_STROKES.get(sign, ""))]
            pen += _ADVANCE / _GRID
    return strokes


@functools.lru_cache(maxsize=128)
def _parsed(written: str) -> tuple[NDArray[np.float64], ...]:
    """Polylines from pairs of digits."""
    return tuple(
        np.array([(int(pair[0]), int(pair[1])) for pair in stroke.split()], dtype=np.float64) / _GRID
        for stroke in written.split("|")
        if stroke
    )
