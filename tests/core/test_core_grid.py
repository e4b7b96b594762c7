"""The frame: every conversion and its way back, and images to cells against loops over pixels."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from priorlab.core.grid import Grid

sizes = st.one_of(st.integers(1, 5), st.floats(0.3, 5.0).map(lambda s: round(s, 3)))


@st.composite
def grids(draw, metres=False):
    height, width = draw(st.integers(5, 40)), draw(st.integers(5, 40))
    scale = draw(st.floats(0.005, 0.5)) if metres else None
    return Grid((height, width), draw(sizes), scale)


@st.composite
def grids_with_points(draw, metres=False):
    grid = draw(grids(metres))
    height, width = grid.image_shape
    shares = draw(hnp.arrays(float, (7, 2), elements=st.floats(0, 1, exclude_max=True)))
    return grid, shares * [width, height]


def cell_by_hand(grid, row, col):
    """The cell of a pixel's centre, counted from the lower left corner of the drawing."""
    up, right = (grid.image_shape[0] - row - 0.5) / grid.cell_size, (col + 0.5) / grid.cell_size
    return grid.shape[0] - 1 - math.floor(up), math.floor(right)


# --- the frame -------------------------------------------------------------------------------------------------------


def test_pixel_to_xy_has_its_origin_in_the_lower_left_corner():
    grid = Grid((4, 10))
    assert grid.pixel_to_xy([[3, 0], [0, 9]]).tolist() == [[0.5, 0.5], [9.5, 3.5]]


@given(grids(), st.data())
def test_pixel_to_xy_comes_back(grid, data):
    height, width = grid.image_shape
    pixel = data.draw(st.tuples(st.integers(0, height - 1), st.integers(0, width - 1)))
    xy = grid.pixel_to_xy(pixel)
    assert tuple(grid.xy_to_pixel(xy)) == pixel
    assert grid.contains(xy)


@given(grids(), st.data())
def test_cell_to_xy_comes_back(grid, data):
    rows, cols = grid.shape
    cell = data.draw(st.tuples(st.integers(0, rows - 1), st.integers(0, cols - 1)))
    assert tuple(grid.xy_to_cell(grid.cell_to_xy(cell))) == cell


@given(grids_with_points())
def test_xy_to_cell_lies_within_half_a_cell_of_its_centre(case):
    grid, points = case
    off = np.abs(grid.cell_to_xy(grid.xy_to_cell(points)) - points)
    assert (off <= grid.cell_size / 2 + 1e-9).all()


@given(grids_with_points())
def test_xy_to_cell_stays_on_the_grid(case):
    grid, points = case
    cells = grid.xy_to_cell(points)
    assert (cells >= 0).all() and (cells < grid.shape).all()


@given(grids_with_points(metres=True))
def test_metres_come_back_and_poses_keep_their_heading(case):
    grid, points = case
    poses = np.column_stack([points, np.linspace(-3, 3, len(points))])
    back = grid.metres_to_xy(grid.xy_to_metres(poses))
    np.testing.assert_allclose(back, poses, atol=1e-9)
    assert (grid.xy_to_metres(poses)[:, 2] == poses[:, 2]).all()


def test_xy_to_metres_multiplies_by_the_scale():
    assert Grid((10, 10), 1, 0.25).xy_to_metres([[4.0, 8.0]]).tolist() == [[1.0, 2.0]]


@given(grids_with_points(metres=True))
def test_metres_to_cells_rounds_to_the_cell_that_holds_the_point(case):
    grid, points = case
    matrix = grid.metres_to_cells
    col, row = matrix @ np.vstack([grid.xy_to_metres(points).T, np.ones(len(points))])
    inside = grid.cell_to_xy(grid.xy_to_cell(points))
    away_from_border = (np.abs(inside - points) < grid.cell_size * (0.5 - 1e-6)).all(axis=1)
    found = np.column_stack([np.rint(row), np.rint(col)])[away_from_border]
    assert (found == grid.xy_to_cell(points)[away_from_border]).all()


@given(grids_with_points(metres=True))
def test_to_ros_puts_a_cell_where_ros_looks_for_it(case):
    """ROS: cell (i, j) of the data covers [i r, (i + 1) r) in y and [j r, (j + 1) r) in x, row 0 at the bottom."""
    grid, points = case
    cells = np.arange(grid.shape[0] * grid.shape[1]).reshape(grid.shape)
    ros = grid.to_ros(cells)
    for (x, y), cell in zip(points, grid.xy_to_cell(points), strict=True):
        assert ros[math.floor(y / grid.cell_size), math.floor(x / grid.cell_size)] == cells[tuple(cell)]
    assert (grid.to_ros(ros) == cells).all()


@given(grids())
def test_shape_covers_the_drawing_and_no_more(grid):
    for cells, side in zip(grid.shape, grid.image_shape, strict=True):
        assert cells * grid.cell_size >= side - 1e-6
        assert (cells - 1) * grid.cell_size < side


def test_rim_cells_stick_out_at_the_top_and_at_the_right():
    grid = Grid((5, 7), 3)
    assert grid.shape == (2, 3)
    assert grid.row_of_pixel.tolist() == [0, 0, 1, 1, 1]
    assert grid.col_of_pixel.tolist() == [0, 0, 0, 1, 1, 1, 2]


def test_contains_is_half_open_and_false_for_nan():
    grid = Grid((2, 3))
    inside = grid.contains([[0, 0], [2.999, 1.999], [3, 1], [1, 2], [-1e-9, 1], [np.nan, 1]])
    assert inside.tolist() == [True, True, False, False, False, False]


# --- images and cells ------------------------------------------------------------------------------------------------


@given(grids())
def test_row_and_col_of_pixel_agree_with_the_frame(grid):
    height, width = grid.image_shape
    pixels = np.moveaxis(np.indices((height, width)), 0, -1)
    cells = grid.xy_to_cell(grid.pixel_to_xy(pixels))
    assert (cells[..., 0] == grid.row_of_pixel[:, None]).all()
    assert (cells[..., 1] == grid.col_of_pixel).all()


@given(grids(), st.integers(0, 2**32 - 1), st.booleans())
def test_sum_in_cells_equals_a_loop(grid, seed, booleans):
    rng = np.random.default_rng(seed)
    image = rng.integers(0, 2, grid.image_shape).astype(bool) if booleans else rng.integers(-9, 9, grid.image_shape)
    expected = np.zeros(grid.shape, dtype=int)
    for row in range(image.shape[0]):
        for col in range(image.shape[1]):
            expected[cell_by_hand(grid, row, col)] += int(image[row, col])
    assert (grid.sum_in_cells(image) == expected).all()


@given(grids(), st.integers(0, 2**32 - 1))
def test_any_in_cells_equals_a_loop(grid, seed):
    mask = np.random.default_rng(seed).random(grid.image_shape) < 0.1
    expected = np.zeros(grid.shape, dtype=bool)
    for row, col in np.argwhere(mask):
        expected[cell_by_hand(grid, row, col)] = True
    found = grid.any_in_cells(mask)
    assert (found >= expected).all()
    if grid.cell_size >= 2:
        assert (found == expected).all()


def test_any_in_cells_below_a_pixel_takes_the_pixel_round_the_centre():
    mask = np.array([[False, True], [False, False]])
    assert Grid((2, 2), 0.5).any_in_cells(mask).tolist() == np.kron(mask, np.ones((2, 2), bool)).tolist()


@given(grids(), st.integers(0, 2**32 - 1))
def test_to_image_equals_a_loop(grid, seed):
    cells = np.random.default_rng(seed).random(grid.shape)
    image = grid.to_image(cells)
    assert image.shape == grid.image_shape
    for row in range(image.shape[0]):
        for col in range(image.shape[1]):
            assert image[row, col] == cells[cell_by_hand(grid, row, col)]


# --- what cannot be ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: Grid((0, 5)), "image_shape must be at least 1 x 1 pixels, got 0 x 5"),
        (lambda: Grid((4, 6), 5), "cell_size must not exceed the drawing's 6 x 4 pixels, got 5"),
        (lambda: Grid((4, 6), 0), "cell_size must be a finite number above 0, got 0"),
        (lambda: Grid((4, 6), float("nan")), "cell_size must be a finite number above 0, got nan"),
        (lambda: Grid((4, 6), 1, -0.1), "metres_per_pixel must be a finite number above 0, got -0.1"),
        (lambda: Grid((4, 6)).scale, "metres_per_pixel must be known"),
        (lambda: Grid((4, 6)).sum_in_cells(np.zeros((6, 4))), r"the image must have the grid's shape \(4, 6\), got \(6, 4\)"),
        (lambda: Grid((4, 6), 2).to_image(np.zeros((3, 2))), r"the cells must have the grid's shape \(2, 3\), got \(3, 2\)"),
    ],
)
def test_grid_says_what_is_wrong(make, sentence):
    with pytest.raises(ValueError, match=sentence):
        make()
