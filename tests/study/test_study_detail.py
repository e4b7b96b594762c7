"""A piece cut out of a plan, with its truth."""

import numpy as np
import pytest

import priorlab as pl
from priorlab.study.detail import cut_detail


@pytest.fixture(scope="module")
def plan():
    return pl.load_floor_plan("flat_north")


def test_cut_detail_pixels_and_truth_are_those_of_the_plan(plan):
    detail = cut_detail(plan, 45, 120, 290, 280)
    here = np.s_[120:400, 45:335]
    assert np.array_equal(detail.drawing.grey, plan.drawing.grey[here])
    assert np.array_equal(detail.truth.walls, plan.truth.walls[here])
    assert np.array_equal(detail.truth.ignore, plan.truth.ignore[here])
    assert detail.drawing.shape == (280, 290) and detail.drawing.metres_per_pixel == plan.drawing.metres_per_pixel


def test_cut_detail_keeps_the_doors_that_lie_wholly_inside(plan):
    detail = cut_detail(plan, 45, 120, 290, 290)
    back = [door.points + [45, 120] for door in detail.truth.doors]
    inside = [d.points for d in plan.truth.doors if ((d.points >= [45, 120]) & (d.points < [335, 410])).all()]
    assert len(back) == len(inside) == 6
    assert all(np.allclose(one, other) for one, other in zip(back, inside, strict=True))


@pytest.mark.parametrize("box", [(-1, 0, 10, 10), (0, 0, 0, 5), (530, 0, 10, 10), (0, 480, 5, 9)])
def test_cut_detail_outside_is_told(plan, box):
    with pytest.raises(ValueError, match="the detail must lie on the drawing of 536 x 488 px, got left"):
        cut_detail(plan, *box)


def test_cut_detail_tiles_make_the_whole_again(plan):
    halves = [cut_detail(plan, left, 0, 268, 488).drawing.grey for left in (0, 268)]
    assert np.array_equal(np.hstack(halves), plan.drawing.grey)
