"""The folder that `priorlab localize` leaves: the way, the map as it is today, and the numbers."""

from __future__ import annotations

import json
import re
import warnings
from pathlib import Path
from typing import Any

import numpy as np

from priorlab.core.files import new_folder
from priorlab.core.picture import encode_png
from priorlab.core.pose import compose
from priorlab.interchange.ros_map import Mode, write_ros_map
from priorlab.interchange.trajectories import write_tum
from priorlab.plot.maps import map as draw_map
from priorlab.report.own_log import OwnLog
from priorlab.report.own_log_verdict import Verdict
from priorlab.report.pictures import picture, size_for
from priorlab.slam.recording import Run
from priorlab.slam.run_file import save_run


def write_own_log(
    run: Run, own: OwnLog, verdict: Verdict, out: str | Path, command: str, force: bool = False, map_mode: Mode = "trinary"
) -> list[str]:
    """Write what came of it into a new folder; what there is to say about it, in sentences.

    run.npz; trajectory.tum, and corrected.tum when the log has such poses, in the frame of the map that came in; map.yaml and
    map.pgm, the map as it is today, for ROS; map.png, the same with the way; walls.png, what was taken for the walls of a
    drawing, black on white; numbers.json.
    """
    with new_folder(out, force) as folder, warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always", UserWarning)
        save_run(run, folder / "run.npz")
        ways = {"trajectory": run.trajectory, "corrected": None if verdict.corrected is None else verdict.corrected.truth}
        for name, way in ways.items():
            if way is not None:
                write_tum(folder / f"{name}.tum", compose(np.asarray(own.origin), way), run.log.stamps)
        write_ros_map(folder / "map.yaml", run.map, map_mode, own.origin)
        grid = run.map.grid
        drawn = picture(lambda ax: draw_map(run.map, ax, run.trajectory), "", "", size_for(grid.shape))
        (folder / "map.png").write_bytes(drawn.png)
        if own.walls is not None:
            (folder / "walls.png").write_bytes(encode_png(np.where(own.walls.mask, 0, 255).astype(np.uint8)))
        warned = [_with_typed_mode(str(one.message)) for one in told if issubclass(one.category, UserWarning)]
        notes = [*verdict.notes, *warned]
        numbers = numbers_of_run(run, own, verdict) | {"notes": notes, "command": command}
        (folder / "numbers.json").write_text(json.dumps(numbers, indent=2, allow_nan=False) + "\n")
    return notes


def _with_typed_mode(sentence: str) -> str:
    """The mode of a ROS map as one types it at the command line."""
    return re.sub(r"\bmode='(\w+)'", r"--map-mode \1", sentence)


def numbers_of_run(run: Run, own: OwnLog, verdict: Verdict) -> dict[str, Any]:
    """What can be measured of a run, unrounded; errors are None without corrected poses to hold it against."""
    corrected = verdict.corrected
    known = corrected is not None
    return {
        "steps": len(run),
        "lost": verdict.lost,
        "ate_m": run.ate_m(corrected) if known else None,
        "rpe_m": run.rpe_m(corrected) if known and len(run) > 1 else None,
        "rpe_deg": run.rpe_deg(corrected) if known and len(run) > 1 else None,
        "heading_error_deg": run.heading_error_deg(corrected) if known else None,
        "errors_are_aligned": not own.has_exact_start if known else None,
        "wheels_without_error": verdict.wheels_without_error if known else None,
        "particles": [int(run.n_particles.min()), int(run.n_particles.max())],
        "median_ess_share": float(np.median(run.ess / run.n_particles)),
        "median_beams_explained": verdict.explained,
        "walls_share_of_drawing": None if own.walls is None else float(own.walls.mask.mean()),
        "map_m": [side * run.map.grid.scale for side in run.map.grid.image_shape[::-1]],
        "cell_m": run.map.grid.cell_size_m,
        "max_range_m": run.parameters.max_range_m,
        "alphas": list(run.parameters.alphas),
        "temper": run.parameters.temper,
    }
