"""The numbers of chapter 6 as one frozen record, and its two presets: as printed, and as it works.

Changing one value is `FastSLAM(TUNED, temper=0.1)` or `dataclasses.replace(TUNED, temper=0.1)`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Literal

from priorlab.core.checks import (
    as_float,
    check_choice,
    check_flag,
    check_not_negative,
    check_positive,
    check_probability,
    check_share,
    check_whole,
)
from priorlab.core.log_odds import OCCUPIED_IN_FIELD
from priorlab.core.sensor import MOST_ALPHA, check_sensor_model

MOST_OWN_MAPS = 100
"""Particles that may have a map of their own (`localize_in="own"`): a step takes about a millisecond for each."""


MOST_PARTICLES = 10_000_000
"""More would not fit into a computer's memory."""

LEAST, MOST = 1e-6, 1e6
"""Sizes, angles and spreads outside mean nothing, and their squares would leave the numbers that there are."""

LEAST_PROBABILITY = 1e-12
"""Below it a likelihood would vanish in the field's 32 bits."""

METHODS = ("systematic", "stratified", "multinomial")
"""How particles are drawn."""


@dataclass(frozen=True)
class Parameters:
    """What FastSLAM assumes of the wheels, the scanner, the particles and the map. Metres and radians.

    Parameters
    ----------
    alphas : alpha_1..4 of algorithm 6.3: rotation from rotation, rotation from translation, translation from translation,
        translation from rotation. 0.004 is twice the noise of the simulated wheels (`ODOMETRY`); Table 6.1 prints 0.2
    noise : what `sample(b)` draws: "variance" takes b as a variance (as the algorithm's source has it), "std" as a deviation
    rotation_noise : "symmetric" measures a rotation to the nearer of 0 and pi, so that a tiny odometry translation in a turn on
        the spot, whose direction is chance, is not taken for a turn by pi; "literal" as printed
    p_through_wall : share of its weight (no P(empty)) that a particle keeps when it drives into a wall of the plan
        (`Impassable`); 1 asks nothing of it, as printed. Not 0: a plan may wall up a doorway
    robot_radius_m : the poses of the log come no nearer to a wall than this. 0.15 is a little less than a TurtleBot's radius of
        0.18; where poses are those of a laser at the bumper, take the distance that it keeps
    n_beams : beams of a scan that weigh, spread evenly over those with a return (Table 6.1)
    sigma_hit_m : deviation of a beam's end from an obstacle, sigma_hit; Table 6.1 prints 0.2
    z_random : weight of unexplained readings; z_hit is the rest. Table 6.1 prints 0.05; see the note on furniture
    max_distance_m : the field grows no further from an obstacle; our reading of Table 6.1's z_max = 2
    max_range_m : ranges from here on are no return; the divisor of z_random. Table 6.1: 12 ("measurement limits"), the Kinect: 3
    temper : exponent of a full scan's likelihood; 1 as printed. Beams of one scan are not independent: 0.05 counts 60 of them as
        three, and fewer beams by the root of their number (`scan_exponent`)
    weigh_every_m, weigh_every_theta : a scan weighs once the robot has driven so far or turned so much since the last one that
        did. Scans from one place are not independent either; 0 weighs every scan, as printed
    occupied_below : a cell is an obstacle for the field when P(empty) is below this
    sensor_offset_m : x, y of the scanner in the robot's frame, x_sens and y_sens of algorithm 6.4
    particle_limits : fewest and most particles (Table 6.1)
    kld_epsilon, kld_quantile : allowed Kullback-Leibler distance and the normal quantile of its confidence, 99 % (Fox 2003)
    kld_bin_m, kld_bin_theta : bins in which the spread is counted (the defaults of ROS AMCL, after Fox 2003)
    resampling : "systematic", "stratified" or "multinomial"; algorithm 6.2 only says "draw with probability"
    resampling_interval : a resampling follows every n-th scan that weighed (Table 6.1)
    estimate : "cluster" is the mean of the heaviest cluster, our reading of algorithm 6.2; "mean" of all; "best" particle
    start_variances : (3,) variances of x, y (m^2) and theta (rad^2) at the start; 0 is exact (6.2.2), 0.1 each is eq. 6.3
    localize_in : "updated", the map as it grows (algorithm 6.1), or "static", the plan alone (6.3), or
        "own", a map per particle (2.2.3), for at most 100 of them; see the note
    lag_m : the scans of the last metres of way are not yet in the map that "updated" and "own" localize in; 0 as printed
    p_free, p_occupied : inverse sensor model, P(empty), eq. 6.1 (Table 6.1)
    lam : weight of "- l_0" in eq. 6.2; 1 as printed, 0 is Bayes for a sensor model made with prior 0.5
    thickening_m : occupied space behind a hit, along the beam (6.2.2 gives no number); 0 is the hit's cell alone
    free_on_no_return : whether a beam that met nothing carves free space up to `max_range_m`

    Notes
    -----
    The defaults are `TUNED`. They hold on `office_floor`, whose world has furniture, open door leaves and two doorways that the
    plan lacks, and on furnished real buildings with their clean plans (`priorlab.study.clutter_pairs`).

    - A Gaussian of 0.2 m with z_random = 0.5 pulls the leaves of doors onto the nearest wall: the robot gets lost in all of five
      runs (ATE 0.2 to 2.4 m). A narrow Gaussian with heavy tails leaves aside what the plan does not explain (0.10 to 0.14 m).
    - Furniture along a wall looks like the wall. A particle that has been drawn to it soon drives into a jamb, and
      `p_through_wall` tells it from one that drives through the doorway. Without it (1, as printed) the same five drives have an
      ATE of up to 0.32 m (with it 0.14 m), and wheels with three times the noise get lost in four of five (in one).
    - A robot that turns in front of a bookcase sees it again and again, 0.35 m before the wall where the plan has nothing. When
      every one of these scans weighs and `p_through_wall` is 1, they outvote all that it saw before (up to 1.8 m off in one
      building of three). So a scan weighs after 0.2 m or 20 degrees, as ROS AMCL's `update_min_d` and `update_min_a` have it.
    - Where few beams return, they are all there is: the root of their number keeps the way through a hall (at most 0.7 m off
      instead of 1.0 m). A drive that keeps to the walls (`priorlab.study.full_tour`) goes at most 8 m with hardly a return, and
      none of 36 through real buildings got lost. A longer way through nothing stays a risk: there the wheels steer alone.
    - With wheels ten times worse (0.02, and alphas of 0.05) four of five runs on `office_floor` get lost for a while (ATE 0.2 to
      0.4 m; with `p_through_wall` 1 all five, 0.9 to 1.6 m).
    - Localizing in the map as it grows drifts on `office_floor` (ATE 0.7 to 4.3 m, all lost): most of what the robot sees was
      written by its own last scans, so an error of heading becomes the map. In a map that lags by the range of its eyes, 3 m, it
      got lost in none of five runs, a little further off than in the plan (0.15 m, in the plan 0.11 m). lam = 0 does not help.

    >>> Parameters().particle_limits
    (1500, 4500)
    """

    # motion, algorithm 6.3
    alphas: tuple[float, float, float, float] = (0.004, 0.004, 0.004, 0.004)
    noise: Literal["variance", "std"] = "variance"
    rotation_noise: Literal["symmetric", "literal"] = "symmetric"
    p_through_wall: float = 0.1
    robot_radius_m: float = 0.15
    # measurement, algorithm 6.4
    n_beams: int = 60
    sigma_hit_m: float = 0.05
    z_random: float = 0.98
    max_distance_m: float = 2.0
    max_range_m: float = 3.0
    temper: float = 0.05
    weigh_every_m: float = 0.2
    weigh_every_theta: float = math.radians(20.0)
    occupied_below: float = OCCUPIED_IN_FIELD
    sensor_offset_m: tuple[float, float] = (0.0, 0.0)
    # particles, algorithm 6.2
    particle_limits: tuple[int, int] = (1500, 4500)
    kld_epsilon: float = 0.01
    kld_quantile: float = 2.326
    kld_bin_m: float = 0.5
    kld_bin_theta: float = math.radians(10.0)
    resampling: Literal["systematic", "stratified", "multinomial"] = "systematic"
    resampling_interval: int = 1
    estimate: Literal["cluster", "mean", "best"] = "cluster"
    start_variances: tuple[float, float, float] = (0.0, 0.0, 0.0)
    # map, algorithms 6.1 and 6.5
    localize_in: Literal["updated", "static", "own"] = "static"
    lag_m: float = 3.0
    p_free: float = 0.8
    p_occupied: float = 0.2
    lam: float = 1.0
    thickening_m: float = 0.10
    free_on_no_return: bool = False

    def __post_init__(self) -> None:
        for name, choices in _CHOICES.items():
            check_choice(name, getattr(self, name), choices)
        for name in ("sigma_hit_m", "max_distance_m", "max_range_m", "kld_epsilon", "kld_quantile", "kld_bin_m", "kld_bin_theta"):
            if not LEAST <= check_positive(name, getattr(self, name)) <= MOST:
                raise ValueError(f"{name} must lie between {LEAST:g} and {MOST:g}, got {getattr(self, name):g}")
        for name in ("z_random", "occupied_below"):
            if check_probability(name, getattr(self, name)) < LEAST_PROBABILITY:
                raise ValueError(f"{name} must be at least {LEAST_PROBABILITY:g}, got {getattr(self, name):g}")
        check_sensor_model(self.p_free, self.p_occupied)
        for name, n_values, most in (("alphas", 4, MOST_ALPHA), ("start_variances", 3, MOST**2)):
            values = _as_numbers(getattr(self, name))
            if len(values) != n_values or not all(value >= 0 for value in values):
                raise ValueError(f"{name} must be {n_values} finite numbers of at least 0, got {getattr(self, name)}")
            if max(values) > most:
                raise ValueError(f"{name} must be at most {most:g}, got {max(values):g}")
            object.__setattr__(self, name, values)  # a list is as good as a tuple, but a record must hash
        offset = _as_numbers(self.sensor_offset_m)
        if len(offset) != 2:
            raise ValueError(f"sensor_offset_m must be two finite numbers x, y, got {self.sensor_offset_m}")
        if max(map(abs, offset)) > MOST:
            raise ValueError(f"sensor_offset_m must be at most {MOST:g}, got {self.sensor_offset_m}")
        object.__setattr__(self, "sensor_offset_m", offset)
        for name in ("n_beams", "resampling_interval"):
            object.__setattr__(self, name, check_whole(name, getattr(self, name), most=MOST_PARTICLES))
        limits = _as_numbers(self.particle_limits)
        if len(limits) != 2 or not (1 <= limits[0] <= limits[1] and all(limit.is_integer() for limit in limits)):
            raise ValueError(f"particle_limits must be the fewest, at least 1, and the most, got {self.particle_limits}")
        fewest, most = (int(limit) for limit in limits)
        if most > MOST_PARTICLES:
            raise ValueError(f"particle_limits must be at most {MOST_PARTICLES:,}, got {most:g}")
        object.__setattr__(self, "particle_limits", (fewest, most))
        if self.localize_in == "own" and most > MOST_OWN_MAPS:
            raise ValueError(f"particle_limits must be at most {MOST_OWN_MAPS} for a map per particle, got {most}")
        for name in ("temper", "p_through_wall"):
            if not 0 < as_float(name, getattr(self, name)) <= 1:
                raise ValueError(f"{name} must lie in (0, 1], got {getattr(self, name):g}")
        check_share("lam", self.lam)
        for name in ("robot_radius_m", "weigh_every_m", "weigh_every_theta", "lag_m", "thickening_m"):
            check_not_negative(name, getattr(self, name), MOST)
        object.__setattr__(self, "free_on_no_return", check_flag("free_on_no_return", self.free_on_no_return))


def _as_numbers(values: Any) -> tuple[float, ...]:
    """The values as finite floats; none when they are something else, which the check of their number then says."""
    try:
        numbers = tuple(float(value) for value in values)
    except (TypeError, ValueError, OverflowError):
        return ()
    return numbers if all(map(math.isfinite, numbers)) else ()


_CHOICES = {
    "noise": ("variance", "std"),
    "rotation_noise": ("symmetric", "literal"),
    "resampling": METHODS,
    "estimate": ("cluster", "mean", "best"),
    "localize_in": ("updated", "static", "own"),
}

TUNED = Parameters()
"""What localizes well with the simulated Kinect and wheels (`KINECT`, `ODOMETRY`)."""

TABLE_6_1 = Parameters(
    alphas=(0.2, 0.2, 0.2, 0.2),
    rotation_noise="literal",
    p_through_wall=1.0,
    sigma_hit_m=0.2,
    z_random=0.05,
    max_range_m=12.0,
    temper=1.0,
    weigh_every_m=0.0,
    weigh_every_theta=0.0,
    thickening_m=0.0,
    localize_in="updated",
    lag_m=0.0,
)
"""Table 6.1 to the letter, with algorithms 6.3 and 6.4 as printed: such a filter gets lost, and notebook 09 shows why."""
