"""Poses that look around while the robot moves along straight lines (thesis 5.2, eq. 5.3 and 5.4)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.checks import check_positive


def look_around(segments: Sequence[ArrayLike], spacing: float) -> NDArray[np.float64]:
    """Poses along straight segments that look to the left and right of the motion in turn, eq. 5.3 and 5.4.

    A vertical segment alternates theta = 0 and pi, a horizontal one pi/2 and 3 pi/2; the count i restarts on each segment.

    Parameters
    ----------
    segments : ((x0, y0), (x1, y1)) each, axis-aligned; any unit
    spacing : distance between poses, the same unit; a shorter one is a denser survey

    Returns
    -------
    (N, 3) x, y, theta

    >>> look_around([((0, 0), (4, 0))], spacing=2).round(3).tolist()
    [[0.0, 0.0, 1.571], [2.0, 0.0, 4.712], [4.0, 0.0, 1.571]]
    """
    check_positive("spacing", spacing)
    poses = [np.empty((0, 3))]
    for segment in segments:
        start, end = np.asarray(segment, dtype=np.float64)
        along = np.abs(end - start)
        if along.min() > 1e-6 * max(1.0, along.max()):
            raise ValueError(f"a survey segment must be horizontal or vertical, got {start.tolist()} to {end.tolist()}")
        n_poses = int(np.floor(along.max() / spacing + 1e-9)) + 1
        share = np.arange(n_poses) * spacing / max(along.max(), 1e-12)
        xy = start + np.minimum(share, 1.0)[:, None] * (end - start)
        first = 0.0 if along[1] > along[0] else np.pi / 2  # vertical: eq. 5.3, horizontal: eq. 5.4
        theta = first + np.pi * (np.arange(n_poses) % 2)
        poses.append(np.column_stack([xy, theta]))
    return np.concatenate(poses)
