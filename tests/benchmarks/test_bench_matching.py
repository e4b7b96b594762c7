"""Coarse to fine against exhaustive: `pytest -s tests/benchmarks/test_bench_matching.py` prints the table.

Milliseconds hang on the machine, so only ratios are asserted, and loosely.
"""

from __future__ import annotations

import math
import time

import numpy as np
import pytest

from priorlab.core.building import World
from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap
from priorlab.core.sensor import Scanner
from priorlab.robot.drive import drive
from priorlab.slam.growing_map import GrowingMap
from priorlab.slam.likelihood_field import LikelihoodField
from priorlab.slam.match_search import find_best
from priorlab.slam.matched_mapping import Slip
from priorlab.slam.measurement import log_weights
from priorlab.slam.scan import choose_beams
from priorlab.slam.scan_matching import MATCHING, Window, match_scan

CELL_M = 0.05
LASER = Scanner(181, math.pi, 0.1, 20.0, 0.02, 0.0, 0.0)


def milliseconds(call, n):
    """Median of this thread's own time of n calls, after one to warm up: other processes do not count."""
    call()
    times = []
    for _ in range(n):
        start = time.thread_time()
        call()
        times.append(time.thread_time() - start)
    return 1e3 * float(np.median(times))


@pytest.fixture(scope="module")
def scene():
    """Rooms of 4 x 5 m with doors on 600 x 800 cells, a scan of 90 beams in one of them, wheels 0.25 m and 5 degrees off."""
    walls = np.zeros((600, 800), dtype=bool)
    walls[::80], walls[:, ::100], walls[-1], walls[:, -1] = True, True, True, True
    walls[80:-1:80, 40:60], walls[30:50, 100:-1:100] = False, False
    log = drive(World(walls, CELL_M), [[17.0, 12.0], [18.0, 13.0]], LASER, rng=np.random.default_rng(0))
    field = LikelihoodField.of(GridMap(np.where(walls, -2.0, 2.0), Grid(walls.shape, 1, CELL_M)), MATCHING)
    truth = log.truth[4]
    return field, choose_beams(log, 4, MATCHING), truth, truth + [0.2, -0.15, math.radians(5)]


def exhaustive(points_scan, field, guess, window):
    """The score of every pose of the window by the look-up of algorithm 6.4, as the filter does it for its particles."""
    steps = math.ceil(window.half_m / CELL_M - 1e-9)
    side = CELL_M * np.arange(-steps, steps + 1)
    step = np.stack(np.meshgrid(window.turns, side, side, indexing="ij"), axis=-1).reshape(-1, 3)[:, [2, 1, 0]]
    return log_weights(guess + step, points_scan, field) - 0.5 * np.square(step / window.spread).sum(axis=1), step


def test_bench_matching_coarse_to_fine_against_exhaustive(scene):
    field, scan, truth, guess = scene
    print("\n| window | poses | scored | coarse to fine, ms | exhaustive, ms | ratio |\n|---|---|---|---|---|---|")
    for half_m, half_turn in ((0.3, 10.0), (0.6, 15.0), (1.2, 20.0)):
        window = Window(half_m / 3, math.radians(half_turn) / 3)
        steps = math.ceil(window.half_m / CELL_M - 1e-9)
        best = find_best(scan.points, field, guess, window.turns, steps, window.spread)
        scores, step = exhaustive(scan, field, guess, window)
        assert best.score == pytest.approx(scores.max(), abs=0.05)  # the filter's look-up rounds in float32
        ours = milliseconds(lambda w=window, s=steps: find_best(scan.points, field, guess, w.turns, s, w.spread), 15)
        slow = milliseconds(lambda w=window: exhaustive(scan, field, guess, w), 3)
        cost = f"{ours:.1f} | {slow:.1f} | {slow / ours:.0f}"
        print(f"| {half_m} m, {half_turn:.0f} degrees | {len(step):,} | {best.n_scored:,} | {cost} |")
    assert slow > 5 * ours
    found = match_scan(scan, field, guess, Window(0.1, math.radians(10) / 3)).pose
    assert np.hypot(*(found - truth)[:2]) < CELL_M


def test_bench_matching_a_step_of_mapping(scene):
    field, scan, truth, guess = scene
    growing = GrowingMap(MATCHING, CELL_M, truth[:2])
    growing.insert(truth, scan)
    window = Slip().window(np.array([0.2, 0.0, 0.1]))
    match = milliseconds(lambda: match_scan(scan, field, guess, window), 15)
    insert = milliseconds(lambda: growing.insert(truth, scan), 15)
    print(f"\n| a step of mapping by matching | ms |\n|---|---|\n| match | {match:.1f} |\n| insert | {insert:.1f} |")
    assert match < 100 and insert < 100
