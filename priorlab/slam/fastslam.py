"""Algorithm 6.1: occupancy grid FastSLAM. Localize in the map, update the map from where the robot seems to be, go on."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import fields, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import check_record, check_rng
from priorlab.core.grid_map import GridMap
from priorlab.core.readings import RobotLog
from priorlab.core.shipped import nearest_name
from priorlab.mapping.overruled import warn_when_overruled
from priorlab.slam.estimate import estimate_pose
from priorlab.slam.impassable import Impassable
from priorlab.slam.lagging_field import LaggingField
from priorlab.slam.likelihood_field import LikelihoodField
from priorlab.slam.localization import choose, predict, weigh
from priorlab.slam.map_update import SeenCells, see_cells, update_seen
from priorlab.slam.measurement import share_explained
from priorlab.slam.own_maps import OwnMaps
from priorlab.slam.parameters import TUNED, Parameters
from priorlab.slam.particles import start_particles
from priorlab.slam.recording import Recorder, Run
from priorlab.slam.scan import choose_beams, weighing_steps
from priorlab.slam.state import State, Step

FARTHEST_M = 1e6
"""Wheels that tell of a longer drive are broken, and numbers of cells would no longer be exact."""


class FastSLAM:
    """Occupancy grid FastSLAM with one map that all particles share, updated from the best estimate (thesis 6.4), or, with
    `localize_in="own"`, a map for each of up to 100 particles (thesis 2.2.3).

    Parameters
    ----------
    parameters : the numbers of the method; `TUNED` works, `TABLE_6_1` is as printed
    changes : single parameters by name

    >>> FastSLAM(temper=0.1).parameters.temper
    0.1
    """

    def __init__(self, parameters: Parameters = TUNED, **changes: Any) -> None:
        check_record("parameters", parameters, Parameters)
        known = sorted(field.name for field in fields(Parameters))
        for name in changes:
            nearest_name("parameter", name, known)
        self.parameters = replace(parameters, **changes)

    def __repr__(self) -> str:
        preset = {field.name: field.default for field in fields(Parameters)}
        changed = ", ".join(f"{name}={value!r}" for name, value in vars(self.parameters).items() if value != preset[name])
        return f"FastSLAM(TUNED{', ' if changed else ''}{changed})"

    def run(
        self,
        prior_map: GridMap,
        log: RobotLog,
        rng: np.random.Generator,
        progress: Callable[[int, int], None] | None = None,
    ) -> Run:
        """Drive through a log once: `start`, then `step` by step, then `finish`.

        Parameters
        ----------
        prior_map : m_0 on a grid that knows its scale; it starts the map, and the robot localizes by its walls
        log : odometry and scans, metres; the robot starts at `log.start`
        rng : for the motion of the particles and their draws
        progress : called with the steps done and the steps to do

        Returns
        -------
        Run, the record of all steps; `.map` is m_T

        Raises
        ------
        ValueError
            When the log is empty, when it starts off the map or in a wall, when the map has no scale or holds no wall.

        Warns
        -----
        OverruledSensorWarning
            When the prior is surer than the sensor (eq. 2.22).
        UserWarning
            When the start lies nearer to a wall than `robot_radius_m`.
        """
        state = self.start(prior_map, log, rng)
        while not state.done:
            self.step(state)
            if progress:
                progress(state.step, len(log))
        return self.finish(state)

    def start(self, prior_map: GridMap, log: RobotLog, rng: np.random.Generator) -> State:
        """The state before the first step; arguments, errors and warnings are those of `run`."""
        rng = check_rng(rng)
        check_record("prior_map", prior_map, GridMap)
        check_record("log", log, RobotLog)
        parameters = self.parameters
        plan = LikelihoodField.of(prior_map, parameters)
        _check_start(plan, prior_map, log)
        warn_when_overruled(prior_map.prior, parameters.p_free, parameters.p_occupied, parameters.lam)
        particles = start_particles(log.start, parameters.particle_limits[1], parameters.start_variances, rng)
        growing = LaggingField(plan, prior_map.log_odds, parameters) if parameters.localize_in == "updated" else None
        steps_m = np.hypot(*np.diff(log.odometry[:, :2], axis=0, prepend=log.odometry[:1, :2]).T)
        weighs = weighing_steps(log, parameters)
        return State(
            prior_map=prior_map,
            log=log,
            plan=plan,
            impassable=_impassable(prior_map, log, parameters),
            way_m=np.cumsum(steps_m),
            weighs=weighs,
            resamples=weighs & (np.cumsum(weighs) % parameters.resampling_interval == 0),
            step=0,
            particles=particles,
            log_odds=prior_map.log_odds.copy(),
            growing=growing,
            own=OwnMaps(prior_map, len(particles), parameters) if parameters.localize_in == "own" else None,
            rng=rng,
            recorder=Recorder(),
        )

    def step(self, state: State) -> Step:
        """One iteration of algorithm 6.1: Localise (algorithm 6.2), UpdateOccupancyGridMap (algorithm 6.5). Moves `state` on.

        Raises
        ------
        ValueError
            When the log has no further step.
        """
        check_record("state", state, State)
        if state.done:
            raise ValueError(f"step must be below the {len(state.log)} scans of the log, got {state.step}")
        parameters, log, k = self.parameters, state.log, state.step
        scan = choose_beams(log, k, parameters)
        moved = predict(state.particles, log.odometry[max(k - 1, 0)], log.odometry[k], state.rng, parameters, state.impassable)
        weighed = moved
        if state.weighs[k]:
            weighed = state.own.weigh(moved, scan) if state.own else weigh(moved, scan, state.field)
        pose = estimate_pose(weighed, parameters)
        particles = choose(weighed, state.rng, parameters) if state.resamples[k] else weighed
        seen = self.map_scan(state, k, pose)
        if state.own:
            state.own.update(weighed, particles, scan, state.way_m[k])
        done = Step(k, scan, moved, weighed, pose, particles, seen)
        state.recorder.add(done, share_explained(pose, scan, state.plan))
        state.step, state.particles = k + 1, particles
        return done

    def map_scan(self, state: State, k: int, pose: NDArray[np.float64]) -> SeenCells:
        """The second half of step k: algorithm 6.5 from a pose. Whoever restores a state puts its old poses into the map so."""
        seen = see_cells(state.prior_map.grid, pose, choose_beams(state.log, k, self.parameters), self.parameters)
        update_seen(state.log_odds, state.prior_map.log_odds, seen, self.parameters)
        if state.growing:
            state.growing.add(seen, state.way_m[k])
        return seen

    def finish(self, state: State) -> Run:
        """The record of the steps made so far; of all of them when the state is done."""
        run = state.recorder.finish(state.prior_map, state.log, self.parameters, state.map)
        return replace(run, path=state.own.paths[state.own.heaviest]) if state.own else run


def _impassable(prior_map: GridMap, log: RobotLog, parameters: Parameters) -> Impassable | None:
    """Where the plan lets no robot drive, or None when driving there costs nothing."""
    if parameters.p_through_wall == 1:
        return None
    impassable = Impassable.of(prior_map, parameters)
    if impassable.holds(log.start[None]).item():
        warnings.warn(
            f"start lies nearer to a wall than robot_radius_m, {parameters.robot_radius_m:g} m: walls do not hinder particles "
            "until they have left them",
            stacklevel=4,
        )
    return impassable


def _check_start(plan: LikelihoodField, prior_map: GridMap, log: RobotLog) -> None:
    """A drive needs steps, and a robot cannot start off the map or in a wall."""
    if len(log) == 0:
        raise ValueError("the log must hold at least one scan, got 0")
    farthest = max(np.ptp(log.odometry[:, 0] / 2), np.ptp(log.odometry[:, 1] / 2)) * 2
    if not farthest <= FARTHEST_M:
        raise ValueError(f"odometry must stay within {FARTHEST_M:g} m, got poses {farthest:.3g} m apart")
    grid, (x, y, _) = prior_map.grid, log.start
    width_m, height_m = grid.image_shape[1] * grid.scale, grid.image_shape[0] * grid.scale
    if max(abs(x), abs(y)) > FARTHEST_M or not grid.contains(grid.metres_to_xy(log.start[:2])):
        raise ValueError(f"start must lie on the map of {width_m:.2f} x {height_m:.2f} m, got x {x:g}, y {y:g} m")
    if grid.at_metres(plan.occupied(prior_map.log_odds), log.start[None], outside=False).item():
        raise ValueError(f"start must lie in free space, got x {x:g}, y {y:g} m, where the map shows a wall")
