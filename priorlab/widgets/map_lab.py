"""A whole map under the prior's sliders: what it shows, what the score counts, and what eq. 2.22 says."""

from __future__ import annotations

import warnings

from priorlab.core.building import Truth
from priorlab.core.drawing import Walls
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.log_odds import DETECTED_WALL
from priorlab.core.picture import grey_of
from priorlab.core.readings import Evidence
from priorlab.core.score import Score, score_map
from priorlab.mapping.overruled import OverruledSensorWarning, overruled_readings
from priorlab.mapping.prior import build_prior_map
from priorlab.mapping.update import update_map
from priorlab.plot.extraction import LEGEND, scored_image
from priorlab.widgets.lab import Lab, table
from priorlab.widgets.picture import Picture
from priorlab.widgets.sliders import Slider

PRESETS: dict[str, dict[str, float]] = {
    "the thesis's prior": {"p_wall": 0.2, "p_space": 0.9, "lam": 1},
    "textbook (lam = 0)": {"lam": 0},
    "just over the cliff": {"p_wall": 0.23},
    "too sure of space": {"p_space": 1.0},
    "the plan upside down": {"p_wall": 0.9, "p_space": 0.2},
}


class MapLab(Lab):
    """Move p_wall, p_space and lam; read `lab.score`, `lab.map`, `lab.prior`, and the two maps to compare with.

    Parameters
    ----------
    walls : extracted from the drawing
    evidence : what the robot saw, on the cells that the map shall have
    truth : what the score counts
    p_wall, p_space, lam : where the sliders start
    threshold : P(empty) at or below which a cell is a detected wall
    width : of each picture on the screen, CSS pixels

    Attributes
    ----------
    map, score : posterior map and its score
    prior_score : score of the prior alone, without readings
    uninformed_score : score of the readings alone, without a prior
    """

    def __init__(
        self,
        walls: Walls,
        evidence: Evidence,
        truth: Truth,
        p_wall: float = 0.2,
        p_space: float = 0.9,
        lam: float = 1.0,
        threshold: float = DETECTED_WALL,
        width: int = 400,
    ) -> None:
        self._walls, self._evidence, self._truth, self._threshold = walls, evidence, truth, threshold
        self.uninformed_score = self._update(Prior.uninformed(), lam)[2]  # l0 = 0: the same for every lam
        self.p_wall = Slider("p_wall", p_wall, 0.05, 1.0, 0.01, "P(empty) where the plan shows a wall, before the factor 0.9")
        self.p_space = Slider("p_space", p_space, 0.05, 1.0, 0.01, "P(empty) where the plan shows space, before the factor 0.9")
        self.lam = Slider("lam", lam, 0, 1, 0.05, "1: the thesis's update takes l0 off at every reading; 0: never")
        sliders = {"p_wall": self.p_wall, "p_space": self.p_space, "lam": self.lam}
        super().__init__(sliders, PRESETS, [Picture(width=width), Picture(width=width)])

    def refresh(self) -> None:
        """Prior map, update, two scores, two pictures."""
        sensor, lam = self._evidence.sensor, self.lam.value
        self.prior = Prior(self.p_wall.value, self.p_space.value)
        self.prior_map, self.map, self.score = self._update(self.prior, lam)
        self.prior_score = score_map(self.prior_map, self._truth, self._threshold)
        self.pictures[0].show(grey_of(self.map.p_empty), f"The map {self._walls.name}, white = empty. {self.summary()}")
        counted = scored_image(self.map.grid.to_image(self.map.detected(self._threshold)), self._truth)
        self.pictures[1].show(counted, f"What the score counts. {LEGEND}. {_line(self.score)}")
        broken = overruled_readings(self.prior, sensor.p_free, sensor.p_occupied, lam)
        rows = [
            ("effective p_wall, p_space", f"{self.prior.effective_p_wall:.3f}, {self.prior.effective_p_space:.3f}"),
            ("<b>with prior and readings</b>", f"<b>{_line(self.score)}</b>"),
            ("prior alone", _line(self.prior_score)),
            ("readings alone", _line(self.uninformed_score)),
            ("looks per seen cell", f"{self._evidence.mean_looks:.2f}"),
            ("left picture", "P(empty): white = empty, black = wall"),
            ("right picture", LEGEND),
            ("eq. 2.22", broken.replace("; ", ";<br>").replace(": each", ":<br>each") if broken else "holds"),
        ]
        self.readout.value = table(rows, caption=f"detected as wall: P(empty) &le; {self._threshold:g}")

    def summary(self) -> str:
        """The sliders and the three scores."""
        return (
            f"p_wall {self.p_wall.value:.2f}, p_space {self.p_space.value:.2f}, lam {self.lam.value:.2f}: {_line(self.score)}; "
            f"prior alone F2 {self.prior_score.f_beta:.3f}, readings alone F2 {self.uninformed_score.f_beta:.3f}"
        )

    def _update(self, prior: Prior, lam: float) -> tuple[GridMap, GridMap, Score]:
        """What the notebook's three lines compute."""
        grid = self._evidence.grid
        prior_map = build_prior_map(self._walls, prior, cell_size=grid.cell_size)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", OverruledSensorWarning)  # the readout says it, at every move
            posterior = update_map(prior_map, self._evidence, lam=lam)
        return prior_map, posterior, score_map(posterior, self._truth, self._threshold)


def _line(score: Score) -> str:
    """A score in one line."""
    return f"precision {score.precision:.3f}, recall {score.recall:.3f}, F{score.beta:g} {score.f_beta:.3f}"
