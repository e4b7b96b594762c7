"""Figures 5.12 and 5.13: a depth image with its strip, and the arena with what the camera found."""

from __future__ import annotations

from dataclasses import replace

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab import plot
from priorlab.core.grid import Grid
from priorlab.core.score import score_map
from priorlab.figures.depth_case import FINE, INFORMATIVE, Interval, arena, seeds_of, survey
from priorlab.figures.figure import Entry, Outcome, sheet, verdict_of
from priorlab.mapping.prior import build_prior_map
from priorlab.robot.depth_camera import DepthCamera
from priorlab.robot.depth_noise import DepthNoise, disturb_depth, in_millimetres
from priorlab.robot.strip import mean_ranges
from priorlab.study.arena import BOARD_M
from priorlab.study.depth_survey import DepthSurvey

POSE = 1
"""In the middle of the large room: a wall ahead and the corner beside it."""

NEAR_WALL_M = 0.05


def _image_and_strip(rng: np.random.Generator) -> Outcome:
    """One image; how wrong are ranges from 20 rows, and from one?"""
    surveys = [survey(seed) for seed in seeds_of(rng)]
    camera = surveys[0].camera
    thin = replace(camera, strip_rows=1)
    wide_errors, thin_errors = ([_errors_m(one, cam) for one in surveys] for cam in (camera, thin))
    rms = {"20 rows": Interval.of([_rms(e) for e in wide_errors]), "1 row": Interval.of([_rms(e) for e in thin_errors])}
    lost = {
        name: Interval.of([float(np.isnan(e).mean()) for e in errors])
        for name, errors in (("20 rows", wide_errors), ("1 row", thin_errors))
    }

    figure, (left, right) = sheet(1, 2, 6.2, 4.4)
    first = surveys[0]
    plot.depth_image(first.image(POSE), camera, left, title="depth image and its strip")
    true = mean_ranges(_exact_strip(first, POSE, camera), camera).ranges_m
    plot.strip_ranges(first.scan(POSE).ranges_m, camera, true, right, title="what the strip becomes")
    numbers = {
        "pose": POSE,
        "rms_error_m": {name: vars(interval) for name, interval in rms.items()},
        "share_of_columns_without_reading": {name: vars(interval) for name, interval in lost.items()},
        "edge_range_over_depth": float(1 / np.cos(camera.bearings[0])),
        "range_error_at_the_edge_if_depth_is_taken_for_range_at_2_m": float(2 / np.cos(camera.bearings[0]) - 2),
    }
    return Outcome(
        figure,
        numbers,
        verdict_of([rms["20 rows"].high < rms["1 row"].low, lost["20 rows"].mean < lost["1 row"].mean]),
        f"ranges from 20 rows err by {1000 * rms['20 rows'].mean:.1f} mm, from one row by {1000 * rms['1 row'].mean:.1f} mm "
        f"(root mean square, {len(surveys)} surveys), and {100 * lost['20 rows'].mean:.1f} against "
        f"{100 * lost['1 row'].mean:.1f} % of the columns give no reading; the photograph 5.12 (a) cannot be computed",
        "Left: a depth image, near walls dark, far ones light, a blue frame round the 20 rows in the middle. Right: range and "
        "depth over the bearing; the range lies above the depth towards the edges and follows the true range.",
    )


def _exact_strip(one: DepthSurvey, pose: int, camera: DepthCamera) -> NDArray[np.uint16]:
    """The strip of a camera without faults."""
    return in_millimetres(one.depths[pose][camera.strip], camera.min_depth_m, camera.max_depth_m)


def _errors_m(one: DepthSurvey, camera: DepthCamera) -> NDArray[np.float64]:
    """(N, columns) errors of the ranges of a survey's first images, nan without a reading; walls alone, no edges."""
    errors = []
    for pose, depth in enumerate(one.depths):
        seen = disturb_depth(depth[camera.strip], DepthNoise(), one.draws[pose][0].rows(camera.strip))
        measured = mean_ranges(in_millimetres(seen, camera.min_depth_m, camera.max_depth_m), camera)
        true = mean_ranges(_exact_strip(one, pose, camera), camera)
        off = np.subtract(
            measured.ranges_m, true.ranges_m, out=np.full(camera.columns, np.nan), where=measured.valid & true.valid
        )
        errors.append(off[true.valid])
    return np.concatenate(errors)


def _rms(errors: NDArray[np.float64]) -> float:
    """Root mean square of what was measured."""
    return float(np.sqrt(np.nanmean(errors**2)))


def _prior_and_poses(rng: np.random.Generator) -> Outcome:
    """The plan as prior, the poses, and where the camera found obstacles: how far from the true walls?"""
    prior_map = build_prior_map(arena().walls, INFORMATIVE, FINE)
    alone = score_map(prior_map, arena().truth)
    seeds = seeds_of(rng)
    to_wall = cv2.distanceTransform((~arena().truth.walls).astype(np.uint8), cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
    near, median = [], []
    for seed in seeds:
        off = _distances_m(survey(seed), to_wall * arena().metres_per_pixel)
        near.append(float((off <= NEAR_WALL_M).mean()))
        median.append(float(np.median(off)))
    figure, (left, right) = sheet(1, 2, 5.4, 4.4)
    plot.map(prior_map, left, title=f"prior, cells of {FINE} px")
    plot.readings(survey(seeds[0]).readings(1), build_prior_map(arena().walls, INFORMATIVE, 1), right, title="poses and hits")
    share = Interval.of(near)
    return Outcome(
        figure,
        {
            "prior_alone_f2": alone.f_beta,
            "poses": len(arena().poses),
            "share_of_hits_within_5_cm_of_a_wall": vars(share),
            "median_distance_m": vars(Interval.of(median)),
        },
        verdict_of([alone.f_beta > 0.9, max(median) <= BOARD_M, share.high < 1]),
        f"the plan alone scores F2 {alone.f_beta:.2f} at cells of {FINE} px; {100 * share.mean:.0f} % of what the camera found "
        f"from {len(arena().poses)} poses lies within {100 * NEAR_WALL_M:.0f} cm of a true wall, although poses "
        f"were measured by hand",
        "Left: the arena's plan as prior map, three rooms, walls dark. Right: twelve poses with fans of rays, red dots where an "
        "obstacle was found, most of them on the walls.",
    )


def _distances_m(one: DepthSurvey, to_wall_m: NDArray[np.float32]) -> NDArray[np.float64]:
    """How far each point that the camera found lies from the nearest true wall."""
    readings = one.readings(1)
    hit = (readings.ranges <= readings.sensor.max_range) & (True if readings.valid is None else readings.valid)
    angles = (readings.poses[:, 2, None] + readings.bearings)[hit]
    start = np.repeat(readings.poses[:, :2], hit.sum(axis=1), axis=0)
    points = start + readings.ranges[hit][:, None] * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    grid = Grid(arena().truth.shape)
    row, col = grid.xy_to_pixel(points).T
    height, width = arena().truth.shape
    return to_wall_m[row.clip(0, height - 1), col.clip(0, width - 1)].astype(np.float64)


FIGURE_5_12 = Entry(
    "fig-5-12",
    "a depth image, its strip, and the ranges that it becomes",
    "Averaging a strip of 20 rows, not a thin one, keeps small errors of the sensor small in the 2-D reading.",
    _image_and_strip,
)
FIGURE_5_13 = Entry(
    "fig-5-13",
    "the arena's plan as prior, the poses, and what the camera found",
    "The plan is very accurate; what the camera finds lies along the walls, with errors.",
    _prior_and_poses,
)
