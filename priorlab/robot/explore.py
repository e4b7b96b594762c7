"""A robot that knows its poses looks around in a building that is known: the simulator of thesis 4.5.2."""

from __future__ import annotations

import math
from collections.abc import Sized

import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.building import Truth, World
from priorlab.core.checks import check_poses, check_record, check_whole
from priorlab.core.grid import Grid
from priorlab.core.progress import Progress
from priorlab.core.readings import Readings
from priorlab.core.sensor import RangeSensor
from priorlab.robot.indoors import is_outdoors
from priorlab.robot.range_noise import RangeNoise, disturb
from priorlab.robot.rays import cast_rays

EXACT = RangeNoise()
"""The sensor of chapter 4: every range is right."""


MOST_REPEATS = 100_000
"""Readings per pose: more say nothing new, and would not fit into memory."""


def explore(
    building: Truth | World,
    survey: ArrayLike,
    sensor: RangeSensor | None = None,
    rng: np.random.Generator | None = None,
    noise: RangeNoise = EXACT,
    repeats: int = 1,
    progress: Progress | None = None,
) -> Readings:
    """Measure ranges from every pose of a survey: one per bearing, bearings so dense that no pixel is missed.

    Parameters
    ----------
    building : what stands in the way (`.obstacles`): the plan's truth, or a world with furniture
    survey : (N, 3) poses x, y, theta; pixels, y up; `read_poses` reads them from a file
    sensor : range and opening of the cone; `RangeSensor()` by default
    rng : draws the noise; not needed for exact ranges
    noise : faults of the sensor (thesis 5.3), in pixels. A lost reading, and one of an obstacle in the blind zone, is no
        reading: its range is nan, `valid` is False, and no cell gets evidence from it
    repeats : readings per pose, each with its own noise (thesis 5.3 takes 1 and 3)
    progress : called with the poses done and the poses to do

    Returns
    -------
    Readings of `repeats` x N poses; the repeats of a pose follow one another.

    Raises
    ------
    ValueError
        For an empty survey, a pose that is not finite, lies off the map, in an obstacle or outdoors (when the truth has doors
        that can be shut), noise without `rng`.

    >>> walls = np.zeros((5, 9), dtype=bool)
    >>> walls[:, 7] = True
    >>> readings = explore(Truth(walls, ~walls & False), [[2.5, 2.5, 0.0]], RangeSensor(max_range=6))
    >>> readings.ranges[0, len(readings.bearings) // 2].item()
    4.5
    """
    sensor = RangeSensor() if sensor is None else sensor
    check_record("building", building, Truth, World)
    check_record("sensor", sensor, RangeSensor)
    check_record("noise", noise, RangeNoise)
    poses = _check_survey(building, survey)
    repeats = check_whole("repeats", repeats, most=MOST_REPEATS)
    bearings = bearings_of(sensor)
    angles = poses[:, 2, None] + bearings
    origins = np.repeat(poses[:, :2], len(bearings), axis=0)
    reach = sensor.max_range + 6 * noise.deviation  # noise may bring a far obstacle within range
    tell = progress and (lambda done, to_do: progress(done // len(bearings), to_do // len(bearings)))
    ranges = cast_rays(building.obstacles, origins, angles.ravel(), reach, tell).reshape(angles.shape)
    if repeats > 1:
        poses, ranges = np.repeat(poses, repeats, axis=0), np.repeat(ranges, repeats, axis=0)
    if noise == EXACT:
        return Readings(poses, ranges, bearings, sensor, building.obstacles.shape)
    ranges = disturb(ranges, noise, sensor.max_range, rng)
    return Readings(poses, ranges, bearings, sensor, building.obstacles.shape, valid=~np.isnan(ranges))


def bearings_of(sensor: RangeSensor) -> NDArray[np.float64]:
    """(B,) bearings from -half_angle to half_angle, right to left, at most one pixel apart at `max_range`; B is odd.

    Then every pixel of the cone has a ray within half a pixel, and a straight wall never hides a free pixel before it.

    >>> len(bearings_of(RangeSensor(max_range=40)))
    43
    """
    per_side = max(1, math.ceil(sensor.half_angle * sensor.max_range))
    return np.linspace(-sensor.half_angle, sensor.half_angle, 2 * per_side + 1)


def _check_survey(building: Truth | World, survey: ArrayLike) -> NDArray[np.float64]:
    """The survey's poses, or a sentence about the first that no robot can take."""
    obstacles = building.obstacles
    if isinstance(survey, Sized) and len(survey) == 0:
        raise ValueError("survey must hold at least one pose x, y, theta, got none")
    poses = check_poses("survey", survey)
    grid = Grid(obstacles.shape)
    outside = np.flatnonzero(~grid.contains(poses))
    if outside.size:
        row, (height, width) = outside[0], obstacles.shape
        x, y = poses[row, :2]
        raise ValueError(f"survey must stay on the map of {width} x {height} pixels, got x, y = {x:g}, {y:g} in row {row}")
    blocked = np.flatnonzero(obstacles[tuple(grid.xy_to_pixel(poses[:, :2]).T)])
    if blocked.size:
        x, y = poses[blocked[0], :2]
        raise ValueError(f"survey must stand in free space, got an obstacle at x, y = {x:g}, {y:g} in row {blocked[0]}")
    left = np.flatnonzero(is_outdoors(building, poses[:, :2]))
    if left.size:
        x, y = poses[left[0], :2]
        raise ValueError(f"survey must stay in the building, got x, y = {x:g}, {y:g} outdoors in row {left[0]}")
    return poses
