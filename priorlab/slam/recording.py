"""The record of a drive: light steps. A map at any step is not kept but replayed from poses and scans."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from priorlab.core.grid_map import GridMap
from priorlab.core.readings import RobotLog
from priorlab.slam.localization import Localized
from priorlab.slam.lost import lost_because
from priorlab.slam.map_update import see_cells, update_seen
from priorlab.slam.parameters import Parameters
from priorlab.slam.scan import choose_beams
from priorlab.slam.trajectory_error import (
    absolute_trajectory_error_m,
    heading_errors,
    relative_pose_error_m,
    true_poses,
)

KEYFRAME_STEPS = 50
"""Steps between two maps that are kept once somebody scrubs through a run."""

SAMPLE_SIZE = 300
"""Particles per step that are kept for pictures."""


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
    sample : (T, S, 3) float32, up to 300 of the particles that went on
    explained : (T,) share of the beams that end at a wall of the PLAN, seen from the estimate; nan for few beams
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

    def __len__(self) -> int:
        return len(self.trajectory)

    # --- maps ----------------------------------------------------------------------------------------------------

    def at(self, step: int) -> GridMap:
        """The map after a step, replayed from the nearest keyframe; -1 is the last one."""
        step = step + len(self) if step < 0 else step
        if not 0 <= step < len(self):
            raise ValueError(f"step must lie between 0 and {len(self) - 1}, got {step}")
        first = (step + 1) // KEYFRAME_STEPS * KEYFRAME_STEPS
        log_odds_map = self._keyframes[first // KEYFRAME_STEPS].copy()
        self._replay(log_odds_map, self.prior_map, first, step + 1)
        return GridMap(log_odds_map, self.prior_map.grid, self.prior_map.prior)

    def remap(self, prior_map: GridMap) -> GridMap:
        """The map that the same poses and scans make of another prior: maps with and without a plan are compared in pairs."""
        log_odds_map = prior_map.log_odds.copy()
        self._replay(log_odds_map, prior_map, 0, len(self))
        return GridMap(log_odds_map, prior_map.grid, prior_map.prior)

    @cached_property
    def _keyframes(self) -> list[NDArray[np.float64]]:
        """The map before steps 0, 50, 100, ..."""
        log_odds_map = self.prior_map.log_odds.copy()
        frames = [log_odds_map.copy()]
        for first in range(0, len(self) - KEYFRAME_STEPS + 1, KEYFRAME_STEPS):
            self._replay(log_odds_map, self.prior_map, first, first + KEYFRAME_STEPS)
            frames.append(log_odds_map.copy())
        return frames

    def _replay(self, log_odds_map: NDArray[np.float64], prior_map: GridMap, first: int, stop: int) -> None:
        """Put the scans of steps first..stop-1 into a map, from the poses that were estimated (algorithm 6.5)."""
        for k in range(first, stop):
            seen = see_cells(prior_map.grid, self.trajectory[k], choose_beams(self.log, k, self.parameters), self.parameters)
            update_seen(log_odds_map, prior_map.log_odds, seen, self.parameters)

    # --- errors --------------------------------------------------------------------------------------------------

    def ate_m(self, log: RobotLog | None = None) -> float:
        """Absolute trajectory error: root of the mean squared distance to the true position, metres, without alignment."""
        return absolute_trajectory_error_m(self.trajectory, true_poses(log or self.log))

    def rpe_m(self, log: RobotLog | None = None, delta: int = 1) -> float:
        """Relative pose error over `delta` steps, metres."""
        return relative_pose_error_m(self.trajectory, true_poses(log or self.log), delta)

    def heading_error_deg(self, log: RobotLog | None = None) -> float:
        """Median size of the heading's error, degrees."""
        return float(np.degrees(np.median(np.abs(heading_errors(self.trajectory, true_poses(log or self.log))))))

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
        grid = self.prior_map.grid
        xy = grid.metres_to_xy(self.trajectory[:, :2])
        outside = ~grid.contains(xy)
        rows, cols = grid.xy_to_cell(np.where(outside[:, None], 0.0, xy)).T
        return outside | (self.prior_map.p_empty[rows, cols] < self.parameters.occupied_below)

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
        self.samples.append(_evenly(here.particles.poses, SAMPLE_SIZE).astype(np.float32))
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


def _evenly(rows: NDArray, at_most: int) -> NDArray:
    """At most `at_most` rows, evenly spread: resampling keeps the copies of one particle together, so they stand for all."""
    return rows if len(rows) <= at_most else rows[np.linspace(0, len(rows) - 1, at_most).astype(np.int64)]
