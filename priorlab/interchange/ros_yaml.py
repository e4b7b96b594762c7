"""The yaml file that describes a ROS map."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
import yaml

from priorlab.core.checks import as_numbers, check_positive, check_share


@dataclass(frozen=True)
class RosYaml:
    """What map_server and nav2 read beside the image.

    Parameters
    ----------
    image : path of the image, relative to the yaml file
    resolution : metres per pixel
    origin : x, y (metres), yaw (radians) of the lower left pixel
    occupied_thresh, free_thresh : occupancy above which a pixel is occupied, below which it is free
    negate : True when white is occupied
    mode : "trinary", "scale" or "raw"
    """

    image: str
    resolution: float
    origin: tuple[float, float, float]
    occupied_thresh: float
    free_thresh: float
    negate: bool = False
    mode: Literal["trinary", "scale", "raw"] = "trinary"

    def __post_init__(self) -> None:
        check_positive("resolution", self.resolution)
        origin = as_numbers("origin", self.origin)
        if origin.shape != (3,) or not np.isfinite(origin).all():
            raise ValueError(f"origin must be three finite numbers x, y, yaw, got {origin.tolist()}")
        for name in ("occupied_thresh", "free_thresh"):
            check_share(name, getattr(self, name))
        if self.free_thresh >= self.occupied_thresh:
            raise ValueError(f"free_thresh must be below occupied_thresh, got {self.free_thresh:g} and {self.occupied_thresh:g}")
        if self.mode not in ("trinary", "scale", "raw"):
            raise ValueError(f"mode must be 'trinary', 'scale' or 'raw', got {self.mode!r}")

    def to_text(self) -> str:
        """The file's text."""
        values = {
            "image": self.image,
            "mode": self.mode,
            "resolution": float(self.resolution),
            "origin": [float(value) for value in self.origin],
            "negate": int(self.negate),
            "occupied_thresh": float(self.occupied_thresh),
            "free_thresh": float(self.free_thresh),
        }
        return yaml.safe_dump(values, sort_keys=False, default_flow_style=None)


def read_ros_yaml(path: Path) -> RosYaml:
    """Read the description of a ROS map; a missing mode means trinary, a missing negate 0, as in nav2.

    Raises
    ------
    FileNotFoundError
        When there is no file.
    ValueError
        When it is no yaml, or a value is missing, of the wrong kind or out of range.
    """
    if not path.is_file():
        raise FileNotFoundError(f"the map's yaml must be a file, found none at {path}")
    try:
        values = yaml.safe_load(path.read_text(encoding="utf-8"))
    except (yaml.YAMLError, ValueError) as broken:  # ValueError: no text, or a date that cannot be
        where = str(broken).splitlines()[-1].strip()
        raise ValueError(f"the map's yaml must be readable, got a broken file: {path} ({where})") from None
    if not isinstance(values, dict):
        raise ValueError(f"the map's yaml must hold names and values, got {type(values).__name__} in {path}")
    needed = ("image", "resolution", "origin", "occupied_thresh", "free_thresh")
    if missing := [name for name in needed if name not in values]:
        raise ValueError(f"the map's yaml must hold {', '.join(needed)}, got no {', '.join(missing)} in {path}")
    origin = values["origin"]
    if not isinstance(origin, list):
        raise ValueError(f"origin must be three finite numbers x, y, yaw, got {origin!r}")
    if not isinstance(values["image"], str) or not values["image"] or "\0" in values["image"]:
        raise ValueError(f"image must be the name of a file, got {values['image']!r}")
    if (negate := values.get("negate", 0)) not in (0, 1):
        raise ValueError(f"negate must be 0 or 1, got {negate!r}")
    return RosYaml(
        image=values["image"],
        resolution=_number("resolution", values["resolution"]),
        origin=tuple(_number("origin", value) for value in origin),  # type: ignore[arg-type]
        occupied_thresh=_number("occupied_thresh", values["occupied_thresh"]),
        free_thresh=_number("free_thresh", values["free_thresh"]),
        negate=bool(negate),
        mode=values.get("mode", "trinary"),
    )


def _number(name: str, value: Any) -> float:
    """A yaml value as a float, or a sentence."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ValueError(f"{name} must be a number, got {value!r}")
    try:
        return float(value)
    except OverflowError:
        raise ValueError(f"{name} must be a number, got one of {len(str(value))} digits") from None
