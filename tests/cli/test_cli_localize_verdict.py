"""What `priorlab localize` says of its numbers: when errors mean nothing, and when start, map or walls are wrong."""

import json
import re
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest
from scipy.optimize import minimize

from priorlab.cli import main
from priorlab.core.building import World
from priorlab.core.drawing import WALL, Walls
from priorlab.core.pose import compose
from priorlab.core.sensor import Scanner
from priorlab.interchange.carmen_writing import write_carmen
from priorlab.interchange.ros_map import read_ros_map, write_ros_map
from priorlab.interchange.trajectories import read_tum
from priorlab.report.own_log import read_own_log, told_of_walls
from priorlab.report.own_log_verdict import aligned, has_wheels_without_error, judge
from priorlab.robot.drive import drive
from priorlab.slam.run_file import load_run

PIXEL_M = 0.05
START = (1.0, 1.5)


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """A room of 10 x 5 m with a wall into it: as a drawing, as a ROS map, and a log of a laser in it, with its true poses."""
    folder = tmp_path_factory.mktemp("place")
    walls = np.zeros((120, 220), dtype=bool)
    walls[10:110, 10:14], walls[10:110, 206:210], walls[10:14, 10:210], walls[106:110, 10:210] = True, True, True, True
    walls[10:60, 100:104] = True
    cv2.imwrite(str(folder / "plan.png"), np.where(walls, 0, 255).astype(np.uint8))
    write_ros_map(folder / "plan.yaml", Walls((walls * WALL).astype(np.uint8), PIXEL_M))
    laser = Scanner(n_beams=181, field_of_view=np.pi, min_range_m=0.1, max_range_m=8.0)
    log = drive(World(walls, PIXEL_M), [START, (3.0, 2.0), (8.0, 2.0)], laser, rng=np.random.default_rng(0), step_m=0.15)
    write_carmen(folder / "drive.log", log)
    write_carmen(folder / "corrected_only.log", replace(log, odometry=log.truth))
    return folder, log, walls


def localize(folder, log_name, plan, pose, out, *more):
    """Exit code and numbers."""
    x, y, theta = pose
    start = [f"{x:.9f}", f"{y:.9f}", f"{np.degrees(theta):.9f}"]
    command = ["localize", str(folder / log_name), "--map", str(folder / plan), "--start", *start, "--out", str(out)]
    code = main([*command, *more])
    return code, json.loads((out / "numbers.json").read_text())


@pytest.fixture(scope="module")
def done(place, tmp_path_factory):
    """A good run and what it came from."""
    folder, log, _ = place
    out = tmp_path_factory.mktemp("done") / "out"
    code, numbers = localize(folder, "drive.log", "plan.yaml", log.start, out)
    return code, numbers, load_run(out / "run.npz"), read_own_log(folder / "drive.log", folder / "plan.yaml", tuple(log.start))


def test_judge_finds_nothing_wrong_with_a_good_run(done):
    code, numbers, run, own = done
    assert code == 0 and numbers["lost"] is None and numbers["ate_m"] < 0.15
    assert numbers["wheels_without_error"] is False and numbers["errors_are_aligned"] is False
    assert not any("WARNING" in note or "no error" in note for note in numbers["notes"])
    assert judge(run, own).corrected is own.corrected


def test_localize_says_when_the_wheels_are_the_corrected_poses(place, tmp_path, capsys):
    folder, log, _ = place
    code, numbers = localize(folder, "corrected_only.log", "plan.yaml", log.start, tmp_path / "out")
    assert code == 0 and numbers["wheels_without_error"] is True
    sentence = "the log keeps only corrected poses, its wheels have no error: the errors say nothing about those of your robot"
    assert sentence in capsys.readouterr().out and sentence in numbers["notes"]


def test_has_wheels_without_error_whatever_frame_the_wheels_count_in(place):
    _, log, _ = place
    elsewhere = compose([30.0, -7.0, 2.0], log.truth)
    assert has_wheels_without_error(replace(log, odometry=elsewhere, start=np.array([9.0, 9.0, 1.0])))
    elsewhere[20:, 0] += 0.01  # a centimetre of slip
    assert not has_wheels_without_error(replace(log, odometry=elsewhere))
    assert not has_wheels_without_error(replace(log, truth=None)) and not has_wheels_without_error(None)


def test_localize_does_not_score_a_recovery_as_an_error(place, tmp_path, capsys):
    """The start is 0.36 m and 8 degrees off, as the user says it may be; the filter finds itself."""
    folder, log, _ = place
    off = log.start + [0.3, -0.2, np.radians(8)]
    out = tmp_path / "out"
    code, numbers = localize(folder, "drive.log", "plan.yaml", off, out, "--start-error", "0.3", "8")
    way, found = load_run(out / "run.npz").trajectory, numbers["ate_m"]
    assert np.hypot(*(way - log.truth)[-10:, :2].T).max() < 0.15  # it did find itself
    assert code == 0 and numbers["errors_are_aligned"] is True and numbers["lost"] is None
    assert found < 0.2 and numbers["heading_error_deg"] < 2
    assert "aligned with the estimate, as the start is not exact" in capsys.readouterr().out
    truth, estimate = (read_tum(out / f"{name}.tum")[1] for name in ("corrected", "trajectory"))
    assert np.sqrt(np.mean(np.sum((truth - estimate)[:, :2] ** 2, axis=1))) == pytest.approx(found, abs=1e-6)


def test_aligned_is_the_best_of_all_ways_to_lay_one_on_the_other():
    """A search over turns and moves finds none that is nearer."""
    rng = np.random.default_rng(3)
    way = np.cumsum(rng.normal(0, 0.5, (30, 3)), axis=0)
    estimate = compose([4.0, -2.0, 2.5], way) + rng.normal(0, 0.2, (30, 3))

    def apart(laid):
        ahead = [poses[:, :2] + np.column_stack([np.cos(poses[:, 2]), np.sin(poses[:, 2])]) for poses in (laid, estimate)]
        return ((laid - estimate)[:, :2] ** 2).sum() + ((ahead[0] - ahead[1]) ** 2).sum()

    best = min(minimize(lambda by: apart(compose(by, way)), [0, 0, turn]).fun for turn in (0.0, 2.0, 4.0))
    assert apart(aligned(way, estimate)) == pytest.approx(best, rel=1e-6)


def test_aligned_knows_the_direction_of_a_robot_that_stands():
    standing = np.tile([2.0, 1.0, 0.3], (5, 1))
    np.testing.assert_allclose(aligned(standing, standing + [1, 1, 0.5]), standing + [1, 1, 0.5], atol=1e-12)


@pytest.mark.parametrize(
    ("by", "is_lost"),
    [
        ((0.0, 0.9, 0.0), False),
        ((0.0, 1.3, 0.0), True),
        ((0.0, 0.0, 0.3), True),  # 7 m along at 17 degrees: 2 m off
    ],
)
def test_judge_takes_a_way_far_off_the_corrected_one_for_lost(done, by, is_lost):
    _, _, run, own = done
    moved = replace(run, trajectory=compose(by, own.corrected.truth), explained=np.full(len(run), 0.9))
    lost = judge(replace(moved, log=replace(own.log, truth=None)), own).lost
    assert (lost is not None) == is_lost
    assert not is_lost or "did not follow the log's corrected way: the start or the map is wrong" in lost


def test_judge_takes_a_wrong_heading_for_lost(done):
    _, _, run, own = done
    turned = own.corrected.truth + [0, 0, np.radians(25)]
    lost = judge(replace(run, trajectory=turned), own).lost
    assert lost is not None and "at worst 0.0 m off, and 25 degrees in the median" in lost


def test_judge_asks_the_whole_way_when_the_start_is_not_exact(place, done):
    """The beginning may be off by more than a metre; a way of another shape may not."""
    folder, log, _ = place
    run, own = done[2], read_own_log(folder / "drive.log", folder / "plan.yaml", tuple(log.start), start_error=(1.0, 0.2))
    recovered = own.corrected.truth.copy()
    recovered[:10, 1] += np.linspace(2.2, 0, 10)
    bent = own.corrected.truth.copy()
    bent[:, 0] = 1 + 0.4 * (bent[:, 0] - 1)
    verdict = judge(replace(run, trajectory=recovered), own)
    assert np.hypot(*(recovered - verdict.corrected.truth)[0, :2]) > 1.2 and verdict.lost is None
    assert "the start or the map is wrong" in judge(replace(run, trajectory=bent), own).lost


@pytest.mark.parametrize(("share", "warned"), [(0.35, True), (0.45, False), (0.95, False)])
def test_judge_warns_when_the_plan_explains_little(done, share, warned):
    _, _, run, own = done
    notes = judge(replace(run, explained=np.full(len(run), share)), own).notes
    assert any(note.startswith("WARNING: below 40 %") for note in notes) == warned
    assert any(f"explain {100 * share:.0f} % of a scan's beams" in note for note in notes)


def test_localize_in_another_building_is_lost(place, tmp_path, capsys):
    """Nothing but a long corridor at 40 degrees to the room that the log is of."""
    folder, log, _ = place
    rows, cols = np.mgrid[:400, :400]
    across = (cols - 200) * np.sin(0.7) + (rows - 200) * np.cos(0.7)
    walls = (np.abs(np.abs(across) - 25) < 2) & (np.hypot(cols - 200, rows - 200) < 190)
    write_ros_map(tmp_path / "other.yaml", Walls((walls * WALL).astype(np.uint8), PIXEL_M))
    code, numbers = localize(folder, "drive.log", tmp_path / "other.yaml", (10, 10, log.start[2]), tmp_path / "out")
    assert code == 5 and numbers["lost"]
    assert "LOST (" in capsys.readouterr().out


def test_localize_exits_with_lost_when_the_start_is_wrong(place, tmp_path, capsys):
    """The filter finds back from 12 degrees, so it shows no sign of being lost; but the corrected way lies elsewhere."""
    folder, log, _ = place
    off = log.start + [0, 0, np.radians(12)]
    code, numbers = localize(folder, "drive.log", "plan.yaml", off, tmp_path / "out")
    assert load_run(tmp_path / "out" / "run.npz").lost_because is None
    assert code == 5 and "the start or the map is wrong" in numbers["lost"]
    assert "\n  LOST (the robot did not follow the log's corrected way" in capsys.readouterr().out


def test_localize_leaves_the_walls_that_it_found_in_a_drawing(place, tmp_path, capsys):
    folder, log, walls = place
    out = tmp_path / "out"
    _, numbers = localize(folder, "drive.log", "plan.png", log.start, out, "--metres-per-pixel", "0.05")
    found = cv2.imread(str(out / "walls.png"), cv2.IMREAD_GRAYSCALE) == 0
    assert found.shape == walls.shape and (found & walls).sum() > 0.9 * walls.sum()
    assert numbers["walls_share_of_drawing"] == pytest.approx(found.mean())
    told = capsys.readouterr().out
    sentence = f"walls were found on {100 * found.mean():.0f} % of the drawing (walls.png)"
    assert told.index(sentence) < told.index("FastSLAM on")  # before the drive, which may be long
    assert "walls.png, run.npz" in told and "other ink" not in told


@pytest.mark.parametrize(("rows", "warned"), [(1, False), (2, True)])
def test_told_of_walls_warns_when_a_fifth_of_the_drawing_is_wall(done, rows, warned):
    own = done[3]
    labels = np.zeros((10, 10), dtype=np.uint8)
    labels[:rows] = WALL
    told = told_of_walls(replace(own, walls=Walls(labels, PIXEL_M)))
    assert f"{10 * rows} % of the drawing" in told and ("more than walls take up" in told) == warned
    assert told_of_walls(own) is None


def test_localize_names_the_mode_of_its_map_as_one_types_it(place, tmp_path, capsys):
    """A robot that has seen little of the plan: most of the space becomes unknown in trinary."""
    folder, log, _ = place
    _, numbers = localize(folder, "drive.log", "plan.yaml", log.start, tmp_path / "out", "--max-range", "0.8")
    told = capsys.readouterr().out
    assert "use --map-mode scale, or" in told and "mode='" not in told + " ".join(numbers["notes"])


def test_the_yaml_of_the_page_makes_a_map_of_a_clean_plan(place, tmp_path):
    """Black pixels are walls, all others are free: nothing was searched for."""
    _, _, walls = place
    (yaml,) = re.findall(
        r"```yaml\n(.*?)```", (Path(__file__).resolve().parents[2] / "docs" / "own_robot.md").read_text(), re.DOTALL
    )
    (tmp_path / "floor.yaml").write_text(yaml)
    cv2.imwrite(str(tmp_path / "floor.png"), np.where(walls, 0, 255).astype(np.uint8))
    ros = read_ros_map(tmp_path / "floor.yaml")
    np.testing.assert_array_equal(ros.occupancy, np.where(walls, 100, 0))
    assert len(yaml.splitlines()) == 6 and ros.grid.cell_size_m == 0.02
