"""Every prior at once against the ways that it replaces: 600 x 800 pixels, cells of 3 px, measured in the same run."""

import time

import numpy as np
import pytest

from priorlab.core.building import Truth
from priorlab.core.drawing import Walls
from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.log_odds import log_odds
from priorlab.core.score import score_map
from priorlab.core.sensor import RangeSensor
from priorlab.core.survey import look_around
from priorlab.mapping.evidence import gather_evidence
from priorlab.optimize.experiment import Experiment
from priorlab.optimize.pareto import pareto_front
from priorlab.robot.explore import explore
from priorlab.robot.inverse_sensor_model import observe
from priorlab.robot.range_noise import RangeNoise

HEIGHT, WIDTH, CELL = 600, 800, 3


@pytest.fixture(scope="module")
def building():
    """Rooms of 120 px with slanting partitions, so that cells are cut at many angles; a survey of about 600 poses."""
    rng = np.random.default_rng(0)
    truth = np.zeros((HEIGHT, WIDTH), dtype=bool)
    segments = []
    for top in range(15, HEIGHT - 130, 120):
        for left in range(15, WIDTH - 130, 120):
            truth[top : top + 125, left : left + 5] = truth[top : top + 5, left : left + 125] = True
            truth[top : top + 125, left + 120 : left + 125] = truth[top + 120 : top + 125, left : left + 125] = True
            slope = rng.uniform(-0.5, 0.5)
            for step in range(50):
                row, col = top + 10 + step, int(left + 30 + step * slope)
                truth[row, col : col + 4] = True
            x, y = left + 62, HEIGHT - (top + 62)
            segments += [((x - 40, y - 35), (x + 40, y - 35)), ((x + 40, y - 35), (x + 40, y + 40))]
    poses = look_around(segments, spacing=6)
    poses = poses[~truth[tuple(Grid(truth.shape).xy_to_pixel(poses[:, :2]).T)]]
    walls = truth.copy()
    for row, col in zip(rng.integers(0, HEIGHT - 30, 80), rng.integers(0, WIDTH - 30, 80), strict=True):
        walls[row : row + 25, col : col + 25] = False  # missed ...
    for row, col in zip(rng.integers(0, HEIGHT - 60, 25), rng.integers(0, WIDTH - 60, 25), strict=True):
        walls[row : row + 3, col : col + 55] = True  # ... and invented
    noise = RangeNoise(2.0)
    readings = explore(Truth(truth, truth & False), poses, RangeSensor(max_range=40), rng, noise)
    return Walls(walls.astype(np.uint8)), Truth(truth, truth & False), readings


def milliseconds(work, repeats=7):
    """Median time of a call, and what it returned."""
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        result = work()
        times.append(1e3 * (time.perf_counter() - start))
    return float(np.median(times)), result


def pair_by_recursion(experiment, looks, prior):
    """One prior the step-by-step way, pose after pose: l_k = logit(ISM) + l_{k-1} - l_0 (eq. 4.11), then its score."""
    at_wall, at_space = log_odds([prior.effective_p_wall, prior.effective_p_space])
    l_0 = np.where(experiment.wall_cells, at_wall, at_space).ravel()
    after = l_0.copy()
    for cell, logit in looks:
        after[cell] = logit + after[cell] - l_0[cell]
    grid = experiment.evidence.grid
    return score_map(GridMap(after.reshape(grid.shape), grid), experiment.truth)


def test_bench_sweep_and_front(building):
    walls, truth, readings = building
    grid = Grid((HEIGHT, WIDTH), CELL)
    experiment = Experiment(walls, gather_evidence(readings, grid), truth)
    looks = [(seen.cell, log_odds(seen.p_empty)) for k in range(len(readings)) for seen in observe(readings[k : k + 1], grid)]

    sort_ms, sweep = milliseconds(lambda: Experiment(walls, experiment.evidence, truth).sweep())

    def a_million_pairs():
        table = sweep.grid(1000)
        return table.precision, table.recall, table.f_beta

    million_ms, _ = milliseconds(a_million_pairs)
    priors = [Prior(p_wall, p_space) for p_wall in sweep.grid(10).p_wall for p_space in sweep.grid(10).p_space]
    hundred_ms, by_recursion = milliseconds(lambda: [pair_by_recursion(experiment, looks, prior) for prior in priors], repeats=1)
    front_ms, exact = milliseconds(sweep.front)
    search_ms, found = milliseconds(lambda: pareto_front(experiment, np.random.default_rng(0)), repeats=3)
    share = found.hypervolume / exact.hypervolume
    faster = (hundred_ms / 100) / ((sort_ms + million_ms) / 1e6)

    rows = [
        ("sort the cells, once", sort_ms, ""),
        ("precision, recall, F2 of 1,000 x 1,000 pairs", million_ms, "reach 20 ms"),
        ("the recursion on 100 pairs", hundred_ms, f"{faster:,.0f} times slower per pair, sort included"),
        (f"exact Pareto front ({len(exact)} priors)", front_ms, "reach 30 ms"),
        (
            f"NSGA-II 60 x 40 ({len(found)} priors)",
            search_ms,
            f"hypervolume {found.hypervolume / exact.hypervolume:.3f} of the exact",
        ),
    ]
    print(
        f"\n{experiment}, {len(readings)} poses\n"
        + "\n".join(f"  {what:<46} {ms:9.2f} ms   {remark}" for what, ms, remark in rows)
    )

    for prior, score in zip(priors, by_recursion, strict=True):
        assert (score.tp, score.fp) == (sweep.at(prior.p_wall, prior.p_space).tp, sweep.at(prior.p_wall, prior.p_space).fp)
    assert faster >= 1000
    assert front_ms < search_ms
    assert share <= 1 + 1e-12
