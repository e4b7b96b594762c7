"""Algorithm 6.3: where a particle may be after the wheels reported a motion.

The motion between two odometry poses is read as a turn, a straight line and a second turn (fig. 6.1); each particle makes
it with noise of its own.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.checks import check_pose, check_poses, check_record, check_rng
from priorlab.core.pose import wrap_angle
from priorlab.slam.parameters import TUNED, Parameters

STANDSTILL_M = 0.001
"""Below this translation its direction is chance: the first turn is 0 and the second one takes the whole rotation."""


def motion_parts(before: ArrayLike, after: ArrayLike) -> tuple[float, float, float]:
    """delta_rot1, delta_trans, delta_rot2 between two odometry poses (x, y, theta), metres and radians.

    >>> [round(part, 3) for part in motion_parts([0, 0, 0], [0, 2, 0])]       # turn left, drive 2 m, turn back
    [1.571, 2.0, -1.571]
    """
    (x, y, theta), (x_after, y_after, theta_after) = check_pose("before", before), check_pose("after", after)
    trans = float(np.hypot(x_after - x, y_after - y))  # the root of the SUM: the print has a comma
    rot1 = float(wrap_angle(np.arctan2(y_after - y, x_after - x) - theta)) if trans >= STANDSTILL_M else 0.0
    rot2 = float(wrap_angle(theta_after - theta - rot1))  # the line that the print lacks
    return rot1, trans, rot2


def motion_deviations(rot1: float, trans: float, rot2: float, parameters: Parameters = TUNED) -> NDArray[np.float64]:
    """(3,) standard deviations of the two turns and the line, in the order rot1, trans, rot2."""
    a1, a2, a3, a4 = parameters.alphas
    if parameters.rotation_noise == "symmetric":  # a turn by pi before a tiny step back is no turn at all
        rot1, rot2 = (min(abs(rot), np.pi - abs(rot)) for rot in (rot1, rot2))
    spread = np.array(
        [
            a1 * rot1**2 + a2 * trans**2,
            a3 * trans**2 + a4 * rot1**2 + a4 * rot2**2,
            a1 * rot2**2 + a2 * trans**2,
        ]
    )
    return np.sqrt(spread) if parameters.noise == "variance" else spread


def sample_motion(
    poses: NDArray[np.float64],
    before: ArrayLike,
    after: ArrayLike,
    rng: np.random.Generator,
    parameters: Parameters = TUNED,
) -> NDArray[np.float64]:
    """Move every particle as the odometry says, each with noise of its own (algorithm 6.3).

    Parameters
    ----------
    poses : (N, 3) particles x, y, theta; metres
    before, after : (3,) odometry poses, the control u_k
    rng : three normal numbers per particle are drawn
    parameters : `alphas`, `noise` and `rotation_noise` are used

    Returns
    -------
    (N, 3) poses; theta in [-pi, pi)

    >>> exact = Parameters(alphas=(0, 0, 0, 0))
    >>> sample_motion(np.array([[5.0, 5.0, 0.0]]), [0, 0, 0], [1, 0, 0], np.random.default_rng(0), exact).tolist()
    [[6.0, 5.0, 0.0]]
    """
    check_record("parameters", parameters, Parameters)
    poses, parts = check_poses("poses", poses), motion_parts(before, after)
    noise = check_rng(rng).standard_normal((len(poses), 3)) * motion_deviations(*parts, parameters)
    rot1, trans, rot2 = (np.array(parts) - noise).T
    x, y, theta = poses.T
    return np.column_stack(
        [
            x + trans * np.cos(theta + rot1),
            y + trans * np.sin(theta + rot1),
            wrap_angle(theta + rot1 + rot2),
        ]
    )
