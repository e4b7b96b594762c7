"""Speed of chapter 6 against the plain ways: `pytest -s tests/benchmarks/test_bench_slam.py` prints the table.

Milliseconds hang on the machine, so only ratios are asserted, and loosely.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable

import numpy as np
import pytest

from priorlab.buildings.floor_plans import load_floor_plan
from priorlab.core.drawing import WALL, Walls
from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.readings import RobotLog
from priorlab.core.sensor import KINECT, ODOMETRY, Scanner
from priorlab.mapping.prior import build_prior_map
from priorlab.robot.drive import drive
from priorlab.slam.fastslam import FastSLAM
from priorlab.slam.likelihood_field import LikelihoodField
from priorlab.slam.map_update import see_cells, update_seen
from priorlab.slam.measurement import log_weights
from priorlab.slam.parameters import TUNED
from priorlab.slam.scan import Scan

CELL_M, N_PARTICLES, N_BEAMS = 0.05, 4500, 60


def milliseconds(call: Callable[[], object], n: int) -> tuple[float, float]:
    """Best of n calls after one to warm up: wall time, and that of this thread alone, which other programs hardly lengthen."""
    call()
    wall, thread = [], []
    for _ in range(n):
        clocks = time.perf_counter(), time.thread_time()
        call()
        wall.append(time.perf_counter() - clocks[0])
        thread.append(time.thread_time() - clocks[1])
    return 1e3 * min(wall), 1e3 * min(thread)


def show(what: str, rows: dict[str, tuple[float, float]]) -> None:
    """A table whose first row is ours."""
    print(f"\n| {what} | ms | of this thread | times ours |\n|---|---|---|---|")
    ours = next(iter(rows.values()))[1]
    for name, (wall, thread) in rows.items():
        print(f"| {name} | {wall:.2f} | {thread:.2f} | {thread / ours:.1f} |")


def naive_log_weights(poses, scan, field):
    """The same look-up as NumPy says it at first thought, one array per thing."""
    angles = poses[:, 2:] + scan.bearings
    x = poses[:, :1] + scan.ranges * np.cos(angles)
    y = poses[:, 1:2] + scan.ranges * np.sin(angles)
    cols = np.floor(x / CELL_M).astype(int)
    rows = field.grid.shape[0] - 1 - np.floor(y / CELL_M).astype(int)
    inside = (rows >= 0) & (rows < field.grid.shape[0]) & (cols >= 0) & (cols < field.grid.shape[1])
    value = np.full(x.shape, field.far)
    value[inside] = field.image[rows[inside], cols[inside]]
    return field.parameters.temper * value.sum(axis=1)


def loop_log_weights(poses, scan, field):
    """One particle and one beam after the other."""
    image, (n_rows, n_cols) = field.image, field.grid.shape
    weights = []
    for x, y, theta in poses.tolist():
        total = 0.0
        for z, bearing in zip(scan.ranges.tolist(), scan.bearings.tolist(), strict=True):
            col = math.floor((x + z * math.cos(theta + bearing)) / CELL_M)
            row = n_rows - 1 - math.floor((y + z * math.sin(theta + bearing)) / CELL_M)
            total += image[row, col] if 0 <= row < n_rows and 0 <= col < n_cols else field.far
        weights.append(field.parameters.temper * total)
    return np.array(weights)


def loop_insert(log_odds_map, prior, grid, pose, scan):
    """Bresenham's line in Python, a set of cells per kind."""
    free, hits = set(), set()
    x, y, theta = pose
    for z, bearing in zip(scan.ranges, scan.bearings, strict=True):
        ends = [(0.0, z, free), (z, z + TUNED.thickening_m, hits)]
        for near, far, kind in ends:
            cells = []
            for along in (near, far):
                px, py = x + along * math.cos(theta + bearing), y + along * math.sin(theta + bearing)
                cells.append((grid.shape[0] - 1 - math.floor(py / CELL_M), math.floor(px / CELL_M)))
            (r0, c0), (r1, c1) = cells
            dr, dc, sr, sc = abs(r1 - r0), abs(c1 - c0), (1 if r1 > r0 else -1), (1 if c1 > c0 else -1)
            error = dc - dr
            while True:
                kind.add((r0, c0))
                if (r0, c0) == (r1, c1):
                    break
                twice = 2 * error
                if twice > -dr:
                    error, c0 = error - dr, c0 + sc
                if twice < dc:
                    error, r0 = error + dc, r0 + sr
    for cells, said in ((free - hits, math.log(4)), (hits, -math.log(4))):
        for cell in cells:
            log_odds_map[cell] += said - prior[cell]


@pytest.fixture(scope="module")
def scene():
    """2,000 x 800 cells of rooms, 4,500 particles in one of them, a scan of 60 beams on a wall 2 m away."""
    walls = np.zeros((800, 2000), dtype=bool)
    walls[::80], walls[1::80], walls[:, ::100], walls[:, 1::100] = True, True, True, True
    grid = Grid(walls.shape, 1, CELL_M)
    prior_map = GridMap(np.where(walls, -1.0, 0.9), grid)
    rng = np.random.default_rng(0)
    pose = np.array([52.5, 22.0, 0.0])
    poses = pose + rng.normal(0, [0.1, 0.1, 0.05], (N_PARTICLES, 3))
    bearings = np.linspace(-0.5, 0.5, N_BEAMS)
    scan = Scan(np.minimum(2.4 / np.cos(bearings), 2.9), bearings, np.empty(0))
    return prior_map, LikelihoodField.of(prior_map, TUNED), poses, pose, scan, TUNED


def test_bench_slam_weighting(scene):
    _, field, poses, _, scan, _ = scene
    ours = milliseconds(lambda: log_weights(poses, scan, field), 40)
    naive = milliseconds(lambda: naive_log_weights(poses, scan, field), 5)
    few = poses[:150]
    loop = tuple(time_ms * N_PARTICLES / len(few) for time_ms in milliseconds(lambda: loop_log_weights(few, scan, field), 2))
    assert np.allclose(log_weights(few, scan, field), loop_log_weights(few, scan, field), atol=0.05)
    show(
        "4,500 particles x 60 beams, 2,000 x 800 cells",
        {"weighting": ours, "naive NumPy": naive, "Python loop": loop},
    )
    assert ours[1] < naive[1] < loop[1]


def test_bench_slam_insertion(scene):
    prior_map, _, _, pose, scan, parameters = scene
    prior, fast, slow = prior_map.log_odds, prior_map.log_odds.copy(), prior_map.log_odds.copy()
    ours = milliseconds(lambda: update_seen(fast, prior, see_cells(prior_map.grid, pose, scan, parameters), parameters), 40)
    loop = milliseconds(lambda: loop_insert(slow, prior, prior_map.grid, pose, scan), 5)
    show("inserting a scan of 60 beams", {"cv2.polylines into a window": ours, "Bresenham in Python": loop})
    assert ours[1] < loop[1]


def test_bench_slam_whole_step(scene):
    """`FastSLAM.step` itself, every scan weighing and the map that it localizes in updated each time."""
    prior_map, _, _, pose, _, _ = scene
    n_steps, bearings = 41, np.linspace(-0.5, 0.5, N_BEAMS)
    odometry = pose + np.outer(np.arange(n_steps), [0.01, 0.0, 0.002])
    ranges = np.minimum(2.4 / np.cos(bearings), 2.9) - 0.01 * np.arange(n_steps)[:, None]
    log = RobotLog(odometry, ranges, bearings, Scanner(field_of_view=1.0), pose)
    every = {"particle_limits": (N_PARTICLES, N_PARTICLES), "weigh_every_m": 0.0, "weigh_every_theta": 0.0}
    slam = FastSLAM(**every, localize_in="updated", lag_m=0.0)
    state = slam.start(prior_map, log, np.random.default_rng(0))
    static = FastSLAM(**every)
    static_state = static.start(prior_map, log, np.random.default_rng(0))

    ours = milliseconds(lambda: slam.step(state), n_steps - 1)
    plan_alone = milliseconds(lambda: static.step(static_state), n_steps - 1)
    rebuilt = milliseconds(lambda: LikelihoodField.of(prior_map, slam.parameters), 5)
    whole = tuple(step + field for step, field in zip(ours, rebuilt, strict=True))
    rows = {"field rebuilt in the window": ours, "field rebuilt everywhere": whole, "in the plan alone": plan_alone}
    show("a step: 4,500 particles, map updated, 2,000 x 800 cells", rows)
    assert ours[1] < whole[1]


def test_bench_slam_thirty_maps():
    """Thirty particles, each with its own map, on the floor of chapter 6; every third scan, as many cells are seen."""
    floor = load_floor_plan("office_floor")
    walls = Walls((floor.truth.walls * WALL).astype(np.uint8), floor.metres_per_pixel)
    prior_map = build_prior_map(walls, Prior(p_wall=0.3, p_space=0.8), cell_size_m=CELL_M)
    log = drive(floor.world, floor.tour, KINECT, ODOMETRY, np.random.default_rng(0), step_m=0.3)
    log = RobotLog(log.odometry[::3], log.ranges[::3], log.bearings, log.scanner, log.start)
    slam, most, began = FastSLAM(localize_in="own", particle_limits=(30, 30)), 0, time.thread_time()
    state = slam.start(prior_map, log, np.random.default_rng(0))
    while not state.done:
        slam.step(state)
        most = max(most, state.own.nbytes + state.own.paths.nbytes)
    step_ms = 1e3 * (time.thread_time() - began) / len(log)
    full = 30 * prior_map.log_odds.nbytes
    print("\n| 30 particle maps of the floor | MB |\n|---|---|")
    print(f"| tiles that copies share, at most ({step_ms:.1f} ms a step) | {most / 1e6:.1f} |\n| whole maps | {full / 1e6:.1f} |")
    assert most < 50e6 < full
