"""THE place that converts between pixels, cells, metres and ROS.

One world frame: x right, y UP, origin in the lower left corner of the drawing, a pixel's centre at +0.5.
Images and cell arrays keep row 0 at the TOP, as pictures have it; cells are counted from the lower left corner,
so that the origin of a ROS map is the origin of the drawing. Cells at the upper and right rim may stick out.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.checks import as_numbers, check_positive

MAX_CELLS = 200_000_000
"""More cells than the largest image has pixels fit into no memory."""


@dataclass(frozen=True)
class Grid:
    """The cells that cover a drawing.

    Parameters
    ----------
    image_shape : (height, width) of the drawing, pixels
    cell_size : side of a square cell, pixels; need not be whole
    metres_per_pixel : scale of the drawing, or None when it is not known

    >>> grid = Grid(image_shape=(6, 9), cell_size=3, metres_per_pixel=0.05)
    >>> grid.shape
    (2, 3)
    >>> grid.pixel_to_xy([[5, 0]]).tolist()              # the lower left pixel
    [[0.5, 0.5]]
    >>> grid.xy_to_cell([[0.5, 0.5]]).tolist()           # lies in the lower left cell
    [[1, 0]]
    """

    image_shape: tuple[int, int]
    cell_size: float = 1
    metres_per_pixel: float | None = None

    def __post_init__(self) -> None:
        sides = as_numbers("image_shape", self.image_shape)
        if sides.shape != (2,) or not np.isfinite(sides).all():
            raise ValueError(f"image_shape must be a height and a width in pixels, got {self.image_shape}")
        height, width = (int(side) for side in sides)
        if height < 1 or width < 1:
            raise ValueError(f"image_shape must be at least 1 x 1 pixels, got {height} x {width}")
        object.__setattr__(self, "image_shape", (height, width))
        size = check_positive("cell_size", self.cell_size)
        object.__setattr__(self, "cell_size", int(size) if size.is_integer() else size)
        if size > min(height, width):
            raise ValueError(f"cell_size must not exceed the drawing's {width} x {height} pixels, got {size:g}")
        n_cells = height * width / size**2
        if n_cells > MAX_CELLS:
            raise ValueError(f"cell_size must leave at most {MAX_CELLS:,} cells, got {size:g}: {n_cells:,.0f} cells")
        if self.metres_per_pixel is not None:
            object.__setattr__(self, "metres_per_pixel", check_positive("metres_per_pixel", self.metres_per_pixel))

    # --- sizes ---------------------------------------------------------------------------------------------------

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns of cells that cover the drawing."""
        rows, cols = (int(np.ceil(side / self.cell_size - 1e-9)) for side in self.image_shape)
        return rows, cols

    @property
    def scale(self) -> float:
        """Metres per pixel; a sentence when the drawing's scale is not known."""
        if self.metres_per_pixel is None:
            raise ValueError("metres_per_pixel must be known to speak of metres, got None: give the drawing its scale")
        return self.metres_per_pixel

    @property
    def cell_size_m(self) -> float:
        """Side of a cell, metres."""
        return self.cell_size * self.scale

    # --- pixels, cells, metres -----------------------------------------------------------------------------------

    def pixel_to_xy(self, pixels: ArrayLike) -> NDArray[np.float64]:
        """Centres of (..., 2) pixels (row, col) as x, y in the world, pixels."""
        row, col = np.moveaxis(np.asarray(pixels, dtype=np.float64), -1, 0)
        return np.stack([col + 0.5, self.image_shape[0] - row - 0.5], axis=-1)

    def xy_to_pixel(self, xy: ArrayLike) -> NDArray[np.int64]:
        """The pixels (row, col) that hold (..., 2) points x, y; outside the drawing they lie outside the image."""
        x, y = np.moveaxis(np.asarray(xy, dtype=np.float64), -1, 0)
        rows = self.image_shape[0] - 1 - np.floor(y)
        return np.stack([rows, np.floor(x)], axis=-1).astype(np.int64)

    def xy_to_cell(self, xy: ArrayLike) -> NDArray[np.int64]:
        """The cells (row, col) that hold (..., 2) points x, y in pixels."""
        x, y = np.moveaxis(np.asarray(xy, dtype=np.float64), -1, 0)
        rows = self.shape[0] - 1 - np.floor(y / self.cell_size)
        return np.stack([rows, np.floor(x / self.cell_size)], axis=-1).astype(np.int64)

    def cell_to_xy(self, cells: ArrayLike) -> NDArray[np.float64]:
        """Centres of (..., 2) cells (row, col) as x, y in pixels."""
        row, col = np.moveaxis(np.asarray(cells, dtype=np.float64), -1, 0)
        return np.stack([col + 0.5, self.shape[0] - row - 0.5], axis=-1) * self.cell_size

    def xy_to_metres(self, xy: ArrayLike) -> NDArray[np.float64]:
        """x, y in pixels as x, y in metres; poses (..., 3) keep their heading."""
        return _scaled(xy, self.scale)

    def metres_to_xy(self, xy_m: ArrayLike) -> NDArray[np.float64]:
        """x, y in metres as x, y in pixels; poses (..., 3) keep their heading."""
        return _scaled(xy_m, 1.0 / self.scale)

    @property
    def metres_to_cells(self) -> NDArray[np.float64]:
        """(2, 3) matrix A with (col, row) = A (x, y, 1): metres to cells, whole numbers at the cells' centres, as cv2 has it.

        >>> Grid((6, 9), cell_size=3, metres_per_pixel=0.1).metres_to_cells.round(3).tolist()
        [[3.333, 0.0, -0.5], [0.0, -3.333, 1.5]]
        """
        per_metre = 1.0 / self.cell_size_m
        return np.array([[per_metre, 0.0, -0.5], [0.0, -per_metre, self.shape[0] - 0.5]])

    def contains(self, xy: ArrayLike) -> NDArray[np.bool_]:
        """True for (..., 2) points x, y (pixels) on the drawing."""
        x, y = np.moveaxis(np.asarray(xy, dtype=np.float64)[..., :2], -1, 0)
        height, width = self.image_shape
        return (x >= 0) & (x < width) & (y >= 0) & (y < height)

    def at_metres(self, cells: ArrayLike, xy_m: ArrayLike, outside: Any) -> NDArray:
        """(N,) values of a (rows, cols) array in the cells of (N, 2) points or (N, 3) poses, metres; `outside` off the drawing.

        >>> Grid((2, 3), metres_per_pixel=0.1).at_metres([[1, 2, 3], [4, 5, 6]], [[0.25, 0.15, 3.1], [0.1, -0.1, 0]], -1).tolist()
        [3, -1]
        """
        xy = self.metres_to_xy(np.asarray(xy_m, dtype=np.float64)[..., :2])
        inside = self.contains(xy)
        rows, cols = self.xy_to_cell(np.where(inside[..., None], xy, 0.0)).T
        return np.where(inside, np.asarray(cells)[rows, cols], outside)

    def to_ros(self, cells: ArrayLike) -> NDArray:
        """A cell array as ROS stores its data: row 0 at the BOTTOM. Its own inverse."""
        return np.asarray(cells)[::-1]

    # --- images and cells ----------------------------------------------------------------------------------------

    @property
    def row_of_pixel(self) -> NDArray[np.int64]:
        """(height,) cell row of every pixel row."""
        heights = self.image_shape[0] - np.arange(self.image_shape[0]) - 0.5
        return self.shape[0] - 1 - np.floor(heights / self.cell_size).astype(np.int64)

    @property
    def col_of_pixel(self) -> NDArray[np.int64]:
        """(width,) cell column of every pixel column."""
        return np.floor((np.arange(self.image_shape[1]) + 0.5) / self.cell_size).astype(np.int64)

    def sum_in_cells(self, image: ArrayLike) -> NDArray[np.int64]:
        """How much of an image (booleans or integers) lies in each cell: (height, width) -> (rows, cols)."""
        image = np.asarray(image)
        if image.shape != self.image_shape:
            raise ValueError(f"the image must have the grid's shape {self.image_shape}, got {image.shape}")
        if self.cell_size == 1:
            return image.astype(np.int64)
        # a running sum, differenced at the cells' borders: two passes at any cell size, empty cells are 0
        rows = np.searchsorted(self.row_of_pixel, np.arange(self.shape[0] + 1))
        cols = np.searchsorted(self.col_of_pixel, np.arange(self.shape[1] + 1))
        if image.dtype == bool:  # a tenth of the time, which a slider feels; at most 200 million pixels fit int32
            total = cv2.integral(np.ascontiguousarray(image).view(np.uint8))
        else:
            total = np.zeros((image.shape[0] + 1, image.shape[1] + 1), dtype=np.int64)
            np.cumsum(image, axis=0, dtype=np.int64, out=total[1:, 1:])
            np.cumsum(total[1:, 1:], axis=1, out=total[1:, 1:])
        at_borders = total[np.ix_(rows, cols)].astype(np.int64)
        return at_borders[1:, 1:] - at_borders[:-1, 1:] - at_borders[1:, :-1] + at_borders[:-1, :-1]

    def any_in_cells(self, mask: ArrayLike) -> NDArray[np.bool_]:
        """True for a cell when any of its pixels is set, or the pixel that holds its centre (cells below a pixel)."""
        mask = np.asarray(mask, dtype=bool)
        if self.cell_size == 1 and mask.shape == self.image_shape:
            return mask.copy()  # a slider on 1 px cells feels the rest
        anywhere = self.sum_in_cells(mask) > 0
        if self.cell_size < 2:
            height, width = self.image_shape
            centres = self.cell_to_xy(np.moveaxis(np.indices(self.shape), 0, -1))
            row, col = np.moveaxis(self.xy_to_pixel(centres), -1, 0)
            anywhere |= mask[row.clip(0, height - 1), col.clip(0, width - 1)]
        return anywhere

    def to_image(self, cells: ArrayLike) -> NDArray:
        """Every pixel takes the value of the cell that holds its centre: (rows, cols) -> (height, width)."""
        cells = np.asarray(cells)
        if cells.shape != self.shape:
            raise ValueError(f"the cells must have the grid's shape {self.shape}, got {cells.shape}")
        if self.cell_size == 1:
            return cells
        return cells.take(self.col_of_pixel, axis=1).take(self.row_of_pixel, axis=0)


def _scaled(points: ArrayLike, factor: float) -> NDArray[np.float64]:
    """Points (..., 2) or poses (..., 3) with x and y multiplied, the heading kept."""
    points = np.array(points, dtype=np.float64)
    points[..., :2] *= factor
    return points
