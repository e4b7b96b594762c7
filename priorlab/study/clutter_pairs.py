"""Real buildings as a clean plan and the same plan furnished: the plan is the prior, the furnished building the world.

A folder holds NAME.png, the plan, and NAME_furnitures.png, the building, of one size and registered: white free, black solid.

    from priorlab.study.clutter_pairs import clutter_pair, pairs_table
    print(pairs_table([clutter_pair(folder, "my_floor", seed) for seed in range(5)]))
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.core.building import Truth, World
from priorlab.core.drawing import WALL, Walls
from priorlab.core.grid_map import Prior
from priorlab.core.score import score_map
from priorlab.core.sensor import KINECT, ODOMETRY, Odometry, Scanner
from priorlab.interchange.images import read_drawing
from priorlab.mapping.prior import build_prior_map
from priorlab.robot.drive import drive
from priorlab.slam.fastslam import FastSLAM
from priorlab.slam.parameters import TUNED, Parameters
from priorlab.slam.recording import Run
from priorlab.slam.trajectory_error import absolute_trajectory_error_m, dead_reckoning, true_poses
from priorlab.study.full_tour import full_tour

METRES_PER_PIXEL = 0.05
"""The scale of the pairs (the test maps of ipa_room_segmentation)."""

SOLID = 128
"""Grey values below this are solid."""

THESIS_PRIOR = Prior(p_wall=0.3, p_space=0.8)
"""Table 6.1."""

SKIN_M = 0.10
"""A scanner sees a wall's skin: what lies deeper in solid is not counted. As deep as `thickening_m` draws it."""

MARKED_AT = 0.5
"""Chapter 6 counts a cell as wall when P(empty) is below this."""


@dataclass(frozen=True, eq=False)
class Pair:
    """A plan and what stands in the building, (height, width) images with True = solid."""

    name: str
    plan: NDArray[np.bool_]
    world: NDArray[np.bool_]
    metres_per_pixel: float = METRES_PER_PIXEL

    @property
    def truth(self) -> Truth:
        """The plan's walls; furniture that a map shows is a mistake. The inside of thick walls is not counted."""
        deep = cv2.distanceTransform(self.plan.astype(np.uint8), cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
        return Truth(self.plan, ignore=deep * self.metres_per_pixel > SKIN_M, metres_per_pixel=self.metres_per_pixel)


@dataclass(frozen=True, eq=False)
class PairRun:
    """One drive through a furnished building with its clean plan as the prior.

    Parameters
    ----------
    name, seed : which pair and which chance
    run : what FastSLAM did
    dead_reckoning_m : ATE of the wheels alone
    f2_plan, f2_none, f2_prior : F2 at threshold 0.5 of the map with the plan, without (same poses and scans), and of the plan
        untouched
    seen : share of the plan's walls that the drive looked at
    blind_m : the longest way with fewer than ten returns a scan, metres
    """

    name: str
    seed: int
    run: Run
    dead_reckoning_m: float
    f2_plan: float
    f2_none: float
    f2_prior: float
    seen: float
    blind_m: float

    @property
    def gain(self) -> float:
        """F2 with the plan over F2 without, minus one; says nothing when the robot was lost."""
        return self.f2_plan / self.f2_none - 1


def read_pair(folder: str | os.PathLike[str], name: str, metres_per_pixel: float = METRES_PER_PIXEL) -> Pair:
    """Read a plan and its furnished building.

    Raises
    ------
    FileNotFoundError
        When one of the two images is missing.
    ValueError
        When they differ in size.
    """
    plan, world = (read_drawing(Path(folder) / f"{name}{end}.png").grey < SOLID for end in ("", "_furnitures"))
    if plan.shape != world.shape:
        raise ValueError(f"{name}_furnitures.png must be as large as {name}.png, {plan.shape}, got {world.shape}")
    return Pair(name, plan, world, metres_per_pixel)


def clutter_pair(
    folder: str | os.PathLike[str],
    name: str,
    seed: int,
    parameters: Parameters = TUNED,
    scanner: Scanner = KINECT,
    odometry: Odometry = ODOMETRY,
    step_m: float = 0.1,
    progress: Callable[[int, int], None] | None = None,
) -> PairRun:
    """Drive through the furnished building once, and localize and map with the clean plan as the prior.

    Parameters
    ----------
    folder, name : where the pair lies
    seed : draws the wheels' and the scanner's faults and, apart from them, the filter's particles
    parameters : of FastSLAM
    scanner, odometry, step_m : of the robot
    progress : called with the steps done and the steps to do
    """
    return drive_pair(read_pair(folder, name), seed, parameters, scanner, odometry, step_m, progress)


def drive_pair(
    pair: Pair,
    seed: int,
    parameters: Parameters = TUNED,
    scanner: Scanner = KINECT,
    odometry: Odometry = ODOMETRY,
    step_m: float = 0.1,
    progress: Callable[[int, int], None] | None = None,
) -> PairRun:
    """As `clutter_pair`, of a pair that was read."""
    plan, furnished = (as_walls(solid, pair.metres_per_pixel) for solid in (pair.plan, pair.world | pair.plan))
    rng_drive, rng_filter = np.random.default_rng(seed).spawn(2)
    tour = full_tour(furnished, landmarks=pair.plan, near_m=alongside_m(scanner))
    log = drive(World(pair.world, pair.metres_per_pixel), tour, scanner, odometry, rng_drive, step_m)
    prior_map = build_prior_map(plan, THESIS_PRIOR)
    run = FastSLAM(parameters).run(prior_map, log, rng_filter, progress)
    without = run.remap(build_prior_map(plan, Prior.uninformed()))
    truth = pair.truth
    f2_plan, f2_none, f2_prior = (score_map(m, truth, MARKED_AT).f_beta for m in (run.map, without, prior_map))
    counted = truth.walls & ~truth.ignore
    return PairRun(
        pair.name,
        seed,
        run,
        absolute_trajectory_error_m(dead_reckoning(log), true_poses(log)),
        f2_plan,
        f2_none,
        f2_prior,
        float((without.log_odds != 0)[counted].mean()),
        longest_blind_way_m(run),
    )


def alongside_m(scanner: Scanner) -> float:
    """How near a wall alongside must be to come into view at all, metres: an operator keeps that near to the walls.

    A Kinect that drives along a wall sees it at the edge of its narrow view only; in the middle of a hall it drives blind.

    >>> round(alongside_m(Scanner(field_of_view=np.pi / 3, max_range_m=3.0)), 9)
    1.5
    """
    return float(scanner.max_range_m * np.sin(min(scanner.field_of_view, np.pi) / 2))


def as_walls(solid: NDArray[np.bool_], metres_per_pixel: float) -> Walls:
    """An image of what is solid as walls."""
    return Walls((solid * WALL).astype(np.uint8), metres_per_pixel)


def longest_blind_way_m(run: Run) -> float:
    """The longest way that the robot drove while fewer than ten beams returned: there it steers by its wheels alone."""
    steps = np.hypot(*np.diff(run.log.odometry[:, :2], axis=0, prepend=run.log.odometry[:1, :2]).T)
    way = np.cumsum(steps)
    began = np.maximum.accumulate(np.where(np.isfinite(run.explained), way, 0.0))
    return float((way - began).max())


def pairs_table(rows: Iterable[PairRun]) -> str:
    """One line a run; the gain of a lost run means nothing and is left out."""
    lines = ["building        seed   way m    ATE m  wheels m  heading  lost  blind m   seen   plan   none  prior   gain"]
    for row in rows:
        steps = np.diff(row.run.log.odometry[:, :2], axis=0)
        gain = "      " if row.run.lost else f"{100 * row.gain:+5.0f}%"
        lines.append(
            f"{row.name:<15} {row.seed:>4} {np.hypot(*steps.T).sum():>7.0f} {row.run.ate_m():>8.2f} {row.dead_reckoning_m:>9.2f} "
            f"{row.run.heading_error_deg():>8.2f} {'LOST' if row.run.lost else 'no':>5} {row.blind_m:>8.1f} {row.seen:>6.2f} "
            f"{row.f2_plan:>6.2f} {row.f2_none:>6.2f} {row.f2_prior:>6.2f} {gain}"
        )
    return "\n".join(lines)
