"""Scrubbing through a run: `pytest -s tests/benchmarks/test_bench_scrubbing.py` prints the table.

Milliseconds hang on the machine, so only a ratio is asserted, and loosely. `Run.at` copies, pastes and draws on one thread, so
the thread's own time is what a free machine would show.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable

import numpy as np
import pytest

from priorlab.buildings.floor_plans import load_floor_plan
from priorlab.core.drawing import WALL, Walls
from priorlab.core.grid_map import Prior
from priorlab.mapping.prior import build_prior_map
from priorlab.robot.drive import drive
from priorlab.slam.parameters import TUNED
from priorlab.slam.recording import Run


@pytest.fixture(scope="module")
def run() -> Run:
    """The whole tour of the office floor, 40 x 10 m, known to the millimetre: scrubbing does not ask how the poses were found."""
    plan = load_floor_plan("office_floor")
    walls = Walls((plan.truth.walls * WALL).astype(np.uint8), plan.metres_per_pixel)
    prior_map = build_prior_map(walls, Prior(0.3, 0.8), cell_size_m=0.05)
    log = drive(plan.world, plan.tour, rng=np.random.default_rng(0))
    n = len(log)
    nothing = np.zeros((n, 1, 3), dtype=np.float32)
    return Run(prior_map, log, TUNED, prior_map, log.truth, np.full(n, 1500), np.ones(n), nothing, np.ones(n))


def milliseconds(call: Callable[[int], object], steps: Iterable[int]) -> tuple[float, float, float]:
    """Median, 90th percentile and maximum."""
    times = []
    for step in steps:
        start = time.thread_time()
        call(int(step))
        times.append(1e3 * (time.thread_time() - start))
    return (*np.percentile(times, [50, 90]), max(times))


def test_bench_scrubbing(run):
    start = time.thread_time()
    kept = run.replay.nbytes
    first = 1e3 * (time.thread_time() - start)
    n, anywhere = len(run), np.random.default_rng(1).integers(0, len(run), 100)

    def from_the_start(step: int) -> np.ndarray:
        log_odds_map = run.prior_map.log_odds.copy()
        for k in range(step + 1):
            run._draw(log_odds_map, k)
        return log_odds_map

    rows = {
        "at(k), any k": milliseconds(run.at, anywhere),
        "at(k), forward": milliseconds(run.at, range(0, n, 25)),
        "at(k), backward": milliseconds(run.at, range(n - 1, -1, -25)),
        "from the start, any k": milliseconds(from_the_start, anywhere[:3]),
    }
    rows_of_map, cols_of_map = run.prior_map.grid.shape
    print(f"\n| {n} steps, {cols_of_map} x {rows_of_map} cells; ms | median | 90 % | most |\n|---|---|---|---|")
    for name, times in rows.items():
        print(f"| {name} | " + " | ".join(f"{value:.2f}" for value in times) + " |")
    print(f"| the first at(k) of a run, once | {first:.0f} | | |")
    print(f"\nkept {kept / 1e6:.1f} MB; a map of every step would be {n * run.map.log_odds.nbytes / 1e6:.0f} MB")
    assert np.array_equal(run.at(int(anywhere[0])).log_odds, from_the_start(int(anywhere[0])))
    assert rows["at(k), any k"][1] < rows["from the start, any k"][0]
