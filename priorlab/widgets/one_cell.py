"""One cell under sliders: how many free and wall readings, which prior, which update."""

from __future__ import annotations

from priorlab.core.log_odds import DETECTED_WALL, log_odds
from priorlab.core.sensor import RangeSensor
from priorlab.mapping.one_cell import one_cell_evidence, one_cell_map
from priorlab.mapping.recursion import one_step
from priorlab.mapping.update import update_map
from priorlab.widgets.lab import Lab, table
from priorlab.widgets.picture import Picture
from priorlab.widgets.sliders import Slider
from priorlab.widgets.track import track_svg

PRESETS: dict[str, dict[str, float]] = {
    "the thesis's numbers": {"n_free": 2, "n_wall": 0, "prior": 0.81, "lam": 1, "p_free": 0.9, "p_occupied": 0.1},
    "textbook (lam = 0)": {"lam": 0},
    "an unseen cell": {"n_free": 0, "n_wall": 0},
    "five free readings make a wall": {"n_free": 5, "n_wall": 0, "prior": 0.9, "lam": 1, "p_free": 0.8, "p_occupied": 0.2},
}


class OneCellLab(Lab):
    """Move the sliders, read `lab.log_odds`, `lab.p_empty`, `lab.track`, `lab.detected`.

    Parameters
    ----------
    n_free, n_wall : readings that saw the cell free, and as wall (drawn in this order; the end does not depend on it)
    prior : effective P(empty) that the cell starts with
    lam : how much of l0 each reading takes off
    sensor : its p_free and p_occupied are where the two sensor sliders start

    >>> lab = OneCellLab(n_free=5, prior=0.9, sensor=RangeSensor(p_free=0.8, p_occupied=0.2))
    >>> lab
    OneCellLab(5 free, 0 wall, prior 0.90, lam 1.00: l = -1.857, P(empty) = 0.135, detected as wall)
    >>> lab.lam.value = 0
    >>> lab
    OneCellLab(5 free, 0 wall, prior 0.90, lam 0.00: l = 9.129, P(empty) = 1.000, not a wall)
    """

    def __init__(
        self, n_free: int = 2, n_wall: int = 0, prior: float = 0.81, lam: float = 1.0, sensor: RangeSensor | None = None
    ) -> None:
        sensor = sensor or RangeSensor()
        self.n_free = Slider("free readings", n_free, 0, 10, 1, "how often the cell was seen free")
        self.n_wall = Slider("wall readings", n_wall, 0, 10, 1, "how often the cell was seen as wall")
        self.prior = Slider("prior P(empty)", prior, 0.02, 0.98, 0.01, "effective prior of the cell: 0 = wall, 1 = empty")
        self.lam = Slider("lam", lam, 0, 1, 0.05, "1: the thesis's update takes l0 off at every reading; 0: never")
        self.p_free = Slider("sensor p_free", sensor.p_free, 0.55, 0.98, 0.01, "P(empty) of a cell that was seen free")
        self.p_occupied = Slider("sensor p_occupied", sensor.p_occupied, 0.02, 0.45, 0.01, "P(empty) of a cell seen as wall")
        sliders = {
            "n_free": self.n_free,
            "n_wall": self.n_wall,
            "prior": self.prior,
            "lam": self.lam,
            "p_free": self.p_free,
            "p_occupied": self.p_occupied,
        }
        super().__init__(sliders, PRESETS, [Picture(width=430)])

    def refresh(self) -> None:
        """Once in closed form for the numbers, once step by step for the picture."""
        sensor = RangeSensor(p_free=self.p_free.value, p_occupied=self.p_occupied.value)
        seen_free = [True] * int(self.n_free.value) + [False] * int(self.n_wall.value)
        evidence = one_cell_evidence(seen_free, sensor)
        start = one_cell_map(self.prior.value)
        end = update_map(start, evidence, lam=self.lam.value)
        self.log_odds, self.p_empty = end.log_odds.item(), end.p_empty.item()
        self.detected = bool(end.detected().item())
        self.track = self._steps(seen_free, sensor, self.lam.value)
        self.other = self._steps(seen_free, sensor, 0.0)

        l_0, total, looks = start.log_odds.item(), evidence.total.item(), evidence.looks.item()
        verdict = "detected as wall" if self.detected else "not a wall"
        rows = [
            ("prior l<sub>0</sub>", f"{l_0:.3f}"),
            ("sum of the readings S", f"{total:.3f}"),
            ("readings n", f"{looks}"),
            ("l = l<sub>0</sub> + S - lam n l<sub>0</sub>", f"<b>{self.log_odds:.3f}</b>"),
            ("step by step, the same", f"{self.track[-1]:.3f}"),
            ("P(empty)", f"<b>{self.p_empty:.3f}</b>, {verdict}"),
            ("dashed: lam = 0, ends at", f"{self.other[-1]:.3f}"),
        ]
        self.readout.value = table(rows)
        alt = (
            f"Log odds of one cell over {looks} readings: from {l_0:.2f} to {self.log_odds:.2f}, P(empty) {self.p_empty:.3f}, "
            f"{verdict} (threshold {float(log_odds(DETECTED_WALL)):.2f}); with lam = 0 it ends at {self.other[-1]:.2f}."
        )
        self.pictures[0].show_svg(track_svg(self.track, seen_free, self.other), alt)

    def summary(self) -> str:
        """The sliders and where the cell ends."""
        verdict = "detected as wall" if self.detected else "not a wall"
        return (
            f"{self.n_free.value:.0f} free, {self.n_wall.value:.0f} wall, prior {self.prior.value:.2f}, "
            f"lam {self.lam.value:.2f}: l = {self.log_odds:.3f}, P(empty) = {self.p_empty:.3f}, {verdict}"
        )

    def _steps(self, seen_free: list[bool], sensor: RangeSensor, lam: float) -> list[float]:
        """Log odds before the first reading and after each, by the recursion."""
        l_0 = one_cell_map(self.prior.value).log_odds.item()
        steps = [l_0]
        for free in seen_free:
            steps.append(one_step(steps[-1], l_0, sensor.p_free if free else sensor.p_occupied, lam))
        return steps
