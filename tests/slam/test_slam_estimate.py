"""The estimate: clusters against a slow flood, means by hand."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from priorlab.slam.estimate import circular_mean, clusters, estimate_pose
from priorlab.slam.parameters import TUNED
from priorlab.slam.particles import Particles


def slow_clusters(poses):
    """Flood from bin to bin, 0.5 m and 10 degrees; a frozen set of particle numbers per cluster."""
    bins = {}
    for i, (x, y, theta) in enumerate(poses):
        bins.setdefault((int(x // 0.5), int(y // 0.5), int(np.degrees(theta % (2 * np.pi)) // 10) % 36), []).append(i)
    found, left = set(), set(bins)
    while left:
        heap, members = [left.pop()], []
        while heap:
            x, y, t = heap.pop()
            members += bins[x, y, t]
            for dx, dy, dt in product((-1, 0, 1), repeat=3):
                neighbour = (x + dx, y + dy, (t + dt) % 36)
                if neighbour in left:
                    left.remove(neighbour)
                    heap.append(neighbour)
        found.add(frozenset(members))
    return found


@pytest.mark.parametrize("spread", [0.3, 1.5, 4.0, 20.0])
def test_clusters_agree_with_a_slow_flood(spread):
    for seed in range(5):
        rng = np.random.default_rng(seed)
        poses = np.column_stack([rng.normal(0, spread, (300, 2)), rng.normal(3, spread / 2, 300)])
        labels = clusters(poses)
        assert {frozenset(np.flatnonzero(labels == label).tolist()) for label in set(labels.tolist())} == slow_clusters(poses)
        assert sorted(set(labels.tolist())) == list(range(labels.max() + 1))


def test_clusters_join_a_long_chain():
    chain = np.column_stack([np.arange(400) * 0.5 + 0.25, np.zeros(400), np.zeros(400)])
    assert set(clusters(chain).tolist()) == {0}


def test_estimate_pose_takes_the_heaviest_cluster_not_the_largest():
    poses = np.array([[0, 0, 0]] * 10 + [[8, 8, 1], [8.2, 8, 1]], dtype=float)
    particles = Particles(poses, np.log([0.02] * 10 + [0.6, 0.2]))
    assert estimate_pose(particles) == pytest.approx([8.05, 8, 1])
    assert estimate_pose(particles, replace(TUNED, estimate="mean")) == pytest.approx(
        [6.44, 6.4, np.arctan2(0.8 * np.sin(1), 0.2 + 0.8 * np.cos(1))]
    )
    assert estimate_pose(particles, replace(TUNED, estimate="best")) == pytest.approx([8, 8, 1])


def test_circular_mean_weighs():
    poses = np.array([[0.0, 0.0, 0.0], [4.0, 8.0, np.pi / 2]])
    assert circular_mean(poses, np.array([0.75, 0.25])) == pytest.approx([1, 2, np.arctan2(1, 3)])
