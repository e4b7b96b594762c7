"""The prior at which each cell of a map flips, and what flips under the sliders."""

from __future__ import annotations

import warnings
from dataclasses import replace
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.grid_map import Prior
from priorlab.core.log_odds import log_odds
from priorlab.core.score import Score
from priorlab.mapping.overruled import OverruledSensorWarning
from priorlab.optimize.experiment import Experiment
from priorlab.optimize.sweep import Sweep
from priorlab.plot.style import BLUE, RED
from priorlab.widgets.lab import Lab, table
from priorlab.widgets.picture import Picture
from priorlab.widgets.plane import Plane
from priorlab.widgets.sliders import Slider

PRESETS: dict[str, dict[str, float]] = {
    "the thesis's prior": {"p_wall": 0.2, "p_space": 0.9, "lam": 1},
    "just over the cliff": {"p_wall": 0.23},
    "walls called empty": {"p_wall": 1.0},
    "too sure of space": {"p_space": 1.0},
    "textbook (lam = 0)": {"lam": 0},
}
START = Prior(0.2, 0.9)
NEVER_SEEN, ALWAYS_WALL, NEVER_WALL = (214, 214, 214), (0, 0, 0), (255, 255, 255)
LOW, HIGH = (0, 114, 178), (255, 234, 70)
"""Blue for a flip at 0, yellow for one at 1 or never: both stand out from black, white and grey."""
GAINED, LOST = (213, 94, 0), (86, 180, 233)
"""Cells that became a wall, and that are none any more, since the thesis's prior."""
CURVE = np.linspace(0.02, 1.0, 197)


class FlipLab(Lab):
    """Read `lab.critical`, `lab.direction`, `lab.detected`, `lab.gained`, `lab.lost`, `lab.score`.

    Parameters
    ----------
    experiment : walls, evidence and truth
    width : of a map on the screen, CSS pixels

    Attributes
    ----------
    critical : (rows, cols) P(empty), before the factor, at which each cell flips; nan where no prior matters
    direction : (rows, cols) -1 wall at or below it, 1 wall at or above it, 0 whatever the prior
    detected : (rows, cols) which cells are walls with the prior of the sliders
    gained, lost : cells that are walls now and were not with (0.2, 0.9) and the same lam, and the other way round
    """

    def __init__(self, experiment: Experiment, width: int = 330) -> None:
        self._experiment = experiment
        self._of = lru_cache(maxsize=8)(self._every_flip)
        self._shown: NDArray[np.uint8] | None = None
        self.p_wall = Slider("p_wall", START.p_wall, 0.02, 1.0, 0.01, "P(empty) where the plan shows a wall, before 0.9")
        self.p_space = Slider("p_space", START.p_space, 0.02, 1.0, 0.01, "P(empty) where the plan shows space, before 0.9")
        self.lam = Slider("lam", experiment.lam, 0, 1, 0.05, "1: the thesis's update takes l0 off at every reading; 0: never")
        sliders = {"p_wall": self.p_wall, "p_space": self.p_space, "lam": self.lam}
        super().__init__(sliders, PRESETS, [Picture(width=width), Picture(width=330), Picture(width=width)])

    def refresh(self) -> None:
        """One sweep for a lam; then a map for the prior."""
        self.experiment, self.sweep, self.critical, before, flips, curve = self._of(round(self.lam.value, 6))
        self.direction = self.sweep.direction
        self.prior = Prior(self.p_wall.value, self.p_space.value, self.experiment.factor)
        self.score: Score = self.sweep.at(self.prior.p_wall, self.prior.p_space)
        self.detected = now = self._detected(self.experiment, self.prior)
        self.gained, self.lost = int((now & ~before).sum()), int((before & ~now).sum())
        if flips is not self._shown:
            self._shown = flips
            self.pictures[0].show(
                flips,
                "For every cell the prior at which it flips: blue 0 to yellow 1; light grey: never seen, all flip at "
                f"{self.sweep.threshold / self.sweep.factor:.3f}; black and white: wall or not, whatever the prior",
            )
        plane = curve.copy()
        for p, colour in ((self.prior.p_wall, BLUE), (self.prior.p_space, RED)):
            plane.line([p, p], [0, 1], f"stroke='{colour}' stroke-width='1.5' stroke-dasharray='5 3'")
        self.pictures[1].show_svg(
            plane.svg(), f"Share of the plan's walls and space called wall over their prior. {self.summary()}"
        )
        self.pictures[2].show(self._changes(now, before), f"Orange: became wall, light blue: no longer wall. {self.summary()}")
        self._tell()

    def summary(self) -> str:
        """The sliders and what flipped."""
        return (
            f"p_wall {self.p_wall.value:.2f}, p_space {self.p_space.value:.2f}, lam {self.lam.value:.2f}: "
            f"{self.gained} cells became wall, {self.lost} no longer are; F{self.score.beta:g} {self.score.f_beta:.3f}"
        )

    def _every_flip(self, lam: float) -> tuple[Experiment, Sweep, NDArray, NDArray[np.bool_], NDArray[np.uint8], Plane]:
        """All that depends on lam alone: the flips, the walls of the thesis's prior, and two pictures."""
        experiment = replace(self._experiment, lam=lam)
        sweep = experiment.sweep()
        critical, before = sweep.critical(), self._detected(experiment, START)
        return experiment, sweep, critical, before, _picture_of_flips(experiment, sweep, critical), _curves(experiment, sweep)

    @staticmethod
    def _detected(experiment: Experiment, prior: Prior) -> NDArray[np.bool_]:
        """Which cells are walls."""
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", OverruledSensorWarning)
            return experiment.map(prior).detected(experiment.threshold)

    def _changes(self, now: NDArray[np.bool_], before: NDArray[np.bool_]) -> NDArray[np.uint8]:
        """Walls black, and what flipped."""
        cells = np.where(now[..., None], np.uint8(0), np.uint8(255)).repeat(3, axis=2)
        cells[now & ~before] = GAINED
        cells[before & ~now] = LOST
        return cells

    def _tell(self) -> None:
        """The numbers."""
        looks = self.experiment.evidence.looks
        kinds = (("never seen", looks == 0), ("seen once", looks == 1), ("seen twice or more", looks >= 2))
        says = {-1: "wall at or below their flip", 0: "no prior matters", 1: "wall at or above their flip"}
        rows = [
            (f"cells {name}", f"{which.sum():,}: {says[int(self.direction[which][0])]}" if which.any() else "none")
            for name, which in kinds
        ]
        edge = self.sweep.threshold / self.sweep.factor
        rows += [
            ("unseen cells flip at", f"{self.sweep.threshold:g} / 0.9 = {edge:.4f}"),
            ("became wall since (0.2, 0.9)", f"<b>{self.gained:,} cells</b>, orange on the right"),
            ("no longer wall", f"<b>{self.lost:,} cells</b>, light blue"),
            ("precision, recall, F2", f"{self.score.precision:.3f}, {self.score.recall:.3f}, <b>{self.score.f_beta:.3f}</b>"),
            ("left: flips at", "blue 0 ... yellow 1;<br>light grey: never seen; black, white: no prior matters"),
        ]
        self.readout.value = table(rows, caption="the prior at which each cell flips")


def flip_colours(critical: ArrayLike) -> NDArray[np.uint8]:
    """(..., 3) colours of critical priors: blue at 0, yellow at 1, straight between; nan as 0.

    >>> flip_colours([[0.0, 0.5, 1.0]]).tolist()
    [[[0, 114, 178], [128, 174, 124], [255, 234, 70]]]
    """
    share = np.clip(np.nan_to_num(np.asarray(critical, dtype=np.float64)), 0, 1)[..., None]
    return np.rint(np.array(LOW) + share * (np.array(HIGH) - LOW)).astype(np.uint8)


def _picture_of_flips(experiment: Experiment, sweep: Sweep, critical: NDArray[np.float64]) -> NDArray[np.uint8]:
    """Critical priors as colours."""
    cells = flip_colours(critical)
    fixed = sweep.direction == 0
    is_wall = experiment.map(Prior.uninformed()).detected(experiment.threshold)  # any prior: these cells do not ask
    cells[fixed & is_wall], cells[fixed & ~is_wall] = ALWAYS_WALL, NEVER_WALL
    cells[~experiment.evidence.seen] = NEVER_SEEN
    return cells


def _curves(experiment: Experiment, sweep: Sweep) -> Plane:
    """Share of each class's true-wall pixels (plan's walls) and false pixels (plan's space) detected over its prior."""
    plane = Plane((0, 1), (0, 1), ("prior of the class, before the factor", "share called wall"), "what a prior calls wall")
    edge = sweep.threshold / sweep.factor
    plane.line([edge, edge], [0, 1], "stroke='#777' stroke-dasharray='2 3'")
    l_0 = log_odds(CURVE * sweep.factor)
    for steps, cells, colour in ((sweep.wall, experiment.wall_cells, BLUE), (sweep.space, ~experiment.wall_cells, RED)):
        tp, fp = steps.counts(l_0)
        plane.line(CURVE, (tp + fp) / max(1, int(experiment.pixels[:, cells].sum())), f"stroke='{colour}' stroke-width='2'")
    plane.words(0.45, 0.9, "blue: plan's walls", style=f"fill='{BLUE}'")
    plane.words(0.45, 0.82, "orange: plan's space", style=f"fill='{RED}'")
    return plane
