"""Algorithm 6.3 under sliders: what the wheels say of a step, and the cloud of poses that may be true after it (fig. 6.1)."""

from __future__ import annotations

import numpy as np

from priorlab.core.pose import wrap_angle
from priorlab.plot.style import BLUE, RED
from priorlab.slam.motion import motion_deviations, motion_parts, sample_motion
from priorlab.slam.parameters import Parameters
from priorlab.widgets.lab import Lab, table
from priorlab.widgets.picture import Picture
from priorlab.widgets.plane import LEFT, TOP, Plane
from priorlab.widgets.sliders import Slider

N_PARTICLES = 400
SIDE = 320
"""Both axes, CSS pixels: a metre is as long upwards as to the right."""

_WHEELS = {"alpha_1": 0.004, "alpha_2": 0.004, "alpha_3": 0.004, "alpha_4": 0.004, "std": 0, "literal": 0}
_PRINTED = {"alpha_1": 0.2, "alpha_2": 0.2, "alpha_3": 0.2, "alpha_4": 0.2}
_STEP = {"forward": 100, "left": 0, "turned": 0, "steps": 10}
PRESETS: dict[str, dict[str, float]] = {
    "fig. 6.1": {"forward": 1500, "left": 900, "turned": 75, "steps": 1, **_WHEELS},
    "ten times 10 cm": {**_STEP, **_WHEELS},
    "Table 6.1 as variance": {**_STEP, **_WHEELS, **_PRINTED},
    "Table 6.1 as deviation": {**_STEP, **_WHEELS, **_PRINTED, "std": 1},
    "a turn on the spot": {"forward": 0, "left": 0, "turned": 15, "steps": 1, **_WHEELS},
    "2 mm back, literal": {"forward": -2, "left": 0, "turned": 15, "steps": 1, **_WHEELS, "literal": 1},
    "2 mm back, symmetric": {"forward": -2, "left": 0, "turned": 15, "steps": 1, **_WHEELS},
}


class MotionLab(Lab):
    """Read `lab.parts`, `lab.deviations`, `lab.poses`, `lab.spread_m`, `lab.spread_deg`.

    Parameters
    ----------
    seed : of the particles' noise; the same numbers at every move, so that only what a slider changes changes

    Attributes
    ----------
    parameters : alphas, noise and rotation noise under the sliders
    parts : delta_rot1, delta_trans, delta_rot2 of one step; radians and metres
    deviations : (3,) standard deviations of the three
    exact : (steps + 1, 3) the way that the wheels report
    poses : (400, 3) the particles after the last step
    spread_m, spread_deg : root mean square distance and heading of the particles to what the wheels say
    """

    def __init__(self, seed: int = 0) -> None:
        self._seed = seed
        self.forward = Slider("forward, mm", 1500, -50, 2000, 1, "how far ahead the wheels say that one step led")
        self.left = Slider("to the left, mm", 900, -1000, 1000, 1, "how far to the left the wheels say that one step led")
        self.turned = Slider("turned, degrees", 75, -180, 180, 1, "by how much the wheels say that the robot turned")
        self.steps = Slider("steps", 1, 1, 20, 1, "the same step so many times")
        hints = (
            "error of a rotation, from rotation",
            "error of a rotation, from translation",
            "error of the translation, from translation",
            "error of the translation, from rotation",
        )
        alphas = {
            f"alpha_{i}": Slider(f"alpha_{i}", 0.004, 0, 0.3, 0.002, hint, digits=3) for i, hint in enumerate(hints, start=1)
        }
        self.std = Slider("std", 0, 0, 1, 1, "0: sample(b) takes b as a variance; 1: as a standard deviation")
        self.literal = Slider("literal", 0, 0, 1, 1, "1: the rotation as printed; 0: to the nearer of 0 and pi")
        sliders = {"forward": self.forward, "left": self.left, "turned": self.turned, "steps": self.steps}
        super().__init__({**sliders, **alphas, "std": self.std, "literal": self.literal}, PRESETS, [Picture()])

    def refresh(self) -> None:
        """The parts of the step, their deviations, and the particles after all steps."""
        a1, a2, a3, a4 = (self.sliders[f"alpha_{i}"].value for i in (1, 2, 3, 4))
        self.parameters = Parameters(
            alphas=(a1, a2, a3, a4),
            noise="std" if self.std.value else "variance",
            rotation_noise="literal" if self.literal.value else "symmetric",
        )
        step = np.array([self.forward.value / 1000, self.left.value / 1000, np.radians(self.turned.value)])
        nowhere, exactly = np.zeros(3), Parameters(alphas=(0, 0, 0, 0))
        self.parts = motion_parts(nowhere, step)
        self.deviations = motion_deviations(*self.parts, self.parameters)
        rng = np.random.default_rng(self._seed)
        way, self.poses = [np.zeros((1, 3))], np.zeros((N_PARTICLES, 3))
        for _ in range(int(self.steps.value)):
            way.append(sample_motion(way[-1], nowhere, step, rng, exactly))
            self.poses = sample_motion(self.poses, nowhere, step, rng, self.parameters)
        self.exact = np.concatenate(way)
        off = self.poses - self.exact[-1]
        self.spread_m = float(np.sqrt(np.square(off[:, :2]).sum(axis=1).mean()))
        self.spread_deg = float(np.degrees(np.sqrt(np.square(wrap_angle(off[:, 2])).mean())))
        self.pictures[0].show_svg(self._cloud(), f"Where the robot may be and where it may look. {self.summary()}")
        rot1, trans, rot2 = self.parts
        first, line, second = self.deviations
        rows = [
            ("&delta;<sub>rot1</sub>", f"{np.degrees(rot1):+.1f}&deg; &plusmn; {np.degrees(first):.1f}&deg;"),
            ("&delta;<sub>trans</sub>", f"{1000 * trans:.0f} mm &plusmn; {1000 * line:.0f} mm"),
            ("&delta;<sub>rot2</sub>", f"{np.degrees(rot2):+.1f}&deg; &plusmn; {np.degrees(second):.1f}&deg;"),
            ("sample(b) takes b as", "deviation" if self.std.value else "variance"),
            ("noise of a turn by &pi;", "of &pi; (as printed)" if self.literal.value else "of 0 (symmetric)"),
            ("after the last step", f"<b>&plusmn; {self.spread_m:.2f} m, &plusmn; {self.spread_deg:.0f}&deg;</b>"),
            ("picture", f"blue: {N_PARTICLES} particles, and where<br>they look; red: as the wheels say"),
        ]
        self.readout.value = table(rows, caption="one step, and what noise it gets")

    def summary(self) -> str:
        """The parts, their deviations, the cloud."""
        rot1, trans, rot2 = self.parts
        return (
            f"rot1 {np.degrees(rot1):+.0f}, trans {trans:.3f} m, rot2 {np.degrees(rot2):+.0f} degrees, "
            f"{self.steps.value:.0f} times: "
            f"{self.spread_m:.2f} m and {self.spread_deg:.0f} degrees round what the wheels say"
        )

    def _cloud(self) -> str:
        """Particles with strokes where they look, and the way of the wheels."""
        shown = np.concatenate([self.exact[:, :2], self.poses[:, :2]])
        low, high = shown.min(axis=0), shown.max(axis=0)
        half = 2.0 ** max(0, int(np.ceil(np.log2(0.55 * float((high - low).max())))))  # few scales, so that clouds compare
        (x, y), ticks = (low + high) / 2, _ticks(half)
        size = (LEFT + SIDE + 16, TOP + SIDE + 40)
        plane = Plane(
            (x - half, x + half),
            (y - half, y + half),
            ("x, metres", "y, metres"),
            "after the last step",
            size,
            x_ticks=[t for t in ticks if abs(t - x) <= half],
            y_ticks=[t for t in ticks if abs(t - y) <= half],
        )
        look = 0.1 * half * np.column_stack([np.cos(self.poses[:, 2]), np.sin(self.poses[:, 2])])
        plane.strokes(self.poses[:, :2], self.poses[:, :2] + look, f"stroke='{BLUE}' stroke-opacity='0.35'")
        plane.strokes(self.poses[:, :2], self.poses[:, :2], f"stroke='{BLUE}' stroke-width='3' stroke-linecap='round'")
        plane.line(self.exact[:, 0], self.exact[:, 1], f"stroke='{RED}' stroke-width='1.5' stroke-dasharray='5 3'")
        ahead = 0.2 * half * np.column_stack([np.cos(self.exact[:, 2]), np.sin(self.exact[:, 2])])
        ends = [0, -1]
        plane.strokes(self.exact[ends, :2], (self.exact[:, :2] + ahead)[ends], f"stroke='{RED}' stroke-width='2.5'")
        plane.points(self.exact[ends, 0], self.exact[ends, 1], "dot", RED, 4.5)
        return plane.svg()


def _ticks(half: float) -> list[float]:
    """Round numbers, four to ten of them across the picture."""
    step = next(step for step in (0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0) if 2 * half / step <= 10)
    return [round(step * i, 2) for i in range(-40, 41)]
