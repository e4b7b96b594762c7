"""One candidate for a door, test by test: the pixels that each test looked at, what it measured, what it asked, its verdict."""

from __future__ import annotations

from collections.abc import Sequence

import ipywidgets
import numpy as np
from numpy.typing import NDArray

from priorlab.drawing.candidates import DOOR, TESTS
from priorlab.drawing.explain import Reading, TestResult, explain_candidate
from priorlab.drawing.extraction import Extraction
from priorlab.widgets.canvas import BLUE, GREEN, ORANGE, PINK, SKY, Canvas, window_round
from priorlab.widgets.lab import Lab, table
from priorlab.widgets.picture import Picture
from priorlab.widgets.sliders import Slider

COLOURS = (BLUE, ORANGE, PINK)
NAMES = ("blue", "orange", "pink")
AREAS = ("triangle", "door kept before")


class CandidateLab(Lab):
    """Choose a candidate and step through its tests; read `lab.results`, `lab.result`, `lab.verdict`.

    Parameters
    ----------
    seen : an extraction, or rather its search for doors
    candidates : rows of `seen.door_search.candidates` to choose among; some of every fate by default
    width : of the picture on the screen, CSS pixels

    Attributes
    ----------
    candidates : the rows to choose among
    row : the row of the one that is shown
    results : every test's result about it, in order
    result : of the test that is shown
    verdict : "a door", or the name of the test that rejected it
    """

    def __init__(self, seen: Extraction, candidates: Sequence[int] | None = None, width: int = 420) -> None:
        self._seen = seen
        self.candidates = tuple(examples(seen) if candidates is None else (int(row) for row in candidates))
        if not self.candidates:
            raise ValueError("candidates must hold at least one row, got none")
        self._told: dict[int, tuple[TestResult, ...]] = {}
        self.candidate = Slider("candidate", 1, 1, len(self.candidates), 1, "accepted ones first, then some lost at each test")
        self.test = Slider("test", 1, 1, len(seen.door_search.tests), 1, "in the order in which they are asked")
        ahead = ipywidgets.Button(description="next test", button_style="primary", layout=ipywidgets.Layout(width="auto"))
        back = ipywidgets.Button(description="one back", layout=ipywidgets.Layout(width="auto"))
        ahead.on_click(lambda _: self.step(1))
        back.on_click(lambda _: self.step(-1))
        presets: dict[str, dict[str, float]] = {}
        for place, row in enumerate(self.candidates, start=1):
            fate = _fate(seen, row)
            presets.setdefault(fate if fate == "a door" else f"lost at {fate}", {"candidate": place, "test": 1})
        super().__init__({"candidate": self.candidate, "test": self.test}, presets, [Picture(width=width)], [back, ahead])

    def step(self, by: int = 1) -> None:
        """Go to the next test (or, with -1, the one before); at the ends nothing happens."""
        self.test.value = float(np.clip(self.test.value + by, 1, self.test.max))

    def refresh(self) -> None:
        """Explain the candidate, show one test."""
        self.row = self.candidates[int(self.candidate.value) - 1]
        if self.row not in self._told:
            self._told[self.row] = explain_candidate(self._seen, self.row)
        self.results = self._told[self.row]
        self.result = self.results[int(self.test.value) - 1]
        self.verdict = _fate(self._seen, self.row)
        shown = self.result
        rows = [("<b>verdict of this test</b>", f"<b>{_word(shown)}</b>")]
        rows += [(reading.name, _asked(reading)) for reading in shown.readings]
        looked_at = zip(shown.pixels.items(), NAMES, strict=False)
        rows += [(name, f"{len(points)} points, {colour}") for (name, points), colour in looked_at]
        rows.append(("<b>all tests</b>", ""))
        for result in self.results:
            here = " &larr;" if result is shown else ""
            rows.append((f"{'' if result.asked else '(after the end) '}{result.test}", f"{_word(result)}{here}"))
        rows.append(("<b>in the end</b>", f"<b>{self.verdict if self.verdict == 'a door' else 'lost at ' + self.verdict}</b>"))
        self.readout.value = table(rows, caption=f"{shown.test}: {shown.question}")
        self.pictures[0].show(self._paint(), f"Candidate {self.candidate.value:.0f}, magnified. {self.summary()}")

    def summary(self) -> str:
        """Candidate, test, its number and its verdict."""
        end = self.verdict if self.verdict == "a door" else f"lost at {self.verdict}"
        return f"candidate {self.candidate.value:.0f} of {len(self.candidates)}, {end}; {self.result}"

    def _paint(self) -> NDArray[np.uint8]:
        """The drawing round the candidate, and what the test looked at."""
        search = self._seen.door_search
        vertices = search.corners[search.candidates[self.row]]
        window = window_round(vertices, margin=0.45 * float(np.ptp(vertices, axis=0).max()) + 6)
        canvas = Canvas(self._seen.drawing.grey, max(1, 840 // window[2]), window)
        for (name, points), colour in zip(self.result.pixels.items(), COLOURS, strict=False):
            if name in AREAS and len(points) == 3:
                canvas.triangle(points, colour, 2, 0.35)
            elif name == "outer walls":
                canvas.line(points, colour, 3)
            else:
                canvas.fill(points, colour, 0.8 if name != "inside" else 0.3)
        canvas.triangle(vertices, GREEN if self.result.passed else PINK, 3)
        canvas.dot(vertices[0], SKY, 6)
        return canvas.picture


def examples(seen: Extraction, of_each: int = 3) -> list[int]:
    """Rows of candidates of every fate: all doors, then some that each test rejected, spread over the drawing."""
    search = seen.door_search
    rows = np.flatnonzero(search.reasons == DOOR).tolist()
    for test in search.tests:
        lost = np.flatnonzero(search.reasons == TESTS.index(test))
        picks = np.linspace(0, len(lost) - 1, min(of_each, len(lost))).astype(int)
        rows += lost[picks].tolist()
    return [int(row) for row in rows]


def _fate(seen: Extraction, row: int) -> str:
    """What became of a candidate."""
    reason = int(seen.door_search.reasons[row])
    return "a door" if reason == DOOR else TESTS[reason]


def _word(result: TestResult) -> str:
    """Passed or failed, and never by colour alone."""
    return "\u2713 passed" if result.passed else "\u2717 FAILED"


def _asked(reading: Reading) -> str:
    """Measured value, threshold and verdict."""
    return str(reading).split(": ", 1)[1].replace(" yes", " \u2713").replace(" no", " \u2717")
