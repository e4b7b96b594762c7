"""A whole FastSLAM run to play, step through and scrub: the map so far, the particles, the way, and F2 over time."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import ipywidgets
import numpy as np
from numpy.typing import NDArray

from priorlab.core.building import Truth
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.picture import grey_of
from priorlab.core.score import score_map
from priorlab.mapping.over_time import OverTime, score_over_time
from priorlab.mapping.timeline import EvidenceOverTime
from priorlab.mapping.update import update_map
from priorlab.plot.style import BLACK, BLUE, RED
from priorlab.slam.recording import Run
from priorlab.slam.run_evidence import evidence_of_run
from priorlab.slam.scan import choose_beams
from priorlab.slam.trajectory_error import absolute_trajectory_error_m, position_errors_m, true_poses
from priorlab.widgets.canvas import BLUE as ESTIMATE
from priorlab.widgets.canvas import GREEN as TRUE_WAY
from priorlab.widgets.canvas import ORANGE as BEAMS
from priorlab.widgets.floor_canvas import FloorCanvas
from priorlab.widgets.lab import Lab, table
from priorlab.widgets.picture import Picture
from priorlab.widgets.plane import Plane
from priorlab.widgets.sliders import Slider

MARKED_AT = 0.5
"""Chapter 6 counts a cell as wall when P(empty) is below this."""

WITH, WITHOUT = "with the plan", "without"
PLAY_STEPS, PLAY_MS = 5, 200
CURVE_EVERY = 5
WAY_EVERY = 3
"""A way is drawn through every so-manyth pose: three steps of 5 cm are three pixels."""

MARGIN_M = 0.5
"""Paper that is left round the building."""

ZOOM, HALF_M = 3, 2.7
"""The window round the robot: screen pixels per cell, and half its side."""


@dataclass(frozen=True, eq=False)
class _Recorded:
    """A run with what its scans said, and F2 over its steps; `alone` is that of the plan."""

    run: Run
    evidence: EvidenceOverTime
    starts: dict[str, GridMap]
    alone: float
    curves: OverTime
    errors_m: NDArray[np.float64]


class RunLab(Lab):
    """Read `lab.run`, `lab.maps` (after the step of the slider), `lab.f2`, `lab.ate_m`, `lab.gain_percent`.

    Both maps take the same poses and scans; they differ in where they started.

    Parameters
    ----------
    runs : by name, all on one building whose true poses are known; `lab.which.value = name` shows another
    truth : what the scores count
    """

    def __init__(self, runs: Mapping[str, Run], truth: Truth) -> None:
        if not runs:
            raise ValueError("runs must hold at least one run, got none")
        self._truth = truth
        self._recorded = {name: _look_through(run, truth) for name, run in runs.items()}
        self._planes = lru_cache(maxsize=len(runs))(self._curves)
        first = next(iter(runs.values()))
        self._rows = _rows_of_building(first.prior_map, truth)
        last = len(first)
        self.step = Slider("step", last, 1, last, 1, "how many steps of algorithm 6.1 have been made")
        self.play = ipywidgets.Play(
            value=last, min=1, max=last, step=PLAY_STEPS, interval=PLAY_MS, show_repeat=False, tooltip="play"
        )
        self.back, self.on = (
            ipywidgets.Button(description=words, tooltip=words, layout=ipywidgets.Layout(width="auto"))
            for words in ("one step back", "one step on")
        )
        self.truth = ipywidgets.Checkbox(value=True, description="show the true way", indent=False)
        self.shown = ipywidgets.Dropdown(options=[WITH, WITHOUT], description="map:", layout=ipywidgets.Layout(width="auto"))
        self.which = ipywidgets.Dropdown(options=list(runs), description="run:", layout=ipywidgets.Layout(width="auto"))
        self.play.observe(self._played, "value")
        self.back.on_click(lambda _: self._go(-1))
        self.on.on_click(lambda _: self._go(1))
        for control in (self.truth, self.shown):
            control.observe(self._moved, "value")
        self.which.observe(self._other_run, "value")
        presets: dict[str, dict[str, float]] = {
            "the start": {"step": 1},
            "a tenth": {"step": max(1, last // 10)},
            "half": {"step": max(1, last // 2)},
            "the end": {"step": last},
        }
        controls = [self.play, self.back, self.on, self.shown, self.truth, *([self.which] if len(runs) > 1 else [])]
        super().__init__({"step": self.step}, presets, [Picture(), Picture(), Picture()], controls)

    def refresh(self) -> None:
        """The maps so far, the errors so far, and the pictures of this step."""
        recorded = self._recorded[self.which.value]
        self.run, k = recorded.run, int(self.step.value)
        self.play.value = k
        self.evidence = recorded.evidence.at(k)
        self.maps = {name: update_map(start, self.evidence, self.run.parameters.lam) for name, start in recorded.starts.items()}
        self.f2 = {name: score_map(one, self._truth, MARKED_AT).f_beta for name, one in self.maps.items()}
        self.alone = recorded.alone
        self.gain_percent = 100 * (self.f2[WITH] / self.f2[WITHOUT] - 1) if self.f2[WITHOUT] else float("nan")
        self.ate_m = absolute_trajectory_error_m(self.run.trajectory[:k], true_poses(self.run.log)[:k])
        self._show(recorded, k - 1)

    def set(self, **values: float) -> None:
        """Several at once; a step beyond the end of a shorter run is its last."""
        if "step" in values:
            values["step"] = min(values["step"], self.step.max)
        super().set(**values)

    def reset(self) -> None:
        """Everything back to where it stood at first."""
        self._held = True
        self.which.value, self.shown.value, self.truth.value = self.which.options[0], WITH, True
        self._held = False
        self._fit()
        super().reset()

    def summary(self) -> str:
        """The step and the numbers that matter, as coarsely as a filter's chance allows."""
        off = "LOST" if self.run.lost else f"ATE <= {math.ceil(self.ate_m / 0.25) * 0.25:.2f} m"
        return (
            f"{self.which.value}, step {self.step.value:.0f} of {len(self.run)}: {off}, "
            f"F2 >= {coarse(self.f2[WITH])} with, {coarse(self.f2[WITHOUT])} without, {coarse(self.alone)} plan alone"
        )

    # --- controls ------------------------------------------------------------------------------------------------

    def _played(self, change: Any) -> None:
        """The play button has moved on."""
        self.step.value = change["new"]

    def _go(self, by: int) -> None:
        """A step on or back, if there is one."""
        self.step.value = min(max(self.step.value + by, self.step.min), self.step.max)

    def _other_run(self, change: Any) -> None:
        """Another run, to its end."""
        if not self._held:
            self._fit()
            self.set(step=self.step.max)

    def _fit(self) -> None:
        """The slider ends where the run does."""
        last = len(self._recorded[self.which.value].run)
        self._held = True
        self.step.value = min(self.step.value, last)
        self.step.max = self.play.max = last
        self._held = False

    # --- pictures ------------------------------------------------------------------------------------------------

    def _show(self, recorded: _Recorded, k: int) -> None:
        """Pictures and numbers after the scan number k."""
        run, said = recorded.run, f"{self.summary()}."
        grey = grey_of(self.maps[self.shown.value].p_empty)
        particles, pose, truth = run.sample[k].astype(np.float64), run.trajectory[k], true_poses(run.log)

        floor = FloorCanvas(run.prior_map.grid, grey)
        if self.truth.value:
            floor.way(_way_to(truth, k), TRUE_WAY, 3)
        floor.way(_way_to(run.trajectory, k), ESTIMATE)
        floor.particles(particles)
        floor.robot(pose, ESTIMATE, 0.4)
        words = f"The map {self.shown.value}, white = empty, and the estimated way in blue. {said}"
        self.pictures[0].show(floor.picture[self._rows], words)

        near = FloorCanvas(run.prior_map.grid, grey, ZOOM, pose[:2], HALF_M)
        near.beams(pose, choose_beams(run.log, k, run.parameters).points, BEAMS)
        near.particles(particles, stroke_m=0.12)
        if self.truth.value:
            near.robot(truth[k], TRUE_WAY, 0.34)
        near.robot(pose, ESTIMATE, 0.2)
        self.pictures[1].show(near.picture, f"Round the robot: beams in orange, {len(particles)} particles in light blue. {said}")

        plane = self._planes(self.which.value).copy()
        plane.line([k + 1, k + 1], [0, 1], f"stroke='{BLACK}' stroke-dasharray='2 3'")
        for name, colour in ((WITH, BLUE), (WITHOUT, RED)):
            plane.points(k + 1, self.f2[name], "dot", colour, 5)
        self.pictures[2].show_svg(plane.svg(), f"F2 over the steps. {said}")
        self.readout.value = table(self._numbers(recorded, k), caption=f"detected as wall: P(empty) &lt; {MARKED_AT:g}")

    def _numbers(self, recorded: _Recorded, k: int) -> list[tuple[str, str]]:
        """The readout."""
        run, n, ess = recorded.run, int(recorded.run.n_particles[k]), float(recorded.run.ess[k])
        share = run.explained[k]
        told = "fewer than 10 beams" if np.isnan(share) else f"{100 * share:.0f} %"
        gain = "LOST: means nothing" if run.lost else f"{self.gain_percent:+.0f} %"
        whole = f"LOST: {run.lost_because}" if run.lost else "never lost"
        return [
            ("step", f"{k + 1} of {len(run)}"),
            ("particles N", f"{n}, ESS {ess:.0f} ({100 * ess / n:.0f} %)"),
            ("off the truth now", f"{100 * recorded.errors_m[k]:.0f} cm, ATE so far <b>{100 * self.ate_m:.0f} cm</b>"),
            ("beams explained by the plan", told),
            ("F2 with the plan", f"<b>{self.f2[WITH]:.3f}</b>"),
            ("F2 without, same poses", f"{self.f2[WITHOUT]:.3f}"),
            ("F2, the plan alone", f"{self.alone:.3f}"),
            ("gain of the plan", gain),
            ("cells seen", f"{100 * self.evidence.seen.mean():.0f} %"),
            ("the whole run", whole),
            ("colours", "blue: estimate, light blue: particles, green: truth, orange: beams"),
        ]

    def _curves(self, name: str) -> Plane:
        """F2 over all steps of a run."""
        recorded = self._recorded[name]
        end, curves = len(recorded.run), recorded.curves
        ticks = [round(end * share) for share in (0, 0.25, 0.5, 0.75, 1)]
        plane = Plane((0, end), (0, 1.05), ("step", "F2"), "F2 over time (fig. 6.6 E)", (340, 326), x_ticks=ticks)
        plane.line([0, end], [self.alone, self.alone], f"stroke='{BLACK}' stroke-width='1.5' stroke-dasharray='1 3'")
        plane.line(curves.steps, curves.f_beta[WITH], f"stroke='{BLUE}' stroke-width='2'")
        plane.line(curves.steps, curves.f_beta[WITHOUT], f"stroke='{RED}' stroke-width='2' stroke-dasharray='6 4'")
        names = (("dotted: the plan alone", BLACK), (WITH, BLUE), (f"dashed: {WITHOUT}", RED))
        for i, (words, colour) in enumerate(names):
            plane.words(end, 0.66 - 0.07 * i, f"{words}\u00a0", "end", f"fill='{colour}'")
        return plane


def coarse(f2: float) -> str:
    """A score cut to one decimal: what a filter's chance leaves of it.

    >>> coarse(0.77), coarse(0.3)
    ('0.7', '0.3')
    """
    return f"{math.floor(10 * f2 + 1e-9) / 10:.1f}"


def _way_to(poses: NDArray[np.float64], k: int) -> NDArray[np.float64]:
    """Some of the poses up to number k, and it."""
    return np.vstack([poses[:k:WAY_EVERY], poses[k]])


def _look_through(run: Run, truth: Truth) -> _Recorded:
    """What the scans of a run said, with the plan as the start and without."""
    evidence, prior_map = evidence_of_run(run), run.prior_map
    nothing = GridMap(np.zeros(prior_map.grid.shape), prior_map.grid, Prior.uninformed())
    starts = {WITH: prior_map, WITHOUT: nothing}
    alone = score_map(prior_map, truth, MARKED_AT).f_beta
    curves = score_over_time(evidence, starts, truth, run.parameters.lam, MARKED_AT, every=CURVE_EVERY)
    return _Recorded(run, evidence, starts, alone, curves, position_errors_m(run.trajectory, true_poses(run.log)))


def _rows_of_building(prior_map: GridMap, truth: Truth) -> slice:
    """The rows of cells that hold the building, and a little paper above and below."""
    rows = np.flatnonzero(prior_map.grid.any_in_cells(truth.walls).any(axis=1))
    margin = round(MARGIN_M / prior_map.grid.cell_size_m)
    return slice(max(0, int(rows[0]) - margin), int(rows[-1]) + margin + 1)
