"""The image of a ROS map: from greys to percents of occupancy by the rules of nav2's loader, and back."""

from __future__ import annotations

import os
import warnings
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.interchange.pixels import open_image
from priorlab.interchange.ros_yaml import RosYaml

OCCUPIED_THRESH, FREE_THRESH = 0.65, 0.196
"""Occupancy above which ROS calls a cell occupied, and below which free. The grey 205 of "unknown" is 50/255 = 0.19608:
with a looser free threshold every unknown cell would become free."""

UNKNOWN = -1
_GREY_UNKNOWN = 205
_IMAGES = ("PPM", "PNG", "BMP", "TIFF", "JPEG")


def occupancy_of(channels: NDArray[np.float64], description: RosYaml) -> NDArray[np.int8]:
    """Percent of every cell by nav2's rules, from (rows, cols, 3 colours and perhaps alpha)."""
    with_alpha = description.mode == "trinary"  # nav2 averages alpha with the colours in this mode
    shade = channels[..., : None if with_alpha else 3].mean(axis=2)
    if description.mode == "raw":
        percent = np.floor(shade * 255 + 0.5)
        return np.where(percent <= 100, percent, UNKNOWN).astype(np.int8)
    occupied = shade if description.negate else 1.0 - shade
    between = np.full(shade.shape, float(UNKNOWN))
    if description.mode == "scale":
        span = description.occupied_thresh - description.free_thresh
        between = np.rint((occupied - description.free_thresh) / span * 100)
    percent = np.where(occupied > description.occupied_thresh, 100, np.where(occupied < description.free_thresh, 0, between))
    if description.mode == "scale" and channels.shape[2] == 4:
        percent[channels[..., 3] < 1] = UNKNOWN
    return percent.astype(np.int8)


def check_mode(channels: NDArray[np.float64], description: RosYaml) -> None:
    """Say when the image cannot be what the yaml says, or does not mean what it shows."""
    shade = np.rint(channels[..., :3].mean(axis=2) * 255)
    if description.mode == "raw":
        strange = (shade > 100) & (shade < 255)
        if strange.any():
            raise ValueError(
                f"an image of mode raw must hold percents of 0 to 100, or 255 for unknown, got {shade[strange][0]:.0f} "
                f"and the like in {100 * strange.mean():.0f} % of its pixels: the mode is trinary or scale, perhaps"
            )
    elif description.mode == "trinary" and not description.negate and 1 - _GREY_UNKNOWN / 255 < description.free_thresh:
        n_unknown = np.count_nonzero(shade == _GREY_UNKNOWN)
        if n_unknown:
            warnings.warn(
                f"free_thresh {description.free_thresh:g} makes {n_unknown} cells of grey {_GREY_UNKNOWN} free, by which map "
                f"savers mean unknown; write {FREE_THRESH:g} into the yaml when they are",
                stacklevel=3,
            )


def read_channels(described_by: Path, image: str) -> NDArray[np.float64]:
    """(rows, cols, 3 or 4) red, green, blue and, when the image has it, alpha; 0 to 1. `described_by` is its yaml file."""
    picture = open_image(_inside(described_by, image), "the map's image", _IMAGES)
    if picture.mode.startswith("I"):
        return np.repeat(np.asarray(picture, dtype=np.float64)[..., None] / 65535, 3, axis=2)
    return np.asarray(picture.convert("RGBA" if picture.has_transparency_data else "RGB"), dtype=np.float64) / 255


def _inside(described_by: Path, image: str) -> Path:
    """Where the image lies; a yaml from elsewhere shall not make us open any file of this computer, nor shall a link.

    A yaml may be reached by a link itself (installed workspaces are full of them): its image lies beside the link, or beside
    the file that the link leads to.
    """
    folders = (described_by.parent, Path(os.path.realpath(described_by)).parent)
    place = next((folder / image for folder in folders if (folder / image).exists()), folders[0] / image)
    real = Path(os.path.realpath(place))
    if not any(real.is_relative_to(os.path.realpath(folder)) for folder in folders):
        raise ValueError(f"image must lie in the folder of its yaml, or below, got {image!r}")
    return real


def encode(grey: NDArray[np.uint8], image_format: str) -> bytes:
    """The image file's bytes."""
    ok, data = cv2.imencode(f".{image_format}", grey)
    if not ok:
        raise ValueError(f"the map of shape {grey.shape} could not be encoded as {image_format}")
    return data.tobytes()


def _trinary(p_empty: NDArray[np.float64]) -> NDArray[np.uint8]:
    """0 occupied, 254 free, 205 unknown."""
    occupied = 1.0 - p_empty
    return np.where(occupied > OCCUPIED_THRESH, 0, np.where(occupied < FREE_THRESH, 254, _GREY_UNKNOWN)).astype(np.uint8)


GREY = {
    "trinary": _trinary,
    "scale": lambda p_empty: np.rint(255 * p_empty).astype(np.uint8),
    "raw": lambda p_empty: np.rint(100 * (1.0 - p_empty)).astype(np.uint8),
}
