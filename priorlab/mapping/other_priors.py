"""Priors to hold the extracted walls against: one number for everything, and the drawing without any extraction (thesis 2.3.5).

Two binarizations of the drawing: dark pixels count as wall ("as it is"), or every pixel that is not white.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import as_float, check_probability, check_record
from priorlab.core.drawing import Drawing, Walls
from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.log_odds import log_odds
from priorlab.mapping.prior import build_prior_map

CLUTTERED, EMPTY = 0.3, 0.8
"""P(empty) of every cell where much, or little, is expected to stand about (thesis 2.3.5)."""

DARK = 127
"""Grey values up to this are dark: the middle between ink and paper."""

WHITE = 255
"""The grey value of white paper; scans and JPEG seldom reach it."""


def constant_prior(p_empty: float, grid: Grid) -> GridMap:
    """One P(empty) for all cells: what is known without a plan is how cluttered a building is.

    Parameters
    ----------
    p_empty : in (0, 1); the thesis names 0.3 for a cluttered and 0.8 for an empty building. There is no factor: it belongs
        to priors made of a plan
    grid : the cells

    >>> constant_prior(0.8, Grid((2, 3))).p_empty.round(3).tolist()
    [[0.8, 0.8, 0.8], [0.8, 0.8, 0.8]]
    """
    check_record("grid", grid, Grid)
    prior = Prior(p_empty, p_empty, factor=1.0)
    return GridMap(np.full(grid.shape, log_odds(check_probability("p_empty", p_empty))), grid, prior)


def drawing_as_it_is(
    drawing: Drawing,
    prior: Prior | None = None,
    cell_size: float | None = None,
    cell_size_m: float | None = None,
    dark: int = DARK,
) -> GridMap:
    """The prior map of a drawing whose dark pixels are all taken for walls: text, furniture and doors too.

    Parameters
    ----------
    drawing : as it was read
    prior, cell_size, cell_size_m : as in `build_prior_map`
    dark : grey values up to this are dark, 0 to 254

    >>> paper = Drawing(np.array([[255, 200, 90, 255]], dtype=np.uint8))
    >>> drawing_as_it_is(paper).p_empty.round(2).tolist(), non_white(paper).p_empty.round(2).tolist()
    ([[0.81, 0.81, 0.18, 0.81]], [[0.81, 0.18, 0.18, 0.81]])
    """
    return build_prior_map(dark_pixels(drawing, dark), prior, cell_size, cell_size_m)


def non_white(
    drawing: Drawing,
    prior: Prior | None = None,
    cell_size: float | None = None,
    cell_size_m: float | None = None,
    white: int = WHITE,
) -> GridMap:
    """The prior map of a drawing of which every pixel that is not white is taken for wall: greys and stains too.

    Parameters
    ----------
    drawing : as it was read
    prior, cell_size, cell_size_m : as in `build_prior_map`
    white : values of grey, or of every colour, from this on are white, 1 to 255
    """
    return build_prior_map(non_white_pixels(drawing, white), prior, cell_size, cell_size_m)


def dark_pixels(drawing: Drawing, dark: int = DARK) -> Walls:
    """The dark pixels of a drawing as if they were its walls, for `build_prior_map` and `Experiment`."""
    check_record("drawing", drawing, Drawing)
    if not 0 <= as_float("dark", dark) <= 254:
        raise ValueError(f"dark must lie between 0 and 254, got {dark}")
    return _as_walls(drawing.grey <= dark, drawing, "as it is")


def non_white_pixels(drawing: Drawing, white: int = WHITE) -> Walls:
    """The pixels of a drawing that are not white as if they were its walls, for `build_prior_map` and `Experiment`."""
    check_record("drawing", drawing, Drawing)
    if not 1 <= as_float("white", white) <= 255:
        raise ValueError(f"white must lie between 1 and 255, got {white}")
    lowest = drawing.grey if drawing.colour is None else drawing.colour.min(axis=2)
    return _as_walls(lowest < white, drawing, "non-white")


def _as_walls(mask: NDArray[np.bool_], drawing: Drawing, how: str) -> Walls:
    """A mask with the drawing's scale and name."""
    return Walls(mask.astype(np.uint8), drawing.metres_per_pixel, f"{drawing.name}, {how}")
