"""A robot drives through a world and records what a robot would: odometry and scans (thesis 6.2), in metres."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.building import World
from priorlab.core.checks import as_numbers, check_positive, check_record, check_rng
from priorlab.core.grid import Grid
from priorlab.core.pose import wrap_angle
from priorlab.core.readings import RobotLog
from priorlab.core.sensor import KINECT, ODOMETRY, Odometry, Scanner
from priorlab.robot.odometry import report_odometry
from priorlab.robot.range_noise import RangeNoise, disturb
from priorlab.robot.rays import cast_rays


def drive(
    world: World,
    tour: ArrayLike,
    scanner: Scanner = KINECT,
    odometry: Odometry = ODOMETRY,
    rng: np.random.Generator | None = None,
    step_m: float = 0.1,
    turn: float = math.radians(15),
) -> RobotLog:
    """Drive a tour: turn on the spot at its corners, go straight between them, scan after every step.

    Parameters
    ----------
    world : what stands in the way
    tour : (M, 2) corners x, y; metres, y up
    scanner : beams, range and faults
    odometry : how the wheels err
    rng : draws the faults; wheels and scanner get generators of their own, so that a change of one leaves the other as it was
    step_m, turn : longest straight step, metres, and widest turn, radians, between two scans

    Returns
    -------
    RobotLog with the truth. Its odometry begins at the true start. A beam that meets nothing within range is inf; a lost one, and
    one that ends in the blind zone, is nan: it says nothing, least of all that the way is free up to the range's end.

    Raises
    ------
    ValueError
        When the tour has no way to go, is not finite, leaves the map or runs through an obstacle.

    >>> world = World(np.zeros((20, 60), dtype=bool), metres_per_pixel=0.05)
    >>> drive(world, [[0.5, 0.5], [2.5, 0.5]], rng=np.random.default_rng(0))
    RobotLog(21 scans of 60 beams over 2.0 m)
    """
    rng = check_rng(rng)
    for name, value, kind in (("world", world, World), ("scanner", scanner, Scanner), ("odometry", odometry, Odometry)):
        check_record(name, value, kind)
    truth = true_path(tour, step_m, turn)
    _check_way(world, truth)
    rng_wheels, rng_scanner = rng.spawn(2)
    return RobotLog(
        odometry=report_odometry(truth, odometry, rng_wheels),
        ranges=_scan(world, truth, scanner, rng_scanner),
        bearings=scanner.bearings,
        scanner=scanner,
        start=truth[0],
        truth=truth,
    )


class BlockedTourError(ValueError):
    """A tour that leaves the map or runs through an obstacle."""


def true_path(tour: ArrayLike, step_m: float = 0.1, turn: float = math.radians(15)) -> NDArray[np.float64]:
    """(T, 3) poses along a tour (M, 2): equal steps of at most `step_m`, equal turns on the spot of at most `turn`.

    >>> true_path([[0, 0], [1, 0], [1, 1]], step_m=1.0, turn=np.pi / 2).round(2).tolist()
    [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, 1.57], [1.0, 1.0, 1.57]]
    """
    check_positive("step_m", step_m)
    check_positive("turn", turn)
    corners = as_numbers("tour", tour)
    if corners.ndim != 2 or corners.shape[1] != 2:
        raise ValueError(f"tour must have shape (M, 2) for x, y in metres, got shape {corners.shape}")
    if not np.isfinite(corners).all():
        row = int(np.flatnonzero(~np.isfinite(corners).all(axis=1))[0])
        raise ValueError(f"tour must be finite numbers, got {corners[row].tolist()} in row {row}")
    legs = np.diff(corners, axis=0)
    moves = np.hypot(*legs.T) > 1e-9  # the same corner twice is one corner
    if not moves.any():
        raise ValueError(f"tour must have at least two different corners, got {len(corners)} at one place")
    starts, legs = corners[:-1][moves], legs[moves]
    headings = np.arctan2(legs[:, 1], legs[:, 0])
    poses = [np.array([[*starts[0], headings[0]]])]
    for start, leg, heading in zip(starts, legs, headings, strict=True):
        poses.append(_turn_on_the_spot(poses[-1][-1], heading, turn))
        n_steps = max(1, math.ceil(float(np.hypot(*leg)) / step_m - 1e-9))
        xy = start + np.linspace(0.0, 1.0, n_steps + 1)[1:, None] * leg
        poses.append(np.column_stack([xy, np.full(n_steps, heading)]))
    return np.concatenate(poses)


def _turn_on_the_spot(pose: NDArray[np.float64], heading: float, turn: float) -> NDArray[np.float64]:
    """Poses of equal turns, the short way round, from a pose to a heading; none when it looks there already."""
    angle = float(wrap_angle(heading - pose[2]))
    n_turns = math.ceil(abs(angle) / turn - 1e-9)
    theta = pose[2] + angle * np.arange(1, n_turns + 1) / max(1, n_turns)
    return np.column_stack([np.tile(pose[:2], (n_turns, 1)), wrap_angle(theta)])


def _check_way(world: World, truth: NDArray[np.float64]) -> None:
    """Say where a path leaves the map or runs through an obstacle; the robot is a point."""
    grid = Grid(world.obstacles.shape, 1, world.metres_per_pixel)
    xy = grid.metres_to_xy(truth[:, :2])
    outside = np.flatnonzero(~grid.contains(xy))
    if outside.size:
        (x, y), (width, height) = truth[outside[0], :2], grid.xy_to_metres([world.obstacles.shape[::-1]])[0]
        raise BlockedTourError(f"tour must stay on the map of {width:.4g} x {height:.4g} m, got x, y = {x:.4g}, {y:.4g} m")
    dx, dy = np.diff(xy, axis=0).T
    met = cast_rays(world.obstacles, xy[:-1], np.arctan2(dy, dx), float(max(np.hypot(dx, dy).max(), 1e-9)))
    blocked = np.flatnonzero(met <= np.hypot(dx, dy))
    if blocked.size:
        x, y = truth[blocked[0], :2]
        raise BlockedTourError(f"tour must run through free space, got an obstacle on the way from x, y = {x:.4g}, {y:.4g} m")


def _scan(world: World, truth: NDArray[np.float64], scanner: Scanner, rng: np.random.Generator) -> NDArray[np.float64]:
    """(T, B) ranges in metres, as the scanner reports them."""
    scale = world.metres_per_pixel
    angles = truth[:, 2, None] + scanner.bearings
    origins = np.repeat(truth[:, :2] / scale, scanner.n_beams, axis=0)
    reach = (scanner.max_range_m + 6 * scanner.range_noise_m) / scale  # noise may bring a far obstacle within range
    ranges = cast_rays(world.obstacles, origins, angles.ravel(), reach).reshape(angles.shape) * scale
    noise = RangeNoise(scanner.range_noise_m, scanner.outlier_rate, scanner.dropout_rate, scanner.min_range_m)
    return disturb(ranges, noise, scanner.max_range_m, rng)
