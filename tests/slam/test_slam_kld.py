"""KLD sampling against the chi-square table it approximates, and against Fox's loop, draw by draw."""

import math
from dataclasses import replace

import numpy as np
import pytest

from priorlab.slam.kld import kld_bound, kld_count, number_bins, pose_bins, theta_bin_count
from priorlab.slam.parameters import TUNED


def slow_count(drawn, fewest, most, epsilon, z):
    """Fox (2003), table 1: draw, note a new bin, raise the bound, until enough were drawn."""
    bins, n, bound = set(), 0, 0.0
    for bin_ in drawn:
        n += 1
        if bin_ not in bins:
            bins.add(bin_)
            k = len(bins)
            if k > 1:
                a = 2 / (9 * (k - 1))
                bound = (k - 1) / (2 * epsilon) * (1 - a + math.sqrt(a) * z) ** 3
        if n >= max(bound, fewest):
            return n
    return most


@pytest.mark.parametrize(("n_bins", "chi_square_99"), [(2, 6.635), (6, 15.086), (11, 23.209), (31, 50.892), (101, 135.807)])
def test_kld_bound_follows_the_chi_square_table(n_bins, chi_square_99):
    assert kld_bound(n_bins) == pytest.approx(chi_square_99 / (2 * 0.01), rel=0.01)


@pytest.mark.parametrize("n_kinds", [1, 5, 12, 25, 60, 4000])
def test_kld_count_stops_where_foxs_loop_stops(n_kinds):
    parameters = replace(TUNED, particle_limits=(200, 4500))
    for seed in range(5):
        drawn = np.random.default_rng(seed).integers(0, n_kinds, 4500)
        assert kld_count(drawn, parameters) == slow_count(drawn.tolist(), 200, 4500, 0.01, 2.326)


def test_kld_count_keeps_the_limits():
    assert kld_count(np.zeros(4500, dtype=int)) == 1500
    assert kld_count(np.arange(4500)) == 4500


def test_pose_bins_go_round():
    bins = pose_bins(np.array([[0, 0, math.radians(359.9)], [0.49, -0.01, math.radians(-0.1)], [0, 0, -1e-17]]))
    assert bins.tolist() == [[0, 0, 35], [0, -1, 35], [0, 0, 0]]
    assert theta_bin_count() == 36


def test_number_bins_agrees_with_sets():
    bins = np.random.default_rng(0).integers(-3, 3, (400, 3))
    different, number = number_bins(bins)
    assert sorted(map(tuple, different.tolist())) == sorted(set(map(tuple, bins.tolist())))
    assert np.array_equal(different[number], bins)
