"""Priors without an extraction, pixel by pixel."""

import numpy as np
import pytest

from priorlab.core.drawing import Drawing
from priorlab.core.grid import Grid
from priorlab.core.grid_map import Prior
from priorlab.core.sensor import RangeSensor
from priorlab.mapping.other_priors import (
    CLUTTERED,
    EMPTY,
    constant_prior,
    dark_pixels,
    drawing_as_it_is,
    non_white,
    non_white_pixels,
)
from priorlab.mapping.update import update_map

GREYS = Drawing(np.array([[0, 127, 128, 254, 255, 255]] * 2, dtype=np.uint8), metres_per_pixel=0.1, name="strip")


def test_constant_prior_is_the_same_everywhere_and_has_no_factor():
    for p in (CLUTTERED, EMPTY, 0.05):
        prior_map = constant_prior(p, Grid((4, 6), 2))
        assert prior_map.log_odds.shape == (2, 3)
        np.testing.assert_allclose(prior_map.p_empty, p, atol=1e-12)
        assert prior_map.prior.effective_p_wall == prior_map.prior.effective_p_space == p


def test_constant_prior_is_updated_like_any_other(strip):
    """Seen free twice: 0.8 comes off once more than it was there, logit 2 x 2.197 - 1.386."""
    after = update_map(constant_prior(0.8, Grid((1, 2))), strip(0.9, [0, 2], RangeSensor()))
    odds = (0.9 / 0.1) ** 2 / (0.8 / 0.2)
    np.testing.assert_allclose(after.p_empty, [[0.8, odds / (1 + odds)]])


def test_drawing_as_it_is_takes_dark_pixels_and_non_white_all_ink():
    low, high = 0.18, 0.81
    np.testing.assert_allclose(drawing_as_it_is(GREYS).p_empty, [[low, low, high, high, high, high]] * 2)
    np.testing.assert_allclose(non_white(GREYS).p_empty, [[low, low, low, low, high, high]] * 2)
    np.testing.assert_allclose(drawing_as_it_is(GREYS, Prior(0.3, 0.8), cell_size=2).p_empty, [[0.27, 0.72, 0.72]])
    assert non_white(GREYS, cell_size_m=0.2).grid.cell_size == 2


def test_non_white_sees_pale_colours_that_are_as_bright_as_paper():
    yellow = np.full((1, 2, 3), 255, dtype=np.uint8)
    yellow[0, 1] = 255, 255, 60
    drawing = Drawing(np.array([[255, 255]], dtype=np.uint8), yellow)
    assert non_white_pixels(drawing).mask.tolist() == [[False, True]]
    assert dark_pixels(drawing).mask.tolist() == [[False, False]]


def test_binarizations_know_their_drawing_and_their_limits():
    assert dark_pixels(GREYS).name == "strip, as it is" and non_white_pixels(GREYS).metres_per_pixel == 0.1
    assert dark_pixels(GREYS, 0).mask.sum() == 2 and non_white_pixels(GREYS, 128).mask.sum() == 4
    for call, sentence in (
        (lambda: dark_pixels(GREYS, 255), "dark must lie between 0 and 254, got 255"),
        (lambda: non_white_pixels(GREYS, 0), "white must lie between 1 and 255, got 0"),
        (lambda: constant_prior(1.0, Grid((1, 1))), "must lie strictly between 0 and 1, got 1"),
    ):
        with pytest.raises(ValueError, match=sentence):
            call()
