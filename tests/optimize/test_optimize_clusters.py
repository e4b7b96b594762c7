"""k-means on fronts whose groups are known because they were put there."""

import numpy as np
import pytest

from priorlab.optimize.clusters import SHORTLIST, cluster
from priorlab.optimize.front import Front


def front_of(priors) -> Front:
    priors = np.asarray(priors, dtype=float).reshape(-1, 2)
    objectives = np.linspace(0.9, 0.5, len(priors))
    return Front(priors[:, 0], priors[:, 1], objectives, objectives[::-1])


THREE = front_of([(0.9, 0.7), (0.95, 0.75), (1.0, 0.8), (0.19, 0.9), (0.21, 0.95), (0.15, 0.4), (0.17, 0.5), (0.13, 0.45)])


def test_cluster_finds_the_groups_and_orders_them_by_their_centres():
    groups = cluster(THREE, rng=np.random.default_rng(0))
    np.testing.assert_allclose(groups.centres, [[0.15, 0.45], [0.2, 0.925], [0.95, 0.75]])
    assert groups.labels.tolist() == [2, 2, 2, 1, 1, 0, 0, 0]
    assert repr(groups) == "Clusters(3 at (0.15, 0.45); 2 at (0.20, 0.93); 3 at (0.95, 0.75))" or "2 at (0.20, 0.92)" in repr(
        groups
    )
    low = groups.ranges[0]
    assert (low.p_wall.low, low.p_wall.high, low.p_space.low, low.p_space.high) == (0.13, 0.17, 0.4, 0.5)


def test_cluster_minimizes_the_distance_to_the_centres():
    rng = np.random.default_rng(4)
    priors = rng.uniform(0.1, 1, (40, 2))
    groups = cluster(front_of(priors), 4, rng=rng)
    distance = np.linalg.norm(priors[:, None] - groups.centres, axis=2)
    np.testing.assert_array_equal(distance.argmin(axis=1), groups.labels)  # eq. 4.24
    for i in range(4):
        np.testing.assert_allclose(priors[groups.labels == i].mean(axis=0), groups.centres[i])  # eq. 4.25
    assert (np.diff(groups.centres[:, 0]) > 0).all()


def test_cluster_takes_several_fronts_as_one_data_set():
    groups = cluster([front_of(THREE.priors[:5]), front_of([]), front_of(THREE.priors[5:])], rng=np.random.default_rng(0))
    assert groups.labels.tolist() == [2, 2, 2, 1, 1, 0, 0, 0]
    assert groups.fronts.tolist() == [0] * 5 + [2] * 3


def test_cluster_repeats_itself_with_one_seed():
    priors = np.random.default_rng(1).uniform(0.1, 1, (60, 2))
    first, second = (cluster(front_of(priors), rng=np.random.default_rng(9)) for _ in range(2))
    np.testing.assert_array_equal(first.labels, second.labels)
    np.testing.assert_array_equal(first.centres, second.centres)


def test_cluster_of_fewer_priors_than_groups_says_so():
    groups = cluster(front_of([(0.3, 0.9), (0.2, 0.9), (0.2, 0.9)]), 3, rng=np.random.default_rng(0))
    np.testing.assert_allclose(groups.centres, [[0.2, 0.9], [0.3, 0.9]])
    assert groups.note == "n_clusters must not exceed the number of different priors, got 3 for 2: made 2"
    assert groups.note in repr(groups) and groups.note in groups._repr_html_()


def test_cluster_of_empty_fronts_is_empty_and_says_so():
    groups = cluster([front_of([]), front_of([])], rng=np.random.default_rng(0))
    assert len(groups) == 0 and groups.ranges == () and "got 3 for 0" in groups.note
    assert len(cluster([], rng=np.random.default_rng(0))) == 0
    with pytest.raises(ValueError, match="n_clusters must be a whole number of at least 1, got 0"):
        cluster(THREE, 0, rng=np.random.default_rng(0))


def test_clusters_shortlist_is_as_printed_and_its_second_line_lies_in_no_cluster():
    first, second = SHORTLIST
    assert (first.p_wall.low, first.p_wall.high, first.p_space.low, first.p_space.high) == (0.2, 0.2, 0.6, 1.0)
    assert (second.p_wall.low, second.p_wall.high, second.p_space.low, second.p_space.high) == (0.4, 0.5, 0.7, 0.8)
    printed = cluster(  # the corners of the three clusters that the thesis prints
        front_of([(0.1, 0.2), (0.3, 0.6), (0.5, 0.48), (1, 1), (0.18, 0.58), (0.21, 1)]), 6, rng=np.random.default_rng(0)
    )
    groups = type(printed)(
        printed.priors, np.array([0, 0, 1, 1, 2, 2]), np.array([[0.2, 0.4], [0.75, 0.74], [0.2, 0.79]]), printed.fronts
    )
    assert groups.shortlist == ((first, (2,)), (second, ()))
    assert "Shortlist as printed (eq. 4.28)" in groups._repr_html_()
