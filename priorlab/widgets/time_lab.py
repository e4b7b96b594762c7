"""A map while the robot explores: a time slider over the readings, with the plan, without it, and the plan alone."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from priorlab.core.building import Truth
from priorlab.core.grid_map import GridMap
from priorlab.core.log_odds import DETECTED_WALL
from priorlab.core.picture import grey_of
from priorlab.core.readings import Readings
from priorlab.mapping.over_time import score_over_time
from priorlab.mapping.timeline import evidence_over_time
from priorlab.mapping.update import update_map
from priorlab.plot.style import BLACK, BLUE, GREEN, ORANGE, RED
from priorlab.widgets.lab import Lab, table
from priorlab.widgets.picture import Picture
from priorlab.widgets.plane import Plane
from priorlab.widgets.sliders import Slider

LINES = ((BLUE, ""), (RED, "stroke-dasharray='6 4'"), (GREEN, "stroke-dasharray='2 3'"), (ORANGE, "stroke-dasharray='8 3 2 3'"))


class TimeLab(Lab):
    """Read `lab.over_time` (all curves), `lab.evidence` and `lab.maps` (after the readings of the slider), `lab.f2`.

    Parameters
    ----------
    readings : in the order in which they were taken
    prior_maps : by name, at most four, on one grid; each is a line and the first two are pictures
    truth : what the score counts
    lam : as in `update_map`
    width : of a map on the screen, CSS pixels
    """

    def __init__(
        self, readings: Readings, prior_maps: Mapping[str, GridMap], truth: Truth, lam: float = 1.0, width: int = 300
    ) -> None:
        if not 1 <= len(prior_maps) <= len(LINES):
            raise ValueError(f"prior_maps must hold 1 to {len(LINES)} maps, got {len(prior_maps)}")
        self._starts, self._lam = dict(prior_maps), lam
        self._timeline = evidence_over_time(readings, next(iter(prior_maps.values())).grid)
        self.over_time = score_over_time(self._timeline, prior_maps, truth, lam)
        self._plane = self._curves()
        self.k = Slider("readings taken", 0, 0, len(readings), 1, "how many readings the maps hold")
        presets: dict[str, dict[str, float]] = {
            "before any look": {"k": 0},
            "a tenth": {"k": len(readings) // 10},
            "half": {"k": len(readings) // 2},
            "all": {"k": len(readings)},
        }
        super().__init__({"k": self.k}, presets, [Picture(width=430), *(Picture(width=width) for _ in list(prior_maps)[:2])])

    def refresh(self) -> None:
        """The evidence so far, a map from each prior, and the place on the curves."""
        k = int(self.k.value)
        self.evidence = self._timeline.at(k)
        self.maps = {name: update_map(start, self.evidence, self._lam) for name, start in self._starts.items()}
        self.f2 = {name: float(curve[k]) for name, curve in self.over_time.f_beta.items()}
        plane = self._plane.copy()
        plane.line([k, k], [0, 1], f"stroke='{BLACK}' stroke-dasharray='2 3'")
        for value, (colour, _) in zip(self.f2.values(), LINES, strict=False):
            plane.points(k, value, "dot", colour, 5)
        self.pictures[0].show_svg(plane.svg(), f"F2 over the readings taken. {self.summary()}")
        for picture, (name, one) in zip(self.pictures[1:], self.maps.items(), strict=False):
            picture.show(self._cells(one), f"The map {name}, white = empty, after {k} readings: F2 {self.f2[name]:.3f}")
        rows = [("readings", f"{k} of {len(self._timeline)}"), ("cells seen", f"{100 * self.evidence.seen.mean():.0f} %")]
        rows += [("looks per seen cell", f"{self.evidence.mean_looks:.2f}")]
        rows += [
            (f"F2 {name}", f"<b>{value:.3f}</b>, at the start {self.over_time.f_beta[name][0]:.3f}")
            for name, value in self.f2.items()
        ]
        shown = zip(("middle", "right"), self.maps, strict=False)
        rows += [(f"{where} picture", f"{name}; white = empty") for where, name in shown]
        self.readout.value = table(rows, caption=f"detected as wall: P(empty) &le; {DETECTED_WALL:g}")

    def summary(self) -> str:
        """How far, and every F2."""
        scores = ", ".join(f"{name} {value:.3f}" for name, value in self.f2.items())
        return f"{self.k.value:.0f} readings, {self.evidence.mean_looks:.2f} looks: F2 {scores}"

    @staticmethod
    def _cells(grid_map: GridMap) -> NDArray[np.uint8]:
        """A map's cells as grey pixels; the browser keeps them sharp."""
        return grey_of(grid_map.p_empty)

    def _curves(self) -> Plane:
        """All curves, and the first map's start as the line of the plan alone."""
        end, curves = int(self.over_time.steps[-1]), self.over_time.f_beta
        ticks = [round(end * share) for share in (0, 0.25, 0.5, 0.75, 1)]
        plane = Plane((0, end), (0, 1), ("readings taken", "F2"), "F2 over time (fig. 5.9)", (430, 300), x_ticks=ticks)
        alone = float(next(iter(curves.values()))[0])
        plane.line([0, end], [alone, alone], f"stroke='{BLACK}' stroke-width='1.5' stroke-dasharray='1 3'")
        steps = np.unique(np.linspace(0, end, 200).astype(int))
        for i, ((name, curve), (colour, dashes)) in enumerate(zip(curves.items(), LINES, strict=False)):
            plane.line(steps, curve[steps], f"stroke='{colour}' stroke-width='2' {dashes}")
            plane.words(end, 0.06 + 0.07 * (len(curves) - 1 - i), f"{name}\u00a0", "end", f"fill='{colour}'")
        plane.words(end, 0.06 + 0.07 * len(curves), f"dotted: {next(iter(curves))}, before any look\u00a0", "end")
        return plane
