"""A handful of weighted particles and the draws that follow: what each is owed, and what three ways of drawing give it."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.plot.style import BLACK, RED, SKY
from priorlab.slam.particles import Particles
from priorlab.slam.resampling import resample
from priorlab.widgets.lab import Lab, table
from priorlab.widgets.picture import Picture
from priorlab.widgets.plane import Plane
from priorlab.widgets.sliders import Slider

METHODS = ("systematic", "stratified", "multinomial")
N_SPINS = 100

PRESETS: dict[str, dict[str, float]] = {
    "systematic": {"method": 1},
    "stratified": {"method": 2},
    "multinomial": {"method": 3},
    "beams as printed (temper 1)": {"temper": 1},
    "60 beams count as 3": {"temper": 0.05},
    "all weigh the same": {"temper": 0},
}


class ResampleLab(Lab):
    """Read `lab.weights`, `lab.ess`, `lab.owed`, `lab.copies`, `lab.survivors`, `lab.fewest`, `lab.most`.

    Parameters
    ----------
    log_likelihoods : (N,) of some particles, the sum over the beams as printed; best 5 to 20 of them
    temper : where that slider starts

    Attributes
    ----------
    weights, ess : with the temper of the slider
    owed : (N,) draws times weight
    copies : (N,) how often each was drawn this time
    survivors : how many different particles go on
    spins : (100, N) copies in as many spins
    fewest, most : (N,) of these
    """

    def __init__(self, log_likelihoods: ArrayLike, temper: float = 0.05) -> None:
        self._logs = np.asarray(log_likelihoods, dtype=np.float64)
        self.temper = Slider("temper", temper, 0, 1, 0.01, "exponent of the likelihood; 1 as printed")
        self.method = Slider("way of drawing", 1, 1, 3, 1, "1 systematic, 2 stratified, 3 multinomial")
        self.n_draws = Slider("draws", len(self._logs), 1, 5 * len(self._logs), 1, "how many particles go on")
        self.spin = Slider("spin", 1, 1, N_SPINS, 1, "other random numbers")
        sliders = {"temper": self.temper, "method": self.method, "n_draws": self.n_draws, "spin": self.spin}
        super().__init__(sliders, PRESETS, [Picture()])

    def refresh(self) -> None:
        """Weights, this draw, and 99 others."""
        n, name = int(self.n_draws.value), METHODS[int(self.method.value) - 1]
        particles = Particles(np.zeros((len(self._logs), 3)), self.temper.value * self._logs)
        self.weights, self.ess = particles.weights, particles.effective_number
        self.owed = n * self.weights
        self.spins = np.array([self._copies(name, n, seed) for seed in range(1, N_SPINS + 1)])
        self.copies = self.spins[int(self.spin.value) - 1]
        self.fewest, self.most = self.spins.min(axis=0), self.spins.max(axis=0)
        self.survivors = int((self.copies > 0).sum())
        self.pictures[0].show_svg(self._bars(), f"Bars: draws owed; dots: drawn; lines: in {N_SPINS} spins. {self.summary()}")
        rows = [
            ("effective number ESS", f"<b>{self.ess:.1f}</b> of {len(self.weights)}"),
            ("heaviest weight", f"{self.weights.max():.3f}"),
            ("drawn", f"{n} times, {name}"),
            ("different ones go on", f"<b>{self.survivors}</b>"),
            ("heaviest: owed, drawn", f"{self.owed.max():.2f}, {self.copies[self.weights.argmax()]}"),
            (f"heaviest: in {N_SPINS} spins", self._range(int(self.weights.argmax()))),
            ("picture", f"bar: draws owed, N w; dot: drawn;<br>line: from fewest to most<br>in {N_SPINS} spins"),
        ]
        self.readout.value = table(rows, caption="weights and draws")

    def summary(self) -> str:
        """The numbers in one line."""
        return (
            f"temper {self.temper.value:.2f}, {METHODS[int(self.method.value) - 1]}: ESS {self.ess:.1f} of {len(self.weights)}, "
            f"{self.survivors} different particles in {self.n_draws.value:.0f} draws; the heaviest is owed {self.owed.max():.2f} "
            f"and gets {self._range(int(self.weights.argmax()))}"
        )

    def _copies(self, name: str, n: int, seed: int) -> NDArray[np.int64]:
        """(N,) how often each particle is drawn."""
        return np.bincount(resample(self.weights, n, np.random.default_rng(seed), name), minlength=len(self.weights))  # type: ignore[arg-type]

    def _range(self, particle: int) -> str:
        """In words."""
        return f"{self.fewest[particle]} to {self.most[particle]}"

    def _bars(self) -> str:
        """One bar, one line and one dot for every particle."""
        n, top = len(self.weights), float(max(4, self.most.max(), self.owed.max()) * 1.08)
        step = next(step for step in (1, 2, 5, 10, 20, 50) if top / step <= 8)
        ticks, names = np.arange(n) + 0.5, [str(number) for number in range(n)]
        plane = Plane(
            (0, n), (0, top), ("particle", "copies"), "draws owed and drawn", (420, 320), 16, ticks.tolist(),
            np.arange(0, top, step).tolist(), names,
        )  # fmt: skip
        for number, owed in enumerate(self.owed.tolist()):
            plane.band((number + 0.18, number + 0.82), (0, owed), SKY)
        plane.strokes(np.column_stack([ticks, self.fewest]), np.column_stack([ticks, self.most]), f"stroke='{BLACK}'")
        plane.points(ticks, self.copies, "dot", RED, 4)
        return plane.svg()
