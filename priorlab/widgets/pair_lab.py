"""Two maps of one run, fed by the same poses: with the plan and without. What is it that the gain hangs on?"""

from __future__ import annotations

import warnings
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from priorlab.core.building import Truth, World
from priorlab.core.drawing import Walls
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.readings import Evidence
from priorlab.core.score import Score
from priorlab.mapping.overruled import OverruledSensorWarning, overruled_readings
from priorlab.mapping.prior import build_prior_map
from priorlab.mapping.update import update_map
from priorlab.plot.extraction import LEGEND, scored_image
from priorlab.slam.recording import Run
from priorlab.slam.run_evidence import evidence_of_run
from priorlab.study.added import changes_between, what_was_added
from priorlab.study.worth import worth_of
from priorlab.widgets.lab import Lab, table
from priorlab.widgets.picture import Picture
from priorlab.widgets.run_lab import coarse
from priorlab.widgets.sliders import Slider

STEP_M = 0.05
THICKEST_M = 0.20
WIDTH = 860
"""A map on the screen has at most so many columns: every second pixel of a larger plan is shown."""

MARGIN_PX = 20
"""Paper that is left above and below the building."""

PRESETS: dict[str, dict[str, float]] = {
    "Table 6.1's prior": {"p_wall": 0.3, "p_space": 0.8, "lam": 1, "thickening_m": 0.1, "threshold": 0.5},
    "textbook (lam = 0)": {"lam": 0},
    "the hit's cell alone": {"thickening_m": 0},
    "the prior of chapter 4": {"p_wall": 0.2, "p_space": 0.9},
    "threshold 0.2": {"threshold": 0.2},
}


class PairLab(Lab):
    """Read `lab.worth` (scores of the pair, coverage), `lab.added` (what the robot added), `lab.map`, `lab.without`.

    Parameters
    ----------
    run : poses and scans; they stay as they are
    walls : of the plan, for other priors
    truth, world : what the scores count, and what stands in the building
    """

    def __init__(self, run: Run, walls: Walls, truth: Truth, world: World) -> None:
        self._run, self._walls, self._truth = run, walls, truth
        self._grid = run.prior_map.grid
        self._changes = changes_between(truth, world, self._grid)
        thicknesses = np.arange(0, THICKEST_M + STEP_M / 2, STEP_M).round(6).tolist()
        self._evidence = {one: _evidence_of(run, one) for one in thicknesses}
        self.p_wall = Slider("p_wall", 0.3, 0.05, 1.0, 0.01, "P(empty) where the plan shows a wall, before the factor 0.9")
        self.p_space = Slider("p_space", 0.8, 0.05, 1.0, 0.01, "P(empty) where the plan shows space, before the factor 0.9")
        self.lam = Slider("lam", 1, 0, 1, 0.05, "1: eq. 6.2 as printed, l0 comes off with every scan; 0: never")
        self.thickening_m = Slider("thickening, m", 0.1, 0, THICKEST_M, STEP_M, "how far behind a hit the wall is drawn")
        self.threshold = Slider("threshold", 0.5, 0.05, 0.5, 0.05, "at or below this P(empty) a cell counts as wall")
        names = ("p_wall", "p_space", "lam", "thickening_m", "threshold")
        (rows, cols), self._small = _shown_pixels(truth)
        self._cells = np.ix_(self._grid.row_of_pixel[rows], self._grid.col_of_pixel[cols])
        self._without = {one: _without_plan(said) for one, said in self._evidence.items()}
        self._drawn: tuple[float, float] | None = None  # thickening and threshold of the picture without a plan
        pictures = [Picture(), Picture()]
        super().__init__({name: getattr(self, name) for name in names}, PRESETS, pictures)

    def refresh(self) -> None:
        """The two maps, their scores, and what the robot added."""
        lam, self.prior = round(self.lam.value, 6), Prior(self.p_wall.value, self.p_space.value)
        thickening_m = round(self.thickening_m.value, 6)
        self.evidence, self.without = self._evidence[thickening_m], self._without[thickening_m]
        start = build_prior_map(self._walls, self.prior, cell_size=self._grid.cell_size)
        self.map = _updated(start, self.evidence, lam)
        threshold = round(self.threshold.value, 6)
        self.worth = worth_of(start, self.evidence, self._truth, lam, threshold)
        maps = {"with": self.map, "without": self.without, "alone": start}
        self.added = what_was_added(self._changes, self.evidence.seen, maps, threshold)

        words = f"With the plan. {LEGEND}. F2 {self.worth.informed.f_beta:.3f}. {self.summary()}"
        self.pictures[0].show(self._counted(self.map, threshold), words)
        if self._drawn != (here := (thickening_m, threshold)):  # no other slider changes it
            words = f"Without a plan, same poses and scans. {LEGEND}. F2 {self.worth.uninformed.f_beta:.3f}"
            self.pictures[1].show(self._counted(self.without, threshold), words)
            self._drawn = here
        sign = "&lt;" if threshold == 0.5 else "&le;"  # a cell at 0.5 knows nothing
        self.readout.value = table(self._numbers(), caption=f"detected as wall: P(empty) {sign} {threshold:g}")

    def summary(self) -> str:
        """The sliders and the pair, as coarsely as a filter's chance allows."""
        worth = self.worth
        return (
            f"p_wall {self.p_wall.value:g}, p_space {self.p_space.value:g}, lam {self.lam.value:g}, "
            f"{self.thickening_m.value:g} m thick, at {self.threshold.value:g}: F2 >= {coarse(worth.informed.f_beta)} with, "
            f"{coarse(worth.uninformed.f_beta)} without, {coarse(worth.alone.f_beta)} plan alone"
        )

    def _counted(self, grid_map: GridMap, threshold: float) -> NDArray[np.uint8]:
        """A map as the score counts it."""
        return scored_image(grid_map.detected(threshold)[self._cells], self._small)

    def _numbers(self) -> list[tuple[str, str]]:
        """The readout: never a gain without the way's error, what was seen, and the plan alone."""
        worth, run, added = self.worth, self._run, self.added
        sensor = self.evidence.sensor
        broken = overruled_readings(self.prior, sensor.p_free, sensor.p_occupied, self.lam.value)
        lost = f"LOST: {run.lost_because}" if run.lost else f"{100 * run.ate_m():.0f} cm, never lost"
        blocked, opened = added.blocked, added.opened
        return [
            ("<b>F2 with the plan</b> (above)", f"<b>{worth.informed.f_beta:.3f}</b> {_why(worth.informed)}"),
            ("<b>F2 without</b> (below)", f"<b>{worth.uninformed.f_beta:.3f}</b> {_why(worth.uninformed)}"),
            ("F2, the plan alone", f"{worth.alone.f_beta:.3f}"),
            ("gain of the plan", "LOST: means nothing" if run.lost else f"<b>{worth.gain_percent:+.0f} %</b>"),
            ("ATE of the poses", lost),
            ("coverage", f"{100 * worth.coverage:.0f} % of the walls seen, {worth.mean_looks:.1f} looks a seen cell"),
            ("where it looked: with, without", f"{worth.seen_informed.f_beta:.3f}, {worth.seen_uninformed.f_beta:.3f}"),
            (f"furniture, {blocked.seen} cells seen: shown", _shares(blocked.share)),
            (f"opened walls, {opened.seen} cells seen: shown free", _shares(opened.share)),
            ("eq. 2.22", broken.replace("; ", ";<br>").replace(": each", ":<br>each") if broken else "holds"),
            ("colours", LEGEND.replace(", light", ",<br>light", 1)),
        ]


def _shown_pixels(truth: Truth) -> tuple[tuple[NDArray[np.int64], NDArray[np.int64]], Truth]:
    """Rows and columns of the pixels that are shown, and the truth there."""
    height, width = truth.shape
    every = max(1, width // WIDTH)
    walls = np.flatnonzero(truth.walls.any(axis=1))
    rows = np.arange(max(0, int(walls[0]) - MARGIN_PX), min(height, int(walls[-1]) + MARGIN_PX), every)
    cols = np.arange(0, width, every)
    return (rows, cols), Truth(truth.walls[np.ix_(rows, cols)], truth.ignore[np.ix_(rows, cols)])


def _evidence_of(run: Run, thickening_m: float) -> Evidence:
    """What the scans of a run said, had the walls been drawn so thick."""
    return evidence_of_run(run, replace(run.parameters, thickening_m=thickening_m)).at(len(run))


def _without_plan(evidence: Evidence) -> GridMap:
    """The map that starts at 0.5: whatever lam is, it takes nothing off."""
    return update_map(GridMap(np.zeros(evidence.grid.shape), evidence.grid, Prior.uninformed()), evidence)


def _updated(start: GridMap, evidence: Evidence, lam: float) -> GridMap:
    """The map, whatever eq. 2.22 says: the readout tells it."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", OverruledSensorWarning)
        return update_map(start, evidence, lam)


def _why(score: Score) -> str:
    """Precision and recall behind an F2."""
    return f"(precision {score.precision:.2f}, recall {score.recall:.2f})"


def _shares(share: dict[str, float]) -> str:
    """With the plan, without, and the plan alone, per cent."""
    return f"with {100 * share['with']:.0f} %, without {100 * share['without']:.0f} %, plan alone {100 * share['alone']:.0f} %"
