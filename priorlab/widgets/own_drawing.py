"""Try your own drawing: upload an image or name its path, and see its doors, its walls and what the extraction has to say."""

from __future__ import annotations

import base64
from html import escape
from typing import Any

import ipywidgets
import numpy as np

from priorlab.core.drawing import Drawing
from priorlab.drawing.method import ROBUST, THESIS
from priorlab.study.own_drawing import OwnResult, extract_own
from priorlab.widgets.canvas import BLUE, ORANGE, Canvas
from priorlab.widgets.lab import Readout, table
from priorlab.widgets.picture import Picture
from priorlab.widgets.screen import Screen

METHODS = {"ROBUST": ROBUST, "THESIS": THESIS}
SURE = 0.7
"""Pieces of wall below this confidence are shown in another colour."""

_ROW = ipywidgets.Layout(flex_flow="row wrap", align_items="center")


class OwnDrawing(ipywidgets.VBox):
    """Set `own.path.value`, or upload; read `own.result`, `own.found`, `own.says`.

    Parameters
    ----------
    bundled : what is shown before anything is uploaded
    width : of each picture on the screen, CSS pixels

    Attributes
    ----------
    result : an `OwnResult`
    found : its extraction, or None
    says : its sentences
    """

    def __init__(self, bundled: Drawing, width: int = 390) -> None:
        self._source: Any = bundled
        self._name = bundled.name
        self.upload = ipywidgets.FileUpload(
            accept="image/*", multiple=False, description="upload an image", layout={"width": "auto"}
        )
        self.path = ipywidgets.Text(
            placeholder="or the path of an image, then Enter", continuous_update=False, layout=ipywidgets.Layout(width="24em")
        )
        self.method = ipywidgets.ToggleButtons(options=list(METHODS), value="ROBUST", style={"button_width": "auto"})
        again = ipywidgets.Button(description="the bundled drawing", layout=ipywidgets.Layout(width="auto"))
        self.progress = ipywidgets.HTML()
        self.pictures = (Picture(width=width), Picture(width=width))
        self.readout, self.screen = Readout(), Screen(self.pictures)
        super().__init__(
            [
                ipywidgets.Box([self.upload, self.path, again], layout=_ROW),
                ipywidgets.Box([self.method, self.progress], layout=_ROW),
                self.screen,
            ]
        )
        self.upload.observe(self._uploaded, "value")
        self.path.observe(self._named, "value")
        self.method.observe(lambda _: self.refresh(), "value")
        again.on_click(lambda _: self.take(bundled, bundled.name))
        self.refresh()

    @property
    def found(self) -> Any:
        """The extraction, or None."""
        return self.result.found

    @property
    def says(self) -> tuple[str, ...]:
        """Its sentences."""
        return self.result.says

    def take(self, source: Any, name: str = "upload") -> None:
        """Look at another drawing: a path, bytes, or a `Drawing`."""
        self._source, self._name = source, name
        self.refresh()

    def refresh(self) -> None:
        """Read, extract, show; or say what is wrong."""
        self.progress.value = _status("reading")
        self.result: OwnResult = extract_own(self._source, self._name, METHODS[self.method.value], self._working)
        self.progress.value = _status("done" if self.found is not None else "this file could not be read")
        notes = [("&bull;", escape(sentence)) for sentence in self.says] or [("&bull;", "nothing to note")]
        self.readout.value = table([*self._numbers(), *notes], caption=escape(self._caption()))
        if self.found is None:
            for picture in self.pictures:
                picture.show(np.full((40, 120), 255, dtype=np.uint8), "nothing to show: the file could not be read")
        else:
            self._paint()
        self.screen.show(self.pictures, self.readout.value)

    def _paint(self) -> None:
        """The drawing with its doors, and its walls."""
        canvas = Canvas(self.found.drawing.grey, max(1, 400 // max(self.found.drawing.shape)))
        for door in self.found.doors:
            canvas.triangle(door.points, ORANGE, 2, 0.45)
        self.pictures[0].show(canvas.picture, f"{self.found.drawing.name} with {len(self.found.doors)} doors, orange triangles")
        walls = Canvas(self.found.drawing.grey, 1, faint=0.75)
        walls.tint(self.found.walls.mask, (0, 0, 0))
        walls.tint(self.found.walls.mask & (self.found.confidence < SURE), BLUE)
        self.pictures[1].show(walls.picture, f"walls, black; blue: those with a confidence below {SURE:g}. {self._caption()}")

    def __repr__(self) -> str:
        return f"OwnDrawing({self._caption() if self.found is not None else f'nothing read: {self.says[0]}'})"

    def _repr_mimebundle_(self, **options: Any) -> dict[str, Any]:
        """The live widget, one line of text, and the walls for readers without a kernel."""
        bundle = super()._repr_mimebundle_(**options) or {}
        bundle["text/plain"] = repr(self)
        bundle["image/png"] = base64.b64encode(self.pictures[1].image).decode()
        return bundle

    def _caption(self) -> str:
        """Which drawing, how large, how read."""
        if self.found is None:
            return "nothing read"
        height, width = self.found.drawing.shape
        return f"{self.found.drawing.name}, {width} x {height} px, {self.method.value}"

    def _numbers(self) -> list[tuple[str, str]]:
        """The numbers under the pictures."""
        found = self.found
        if found is None:
            return []
        rows = [("doors found", f"{len(found.doors)}"), ("wall", f"{100 * found.walls.mask.mean():.1f} % of the pixels")]
        if found.drawing.reduced_by > 1:
            rows.append(("made smaller by", f"{found.drawing.reduced_by:.2f}"))
        if found.door_width is not None:
            rows.append(("median door", f"{found.door_width:.0f} px wide"))
        if found.pieces:
            unsure = (found.confidence[found.walls.mask] < SURE).mean()
            least = min(piece.confidence for piece in found.pieces)
            rows.append(("pieces of wall, the least sure", f"{len(found.pieces)}, confidence {least:.2f}"))
            rows.append((f"walls below {SURE:g}", f"{100 * unsure:.0f} % of them"))
        words = f"black: walls; blue: confidence below {SURE:g}"
        return [*rows, ("left picture", "orange: doors"), ("right picture", words)]

    def _working(self, step: str, done: float) -> None:
        """A step of the extraction begins."""
        self.progress.value = _status(f"{step} ({100 * done:.0f} %)")

    def _uploaded(self, change: Any) -> None:
        """The browser has sent a file."""
        if change["new"]:
            self.take(change["new"][-1]["content"], change["new"][-1]["name"])

    def _named(self, change: Any) -> None:
        """A path was typed."""
        if change["new"]:
            self.take(change["new"])


def _status(words: str) -> str:
    """What is going on, announced politely to screen readers."""
    return f"<span role='status'>{words}</span>"
