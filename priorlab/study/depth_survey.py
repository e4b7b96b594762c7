"""A survey with a depth camera (thesis 5.3): at each pose some images; the poses are measured by hand, and a little wrong."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from priorlab.core.readings import Readings
from priorlab.robot.depth_camera import DepthCamera
from priorlab.robot.depth_image import exact_depth
from priorlab.robot.depth_noise import DepthNoise, FaultDraws, disturb_depth, draw_faults, in_millimetres
from priorlab.robot.strip import StripRanges, mean_ranges, readings_from_scans
from priorlab.study.arena import Arena


@dataclass(frozen=True)
class ByHand:
    """How wrong poses are that were measured with a tape and set with a box: standard deviations, metres and radians."""

    position_m: float = 0.02
    heading: float = 0.02

    def __post_init__(self) -> None:
        for name in ("position_m", "heading"):
            value = getattr(self, name)
            if not (np.isfinite(value) and value >= 0):
                raise ValueError(f"{name} must be a finite number of at least 0, got {value:g}")


@dataclass(frozen=True, eq=False)
class DepthSurvey:
    """What a camera saw from every pose, and the chance in each image; made by `survey_arena`.

    The faults are applied when images or readings are asked for, so that their size can be moved and the chance stays.

    Parameters
    ----------
    arena : where
    camera : with what
    depths : N exact depth images, metres, from where the camera really stood
    draws : for each pose the chance in its images
    """

    arena: Arena
    camera: DepthCamera
    depths: tuple[NDArray[np.float64], ...]
    draws: tuple[tuple[FaultDraws, ...], ...]

    @property
    def repeats(self) -> int:
        """Images taken at each pose."""
        return len(self.draws[0])

    def image(self, pose: int, repeat: int = 0, noise: DepthNoise | None = None) -> NDArray[np.uint16]:
        """One image, millimetres."""
        depth = disturb_depth(self.depths[pose], noise or DepthNoise(), self.draws[pose][repeat])
        return in_millimetres(depth, self.camera.min_depth_m, self.camera.max_depth_m)

    def scan(self, pose: int, repeat: int = 0, noise: DepthNoise | None = None, strip_row: int | None = None) -> StripRanges:
        """`strip_ranges(image(pose, repeat, noise), camera)`, computed for the strip's rows alone."""
        camera = self._camera(strip_row)
        depth = disturb_depth(self.depths[pose][camera.strip], noise or DepthNoise(), self.draws[pose][repeat].rows(camera.strip))
        return mean_ranges(in_millimetres(depth, camera.min_depth_m, camera.max_depth_m), camera)

    def readings(
        self,
        repeats: int = 1,
        noise: DepthNoise | None = None,
        strip_row: int | None = None,
        p_free: float = 0.9,
        p_occupied: float = 0.1,
        poses: slice = slice(None),
    ) -> Readings:
        """All images as readings of chapter 4; the repeats of a pose follow one another.

        Parameters
        ----------
        repeats : images used at each pose, at most as many as were taken; 1 takes the first of each
        noise : the camera's faults; `DepthNoise()`, a Kinect's, by default
        strip_row : first row of the strip; the camera's by default
        p_free, p_occupied : inverse sensor model
        poses : of which poses

        Returns
        -------
        Readings at the poses that were MEASURED, not those where the camera really stood
        """
        if not 1 <= repeats <= self.repeats:
            raise ValueError(f"repeats must lie between 1 and the {self.repeats} images of a pose, got {repeats}")
        chosen = range(len(self.depths))[poses]
        scans = [self.scan(pose, repeat, noise, strip_row) for pose in chosen for repeat in range(repeats)]
        at = np.repeat(self.arena.poses[list(chosen)].reshape(-1, 3), repeats, axis=0)
        scale = self.arena.metres_per_pixel
        sensor = self.camera.range_sensor(scale, self.arena.wall_thickness, p_free, p_occupied)
        return readings_from_scans(scans, at, self._camera(strip_row), self.arena.truth.shape, scale, sensor)

    def __repr__(self) -> str:
        return f"DepthSurvey({len(self.depths)} poses x {self.repeats} images of {self.camera.rows} x {self.camera.columns} px)"

    def _camera(self, strip_row: int | None) -> DepthCamera:
        """The camera with its strip elsewhere."""
        return self.camera if strip_row is None else replace(self.camera, strip_row=strip_row)


def survey_arena(
    arena: Arena,
    rng: np.random.Generator,
    camera: DepthCamera | None = None,
    repeats: int = 3,
    by_hand: ByHand | None = None,
) -> DepthSurvey:
    """Take `repeats` images from each of the arena's poses.

    Parameters
    ----------
    arena : the arena
    rng : draws how wrong the poses are, and the chance in each image
    camera : `DepthCamera()`, a Kinect, by default
    repeats : images of each pose: the pose's error is the same for all of them, the camera's faults are not
    by_hand : how wrong the poses are; `ByHand()` by default

    >>> from priorlab.study.arena import build_arena
    >>> survey_arena(build_arena(), np.random.default_rng(0), repeats=1)
    DepthSurvey(12 poses x 1 images of 480 x 640 px)
    """
    if repeats < 1:
        raise ValueError(f"repeats must be at least 1, got {repeats}")
    camera, by_hand = camera or DepthCamera(), by_hand or ByHand()
    rng_poses, rng_images = rng.spawn(2)
    off = rng_poses.standard_normal(arena.poses.shape)
    stood = arena.poses + off * (by_hand.position_m / arena.metres_per_pixel)
    stood[:, 2] = arena.poses[:, 2] + off[:, 2] * by_hand.heading
    return DepthSurvey(
        arena,
        camera,
        tuple(exact_depth(arena.relief, pose, camera) for pose in stood),
        tuple(tuple(draw_faults(rng_images, camera.shape) for _ in range(repeats)) for _ in stood),
    )
