"""The depth camera of thesis 5.3 as a record: a Kinect, its pinhole geometry and the strip that becomes a 2-D scan.

A depth camera does not measure how far a point is. It measures the point's DEPTH: its distance along the optical axis,
the same for a whole wall that stands square to the camera. The distance that a map needs is

    range = depth / cos(bearing),

at 29 degrees, the edge of the image, 14 % more.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import as_float, check_positive, check_whole
from priorlab.core.sensor import RangeSensor


@dataclass(frozen=True)
class DepthCamera:
    """A depth camera that looks straight ahead; the defaults are the Kinect of thesis 5.3.

    Parameters
    ----------
    rows, columns : size of a depth image
    field_of_view : FULL horizontal angle, radians
    min_depth_m, max_depth_m : nearer than the one is the blind zone, farther than the other nothing is measured
    height_m : of the lens above the floor
    strip_rows : rows that are averaged to one range a column
    strip_row : the first of them; by default the strip lies round the middle of the image, where the horizon is

    >>> camera = DepthCamera()
    >>> round(camera.focal_length, 1)                    # pixels: half the width / tan(half the angle)
    577.3
    >>> [round(math.degrees(b), 1) for b in camera.bearings[[0, 319, 639]].tolist()]      # left is positive
    [29.0, 0.0, -29.0]
    """

    rows: int = 480
    columns: int = 640
    field_of_view: float = math.radians(58.0)
    min_depth_m: float = 0.4
    max_depth_m: float = 3.0
    height_m: float = 0.3
    strip_rows: int = 20
    strip_row: int | None = None

    def __post_init__(self) -> None:
        for name in ("rows", "columns", "strip_rows"):
            object.__setattr__(self, name, check_whole(name, getattr(self, name)))
        for name in ("max_depth_m", "height_m"):
            check_positive(name, getattr(self, name))
        if not 0 < as_float("field_of_view", self.field_of_view) < math.pi:
            raise ValueError(f"field_of_view must lie strictly between 0 and pi radians, got {self.field_of_view:g}")
        if not 0 <= as_float("min_depth_m", self.min_depth_m) < self.max_depth_m:
            raise ValueError(f"min_depth_m must lie in [0, max_depth_m), got {self.min_depth_m:g}")
        row = max(0, (self.rows - self.strip_rows) // 2) if self.strip_row is None else self.strip_row
        object.__setattr__(self, "strip_row", check_whole("strip_row", row, least=-self.rows))
        if not 0 <= self.first_strip_row <= self.rows - self.strip_rows:
            raise ValueError(
                f"the strip must lie in the image's rows 0 to {self.rows - 1}, got rows {self.strip_row} to "
                f"{self.first_strip_row + self.strip_rows - 1}"
            )

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns of an image."""
        return self.rows, self.columns

    @property
    def focal_length(self) -> float:
        """Pixels; one number for rows and columns: the pixels are square."""
        return self.columns / 2 / math.tan(self.field_of_view / 2)

    @property
    def right_of_axis(self) -> NDArray[np.float64]:
        """(columns,) how far each column's centre lies right of the optical axis at a depth of 1."""
        return (np.arange(self.columns, dtype=np.float64) + 0.5 - self.columns / 2) / self.focal_length

    @property
    def below_axis(self) -> NDArray[np.float64]:
        """(rows,) how far each row's centre lies below the optical axis at a depth of 1."""
        return (np.arange(self.rows, dtype=np.float64) + 0.5 - self.rows / 2) / self.focal_length

    @property
    def bearings(self) -> NDArray[np.float64]:
        """(columns,) angle of each column to the optical axis, radians, counter-clockwise: from the left edge to the right."""
        return -np.arctan(self.right_of_axis)

    @property
    def first_strip_row(self) -> int:
        """The first row of the strip."""
        return int(self.strip_row or 0)

    @property
    def strip(self) -> slice:
        """The strip's rows."""
        return slice(self.first_strip_row, self.first_strip_row + self.strip_rows)

    def range_sensor(
        self, metres_per_pixel: float, wall_thickness: float = 4.0, p_free: float = 0.9, p_occupied: float = 0.1
    ) -> RangeSensor:
        """The cone of chapter 4 that this camera looks through, in a map's pixels.

        Parameters
        ----------
        metres_per_pixel : scale of the map
        wall_thickness : pixels; how far behind a hit eq. 5.6 still speaks
        p_free, p_occupied : inverse sensor model, eq. 5.6; the thesis also tries 0.8 and 0.2

        >>> DepthCamera().range_sensor(metres_per_pixel=0.05).max_range
        60.0
        """
        scale = check_positive("metres_per_pixel", metres_per_pixel)
        return RangeSensor(
            max_range=round(self.max_depth_m / scale, 9),
            half_angle=self.field_of_view / 2,
            p_free=p_free,
            p_occupied=p_occupied,
            wall_thickness=wall_thickness,
        )
