"""A walk with what it saw at every pixel, against the walk itself."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from priorlab.drawing.connectivity import walk
from priorlab.drawing.walk_steps import walk_steps


@given(st.integers(0, 2**32 - 1), st.tuples(*[st.integers(0, 14)] * 4))
def test_walk_steps_follow_the_walk_and_choose_the_nearest_dark(seed, ends):
    ink = np.random.default_rng(seed).random((15, 15)) < 0.6
    origin, goal = ends[:2], ends[2:]
    if origin == goal:
        return
    way, steps = walk_steps(ink, origin, goal, reach=1)
    assert way == walk(ink, origin, goal, reach=1)
    assert tuple(step.at for step in steps) == way.path
    for step in steps[:-1]:
        dark = [d for d, is_dark in zip(step.distances, step.dark, strict=True) if is_dark]
        assert step.distances[step.neighbours.index(step.chosen)] == min(dark)
        assert step.n_dark == sum(bool(ink[y, x]) for x, y in step.neighbours if 0 <= x < 15 and 0 <= y < 15)
    assert steps[-1].chosen is None


def test_walk_steps_hand_made():
    ink = np.zeros((5, 5), dtype=bool)
    ink[2, 0:3] = ink[1, 2] = True
    way, steps = walk_steps(ink, (0, 2), (4, 0), reach=0)
    assert [step.at for step in steps] == [(0, 2), (1, 2), (2, 1)]
    assert steps[1].neighbours == ((2, 2), (1, 1), (2, 1)) and steps[1].dark == (True, False, True)
    assert np.allclose(steps[1].distances, [np.sqrt(8), np.sqrt(10), np.sqrt(5)]) and not way.reached
