"""What the two prior sliders write into the cells of a map before the robot moves, and what a quick look makes of it."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from functools import lru_cache

import ipywidgets
import numpy as np

from priorlab.core.building import Truth
from priorlab.core.drawing import Walls
from priorlab.core.grid_map import Prior
from priorlab.core.log_odds import DETECTED_WALL, log_odds
from priorlab.core.picture import grey_of
from priorlab.core.readings import Evidence, Readings
from priorlab.core.score import Score, score_map
from priorlab.mapping.evidence import gather_evidence
from priorlab.mapping.overruled import OverruledSensorWarning, overruled_readings
from priorlab.mapping.prior import build_prior_map
from priorlab.mapping.update import update_map
from priorlab.plot.extraction import LEGEND, scored_image
from priorlab.plot.style import BLUE, RED
from priorlab.widgets.lab import Lab, table
from priorlab.widgets.picture import Picture
from priorlab.widgets.plane import Plane
from priorlab.widgets.sliders import Slider

PRESETS: dict[str, dict[str, float]] = {
    "the thesis's prior": {"p_wall": 0.2, "p_space": 0.9},
    "timid": {"p_wall": 0.5, "p_space": 0.6},
    "as if it were occupancy": {"p_wall": 0.9, "p_space": 0.2},
    "surer than the sensor": {"p_wall": 0.1, "p_space": 1.0},
    "coarse cells": {"cell_size": 10},
}
CURVE = np.linspace(0.006, 0.994, 120)


class PriorLab(Lab):
    """Read `lab.prior`, `lab.prior_map`, `lab.prior_score`, `lab.map`, `lab.score`, `lab.wall_share`.

    Parameters
    ----------
    plans : walls by a name; the first is shown at first, `lab.plan.value = name` shows another
    readings : of a quick look around
    truth : what the scores count
    cell_size : pixels, where that slider starts
    width : of a map on the screen, CSS pixels

    Attributes
    ----------
    prior_map, prior_score : the prior alone
    map, score : after the readings
    wall_share : share of the cells that start as wall
    """

    def __init__(
        self, plans: Mapping[str, Walls], readings: Readings, truth: Truth, cell_size: float = 3, width: int = 330
    ) -> None:
        self._plans, self._readings, self._truth = dict(plans), readings, truth
        self._evidence_at = lru_cache(maxsize=16)(self._gather)
        self.p_wall = Slider("p_wall", 0.2, 0.02, 1.0, 0.01, "P(empty) where the plan shows a wall, before the factor 0.9")
        self.p_space = Slider("p_space", 0.9, 0.02, 1.0, 0.01, "P(empty) where the plan shows space, before the factor 0.9")
        self.cell_size = Slider("cell size, pixels", cell_size, 1, 20, 1, "side of a square cell")
        sliders = {"p_wall": self.p_wall, "p_space": self.p_space, "cell_size": self.cell_size}
        self.plan = ipywidgets.Dropdown(options=list(self._plans), description="plan:", layout=ipywidgets.Layout(width="auto"))
        self.plan.observe(self._moved, "value")
        pictures = [Picture(width=width), Picture(width=330), Picture(width=width)]
        super().__init__(sliders, PRESETS, pictures, [self.plan])

    def refresh(self) -> None:
        """Prior map, its score, the map after the readings and its score."""
        walls, evidence = self._plans[self.plan.value], self._evidence_at(self.cell_size.value)
        self.prior = Prior(self.p_wall.value, self.p_space.value)
        self.prior_map = build_prior_map(walls, self.prior, cell_size=self.cell_size.value)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", OverruledSensorWarning)  # the readout says it, at every move
            self.map = update_map(self.prior_map, evidence)
        self.prior_score, self.score = score_map(self.prior_map, self._truth), score_map(self.map, self._truth)
        self.wall_share = float(self.prior_map.grid.any_in_cells(walls.mask).mean())
        self._show(evidence)

    def reset(self) -> None:
        """Sliders and plan back to where they stood at first."""
        self._held = True
        self.plan.value = next(iter(self._plans))
        super().reset()

    def summary(self) -> str:
        """The sliders and both scores."""
        return (
            f"{self.plan.value}, p_wall {self.p_wall.value:.2f}, p_space {self.p_space.value:.2f}, "
            f"cells of {self.cell_size.value:.0f} px, {100 * self.wall_share:.1f} % of them wall: "
            f"prior alone F2 {self.prior_score.f_beta:.3f}, after the readings F2 {self.score.f_beta:.3f}"
        )

    def _gather(self, cell_size: float) -> Evidence:
        """S and n on cells of this size; the readings stay the same."""
        any_plan = next(iter(self._plans.values()))
        return gather_evidence(self._readings, build_prior_map(any_plan, None, cell_size=cell_size).grid)

    def _show(self, evidence: Evidence) -> None:
        """Pictures and numbers."""
        prior, sensor = self.prior, self._readings.sensor
        l_wall, l_space = log_odds([prior.effective_p_wall, prior.effective_p_space]).tolist()
        self.pictures[0].show(grey_of(self.prior_map.p_empty), f"The prior map, white = empty, black = wall. {self.summary()}")
        self.pictures[1].show_svg(
            self._curve(l_wall, l_space),
            f"Log odds over P(empty), nearly straight between 0.2 and 0.8. Walls start at {l_wall:.2f}, space at {l_space:.2f}; "
            f"the sensor says P(empty) = {sensor.p_occupied:g} for wall and {sensor.p_free:g} for free.",
        )
        counted = scored_image(self.map.grid.to_image(self.map.detected()), self._truth)
        self.pictures[2].show(counted, f"After the readings, as the score counts it. {LEGEND}. {_line(self.score)}")
        broken = overruled_readings(prior, sensor.p_free, sensor.p_occupied)
        rows = [
            ("p_wall x 0.9", f"{prior.p_wall:.2f} x 0.9 = <b>{prior.effective_p_wall:.3f}</b>, l<sub>0</sub> = {l_wall:+.2f}"),
            (
                "p_space x 0.9",
                f"{prior.p_space:.2f} x 0.9 = <b>{prior.effective_p_space:.3f}</b>, l<sub>0</sub> = {l_space:+.2f}",
            ),
            ("cells that start as wall", f"{100 * self.wall_share:.1f} % of {self.prior_map.log_odds.size:,}"),
            ("left: prior alone", _line(self.prior_score)),
            ("right: after the readings", f"<b>{_line(self.score)}</b>"),
            ("looks per seen cell", f"{evidence.mean_looks:.2f}"),
            ("colours on the right", LEGEND.replace(", light", ",<br>light", 1)),
            ("eq. 2.22", broken.replace("; ", ";<br>").replace(": each", ":<br>each") if broken else "holds"),
        ]
        self.readout.value = table(rows, caption=f"detected as wall: P(empty) &le; {DETECTED_WALL:g}")

    def _curve(self, l_wall: float, l_space: float) -> str:
        """Fig. 2.9 with both priors on it, and what the sensor says as dashed lines."""
        ticks = (0, 0.2, 0.4, 0.6, 0.8, 1)
        plane = Plane((0, 1), (-5, 5), ("P(empty)", "log odds"), "log odds (fig. 2.9)", (330, 300), 16, ticks, (-4, -2, 0, 2, 4))
        plane.band(x=(0.2, 0.8))
        plane.line([0, 1], [0, 0], "stroke='#000' stroke-width='0.7'")
        sensor = self._readings.sensor
        for p, words, x, above in ((sensor.p_free, "sensor: free", 0.02, 0.25), (sensor.p_occupied, "sensor: wall", 0.68, -0.7)):
            at = float(log_odds(p))
            plane.line([0, 1], [at, at], "stroke='#555' stroke-dasharray='4 3'")
            plane.words(x, at + above, f"{words}, {p:g}", style="fill='#444'")
        plane.line(CURVE, log_odds(CURVE), f"stroke='{BLUE}' stroke-width='2'")
        plane.points(self.prior.effective_p_wall, l_wall, "square", "#000", 6)
        plane.points(self.prior.effective_p_space, l_space, "ring", RED, 7)
        plane.words(0.35, -4.5, "square: wall, ring: space")
        return plane.svg()


def _line(score: Score) -> str:
    """A score in one line."""
    return f"precision {score.precision:.3f}, recall {score.recall:.3f}, F{score.beta:g} {score.f_beta:.3f}"
