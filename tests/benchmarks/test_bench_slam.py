"""Speed of chapter 6 against the plain ways: `pytest -s tests/benchmarks/test_bench_slam.py` prints the table.

Milliseconds hang on the machine, so only ratios are asserted, and loosely.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable

import numpy as np
import pytest

from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap
from priorlab.slam.estimate import estimate_pose
from priorlab.slam.likelihood_field import LikelihoodField
from priorlab.slam.localization import choose, predict, weigh
from priorlab.slam.map_update import see_cells, update_seen
from priorlab.slam.measurement import log_weights
from priorlab.slam.parameters import TUNED
from priorlab.slam.particles import Particles
from priorlab.slam.scan import Scan

CELL_M, N_PARTICLES, N_BEAMS = 0.05, 4500, 60


def milliseconds(call: Callable[[], object], n: int) -> float:
    """Median time of n calls, after one to warm up."""
    call()
    times = []
    for _ in range(n):
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return 1e3 * float(np.median(times))


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
    ours = milliseconds(lambda: log_weights(poses, scan, field), 20)
    naive = milliseconds(lambda: naive_log_weights(poses, scan, field), 5)
    few = poses[:150]
    loop = milliseconds(lambda: loop_log_weights(few, scan, field), 2) * N_PARTICLES / len(few)
    assert np.allclose(log_weights(few, scan, field), loop_log_weights(few, scan, field), atol=0.05)
    print("\n| 4,500 particles x 60 beams, 2,000 x 800 cells | ms | times ours |\n|---|---|---|")
    for name, cost in (("weighting", ours), ("naive NumPy", naive), ("Python loop", loop)):
        print(f"| {name} | {cost:.2f} | {cost / ours:.1f} |")
    assert ours < naive < loop


def test_bench_slam_insertion(scene):
    prior_map, _, _, pose, scan, parameters = scene
    prior, fast, slow = prior_map.log_odds, prior_map.log_odds.copy(), prior_map.log_odds.copy()
    ours = milliseconds(lambda: update_seen(fast, prior, see_cells(prior_map.grid, pose, scan, parameters), parameters), 20)
    loop = milliseconds(lambda: loop_insert(slow, prior, prior_map.grid, pose, scan), 5)
    print("\n| inserting a scan of 60 beams | ms | times ours |\n|---|---|---|")
    print(f"| cv2.polylines into a window | {ours:.2f} | 1.0 |\n| Bresenham in Python | {loop:.2f} | {loop / ours:.1f} |")
    assert ours < loop


def test_bench_slam_whole_step(scene):
    prior_map, plan, poses, pose, scan, parameters = scene
    rng, particles, field = np.random.default_rng(0), Particles(poses), plan.copy()
    log_odds_map = prior_map.log_odds.copy()
    everywhere = (slice(0, prior_map.grid.shape[0]), slice(0, prior_map.grid.shape[1]))

    def step(window: bool) -> None:
        weighed = weigh(predict(particles, [0, 0, 0], [0.1, 0, 0.02], rng, parameters), scan, field)
        pose = estimate_pose(weighed, parameters)
        choose(weighed, rng, parameters)
        seen = see_cells(prior_map.grid, pose, scan, parameters)
        update_seen(log_odds_map, prior_map.log_odds, seen, parameters)
        field.refresh(log_odds_map, *((seen.rows, seen.cols) if window else everywhere))

    ours, whole = milliseconds(lambda: step(True), 20), milliseconds(lambda: step(False), 5)
    print("\n| a step: 4,500 particles, map updated, 2,000 x 800 cells | ms | times ours |\n|---|---|---|")
    print(f"| field rebuilt in the window | {ours:.2f} | 1.0 |\n| field rebuilt everywhere | {whole:.2f} | {whole / ours:.1f} |")
    assert ours < whole
