"""The record of a drive: light steps. A map at any step is not kept but replayed from poses and scans."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from priorlab.core.building import Truth
from priorlab.core.checks import check_record
from priorlab.core.grid_map import GridMap
from priorlab.core.readings import RobotLog
from priorlab.slam.likelihood_field import obstacles_of
from priorlab.slam.localization import Localized
from priorlab.slam.lost import lost_because
from priorlab.slam.map_update import SeenCells, see_cells, update_seen
from priorlab.slam.parameters import Parameters
from priorlab.slam.replay import Replay
from priorlab.slam.scan import choose_beams
from priorlab.slam.trajectory_error import (
    absolute_trajectory_error_m,
    heading_errors,
    relative_heading_error,
    relative_pose_error_m,
    true_poses,
)

SAMPLE_SIZE = 300
"""Particles per step that are kept for pictures."""

SAMPLE_UNITS = 1000
"""Per metre and per radian: the sample is kept to the millimetre and the milliradian, which no picture shows."""


@dataclass(frozen=True, eq=False)
class Run:
    """What FastSLAM did, step by step.

    Parameters
    ----------
    prior_map : m_0
    log : the drive
    parameters : the method's numbers
    map : m_T, the map at the end
    trajectory : (T, 3) estimated poses x, y, theta; metres, in the frame of the map
    n_particles : (T,) particles that were weighed
    ess : (T,) their effective number, before resampling
    sample : (T, S, 3) float32, up to 300 of the particles that went on, for pictures: to the millimetre and the milliradian,
        in the order of x
    explained : (T,) share of the beams that end at a wall of the PLAN, seen from the estimate; nan for few beams
    path : (T, 3) the poses that drew `map`, when it is that of the heaviest particle (`localize_in="own"`); else the trajectory
    """

    prior_map: GridMap
    log: RobotLog
    parameters: Parameters
    map: GridMap
    trajectory: NDArray[np.float64]
    n_particles: NDArray[np.int64]
    ess: NDArray[np.float64]
    sample: NDArray[np.float32]
    explained: NDArray[np.float64]
    path: NDArray[np.float64] | None = None

    def __len__(self) -> int:
        return len(self.trajectory)

    # --- maps ----------------------------------------------------------------------------------------------------

    def at(self, step: int) -> GridMap:
        """The map after a step, to the last bit as it was; -1 is the last one.

        The first call drives through the log once more (a tenth of the time that the run took); the others take a few ms.
        """
        n_steps = self._check_step(step) + 1
        return GridMap(self.replay.after(n_steps), self.prior_map.grid, self.prior_map.prior)

    def remap(self, prior_map: GridMap) -> GridMap:
        """The map that the same poses and scans make of another prior: maps with and without a plan are compared in pairs."""
        check_record("prior_map", prior_map, GridMap)
        log_odds_map = prior_map.log_odds.copy()
        for k in range(len(self)):
            self._draw(log_odds_map, k, prior_map)
        return GridMap(log_odds_map, prior_map.grid, prior_map.prior)

    @cached_property
    def replay(self) -> Replay:
        """The drive again: maps at any step, and when a cell was seen first."""
        return Replay(self.prior_map.log_odds, self._draw, len(self))

    def coverage(self, truth: Truth, step: int = -1) -> float:
        """Share of the truth's wall pixels whose cell some scan has said something about, up to a step; don't-care left out."""
        check_record("truth", truth, Truth)
        grid, step = self.prior_map.grid, self._check_step(step)
        if truth.shape != grid.image_shape:
            raise ValueError(f"map and truth must have one shape, got {grid.image_shape} and {truth.shape}")
        walls = truth.walls & ~truth.ignore
        if not walls.any():
            raise ValueError("the truth must hold a wall to be covered, got none")
        return float(grid.to_image(self.replay.first_seen <= step)[walls].mean())

    def _check_step(self, step: int) -> int:
        """A step from the front, also when it was counted from the end."""
        if not isinstance(step, int | np.integer):
            raise ValueError(f"step must be a whole number, got {step!r}")
        from_front = step + len(self) if step < 0 else step
        if not 0 <= from_front < len(self):
            raise ValueError(f"step must lie between 0 and {len(self) - 1}, got {step}")
        return from_front

    def _draw(self, log_odds_map: NDArray[np.float64], k: int, prior_map: GridMap | None = None) -> SeenCells:
        """Put the scan of a step into a map, from the pose that was estimated (algorithm 6.5)."""
        prior_map = prior_map or self.prior_map
        pose = self.trajectory[k] if self.path is None else self.path[k]
        seen = see_cells(prior_map.grid, pose, choose_beams(self.log, k, self.parameters), self.parameters)
        update_seen(log_odds_map, prior_map.log_odds, seen, self.parameters)
        return seen

    # --- errors --------------------------------------------------------------------------------------------------

    def ate_m(self, log: RobotLog | None = None) -> float:
        """Absolute trajectory error: root of the mean squared distance to the true position, metres, without alignment."""
        return absolute_trajectory_error_m(self.trajectory, self._truth(log))

    def rpe_m(self, log: RobotLog | None = None, delta: int = 1) -> float:
        """Relative pose error over `delta` steps, metres: the drift."""
        return relative_pose_error_m(self.trajectory, self._truth(log), delta)

    def rpe_deg(self, log: RobotLog | None = None, delta: int = 1) -> float:
        """Rotation of the relative pose error over `delta` steps, degrees."""
        return float(np.degrees(relative_heading_error(self.trajectory, self._truth(log), delta)))

    def heading_error_deg(self, log: RobotLog | None = None) -> float:
        """Median size of the heading's error, degrees."""
        return float(np.degrees(np.median(np.abs(heading_errors(self.trajectory, self._truth(log))))))

    def _truth(self, log: RobotLog | None) -> NDArray[np.float64]:
        """(T, 3) true poses of a log, the run's own when no other is given."""
        return true_poses(self.log if log is None else log)

    @cached_property
    def lost_because(self) -> str | None:
        """A sentence when the robot got lost, None when it did not."""
        return lost_because(self.trajectory, self._in_wall(), self.explained, self.log)

    @property
    def lost(self) -> bool:
        """True when the robot got lost: then neither the map nor a gain over another map means anything."""
        return self.lost_because is not None

    def _in_wall(self) -> NDArray[np.bool_]:
        """(T,) True where the estimate stands in a wall of the plan, or off the map."""
        walls = obstacles_of(self.prior_map.log_odds, self.parameters)
        return self.prior_map.grid.at_metres(walls, self.trajectory, outside=True)

    def summary(self, truth: Truth | None = None, log: RobotLog | None = None) -> str:
        """Errors, particles and, when the building is known, coverage in one line; a lost run says so first.

        The errors are those against `log.truth`, of the run's own log when no other is given.
        """
        log = self.log if log is None else log
        check_record("log", log, RobotLog)
        words = [f"{len(self)} steps"]
        if self.lost:
            words.insert(0, f"LOST ({self.lost_because})")
        if log.truth is not None:
            words.append(f"ATE {self.ate_m(log):.3f} m")
            if len(self) > 1:
                words.append(f"RPE {1000 * self.rpe_m(log):.1f} mm and {self.rpe_deg(log):.2f} degrees a step")
            words.append(f"heading {self.heading_error_deg(log):.2f} degrees off (median)")
        words.append(f"{int(self.n_particles.min())} to {int(self.n_particles.max())} particles")
        words.append(f"ESS {100 * np.median(self.ess / self.n_particles):.0f} % of them (median)")
        if truth is not None:
            words.append(f"{100 * self.coverage(truth):.0f} % of the walls seen")
        return ", ".join(words)

    def __repr__(self) -> str:
        fewest, most = int(self.n_particles.min()), int(self.n_particles.max())
        error = "" if self.log.truth is None else f", ATE {self.ate_m():.2f} m"
        return f"Run({len(self)} steps, {fewest} to {most} particles{error}{', LOST' if self.lost else ''})"


@dataclass
class Recorder:
    """Collects the steps of a run while it goes on."""

    poses: list[NDArray] = field(default_factory=list)
    n_particles: list[int] = field(default_factory=list)
    ess: list[float] = field(default_factory=list)
    samples: list[NDArray] = field(default_factory=list)
    explained: list[float] = field(default_factory=list)

    def add(self, here: Localized, explained: float) -> None:
        """Remember one step."""
        self.poses.append(here.pose)
        self.n_particles.append(len(here.weighed))
        self.ess.append(here.weighed.effective_number)
        self.samples.append(_sample(here.particles.poses))
        self.explained.append(explained)

    def finish(self, prior_map: GridMap, log: RobotLog, parameters: Parameters, final_map: GridMap) -> Run:
        """All steps as one record."""
        smallest = min(len(sample) for sample in self.samples)
        return Run(
            prior_map,
            log,
            parameters,
            final_map,
            np.array(self.poses),
            np.array(self.n_particles),
            np.array(self.ess),
            np.array([_evenly(sample, smallest) for sample in self.samples]),
            np.array(self.explained),
        )


def _sample(poses: NDArray[np.float64]) -> NDArray[np.float32]:
    """Some of the particles, rounded and ordered, which halves a run's file twice; none has a name that could get lost."""
    rounded = np.rint(_evenly(poses, SAMPLE_SIZE) * SAMPLE_UNITS) / SAMPLE_UNITS
    return rounded[np.lexsort(rounded.T[::-1])].astype(np.float32)


def _evenly(rows: NDArray, at_most: int) -> NDArray:
    """At most `at_most` rows, evenly spread: resampling keeps the copies of one particle together, so they stand for all."""
    return rows if len(rows) <= at_most else rows[np.linspace(0, len(rows) - 1, at_most).astype(np.int64)]
