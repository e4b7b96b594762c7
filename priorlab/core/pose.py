"""Poses (x, y, theta) in the world frame: x right, y up, theta counter-clockwise from +x, radians."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray


def wrap_angle(angle: ArrayLike) -> NDArray[np.float64]:
    """The same direction in [-pi, pi).

    >>> float(wrap_angle(3 * np.pi)) == -np.pi
    True
    """
    return (np.asarray(angle, dtype=np.float64) + np.pi) % (2 * np.pi) - np.pi


def compose(pose: ArrayLike, step: ArrayLike) -> NDArray[np.float64]:
    """Where a robot at `pose` stands after `step`, given in the robot's own frame; both (..., 3).

    >>> compose([0, 0, np.pi / 2], [1, 0, 0]).round(6).tolist()
    [0.0, 1.0, 1.570796]
    """
    pose, step = np.asarray(pose, dtype=np.float64), np.asarray(step, dtype=np.float64)
    x, y, theta = np.moveaxis(pose, -1, 0)
    dx, dy, dtheta = np.moveaxis(step, -1, 0)
    cos, sin = np.cos(theta), np.sin(theta)
    return np.stack([x + cos * dx - sin * dy, y + sin * dx + cos * dy, wrap_angle(theta + dtheta)], axis=-1)


def relative(start: ArrayLike, end: ArrayLike) -> NDArray[np.float64]:
    """The step that leads from `start` to `end`, in the frame of `start`: compose(start, relative(start, end)) == end."""
    start, end = np.asarray(start, dtype=np.float64), np.asarray(end, dtype=np.float64)
    dx, dy, dtheta = np.moveaxis(end - start, -1, 0)
    cos, sin = np.cos(start[..., 2]), np.sin(start[..., 2])
    return np.stack([cos * dx + sin * dy, cos * dy - sin * dx, wrap_angle(dtheta)], axis=-1)
