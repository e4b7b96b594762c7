"""Resampling against filterpy's two good resamplers, with the same offsets, and against what the methods promise."""

import contextlib

import numpy as np
import pytest
from filterpy.monte_carlo import residual_resample, stratified_resample, systematic_resample
from hypothesis import given, settings
from hypothesis import strategies as st

from priorlab.slam.particles import Particles, start_particles
from priorlab.slam.resampling import resample


@contextlib.contextmanager
def global_offsets(seed):
    """filterpy draws from NumPy's global generator: seed it, then give it back as it was."""
    state = np.random.get_state()  # noqa: NPY002
    np.random.seed(seed)  # noqa: NPY002
    try:
        yield
    finally:
        np.random.set_state(state)  # noqa: NPY002


class SameOffsets(np.random.Generator):
    """Stands in for a Generator and draws what the seeded global generator would."""

    def __init__(self, seed):
        super().__init__(np.random.PCG64(seed))
        self.legacy = np.random.RandomState(seed)  # noqa: NPY002

    def random(self, size=None):
        return self.legacy.random_sample(size)


@pytest.mark.parametrize(("method", "reference"), [("systematic", systematic_resample), ("stratified", stratified_resample)])
@pytest.mark.parametrize("seed", range(10))
def test_resample_agrees_with_filterpy(method, reference, seed):
    weights = np.random.default_rng(seed).random(500) ** 8
    weights /= weights.sum()
    with global_offsets(seed):
        expected = reference(weights)
    assert np.array_equal(resample(weights, 500, SameOffsets(seed), method), expected)


def right_residual_counts(weights, rng):
    """Every particle floor(N w) times; the rest drawn by what is left, N w - floor(N w)."""
    n = len(weights)
    counts = [int(n * w) for w in weights]
    left = [n * w - count for w, count in zip(weights, counts, strict=True)]
    shares = np.cumsum(left) / sum(left)
    for _ in range(n - sum(counts)):
        counts[int(np.searchsorted(shares, rng.random(), side="right"))] += 1
    return np.array(counts)


def test_residual_resample_of_filterpy_lacks_a_factor():
    weights = np.array([0.5, 0.21, 0.2, 0.07, 0.02])  # N w is 2.5, 1.05, 1, 0.35, 0.1
    with global_offsets(0):
        wrong = np.mean([np.bincount(residual_resample(weights), minlength=5) for _ in range(4000)], axis=0)
    rng = np.random.default_rng(0)
    right = np.mean([right_residual_counts(weights, rng) for _ in range(4000)], axis=0)
    assert right == pytest.approx(5 * weights, abs=0.03)  # as often as the weight says
    # its residual is w - floor(N w); over its sum, below 0, those already taken are drawn once more and the light ones never
    assert wrong[3:].tolist() == [0, 0]
    ours = np.mean([np.bincount(resample(weights, 5, rng, "stratified"), minlength=5) for _ in range(4000)], axis=0)
    assert ours == pytest.approx(5 * weights, abs=0.03)


@given(st.lists(st.floats(0, 1), min_size=1, max_size=30).filter(lambda w: sum(w) > 1e-6), st.integers(1, 80), st.integers(0, 99))
@settings(deadline=None)
def test_resample_systematic_repeats_floor_or_ceil_times(raw, n_draws, seed):
    weights = np.array(raw) / np.sum(raw)
    counts = np.bincount(resample(weights, n_draws, np.random.default_rng(seed)), minlength=len(weights))
    assert counts.sum() == n_draws
    assert (counts >= np.floor(n_draws * weights - 1e-9)).all() and (counts <= np.ceil(n_draws * weights + 1e-9)).all()
    assert (counts[weights == 0] == 0).all()


@pytest.mark.parametrize("method", ["systematic", "stratified", "multinomial"])
def test_resample_draws_in_proportion(method):
    weights = np.array([0.1, 0.0, 0.6, 0.3, 0.0])
    rng = np.random.default_rng(0)
    counts = sum(np.bincount(resample(weights, 100, rng, method), minlength=5) for _ in range(400))
    assert counts / 40_000 == pytest.approx(weights, abs=0.01)
    assert counts[1] == counts[4] == 0


def test_resample_multinomial_varies_most_and_systematic_least():
    weights = np.arange(1, 51) / 1275
    spread = {}
    for method in ("systematic", "stratified", "multinomial"):
        rng = np.random.default_rng(1)
        counts = np.array([np.bincount(resample(weights, 75, rng, method), minlength=50) for _ in range(100)])
        spread[method] = np.square(counts - 75 * weights).mean()
    assert 1.2 * spread["systematic"] < spread["stratified"] < spread["multinomial"] / 1.2


class Always(np.random.Generator):
    """A Generator that draws one number again and again."""

    def __init__(self, number):
        super().__init__(np.random.PCG64(0))
        self.number = number

    def random(self, size=None):
        return self.number if size is None else np.full(size, self.number)


def test_resample_never_draws_a_weight_of_zero_at_either_end():
    highest = float(np.nextafter(1.0, 0.0))
    tenths = [0.0] + [0.1] * 10 + [0.0]  # adds up to a hair below 1
    assert sum(tenths) <= highest
    assert resample(tenths, 1, Always(0.0)).tolist() == [1]
    assert resample(tenths, 3, Always(highest), "multinomial").tolist() == [10, 10, 10]


@pytest.mark.parametrize(
    ("weights", "n_draws", "method", "sentence"),
    [
        ([0.5, 0.6], 2, "systematic", "weights must sum to 1, got 1.1"),
        ([0.0, 0.0], 2, "systematic", "weights must sum to 1, got 0"),
        ([1.5, -0.5], 2, "systematic", "weights must not be negative or nan, got -0.5"),
        ([np.nan, 1.0], 2, "systematic", "weights must not be negative or nan, got nan"),
        ([], 2, "systematic", "weights must be a list of at least one number"),
        ([1.0], 0, "systematic", "n_draws must be a whole number of at least 1, got 0"),
        ([1.0], 2.5, "systematic", "n_draws must be a whole number of at least 1, got 2.5"),
        ([1.0], 2, "residual", "resampling must be one of systematic, stratified, multinomial, got 'residual'"),
    ],
)
def test_resample_says_what_is_wrong(weights, n_draws, method, sentence):
    with pytest.raises(ValueError, match=sentence):
        resample(weights, n_draws, np.random.default_rng(0), method)


def test_particles_weigh_without_underflow():
    particles = Particles(np.zeros((3, 3)), np.array([-5000.0, -5000.0 + np.log(3), -np.inf]))
    assert particles.weights == pytest.approx([0.25, 0.75, 0])
    assert particles.effective_number == pytest.approx(1 / (0.0625 + 0.5625))
    assert "ESS 2" in repr(particles)


@pytest.mark.parametrize("logs", [[np.nan, 0.0], [-np.inf, -np.inf], [np.inf, 0.0], [0.0]])
def test_particles_refuse_weights_that_are_none(logs):
    with pytest.raises(ValueError, match="log_weights must be 2 numbers"):
        Particles(np.zeros((2, 3)), np.array(logs))


def test_particles_refuse_nobody_and_nan():
    with pytest.raises(ValueError, match="at least one particle"):
        Particles(np.empty((0, 3)))
    with pytest.raises(ValueError, match="poses must be finite numbers"):
        Particles(np.array([[0.0, np.nan, 0.0]]))


def test_start_particles_have_the_variances_of_eq_6_3():
    poses = start_particles([1, 2, 3], 50_000, (0.1, 0.2, 0.0), np.random.default_rng(0)).poses
    assert poses.mean(axis=0) == pytest.approx([1, 2, 3], abs=0.01)
    assert poses.var(axis=0) == pytest.approx([0.1, 0.2, 0.0], abs=0.005)
    assert np.abs(start_particles([0, 0, 3.1], 100, (0, 0, 0.1), np.random.default_rng(0)).poses[:, 2]).max() <= np.pi
