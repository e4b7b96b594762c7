"""A drawing of one's own, from a file or from an upload: its walls, or the sentence that says why there are none."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from priorlab.core.drawing import Drawing
from priorlab.drawing.extraction import Extraction, extract_walls
from priorlab.drawing.method import ROBUST, Method
from priorlab.interchange.images import read_drawing

NOTHING = "No file was named: give a path, or upload an image."


@dataclass(frozen=True, eq=False)
class OwnResult:
    """What became of a drawing.

    Parameters
    ----------
    found : the extraction; None when the file could not be read
    says : sentences for the reader: what the extraction notes, or what is wrong with the file
    """

    found: Extraction | None
    says: tuple[str, ...]

    def __repr__(self) -> str:
        return f"OwnResult({self.found if self.found is not None else self.says[0]})"


def extract_own(
    source: str | os.PathLike[str] | bytes | memoryview | Drawing,
    name: str = "upload",
    method: Method = ROBUST,
    progress: Callable[[str, float], None] | None = None,
) -> OwnResult:
    """Read a drawing and extract its walls; a file that cannot be read gives its sentence, never an exception.

    Parameters
    ----------
    source : the path of an image, the bytes of one as a browser uploads them, or a drawing that was read already
    name : what uploaded bytes were called
    method : as in `extract_walls`
    progress : as in `extract_walls`

    >>> extract_own("no_such_plan.png").says
    ('the drawing must be a file, found nothing at no_such_plan.png',)
    >>> extract_own(b"%PDF-1.7 ...", "plan.pdf").says[0]
    'the drawing must be a PNG, JPEG, BMP or TIFF image, got a PDF file: export plan.pdf as a PNG first'
    """
    try:
        drawing = source if isinstance(source, Drawing) else _read(source, name)
    except (ValueError, OSError) as error:  # the file's fault: its sentence is the answer
        return OwnResult(None, (str(error),))
    found = extract_walls(drawing, method, progress)
    return OwnResult(found, found.notes)


def _read(source: str | os.PathLike[str] | bytes | memoryview, name: str) -> Drawing:
    """A drawing from a path, or from bytes by way of a file; sentences call that by the name it was uploaded under."""
    if isinstance(source, str | os.PathLike):
        if not str(source).strip():
            raise ValueError(NOTHING)
        return read_drawing(Path(source).expanduser())
    called = Path(name.replace("\\", "/")).name or "upload"
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder) / called
        place.write_bytes(source)
        try:
            return read_drawing(place)
        except (ValueError, OSError) as error:
            raise ValueError(str(error).replace(str(place), called)) from None
