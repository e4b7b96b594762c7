"""CARMEN logs: drives of our simulator written, read again, and read by a slow parser of its own; then logs made by hand.

The real ones lie where PRIORLAB_REAL_DATA says.
"""

import gzip
import os
import re
from pathlib import Path

import numpy as np
import pytest

from priorlab.buildings.floor_plans import load_floor_plan
from priorlab.core.readings import RobotLog
from priorlab.core.sensor import KINECT, Scanner
from priorlab.interchange.carmen import read_carmen
from priorlab.interchange.carmen_writing import write_carmen
from priorlab.robot.drive import drive

SICK = Scanner(n_beams=181, field_of_view=np.pi, min_range_m=0.1, max_range_m=8.0)


def slow_read(text):
    """Ranges, first and second poses and stamps of the scans, by regular expressions on whole lines."""
    number = r"(?:[-+]?[\d.]+(?:[eE][-+]?\d+)?)"
    rows = []
    for line in text.splitlines():
        if found := re.fullmatch(rf"FLASER (\d+)((?: {number})+) (\S+) \S+ \S+", line):
            numbers = [float(word) for word in found[2].split()]
            ranges, poses = numbers[: int(found[1])], numbers[int(found[1]) :]
        elif found := re.fullmatch(rf"ROBOTLASER1(?: {number}){{7}} (\d+)((?: {number})+) (\S+) \S+ \S+", line):
            numbers = [float(word) for word in found[2].split()]
            ranges, rest = numbers[: int(found[1])], numbers[int(found[1]) :]
            poses = rest[1 + int(rest[0]) :][:6]
        else:
            continue
        rows.append((ranges, poses[:3], poses[3:], float(found[3])))
    return [np.array(column) for column in zip(*rows, strict=True)]


@pytest.fixture(scope="module")
def drives():
    """A round through a bundled building, once with the Kinect's beams and once with a laser's half circle."""
    floor = load_floor_plan("busy_flat")
    rng = np.random.default_rng(3)
    return {name: drive(floor.world, floor.tour[:4], scanner, rng=rng) for name, scanner in (("kinect", KINECT), ("sick", SICK))}


def log_by_hand(n=3, truth=None, stamps=None, ranges=None):
    odometry = np.column_stack([np.arange(n), np.zeros(n), np.zeros(n)])
    ranges = np.full((n, 180), 2.5) if ranges is None else ranges
    bearings = np.radians(np.arange(180) - 90.0)
    return RobotLog(odometry, ranges, bearings, Scanner(180, 3.0, 0.0, 30.0), odometry[0], truth, stamps)


def flaser(ranges="2.5 " * 180, poses="1 2 0.5 1 2 0.5", stamp=7.0, n=180):
    return f"FLASER {n} {ranges} {poses} {stamp} robot {stamp}\n"


@pytest.mark.parametrize(("name", "message"), [("kinect", "ROBOTLASER1"), ("sick", "FLASER")])
@pytest.mark.parametrize("suffix", [".log", ".log.gz"])
def test_read_carmen_reads_what_was_written(tmp_path, drives, name, message, suffix):
    log = drives[name]
    path = write_carmen(tmp_path / f"a{suffix}", log)
    assert (path.read_bytes()[:2] == b"\x1f\x8b") == (suffix == ".log.gz")
    again = read_carmen(path)
    np.testing.assert_array_equal(again.odometry, log.odometry)
    np.testing.assert_array_equal(again.truth, log.truth)
    np.testing.assert_array_equal(again.start, log.start)
    np.testing.assert_allclose(again.bearings, log.bearings, atol=1e-12)
    np.testing.assert_array_equal(again.ranges, np.where(np.isfinite(log.ranges), log.ranges, np.nan))
    assert np.isnan(again.ranges).any() and again.stamps is None and again.scanner.max_range_m == log.scanner.max_range_m


@pytest.mark.parametrize("name", ["kinect", "sick"])
def test_read_carmen_agrees_with_a_slow_parser(tmp_path, drives, name):
    path = write_carmen(tmp_path / "a.log", drives[name])
    ranges, poses, wheels, stamps = slow_read(path.read_text())
    log = read_carmen(path)
    assert len(log) == len(ranges) == len(drives[name]) and not stamps.any()
    np.testing.assert_array_equal(log.truth, poses)
    np.testing.assert_array_equal(log.odometry, wheels)
    np.testing.assert_array_equal(log.ranges, np.where(ranges >= drives[name].scanner.max_range_m, np.nan, ranges))


@pytest.mark.parametrize(("n", "last"), [(180, 89), (181, 90), (360, 89.5), (361, 90)])
def test_read_carmen_knows_the_angles_of_flaser(tmp_path, n, last):
    (tmp_path / "a.log").write_text(flaser("1 " * n, n=n))
    bearings = np.degrees(read_carmen(tmp_path / "a.log").bearings)
    np.testing.assert_allclose([bearings[0], bearings[-1], np.ptp(np.diff(bearings))], [-90, last, 0], atol=1e-9)


def test_read_carmen_orders_by_stamps(tmp_path):
    lines = [flaser(poses=f"{x} 0 0 {x} 0 0", stamp=stamp) for x, stamp in ((1, 5.0), (3, 7.5), (2, 6.0))]
    (tmp_path / "a.log").write_text("# a comment\n\n" + "".join(lines))
    log = read_carmen(tmp_path / "a.log")
    assert log.stamps.tolist() == [5.0, 6.0, 7.5] and log.odometry[:, 0].tolist() == [1, 2, 3]
    (tmp_path / "b.log").write_text("".join(lines).replace("6.0", "0"))
    log = read_carmen(tmp_path / "b.log")
    assert log.stamps is None and log.odometry[:, 0].tolist() == [1, 3, 2]


@pytest.mark.parametrize(
    ("stamps", "read", "order"),
    [
        ([0, 0.1, 0.2], [0, 0.1, 0.2], [0, 1, 2]),  # Stage and Gazebo begin at 0
        ([0.3, 0.1, 0, 0.2], [0, 0.1, 0.2, 0.3], [2, 1, 3, 0]),  # the same, shuffled
        ([0, 0, 0.1], [0, 0, 0.1], [0, 1, 2]),  # the clock had not begun to run
        ([-0.5, 0, 0.5], [-0.5, 0, 0.5], [0, 1, 2]),
        ([0, 0, 0], None, [0, 1, 2]),
        ([0], None, [0]),
        ([0, 1e9, 1e9 + 1], None, [0, 1, 2]),  # a date does not begin at 0
        ([1e9 + 2, 1e9, 0, 1e9 + 1], None, [0, 1, 2, 3]),
        ([5, 0, 7], None, [0, 1, 2]),  # one is missing: between 5 and 7
        ([0.3, 0, 0.1, 0, 0.2], None, [0, 1, 2, 3, 4]),  # only one of them can be the beginning
    ],
)
def test_read_carmen_knows_a_clock_that_begins_at_0_from_missing_stamps(tmp_path, stamps, read, order):
    lines = [flaser(poses=f"{i} 0 0 {i} 0 0", stamp=stamp) for i, stamp in enumerate(stamps)]
    (tmp_path / "a.log").write_text("".join(lines))
    log = read_carmen(tmp_path / "a.log")
    assert (None if log.stamps is None else log.stamps.tolist()) == read and log.odometry[:, 0].tolist() == order


def test_read_carmen_takes_the_stamp_of_the_measurement_before_the_loggers(tmp_path):
    (tmp_path / "a.log").write_text(flaser(stamp=7.0).replace("robot 7.0", "robot 9.5"))
    assert read_carmen(tmp_path / "a.log").stamps.tolist() == [7.0]


def test_read_carmen_turns_between_odom_lines_the_short_way(tmp_path):
    wheels = [f"ODOM {x} 0 {theta} 0 0 0 {t} robot {t}\n" for t, x, theta in ((0.5, 3, 3.1), (1.5, 4, -3.1), (2.5, 5, -2.9))]
    scans = [flaser(poses=f"{x} 0 0 {x} 0 0", stamp=float(x)) for x in (1, 2)]
    (tmp_path / "a.log").write_text("".join(wheels + scans))
    log = read_carmen(tmp_path / "a.log")
    assert np.allclose(log.odometry[:, 0], [3.5, 4.5]) and np.allclose(np.abs(log.odometry[:, 2]), [np.pi, 3.0])
    assert np.allclose(log.truth[:, 0], [1, 2])


def test_read_carmen_takes_odom_lines_of_a_clock_that_begins_at_0(tmp_path):
    def odometry_of(stamps):
        wheels = [f"ODOM {2 * i} 0 0 0 0 0 {stamp} robot {stamp}\n" for i, stamp in enumerate(stamps)]
        scans = [flaser(poses=f"{i} 0 0 {i} 0 0", stamp=float(i)) for i in range(3)]
        (tmp_path / "a.log").write_text("".join(wheels + scans))
        return read_carmen(tmp_path / "a.log").odometry[:, 0].tolist()

    assert odometry_of([0, 1, 2]) == [0, 2, 4]
    assert odometry_of([0.5, 0, 2]) == [0, 1, 2]  # one of them has no stamp: the scans' own poses


def test_read_carmen_takes_the_loggers_stamp_for_a_missing_one(tmp_path):
    (tmp_path / "a.log").write_text(flaser().replace("7.0 robot", "0 robot"))
    assert read_carmen(tmp_path / "a.log").stamps.tolist() == [7.0]


@pytest.mark.parametrize("code", ["81.91", "81.83", "inf", "0"])
def test_read_carmen_a_fault_is_no_reading(tmp_path, code):
    readings = np.arange(1, 180) / 64
    (tmp_path / "a.log").write_text(flaser(" ".join(map(str, readings)) + f" {code}"))
    ranges = read_carmen(tmp_path / "a.log").ranges[0]
    assert np.isnan(ranges[-1]) and (ranges[:-1] == readings).all()


def test_read_carmen_finds_the_limit(tmp_path):
    path = tmp_path / "a.log"
    path.write_text(flaser("2.5 " * 150 + "29.9 " * 20 + "30 " * 10))
    assert np.isnan(read_carmen(path).ranges).sum() == 10  # ten at the farthest range
    path.write_text(flaser("2.5 " * 150 + "29.9 " * 21 + "30 " * 9))
    assert np.isnan(read_carmen(path).ranges).sum() == 0
    path.write_text("PARAM robot_front_laser_max 29.5 robot 0\n" + flaser("2.5 " * 150 + "29.9 " * 21 + "30 " * 9))
    assert np.isnan(read_carmen(path).ranges).sum() == 30
    assert np.isnan(read_carmen(path, max_range_m=30).ranges).sum() == 9
    with pytest.raises(ValueError, match="max_range_m must be a finite number above 0"):
        read_carmen(path, max_range_m=0)
    path.write_text("PARAM robot_front_laser_max off robot 0\n" + flaser())
    with pytest.raises(ValueError, match="robot_front_laser_max must be a number above 0, got 'off'"):
        read_carmen(path)


def test_read_carmen_passes_remissions_over(tmp_path):
    line = "ROBOTLASER1 0 -0.5 1 0.5 8 0.02 1 3 1 2 9 3 100 200 300 4.1 5 0 4 5 0 0 0 0 0 0 6.5 robot 6.5"
    (tmp_path / "a.log").write_text(line)
    log = read_carmen(tmp_path / "a.log")
    np.testing.assert_array_equal(log.ranges, [[1, 2, np.nan]])
    assert log.bearings.tolist() == [-0.5, 0, 0.5] and log.odometry.tolist() == [[4.1, 5, 0]]  # the laser's pose
    assert (log.scanner.max_range_m, log.scanner.range_noise_m) == (8, 0.02)


def test_read_carmen_knows_corrected_poses(tmp_path):
    def truth_of(text, **keywords):
        (tmp_path / "a.log").write_text(text)
        return read_carmen(tmp_path / "a.log", **keywords)

    mounted = [flaser(poses=poses, stamp=stamp) for poses, stamp in (("0.2 0 0 0 0 0", 1), ("1 1.2 1.5708 1 1 1.5708", 2))]
    assert truth_of("".join(mounted)).truth is None  # 20 cm in front of the axle in both: one body
    assert truth_of("".join(mounted)).odometry[1].tolist() == [1, 1.2, 1.5708]
    assert truth_of("NEFF 12.5\n" + "".join(mounted)).truth[0].tolist() == [0.2, 0, 0]
    assert truth_of("NEFF 12.5\n" + "".join(mounted), corrected=False).truth is None
    apart = "".join([mounted[0], flaser(poses="1 1.2 1.5 1.1 1 1.6", stamp=2)])
    log = truth_of(apart)
    assert log.truth[1].tolist() == [1, 1.2, 1.5] and log.odometry[1].tolist() == [1.1, 1, 1.6]
    still = flaser(poses="1 0 0 1 0 0", stamp=1) + flaser(poses="2 0 0 2 0 0", stamp=2)
    faster, same = ("".join(f"ODOM {v * t} 0 0 0 0 0 {t} robot {t}\n" for t in (0.5, 1.5, 2.5)) for v in (2, 1))
    log = truth_of(faster + still)
    assert log.truth[:, 0].tolist() == [1, 2] and log.odometry[:, 0].tolist() == [2, 4]  # between the lines of ODOM
    assert truth_of(same + still).truth is None and truth_of(faster.splitlines()[0] + "\n" + still).truth is None


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (flaser("2.5 " * 179 + "nan"), "a range must be a number, got 'nan' in line 1"),
        ("\n\n" + flaser("2.5 " * 179 + "-1"), "a range must not be negative, got -1 in line 3"),
        (flaser("2.5 " * 179 + "wall"), "a range must be a number, got 'wall' in line 1"),
        (flaser("2.5 " * 179), "FLASER must hold the 191 words that it promises, got 190 in line 1"),
        (flaser() + flaser()[:200], r"FLASER must hold the 191 words that it promises, got 5\d in line 2"),
        ("FLASER", "FLASER must tell its number of readings, got a line cut off after 1 words in line 1"),
        (flaser(n="many"), "FLASER's number of readings must be a whole number, got 'many' in line 1"),
        (flaser("1 " * 90, n=90), "FLASER must hold 180, 181, 360 or 361 readings, as it tells no angles, got 90 in line 1"),
        (flaser() + flaser("1 " * 360, n=360), "all scans of a log must have 180 readings, as the first, got 360 in line 2"),
        (
            flaser() + "ROBOTLASER1 0 -0.5 1 0.5 8 0.02 1 3 1 2 9 0 4 5 0 4 5 0 0 0 0 0 0 6.5 robot 6.5",
            "a log must hold one kind of scan, got FLASER and, in line 2, ROBOTLASER1",
        ),
        (flaser(poses="1 2 nan 1 2 0"), "the poses of a scan must be finite numbers, got '1 2 nan 1 2 0' in line 1"),
        (flaser(stamp="noon"), "the stamps must be finite numbers, got 'noon noon' in line 1"),
        (flaser() + "ODOM 1 2 three 0 0 0 1 robot 1", "a pose must be finite numbers, got '1 2 three' in line 2"),
        (flaser() + "ODOM 1 2 0", "ODOM must hold the 10 words that it promises, got 4 in line 2"),
        (
            "ROBOTLASER1 0 -0.5 1 0 8 0.02 1 3 1 2 9 0 4 5 0 4 5 0 0 0 0 0 0 6.5 robot 6.5",
            "the laser's step between beams must be above 0, got 0 in line 1",
        ),
        ("ROBOTLASER1 0 -0.5 1 0.5 8 0.02 1 3 1 2 9", "ROBOTLASER1 must tell its number of remissions, got a line cut off"),
        ("PARAM a b c 0\n", r"a CARMEN log must hold scans \(FLASER or ROBOTLASER1\), got none"),
        ("", "got none"),
        ("FLASER ä", "a CARMEN log must be text, got something else in line 1"),
    ],
)
def test_read_carmen_says_which_line_is_wrong(tmp_path, text, sentence):
    (tmp_path / "a.log").write_text(text, encoding="utf-8")
    with pytest.raises(ValueError, match=sentence):
        read_carmen(tmp_path / "a.log")


def test_read_carmen_says_when_angles_change(tmp_path):
    lines = [f"ROBOTLASER1 0 {a} 1 0.5 8 0.02 1 3 1 2 9 0 4 5 0 4 5 0 0 0 0 0 0 6.5 robot 6.5" for a in (-0.5, -0.4)]
    (tmp_path / "a.log").write_text("\n".join(lines))
    with pytest.raises(ValueError, match="must have the angles of the first, got others in line 2"):
        read_carmen(tmp_path / "a.log")


def test_read_carmen_says_when_a_gzip_file_breaks_off(tmp_path):
    rng = np.random.default_rng(0)
    whole = gzip.compress("".join(flaser(" ".join(map(str, rng.random(180)))) for _ in range(50)).encode())
    (tmp_path / "a.gz").write_bytes(whole[: len(whole) // 2])
    with pytest.raises(ValueError, match=r"must be whole, got one that breaks off after line 2\d"):
        read_carmen(tmp_path / "a.gz")
    (tmp_path / "b.gz").write_bytes(whole[:2] + b"nonsense" + whole[10:])
    with pytest.raises(ValueError, match="must be whole"):
        read_carmen(tmp_path / "b.gz")
    with pytest.raises(FileNotFoundError, match="must be a file"):
        read_carmen(tmp_path / "c.gz")


def test_read_carmen_reads_only_the_first(tmp_path):
    path = write_carmen(tmp_path / "a.log", log_by_hand(3))
    assert len(read_carmen(path, first=2)) == 2 and len(read_carmen(path, first=5)) == 3
    with pytest.raises(ValueError, match="first must be a whole number of at least 1, got 0"):
        read_carmen(path, first=0)


def test_write_carmen_keeps_stamps_and_a_truth_that_equals_the_odometry(tmp_path):
    log = log_by_hand(2, stamps=np.array([1076.25, 1076.5]))
    path = write_carmen(tmp_path / "a.log", log)
    assert read_carmen(path).stamps.tolist() == [1076.25, 1076.5] and read_carmen(path).truth is None
    path = write_carmen(tmp_path / "a.log", log_by_hand(2, truth=log.odometry), force=True)
    np.testing.assert_array_equal(read_carmen(path).truth, log.odometry)


@pytest.mark.parametrize("stamps", [[0, 0.1, 0.2], [0, 100, 200], [0, 0, 0], [-7, 0, 7], [0, 1e9, 2e9], [0.1, 0.2, 0.2]])
def test_write_carmen_keeps_stamps_that_hold_a_zero(tmp_path, stamps):
    path = write_carmen(tmp_path / "a.log", log_by_hand(3, stamps=np.array(stamps, dtype=float)))
    assert read_carmen(path).stamps.tolist() == stamps
    lines = path.read_text().splitlines()
    scans = [line for line in lines if line.startswith("FLASER")]
    shuffled = [line for line in lines if line not in scans] + [scans[i] for i in (2, 0, 1)]
    path.write_text("\n".join(shuffled))
    assert read_carmen(path).stamps.tolist() == sorted(stamps)


def test_write_carmen_says_what_it_cannot_write(tmp_path):
    log = log_by_hand(2)
    with pytest.raises(ValueError, match="at least one scan"):
        write_carmen(tmp_path / "a.log", RobotLog(np.empty((0, 3)), np.empty((0, 180)), log.bearings, log.scanner, log.start))
    with pytest.raises(ValueError, match="bearings must rise evenly"):
        write_carmen(tmp_path / "a.log", RobotLog(log.odometry, log.ranges, log.bearings**3, log.scanner, log.start))
    write_carmen(tmp_path / "a.log", log)
    with pytest.raises(FileExistsError, match="exists already"):
        write_carmen(tmp_path / "a.log", log)


@pytest.mark.skipif("PRIORLAB_REAL_DATA" not in os.environ, reason="PRIORLAB_REAL_DATA is not set")
@pytest.mark.parametrize(
    ("name", "shape", "length_m", "limit_m"), [("freiburg-079", (4791, 360), 422.5, 80.99), ("aces", (440, 180), 323.2, 50)]
)
def test_read_carmen_real_logs(name, shape, length_m, limit_m):
    log = read_carmen(Path(os.environ["PRIORLAB_REAL_DATA"]) / "robot_logs" / f"{name}-corrected.log.gz")
    assert log.ranges.shape == shape and log.scanner.max_range_m == limit_m
    assert np.hypot(*np.diff(log.truth[:, :2], axis=0).T).sum() == pytest.approx(length_m, abs=0.1)
    assert np.nanmax(log.ranges) < limit_m and 0 < np.isnan(log.ranges).mean() < 0.05
    assert (np.diff(log.stamps) > 0).all()
