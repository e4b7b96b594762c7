"""A floor to paint on in metres, y UP: particles coloured by their weight, a robot, the beams of a scan."""

from __future__ import annotations

from collections.abc import Callable

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.grid import Grid
from priorlab.widgets.canvas import Canvas, Colour

LIGHT, HEAVY = (86, 180, 233), (213, 94, 0)
"""The lightest and the heaviest particle."""

LEVELS = 8


class FloorCanvas(Canvas):
    """The cells of a map, each `zoom` screen pixels wide.

    Parameters
    ----------
    grid : of the map; it must know its scale
    grey : (rows, cols) uint8, one value per cell
    zoom, faint : as in `Canvas`
    centre_m, half_m : the window is a square of 2 `half_m` round `centre_m`, metres; all of the map by default

    >>> grid = Grid((20, 40), 1, metres_per_pixel=0.1)
    >>> floor = FloorCanvas(grid, np.full(grid.shape, 255, np.uint8))
    >>> floor.cells([[0.05, 0.05]]).round(6).tolist()                       # the lower left cell: column 0, row 19
    [[0.0, 19.0]]
    """

    def __init__(
        self,
        grid: Grid,
        grey: NDArray[np.uint8],
        zoom: int = 1,
        centre_m: ArrayLike | None = None,
        half_m: float = 2.5,
        faint: float = 0.0,
    ) -> None:
        self.grid, window = grid, None
        if centre_m is not None:
            (col, row), half = (
                np.floor(self.cells(np.array([centre_m]))[0]).astype(int).tolist(),
                round(half_m / grid.cell_size_m),
            )
            window = (col - half, row - half, 2 * half, 2 * half)
        super().__init__(grey, zoom, window, faint)

    def cells(self, xy_m: ArrayLike) -> NDArray[np.float64]:
        """(N, 2) column and row of points in metres; whole numbers are the centres of cells."""
        xy = np.asarray(xy_m, dtype=np.float64)[:, :2]
        return np.column_stack([xy, np.ones(len(xy))]) @ self.grid.metres_to_cells.T

    def colour(self, values: NDArray, scale: Callable[[NDArray], NDArray[np.uint8]]) -> None:
        """Show the (rows, cols) values of the map's cells in the colours that `scale` gives them, where it was grey."""
        (width, height), (n_rows, n_cols) = self.size, values.shape
        rows, cols = self.top + np.arange(height), self.left + np.arange(width)
        inside = ((rows >= 0) & (rows < n_rows))[:, None] & ((cols >= 0) & (cols < n_cols))
        colours = scale(values[rows.clip(0, n_rows - 1)[:, None], cols.clip(0, n_cols - 1)])
        colours[~inside] = 255
        self.picture = np.ascontiguousarray(colours.repeat(self.zoom, axis=0).repeat(self.zoom, axis=1))

    def particles(self, poses: NDArray[np.float64], weights: ArrayLike | None = None, stroke_m: float = 0.0) -> None:
        """Dots, and strokes where they look when `stroke_m` is not 0; the heavier the redder, the heaviest on top."""
        share = _shares(np.zeros(len(poses)) if weights is None else np.asarray(weights, dtype=np.float64))
        level = np.minimum((share * LEVELS).astype(int), LEVELS - 1)
        ends = poses[:, :2] + stroke_m * np.column_stack([np.cos(poses[:, 2]), np.sin(poses[:, 2])])
        starts, tips = self._at(self.cells(poses)), self._at(self.cells(ends))
        for number in np.unique(level).tolist():
            colour = _between(LIGHT, HEAVY, number / (LEVELS - 1))
            mine = level == number
            if stroke_m:
                cv2.polylines(self.picture, list(np.stack([starts[mine], tips[mine]], axis=1)), False, colour, 1, cv2.LINE_AA)
            self._dots(starts[mine], colour)

    def robot(self, pose: ArrayLike, colour: Colour, size_m: float = 0.22) -> None:
        """A triangle that points where the robot looks, with a white rim."""
        x, y, theta = np.asarray(pose, dtype=np.float64)
        turn = theta + np.array([0.0, 2.5, -2.5])
        corners = self._at(self.cells(np.array([x, y]) + size_m * np.column_stack([np.cos(turn), np.sin(turn)])))
        cv2.polylines(self.picture, [corners], True, (255, 255, 255), 3, cv2.LINE_AA)
        cv2.fillPoly(self.picture, [corners], colour, cv2.LINE_AA)

    def beams(self, pose: ArrayLike, points: NDArray[np.float64], colour: Colour, every: int = 4) -> None:
        """Beams from a pose to their ends, (B, 2) in the robot's frame; every so-manyth as a line, every end as a dot."""
        x, y, theta = np.asarray(pose, dtype=np.float64)
        cos, sin = np.cos(theta), np.sin(theta)
        ends = np.column_stack([x + points[:, 0] * cos - points[:, 1] * sin, y + points[:, 1] * cos + points[:, 0] * sin])
        at, eye = self._at(self.cells(ends)), self._at(self.cells([[x, y]]))
        rays = np.stack([np.broadcast_to(eye, at.shape), at], axis=1)[::every]
        cv2.polylines(self.picture, list(rays), False, colour, 1, cv2.LINE_AA)
        self._dots(at, colour, radius=2)

    def way(self, poses: ArrayLike, colour: Colour, width: int = 1) -> None:
        """A way, poses or points in metres."""
        self.line(self.cells(poses), colour, width)

    def _dots(self, at: NDArray[np.int32], colour: Colour, radius: int = 1) -> None:
        """Squares of 2 radius + 1 screen pixels, all at once."""
        height, width = self.picture.shape[:2]
        offsets = np.mgrid[-radius : radius + 1, -radius : radius + 1].reshape(2, -1).T
        x, y = (at[:, None] + offsets).reshape(-1, 2).T
        inside = (x >= 0) & (x < width) & (y >= 0) & (y < height)
        self.picture[y[inside], x[inside]] = colour


def _shares(weights: NDArray[np.float64]) -> NDArray[np.float64]:
    """0 for the lightest, 1 for the heaviest; all 0 when they weigh the same."""
    low, high = weights.min(), weights.max()
    return (weights - low) / (high - low) if high > low * (1 + 1e-6) else np.zeros(len(weights))


def _between(first: Colour, last: Colour, share: float) -> Colour:
    """A colour between two."""
    red, green, blue = (round((1 - share) * a + share * b) for a, b in zip(first, last, strict=True))
    return red, green, blue
