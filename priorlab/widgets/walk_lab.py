"""One walk of algorithm 3.1, pixel by pixel: where it stands, the three pixels it tests, and which of them it takes."""

from __future__ import annotations

from collections.abc import Mapping

import ipywidgets
import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.drawing.connectivity import walk
from priorlab.drawing.walk_steps import walk_steps
from priorlab.widgets.canvas import BLUE, GREEN, ORANGE, PINK, RED, Canvas, window_round
from priorlab.widgets.lab import Lab, table
from priorlab.widgets.picture import Picture
from priorlab.widgets.sliders import Slider

Pair = tuple[tuple[int, int], tuple[int, int]]


class WalkLab(Lab):
    """Step with the buttons or with `lab.step()`; read `lab.walk`, `lab.now`, `lab.reached`.

    Parameters
    ----------
    ink : (height, width) bool
    pairs : by name, (origin, goal) in whole pixels x, y; each becomes a button
    reach : the walk has arrived within so many pixels of the goal
    width : of the picture on the screen, CSS pixels

    Attributes
    ----------
    walk : the whole walk, with its path
    now : what it saw where it stands, a `WalkStep`
    reached : whether it arrives
    """

    def __init__(self, ink: ArrayLike, pairs: Mapping[str, Pair], reach: int = 2, width: int = 420) -> None:
        self._ink, self._pairs, self._reach = np.asarray(ink, dtype=bool), dict(pairs), reach
        longest = max(len(walk(ink, *pair, reach).path) for (a, b) in pairs.values() for pair in ((a, b), (b, a)))
        self.pair = Slider("pair", 1, 1, len(pairs), 1, "which two corners")
        self.back = Slider("backwards", 0, 0, 1, 1, "1: from the second corner to the first")
        self.at = Slider("steps taken", 0, 0, longest - 1, 1, "0: the walk stands at its start")
        ahead = ipywidgets.Button(description="next pixel", button_style="primary", layout=ipywidgets.Layout(width="auto"))
        behind = ipywidgets.Button(description="one back", layout=ipywidgets.Layout(width="auto"))
        end = ipywidgets.Button(description="to its end", layout=ipywidgets.Layout(width="auto"))
        ahead.on_click(lambda _: self.step(1))
        behind.on_click(lambda _: self.step(-1))
        end.on_click(lambda _: self.step(longest))
        presets = {name: {"pair": place, "back": 0, "at": 0} for place, name in enumerate(pairs, start=1)}
        super().__init__(
            {"pair": self.pair, "back": self.back, "at": self.at}, presets, [Picture(width=width)], [behind, ahead, end]
        )

    def step(self, by: int = 1) -> None:
        """Take the next pixel (or, with -1, the last one back); where the walk ends nothing happens."""
        self.at.value = float(np.clip(self.at.value + by, 0, len(self.walk.path) - 1))

    def refresh(self) -> None:
        """The walk, and what it saw where it stands."""
        self.name = list(self._pairs)[int(self.pair.value) - 1]
        origin, goal = self._pairs[self.name][:: -1 if self.back.value else 1]
        self.walk, steps = walk_steps(self._ink, origin, goal, self._reach)
        self.reached = self.walk.reached
        place = min(int(self.at.value), len(steps) - 1)
        self.now, at_end = steps[place], place == len(steps) - 1
        self.readout.value = table(self._rows(place, goal, at_end), caption=f"from {origin} to {goal}")
        self.pictures[0].show(self._paint(place, origin, goal, at_end), f"A walk on ink, magnified. {self.summary()}")

    def summary(self) -> str:
        """How far the walk is, and how it ends."""
        taken = min(int(self.at.value), len(self.walk.path) - 1)
        ends = "arrives" if self.reached else "does not arrive"
        return f"{self.name}: at {self.now.at} after {taken} of {len(self.walk.path) - 1} steps, n_d = {self.now.n_dark}; {ends}"

    def _rows(self, place: int, goal: tuple[int, int], at_end: bool) -> list[tuple[str, str]]:
        """The numbers under the picture."""
        seen = self.now
        rows = [("stands at (x, y)", f"{seen.at}, after {place} steps")]
        for point, dark, distance in zip(seen.neighbours, seen.dark, seen.distances, strict=True):
            taken = " <b>&larr; taken</b>" if point == seen.chosen else ""
            rows.append((f"P<sub>n</sub> {point}", f"{'dark' if dark else 'white'}, d = {distance:.2f}{taken}"))
        rows.append(("n<sub>d</sub>, dark ones", f"{seen.n_dark}"))
        left = max(abs(goal[0] - seen.at[0]), abs(goal[1] - seen.at[1]))
        if at_end:
            why = f"arrived: {left} px from the goal" if self.reached else f"stuck, {left} px from the goal: not connected"
            rows.append(("<b>the end</b>", f"<b>{why}</b>"))
        return [*rows, ("picture", "green: walked, orange: P<sub>n</sub>, blue dot: goal")]

    def _paint(self, place: int, origin: tuple[int, int], goal: tuple[int, int], at_end: bool) -> NDArray[np.uint8]:
        """The ink round both corners, the way so far, the three pixels ahead."""
        window = window_round([origin, goal], margin=6)
        canvas = Canvas(np.where(self._ink, 0, 255).astype(np.uint8), max(1, 840 // window[2]), window)
        canvas.fill(self.walk.path[: place + 1], GREEN)
        if not (at_end and self.reached):
            canvas.fill(self.now.neighbours, ORANGE, 0.55)
            for point in self.now.neighbours:
                canvas.ring(point, RED)
        canvas.ring(self.now.at, PINK, max(2, canvas.zoom // 5))
        canvas.dot(goal, BLUE, max(4, canvas.zoom // 3))
        return canvas.picture
