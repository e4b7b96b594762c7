"""The parts of algorithm 6.2, Monte Carlo localization: move the particles, weigh them, draw the next ones.

`FastSLAM.step` calls them in turn, with `estimate_pose` between weighing and drawing.
"""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.checks import check_record
from priorlab.slam.impassable import Impassable
from priorlab.slam.kld import kld_count, number_bins, pose_bins
from priorlab.slam.likelihood_field import LikelihoodField
from priorlab.slam.measurement import log_weights
from priorlab.slam.motion import sample_motion
from priorlab.slam.parameters import TUNED, Parameters
from priorlab.slam.particles import Particles
from priorlab.slam.resampling import resample
from priorlab.slam.scan import Scan


class Localized(Protocol):
    """What every step of localization says, however it was made (`Step` does).

    `pose`: (3,) the estimate x, y, theta, metres. `weighed`: the particles with their weights, before resampling. `particles`:
    those that go on.
    """

    @property
    def pose(self) -> NDArray[np.float64]: ...
    @property
    def weighed(self) -> Particles: ...
    @property
    def particles(self) -> Particles: ...


def predict(
    particles: Particles,
    before: ArrayLike,
    after: ArrayLike,
    rng: np.random.Generator,
    parameters: Parameters = TUNED,
    impassable: Impassable | None = None,
) -> Particles:
    """x_k^[j] = SampleMotionModel(u_k, x_{k-1}^[j]) for all j; with the plan's walls, those that drove into one lose weight."""
    check_record("particles", particles, Particles)
    poses = sample_motion(particles.poses, before, after, rng, parameters)
    if impassable is None:
        return Particles(poses, particles.log_weights)
    check_record("impassable", impassable, Impassable)
    return Particles(poses, particles.log_weights + impassable.log_weights(particles.poses, poses))


def weigh(particles: Particles, scan: Scan, field: LikelihoodField) -> Particles:
    """w_k^[j] = MeasurementModel(z_k, x_k^[j], m_{k-1}) for all j, times the weight that was left over."""
    for name, value, kind in (("particles", particles, Particles), ("scan", scan, Scan), ("field", field, LikelihoodField)):
        check_record(name, value, kind)
    return Particles(particles.poses, particles.log_weights + log_weights(particles.poses, scan, field))


def choose(particles: Particles, rng: np.random.Generator, parameters: Parameters = TUNED) -> Particles:
    """Draw with a probability proportional to w_k^[j], as many as the spread asks for; afterwards all weigh the same."""
    check_record("particles", particles, Particles)
    check_record("parameters", parameters, Parameters)
    fewest, most = parameters.particle_limits
    weights = particles.weights
    n_draws = most
    if fewest < most:
        pilot = resample(weights, most, rng, "multinomial")  # Fox's rule counts bins of independent draws
        _, bin_of_particle = number_bins(pose_bins(particles.poses, parameters))
        n_draws = kld_count(bin_of_particle[pilot], parameters)
    drawn = resample(weights, n_draws, rng, parameters.resampling)
    return Particles(particles.poses[drawn], ancestors=drawn)
