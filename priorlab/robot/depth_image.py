"""What a depth camera sees in a building: every pixel's ray meets a block, the floor, the ceiling, or nothing.

The blocks stand upright, so all rays of one column lie over one line of the plan. Along it the rays of `rays.py` find where
the plan rises to a height and where it falls below it again; from these runs a column's pixels follow without further rays.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.checks import as_numbers, check_poses, check_record
from priorlab.core.grid import Grid
from priorlab.robot.depth_camera import DepthCamera
from priorlab.robot.depth_noise import DepthNoise, disturb_depth, draw_faults, in_millimetres
from priorlab.robot.rays import cast_rays
from priorlab.robot.relief import Relief

NO_FAULTS = DepthNoise(deviation_at_1m=0.0, common_at_1m=0.0, hole_rate=0.0)
"""A camera that is always right, but for whole millimetres."""

A_HAIR = 1e-6
"""How far behind a border a ray starts anew, pixels."""


def depth_image(
    relief: Relief,
    pose: ArrayLike,
    camera: DepthCamera | None = None,
    rng: np.random.Generator | None = None,
    noise: DepthNoise = NO_FAULTS,
) -> NDArray[np.uint16]:
    """The image that a camera takes from a pose.

    Parameters
    ----------
    relief : what stands how high
    pose : (3,) x, y, theta; pixels of the plan, y up
    camera : `DepthCamera()`, a Kinect, by default
    rng : draws the faults; not needed without any
    noise : the camera's faults

    Returns
    -------
    (rows, columns) depths along the optical axis, millimetres; 0 where nothing was measured: too near, too far, lost

    Raises
    ------
    ValueError
        For a pose off the plan or in something that stands higher than the lens, noise without `rng`.

    >>> room = np.zeros((60, 80), dtype=bool)
    >>> room[:, 60:] = True                                        # a wall square to the camera, 2 m ahead
    >>> image = depth_image(Relief(room * 2.4, 0.05), [20.0, 30.0, 0.0])
    >>> image[240, [0, 320, 639]].tolist()                         # one depth in the middle and at both edges
    [2000, 2000, 2000]
    """
    camera = DepthCamera() if camera is None else camera
    for name, value, kind in (("relief", relief, Relief), ("camera", camera, DepthCamera), ("noise", noise, DepthNoise)):
        check_record(name, value, kind)
    depth = exact_depth(relief, pose, camera)
    if noise != NO_FAULTS:
        depth = disturb_depth(depth, noise, draw_faults(rng, camera.shape, noise.hole_side))
    return in_millimetres(depth, camera.min_depth_m, camera.max_depth_m)


def exact_depth(relief: Relief, pose: ArrayLike, camera: DepthCamera) -> NDArray[np.float64]:
    """(rows, columns) true depths, metres; inf where nothing is met as far as the camera can see."""
    x, y, theta = _check_pose(relief, pose, camera)
    below = camera.below_axis[:, None]  # (rows, 1): a ray at depth d is d * below under the lens
    with np.errstate(divide="ignore", invalid="ignore"):
        depth = np.where(below > 0, camera.height_m / below, np.inf)  # the floor
        if relief.ceiling_m is not None:
            depth = np.minimum(depth, np.where(below < 0, (camera.height_m - relief.ceiling_m) / below, np.inf))
    depth = np.repeat(depth, camera.columns, axis=1)

    angles = theta + camera.bearings
    per_pixel = relief.metres_per_pixel * np.cos(camera.bearings)  # depth, metres, for a pixel along a column's line
    reach = camera.max_depth_m / per_pixel.min()
    for level in relief.levels_m:
        drop = camera.height_m - level  # how far the block's top lies under the lens
        with np.errstate(divide="ignore", invalid="ignore"):
            under_top = np.where(below > 0, drop / below, np.inf if drop > 0 else 0.0)  # a falling ray is under it from here
            over_top = np.where(below < 0, drop / below, np.inf)  # a rising ray is over it from here
        if drop >= 0:
            over_top = np.where(below < 0, 0.0, over_top)
        for start, end in _runs(relief.heights_m >= level, (x, y), angles, reach, all_runs=drop > 0):
            first = np.maximum(start * per_pixel, under_top)
            met = (first < end * per_pixel) & (first <= over_top)
            np.minimum(depth, first, out=depth, where=met)
    return depth


def _runs(
    blocks: NDArray[np.bool_], xy: tuple[float, float], angles: NDArray, reach: float, all_runs: bool
) -> list[tuple[NDArray, NDArray]]:
    """Where each ray enters and leaves blocks, (N,) pixels each, run by run; who can be seen over needs all, others the first."""
    blocks = np.pad(blocks, 1)  # a rim of floor: a block at the plan's border ends there
    origins = np.tile(np.add(xy, 1.0), (len(angles), 1))
    forward = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    grid = Grid(blocks.shape)
    runs: list[tuple[NDArray, NDArray]] = []
    at = np.zeros(len(angles))
    while True:
        start = _cast_on(blocks, origins, forward, angles, at, reach, grid)
        if not all_runs:
            return [(start, np.full(len(angles), np.inf))]
        end = _cast_on(~blocks, origins, forward, angles, start + A_HAIR, reach, grid)
        if np.isinf(start).all():
            return runs
        runs.append((start, end))
        at = end + A_HAIR


def _cast_on(
    targets: NDArray[np.bool_], origins: NDArray, forward: NDArray, angles: NDArray, at: NDArray, reach: float, grid: Grid
) -> NDArray[np.float64]:
    """Distance from the ORIGINS to the first target pixel beyond `at`; inf for rays that have left the plan or their reach."""
    met = np.full(len(at), np.inf)
    begin = origins + np.where(np.isfinite(at), at, 0.0)[:, None] * forward
    on = np.flatnonzero((at <= reach) & grid.contains(begin))
    if on.size:
        met[on] = at[on] + cast_rays(targets, begin[on], angles[on], reach)
    return np.where(met <= reach, met, np.inf)


def _check_pose(relief: Relief, pose: ArrayLike, camera: DepthCamera) -> tuple[float, float, float]:
    """x, y and theta, or a sentence about a place where no camera can be."""
    x, y, theta = check_poses("pose", as_numbers("pose", pose).reshape(1, -1))[0].tolist()
    grid = Grid(relief.shape)
    height, width = relief.shape
    if not grid.contains((x, y)):
        raise ValueError(f"pose must lie on the plan of {width} x {height} pixels, got x, y = {x:g}, {y:g}")
    stands = float(relief.heights_m[tuple(grid.xy_to_pixel((x, y)))])
    if stands >= camera.height_m:
        raise ValueError(
            f"pose must leave the lens at {camera.height_m:g} m free, got x, y = {x:g}, {y:g} in {stands:g} m of wall"
        )
    if relief.ceiling_m is not None and relief.ceiling_m <= camera.height_m:
        raise ValueError(f"height_m must lie under the ceiling at {relief.ceiling_m:g} m, got {camera.height_m:g}")
    return x, y, theta
