"""A floor in metres, y up: what is painted lies on the cell that the grid names."""

from __future__ import annotations

import numpy as np
import pytest

from priorlab.core.grid import Grid
from priorlab.widgets.floor_canvas import HEAVY, LIGHT, FloorCanvas
from priorlab.widgets.plane import Plane

RED = (213, 94, 0)


@pytest.fixture
def grid():
    return Grid((40, 60), 2, metres_per_pixel=0.05)  # 20 x 30 cells of 10 cm


@pytest.fixture
def floor(grid):
    return FloorCanvas(grid, np.full(grid.shape, 255, np.uint8), zoom=3)


def cells_of(picture, colour, zoom):
    """Cells whose middle screen pixel has a colour."""
    return np.argwhere((picture[zoom // 2 :: zoom, zoom // 2 :: zoom] == colour).all(axis=-1)).tolist()


@pytest.mark.parametrize("xy", [(0.05, 0.05), (2.95, 1.95), (1.23, 0.77)])
def test_floor_canvas_particle_lies_on_its_cell(floor, grid, xy):
    floor.particles(np.array([[*xy, 0.0]]))
    assert cells_of(floor.picture, LIGHT, 3) == [grid.xy_to_cell(grid.metres_to_xy(xy)).tolist()]


def test_floor_canvas_heavy_particles_are_redder_and_on_top(floor):
    poses = np.array([[1.05, 1.05, 0.0], [1.05, 1.05, 0.0], [2.05, 1.05, 0.0]])
    floor.particles(poses, [0.7, 0.1, 0.2])
    assert cells_of(floor.picture, HEAVY, 3) == [[9, 10]]
    assert len(np.unique(floor.picture.reshape(-1, 3), axis=0)) == 3  # paper, heavy, nearly light


def test_floor_canvas_equal_weights_are_all_light(floor):
    floor.particles(np.array([[1.05, 1.05, 0.0], [2.05, 1.05, 0.0]]), [0.5, 0.5 * (1 + 1e-12)])
    assert len(cells_of(floor.picture, LIGHT, 3)) == 2


def test_floor_canvas_stroke_points_up_for_a_robot_that_looks_north(floor):
    floor.particles(np.array([[1.05, 1.05, np.pi / 2]]), stroke_m=0.3)
    painted = np.argwhere((floor.picture != 255).any(axis=-1))
    assert painted[:, 0].min() < 3 * 9 - 6 and painted[:, 0].max() <= 3 * 9 + 2  # rows count down


def test_floor_canvas_window_is_centred_and_white_beyond_the_rim(grid):
    near = FloorCanvas(grid, np.zeros(grid.shape, np.uint8), 1, centre_m=(0.05, 0.05), half_m=0.5)
    assert near.picture.shape == (10, 10, 3)
    assert (near.picture[:5, 5:] == 0).all() and (near.picture[7:] == 255).all() and (near.picture[:, :4] == 255).all()


def test_floor_canvas_colours_stand_where_the_grey_stood(grid):
    values = np.zeros(grid.shape)
    values[19, 0] = 1.0
    near = FloorCanvas(grid, np.zeros(grid.shape, np.uint8), 1, centre_m=(0.05, 0.05), half_m=0.5)
    near.colour(values, lambda cells: np.repeat((200 * cells).astype(np.uint8)[..., None], 3, axis=2))
    assert np.argwhere(near.picture[..., 0] == 200).tolist() == [[5, 5]]
    assert (near.picture[7:] == 255).all()


def test_floor_canvas_beams_end_where_they_end(floor, grid):
    floor.beams([1.0, 1.0, np.pi / 2], np.array([[0.55, 0.0]]), RED)
    assert grid.xy_to_cell(grid.metres_to_xy([1.0, 1.55])).tolist() in cells_of(floor.picture, RED, 3)


def test_floor_canvas_what_lies_outside_is_left_out(floor):
    before = floor.picture.copy()
    floor.particles(np.array([[-5.0, 1.0, 0.0], [1.0, 99.0, 0.0]]))
    assert (floor.picture == before).all()


def test_plane_strokes_are_one_path_from_point_to_point():
    plane = Plane((0.0, 10.0), (0.0, 10.0), ("x", "y"), "title", (200, 200), 20, (0, 10), (0, 10))
    plane.strokes([[0, 0], [5, 5]], [[10, 0], [5, 10]], "stroke='#000'")
    x0, x5, x10, y0, y5, y10 = (f"{at:.1f}" for at in (52, 116, 180, 160, 92, 24))
    assert f"<path d='M{x0} {y0}L{x10} {y0}M{x5} {y5}L{x5} {y10}'" in plane.svg()
