"""The thresholds of the search for doors: move one, and the funnel and the doors answer."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from priorlab.core.building import Truth
from priorlab.core.drawing import Drawing
from priorlab.drawing.candidates import DoorSearch
from priorlab.drawing.corners import corners_of
from priorlab.drawing.doors import search_doors
from priorlab.drawing.method import THESIS, Method
from priorlab.drawing.preprocessing import prepare
from priorlab.study.drawing_suite import matched_doors
from priorlab.widgets.canvas import BLUE, GREEN, ORANGE, PINK, Canvas
from priorlab.widgets.funnel import funnel_svg
from priorlab.widgets.lab import Lab, table
from priorlab.widgets.picture import Picture
from priorlab.widgets.sliders import Slider

AS_PRINTED: dict[str, float] = {
    "n_corners": 200,
    "ratio": 0.9,
    "min_angle": 0,
    "max_angle": 100,
    "max_tilt": 45,
    "max_dark": 0.4,
    "max_overlap": 0.3,
    "keep_best": 0,
    "drop_outer": 1,
}
PRESETS: dict[str, dict[str, float]] = {
    "as the text says": AS_PRINTED,
    "keep the best": {**AS_PRINTED, "keep_best": 1},
    "and no needles": {**AS_PRINTED, "keep_best": 1, "min_angle": 25},
    "and the open side along an axis": {**AS_PRINTED, "keep_best": 1, "min_angle": 25, "max_tilt": 12},
    "and doors on outer walls": {**AS_PRINTED, "keep_best": 1, "min_angle": 25, "max_tilt": 12, "drop_outer": 0},
    "too few corners": {**AS_PRINTED, "n_corners": 30},
    "dark share 2 %": {**AS_PRINTED, "max_dark": 0.02},
    "all overlaps": {**AS_PRINTED, "max_overlap": 1},
}


class DoorLab(Lab):
    """Move a threshold; read `lab.search`, `lab.funnel`, `lab.doors`, `lab.right`, `lab.method`.

    Parameters
    ----------
    drawing : a small one, so that a move answers at once
    truth : whose doors count as right
    width : of the drawing on the screen, CSS pixels

    Attributes
    ----------
    method : what the sliders say
    search : everything the search saw
    funnel : corners, wedges, then what each test leaves
    doors : what is left
    right : how many of them are true doors
    """

    def __init__(self, drawing: Drawing, truth: Truth, width: int = 470) -> None:
        self._drawing, self._truth = drawing, truth
        self._zoom = max(1, -(-width // drawing.shape[1]))
        self._sheet = prepare(drawing, THESIS)
        self._search_by = lru_cache(maxsize=64)(self._search)  # a slider goes back and forth
        start = AS_PRINTED
        self.n_corners = Slider("corners", start["n_corners"], 10, 200, 10, "the budget: the strongest so many (fig. 3.9)")
        self.ratio = Slider("side ratio above", start["ratio"], 0.5, 0.98, 0.02, "shorter over longer of two sides (eq. 3.5)")
        self.min_angle = Slider("smallest angle, deg", start["min_angle"], 0, 40, 1, "the text asks for none")
        self.max_angle = Slider("largest angle, deg", start["max_angle"], 60, 150, 5, "the text says 100")
        self.max_tilt = Slider("tilt up to, deg", start["max_tilt"], 0, 45, 1, "of the open side (eq. 3.15); 45 allows all")
        self.max_dark = Slider("dark share below", start["max_dark"], 0.02, 1, 0.02, "ink inside the triangle (3.3.1: 40 %)")
        self.max_overlap = Slider("overlap up to", start["max_overlap"], 0, 1, 0.05, "of the smaller triangle (3.3.1: 30 %)")
        self.keep_best = Slider(
            "keep the best", start["keep_best"], 0, 1, 1, "0: of overlapping ones the first stays; 1: the best"
        )
        self.drop_outer = Slider("drop on outer walls", start["drop_outer"], 0, 1, 1, "1: as the text, third check")
        super().__init__({name: getattr(self, name) for name in AS_PRINTED}, PRESETS, [Picture(width=width), Picture()])

    def refresh(self) -> None:
        """Corners, search, two pictures."""
        self.method = self._method()
        self.search = self._search_by(self.method)
        self.doors = self.search.doors
        self.funnel = {"corners": len(self.search.corners), **self.search.funnel}
        pairs = matched_doors(self.doors, self._truth.doors)
        self.right = len(pairs)
        self.pictures[0].show(self._paint({found for found, _ in pairs}, {true for _, true in pairs}), self._alt())
        self.pictures[1].show_svg(funnel_svg(self.funnel), "; ".join(f"{name} {left}" for name, left in self.funnel.items()))
        n_true = len(self._truth.doors)
        rows = [
            ("<b>true doors found</b>", f"<b>{self.right} of {n_true}</b>"),
            ("false doors", f"{len(self.doors) - self.right}"),
            ("precision, recall of doors", f"{_share(self.right, len(self.doors))}, {_share(self.right, n_true)}"),
            (
                "corners, triples of them (nCr)",
                f"{len(self.search.corners)} of at most {self.method.n_corners}, {self.search.n_triples:,}",
            ),
            ("connected pairs", f"{len(self.search.edges):,}"),
            (
                "picture",
                "green: a true door; orange, black cross: a false one;<br>pink outline: a door that was missed; blue +: corners",
            ),
        ]
        self.readout.value = table(rows)

    def _search(self, method: Method) -> DoorSearch:
        """Corners, and the search among them."""
        corners = self._sheet.points_to_input(corners_of(self._sheet, method.n_corners, method))
        return search_doors(self._sheet, corners, method)

    def summary(self) -> str:
        """Doors and the funnel."""
        left = " > ".join(f"{count}" for count in self.funnel.values())
        return f"{self.right} of {len(self._truth.doors)} true doors, {len(self.doors) - self.right} false; {left}"

    def _method(self) -> Method:
        """The sliders as a method."""
        return replace(
            THESIS,
            name="sliders",
            n_corners=int(self.n_corners.value),
            isosceles_ratio=self.ratio.value,
            min_angle=self.min_angle.value,
            max_largest_angle=self.max_angle.value,
            max_tilt=self.max_tilt.value,
            max_dark=self.max_dark.value,
            max_overlap=self.max_overlap.value,
            keep_best=bool(self.keep_best.value),
            drop_on_outer_walls=bool(self.drop_outer.value),
        )

    def _alt(self) -> str:
        """The picture in words."""
        return f"The drawing with {self.funnel['corners']} corners and the doors. {self.summary()}"

    def _paint(self, right: set[int], found: set[int]) -> NDArray[np.uint8]:
        """Corners, doors that are right or wrong, doors that were missed."""
        canvas = Canvas(self._drawing.grey, self._zoom)
        for place, door in enumerate(self._truth.doors):
            if place not in found:
                canvas.triangle(door.points, PINK, 2)
        for place, door in enumerate(self.doors):
            canvas.triangle(door.points, GREEN if place in right else ORANGE, 2, 0.4)
            if place not in right:
                canvas.crosses([door.points.mean(axis=0)], (0, 0, 0), 13, 2)
        canvas.crosses(self.search.corners, BLUE)
        return canvas.picture


def _share(part: int, whole: int) -> str:
    """A share, or that there is none."""
    return f"{part / whole:.2f}" if whole else "undefined"
