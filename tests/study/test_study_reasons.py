"""Why recall is highest where it is: the closed form against the exact sweep and against every pair by loop; discord by loop."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from priorlab.core.building import Truth
from priorlab.core.drawing import Walls
from priorlab.core.grid import Grid
from priorlab.core.readings import Evidence
from priorlab.core.sensor import RangeSensor
from priorlab.optimize.experiment import Experiment
from priorlab.study.discord import discord_of
from priorlab.study.recall_reasons import recall_reasons


def random_experiment(seed, lam=1.0):
    """Cells of one pixel with 0 to 4 looks that tie often."""
    rng = np.random.default_rng(seed)
    shape = (6, 7)
    truth = rng.random(shape) < 0.5
    walls = truth ^ (rng.random(shape) < 0.3)
    looks = rng.integers(0, 5, shape)
    said = np.log(1 / 9) * rng.choice([-1.0, 1.0, 0.5, 0.0], size=(*shape, 4))
    total = np.where(np.arange(4) < looks[..., None], said, 0).sum(axis=-1)
    evidence = Evidence(total, looks, Grid(shape), RangeSensor())
    return Experiment(Walls(walls.astype(np.uint8)), evidence, Truth(truth, np.zeros(shape, dtype=bool)), lam)


def true_walls_found(experiment, p_wall, p_space):
    """Loop over the cells with eq. 4.11 written out."""
    found = 0
    for row, col in np.ndindex(experiment.walls.mask.shape):
        p = 0.9 * (p_wall if experiment.walls.mask[row, col] else p_space)
        l_0 = math.log(p / (1 - p))
        n, total = int(experiment.evidence.looks[row, col]), float(experiment.evidence.total[row, col])
        found += bool(experiment.truth.walls[row, col]) and l_0 + total - n * l_0 <= math.log(0.25) + 1e-9
    return found


@settings(max_examples=40)
@given(seed=st.integers(0, 10_000))
def test_reasons_foresee_the_highest_recall(seed):
    experiment = random_experiment(seed)
    wall, space = recall_reasons(experiment)
    best = experiment.sweep().best("recall")
    found = wall.found + space.found
    assert found == round(best.value * experiment.truth.walls.sum())
    assert found == true_walls_found(experiment, wall.best, space.best)
    if found:
        assert any(wall.best in where.p_wall and space.best in where.p_space for where in best.plateaus)


def test_reasons_name_the_cells_that_decide():
    looks = np.array([[0, 0, 0, 2, 2, 1]])  # three walls never seen, two seen twice, one once
    total = np.array([[0, 0, 0, -0.5, -0.5, np.log(1 / 9)]])
    evidence = Evidence(total, looks, Grid((1, 6)), RangeSensor())
    walls, everywhere = Walls(np.ones((1, 6), dtype=np.uint8)), Truth(np.ones((1, 6), dtype=bool), np.zeros((1, 6), dtype=bool))
    wall, space = recall_reasons(Experiment(walls, evidence, everywhere))
    assert (wall.unseen, wall.once, wall.at_cliff, wall.at_bound) == (3, 1, 0, 2)
    assert wall.is_cliff and wall.best == pytest.approx(0.2 / 0.9) and wall.found == 4
    assert wall.sentence == "p_wall up to 0.222: n = 0 holds 3 px, n >= 2 would gain 2"
    assert space.found == 0 and space.sentence.startswith("any p_space")

    looks[0, :2] = 2  # now four are seen twice
    wall, _ = recall_reasons(Experiment(walls, Evidence(total - 0.5, looks, Grid((1, 6)), RangeSensor()), everywhere))
    assert not wall.is_cliff and wall.best == 1.0
    assert wall.sentence == "p_wall high: n >= 2 gains 4 px, n = 0 holds only 1"


def test_reasons_hold_for_the_thesis_update_only():
    with pytest.raises(ValueError, match="lam must be 1, the thesis's update, got 0"):
        recall_reasons(random_experiment(0, lam=0.0))


@given(st.lists(st.tuples(st.sampled_from([0.1, 0.2, 0.5, math.nan]), st.sampled_from([0.0, 0.01, 0.3])), max_size=12))
def test_discord_by_loop(points):
    precision, rate = [p for p, _ in points], [r for _, r in points]
    pairs = discordant = 0
    for i in range(len(points)):
        for j in range(i):
            if math.isnan(precision[i]) or math.isnan(precision[j]):
                continue
            apart, more = precision[i] - precision[j], rate[i] - rate[j]
            pairs += apart != 0 and more != 0
            discordant += apart * more > 0
    found = discord_of(precision, rate)
    assert (found.pairs, found.discordant) == (pairs, discordant)
    if found.worst:
        better, worse = found.worst
        assert precision[better] > precision[worse] and rate[better] > rate[worse]
    assert found.share == (discordant / pairs if pairs else 0)
