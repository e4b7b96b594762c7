"""Algorithm 6.2 one stage after the other: sample, weigh, estimate, resample; and play it through (fig. 2.7)."""

from __future__ import annotations

import copy
from collections.abc import Mapping
from functools import lru_cache

import ipywidgets
import numpy as np
from numpy.typing import NDArray

from priorlab.core.grid_map import GridMap
from priorlab.core.picture import grey_of
from priorlab.core.readings import RobotLog
from priorlab.slam.fastslam import FastSLAM
from priorlab.slam.kld import number_bins, pose_bins
from priorlab.slam.parameters import Parameters
from priorlab.slam.state import State, Step
from priorlab.widgets.canvas import GREEN, PINK
from priorlab.widgets.floor_canvas import FloorCanvas
from priorlab.widgets.lab import Lab, table
from priorlab.widgets.picture import Picture
from priorlab.widgets.sliders import Slider

STAGES = ("sample", "weigh", "estimate", "resample")
DONE = {
    "start": "none: it stands at its start",
    "sample": "1 <b>sample</b> (eq. 2.6): moved as the<br>wheels say, with noise of its own",
    "weigh": "2 <b>weigh</b> (eq. 2.7): how well does<br>each explain the scan?",
    "estimate": "3 <b>estimate</b>: the mean of the<br>heaviest cluster",
    "resample": "4 <b>resample</b> (alg. 6.2): drawn by<br>weight; now all weigh the same",
}
SKIPPED = "left out: no beam returned, or it<br>hardly moved since the last that did"
HALF_M, ZOOM = 3.0, 3


class StepLab(Lab):
    """Step with the buttons, play, or `lab.next()`; read `lab.stage`, `lab.step`, `lab.particles`, `lab.pose`, `lab.error_m`.

    Parameters
    ----------
    grid_map : the plan, on a grid that knows its scale
    log : a drive with its truth
    filters : parameters by a name; the first is shown at first, `lab.filter.value = name` shows another
    rng : of the filter; each of `filters` gets the same numbers
    width : of the floor on the screen, CSS pixels

    Attributes
    ----------
    stage : "start", "sample", "weigh", "estimate" or "resample"
    step : the step that the stage belongs to, from 1; 0 at the start
    particles : as they are after the stage
    pose : (3,) the last estimate; None before the first
    error_m : its distance to the true position of its step, metres
    """

    def __init__(
        self, grid_map: GridMap, log: RobotLog, filters: Mapping[str, Parameters], rng: np.random.Generator, width: int = 600
    ) -> None:
        if log.truth is None:
            raise ValueError("log must hold its truth for this lab, got none")
        self._map, self._log, self._truth, self._filters = grid_map, log, log.truth, dict(filters)
        self._rng, self._last = copy.deepcopy(rng), len(STAGES) * len(log)
        self._run_of = lru_cache(maxsize=None)(self._start_run)
        self._grey = grey_of(grid_map.p_empty / grid_map.p_empty.max())
        self._paper = FloorCanvas(grid_map.grid, self._grey, faint=0.3)
        self._paper.way(log.truth, GREEN)
        self.at = Slider("stages done", 0, 0, self._last, 1, "four stages a step: sample, weigh, estimate, resample")
        self.filter = ipywidgets.Dropdown(options=list(filters), description="filter:", layout=ipywidgets.Layout(width="auto"))
        self.filter.observe(self._moved, "value")
        self.play = ipywidgets.Play(min=0, max=self._last, interval=400, show_repeat=False, tooltip="play the stages")
        ipywidgets.link((self.play, "value"), (self.at, "value"))
        moves = [self._mover("one back", -1), self._mover("next stage", 1, "primary"), self._mover("a whole step", len(STAGES))]
        presets: dict[str, dict[str, float]] = {
            "before the first step": {"at": 0},
            "half way": {"at": len(STAGES) * (len(log) // 2)},
            "the end": {"at": self._last},
        }
        super().__init__({"at": self.at}, presets, [Picture(width=width), Picture(width=330)], [*moves, self.play, self.filter])

    def next(self, by: int = 1) -> None:
        """Take the next stage (or, with -1, the last one back); at the ends nothing happens."""
        self.at.value = float(np.clip(self.at.value + by, 0, self._last))

    def refresh(self) -> None:
        """The stage, its numbers, its pictures."""
        done = int(self.at.value)
        self.step = (done + len(STAGES) - 1) // len(STAGES)
        start, steps = self._steps(self.step)
        self.stage = STAGES[(done - 1) % len(STAGES)] if done else "start"
        now = steps[self.step - 1] if done else None
        before = steps[self.step - 2].pose if self.step > 1 else None
        self._skipped = now is not None and now.weighed is now.moved  # the scan did not weigh (`weigh_every_m`), or had no return
        if now is None:
            self.particles, self.pose = start.particles, None
        else:
            at_stage = {"sample": now.moved, "weigh": now.weighed, "estimate": now.weighed, "resample": now.particles}
            self.particles = at_stage[self.stage]
            self.pose = now.pose if self.stage in ("estimate", "resample") else before
        self.truth = self._truth[max(self.step - 1, 0)]
        then = self.truth if self.stage in ("estimate", "resample") else self._truth[max(self.step - 2, 0)]
        self.error_m = float("nan") if self.pose is None else float(np.hypot(*(self.pose - then)[:2]))
        self._show(now if self.stage in ("estimate", "resample") else None)

    def reset(self) -> None:
        """To the start, with the first filter."""
        self._held = True
        self.filter.value = next(iter(self._filters))
        super().reset()

    def summary(self) -> str:
        """Where the run is, and its numbers."""
        error = "" if self.pose is None else f", estimate {100 * self.error_m:.0f} cm off"
        return (
            f"{self.filter.value}, step {self.step}, {self.stage}: N {len(self.particles)}, "
            f"ESS {self.particles.effective_number:.0f}{error}"
        )

    def _start_run(self, name: str) -> tuple[State, State, list[Step]]:
        """The state at the start, the one that moves on, and the steps made so far."""
        fastslam = FastSLAM(self._filters[name])
        start, moving = (fastslam.start(self._map, self._log, copy.deepcopy(self._rng)) for _ in range(2))
        return start, moving, []

    def _steps(self, n_steps: int) -> tuple[State, list[Step]]:
        """The start and at least the first steps of the chosen filter; what was made before is kept."""
        start, moving, steps = self._run_of(self.filter.value)
        while len(steps) < n_steps:
            steps.append(FastSLAM(self._filters[self.filter.value]).step(moving))
        return start, steps

    def _mover(self, words: str, by: int, style: str = "") -> ipywidgets.Button:
        """A button that goes some stages on."""
        button = ipywidgets.Button(description=words, button_style=style, layout=ipywidgets.Layout(width="auto"))
        button.on_click(lambda _: self.next(by))
        return button

    def _show(self, seen_from: Step | None) -> None:
        """Both pictures and the numbers; with the scan, once there is an estimate to see it from."""
        weights = self.particles.weights
        floor = copy.copy(self._paper)
        floor.picture = self._paper.picture.copy()
        floor.particles(self.particles.poses, weights)
        near = FloorCanvas(self._map.grid, self._grey, ZOOM, self.truth[:2], HALF_M, faint=0.3)
        near.way(self._truth, GREEN)
        near.particles(self.particles.poses, weights, stroke_m=0.2)
        if seen_from is not None:
            near.beams(seen_from.pose, seen_from.scan.points, PINK)
        for canvas, size in ((floor, 0.6), (near, 0.15)):
            canvas.robot(self.truth, GREEN, size)
            if self.pose is not None:
                canvas.robot(self.pose, PINK, size)
        self.pictures[0].show(floor.picture, f"The floor, all particles on it. {self.summary()}")
        self.pictures[1].show(near.picture, f"Six metres round the robot; a heavy particle is redder. {self.summary()}")
        self.readout.value = table(self._rows(weights), caption=f"filter: {self.filter.value}")

    def _rows(self, weights: NDArray[np.float64]) -> list[tuple[str, str]]:
        """The numbers beside the pictures."""
        parameters, n = self._filters[self.filter.value], len(self.particles)
        n_bins = len(number_bins(pose_bins(self.particles.poses, parameters))[0])
        spread = float(np.sqrt(self.particles.poses[:, :2].var(axis=0).sum()))
        return [
            ("step", f"{self.step} of {len(self._log)}"),
            ("last stage", SKIPPED if self._skipped and self.stage in ("weigh", "resample") else DONE[self.stage]),
            ("particles N", f"<b>{n}</b>"),
            ("effective number", f"<b>{self.particles.effective_number:.0f}</b>"),
            ("heaviest weight, x N", f"{n * weights.max():.2f}"),
            ("spread", f"{spread:.2f} m, {n_bins} bins"),
            ("last estimate", "none yet" if self.pose is None else f"<b>{100 * self.error_m:.0f} cm</b> from the truth"),
            ("particles", "blue: light, orange: heavy"),
            ("green, pink", "the truth; the estimate,<br>and the scan as seen from it"),
        ]
