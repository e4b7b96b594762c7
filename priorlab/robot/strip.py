"""From depth images to 2-D ranges: the mean over a strip of rows, without its zeros (thesis 5.3)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.checks import check_poses, check_positive, check_record
from priorlab.core.readings import Readings
from priorlab.core.sensor import RangeSensor
from priorlab.robot.depth_camera import DepthCamera


class StripRanges(NamedTuple):
    """A 2-D scan: `ranges_m[k]` metres along `camera.bearings[k]`; where `valid[k]` is False nothing is known (inf)."""

    ranges_m: NDArray[np.float64]
    valid: NDArray[np.bool_]


def strip_ranges(image: ArrayLike, camera: DepthCamera | None = None) -> StripRanges:
    """Average the strip column by column, and turn depth along the axis into distance along the bearing.

    range = (mean of the column's depths that are not zero) / cos(bearing). A zero is no distance: the pixel was too near,
    too far or lost. A column of zeros gives no reading.

    Parameters
    ----------
    image : (rows, columns) whole millimetres, 0 = nothing measured, as the camera delivers it
    camera : says where the strip lies; `DepthCamera()` by default

    Returns
    -------
    ranges_m, valid : (columns,) each, from the left edge of the image to the right

    Raises
    ------
    ValueError
        When the image is not the camera's size, not whole millimetres, or metres were given for millimetres.

    >>> camera = DepthCamera(rows=2, columns=3, strip_rows=2)
    >>> ranges, valid = strip_ranges([[2000, 0, 0], [2000, 1000, 0]], camera)
    >>> ranges.round(3).tolist(), valid.tolist()          # 2 m / cos(20.3 degrees), the zero left out, no reading
    ([2.132, 1.0, inf], [True, True, False])
    """
    camera = DepthCamera() if camera is None else camera
    check_record("camera", camera, DepthCamera)
    return mean_ranges(check_depth_image(image, camera)[camera.strip], camera)


def mean_ranges(strip: NDArray, camera: DepthCamera) -> StripRanges:
    """The ranges of a strip that was cut out already, (strip rows, columns) millimetres."""
    measured = strip > 0
    count = measured.sum(axis=0)
    valid = count > 0
    depth_m = strip.sum(axis=0, dtype=np.int64) / np.maximum(count, 1) / 1000.0
    return StripRanges(np.where(valid, depth_m / np.cos(camera.bearings), np.inf), valid)


def readings_from_scans(
    scans: Sequence[StripRanges],
    poses: ArrayLike,
    camera: DepthCamera,
    image_shape: tuple[int, int],
    metres_per_pixel: float,
    sensor: RangeSensor | None = None,
) -> Readings:
    """Scans taken at known poses as the readings of chapter 4.

    Parameters
    ----------
    scans : N scans, metres, one for each pose: `[strip_ranges(image, camera) for image in images]`
    poses : (N, 3) x, y, theta of the camera; pixels of the map, y up
    camera : that took them
    image_shape : (height, width) of the drawing that the poses lie on, pixels
    metres_per_pixel : its scale
    sensor : inverse sensor model and reach in pixels; `camera.range_sensor(metres_per_pixel)` by default

    Returns
    -------
    Readings of N poses x `camera.columns` bearings, `valid` where the strip held a depth

    >>> camera = DepthCamera(rows=2, columns=3, strip_rows=2)
    >>> scan = strip_ranges([[0, 1000, 0], [0, 1000, 0]], camera)
    >>> readings_from_scans([scan], [[10.5, 5.5, 0.0]], camera, (11, 60), metres_per_pixel=0.05).ranges.tolist()
    [[inf, 20.0, inf]]
    """
    scale = check_positive("metres_per_pixel", metres_per_pixel)
    taken_at = check_poses("poses", poses)
    if len(scans) != len(taken_at):
        raise ValueError(f"scans and poses must be as many, got {len(scans)} and {len(taken_at)}")
    ranges = np.array([scan.ranges_m for scan in scans]).reshape(len(scans), camera.columns)
    valid = np.array([scan.valid for scan in scans], dtype=bool).reshape(ranges.shape)
    return Readings(taken_at, ranges / scale, camera.bearings, sensor or camera.range_sensor(scale), image_shape, valid)


def check_depth_image(image: ArrayLike, camera: DepthCamera) -> NDArray:
    """The image as an array of whole millimetres, or a sentence."""
    try:
        array = np.asarray(image)
    except ValueError:  # rows of different lengths
        raise ValueError(f"a depth image must have {camera.rows} x {camera.columns} pixels, got uneven rows") from None
    if array.shape != camera.shape:
        raise ValueError(f"a depth image must have {camera.rows} x {camera.columns} pixels, got shape {array.shape}")
    if array.dtype.kind not in "ui":
        raise ValueError(f"a depth image must hold whole millimetres, got {array.dtype}: multiply metres by 1000 and round")
    if array.min() < 0:
        raise ValueError(f"a depth image must hold millimetres of at least 0, got {array.min()}")
    if 0 < array.max() < 20:
        raise ValueError(f"a depth image must hold millimetres, got at most {array.max()}, which look like metres")
    return array
