"""The example of docs/own_robot.md runs as printed, on the small floor of these tests."""

import re
from pathlib import Path

import numpy as np

from priorlab.core.drawing import WALL, Walls
from priorlab.interchange.carmen_writing import write_carmen
from priorlab.interchange.ros_map import read_ros_map, write_ros_map
from priorlab.slam.run_file import load_run

PAGE = Path(__file__).resolve().parents[2] / "docs" / "own_robot.md"


def test_the_example_of_the_page_runs(tmp_path, monkeypatch, capsys, floor, drive_log):
    monkeypatch.chdir(tmp_path)
    write_ros_map("floor.yaml", Walls((floor[0] * WALL).astype(np.uint8), metres_per_pixel=0.05))
    write_carmen("drive.log.gz", drive_log)
    (example,) = re.findall(r"```python\n(.*?)```", PAGE.read_text(), re.DOTALL)
    names: dict = {}
    exec(example, names)
    assert re.match(r"270 steps, ATE 0\.\d+ m, RPE ", capsys.readouterr().out)
    assert not names["run"].lost
    np.testing.assert_array_equal(load_run("run.npz").map.log_odds, names["run"].map.log_odds)
    assert abs(read_ros_map("found.yaml").p_empty - names["run"].map.p_empty).max() < 0.008
    assert Path("run.npz").stat().st_size < 2000 * 270


def test_the_page_names_the_options_that_there_are(capsys):
    from priorlab.cli import main

    try:
        main(["localize", "--help"])
    except SystemExit as left:
        assert left.code == 0
    told = capsys.readouterr().out
    named = set(re.findall(r"(?<!-)--[a-z][a-z-]+", PAGE.read_text()))
    assert named and all(option in told for option in named)
