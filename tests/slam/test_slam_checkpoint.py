"""A drive that is interrupted, by Ctrl-C and by a real kill -9, and gone on with: the very run of one that was not."""

import signal
import subprocess
import sys

import numpy as np
import pytest

from priorlab.core.readings import RobotLog
from priorlab.slam.checkpoint import EVERY, resume, run_with_checkpoints
from priorlab.slam.fastslam import FastSLAM
from priorlab.slam.own_maps_record import shared_steps
from priorlab.slam.run_file import load_run, save_run

FAST = FastSLAM(particle_limits=(100, 300))


def shorter(log, n):
    return RobotLog(log.odometry[:n], log.ranges[:n], log.bearings, log.scanner, log.start, log.truth[:n])


@pytest.fixture(scope="module")
def log(drive_log):
    return shorter(drive_log, 130)


def assert_same(one, other):
    assert len(one) == len(other)
    for name in ("trajectory", "n_particles", "ess", "sample", "explained"):
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name), strict=True)
    np.testing.assert_array_equal(one.map.log_odds, other.map.log_odds)
    assert one.parameters == other.parameters and one.map.prior == other.map.prior


def interrupt_at(step):
    def progress(done, to_do):
        if done == step:
            raise KeyboardInterrupt

    return progress


@pytest.mark.parametrize(
    "fast_slam",
    [
        FAST,
        FastSLAM(particle_limits=(100, 300), localize_in="updated", resampling_interval=3, start_variances=(0.01, 0.01, 0.01)),
    ],
    ids=["static", "updated"],
)
def test_resume_ends_like_a_run_that_was_never_interrupted(tmp_path, slam_prior, log, fast_slam):
    whole_rng, rng = np.random.default_rng(7), np.random.default_rng(7)
    whole = fast_slam.run(slam_prior, log, whole_rng)
    path = tmp_path / "drive.part"
    with pytest.raises(KeyboardInterrupt):
        run_with_checkpoints(fast_slam, slam_prior, log, rng, path, progress=interrupt_at(73))
    told = []
    with pytest.raises(KeyboardInterrupt):
        resume(path, progress=interrupt_at(110))
    run = resume(path, progress=lambda done, to_do: told.append((done, to_do)))
    assert told[0] == (101, 130) and told[-1] == (130, 130)  # from the record of step 100
    assert_same(run, whole)
    assert_same(resume(path), whole)  # a finished drive is read, not driven
    save_run(run, tmp_path / "drive.npz")
    assert_same(load_run(tmp_path / "drive.npz"), whole)


def test_resume_keeps_weights_that_wait_for_a_draw(tmp_path, slam_prior, log):
    few, never = shorter(log, 14), FastSLAM(particle_limits=(50, 50), resampling_interval=1000, weigh_every_m=0.0)
    whole = never.run(slam_prior, few, np.random.default_rng(2))
    with pytest.raises(KeyboardInterrupt):
        run_with_checkpoints(never, slam_prior, few, np.random.default_rng(2), tmp_path / "a", every=4, progress=interrupt_at(10))
    assert_same(resume(tmp_path / "a"), whole)
    assert whole.ess[7] < 49.9  # the particles of the record at step 8 do not weigh alike


@pytest.mark.parametrize("generator", ["MT19937", "Philox", "SFC64", "PCG64DXSM"])
def test_resume_goes_on_with_any_generator(tmp_path, slam_prior, log, generator):
    few = shorter(log, 12)
    rngs = [np.random.Generator(getattr(np.random, generator)(3)) for _ in range(2)]
    whole = FAST.run(slam_prior, few, rngs[0])
    with pytest.raises(KeyboardInterrupt):
        run_with_checkpoints(FAST, slam_prior, few, rngs[1], tmp_path / "a", every=5, progress=interrupt_at(8))
    assert_same(resume(tmp_path / "a"), whole)


def test_run_with_checkpoints_is_the_run_and_leaves_the_generator_where_it_does(tmp_path, slam_prior, log):
    one, other = np.random.default_rng(1), np.random.default_rng(1)
    assert_same(run_with_checkpoints(FAST, slam_prior, log, one, tmp_path / "a"), FAST.run(slam_prior, log, other))
    assert one.random() == other.random()


DRIVER = """
import sys
import numpy as np
from priorlab.slam.checkpoint import run_with_checkpoints
from priorlab.slam.fastslam import FastSLAM
from priorlab.slam.own_maps_record import shared_steps
from priorlab.slam.run_file import load_run

given = load_run(sys.argv[1])
def tell(done, to_do):
    print(done, flush=True)
run_with_checkpoints(FastSLAM(given.parameters), given.prior_map, given.log, np.random.default_rng(7), sys.argv[2], progress=tell)
"""


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="this system knows no kill -9")
def test_resume_after_kill_9_loses_at_most_50_steps(tmp_path, slam_prior, log):
    whole = FAST.run(slam_prior, log, np.random.default_rng(7))
    save_run(whole, tmp_path / "given.npz")
    command = [sys.executable, "-c", DRIVER, str(tmp_path / "given.npz"), str(tmp_path / "drive.part")]
    driver = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    for line in driver.stdout:
        if int(line) == 90:
            driver.send_signal(signal.SIGKILL)
            break
    driver.stdout.close()
    assert driver.wait(timeout=60) == -signal.SIGKILL
    told = []
    assert_same(resume(tmp_path / "drive.part", lambda done, to_do: told.append(done)), whole)
    assert told[0] > 90 - EVERY and told[-1] == 130


def test_resume_drops_a_torn_end_wherever_it_is_torn(tmp_path, slam_prior, log):
    few = shorter(log, 20)
    path = tmp_path / "a"
    whole = run_with_checkpoints(FAST, slam_prior, few, np.random.default_rng(0), path, every=5)
    content = path.read_bytes()
    start = content.rindex(b"priorlab record\n")
    for cut in (start, start + 3, start + 16, start + 20, start + 200, len(content) - 1):
        path.write_bytes(content[:cut])
        told = []
        assert_same(resume(path, lambda done, to_do, told=told: told.append(done)), whole)
        assert told == [16, 17, 18, 19, 20]
        assert path.read_bytes() == content  # the torn end is gone, the record stands again


def test_resume_says_what_is_damaged(tmp_path, slam_prior, log):
    few = shorter(log, 20)
    path = tmp_path / "a"
    with pytest.raises(FileNotFoundError, match="a checkpoint must lie at"):
        resume(path)
    run_with_checkpoints(FAST, slam_prior, few, np.random.default_rng(0), path, every=5)
    content = path.read_bytes()
    second = content.index(b"priorlab record\n", 1)
    third = content.index(b"priorlab record\n", second + 1)
    middle = bytearray(content)
    middle[third + 1000] ^= 1
    length = bytearray(content)
    length[third + 20] = 255  # the record says that it is longer than the file
    for damaged, why in (
        (bytes(middle), "record 2 is broken, and more follow"),
        (bytes(length), "record 2 is broken, and more follow"),
        (content[: second + 100], "it does not begin with whole records"),
        (b"hello", "it does not begin with whole records"),
        (b"", "it does not begin with whole records"),
        (content[second:], "words"),
    ):
        path.write_bytes(damaged)
        with pytest.raises(ValueError, match="must be a checkpoint that priorlab wrote, got a damaged file: .*" + why):
            resume(path)
        assert path.read_bytes() == damaged


def test_run_with_checkpoints_says_what_is_wrong(tmp_path, slam_prior, log):
    path = tmp_path / "a"
    for change, sentence in (
        ({"every": 0}, "every must be a whole number of at least 1, got 0"),
        ({"prior_map": np.zeros((3, 3))}, "prior_map must be a GridMap, got ndarray"),
        ({"log": np.zeros((3, 3))}, "log must be a RobotLog, got ndarray"),
        ({"fast_slam": None}, "fast_slam must be a FastSLAM, got NoneType"),
        ({"rng": 3}, "rng must be a numpy Generator"),
        ({"log": shorter(log, 0)}, "the log must hold at least one scan"),
    ):
        given = {"fast_slam": FAST, "prior_map": slam_prior, "log": log, "rng": np.random.default_rng(0), "path": path} | change
        with pytest.raises(ValueError, match=sentence):
            run_with_checkpoints(**given)
        assert not path.exists()
    path.write_text("mine")
    with pytest.raises(FileExistsError, match="exists already"):
        run_with_checkpoints(FAST, slam_prior, log, np.random.default_rng(0), path)
    assert path.read_text() == "mine"
    few = shorter(log, 3)
    assert len(run_with_checkpoints(FAST, slam_prior, few, np.random.default_rng(0), path, force=True)) == 3


@pytest.mark.parametrize("lag_m", [0.0, 1.0])
def test_resume_goes_on_with_a_map_for_every_particle(tmp_path, slam_prior, log, lag_m):
    few, own = shorter(log, 45), FastSLAM(particle_limits=(12, 12), localize_in="own", weigh_every_m=0.0, lag_m=lag_m)
    whole = own.run(slam_prior, few, np.random.default_rng(5))
    assert not np.array_equal(whole.path, whole.trajectory)
    with pytest.raises(KeyboardInterrupt):
        run_with_checkpoints(own, slam_prior, few, np.random.default_rng(5), tmp_path / "a", every=10, progress=interrupt_at(17))
    with pytest.raises(KeyboardInterrupt):
        resume(tmp_path / "a", interrupt_at(38))
    run = resume(tmp_path / "a")
    assert_same(run, whole)
    np.testing.assert_array_equal(run.path, whole.path)
    np.testing.assert_array_equal(run.at(-1).log_odds, whole.map.log_odds)
    save_run(run, tmp_path / "run.npz")
    again = load_run(tmp_path / "run.npz")
    assert_same(again, whole)
    np.testing.assert_array_equal(again.path, whole.path)


def test_shared_steps_end_where_the_first_particle_leaves():
    paths = np.zeros((3, 6, 3))
    assert shared_steps(paths) == 6 and shared_steps(paths[:, :0]) == 0 and shared_steps(paths[:1]) == 6
    paths[1, 4, 2], paths[2, 5] = 1e-12, 7
    assert shared_steps(paths) == 4


def test_a_record_costs_the_same_late_as_early(tmp_path, slam_prior, log):
    sizes = []
    path = tmp_path / "a"
    steady = FastSLAM(particle_limits=(200, 200))
    run_with_checkpoints(
        steady,
        slam_prior,
        log,
        np.random.default_rng(0),
        path,
        every=10,
        progress=lambda done, to_do: sizes.append(path.stat().st_size) if done % 10 == 0 else None,
    )
    added = np.diff(sizes)
    assert added.min() > 0 and added.max() < 1.02 * added.min()
