"""`priorlab localize`: a robot's log, made by the simulator, in a plan that is a ROS map or a drawing."""

import json
import os
import shutil
import signal
import subprocess
import sys
from dataclasses import replace

import cv2
import numpy as np
import pytest

from priorlab.cli import main
from priorlab.core.building import World
from priorlab.core.drawing import WALL, Walls
from priorlab.core.pose import compose
from priorlab.core.readings import RobotLog
from priorlab.core.sensor import Scanner
from priorlab.interchange.carmen_writing import write_carmen
from priorlab.interchange.ros_map import read_ros_map, write_ros_map
from priorlab.interchange.trajectories import read_tum
from priorlab.report.own_log import advice, drive_own_log, read_own_log
from priorlab.robot.drive import drive
from priorlab.slam.fastslam import FastSLAM
from priorlab.slam.parameters import TUNED
from priorlab.slam.record_file import pack_record, whole_records
from priorlab.slam.run_file import load_run
from priorlab.slam.run_inputs import arrays_of

PIXEL_M = 0.05
ORIGIN = (-10.0, 5.0, 0.5)
START = (1.0, 1.5, 0.0)


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """Two rooms of 10 x 5 m: as a drawing, as a ROS map that lies elsewhere and turned, and the log of a laser in them."""
    folder = tmp_path_factory.mktemp("place")
    walls = np.zeros((120, 220), dtype=bool)
    walls[10:110, 10:14], walls[10:110, 206:210], walls[10:14, 10:210], walls[106:110, 10:210] = True, True, True, True
    walls[10:110, 100:104] = True
    walls[60:78, 100:104] = False  # a way through
    cv2.imwrite(str(folder / "plan.png"), np.where(walls, 0, 255).astype(np.uint8))
    write_ros_map(folder / "plan.yaml", Walls((walls * WALL).astype(np.uint8), PIXEL_M), origin=ORIGIN)
    laser = Scanner(n_beams=181, field_of_view=np.pi, min_range_m=0.1, max_range_m=8.0)
    log = drive(
        World(walls, PIXEL_M), [START[:2], (3.0, 2.5), (8.0, 2.5), (8.5, 3.5)], laser, rng=np.random.default_rng(0), step_m=0.15
    )
    write_carmen(folder / "drive.log.gz", log)
    write_carmen(folder / "blind.log", RobotLog(log.odometry, log.ranges, log.bearings, log.scanner, log.start))
    return folder, log


def degrees_at(pose):
    """X, Y, DEGREES as a user types them."""
    return [f"{pose[0]:.9f}", f"{pose[1]:.9f}", f"{np.degrees(pose[2]):.9f}"]


def localize(folder, log_name, plan, out, start, *more):
    return [
        "localize", str(folder / log_name), "--map", str(folder / plan), "--start", *start, "--out", str(out), *more,
    ]  # fmt: skip


@pytest.fixture(scope="module")
def done(place, tmp_path_factory):
    """The command on the ROS map, once."""
    folder, log = place
    out = tmp_path_factory.mktemp("done") / "out"
    code = main(localize(folder, "drive.log.gz", "plan.yaml", out, degrees_at(compose(np.array(ORIGIN), log.start))))
    return out, code


def test_localize_writes_the_run_the_way_and_the_map(place, done):
    (_, log), (out, code) = place, done
    assert code == 0
    assert sorted(path.name for path in out.iterdir()) == [
        ".priorlab", "corrected.tum", "map.pgm", "map.png", "map.yaml", "numbers.json", "run.npz", "trajectory.tum",
    ]  # fmt: skip
    assert [path.name for path in out.parent.iterdir()] == ["out"]  # the drive's own file is gone
    run = load_run(out / "run.npz")
    numbers = json.loads((out / "numbers.json").read_text())
    assert numbers["ate_m"] == pytest.approx(run.ate_m(log), abs=1e-6) and run.ate_m(log) < 0.15
    assert numbers["lost"] is None and numbers["steps"] == len(log)
    assert cv2.imread(str(out / "map.png")).shape[0] > 100


def test_localize_keeps_every_percent_when_asked_and_tells_what_the_errors_are(place, tmp_path, capsys):
    (folder, log), out = place, tmp_path / "out"
    start = degrees_at(compose(np.array(ORIGIN), log.start))
    assert main(localize(folder, "drive.log.gz", "plan.yaml", out, start, "--map-mode", "scale")) == 0
    kept = read_ros_map(out / "map.yaml")
    percents = np.rint(100 * (1 - load_run(out / "run.npz").map.p_empty))
    assert kept.mode == "scale" and np.abs(kept.occupancy - percents).max() <= 1
    said = capsys.readouterr().out
    explained = json.loads((out / "numbers.json").read_text())["median_beams_explained"]
    assert f"the plan's walls explain {100 * explained:.0f} % of a scan's beams (median)" in said
    assert "they cannot tell a wrong start" in said and "corrected.tum" in said


def test_localize_says_in_a_sentence_that_the_start_is_near_a_wall(place, tmp_path, capsys):
    (folder, _), out = place, tmp_path / "out"
    start = ("0.8", "1.5", "0", "--metres-per-pixel", str(PIXEL_M))  # 0.1 m from the wall
    assert main(localize(folder, "blind.log", "plan.png", out, start)) in (0, 5)
    lines = [line for line in capsys.readouterr().out.splitlines() if "robot_radius_m" in line]
    assert lines == [
        "  start lies nearer to a wall than robot_radius_m, 0.15 m: walls do not hinder particles until they have left them"
    ]


def test_localize_speaks_in_the_frame_of_the_map_that_came_in(place, done):
    (_, log), (out, _) = place, done
    _, way = read_tum(out / "trajectory.tum")
    _, truth = read_tum(out / "corrected.tum")
    np.testing.assert_allclose(truth[:, :2], compose(np.array(ORIGIN), log.truth)[:, :2], atol=1e-6)
    ate = np.sqrt(np.mean(np.sum((way - truth)[:, :2] ** 2, axis=1)))
    assert ate == pytest.approx(load_run(out / "run.npz").ate_m(log), abs=1e-6)
    made, given = read_ros_map(out / "map.yaml"), read_ros_map(place[0] / "plan.yaml")
    assert made.origin == ORIGIN and made.grid == given.grid
    wall = given.occupancy == 100
    assert (made.occupancy[wall] == 100).mean() > 0.8 and (made.occupancy[~wall] == 100).mean() < 0.05


def test_localize_takes_a_drawing_and_a_log_without_truth(place, tmp_path, capsys):
    folder, _ = place
    command = localize(folder, "blind.log", "plan.png", tmp_path / "out", degrees_at(START), "--metres-per-pixel", "0.05")
    command[command.index("--start") + 3] = "26.565"  # towards the second corner
    assert main(command) == 0
    numbers = json.loads((tmp_path / "out" / "numbers.json").read_text())
    assert numbers["ate_m"] is None and numbers["lost"] is None and not (tmp_path / "out" / "corrected.tum").exists()
    assert numbers["map_m"] == pytest.approx([11, 6])
    said = capsys.readouterr().out
    assert "to go" in said and "ATE" not in said and "ESS" in said


def test_localize_starts_round_a_start_that_is_not_exact(place):
    folder, log = place
    off = compose(np.array(ORIGIN), log.start + [0.2, -0.1, np.radians(4)])
    own = read_own_log(folder / "drive.log.gz", folder / "plan.yaml", tuple(off), start_error=(0.2, np.radians(5)))
    assert own.parameters.start_variances == pytest.approx((0.04, 0.04, np.radians(5) ** 2))
    run = FastSLAM(own.parameters).run(own.prior_map, own.log, np.random.default_rng(0))
    assert np.hypot(*(run.trajectory - log.truth)[-1, :2]) < 0.1


def test_localize_says_when_the_robot_got_lost(place, tmp_path, capsys):
    folder, _ = place
    command = localize(folder, "drive.log.gz", "plan.png", tmp_path / "out", ["5.5", "4.9", "180"], "--metres-per-pixel", "0.05")
    assert main([*command, "--max-range", "3", "--wheel-noise", "0.001"]) == 5
    assert json.loads((tmp_path / "out" / "numbers.json").read_text())["lost"]
    assert "LOST (" in capsys.readouterr().out


def test_localize_goes_on_after_an_interruption(place, done, tmp_path):
    """Ctrl-C in another process; what comes of the rest is what came of the whole."""
    folder, log = place
    out = tmp_path / "out"
    command = localize(folder, "drive.log.gz", "plan.yaml", out, degrees_at(compose(np.array(ORIGIN), log.start)))
    driver = subprocess.Popen(
        [sys.executable, "-u", "-m", "priorlab.cli", *command],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # a CI in the background is deaf to Ctrl-C
    )
    for line in driver.stdout:
        if "  step " in line and int(line.split()[1]) >= 55:
            driver.send_signal(signal.SIGINT)
            break
    _, said = driver.communicate(timeout=60)
    assert driver.returncode == 130 and "interrupted" in said
    assert [path.name for path in tmp_path.iterdir()] == ["out.part"]
    assert main([*command, "--resume"]) == 0
    assert [path.name for path in tmp_path.iterdir()] == ["out"]
    np.testing.assert_array_equal(load_run(out / "run.npz").trajectory, load_run(done[0] / "run.npz").trajectory)
    assert (out / "map.pgm").read_bytes() == (done[0] / "map.pgm").read_bytes()


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (
            {"--map": "plan.png"},
            "--metres-per-pixel must be given with a drawing: a robot's ranges are in metres, got none; for a",
        ),
        ({"--metres-per-pixel": "0.1"}, "--metres-per-pixel must not be given with a ROS map"),
        ({"--map": "none.yaml"}, "the map's yaml must be a file, found none"),
        ({"log": "none.log"}, "the log must be a file, found none"),
        ({"log": "plan.png"}, "a CARMEN log must be text"),
        (
            {"start": ["0", "0", "0"]},
            "priorlab: --start must lie on the map, which reaches 11.00 x 6.00 m from x -10, y 5, got x 0, y 0 m",
        ),
        ({"start": ["nan", "0", "0"]}, "start must be finite numbers"),
        ({"--max-range": "-1"}, "priorlab: --max-range must be a finite number above 0, got -1"),
        ({"--wheel-noise": "-0.1"}, "priorlab: --wheel-noise must be a finite number of at least 0, got -0.1"),
        ({"--wheel-noise": "1e300"}, "priorlab: --wheel-noise must be at most 1e+06, got 1e+300"),
        ({"start": ["1e308", "0", "0"]}, "priorlab: --start must lie within 1e+06 m, got x 1e+308, y 0 m"),
        ({"--max-range": "1e300"}, "priorlab: --max-range must lie between 1e-06 and 1e+06, got 1e+300"),
        ({"--temper": "1.5"}, "priorlab: --temper must lie in (0, 1], got 1.5"),
        ({"--wheel-noise": "nan"}, "priorlab: --wheel-noise must be a finite number of at least 0, got nan"),
        ({"--resume": None}, "a checkpoint must lie at"),
        ({"--start-error": ["1e200", "5"]}, "priorlab: --start-error must be at most 1e+06, got 1e+200 m"),
        ({"--start-error": ["nan", "5"]}, "--start-error must be a finite number, got nan"),
        ({"--start-error": ["-1", "0"]}, "--start-error must not be negative, got -1 m, 0 radians"),
    ],
)
def test_localize_says_what_is_wrong(place, tmp_path, capsys, change, sentence):
    folder, log = place
    start = change.get("start", degrees_at(compose(np.array(ORIGIN), log.start)))
    command = localize(folder, change.get("log", "drive.log.gz"), change.get("--map", "plan.yaml"), tmp_path / "out", start)
    for name in ("--metres-per-pixel", "--max-range", "--wheel-noise", "--temper", "--resume"):
        command += [] if name not in change else [name] if change[name] is None else [f"{name}={change[name]}"]
    command += ["--start-error", *change["--start-error"]] if "--start-error" in change else []
    assert main(command) == 2
    said = capsys.readouterr().err
    assert sentence in said and said.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_localize_guards_a_drive_that_was_interrupted(place, tmp_path, capsys):
    folder, log = place
    start = degrees_at(compose(np.array(ORIGIN), log.start))
    (tmp_path / "out.part").write_bytes(b"torn")
    command = localize(folder, "drive.log.gz", "plan.yaml", tmp_path / "out", start)
    assert main(command) == 2
    assert "holds a drive that was interrupted: go on with --resume, or begin anew with --force" in capsys.readouterr().err
    assert main([*command, "--resume"]) == 2
    assert "must be a checkpoint that priorlab wrote, got a damaged file" in capsys.readouterr().err
    assert (tmp_path / "out.part").read_bytes() == b"torn"


@pytest.fixture(scope="module")
def begun(place, tmp_path_factory):
    """A drive that was begun with seed 3 in the drawing, and interrupted after its first step; the command for it."""
    folder, log = place
    out = tmp_path_factory.mktemp("begun") / "out"
    own = read_own_log(folder / "blind.log", folder / "plan.png", START, 0.05, max_range_m=6.0)

    def stop(done, to_do):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        drive_own_log(own, out.with_name("out.part"), seed=3, progress=stop)
    return {
        "--map": [str(folder / "plan.png")], "--metres-per-pixel": ["0.05"], "--start": ["1", "1.5", "0"],
        "--max-range": ["6"], "--out": [str(out)], "--resume": [],
    }  # fmt: skip


def resumed(folder, options, log_name="blind.log"):
    """The exit code of localize with these options."""
    return main(["localize", str(folder / log_name), *(word for name, words in options.items() for word in (name, *words))])


@pytest.mark.parametrize(
    ("change", "named"),
    [
        ({"--seed": ["4"]}, "another --seed"),
        ({"--seed": ["0"]}, "another --seed"),
        ({"--start": ["1.1", "1.5", "0"]}, "another --start"),
        ({"--start-error": ["0.1", "5"]}, "another --start-error (0 0)"),
        ({"--max-range": ["5"]}, "another --max-range (6)"),
        ({"--wheel-noise": ["0.02"]}, "another --wheel-noise (0.01)"),
        ({"--temper": ["0.2"]}, "another --temper (0.05)"),
        ({"--metres-per-pixel": ["0.1"], "--start": ["1", "1.5", "0"]}, "another --map"),  # as many cells, twice as large
        ({"--seed": ["4"], "--max-range": ["5"]}, "another --max-range (6) and another --seed"),
    ],
)
def test_localize_goes_on_with_the_numbers_of_its_drive_only(place, begun, capsys, change, named):
    part = begun["--out"][0] + ".part"
    with open(part, "rb") as file:
        before = file.read()
    assert resumed(place[0], begun | change) == 2
    told, said = capsys.readouterr()
    assert said == f"priorlab: {part} began with {named}: give the same, or begin anew with --force\n"
    assert "FastSLAM" not in told  # nothing is announced that is then refused
    with open(part, "rb") as file:
        assert file.read() == before


def test_localize_goes_on_with_the_log_of_its_drive_only(place, begun, tmp_path, capsys):
    lines = (place[0] / "blind.log").read_text().splitlines(keepends=True)
    (tmp_path / "shorter.log").write_text("".join(lines[:-1]))
    assert resumed(place[0], begun, tmp_path / "shorter.log") == 2
    assert ".part began with another log: give the same" in capsys.readouterr().err


def test_localize_does_not_go_on_with_other_numbers_of_its_own(place, begun, monkeypatch, capsys):
    monkeypatch.setattr("priorlab.report.own_log.TUNED", replace(TUNED, n_beams=TUNED.n_beams + 1))
    assert resumed(place[0], begun) == 2
    said = capsys.readouterr().err
    assert said.endswith(".part began with other numbers of priorlab's own than today's; begin anew with --force\n")


def test_localize_says_when_an_older_priorlab_began(place, begun, tmp_path, capsys):
    with open(begun["--out"][0] + ".part", "rb") as file:
        first, *more = whole_records(file.read())[0]
    arrays = arrays_of(first)
    arrays["words"] = np.array(str(arrays["words"]).replace("priorlab checkpoint 3", "priorlab checkpoint 2"))
    (tmp_path / "out.part").write_bytes(b"".join(map(pack_record, [arrays, *map(arrays_of, more)])))
    assert resumed(place[0], begun | {"--out": [str(tmp_path / "out")]}) == 2
    said = capsys.readouterr().err
    assert said == f"priorlab: {tmp_path / 'out.part'} was written by an older priorlab; begin anew with --force\n"


@pytest.mark.parametrize("seed", [None, 3])
def test_localize_goes_on_with_the_seed_of_its_drive(place, begun, tmp_path, seed):
    """The seed need not be told again; told, it is the same."""
    folder, out = place[0], tmp_path / "out"
    shutil.copy(begun["--out"][0] + ".part", tmp_path / "out.part")
    assert resumed(folder, begun | {"--out": [str(out)]} | ({} if seed is None else {"--seed": [str(seed)]})) in (0, 5)
    own = read_own_log(folder / "blind.log", folder / "plan.png", START, 0.05, max_range_m=6.0)
    whole = FastSLAM(own.parameters).run(own.prior_map, own.log, np.random.default_rng(3))
    np.testing.assert_array_equal(load_run(out / "run.npz").trajectory, whole.trajectory)


@pytest.mark.parametrize(("every", "temper", "told"), [(1, 0.05, False), (8, 0.05, True), (8, 0.2, False)])
def test_localize_advises_when_scans_lie_far_apart(place, tmp_path, every, temper, told):
    """The robot of this log makes steps of 0.15 m."""
    folder, log = place
    few = RobotLog(log.odometry[::every], log.ranges[::every], log.bearings, log.scanner, log.start)
    own = read_own_log(write_carmen(tmp_path / "few.log", few), folder / "plan.png", START, 0.05, temper=temper)
    sentence = advice(own)
    assert (sentence is not None) == told
    assert not told or ("m apart (median)" in sentence and "--temper 0.2" in sentence)


def test_localize_points_from_the_image_of_a_ros_map_to_its_yaml(place, tmp_path, capsys):
    folder, _ = place
    assert main(localize(folder, "blind.log", "plan.pgm", tmp_path / "out", degrees_at(START))) == 2
    said = capsys.readouterr().err
    assert "priorlab: --map must be the yaml of a ROS map or a drawing, got the image of a ROS map" in said
    assert f"give {folder / 'plan.yaml'}, which lies beside it" in said
    (tmp_path / "alone.pgm").write_bytes((folder / "plan.pgm").read_bytes())
    assert main(localize(folder, "blind.log", tmp_path / "alone.pgm", tmp_path / "out", degrees_at(START))) == 2
    assert "no yaml of its name lies beside it" in capsys.readouterr().err


def test_localize_fills_an_empty_folder(place, tmp_path):
    folder, _ = place
    (tmp_path / "out").mkdir()
    command = localize(folder, "blind.log", "plan.png", tmp_path / "out", degrees_at(START), "--metres-per-pixel", "0.05")
    assert main(command) in (0, 5)
    assert (tmp_path / "out" / "run.npz").exists() and [path.name for path in tmp_path.iterdir()] == ["out"]


def test_localize_goes_on_with_its_own_drive_only(place, tmp_path, capsys):
    folder, log = place
    own = read_own_log(folder / "blind.log", folder / "plan.yaml", tuple(compose(np.array(ORIGIN), log.start)))

    def stop(done, to_do):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        drive_own_log(own, tmp_path / "out.part", seed=0, progress=stop)
    elsewhere = compose(np.array(ORIGIN), log.start + [0.1, 0, 0])
    command = localize(folder, "blind.log", "plan.yaml", tmp_path / "out", degrees_at(elsewhere), "--resume")
    assert main(command) == 2
    assert f"{tmp_path / 'out.part'} began with another --start: give the same" in capsys.readouterr().err
    assert os.listdir(tmp_path) == ["out.part"]
