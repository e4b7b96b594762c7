"""A depth camera in an arena: the image with its strip, the fan of ranges that it becomes, and the map so far (thesis 5.3)."""

from __future__ import annotations

import warnings

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.picture import grey_of
from priorlab.core.readings import Evidence, Readings
from priorlab.core.score import Score, score_map
from priorlab.mapping.evidence import gather_evidence
from priorlab.mapping.overruled import OverruledSensorWarning
from priorlab.mapping.prior import build_prior_map
from priorlab.mapping.update import update_map
from priorlab.plot.depth_camera import DEPTH_LEGEND, STRIP, depth_picture
from priorlab.robot.depth_noise import DepthNoise
from priorlab.study.depth_survey import DepthSurvey
from priorlab.widgets.lab import Lab, table
from priorlab.widgets.picture import Picture
from priorlab.widgets.sliders import Slider

RAY, HIT, ROBOT = (86, 180, 233), (213, 94, 0), (0, 114, 178)
EVERY_RAY = 16
HALF, ZOOM = 2, 2
"""Every second pixel of a depth image is shown, every pixel of the map twice."""

PRESETS: dict[str, dict[str, float]] = {
    "the Kinect, 1 image a pose": {"repeats": 1, "noise": 1, "holes": 0.05, "cell_size": 2, "strip_row": 230},
    "3 images a pose": {"repeats": 3},
    "coarse cells": {"cell_size": 3},
    "no plan": {"p_wall": 0.55, "p_space": 0.55},
    "half of the image lost": {"holes": 0.5},
    "strip too high": {"strip_row": 60},
    "strip on the floor": {"strip_row": 460},
}


class DepthLab(Lab):
    """Move along the poses, move the strip, spoil the camera; read `lab.score`, `lab.map`, `lab.evidence`, `lab.readings`.

    Parameters
    ----------
    survey : made by `survey_arena`
    pose : how many poses the map has used; the image shown is the last one's
    cell_size : pixels

    Attributes
    ----------
    map, score : posterior map and its score
    prior_score, uninformed_score : of the plan alone, and of the readings alone
    readings : of all poses so far
    """

    def __init__(self, survey: DepthSurvey, pose: int = 2, cell_size: int = 2) -> None:
        camera, n_poses = survey.camera, len(survey.depths)
        self._survey = survey
        self._taken: tuple | None = None  # settings of the images in hand
        self._gathered: tuple | None = None  # readings and cell size of the evidence in hand
        self.pose = Slider("poses used", pose, 1, n_poses, 1, "the map holds poses 1 to here; the image is the last one")
        self.repeats = Slider("images a pose", 1, 1, survey.repeats, 1, "how many images of each pose the map holds")
        self.strip_row = Slider(
            "strip's first row", camera.first_strip_row, 0, camera.rows - camera.strip_rows, 10, "row 0 is the image's top"
        )
        self.noise = Slider("noise, x Kinect", 1, 0, 20, 1, "the camera's noise as a multiple of a Kinect's")
        self.holes = Slider("image lost", 0.05, 0, 0.8, 0.05, "share of the image without a depth, in patches")
        self.cell_size = Slider("cell size, px", cell_size, 1, 6, 1, "side of a cell, pixels of the plan")
        self.p_wall = Slider("p_wall", 0.2, 0.05, 1.0, 0.01, "P(empty) where the plan shows a wall, before the factor 0.9")
        self.p_space = Slider("p_space", 0.9, 0.05, 1.0, 0.01, "P(empty) where the plan shows space, before the factor 0.9")
        names = ("pose", "repeats", "strip_row", "noise", "holes", "cell_size", "p_wall", "p_space")
        super().__init__(
            {name: getattr(self, name) for name in names},
            {"all poses": {"pose": n_poses}, **PRESETS},
            [Picture(), Picture()],  # as large as they come: nothing to scale on the way
        )

    def refresh(self) -> None:
        """The readings so far, their evidence, three maps, two pictures; what a slider does not touch is kept."""
        self._take()
        arena, size = self._survey.arena, int(self.cell_size.value)
        self.prior = Prior(self.p_wall.value, self.p_space.value)
        prior_map, uninformed = (
            build_prior_map(arena.walls, prior, cell_size=size) for prior in (self.prior, Prior.uninformed())
        )
        if (self.readings, size) != self._gathered:
            self.evidence, self._gathered = gather_evidence(self.readings, prior_map.grid), (self.readings, size)
        self.map = _updated(prior_map, self.evidence)
        self.score, self.prior_score, self.uninformed_score = (
            score_map(one, arena.truth) for one in (self.map, prior_map, _updated(uninformed, self.evidence))
        )
        newest = self.readings[-1:]
        lost = 100 * (1 - newest.valid.mean()) if newest.valid is not None else 0.0
        self.pictures[1].show(_paint(self.map, newest), f"The map so far, white = empty, and the newest fan. {self.summary()}")
        self.readout.value = table(self._rows(newest, lost), caption="detected as wall: P(empty) &le; 0.2")

    def _take(self) -> None:
        """Take the images again, when a slider of the camera or the robot has moved."""
        survey, camera, last = self._survey, self._survey.camera, int(self.pose.value) - 1
        usual, times = DepthNoise(), self.noise.value
        noise = DepthNoise(usual.deviation_at_1m * times, usual.common_at_1m * times, self.holes.value)
        repeats, row = int(self.repeats.value), int(self.strip_row.value)
        if (last, repeats, row, noise) == self._taken:
            return
        self._taken = (last, repeats, row, noise)
        self.readings = survey.readings(repeats, noise, row, poses=slice(0, last + 1))
        self.image = survey.image(last, repeats - 1, noise)
        picture = depth_picture(self.image[::HALF, ::HALF], camera)
        bottom = (row + camera.strip_rows) // HALF
        cv2.rectangle(picture, (0, row // HALF), (picture.shape[1] - 1, bottom), STRIP, 2)
        self.pictures[0].show(picture, f"Depth image of pose {last + 1}; {DEPTH_LEGEND}. The frame is the strip.")

    def _rows(self, newest: Readings, lost: float) -> list[tuple[str, str]]:
        """The numbers under the pictures."""
        scale, camera = self._survey.arena.metres_per_pixel, self._survey.camera
        middle = camera.columns // 2
        ahead, edge = (newest.ranges[0, column] * scale for column in (middle, 0))
        depth = edge * np.cos(camera.bearings[0])
        x, y, theta = self._survey.arena.poses[int(self.pose.value) - 1]
        return [
            ("<b>F2 with plan and readings</b>", f"<b>{self.score.f_beta:.3f}</b> {_why(self.score)}"),
            ("F2, the plan alone", f"{self.prior_score.f_beta:.3f}"),
            ("F2, the readings alone", f"{self.uninformed_score.f_beta:.3f} {_why(self.uninformed_score)}"),
            ("looks per seen cell", f"{self.evidence.mean_looks:.2f}"),
            ("camera at", f"x {x * scale:.2f} m, y {y * scale:.2f} m, {np.degrees(theta):.0f}&deg;"),
            ("range straight ahead", _metres(ahead)),
            ("at the left edge: depth, range", f"{_metres(depth)}, {_metres(edge)}"),
            ("columns without a reading", f"{lost:.0f} %"),
            ("left picture", DEPTH_LEGEND),
            ("right picture", "the map, white = empty;<br>blue: camera, light blue: rays, dark orange: what the strip found"),
        ]

    def summary(self) -> str:
        """The sliders that matter and the three scores."""
        return (
            f"poses 1 to {self.pose.value:.0f}, images a pose: {self.repeats.value:.0f}, cells of {self.cell_size.value:.0f} px: "
            f"F2 {self.score.f_beta:.3f}; plan alone {self.prior_score.f_beta:.3f}, readings alone "
            f"{self.uninformed_score.f_beta:.3f}"
        )


def _updated(prior_map: GridMap, evidence: Evidence) -> GridMap:
    """The posterior map; any prior may be tried here."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", OverruledSensorWarning)
        return update_map(prior_map, evidence)


def _why(score: Score) -> str:
    """Precision and recall behind an F2."""
    return f"(precision {score.precision:.2f}, recall {score.recall:.2f})"


def _metres(value: float) -> str:
    """A length, or that there is none."""
    return f"{value:.3f} m" if np.isfinite(value) else "no reading"


def _paint(grid_map: GridMap, newest: Readings, zoom: int = ZOOM) -> NDArray[np.uint8]:
    """The map, magnified, with the newest fan: rays, what they met, and the robot."""
    image = grey_of(grid_map.grid.to_image(grid_map.p_empty)).repeat(zoom, axis=0).repeat(zoom, axis=1)
    picture = np.ascontiguousarray(image[..., None].repeat(3, axis=2))
    x, y, theta = newest.poses[0]
    known = newest.valid[0] if newest.valid is not None else np.ones(len(newest.bearings), dtype=bool)
    length = np.minimum(np.where(known, newest.ranges[0], 0.0), newest.sensor.max_range)
    angles = theta + newest.bearings
    ends = np.stack([x + length * np.cos(angles), grid_map.grid.image_shape[0] - y - length * np.sin(angles)], axis=1) * zoom
    start = (round(x * zoom), round((grid_map.grid.image_shape[0] - y) * zoom))
    for end in ends[known][::EVERY_RAY]:
        cv2.line(picture, start, (round(end[0]), round(end[1])), RAY, 1, cv2.LINE_AA)
    met = known & (newest.ranges[0] <= newest.sensor.max_range)
    for column, row in np.rint(ends[met][:: EVERY_RAY // 4]).astype(int):
        cv2.circle(picture, (int(column), int(row)), 1, HIT, -1)
    turn = theta + np.array([0.0, 2.6, -2.6])
    corners = start + 4.0 * zoom * np.column_stack([np.cos(turn), -np.sin(turn)])
    cv2.fillPoly(picture, [np.rint(corners).astype(np.int32)], ROBOT, cv2.LINE_AA)
    return picture
