"""The score after every reading, and the evidence at any step, against doing it all again: 600 x 800 pixels, 1,600 poses."""

import time

import numpy as np
import pytest

from priorlab.core.drawing import Walls
from priorlab.core.grid_map import Prior
from priorlab.core.score import score_map
from priorlab.core.sensor import RangeSensor
from priorlab.mapping.evidence import gather_evidence
from priorlab.mapping.over_time import score_over_time
from priorlab.mapping.prior import build_prior_map
from priorlab.mapping.timeline import evidence_over_time
from priorlab.mapping.update import update_map
from priorlab.robot.explore import explore

PRIORS = {"plan": Prior(), "none": Prior.uninformed()}


def milliseconds(work, repeats=5):
    """Least time of a call (the machine is shared), and what it returned."""
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        result = work()
        times.append(1e3 * (time.perf_counter() - start))
    return min(times), result


@pytest.mark.parametrize("cell_size", [3, 1])
def test_bench_score_over_time(survey, cell_size):
    truth, poses = survey
    walls = Walls(truth.walls.astype(np.uint8))
    readings = explore(truth, poses, RangeSensor(max_range=40))
    maps = {name: build_prior_map(walls, prior, cell_size) for name, prior in PRIORS.items()}
    grid = maps["plan"].grid

    gathered, timeline = milliseconds(lambda: evidence_over_time(readings, grid), 3)
    scored, curves = milliseconds(lambda: score_over_time(timeline, maps, truth), 3)

    some = np.linspace(0, len(readings), 9).astype(int)
    again_ms, scores = milliseconds(
        lambda: [score_map(update_map(maps[name], timeline.at(k)), truth) for k in some for name in maps], 1
    )
    again_ms *= (len(readings) + 1) / len(some)
    for (k, name), score in zip([(k, name) for k in some for name in maps], scores, strict=True):
        assert (score.tp, score.fp) == (curves.tp[name][k], curves.fp[name][k])

    steps_ms = max(milliseconds(lambda k=k: timeline.at(k))[0] for k in some.tolist())
    whole_ms, _ = milliseconds(lambda: gather_evidence(readings, grid), 3)
    print(
        f"\n{len(readings):,} readings, 2 priors, cells of {cell_size} px, {len(timeline.cell):,} looks                    ms"
        f"\n  looks of every reading, kept in order                {gathered:10.0f}"
        f"\n  F2 after each of {len(readings):,} readings                    {scored:10.0f}   reach 200; "
        f"recomputing {again_ms:,.0f}, {again_ms / scored:,.0f} times as long"
        f"\n  evidence at a step (slider), slowest step            {steps_ms:10.1f}   reach 10; gathering anew {whole_ms:,.0f}"
    )
    assert scored < again_ms / 10
    assert steps_ms < whole_ms
