"""A figure of our own: what mapping costs as drawings and surveys grow. Times are measured: they differ from run to run."""

from __future__ import annotations

import numpy as np

from priorlab import plot
from priorlab.figures.figure import Entry, Outcome, sheet, verdict_of
from priorlab.study.scaling import cost_by_poses, cost_by_size, growth

LINEAR = 1.2
"""Growth exponents up to this count as linear: a sort's logarithm and a busy machine are in them."""

MOST_MB = 2000.0
"""Memory that the largest drawing may take."""


def _scaling(rng: np.random.Generator) -> Outcome:
    """Time by pixels (as many poses a room) and by poses (one drawing), and the memory of the largest drawing."""
    by_size, by_poses = cost_by_size(), cost_by_poses()
    sides, pixels, poses = ([getattr(one, name) for one in by_size] for name in ("side", "pixels", "poses"))
    pixel_work, pose_work = ([getattr(one, name) for one in by_size] for name in ("pixel_seconds", "pose_seconds"))
    denser, denser_work = [one.poses for one in by_poses], [one.pose_seconds for one in by_poses]
    figure, (left, right) = sheet(1, 2, 5.4, 4.0)
    plot.cost(
        pixels,
        {"ranges and evidence, a pose for 300 pixels": pose_work, "prior map, map, score and sweep": pixel_work},
        left,
        "four sizes, cells of 3 px",
    )
    plot.cost(denser, {"ranges and evidence": denser_work}, right, f"{by_poses[0].side:,} x {by_poses[0].side:,} px", "poses")
    exponents = {
        "pixel_work_by_pixels": growth(pixels, pixel_work),
        "pose_work_by_size": growth(poses, pose_work),
        "pose_work_by_poses": growth(denser, denser_work),
    }
    peak = by_size[-1].peak_mb
    return Outcome(
        figure,
        {
            "sides": sides,
            "poses": poses,
            "seconds": [one.seconds for one in by_size],
            "peak_mb": [one.peak_mb for one in by_size],
            "poses_on_one_drawing": denser,
            "seconds_on_one_drawing": denser_work,
            "growth": exponents,
            "measured": "times and memory of one machine, not the same twice",
        },
        verdict_of([*(exponent <= LINEAR for exponent in exponents.values()), peak < MOST_MB]),
        f"from {sides[0]:,} to {sides[-1]:,} pixels a side the work on pixels grows with their number to the power of "
        f"{exponents['pixel_work_by_pixels']:.2f}, that of the survey with the poses to the power of "
        f"{exponents['pose_work_by_size']:.2f} (on one drawing {exponents['pose_work_by_poses']:.2f}); the largest took "
        f"{pixel_work[-1] + pose_work[-1]:.1f} s and {peak:,.0f} MB",
        "Two log-log plots of seconds, over pixels and over poses; all lines run along the dotted lines of linear growth.",
    )


SCALING = Entry(
    "fig-scaling",
    "time and memory as drawings and surveys grow (ours; measured, so not the same twice)",
    "Cost grows linearly with pixels and poses, and a drawing of 4,000 x 4,000 pixels is mapped in less than 2 GB.",
    _scaling,
)
