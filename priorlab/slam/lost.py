"""When is a robot lost? A lost robot still draws a map, and a gain over it means nothing: every figure asks this first."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from priorlab.core.pose import relative
from priorlab.core.readings import RobotLog
from priorlab.slam.trajectory_error import position_errors_m

LOST_M = 1.0
"""A robot this far from the truth, or whose estimate leaps this far against its wheels, is lost: it may be in the next room."""

IN_WALLS = 0.02
"""Share of the steps whose estimate stands in a wall of the plan: at most 0.8 % for a robot that drove through two doorways
that the plan walls up, 3 to 9 % for every lost one."""

FEWEST_IN_WALLS = 5
"""A single slip into a wall's edge is no sign."""

WINDOW_STEPS = 100
LEAST_EXPLAINED = 0.15
"""Over any 100 steps the walls of the plan explained at least 23 % of the beams of a robot that knew where it was (the furnished
buildings; 31 % on our floor), and none at all of one that was lost."""


def lost_because(
    trajectory: NDArray[np.float64], in_wall: NDArray[np.bool_], explained: NDArray[np.float64], log: RobotLog
) -> str | None:
    """A sentence when a run got lost, None when it did not.

    The truth decides when the log holds it: the estimate is far from it or not. Without it there are three signs: the estimate
    leaps where the wheels say that the robot hardly moved; it drives through walls of the plan; those walls explain few of the
    beams for a while. Signs, not proofs: a robot may be off by a metre and show none.

    Parameters
    ----------
    trajectory : (T, 3) estimated poses, metres
    in_wall : (T,) True where the estimate stands in a wall of the plan, or off the map
    explained : (T,) share of the beams that end at a wall of the plan; nan for few beams
    log : the drive
    """
    if log.truth is not None:
        errors = position_errors_m(trajectory, log.truth)
        if errors.max() <= LOST_M:
            return None
        step = int(np.argmax(errors > LOST_M))
        return f"the estimate is more than {LOST_M:g} m off the true position from step {step}, at worst {errors.max():.1f} m"
    if len(trajectory) > 1:
        told, moved = (relative(poses[:-1], poses[1:]) for poses in (log.odometry, trajectory))
        leaps = np.hypot(*(moved - told)[:, :2].T)
        if leaps.max() > LOST_M:
            return f"the estimate leapt {leaps.max():.1f} m against the wheels at step {int(leaps.argmax()) + 1}"
    if in_wall.sum() >= FEWEST_IN_WALLS and in_wall.mean() > IN_WALLS:
        return f"the estimate stands in walls of the plan in {100 * in_wall.mean():.0f} % of the steps"
    beams = np.isfinite(explained)
    window = np.ones(min(WINDOW_STEPS, len(explained)))
    n_scans = np.convolve(beams, window, "valid")
    share = np.convolve(np.where(beams, explained, 0.0), window, "valid") / np.maximum(n_scans, 1)
    share[n_scans < len(window) / 2] = 1.0  # too few scans to say anything
    if share.min() < LEAST_EXPLAINED:
        first, percent = int(share.argmin()), 100 * share.min()
        return f"the plan's walls explain only {percent:.0f} % of the beams in steps {first} to {first + len(window) - 1}"
    return None
