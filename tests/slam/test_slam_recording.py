"""A run's record: maps replayed at any step, another prior fed by the same poses, the npz file."""

import pickle
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from priorlab.core.building import Truth
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.readings import RobotLog
from priorlab.slam.fastslam import FastSLAM
from priorlab.slam.lost import lost_because
from priorlab.slam.map_update import FREE, OCCUPIED, see_cells, update_seen
from priorlab.slam.particles import Particles
from priorlab.slam.recording import Recorder
from priorlab.slam.run_file import load_run, save_run
from priorlab.slam.sample_packing import pack_sample, unpack_sample
from priorlab.slam.scan import choose_beams


@pytest.fixture(scope="module")
def run(slam_prior, drive_log):
    return FastSLAM().run(slam_prior, drive_log, np.random.default_rng(0))


def counted_map(run, prior_map, n_steps):
    """The closed form l = l_0 + S - n l_0 from counts of looks, no recursion."""
    free, hits = np.zeros(prior_map.grid.shape), np.zeros(prior_map.grid.shape)
    for k in range(n_steps):
        scan = choose_beams(run.log, k, run.parameters)
        seen = see_cells(prior_map.grid, run.trajectory[k], scan, run.parameters)
        free[seen.rows, seen.cols] += seen.labels == FREE
        hits[seen.rows, seen.cols] += seen.labels == OCCUPIED
    return prior_map.log_odds + np.log(4) * (free - hits) - (free + hits) * prior_map.log_odds


def test_at_replays_the_run_to_the_last_bit(run):
    assert np.array_equal(run.at(-1).log_odds, run.map.log_odds)
    assert np.array_equal(run.at(len(run) - 1).log_odds, run.map.log_odds)


@pytest.mark.parametrize("step", [0, 2, 3, 4, 14, 15, 16, 63, 137, 255, 269])
def test_at_equals_the_closed_form_of_the_first_steps(run, slam_prior, step):
    assert np.allclose(run.at(step).log_odds, counted_map(run, slam_prior, step + 1), atol=1e-9)


def test_at_equals_the_map_of_a_shorter_drive_to_the_last_bit(run, slam_prior):
    log_odds_map = slam_prior.log_odds.copy()
    for k in range(len(run)):
        scan = choose_beams(run.log, k, run.parameters)
        update_seen(log_odds_map, slam_prior.log_odds, see_cells(slam_prior.grid, run.trajectory[k], scan, run.parameters))
        if k % 13 == 0 or k in (7, 63, 127, 255):
            assert np.array_equal(run.at(k).log_odds, log_odds_map)


def test_a_run_that_was_scrubbed_can_be_sent_to_another_process(run):
    expected = run.at(100).log_odds
    assert np.array_equal(pickle.loads(pickle.dumps(run)).at(100).log_odds, expected)


def test_at_keeps_little(run):
    run.at(0)
    assert run.replay.nbytes < 12 * run.map.log_odds.nbytes  # a map per step would be 270


def test_first_seen_and_coverage_agree_with_a_slow_count(run, floor, slam_prior):
    first_seen = np.full(slam_prior.grid.shape, len(run))
    for k in reversed(range(len(run))):
        seen = see_cells(slam_prior.grid, run.trajectory[k], choose_beams(run.log, k, run.parameters), run.parameters)
        for row, col in zip(*np.nonzero(seen.labels), strict=True):
            first_seen[row + seen.rows.start, col + seen.cols.start] = k
    assert np.array_equal(run.replay.first_seen, first_seen)
    ignore = np.zeros_like(floor[0])
    ignore[:, :100] = True
    truth = Truth(floor[0], ignore)
    for step in (0, 40, 200, -1):
        walls = [(row, col) for row, col in zip(*np.nonzero(floor[0]), strict=True) if col >= 100]
        covered = sum(first_seen[place] <= (step if step >= 0 else 269) for place in walls)  # cells are pixels here
        assert run.coverage(truth, step) == pytest.approx(covered / len(walls), abs=1e-12)
    assert 0 < run.coverage(truth, 40) < run.coverage(truth) < 1


def test_coverage_says_what_is_wrong(run, floor):
    nothing = np.zeros_like(floor[0])
    with pytest.raises(ValueError, match="step must lie between 0 and 269, got 270"):
        run.coverage(Truth(floor[0], nothing), 270)
    with pytest.raises(ValueError, match=r"map and truth must have one shape, got \(160, 280\) and \(159, 280\)"):
        run.coverage(Truth(floor[0][1:], nothing[1:]))
    with pytest.raises(ValueError, match="the truth must hold a wall to be covered, got none"):
        run.coverage(Truth(nothing, nothing))


def test_at_does_not_spoil_what_is_kept(run):
    first = run.at(60).log_odds
    run.at(60).log_odds[:] = 7.0
    assert np.array_equal(run.at(60).log_odds, first)


@pytest.mark.parametrize("step", [270, -271])
def test_at_says_which_steps_there_are(run, step):
    with pytest.raises(ValueError, match="step must lie between 0 and 269, got"):
        run.at(step)


def test_remap_feeds_another_prior_with_the_same_poses(run, floor, prior_of):
    assert np.array_equal(run.remap(run.prior_map).log_odds, run.map.log_odds)
    nothing = prior_of(floor[0], Prior.uninformed())
    without = run.remap(nothing)
    assert np.allclose(without.log_odds, counted_map(run, nothing, len(run)), atol=1e-9)
    assert without.prior.is_uninformed
    coarse = run.remap(prior_of(floor[0], Prior(0.3, 0.8), cell_size=2))
    assert coarse.log_odds.shape == (80, 140) and not np.array_equal(coarse.log_odds, coarse.log_odds * 0)


def test_run_shows_itself(run):
    assert len(run) == 270
    assert repr(run).startswith("Run(270 steps, 1500 to 4500 particles, ATE 0.")
    assert run.sample.shape == (270, 300, 3)
    assert np.abs(run.sample[:, :, :2].mean(axis=1) - run.trajectory[:, :2]).max() < 0.15
    assert run.rpe_m() < 0.05


def test_summary_tells_the_numbers(run, floor):
    truth = Truth(floor[0], np.zeros_like(floor[0]))
    line = run.summary(truth)
    assert line.startswith(f"270 steps, ATE {run.ate_m():.3f} m, RPE ") and line.endswith("of the walls seen")
    assert f"{run.rpe_deg():.2f} degrees a step" in line and "1500 to 4500 particles" in line
    astray = replace(run, trajectory=run.trajectory + [3, 0, 0])
    assert astray.summary().startswith("LOST (the estimate is more than 1 m off the true position from step 0")
    blind = replace(run, log=replace(run.log, truth=None))
    assert "ATE" not in blind.summary() and blind.summary().startswith("270 steps, 1500 to 4500 particles, ESS ")


def test_sample_is_some_of_the_particles_to_the_millimetre():
    rng = np.random.default_rng(0)
    poses = rng.normal(0, [0.2, 0.2, 0.05], (1000, 3)) + [3, -4, 1]
    recorder = Recorder()
    recorder.add(SimpleNamespace(pose=poses[0], weighed=Particles(poses), particles=Particles(poses)), 0.5)
    sample = recorder.samples[0].astype(float)
    assert sample.shape == (300, 3) and (np.diff(sample[:, 0]) >= 0).all()
    near = np.abs(sample[:, None] - poses).max(axis=2).min(axis=1)
    assert near.max() <= 0.0005 + 1e-6
    assert sample.mean(axis=0) == pytest.approx(poses.mean(axis=0), abs=0.03)
    line = np.outer(np.arange(1000.0), [1, 0, 0])  # spread over all of them: copies of one particle lie in a row
    recorder.add(SimpleNamespace(pose=line[0], weighed=Particles(line), particles=Particles(line)), 0.5)
    assert recorder.samples[1][[0, -1], 0].tolist() == [0, 999] and np.diff(recorder.samples[1][:, 0]).max() <= 4


def test_run_tells_its_errors_in_metres_and_degrees(run):
    truth, rng = run.log.truth, np.random.default_rng(0)
    off = rng.normal(0, [0.1, 0.2, 0.3], truth.shape)
    off[5, 2] = np.radians(359)  # one degree the short way
    other = replace(run, trajectory=truth + off)
    assert other.ate_m() == pytest.approx(np.sqrt((off[:, 0] ** 2 + off[:, 1] ** 2).mean()))
    turns = np.abs(np.degrees(np.angle(np.exp(1j * off[:, 2]))))
    assert other.heading_error_deg() == pytest.approx(np.median(turns))
    drift = np.degrees(np.angle(np.exp(1j * np.diff(off[:, 2]))))
    assert other.rpe_deg() == pytest.approx(np.sqrt(np.mean(drift**2)))


@pytest.mark.parametrize("far_m", [0.0, -50.0, 9e5])
def test_packed_samples_come_back_to_the_last_bit(far_m):
    rng = np.random.default_rng(1)
    sample = np.rint(1000 * rng.normal(0, [0.3, 0.3, 3], (20, 50, 3)) + far_m) / 1000
    for some in (sample, sample[:, :1], rng.normal(0, 1, (4, 5, 3))):  # the last one is no whole millimetres
        some = some.astype(np.float32)
        assert np.array_equal(unpack_sample(pack_sample(some)), some)


def test_run_file_brings_everything_back(run, tmp_path):
    save_run(run, tmp_path / "drive.npz")
    again = load_run(tmp_path / "drive.npz")
    for name in ("trajectory", "n_particles", "ess", "sample", "explained"):
        assert np.array_equal(getattr(again, name), getattr(run, name), equal_nan=True)
    assert np.array_equal(again.map.log_odds, run.map.log_odds)
    assert (again.parameters, again.prior_map.grid, again.prior_map.prior, again.log.scanner) == (
        run.parameters,
        run.prior_map.grid,
        run.prior_map.prior,
        run.log.scanner,
    )
    assert repr(again) == repr(run)
    assert (tmp_path / "drive.npz").stat().st_size < 500_000


def test_run_says_what_kind_of_record_it_wants(run, tmp_path):
    array = np.zeros((3, 3))
    for call, sentence in (
        (lambda: run.remap(array), "prior_map must be a GridMap, got ndarray"),
        (lambda: run.ate_m(array), "log must be a RobotLog, got ndarray"),
        (lambda: run.coverage(array), "truth must be a Truth, got ndarray"),
        (lambda: save_run(array, tmp_path / "a.npz"), "run must be a Run, got ndarray"),
    ):
        with pytest.raises(ValueError, match=sentence):
            call()
    assert not list(tmp_path.iterdir())


def test_ess_and_number_are_those_of_the_weighed_particles(slam_prior, drive_log):
    fast_slam = FastSLAM(particle_limits=(50, 300), resampling_interval=2)
    state = fast_slam.start(slam_prior, drive_log, np.random.default_rng(0))
    sizes, numbers = [], []
    for _ in range(6):
        weighed = fast_slam.step(state).weighed
        weights = [np.exp(value - max(weighed.log_weights)) for value in weighed.log_weights]
        numbers.append(sum(weights) ** 2 / sum(weight**2 for weight in weights))  # Kish's effective size
        sizes.append(len(weighed.poses))
    run = fast_slam.finish(state)
    assert run.n_particles.tolist() == sizes
    np.testing.assert_allclose(run.ess, numbers, rtol=1e-9)
    assert (run.ess <= run.n_particles).all() and run.ess.min() < run.n_particles.max()


def test_run_file_overwrites_nothing_unasked(run, tmp_path):
    (tmp_path / "drive.npz").write_text("mine")
    with pytest.raises(FileExistsError, match="exists already"):
        save_run(run, tmp_path / "drive.npz")
    assert (tmp_path / "drive.npz").read_text() == "mine"
    save_run(run, tmp_path / "drive.npz", force=True)
    assert len(load_run(tmp_path / "drive.npz")) == 270


def test_run_file_says_what_it_cannot_read(run, tmp_path):
    with pytest.raises(FileNotFoundError, match="a run must lie at"):
        load_run(tmp_path / "none.npz")
    save_run(run, tmp_path / "whole.npz")
    content = (tmp_path / "whole.npz").read_bytes()
    np.savez(tmp_path / "other.npz", x=1)
    np.save(tmp_path / "array.npy", np.zeros(3))
    for name, data in (("cut.npz", content[: len(content) // 2]), ("text.npz", b"hello"), ("empty.npz", b"")):
        (tmp_path / name).write_bytes(data)
    for name in ("cut.npz", "text.npz", "empty.npz", "other.npz", "array.npy"):
        with pytest.raises(ValueError, match=f"{name} must be a run that priorlab saved"):
            load_run(tmp_path / name)


def test_lost_because_asks_the_truth_first(drive_log):
    log, truth, free, fine = drive_log, drive_log.truth, np.zeros(270, bool), np.full(270, 0.9)
    assert lost_because(truth, free, fine, log) is None
    assert lost_because(truth, ~free, np.zeros(270), log) is None
    astray = truth + np.where(np.arange(270) < 100, 0.0, 1.5)[:, None] * [1, 0, 0]
    sentence = "the estimate is more than 1 m off the true position from step 100, at worst 1.5 m"
    assert lost_because(astray, free, fine, log) == sentence
    strayed = truth + np.where(np.arange(270) == 140, 1.1, 0.9)[:, None] * [0, 1, 0]  # and found its way back
    assert "from step 140, at worst 1.1 m" in lost_because(strayed, free, fine, log)


def test_lost_because_reads_three_signs_without_the_truth(drive_log):
    log, truth, free, fine = drive_log, drive_log.truth, np.zeros(270, bool), np.full(270, 0.9)
    blind = RobotLog(log.odometry, log.ranges, log.bearings, log.scanner, log.start)
    assert lost_because(truth, free, fine, blind) is None
    astray = truth + np.where(np.arange(270) < 100, 0.0, 1.5)[:, None] * [1, 0, 0]
    assert lost_because(astray, free, fine, blind) == "the estimate leapt 1.5 m against the wheels at step 100"
    walled = np.arange(270) < 27
    assert lost_because(truth, walled, fine, blind) == "the estimate stands in walls of the plan in 10 % of the steps"
    assert lost_because(truth, np.arange(270) < 4, fine, blind) is None
    worse = np.where((np.arange(270) >= 50) & (np.arange(270) < 170), 0.1, 0.9)
    sentence = "the plan's walls explain only 10 % of the beams in steps 50 to 149"
    assert lost_because(truth, free, worse, blind) == sentence
    dark = np.where(np.arange(270) < 200, np.nan, 0.9)
    assert lost_because(truth, free, dark, blind) is None


def test_lost_because_of_a_short_log(drive_log):
    log = RobotLog(drive_log.odometry[:1], drive_log.ranges[:1], drive_log.bearings, drive_log.scanner, drive_log.start)
    assert lost_because(log.odometry, np.array([False]), np.array([0.9]), log) is None
    assert lost_because(log.odometry, np.array([False]), np.array([0.0]), log) is not None


def test_run_knows_when_it_drives_through_walls(run):
    blind = replace(run.log, truth=None)
    assert replace(run, log=blind).lost_because is None
    shifted = replace(run, log=blind, trajectory=run.trajectory + [0, 1.6, 0])
    assert "the estimate stands in walls of the plan" in shifted.lost_because
    assert replace(run, log=blind, trajectory=run.trajectory + [500, 0, 0]).lost
    unknown = GridMap(np.zeros_like(run.prior_map.log_odds), run.prior_map.grid)
    assert replace(run, log=blind, prior_map=unknown).lost_because is None  # what nobody knows is no wall
