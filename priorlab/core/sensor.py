"""What a sensor can do, as records: the cone of chapters 4-5 in pixels, the scanner of chapter 6 in metres, odometry."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import (
    as_float,
    as_numbers,
    check_not_negative,
    check_positive,
    check_probability,
    check_share,
    check_whole,
)

MOST_BEAMS = 1_000_000

MOST_ALPHA = 1e6
"""Wheels that err by a kilometre a metre say nothing, and their squares would leave the numbers that there are."""


@dataclass(frozen=True)
class RangeSensor:
    """The Kinect of chapters 4-5, simplified to a cone in the drawing's pixels (thesis 4.5.2).

    Parameters
    ----------
    max_range : pixels; the thesis takes the length of a door's side (20 or 40)
    half_angle : half the opening of the cone, radians (phi = pi/6)
    p_free, p_occupied : inverse sensor model, P(empty) of a cell that was seen free, seen as wall (eq. 4.22)
    beyond : what "beyond the obstacle" means in eq. 4.22: "thickness" marks at most `wall_thickness` pixels behind the
        hit, "hit_cell" only the cell that was hit (eq. 6.1), "all" the whole shadow (the literal reading)
    wall_thickness : pixels
    """

    max_range: float = 40.0
    half_angle: float = math.pi / 6
    p_free: float = 0.9
    p_occupied: float = 0.1
    beyond: Literal["thickness", "hit_cell", "all"] = "thickness"
    wall_thickness: float = 4.0

    def __post_init__(self) -> None:
        for name in ("max_range", "half_angle", "wall_thickness"):
            check_positive(name, getattr(self, name))
        if self.half_angle > np.pi:
            raise ValueError(f"half_angle must be at most pi radians, got {self.half_angle:g}")
        check_sensor_model(self.p_free, self.p_occupied)
        if not isinstance(self.beyond, str) or self.beyond not in ("thickness", "hit_cell", "all"):
            raise ValueError(f"beyond must be 'thickness', 'hit_cell' or 'all', got {self.beyond!r}")


@dataclass(frozen=True)
class Scanner:
    """A planar scanner in metres (chapter 6): beams spread evenly over a field of view, with its faults.

    Parameters
    ----------
    n_beams : beams per scan
    field_of_view : full angle, radians
    min_range_m, max_range_m : readings outside are no return (the blind zone and the end of the range)
    range_noise_m : standard deviation of a range
    outlier_rate, dropout_rate : share of readings that are random, that are missing
    """

    n_beams: int = 60
    field_of_view: float = math.radians(58.0)
    min_range_m: float = 0.4
    max_range_m: float = 3.0
    range_noise_m: float = 0.02
    outlier_rate: float = 0.01
    dropout_rate: float = 0.02

    def __post_init__(self) -> None:
        object.__setattr__(self, "n_beams", check_whole("n_beams", self.n_beams, most=MOST_BEAMS))
        for name in ("field_of_view", "max_range_m"):
            check_positive(name, getattr(self, name))
        if not 0 <= as_float("min_range_m", self.min_range_m) < self.max_range_m:
            raise ValueError(f"min_range_m must lie in [0, max_range_m), got {self.min_range_m:g}")
        check_not_negative("range_noise_m", self.range_noise_m)
        for name in ("outlier_rate", "dropout_rate"):
            check_share(name, getattr(self, name))

    @property
    def bearings(self) -> NDArray[np.float64]:
        """(n_beams,) angle of every beam to the robot's heading, radians, right to left."""
        half = self.field_of_view / 2
        return np.linspace(-half, half, self.n_beams) if self.n_beams > 1 else np.zeros(1)


@dataclass(frozen=True)
class Odometry:
    """How wheels err (algorithm 6.3): variances alpha_1..4 per squared metre or radian of a step.

    `alphas`: rotation from rotation, rotation from translation, translation from translation, translation from rotation.
    """

    alphas: tuple[float, float, float, float] = (0.002, 0.002, 0.002, 0.002)

    def __post_init__(self) -> None:
        alphas = as_numbers("alphas", self.alphas)
        if alphas.shape != (4,) or not (np.isfinite(alphas) & (alphas >= 0)).all():
            raise ValueError(f"alphas must be four finite numbers of at least 0, got {self.alphas}")
        if alphas.max() > MOST_ALPHA:
            raise ValueError(f"alphas must be at most {MOST_ALPHA:g}, got {alphas.max():g}")
        object.__setattr__(self, "alphas", tuple(alphas.tolist()))  # a list is as good as a tuple, but a record must hash


KINECT = Scanner()
"""The Kinect of chapters 5.3 and 6: 58 degrees, 60 beams, 0.4 to 3 m."""

ODOMETRY = Odometry()
"""A TurtleBot's wheels: 0.002 in all four alphas."""


def check_sensor_model(p_free: float, p_occupied: float) -> None:
    """Say when an inverse sensor model contradicts itself: seen free must mean emptier than seen occupied."""
    check_probability("p_free", p_free)
    check_probability("p_occupied", p_occupied)
    if p_free <= p_occupied:
        raise ValueError(f"p_free must be above p_occupied, got {p_free:g} and {p_occupied:g}")
