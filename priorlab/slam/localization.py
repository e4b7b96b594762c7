"""Algorithm 6.2, Monte Carlo localization: move the particles, weigh them, say where the robot is, draw the next particles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.slam.estimate import estimate_pose
from priorlab.slam.kld import kld_count, number_bins, pose_bins
from priorlab.slam.likelihood_field import LikelihoodField
from priorlab.slam.measurement import log_weights
from priorlab.slam.motion import sample_motion
from priorlab.slam.parameters import TUNED, Parameters
from priorlab.slam.particles import Particles
from priorlab.slam.resampling import resample
from priorlab.slam.scan import Scan


@dataclass(frozen=True, eq=False)
class Localized:
    """What one step of localization says.

    Parameters
    ----------
    pose : (3,) the estimate x, y, theta; metres
    weighed : the particles with their weights, before resampling
    particles : those that go on
    """

    pose: NDArray[np.float64]
    weighed: Particles
    particles: Particles


def localise(
    particles: Particles,
    before: ArrayLike,
    after: ArrayLike,
    scan: Scan,
    field: LikelihoodField,
    rng: np.random.Generator,
    parameters: Parameters = TUNED,
    resample_now: bool = True,
) -> Localized:
    """One step of algorithm 6.2.

    Parameters
    ----------
    particles : the belief so far
    before, after : (3,) odometry poses, the control u_k
    scan : z_k; without a return it neither weighs nor resamples
    field : likelihood field of the map m_{k-1}
    rng : for the motion and for the draws
    resample_now : False in the steps between two resamplings; the weights then pile up
    """
    moved = predict(particles, before, after, rng, parameters)
    weighed = weigh(moved, scan, field)
    pose = estimate_pose(weighed, parameters)
    chosen = choose(weighed, rng, parameters) if resample_now and len(scan) else weighed
    return Localized(pose, weighed, chosen)


def predict(
    particles: Particles, before: ArrayLike, after: ArrayLike, rng: np.random.Generator, parameters: Parameters = TUNED
) -> Particles:
    """x_k^[j] = SampleMotionModel(u_k, x_{k-1}^[j]) for all j."""
    return Particles(sample_motion(particles.poses, before, after, rng, parameters), particles.log_weights)


def weigh(particles: Particles, scan: Scan, field: LikelihoodField) -> Particles:
    """w_k^[j] = MeasurementModel(z_k, x_k^[j], m_{k-1}) for all j, times the weight that was left over."""
    return Particles(particles.poses, particles.log_weights + log_weights(particles.poses, scan, field))


def choose(particles: Particles, rng: np.random.Generator, parameters: Parameters = TUNED) -> Particles:
    """Draw with a probability proportional to w_k^[j], as many as the spread asks for; afterwards all weigh the same."""
    fewest, most = parameters.particle_limits
    weights = particles.weights
    n_draws = most
    if fewest < most:
        pilot = resample(weights, most, rng, "multinomial")  # Fox's rule counts bins of independent draws
        _, bin_of_particle = number_bins(pose_bins(particles.poses, parameters))
        n_draws = kld_count(bin_of_particle[pilot], parameters)
    return Particles(particles.poses[resample(weights, n_draws, rng, parameters.resampling)])
