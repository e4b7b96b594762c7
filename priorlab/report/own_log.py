"""A robot's own log in the plan of its building: what `priorlab localize` reads and how it drives."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import check_not_negative, check_number, check_poses, check_positive
from priorlab.core.drawing import Walls
from priorlab.core.grid_map import GridMap
from priorlab.core.pose import compose, relative
from priorlab.core.readings import RobotLog
from priorlab.core.sensor import MOST_ALPHA
from priorlab.drawing.extraction import extract_walls
from priorlab.interchange.carmen import read_carmen
from priorlab.interchange.images import read_drawing
from priorlab.interchange.ros_map import read_ros_map
from priorlab.mapping.prior import build_prior_map
from priorlab.pipeline import SLAM_CELL_M, SLAM_PRIOR
from priorlab.slam.checkpoint import inputs_of, resume, run_with_checkpoints, state_of
from priorlab.slam.fastslam import FARTHEST_M, FastSLAM
from priorlab.slam.parameters import TUNED, Parameters
from priorlab.slam.recording import Run
from priorlab.slam.run_inputs import OlderFile

WHEEL_NOISE = 0.01
"""All four alphas for wheels that nobody has measured; the simulated ones (0.002) are better than most."""

FAR_APART_M = 0.8
"""Scans farther apart ask for a larger temper: at 1.0 m the default was twice as far off as 0.2, at 1.8 m it got lost."""

LONGEST_M = 20.0
"""Beams from here on are left out: over 20 m, a degree of heading moves a beam's end by 35 cm."""

MANY_WALLS = 0.15
"""Walls on more of a drawing than this are hardly walls: furniture, hatching or solid black was taken for them."""


@dataclass(frozen=True, eq=False)
class OwnLog:
    """What is to be done: a log, the map to localize in, and the method's numbers.

    Parameters
    ----------
    prior_map : m_0; its lower left corner is 0, 0
    log : starts in that frame, and holds no truth
    corrected : the same log; its truth is what a mapper has made of it, laid on the start. None when there is no such
    parameters : `TUNED`, but for the laser's range, the wheels, the start and the temper
    origin : x, y (metres), theta of the map's lower left corner in the frame that the user speaks of (a ROS map's origin)
    walls : what was taken for walls of a drawing; None with a ROS map
    """

    prior_map: GridMap
    log: RobotLog
    corrected: RobotLog | None
    parameters: Parameters
    origin: tuple[float, float, float]
    walls: Walls | None = None

    @property
    def has_exact_start(self) -> bool:
        """True when the user did not call the start uncertain."""
        return not any(self.parameters.start_variances)


def read_own_log(
    log_path: str | Path,
    map_path: str | Path,
    start: tuple[float, float, float],
    metres_per_pixel: float | None = None,
    max_range_m: float | None = None,
    wheel_noise: float = WHEEL_NOISE,
    start_error: tuple[float, float] = (0.0, 0.0),
    temper: float = TUNED.temper,
) -> OwnLog:
    """Read a CARMEN log and the map it was driven in.

    Parameters
    ----------
    log_path : CARMEN, plain or gzip
    map_path : a ROS map's yaml file, or a drawing
    start : x, y (metres) and theta (radians) of the laser at the first scan, in the map's frame: that of the yaml's origin, or
        from the drawing's lower left corner
    metres_per_pixel : scale of a drawing
    max_range_m : beams from here on do not count; by default the laser's range, at most 20 m
    wheel_noise : alpha_1 to alpha_4 of algorithm 6.3, variances per squared metre or radian
    start_error : how far the start may be off, standard deviations: of x and y (metres) and of theta (radians)
    temper : exponent of a scan's likelihood; scans that lie more than a metre apart must count more to be followed

    The poses of a CARMEN log are the laser's own, as `start` is, so there is no sensor offset to take account of
    (`sensor_offset_m` stays 0). Poses that a mapper has corrected lie in a frame of their own. Laid on the start, they tell how
    well the robot kept track, but not whether the start was right: so the filter's own signs, not they, say first whether the
    robot got lost (`own_log_verdict` asks them next).
    """
    check_not_negative("wheel_noise", wheel_noise, MOST_ALPHA)
    if np.abs(check_poses("start", [start])).max() > FARTHEST_M:
        raise ValueError(f"start must lie within {FARTHEST_M:g} m, got x {start[0]:g}, y {start[1]:g} m")
    prior_map, origin, walls = _read_prior_map(Path(map_path), metres_per_pixel)
    log = read_carmen(log_path)
    here = relative(np.asarray(origin), np.asarray(start))
    _check_on_map(prior_map, here, start, origin)
    corrected = None if log.truth is None else compose(here, relative(log.truth[0], log.truth))
    off_m, off_turn = (check_number("start_error", value) for value in start_error)
    if min(off_m, off_turn) < 0:
        raise ValueError(f"start_error must not be negative, got {off_m:g} m, {off_turn:g} radians")
    if max(off_m, off_turn) > FARTHEST_M:
        raise ValueError(f"start_error must be at most {FARTHEST_M:g}, got {off_m:g} m, {off_turn:g} radians")
    farthest = min(log.scanner.max_range_m, LONGEST_M) if max_range_m is None else check_positive("max_range_m", max_range_m)
    return OwnLog(
        prior_map,
        replace(log, start=here, truth=None),
        None if corrected is None else replace(log, start=here, truth=corrected),
        replace(
            TUNED,
            max_range_m=farthest,
            alphas=(wheel_noise,) * 4,
            start_variances=(off_m**2, off_m**2, off_turn**2),
            temper=temper,
        ),
        origin,
        walls,
    )


def _check_on_map(
    prior_map: GridMap, here: NDArray[np.float64], start: tuple[float, ...], origin: tuple[float, float, float]
) -> None:
    """Say it in the user's frame when a start is off the map."""
    grid = prior_map.grid
    if not grid.contains(grid.metres_to_xy(here[:2])):
        width_m, height_m = (side * grid.scale for side in grid.image_shape[::-1])
        raise ValueError(
            f"start must lie on the map, which reaches {width_m:.2f} x {height_m:.2f} m from x {origin[0]:g}, y {origin[1]:g}, "
            f"got x {start[0]:g}, y {start[1]:g} m"
        )


def _read_prior_map(path: Path, metres_per_pixel: float | None) -> tuple[GridMap, tuple[float, float, float], Walls | None]:
    """m_0, its origin and the walls that were found, from a ROS map (none are looked for) or a drawing."""
    if path.suffix.lower() in (".yaml", ".yml"):
        if metres_per_pixel is not None:
            raise ValueError(f"metres_per_pixel must not be given with a ROS map, which knows its own, got {metres_per_pixel:g}")
        ros = read_ros_map(path)
        return ros.to_prior_map(SLAM_PRIOR), ros.origin, None
    yaml = next((beside for suffix in (".yaml", ".yml") if (beside := path.with_suffix(suffix)).is_file()), None)
    if path.suffix.lower() == ".pgm":
        found = f"give {yaml}, which lies beside it" if yaml else "no yaml of its name lies beside it"
        raise ValueError(f"map must be the yaml of a ROS map or a drawing, got the image of a ROS map, {path}: {found}")
    if metres_per_pixel is None:
        or_yaml = f"; for a ROS map give {yaml}" if yaml else ""
        raise ValueError(f"metres_per_pixel must be given with a drawing: a robot's ranges are in metres, got none{or_yaml}")
    drawing = read_drawing(path, metres_per_pixel)
    walls = Walls(extract_walls(drawing).walls.labels, drawing.metres_per_pixel, drawing.name)
    if not walls.mask.any():
        raise ValueError(f"the drawing must show walls to localize by, got none that was found in {path}")
    prior_map = build_prior_map(walls, SLAM_PRIOR, cell_size_m=max(SLAM_CELL_M, drawing.metres_per_pixel or 0.0))
    return prior_map, (0.0, 0.0, 0.0), walls


def told_of_walls(own: OwnLog) -> str | None:
    """A sentence on what was taken for the walls of a drawing; None with a ROS map."""
    if own.walls is None:
        return None
    share = float(own.walls.mask.mean())
    sentence = f"walls were found on {100 * share:.0f} % of the drawing (walls.png)"
    if share <= MANY_WALLS:
        return sentence
    return (
        f"{sentence}, more than walls take up: other ink was taken for walls; "
        "of a clean plan make a ROS map (docs/own_robot.md), then nothing is looked for"
    )


def advice(own: OwnLog) -> str | None:
    """A sentence when the robot drove so far between scans that the wheels outweigh them; None when it did not.

    Standing scans say nothing new: only steps of 0.1 m and more count.
    """
    steps_m = np.hypot(*np.diff(own.log.odometry[:, :2], axis=0).T)
    way_m = float(np.median(steps_m[steps_m >= 0.1])) if (steps_m >= 0.1).any() else 0.0
    if way_m < FAR_APART_M or own.parameters.temper > TUNED.temper:
        return None
    return f"the scans lie {way_m:.1f} m apart (median): if the robot gets lost, --temper 0.2 lets each of them count more"


def drive_own_log(
    own: OwnLog,
    part: Path,
    seed: int | None = None,
    go_on: bool = False,
    force: bool = False,
    progress: Callable[[int, int], None] | None = None,
    begins: Callable[[], None] | None = None,
) -> Run:
    """FastSLAM through the log; what is done so far lies in `part`, and with `go_on` it is gone on with.

    Parameters
    ----------
    seed : of the filter; None is 0, and with `go_on` the one that the drive began with
    begins : called once nothing speaks against the drive any more

    Raises
    ------
    FileExistsError
        When an interrupted drive lies there and neither `go_on` nor `force` is given.
    ValueError
        When the one that lies there is another log's, or began with other numbers or another seed.
    """
    if not go_on and os.path.lexists(part) and not force:
        raise FileExistsError(f"{part} holds a drive that was interrupted: go on with --resume, or begin anew with --force")
    if go_on:
        _check_begun_alike(own, seed, part)
    if begins:
        begins()
    if go_on:
        return resume(part, progress)
    fast_slam, rng = FastSLAM(own.parameters), np.random.default_rng(seed or 0)
    return run_with_checkpoints(fast_slam, own.prior_map, own.log, rng, part, progress=progress, force=force)


def _check_begun_alike(own: OwnLog, seed: int | None, part: Path) -> None:
    """Say how to go on when a drive was begun otherwise than it is asked for."""
    try:
        other = _begun_otherwise(own, seed, part)
    except OlderFile as fault:
        raise ValueError(f"{part} was written by an older priorlab; begin anew with --force") from fault
    if other == [_OWN_NUMBERS]:
        raise ValueError(f"{part} began with {_OWN_NUMBERS}; begin anew with --force")
    if other:
        raise ValueError(f"{part} began with {' and '.join(other)}: give the same, or begin anew with --force")


_OWN_NUMBERS = "other numbers of priorlab's own than today's"


def _begun_otherwise(own: OwnLog, seed: int | None, part: Path) -> list[str]:
    """What a drive was begun with that differs from what is asked for, by the names of the options."""
    prior_map, log, parameters, rng = inputs_of(part)
    wished = own.parameters
    arrays = [(getattr(log, name), getattr(own.log, name)) for name in ("odometry", "ranges", "bearings")]
    off_m, _, off_turn = np.sqrt(parameters.start_variances)
    same = {
        "another log": log.scanner == own.log.scanner and all(np.array_equal(*pair, equal_nan=True) for pair in arrays),
        "another --map": (prior_map.grid, prior_map.prior) == (own.prior_map.grid, own.prior_map.prior)
        and np.array_equal(prior_map.log_odds, own.prior_map.log_odds),
        "another --start": np.array_equal(log.start, own.log.start),
        f"another --start-error ({off_m:g} {np.degrees(off_turn):g})": parameters.start_variances == wished.start_variances,
        f"another --max-range ({parameters.max_range_m:g})": parameters.max_range_m == wished.max_range_m,
        f"another --wheel-noise ({parameters.alphas[0]:g})": parameters.alphas == wished.alphas,
        f"another --temper ({parameters.temper:g})": parameters.temper == wished.temper,
        "another --seed": seed is None or rng == state_of(np.random.default_rng(seed)),
    }
    other = [name for name, is_same in same.items() if not is_same]
    return other or ([] if parameters == wished else [_OWN_NUMBERS])
