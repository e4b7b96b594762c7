"""The examples of docs/map_without_a_plan.md run as printed, on a small hall."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np

from priorlab.core.building import World
from priorlab.core.sensor import Odometry, Scanner
from priorlab.interchange.carmen_writing import write_carmen
from priorlab.interchange.ros_map import read_ros_map
from priorlab.interchange.trajectories import read_tum
from priorlab.robot.drive import drive

PAGE = Path(__file__).resolve().parents[2] / "docs" / "map_without_a_plan.md"


def test_the_examples_of_the_page_run(tmp_path, monkeypatch, capsys):
    obstacles = np.zeros((100, 160), dtype=bool)
    obstacles[[0, -1]] = obstacles[:, [0, -1]] = True
    obstacles[30:36, 50:56] = obstacles[60:66, 110:116] = True
    sick = Scanner(181, np.pi, 0.1, 15.0, 0.01, 0.0, 0.0)
    truth = []
    for seed, day in enumerate(("monday", "tuesday")):
        wheels = Odometry((0.02, 0.02, 0.02, 0.02))
        log = drive(World(obstacles, 0.05), [[1, 1], [4, 1], [4, 2.5]], sick, wheels, np.random.default_rng(seed))
        truth.append(log.truth)
        write_carmen(tmp_path / f"{day}.log.gz", replace(log, truth=None, stamps=np.arange(len(log)) / 4))
    monkeypatch.chdir(tmp_path)
    names: dict = {}
    for example in re.findall(r"```python\n(.*?)```", PAGE.read_text(), re.DOTALL):
        exec(example, names)
    mapped, lost = capsys.readouterr().out.splitlines()
    assert mapped.startswith("MatchedDrive(52 scans, ") and lost == "False"
    first = names["drive"].trajectory
    for way, true in ((first, truth[0]), (names["run"].trajectory, truth[1])):
        assert np.hypot(*((way - first[0]) - (true - true[0]))[:, :2].T).max() < 0.15
    np.testing.assert_allclose(read_tum("way.tum")[1], first, atol=1e-6)
    assert abs(read_ros_map("own.yaml").p_empty - names["drive"].map.p_empty).max() < 0.008
