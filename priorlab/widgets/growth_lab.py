"""Walls growing from doors, sweep by sweep, and what the score makes of every stage."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from priorlab.core.building import Truth
from priorlab.core.drawing import Door, Drawing
from priorlab.core.score import Score, score_mask
from priorlab.drawing.corners import corners_of
from priorlab.drawing.method import THESIS
from priorlab.drawing.outer_walls import outer_walls
from priorlab.drawing.preprocessing import prepare
from priorlab.drawing.sweeps import orientation
from priorlab.drawing.walls import sweeps_from
from priorlab.plot.extraction import LEGEND, scored_image
from priorlab.widgets.canvas import BLUE, GREEN, ORANGE, PINK, Canvas
from priorlab.widgets.lab import Lab, table
from priorlab.widgets.picture import Picture
from priorlab.widgets.sliders import Slider


class GrowthLab(Lab):
    """Move the stage; read `lab.walls`, `lab.new`, `lab.score`, `lab.literal_score`.

    Parameters
    ----------
    drawing : the drawing
    truth : what the score counts
    doors : by name, doors in pixels of the drawing; the walls grow from the first so many of one of them
    width : of each picture on the screen, CSS pixels

    Attributes
    ----------
    stages : masks after the jambs' runs and after each sweep
    walls, new : mask at the stage, and what its last step added
    score, literal_score : with the don't-care pixels left out, and with all pixels counted
    """

    def __init__(self, drawing: Drawing, truth: Truth, doors: Mapping[str, Sequence[Door]], width: int = 390) -> None:
        if not doors or not all(doors.values()):
            raise ValueError("doors must name at least one group of at least one door, got none")
        self._drawing, self._truth, self._doors = drawing, truth, {name: tuple(some) for name, some in doors.items()}
        self._all_counted = replace(truth, ignore=np.zeros_like(truth.ignore))
        self._grown_from: tuple[float, ...] = ()
        sheet = prepare(drawing, THESIS)
        self._ink = sheet.walls
        self._outer = outer_walls(sheet.walls, corners_of(sheet, THESIS.n_corners, THESIS), THESIS.outer_tolerance)
        most = max(len(some) for some in self._doors.values())
        self.stage = Slider("stage", 0, 0, THESIS.n_sweeps, 1, "0: the runs at the jambs; 1 to 4: after so many sweeps")
        self.n_doors = Slider("doors used", most, 0, most, 1, "walls grow from the first so many")
        self.source = Slider("doors from", 1, 1, len(self._doors), 1, "; ".join(self._doors))
        self.outer = Slider("outer walls", 0, 0, 1, 1, "1: begin with the lines through the extreme corners (eq. 3.11-3.14)")
        self.dont_care = Slider("don't-care", 1, 0, 1, 1, "1: doors, stairs and fixtures are not counted; 0: everything is")
        names = ("stage", "n_doors", "source", "outer", "dont_care")
        last = {"stage": THESIS.n_sweeps, "n_doors": most, "outer": 0, "dont_care": 1}
        presets: dict[str, dict[str, float]] = {"one door": {**last, "n_doors": 1, "source": 1}}
        presets |= {name: {**last, "source": place} for place, name in enumerate(self._doors, start=1)}
        presets |= {"with outer walls": {**last, "source": 1, "outer": 1}, "count everything": {"dont_care": 0}}
        super().__init__({name: getattr(self, name) for name in names}, presets, [Picture(width=width), Picture(width=width)])

    def refresh(self) -> None:
        """Sweeps from the doors, two scores, two pictures."""
        self.doors = list(self._doors.values())[int(self.source.value) - 1][: int(self.n_doors.value)]
        grown_from = (self.source.value, self.n_doors.value, self.outer.value)
        if grown_from != self._grown_from:  # another stage of the same walls needs no new sweeps
            outer = self._outer if self.outer.value else np.zeros_like(self._outer)
            self.stages, self._grown_from = sweeps_from(self._ink, outer, self.doors, THESIS), grown_from
        stage = int(self.stage.value)
        self.walls = self.stages[stage]
        self.new = self.walls & ~self.stages[stage - 1] if stage else self.walls
        self.score, self.literal_score = score_mask(self.walls, self._truth), score_mask(self.walls, self._all_counted)
        truth = self._truth if self.dont_care.value else self._all_counted
        self.pictures[0].show(self._paint(), f"Walls growing; orange: new at this stage. {self.summary()}")
        self.pictures[1].show(scored_image(self.walls, truth), f"What the score counts. {LEGEND}. {percent(self.score)}")
        ways = [orientation(door) for door in self.doors]
        n_doors = len(list(self._doors.values())[int(self.source.value) - 1])
        bold = ("<b>", "</b>") if self.dont_care.value else ("", "")
        rows = [
            (f"{bold[0]}don't-care left out{bold[1]}", f"{bold[0]}{percent(self.score)}{bold[1]}"),
            ("everything counted", percent(self.literal_score)),
            ("pixels of wall, new ones", f"{self.walls.sum():,}, {self.new.sum():,}"),
            (
                "doors used",
                f"{len(self.doors)} of {n_doors}: {ways.count('h')} horizontal, {ways.count('v')} vertical (eq. 3.15)",
            ),
            ("left picture", "green: wall, orange: new, pink: open sides of doors, blue: jambs"),
            ("right picture", LEGEND.replace(", dark", ",<br>dark").replace(", light grey", ",<br>light grey")),
        ]
        self.readout.value = table(rows, caption="the jambs' runs" if not stage else f"after sweep {stage}")

    def summary(self) -> str:
        """The stage and both scores."""
        name = list(self._doors)[int(self.source.value) - 1]
        start = " and outer walls" if self.outer.value else ""
        return (
            f"stage {self.stage.value:.0f} from {len(self.doors)} doors ({name}){start}: {percent(self.score)}; "
            f"everything counted: {percent(self.literal_score)}"
        )

    def _paint(self) -> NDArray[np.uint8]:
        """The drawing, its walls so far, what is new, the doors."""
        canvas = Canvas(self._drawing.grey)
        canvas.tint(self.walls, GREEN)
        canvas.tint(self.new, ORANGE)
        for door in self.doors:
            canvas.line(door.points[:2], PINK, 2)
            canvas.dot(door.points[0], BLUE, 2)
            canvas.dot(door.points[1], BLUE, 2)
        return canvas.picture


def percent(score: Score) -> str:
    """Precision, recall and false positive rate as table 3.1 has them."""
    precision = f"{100 * score.precision:.1f}" if np.isfinite(score.precision) else "undefined"
    return f"precision {precision}, recall {100 * score.recall:.1f}, FPR {100 * score.false_positive_rate:.2f} %"
