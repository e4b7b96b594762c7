"""Damage to walls: exact shares, a wall from wall to wall, the same for the same seed."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from priorlab.core.drawing import Walls
from priorlab.study.damaged_walls import poor, typical_thickness, with_extra_wall, without_parts


def two_rooms():
    """A box of 100 x 160 px with walls of 4 px and a wall between two rooms."""
    mask = np.zeros((120, 180), dtype=np.uint8)
    mask[10:110, 10:170] = 1
    mask[14:106, 14:88] = mask[14:106, 92:166] = 0
    return Walls(mask, 0.05, "two rooms")


@given(share=st.floats(0, 1), seed=st.integers(0, 1000))
def test_without_parts_loses_the_share_to_the_pixel(share, seed):
    walls = two_rooms()
    left = without_parts(walls, share, np.random.default_rng(seed))
    n = int(walls.labels.sum())
    assert int(left.mask.sum()) == n - round(share * n)
    assert not (left.mask & ~walls.mask).any()


def test_without_parts_takes_away_parts_not_single_pixels():
    walls = two_rooms()
    gone = walls.mask & ~without_parts(walls, 0.3, np.random.default_rng(1)).mask
    inside = gone[1:-1, 1:-1]
    neighbours = gone[:-2, 1:-1].astype(int) + gone[2:, 1:-1] + gone[1:-1, :-2] + gone[1:-1, 2:]
    assert neighbours[inside].mean() > 2.5


def test_without_parts_refuses_a_share_above_one():
    with pytest.raises(ValueError, match=r"share must lie in \[0, 1\], got 1.5"):
        without_parts(two_rooms(), 1.5, np.random.default_rng(0))


@pytest.mark.parametrize("seed", range(12))
def test_with_extra_wall_adds_one_strip_across_a_room(seed):
    walls = two_rooms()
    more = with_extra_wall(walls, np.random.default_rng(seed))
    added = more.mask & ~walls.mask
    rows, cols = np.flatnonzero(added.any(axis=1)), np.flatnonzero(added.any(axis=0))
    height, width = rows[-1] + 1 - rows[0], cols[-1] + 1 - cols[0]
    assert added.sum() == height * width, "a full rectangle"
    assert min(height, width) == 4 and max(height, width) in (92, 74), "as thick as the others, from wall to wall"
    assert (more.mask >= walls.mask).all()


def test_with_extra_wall_says_when_there_is_no_room():
    with pytest.raises(ValueError, match="walls must leave a room"):
        with_extra_wall(Walls(np.ones((20, 20), dtype=np.uint8)), np.random.default_rng(0))


def test_poor_lacks_moves_and_adds():
    walls = two_rooms()
    bad = poor(walls, np.random.default_rng(3))
    kept = (bad.mask & walls.mask).sum() / walls.mask.sum()
    stray = (bad.mask & ~walls.mask).sum() / walls.mask.sum()
    assert 0.2 < kept < 0.75
    assert stray > 0.1
    assert bad.shape == walls.shape and bad.metres_per_pixel == 0.05


@pytest.mark.parametrize("damage", [lambda w, r: without_parts(w, 0.4, r), poor, with_extra_wall])
def test_same_seed_same_damage_other_seed_other(damage):
    walls = two_rooms()
    one, same, other = (damage(walls, np.random.default_rng(seed)).mask for seed in (5, 5, 6))
    assert np.array_equal(one, same) and not np.array_equal(one, other)
    assert np.array_equal(walls.mask, two_rooms().mask), "what was given is left alone"


@pytest.mark.parametrize("thickness", [2, 3, 4, 5, 8])
def test_typical_thickness_of_a_strip(thickness):
    mask = np.zeros((40, 400), dtype=bool)
    mask[10 : 10 + thickness, 5:395] = True
    assert typical_thickness(mask) == thickness


@pytest.mark.parametrize("damage", [poor, with_extra_wall, lambda walls, rng: without_parts(walls, 0.3, rng)])
def test_damage_refuses_a_seed_in_place_of_a_generator(damage):
    with pytest.raises(ValueError, match="rng must be a numpy Generator.*got 0"):
        damage(two_rooms(), 0)
