"""Rows of folds, against a loop over all pairs of them."""

import itertools

import numpy as np
import pytest

from priorlab.drawing.folding import ALIKE, OFF, _rows


def _folds(seed: int, n: int) -> np.ndarray:
    """(2 n, 3, 2) tip, start and end of folds that point down; every second one goes on, more or less, where another ends."""
    rng = np.random.default_rng(seed)
    start, long, high = rng.uniform(0, 120, (n, 2)), rng.uniform(10, 20, n), rng.uniform(6, 12, n)
    start = np.vstack([start, start + np.column_stack([long, np.zeros(n)]) + rng.normal(0, 3, (n, 2))])
    long, high = np.tile(long, 2), np.tile(high, 2)
    away = np.column_stack([long, np.zeros(2 * n)])
    return np.stack([start + away / 2 + np.column_stack([np.zeros(2 * n), high]), start, start + away], axis=1)


def _alike(a: float, b: float) -> bool:
    return min(a, b) >= ALIKE * max(a, b)


@pytest.mark.parametrize("seed", range(5))
def test_rows_are_those_of_all_pairs(seed):
    folds = _folds(seed, 20)
    expected = []
    for (tip, start, end), (top, begin, finish) in itertools.permutations(folds.tolist(), 2):
        long, also_long = end[0] - start[0], finish[0] - begin[0]
        if not (_alike(long, also_long) and _alike(tip[1] - start[1], top[1] - begin[1])):
            continue
        if np.hypot(begin[0] - end[0], begin[1] - end[1]) <= OFF * long:
            expected.append((*tip, *start, *finish))
        if np.hypot(begin[0] - end[0], begin[1] - end[1]) <= OFF * also_long:
            expected.append((*top, *finish, *start))  # the same row from its other end
    found = [(*tip, *start, *end) for tip, start, end in _rows(folds)]
    assert len(expected) >= 20
    assert sorted(found) == sorted(expected)
