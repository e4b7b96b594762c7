"""Two prior sliders that move the map, its score and its place on the Pareto front; and the threshold that moves the optimum."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from priorlab.core.grid_map import Prior
from priorlab.mapping.overruled import OverruledSensorWarning, overruled_readings
from priorlab.optimize.exact_front import Best
from priorlab.optimize.experiment import Experiment
from priorlab.optimize.front import BOUNDS, FLOOR, Front
from priorlab.optimize.sweep import Sweep
from priorlab.plot.extraction import LEGEND, scored_image
from priorlab.plot.style import BLACK, BLUE, GREEN, ORANGE, RED
from priorlab.widgets.lab import Lab, table
from priorlab.widgets.picture import Picture
from priorlab.widgets.plane import Plane
from priorlab.widgets.sliders import Slider

PRESETS: dict[str, dict[str, float]] = {
    "the thesis's prior": {"p_wall": 0.2, "p_space": 0.9, "threshold": 0.2, "lam": 1},
    "highest precision": {"p_wall": 0.3, "p_space": 0.3},
    "everything is a wall": {"p_wall": 1.0, "p_space": 0.2},
    "threshold 0.4": {"threshold": 0.4},
    "textbook (lam = 0)": {"lam": 0},
}
COLUMNS = np.linspace(*BOUNDS, 180, endpoint=False) + 0.0025
"""The middles of the colour maps' columns and rows."""

MEASURES = ("precision", "recall")

OTHERS = (("square", GREEN, "stroke-dasharray='5 3'"), ("dot", ORANGE, "stroke-dasharray='2 3'"))


class SweepLab(Lab):
    """Read `lab.score`, `lab.front`, `lab.best`, `lab.sweep`, `lab.beaten_by`.

    Parameters
    ----------
    experiment : walls, evidence and truth; its threshold and lam are where those sliders start
    fronts : others to draw beside the exact one, such as what NSGA-II found; shown while threshold and lam are the experiment's
    width : of a picture on the screen, CSS pixels

    Attributes
    ----------
    score : of the map under the sliders
    front, best : exact front and optimum of F-beta for the threshold and lam of the sliders
    beaten_by : how many points of the front are better in both measures, or in one and equal in the other
    """

    def __init__(self, experiment: Experiment, fronts: Mapping[str, Front] | None = None, width: int = 330) -> None:
        self._experiment, self._fronts = experiment, dict(fronts or {})
        self._of = lru_cache(maxsize=16)(self._every_prior)
        self.p_wall = Slider("p_wall", 0.2, 0.1, 1.0, 0.01, "P(empty) where the plan shows a wall, before the factor 0.9")
        self.p_space = Slider("p_space", 0.9, 0.1, 1.0, 0.01, "P(empty) where the plan shows space, before the factor 0.9")
        self.threshold = Slider("threshold", experiment.threshold, 0.1, 0.5, 0.01, "P(empty) at or below which a cell is a wall")
        self.lam = Slider("lam", experiment.lam, 0, 1, 0.05, "1: the thesis's update takes l0 off at every reading; 0: never")
        sliders = {"p_wall": self.p_wall, "p_space": self.p_space, "threshold": self.threshold, "lam": self.lam}
        super().__init__(sliders, PRESETS, [Picture(width=width) for _ in range(4)])

    def refresh(self) -> None:
        """One sweep for a threshold and a lam; then the prior is a look-up and a map."""
        threshold, lam = round(self.threshold.value, 6), round(self.lam.value, 6)
        self.experiment, self.sweep, self.front, self.best, self._planes = self._of(threshold, lam)
        self.prior = Prior(self.p_wall.value, self.p_space.value, self._experiment.factor)
        self.score = self.sweep.at(self.prior.p_wall, self.prior.p_space)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", OverruledSensorWarning)  # the readout says it, at every move
            self.map = self.experiment.map(self.prior)
        precision, recall = np.nan_to_num(self.score.precision), self.score.recall
        at_least = (self.front.precision >= precision) & (self.front.recall >= recall)
        self.beaten_by = int((at_least & ((self.front.precision > precision) | (self.front.recall > recall))).sum())
        self._show()

    def summary(self) -> str:
        """The sliders, the score, the place."""
        return (
            f"p_wall {self.p_wall.value:.2f}, p_space {self.p_space.value:.2f}, threshold {self.threshold.value:.2f}, "
            f"lam {self.lam.value:.2f}: precision {self.score.precision:.3f}, recall {self.score.recall:.3f}, "
            f"F{self.score.beta:g} {self.score.f_beta:.3f}; {self._place()}"
        )

    def _every_prior(self, threshold: float, lam: float) -> tuple[Experiment, Sweep, Front, Best, tuple[Plane, ...]]:
        """All that depends on threshold and lam alone; the front and the optimum are exact."""
        experiment = replace(self._experiment, threshold=threshold, lam=lam)
        sweep = experiment.sweep()
        front, everywhere = sweep.front(), sweep.grid(COLUMNS)
        squares = [_square(measure, getattr(everywhere, measure), threshold / sweep.factor, front) for measure in MEASURES]
        fronts = _plane_of_fronts(front, self._shown(experiment))
        return experiment, sweep, front, sweep.best(), (*squares, fronts)

    def _shown(self, experiment: Experiment) -> dict[str, Front]:
        """The other fronts, while they answer the same question."""
        apart = experiment.threshold - self._experiment.threshold, experiment.lam - self._experiment.lam
        return self._fronts if max(map(abs, apart)) < 1e-6 else {}

    def _place(self) -> str:
        """Where the prior stands to the front."""
        if not len(self.front):
            return "the front is empty"
        if min(np.nan_to_num(self.score.precision), self.score.recall) <= FLOOR:
            return f"below the floor of {100 * FLOOR:g} %"
        return f"beaten by {self.beaten_by} of the front's {len(self.front)}" if self.beaten_by else "on the front"

    def _show(self) -> None:
        """Pictures and numbers."""
        edge = self.sweep.threshold / self.sweep.factor
        for picture, measure, square in zip(self.pictures, MEASURES, self._planes, strict=False):
            plane, here = square.copy(), getattr(self.score, measure)
            plane.points(self.prior.p_wall, self.prior.p_space, "cross", RED, 7)
            words = f"{measure} of every prior, exact; dotted: threshold / 0.9 = {edge:.3f}; cross: yours, {here:.3f}"
            picture.show_svg(plane.svg(), words)
        plane = self._planes[2].copy()
        plane.points(self.score.recall, np.nan_to_num(self.score.precision), "cross", RED if self.beaten_by else BLACK, 7)
        self.pictures[2].show_svg(plane.svg(), f"{self.front!r}. Yours: {self.summary()}")
        counted = scored_image(self.map.grid.to_image(self.map.detected(self.sweep.threshold)), self.experiment.truth)
        self.pictures[3].show(counted, f"The map of this prior as the score counts it. {LEGEND}. {self.summary()}")

        sensor, best = self.experiment.evidence.sensor, self.best
        broken = overruled_readings(self.prior, sensor.p_free, sensor.p_occupied, self.lam.value)
        rows = [
            ("effective p_wall, p_space", f"{self.prior.effective_p_wall:.3f}, {self.prior.effective_p_space:.3f}"),
            ("<b>precision, recall</b>", f"<b>{self.score.precision:.3f}, {self.score.recall:.3f}</b>"),
            (f"<b>F{self.score.beta:g}</b>", f"<b>{self.score.f_beta:.3f}</b>"),
            ("its place", self._place()),
            (f"best F{self.score.beta:g} of all priors", f"{best.value:.3f}"),
            ("reached at", _where(best)),
            ("threshold / 0.9", f"{edge:.4f}"),
            ("exact front", f"{len(self.front)} points, hypervolume {self.front.hypervolume:.3f}"),
            *((name, f"{len(one)} points, {one.hypervolume:.3f}") for name, one in self._shown(self.experiment).items()),
            ("last picture", LEGEND.replace(", light", ",<br>light", 1)),
            ("eq. 2.22", broken.replace("; ", ";<br>").replace(": each", ":<br>each") if broken else "holds"),
        ]
        self.readout.value = table(rows, caption=f"detected as wall: P(empty) &le; {self.threshold.value:g}")


def _square(measure: str, values: NDArray[np.float64], edge: float, front: Front) -> Plane:
    """A colour map over p_wall and p_space, the cliffs and the front's priors."""
    ticks = (0.1, 0.2, 0.4, 0.6, 0.8, 1)
    plane = Plane(BOUNDS, BOUNDS, ("p_wall", "p_space"), measure, (330, 300), 46, ticks, ticks)
    plane.colours(values)
    for xs, ys in (((edge, edge), BOUNDS), (BOUNDS, (edge, edge))):
        plane.line(xs, ys, "stroke='#fff' stroke-dasharray='2 3'")
    plane.points(front.p_wall, front.p_space, "ring", "#ffffff", 3)
    return plane


def _plane_of_fronts(front: Front, others: Mapping[str, Front]) -> Plane:
    """Recall and precision: the floor of eq. 4.19 and the fronts, as stairs: between two points nothing can be had."""
    plane = Plane((0, 1.02), (0, 1.02), ("recall", "precision"), "exact front: rings; yours: cross", (330, 300))
    plane.band(x=(0, FLOOR))
    plane.band(y=(0, FLOOR))
    plane.words(0.02, 0.02, f"grey: below {100 * FLOOR:g} %, eq. 4.19")
    for i, (name, one) in enumerate(others.items()):
        marker, colour, dashes = OTHERS[i % len(OTHERS)]
        plane.line(*_stairs(one), f"stroke='{colour}' {dashes}")
        plane.points(one.recall, one.precision, marker, colour, 2.5)
        plane.points(0.06, 0.34 - 0.07 * i, marker, colour, 3)
        plane.words(0.1, 0.32 - 0.07 * i, name)
    plane.line(*_stairs(front), f"stroke='{BLUE}'")
    plane.points(front.recall, front.precision, "ring", BLUE, 4.5)
    return plane


def _stairs(front: Front) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Recall and precision along the border of what a front dominates."""
    return np.repeat(front.recall, 2)[:-1], np.repeat(front.precision, 2)[1:]


def _where(best: Best) -> str:
    """The largest plateau of an optimum."""
    return f"{best.plateaus[0]!r}".replace(", p_space", ",<br>p_space") if best.plateaus else "no prior detects a true wall"
