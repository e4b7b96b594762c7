"""Algorithm 6.4 under sliders: the likelihood field of a plan, one scan laid on it, and what its pose weighs."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from priorlab.core.grid_map import GridMap
from priorlab.core.pose import wrap_angle
from priorlab.core.readings import RobotLog
from priorlab.plot.style import BLUE, RED
from priorlab.slam.likelihood_field import LikelihoodField, log_likelihood_of
from priorlab.slam.measurement import log_weights, share_explained
from priorlab.slam.parameters import TABLE_6_1, TUNED, Parameters
from priorlab.slam.scan import choose_beams
from priorlab.widgets.canvas import GREEN as TRUE
from priorlab.widgets.canvas import PINK
from priorlab.widgets.floor_canvas import FloorCanvas
from priorlab.widgets.lab import Lab, table
from priorlab.widgets.picture import Picture
from priorlab.widgets.plane import Plane, cividis
from priorlab.widgets.sliders import Slider

HALF_M, ZOOM = 4.0, 2
SHIFTS_M = np.round(np.arange(-4.0, 4.001, 0.05), 3)

_HERE = {"dx": 0.0, "dy": 0.0, "turn": 0.0}


def _numbers(parameters: Parameters) -> dict[str, float]:
    """The four sliders of a preset."""
    names = {"sigma_hit": "sigma_hit_m", "z_random": "z_random", "max_distance": "max_distance_m", "temper": "temper"}
    return {slider: getattr(parameters, name) for slider, name in names.items()}


PRESETS: dict[str, dict[str, float]] = {
    "where it stood": _HERE,
    "20 cm beside": {"dx": 0.2, "dy": 0, "turn": 0},
    "turned by 20 degrees": {"dx": 0, "dy": 0, "turn": 20},
    "Table 6.1's numbers": _numbers(TABLE_6_1),
    "tuned": _numbers(TUNED),
    "temper 1": {"temper": 1},
}


class FieldLab(Lab):
    """Read `lab.field`, `lab.pose`, `lab.log_weight`, `lab.log_likelihood`, `lab.ratio`, `lab.explained`, `lab.across`.

    Parameters
    ----------
    grid_map : the plan, on a grid that knows its scale
    log : a drive with its truth
    step : whose scan is shown
    parameters : where the sliders start; the sensor's range is its own
    looks_like : metres to the right of the true pose that a preset leads to, when another place looks alike

    Attributes
    ----------
    pose : (3,) where the scan is laid from
    log_likelihood, log_weight : sum of the beams' logarithms, and the weight that the temper makes of it
    ratio : its weight over that of the true pose
    explained : share of the beams that end near an obstacle
    across : (161,) log weights of the poses to the left and right of it
    """

    def __init__(
        self, grid_map: GridMap, log: RobotLog, step: int, parameters: Parameters = TUNED, looks_like: float | None = None
    ) -> None:
        if log.truth is None:
            raise ValueError("log must hold its truth for this lab, got none")
        self._map, self._given = grid_map, parameters
        self.truth, self.scan = log.truth[step], choose_beams(log, step, parameters)
        self._field_of = lru_cache(maxsize=16)(lambda chosen: LikelihoodField.of(grid_map, chosen))
        self.dx = Slider("to the right, m", 0, -4, 4, 0.05, "how far right of the true place the scan is laid")
        self.dy = Slider("up, m", 0, -2, 2, 0.05, "how far above the true place the scan is laid")
        self.turn = Slider("turned, degrees", 0, -90, 90, 1, "against the true heading")
        self.sigma_hit = Slider("sigma_hit, m", parameters.sigma_hit_m, 0.01, 0.5, 0.01, "deviation of a beam's end from a wall")
        self.z_random = Slider("z_random", parameters.z_random, 0.01, 0.99, 0.01, "weight of readings that nothing explains")
        self.max_distance = Slider("max distance, m", parameters.max_distance_m, 0.1, 4, 0.1, "the field grows no further")
        self.temper = Slider("temper", parameters.temper, 0.01, 1, 0.01, "exponent of the likelihood; 1 as printed")
        names = ("dx", "dy", "turn", "sigma_hit", "z_random", "max_distance", "temper")
        presets = dict(PRESETS) if looks_like is None else {**PRESETS, "the room next door": {**_HERE, "dx": looks_like}}
        super().__init__({name: getattr(self, name) for name in names}, presets, [Picture(), Picture()])

    def refresh(self) -> None:
        """Field, weight of the pose, and of the poses beside it."""
        self.parameters = replace(
            self._given,
            sigma_hit_m=round(self.sigma_hit.value, 6),
            z_random=round(self.z_random.value, 6),
            max_distance_m=round(self.max_distance.value, 6),
            temper=round(self.temper.value, 6),
        )
        self.field = self._field_of(self.parameters)
        self.pose = self.truth + [self.dx.value, self.dy.value, np.radians(self.turn.value)]
        self.pose[2] = wrap_angle(self.pose[2])
        beside = np.tile(self.pose, (len(SHIFTS_M), 1))
        beside[:, 0] = self.truth[0] + SHIFTS_M
        poses = np.vstack([self.truth, self.pose, beside])
        weights = log_weights(poses, self.scan, self.field)
        as_printed = LikelihoodField(self.field.image, self.field.grid, replace(self.parameters, temper=1.0))
        literal = log_weights(poses, self.scan, as_printed)
        self.log_weight, self.across = float(weights[1]), weights[2:]
        self.log_likelihood, self._literal = float(literal[1]), literal[2:]
        self.ratio = float(np.exp(weights[1] - weights[0]))
        self.explained = share_explained(self.pose, self.scan, self.field)
        self.pictures[0].show(self._paint(), f"The likelihood field, yellow = likely, and the scan laid on it. {self.summary()}")
        self.pictures[1].show_svg(self._curve(), f"Weight of the poses beside this one, over the largest. {self.summary()}")
        at_wall = float(log_likelihood_of(np.array(0.0), self.parameters))
        rows = [
            ("beams that returned", f"{len(self.scan)}"),
            ("one beam that ends at a wall", f"ln = {at_wall:+.2f}"),
            ("one that ends far from any", f"ln = {self.field.far:+.2f}"),
            ("all beams, the product q", f"ln q = {self.log_likelihood:+.1f}"),
            ("tempered", f"<b>ln w = {self.log_weight:+.2f}</b>"),
            ("weight over the true pose's", f"<b>{self.ratio:.3g}</b>"),
            ("beams that end near a wall", f"{100 * self.explained:.0f} %"),
            ("left picture", "yellow: likely; pink: the scan;<br>green: where the robot stood"),
            ("right picture", "blue: weights; dashed: with temper 1"),
        ]
        self.readout.value = table(rows, caption="algorithm 6.4")

    def summary(self) -> str:
        """Where the scan is laid, and what that weighs."""
        return (
            f"{self.dx.value:+.2f} m right, {self.dy.value:+.2f} m up, {self.turn.value:+.0f} degrees, temper "
            f"{self.temper.value:.2f}: ln q {self.log_likelihood:+.1f}, ln w {self.log_weight:+.2f}, "
            f"{100 * self.explained:.0f} % of {len(self.scan)} beams near a wall"
        )

    def _paint(self) -> NDArray[np.uint8]:
        """Field, scan, both poses."""
        floor = FloorCanvas(self._map.grid, np.zeros((1, 1), np.uint8), ZOOM, self.truth[:2], HALF_M)
        at_wall = float(log_likelihood_of(np.array(0.0), self.parameters))
        floor.colour(self.field.image, lambda cells: cividis(cells, self.field.far, at_wall))
        floor.beams(self.pose, self.scan.points, PINK)
        floor.robot(self.truth, TRUE)
        floor.robot(self.pose, PINK)
        return floor.picture

    def _curve(self) -> str:
        """Weights of the poses left and right, over their largest; as set, and with temper 1."""
        plane = Plane(
            (-4, 4), (0, 1.05), ("to the right of the true place, m", "weight / largest"), "slid sideways", (360, 320),
            x_ticks=(-4, -2, 0, 2, 4), y_ticks=(0, 0.5, 1),
        )  # fmt: skip
        plane.line(SHIFTS_M, np.exp(self._literal - self._literal.max()), "stroke='#555' stroke-dasharray='4 3'")
        plane.line(SHIFTS_M, np.exp(self.across - self.across.max()), f"stroke='{BLUE}' stroke-width='2'")
        plane.points(self.dx.value, float(np.exp(self.log_weight - self.across.max())), "dot", RED, 5)
        return plane.svg()
