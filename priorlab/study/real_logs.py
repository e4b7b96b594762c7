"""A real robot's log as a test of localization: a map is built from every other scan, the robot is localized on the rest.

A log whose poses a mapper has corrected holds its own truth. The even scans, from those poses, make an occupancy map; on the
odd ones the filter starts at the true pose and gets odometry that was made worse on purpose, as corrected logs seldom keep the
wheels' own.

    from priorlab.interchange.carmen import read_carmen
    from priorlab.study.real_logs import localize_on_odd_scans, logs_table
    log = read_carmen("my-corrected.log.gz")
    print(logs_table("my", [localize_on_odd_scans(log, seed) for seed in range(5)]))
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

import numpy as np

from priorlab.core.checks import check_positive
from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.pose import compose, relative
from priorlab.core.readings import RobotLog
from priorlab.interchange.relations import Relations
from priorlab.slam.fastslam import FastSLAM
from priorlab.slam.map_update import see_cells, update_seen
from priorlab.slam.parameters import TUNED, Parameters
from priorlab.slam.recording import Run
from priorlab.slam.relations import RelationErrors, relation_errors
from priorlab.slam.scan import choose_beams
from priorlab.slam.trajectory_error import absolute_trajectory_error_m, dead_reckoning, true_poses

LASER = replace(
    TUNED,
    alphas=(0.02, 0.002, 0.02, 0.002),
    n_beams=60,
    sigma_hit_m=0.05,
    z_random=0.98,
    max_distance_m=2.0,
    max_range_m=20.0,
    temper=0.2,
    weigh_every_m=0.0,
    weigh_every_theta=0.0,
    particle_limits=(4500, 4500),
    lam=0.0,
)
"""For a laser that sees 20 m, for the worn wheels below, and for a map of what the robot has seen itself. Every scan weighs.

Such a map holds the furniture too: what a beam meets is on it, so beams may weigh more than against a plan (`temper`; chosen
on one seed of freiburg-079 and of aces, whose few scans lie 1.5 m apart and leave 0.05 more than a metre off). The map is no
prior that scans correct, but all that is known: lam = 0. What has been moved since is a wall in it (`p_through_wall`); on these
logs that changes hardly anything.
"""

CELL_M = 0.05
MARGIN_M = 1.0
"""Space round all that was seen: an estimate may be a little off."""


@dataclass(frozen=True)
class WornWheels:
    """Odometry made worse than the truth on purpose.

    Parameters
    ----------
    spread : standard deviation of a step's length and of its turn, as a share of them
    bias : share by which every step comes out too long
    turn_per_m : standard deviation of the heading over a step, radians per metre of it
    """

    spread: float = 0.10
    bias: float = 0.03
    turn_per_m: float = math.radians(1.0)


@dataclass(frozen=True, eq=False)
class OddScans:
    """The filter on the odd scans of a log.

    Parameters
    ----------
    seed : of wheels and filter
    run : what the filter did
    dead_reckoning_m : ATE of the worn wheels alone
    step_ms : time for a step, milliseconds
    """

    seed: int
    run: Run
    dead_reckoning_m: float
    step_ms: float

    def relation_errors(self, relations: Relations, behind_s: float = 0.0) -> RelationErrors:
        """The estimate against hand-checked relations; see `priorlab.slam.relations`."""
        if self.run.log.stamps is None:
            raise ValueError("the log must have stamps to be held against relations, got none")
        return relation_errors(self.run.trajectory, self.run.log.stamps, relations, behind_s)


def localize_on_odd_scans(
    log: RobotLog,
    seed: int,
    parameters: Parameters = LASER,
    wheels: WornWheels | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> OddScans:
    """Build a map from the even scans, then localize in it on the odd ones.

    Parameters
    ----------
    log : with corrected poses as the truth
    seed : draws the wheels' faults and, apart from them, the particles
    parameters : of the filter; its `max_range_m` is also how far the map is drawn
    wheels : how the odometry is made worse; `WornWheels()` by default
    progress : called with the steps done and the steps to do

    Raises
    ------
    ValueError
        When the log holds no truth, or fewer than four scans.
    """
    if len(log) < 4:
        raise ValueError(f"the log must hold at least four scans to build a map and localize in it, got {len(log)}")
    log, grid = into_map_frame(log, parameters.max_range_m, sensor_offset_m=parameters.sensor_offset_m)
    rng_wheels, rng_filter = np.random.default_rng(seed).spawn(2)
    own_map = map_from_truth(every_other(log, 0), grid, parameters)
    odd = wear_wheels(every_other(log, 1), rng_wheels, wheels or WornWheels())
    began = time.perf_counter()
    run = FastSLAM(parameters).run(own_map, odd, rng_filter, progress)
    step_ms = 1e3 * (time.perf_counter() - began) / len(odd)
    return OddScans(seed, run, absolute_trajectory_error_m(dead_reckoning(odd), true_poses(odd)), step_ms)


def into_map_frame(
    log: RobotLog, max_range_m: float, cell_m: float = CELL_M, sensor_offset_m: tuple[float, float] = (0.0, 0.0)
) -> tuple[RobotLog, Grid]:
    """Shift a log so that its true poses and all it sees from them lie on a map whose lower left corner is 0, 0; and that map's
    grid.

    The truth moves; the odometry has a frame of its own and stays. `sensor_offset_m` is where the scanner sits on the robot; the
    poses of a CARMEN log are the scanner's own.
    """
    truth, cell_m = true_poses(log), check_positive("cell_m", cell_m)
    seen = np.isfinite(log.ranges) & (log.ranges < max_range_m)
    scanner = compose(truth, (*sensor_offset_m, 0.0))
    angles = truth[:, 2:] + log.bearings
    reach = np.where(seen, log.ranges, 0.0)
    x, y = scanner[:, :1] + reach * np.cos(angles), scanner[:, 1:2] + reach * np.sin(angles)
    # the robot itself counts too: one that only looks ahead may stand far behind all that it sees
    low = np.minimum([x.min(), y.min()], truth[:, :2].min(axis=0)) - MARGIN_M
    high = np.maximum([x.max(), y.max()], truth[:, :2].max(axis=0)) + MARGIN_M
    width, height = np.ceil((high - low) / cell_m).astype(int)
    shift = np.array([*low, 0.0])
    return replace(log, truth=truth - shift, start=log.start - shift), Grid((int(height), int(width)), 1, cell_m)


def every_other(log: RobotLog, first: int) -> RobotLog:
    """Scans first, first + 2, ...; the drive starts at the first of them."""
    truth = true_poses(log)[first::2]
    stamps = None if log.stamps is None else log.stamps[first::2]
    return replace(log, odometry=log.odometry[first::2], ranges=log.ranges[first::2], truth=truth, start=truth[0], stamps=stamps)


def map_from_truth(log: RobotLog, grid: Grid, parameters: Parameters) -> GridMap:
    """The occupancy map that the scans make from the true poses, all their beams; unseen cells stay at 0.5."""
    all_beams = replace(parameters, n_beams=len(log.bearings), thickening_m=0.0)
    log_odds_map, none = np.zeros(grid.shape), np.zeros(grid.shape)
    for step, pose in enumerate(true_poses(log)):
        seen = see_cells(grid, pose, choose_beams(log, step, all_beams), all_beams)
        update_seen(log_odds_map, none, seen, all_beams)
    return GridMap(log_odds_map, grid, Prior.uninformed())


def wear_wheels(log: RobotLog, rng: np.random.Generator, wheels: WornWheels) -> RobotLog:
    """The log with odometry made from its truth: every step too long, its length and its turn disturbed."""
    truth = true_poses(log)
    steps = relative(truth[:-1], truth[1:])
    lengths = np.hypot(steps[:, 0], steps[:, 1])
    noise = rng.standard_normal((3, len(steps)))
    steps[:, :2] *= (1.0 + wheels.bias + wheels.spread * noise[0])[:, None]
    steps[:, 2] *= 1.0 + wheels.spread * noise[1]
    steps[:, 2] += wheels.turn_per_m * lengths * noise[2]
    poses = [truth[0]]
    for step in steps:
        poses.append(compose(poses[-1], step))
    return replace(log, odometry=np.array(poses))


def logs_table(name: str, rows: Iterable[OddScans], relations: Relations | None = None, behind_s: float = 0.0) -> str:
    """One line a seed; with relations their errors too."""
    head = "log             seed  steps    ATE m  worst m  heading  wheels m  lost  ms/step"
    lines = [head + ("  relations m  degrees" if relations else "")]
    for row in rows:
        run = row.run
        worst = np.hypot(*(run.trajectory - true_poses(run.log))[:, :2].T).max()
        line = (
            f"{name:<15} {row.seed:>4} {len(run):>6} {run.ate_m():>8.3f} {worst:>8.2f} {run.heading_error_deg():>8.2f} "
            f"{row.dead_reckoning_m:>9.2f} {'LOST' if run.lost else 'no':>5} {row.step_ms:>8.1f}"
        )
        if relations:
            errors = row.relation_errors(relations, behind_s)
            line += f" {errors.translation_m.mean():>12.3f} {np.degrees(errors.rotation).mean():>8.2f}"
        lines.append(line)
    return "\n".join(lines)
