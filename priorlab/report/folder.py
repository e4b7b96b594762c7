"""The folder of results: the report, pictures that other programs read, the numbers, the recorded run, the map for ROS."""

from __future__ import annotations

import json
from pathlib import Path

from priorlab.core.files import new_folder
from priorlab.core.picture import encode_png, grey_of
from priorlab.interchange.ros_map import write_ros_map
from priorlab.pipeline import PipelineResult
from priorlab.report.numbers import numbers_of
from priorlab.report.page import write_report
from priorlab.slam.run_file import save_run


def write_results(result: PipelineResult, out: str | Path, command: str, force: bool = False) -> None:
    """Write everything that a result has into a new folder; it appears only when it is whole.

    report.html, numbers.json, walls.png; with walls prior_map.png, with a survey posterior.png (grey = 255 P(empty), as large
    as the drawing); with a scale ros_map.yaml and ros_map.pgm, the extracted walls; with a drive fastslam.npz, which
    `priorlab.slam.run_file.load_run` reads.

    Raises
    ------
    FileExistsError
        When `out` exists and `force` is not given.
    """
    with new_folder(out, force) as folder:
        write_report(result, folder / "report.html", command)
        numbers = numbers_of(result) | {"command": command}
        (folder / "numbers.json").write_text(json.dumps(numbers, indent=2, allow_nan=False) + "\n")
        (folder / "walls.png").write_bytes(encode_png(grey_of(~result.walls.mask), 6))
        maps = {"prior_map": result.prior_map, "posterior": result.mapping.informed if result.mapping else None}
        for name, grid_map in maps.items():
            if grid_map is not None:
                (folder / f"{name}.png").write_bytes(encode_png(grey_of(grid_map.grid.to_image(grid_map.p_empty)), 6))
        if result.has_walls and result.scale.metres_per_pixel is not None:
            write_ros_map(folder / "ros_map.yaml", result.walls)
        if result.drive is not None:
            save_run(result.drive.run, folder / "fastslam.npz")
