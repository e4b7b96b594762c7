"""The belief about the pose: particles, each with the log of its weight."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.checks import as_numbers, check_pose, check_poses, check_rng, check_whole
from priorlab.core.pose import wrap_angle
from priorlab.slam.parameters import MOST_PARTICLES


@dataclass(frozen=True, eq=False)
class Particles:
    """Guesses of where the robot is.

    Parameters
    ----------
    poses : (N, 3) x, y, theta; metres, y up
    log_weights : (N,) log of the weights, up to a common constant; equal weights by default
    ancestors : (N,) after a draw, the number of the particle that each was drawn from; None else

    >>> Particles([[0, 0, 0], [1, 0, 0]], np.log([1, 3])).weights.tolist()
    [0.25, 0.75]
    """

    poses: NDArray[np.float64]
    log_weights: NDArray[np.float64] = None  # type: ignore[assignment]
    ancestors: NDArray[np.int64] | None = None

    def __post_init__(self) -> None:
        poses = check_poses("poses", self.poses)
        if len(poses) == 0:
            raise ValueError("poses must hold at least one particle, got none")
        logs = np.zeros(len(poses)) if self.log_weights is None else as_numbers("log_weights", self.log_weights)
        if logs.shape != (len(poses),) or np.isnan(logs).any() or not np.isfinite(logs.max()):
            raise ValueError(f"log_weights must be {len(poses)} numbers, at least one of them finite, got shape {logs.shape}")
        object.__setattr__(self, "poses", poses)
        object.__setattr__(self, "log_weights", logs)

    def __len__(self) -> int:
        return len(self.poses)

    @property
    def weights(self) -> NDArray[np.float64]:
        """(N,) weights that sum to 1. The largest log is taken off first, so that 60 small factors cannot underflow."""
        weights = np.exp(self.log_weights - self.log_weights.max())
        return weights / weights.sum()

    @property
    def effective_number(self) -> float:
        """ESS = 1 / sum(w^2): N when all weigh the same, 1 when one has all the weight."""
        return float(1.0 / np.square(self.weights).sum())

    def __repr__(self) -> str:
        x, y, _ = self.poses.mean(axis=0)
        return f"Particles({len(self)} round x {x:.2f}, y {y:.2f} m, ESS {self.effective_number:.0f})"


def start_particles(
    start: ArrayLike, n_particles: int, variances: tuple[float, float, float], rng: np.random.Generator
) -> Particles:
    """Particles round a known start: all on it when the variances are 0 (6.2.2), normal round it otherwise (eq. 6.3).

    >>> start_particles([1, 2, 0], 3, (0, 0, 0), np.random.default_rng(0)).poses.tolist()
    [[1.0, 2.0, 0.0], [1.0, 2.0, 0.0], [1.0, 2.0, 0.0]]
    """
    rng, n_particles = check_rng(rng), check_whole("n_particles", n_particles, most=MOST_PARTICLES)
    centre = check_pose("start", start)
    spread = as_numbers("variances", variances)
    if spread.shape != (3,) or not (np.isfinite(spread) & (spread >= 0)).all():
        raise ValueError(f"variances must be three finite numbers of at least 0, got {variances}")
    poses = centre + rng.standard_normal((n_particles, 3)) * np.sqrt(spread)
    poses[:, 2] = wrap_angle(poses[:, 2])
    return Particles(poses)
