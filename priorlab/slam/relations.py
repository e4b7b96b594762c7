"""How well a trajectory keeps steps that are known to be true (Kuemmerle et al. 2009): it asks for no frame and no alignment.

With delta_ij = x_i^-1 x_j, the step of the estimate, and delta*_ij the true one, the error of a relation is the step
delta*_ij^-1 delta_ij that is left, and

    epsilon = mean of |trans(delta*_ij^-1 delta_ij)|^2, and the same of |rot(...)|^2;

the authors' tables give the mean of the plain sizes beside that of the squares.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.checks import check_poses
from priorlab.core.pose import relative, wrap_angle
from priorlab.interchange.relations import Relations

WIDEST_GAP_S = 5.0
"""Between poses farther apart in time nobody knows where the robot was; freiburg-079 has a scan every 2.3 s or sooner."""


@dataclass(frozen=True, eq=False)
class RelationErrors:
    """The errors of the relations that a trajectory covers.

    Parameters
    ----------
    translation_m : (R,) metres
    rotation : (R,) radians, from 0 to pi
    n_relations : relations there were; the rest lies outside the trajectory or in a gap of it

    >>> RelationErrors(np.array([0.1, 0.3]), np.radians([1.0, 3.0]), 5)
    RelationErrors(0.200 +- 0.100 m, 2.00 +- 1.00 degrees, 2 of 5 relations)
    """

    translation_m: NDArray[np.float64]
    rotation: NDArray[np.float64]
    n_relations: int

    def __len__(self) -> int:
        return len(self.translation_m)

    @property
    def mean_square_m2(self) -> float:
        """epsilon_trans, the authors' first measure; square metres."""
        return float(np.mean(np.square(self.translation_m)))

    @property
    def mean_square_rotation(self) -> float:
        """epsilon_rot; square radians."""
        return float(np.mean(np.square(self.rotation)))

    def __repr__(self) -> str:
        along, turn = self.translation_m, np.degrees(self.rotation)
        return (
            f"RelationErrors({along.mean():.3f} +- {along.std():.3f} m, {turn.mean():.2f} +- {turn.std():.2f} degrees, "
            f"{len(self)} of {self.n_relations} relations)"
        )


def relation_errors(trajectory: ArrayLike, stamps: ArrayLike, relations: Relations, behind_s: float = 0.0) -> RelationErrors:
    """Compare a trajectory with relations; between two poses it is a straight line.

    Parameters
    ----------
    trajectory : (T, 3) poses x, y, theta; metres, in any frame
    stamps : (T,) seconds, rising
    relations : the true steps
    behind_s : how far the trajectory's clock is behind that of the relations: its time = theirs - `behind_s`
        (1211.36 s for the log and the relations of freiburg-079)

    Raises
    ------
    ValueError
        When poses and stamps do not fit together, or no relation lies within the trajectory.

    >>> true_step = Relations([[100.0, 101.0]], [[1.0, 0.0, 0.0]])
    >>> relation_errors([[5, 5, 0], [6.25, 5, 0]], [0, 1], true_step, behind_s=100).translation_m.tolist()
    [0.25]
    """
    poses = check_poses("trajectory", trajectory)
    stamps = np.asarray(stamps, dtype=np.float64)
    if stamps.shape != (len(poses),) or not np.isfinite(stamps).all() or (np.diff(stamps) < 0).any():
        raise ValueError(f"stamps must be {len(poses)} finite numbers that rise, one per pose, got shape {stamps.shape}")
    if len(poses) < 2:
        raise ValueError(f"trajectory must hold at least two poses, got {len(poses)}")
    moments = relations.stamps - behind_s
    after = np.searchsorted(stamps, moments).clip(1, len(stamps) - 1)
    covered = (moments >= stamps[0]) & (moments <= stamps[-1]) & (stamps[after] - stamps[after - 1] <= WIDEST_GAP_S)
    inside = covered.all(axis=1)
    if not inside.any():
        raise ValueError(
            f"at least one relation must lie within the trajectory, from {stamps[0]:g} to {stamps[-1]:g} s, "
            f"got moments from {moments.min():g} to {moments.max():g} s: is `behind_s` right?"
        )
    first, second = (_poses_at(moments[inside, i], stamps, poses) for i in (0, 1))
    left = relative(relations.steps[inside], relative(first, second))
    return RelationErrors(np.hypot(left[:, 0], left[:, 1]), np.abs(left[:, 2]), len(relations))


def _poses_at(moments: NDArray[np.float64], stamps: NDArray[np.float64], poses: NDArray[np.float64]) -> NDArray[np.float64]:
    """(R, 3) poses at some moments, between those of the trajectory; headings turn the short way."""
    x, y, theta = poses.T
    columns = [np.interp(moments, stamps, column) for column in (x, y, np.unwrap(theta))]
    return np.column_stack([columns[0], columns[1], wrap_angle(columns[2])])
