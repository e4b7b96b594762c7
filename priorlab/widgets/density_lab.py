"""How densely was the building surveyed? The gain of a plan over no plan, and the number of looks at which its sign changes."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from functools import lru_cache

import ipywidgets
import numpy as np
from numpy.typing import NDArray

from priorlab.core.building import Truth
from priorlab.core.drawing import Walls
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.log_odds import DETECTED_WALL
from priorlab.core.readings import Evidence
from priorlab.core.score import score_map
from priorlab.mapping.overruled import OverruledSensorWarning, overruled_readings
from priorlab.mapping.prior import build_prior_map
from priorlab.mapping.update import update_map
from priorlab.optimize.experiment import Experiment
from priorlab.optimize.sweep import Sweep
from priorlab.plot.extraction import LEGEND, scored_image
from priorlab.plot.style import BLACK, BLUE, RED
from priorlab.widgets.lab import Lab, table
from priorlab.widgets.picture import Picture
from priorlab.widgets.plane import Plane
from priorlab.widgets.sliders import Slider

TICKS = (1, 1.5, 2, 3, 5, 8, 12)


class DensityLab(Lab):
    """Read `lab.looks`, `lab.with_plan`, `lab.without`, `lab.alone`, `lab.gain_percent`, `lab.gain_here`, `lab.turns_between`.

    Parameters
    ----------
    plans : walls by a name; the first is shown at first, `lab.plan.value = name` shows another
    evidence : of surveys of one building, from the quickest to the densest, on one grid
    truth : what the scores count
    width : of a map on the screen, CSS pixels

    Attributes
    ----------
    looks : (K,) mean looks at a seen cell, for each survey
    with_plan, without : (K,) F2 after each survey; alone is F2 of the prior without any
    gain_percent : (K,) how much higher F2 is with the plan than without
    turns_between : looks of the last survey with which the plan pays and of the first with which it does not; None if it
        pays for all, or for none
    """

    def __init__(self, plans: Mapping[str, Walls], evidence: Sequence[Evidence], truth: Truth, width: int = 300) -> None:
        if len(evidence) < 2:
            raise ValueError(f"evidence must hold at least 2 surveys, got {len(evidence)}")
        self._plans, self._evidence, self._truth = dict(plans), tuple(evidence), truth
        self._sweeps = lru_cache(maxsize=16)(self._sweeps_of)
        self._pixels = lru_cache(maxsize=len(evidence))(self._without_plan)
        self.looks = np.array([one.mean_looks for one in evidence])
        nothing = (self._uninformed(k) for k in range(len(evidence)))
        self.without = np.array([score_map(one, truth).f_beta for one in nothing])
        presets: dict[str, dict[str, float]] = {
            "a quick look": {"survey": 1},
            "thorough": {"survey": (len(evidence) + 1) // 2},
            "dense": {"survey": len(evidence)},
            "textbook (lam = 0)": {"lam": 0},
            "walls called empty": {"p_wall": 1.0},
        }
        self.survey = Slider("survey", 1, 1, len(evidence), 1, "how densely the building was surveyed: 1 is the quickest")
        self.p_wall = Slider("p_wall", 0.2, 0.05, 1.0, 0.01, "P(empty) where the plan shows a wall, before the factor 0.9")
        self.p_space = Slider("p_space", 0.9, 0.05, 1.0, 0.01, "P(empty) where the plan shows space, before the factor 0.9")
        self.lam = Slider("lam", 1, 0, 1, 0.05, "1: the thesis's update takes l0 off at every reading; 0: never")
        sliders = {"survey": self.survey, "p_wall": self.p_wall, "p_space": self.p_space, "lam": self.lam}
        self.plan = ipywidgets.Dropdown(options=list(self._plans), description="plan:", layout=ipywidgets.Layout(width="auto"))
        self.plan.observe(self._moved, "value")
        super().__init__(sliders, presets, [Picture(width=430), Picture(width=width), Picture(width=width)], [self.plan])

    def refresh(self) -> None:
        """Score the prior on every survey; build the map of one."""
        lam, self.prior = round(self.lam.value, 6), Prior(self.p_wall.value, self.p_space.value)
        start = build_prior_map(self._plans[self.plan.value], self.prior, cell_size=self._evidence[0].grid.cell_size)
        self.alone = score_map(start, self._truth).f_beta
        if lam in (0, 1):  # where most people stay: every prior at once, kept
            sweeps = self._sweeps(self.plan.value, lam)
            scores = [sweep.at(self.prior.p_wall, self.prior.p_space) for sweep in sweeps]
        else:
            scores = [score_map(self._update(start, one, lam), self._truth) for one in self._evidence]
        self.with_plan = np.array([score.f_beta for score in scores])
        with np.errstate(divide="ignore", invalid="ignore"):
            self.gain_percent = 100 * (self.with_plan / self.without - 1)
        self.here = int(self.survey.value) - 1
        self.gain_here = float(self.gain_percent[self.here])
        self.turns_between = self._turn()

        self.map = self._update(start, self._evidence[self.here], lam)
        self._show()

    def reset(self) -> None:
        """Sliders and plan back to where they stood at first."""
        self._held = True
        self.plan.value = next(iter(self._plans))
        super().reset()

    def summary(self) -> str:
        """The survey and what the plan was worth."""
        return (
            f"{self.plan.value}, {self.looks[self.here]:.2f} looks, p_wall {self.p_wall.value:.2f}, "
            f"p_space {self.p_space.value:.2f}, lam {self.lam.value:.2f}: F2 {self.with_plan[self.here]:.3f} with the plan, "
            f"{self.without[self.here]:.3f} without, {self.alone:.3f} the plan alone, gain {self.gain_here:+.0f} %"
        )

    @staticmethod
    def _update(start: GridMap, evidence: Evidence, lam: float) -> GridMap:
        """The map after a survey, whatever eq. 2.22 says."""
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", OverruledSensorWarning)
            return update_map(start, evidence, lam)

    def _sweeps_of(self, plan: str, lam: float) -> list[Sweep]:
        """Every prior at once, for every survey."""
        return [Experiment(self._plans[plan], one, self._truth, lam=lam).sweep() for one in self._evidence]

    def _uninformed(self, survey: int) -> GridMap:
        """The map of a survey without a plan: it starts at 0.5, whatever lam is."""
        grid = self._evidence[survey].grid
        return update_map(GridMap(np.zeros(grid.shape), grid, Prior.uninformed()), self._evidence[survey])

    def _without_plan(self, survey: int) -> NDArray[np.uint8]:
        """Its picture."""
        return self._counted(self._uninformed(survey))

    def _counted(self, grid_map: GridMap) -> NDArray[np.uint8]:
        """A map as the score counts it."""
        return scored_image(grid_map.grid.to_image(grid_map.detected()), self._truth)

    def _turn(self) -> tuple[float, float] | None:
        """Between which looks the gain first falls below 0."""
        below = np.flatnonzero(self.gain_percent < 0)
        if not below.size or below[0] == 0:
            return None
        return float(self.looks[below[0] - 1]), float(self.looks[below[0]])

    def _show(self) -> None:
        """Pictures and numbers."""
        self.pictures[0].show_svg(self._curves(), f"F2 over the mean looks at a seen cell. {self.summary()}. {self._verdict()}")
        self.pictures[1].show(self._counted(self.map), f"With the plan. {LEGEND}. F2 {self.with_plan[self.here]:.3f}")
        self.pictures[2].show(self._pixels(self.here), f"Without a plan. {LEGEND}. F2 {self.without[self.here]:.3f}")
        evidence = self._evidence[self.here]
        sensor = evidence.sensor
        broken = overruled_readings(self.prior, sensor.p_free, sensor.p_occupied, self.lam.value)
        rows = [
            ("looks per seen cell", f"<b>{self.looks[self.here]:.2f}</b>, {100 * evidence.seen.mean():.0f} % of the cells seen"),
            ("F2 with the plan (middle)", f"<b>{self.with_plan[self.here]:.3f}</b>"),
            ("F2 without (right)", f"{self.without[self.here]:.3f}"),
            ("F2 of the plan alone", f"{self.alone:.3f}"),
            ("gain of the plan", f"<b>{self.gain_here:+.0f} %</b>"),
            ("the sign of the gain", self._verdict()),
            ("eq. 2.22", broken.replace("; ", ";<br>").replace(": each", ":<br>each") if broken else "holds"),
            ("colours", LEGEND.replace(", light", ",<br>light", 1)),
        ]
        self.readout.value = table(rows, caption=f"detected as wall: P(empty) &le; {DETECTED_WALL:g}")

    def _verdict(self) -> str:
        """When the plan pays."""
        if self.turns_between:
            return f"turns between {self.turns_between[0]:.2f} and {self.turns_between[1]:.2f} looks"
        return "the plan pays for every survey" if (self.gain_percent >= 0).all() else "the plan does harm from the first look"

    def _curves(self) -> str:
        """Three lines over the looks, and where we stand."""
        low, high = 0.95 * float(self.looks.min()), 1.05 * float(self.looks.max())
        ticks = [tick for tick in TICKS if low <= tick <= high]
        labels = ("mean looks at a seen cell", "F2")
        plane = Plane((low, high), (0, 1), labels, "with and without the plan", (430, 300), x_ticks=ticks, logarithmic=True)
        if self.turns_between:
            plane.band(x=(float(np.sqrt(np.prod(self.turns_between))), high))
            plane.words(high, 0.03, "grey: the plan does harm ", "end", "fill='#333'")
        here = self.looks[self.here]
        plane.line([here, here], [0, 1], f"stroke='{BLACK}' stroke-dasharray='2 3'")
        plane.line([low, high], [self.alone, self.alone], f"stroke='{BLACK}' stroke-width='1.5' stroke-dasharray='1 3'")
        plane.line(self.looks, self.without, f"stroke='{RED}' stroke-width='2' stroke-dasharray='6 4'")
        plane.points(self.looks, self.without, "square", RED, 3.5)
        plane.line(self.looks, self.with_plan, f"stroke='{BLUE}' stroke-width='2'")
        plane.points(self.looks, self.with_plan, "dot", BLUE, 4)
        names = (("dotted: the plan alone", BLACK), ("dots: with the plan", BLUE), ("squares: without", RED))
        for i, (words, colour) in enumerate(names):
            plane.words(low, 0.17 - 0.07 * i, f"\u00a0{words}", style=f"fill='{colour}'")
        return plane.svg()
