"""Section 5.3 as pictures: a depth image with its strip, and the ranges that it becomes."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle
from numpy.typing import ArrayLike, NDArray

from priorlab.plot.style import BLACK, BLUE, ORANGE, finish, given_or_new
from priorlab.robot.depth_camera import DepthCamera

NOTHING, STRIP = (86, 180, 233), (0, 114, 178)
"""Colours of pixels without a depth, and of the strip's frame."""

DEPTH_LEGEND = "dark: near, light: far, light blue: nothing measured"


def depth_picture(image: ArrayLike, camera: DepthCamera) -> NDArray[np.uint8]:
    """(rows, columns, 3) a depth image as fig. 5.12 shows it: dark = near, light = far, and light blue without a depth."""
    grey = 30 + 215 * (np.arange(2**16) / 1000 - camera.min_depth_m) / (camera.max_depth_m - camera.min_depth_m)
    shades = np.rint(grey.clip(0, 255)).astype(np.uint8)[:, None].repeat(3, axis=1)  # one for each depth there can be
    shades[0] = NOTHING
    return shades[np.asarray(image)]


def depth_image(image: ArrayLike, camera: DepthCamera, ax: Axes | None = None, title: str | None = None) -> Axes:
    """A depth image with the frame of its strip (fig. 5.12 b)."""
    ax = given_or_new(ax, 6.0, 4.6)
    ax.imshow(depth_picture(image, camera), interpolation="antialiased")
    corner, width = (-0.5, camera.first_strip_row - 0.5), camera.columns
    ax.add_patch(Rectangle(corner, width, camera.strip_rows, fill=False, ec=BLUE, lw=1.8))
    return finish(ax, DEPTH_LEGEND if title is None else title, "column", "row")


def strip_ranges(
    ranges_m: ArrayLike, camera: DepthCamera, true_m: ArrayLike | None = None, ax: Axes | None = None, title: str | None = None
) -> Axes:
    """Ranges by bearing, the left of the image at the left; what the strip says, the depth behind it, and the truth."""
    ax = given_or_new(ax, 6.0, 3.6)
    degrees = np.degrees(camera.bearings)
    ranges = np.where(np.isfinite(ranges_m), ranges_m, np.nan)
    if true_m is not None:
        true = np.where(np.isfinite(true_m), true_m, np.nan)
        ax.plot(degrees, true, "-", color=BLACK, lw=3.5, alpha=0.3, label="true range")
    ax.plot(degrees, ranges, "-", color=BLUE, lw=1.4, label="range = depth / cos(bearing)")
    ax.plot(degrees, ranges * np.cos(camera.bearings), "--", color=ORANGE, lw=1.2, label="depth, the strip's mean")
    ax.set(xlim=(degrees[0], degrees[-1]), ylim=(0, None))
    ax.legend(fontsize=8, loc="lower left")
    return finish(ax, title, "bearing, degrees (positive: left)", "metres")
