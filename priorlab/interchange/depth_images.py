"""Depth images as files: 16-bit grey PNG or TIFF, whole millimetres, 0 = nothing measured, as ROS and OpenNI store them."""

from __future__ import annotations

import os
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.files import write_file
from priorlab.interchange.pixels import open_image

KINECT_SHAPE = (480, 640)

FARTHEST_IN_METRES = 20
"""No depth image in millimetres has its farthest pixel this near; one in metres has."""


def read_depth_image(path: str | os.PathLike[str], shape: tuple[int, int] = KINECT_SHAPE) -> NDArray[np.uint16]:
    """Read a depth image.

    Parameters
    ----------
    path : a 16-bit grey PNG or TIFF
    shape : (rows, columns) that the camera has

    Returns
    -------
    (rows, columns) millimetres along the optical axis; 0 where nothing was measured

    Raises
    ------
    FileNotFoundError
        When there is no such file.
    ValueError
        When it is no image, of 8 bits or in colour, of another size, empty, or in metres.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_depth_image(f"{folder}/wall.png", np.full((480, 640), 2000))
    ...     read_depth_image(f"{folder}/wall.png")[240, 320].item()
    2000
    """
    path = Path(path)
    image = open_image(path, "the depth image", ("PNG", "TIFF"))
    if not (image.mode.startswith("I;16") or image.mode == "I"):
        kind = {"F": "32-bit fractions", "L": "8 bits", "P": "8 bits", "1": "1 bit"}.get(image.mode, f"colours ({image.mode})")
        raise ValueError(f"the depth image must hold 16-bit grey values, whole millimetres, got {kind}: {path}")
    depth = np.asarray(image)
    if depth.shape != tuple(shape):
        raise ValueError(
            f"the depth image must have {shape[0]} rows of {shape[1]} pixels, got {depth.shape[0]} of {depth.shape[1]}"
        )
    return _check_millimetres(depth, str(path))


def write_depth_image(path: str | os.PathLike[str], image: ArrayLike) -> None:
    """Write a depth image as a 16-bit PNG.

    Parameters
    ----------
    path : where; an existing file is replaced in one step
    image : (rows, columns) whole millimetres, 0 = nothing measured

    Raises
    ------
    ValueError
        When the image does not hold whole millimetres that fit 16 bits.
    """
    depth = np.asarray(image)
    if depth.ndim != 2 or depth.size == 0 or depth.dtype.kind not in "ui":
        raise ValueError(f"a depth image must be a 2-D array of whole millimetres, got {depth.dtype} of shape {depth.shape}")
    ok, png = cv2.imencode(".png", _check_millimetres(depth, "an array"))
    if not ok:
        raise ValueError(f"the depth image of shape {depth.shape} could not be encoded as PNG")
    write_file(Path(path), png.tobytes())


def _check_millimetres(depth: NDArray, where: str) -> NDArray[np.uint16]:
    """The same as 16 bits, or a sentence about values that are no millimetres."""
    low, high = int(depth.min()), int(depth.max())
    if low < 0 or high > np.iinfo(np.uint16).max:
        raise ValueError(f"the depth image must hold millimetres from 0 to 65535, got {low} to {high}: {where}")
    if high == 0:
        raise ValueError(f"the depth image must hold at least one depth, got only zeros: {where}")
    if high < FARTHEST_IN_METRES:
        raise ValueError(f"the depth image must hold millimetres, got at most {high}, which look like metres: {where}")
    return depth.astype(np.uint16)
