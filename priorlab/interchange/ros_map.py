"""Maps as ROS keeps them: a yaml file and an image beside it (map_server, nav2).

ROS counts OCCUPANCY in percent, -1 = unknown; ours is P(empty). Only here, at the border, one becomes the other. Image
row 0 is the top, as in our arrays, so no row is flipped. Written and read by the rules of nav2's loader; no robot was
asked.
"""

from __future__ import annotations

import os
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import check_probability, check_record
from priorlab.core.drawing import Walls
from priorlab.core.files import check_free, write_file
from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.log_odds import log_odds
from priorlab.interchange.ros_image import (
    FREE_THRESH,
    GREY,
    OCCUPIED_THRESH,
    UNKNOWN,
    check_mode,
    encode,
    occupancy_of,
    read_channels,
)
from priorlab.interchange.ros_yaml import RosYaml, read_ros_yaml

Mode = Literal["trinary", "scale", "raw"]


@dataclass(frozen=True, eq=False)
class RosMap:
    """A map as a ROS node would hold it.

    Parameters
    ----------
    occupancy : (rows, cols) int8 percent, 0 free to 100 occupied, -1 unknown; row 0 at the TOP, as in the image
    grid : cells of one pixel with ROS's resolution as their metres per pixel
    origin : x, y (metres) and yaw (radians) of the lower left corner in the frame of the robot's map
    mode : how it was stored
    """

    occupancy: NDArray[np.int8]
    grid: Grid
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0)
    mode: Mode = "trinary"

    @property
    def data(self) -> NDArray[np.int8]:
        """The cells in the order of the message nav_msgs/OccupancyGrid: row by row from the BOTTOM."""
        return self.grid.to_ros(self.occupancy).ravel()

    @property
    def p_empty(self) -> NDArray[np.float64]:
        """(rows, cols) P(empty) = 1 - occupancy; unknown is 0.5."""
        return np.where(self.occupancy == UNKNOWN, 0.5, 1.0 - self.occupancy / 100.0)

    def to_map(self, least: float = 0.01) -> GridMap:
        """A map to go on with: percents 0 and 100 become `least` and 1 - `least`, for no cell of ours is certain."""
        check_probability("least", least)
        return GridMap(log_odds(self.p_empty.clip(least, 1 - least)), self.grid)

    def to_prior_map(self, prior: Prior) -> GridMap:
        """A map for FastSLAM to start from: no cell is believed to be a wall, or space, more than the prior does.

        Occupied cells get the effective p_wall, free ones the effective p_space, unknown ones 0.5.

        >>> occupancy = np.array([[100, 0, UNKNOWN, 60]], dtype=np.int8)
        >>> RosMap(occupancy, Grid((1, 4), 1, 0.05)).to_prior_map(Prior(0.3, 0.8)).p_empty.round(2).tolist()
        [[0.27, 0.72, 0.5, 0.4]]
        """
        check_record("prior", prior, Prior)
        low, high = sorted((prior.effective_p_wall, prior.effective_p_space))
        return GridMap(log_odds(self.p_empty.clip(low, high)), self.grid, prior)

    def __repr__(self) -> str:
        rows, cols = self.occupancy.shape
        known = 100 * (self.occupancy != UNKNOWN).mean()
        return f"RosMap({cols} x {rows} cells of {self.grid.scale:g} m, {known:.0f} % known, {self.mode})"


def write_ros_map(
    path: str | os.PathLike[str],
    grid_map: GridMap | Walls,
    mode: Mode = "trinary",
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0),
    image_format: Literal["pgm", "png", "bmp"] = "pgm",
    force: bool = False,
) -> Path:
    """Write a map for ROS: `path` (.yaml) and an image of the same name beside it.

    "trinary": 0 occupied, 205 unknown, 254 free, by occupancy 1 - P(empty) above 0.65 and below 0.196. "scale": grey =
    255 P(empty), with thresholds 1 and 0 so that every percent survives. "raw": the percents of occupancy themselves.

    Parameters
    ----------
    path : the yaml file
    grid_map : a map, or extracted walls (wall = occupied, all else free)
    mode : see above
    origin : x, y (metres) and yaw (radians) of the drawing's lower left corner in the robot's frame
    image_format : all hold every value
    force : replace what stands there

    Returns
    -------
    The yaml file's path

    Raises
    ------
    FileExistsError
        When one of the two files is there already.
    ValueError
        When the scale is not known.

    Warns
    -----
    UserWarning
        When trinary turns most of the space into unknown: a cell is free only above P(empty) = 0.804.

    >>> import tempfile
    >>> walls = Walls(np.array([[1, 0], [1, 0]], dtype=np.uint8), metres_per_pixel=0.05)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = write_ros_map(f"{folder}/flat.yaml", walls)
    ...     print(path.read_text().splitlines()[:3])
    ...     read_ros_map(path).occupancy.tolist()
    ['image: flat.pgm', 'mode: trinary', 'resolution: 0.05']
    [[100, 0], [100, 0]]
    """
    if mode not in ("trinary", "scale", "raw"):
        raise ValueError(f"mode must be 'trinary', 'scale' or 'raw', got {mode!r}")
    if image_format not in ("pgm", "png", "bmp"):
        raise ValueError(f"image_format must be 'pgm', 'png' or 'bmp', got {image_format!r}")
    path = Path(path)
    if path.suffix not in (".yaml", ".yml"):
        raise ValueError(f"a ROS map's path must end in .yaml, got {path}")
    if isinstance(grid_map, Walls):
        grid, p_empty = Grid(grid_map.shape, 1, grid_map.metres_per_pixel), (~grid_map.mask).astype(np.float64)
    else:
        check_record("grid_map", grid_map, GridMap)
        grid, p_empty = grid_map.grid, grid_map.p_empty
    thresholds = (1.0, 0.0) if mode == "scale" else (OCCUPIED_THRESH, FREE_THRESH)
    image_path = path.with_suffix(f".{image_format}")
    description = RosYaml(image_path.name, grid.cell_size_m, origin, *thresholds, negate=False, mode=mode)
    for place in (path, image_path):
        check_free(place, force)
    if mode == "trinary":
        _warn_when_space_is_lost(p_empty)
    write_file(image_path, encode(GREY[mode](p_empty), image_format))
    write_file(path, description.to_text())
    return path


def read_ros_map(path: str | os.PathLike[str]) -> RosMap:
    """Read a ROS map from its yaml file; the image (pgm, png, bmp, tiff or jpeg) lies in its folder, or below.

    Raises
    ------
    FileNotFoundError
        When the yaml file or the image is missing.
    ValueError
        When the yaml is broken, a value is missing or out of range, or the image lies elsewhere, cannot be read, or is not
        what the mode "raw" says.

    Warns
    -----
    UserWarning
        When the thresholds make the grey 205 free, by which map savers mean unknown (some write free_thresh 0.25 beside it).
    """
    path = Path(path)
    description = read_ros_yaml(path)
    channels = read_channels(path, description.image)
    check_mode(channels, description)
    rows, cols = channels.shape[:2]
    return RosMap(
        occupancy_of(channels, description), Grid((rows, cols), 1, description.resolution), description.origin, description.mode
    )


def _warn_when_space_is_lost(p_empty: NDArray[np.float64]) -> None:
    """Say when most cells that are likelier empty than not become unknown."""
    space = p_empty > 0.5
    lost = space & (1.0 - p_empty >= FREE_THRESH)
    if 2 * np.count_nonzero(lost) > np.count_nonzero(space):
        share = 100 * np.count_nonzero(lost) / np.count_nonzero(space)
        warnings.warn(
            f"trinary calls a cell free only above P(empty) = {1 - FREE_THRESH:.3f}: {share:.0f} % of the space becomes unknown "
            "to the robot; use mode='scale', or export the walls themselves",
            stacklevel=3,
        )
