"""Where readings and plan differ."""

import numpy as np
import pytest

from priorlab.core.building import World
from priorlab.core.drawing import Walls
from priorlab.core.grid_map import Prior
from priorlab.core.sensor import RangeSensor
from priorlab.mapping.disagreement import find_disagreement
from priorlab.mapping.evidence import gather_evidence
from priorlab.mapping.prior import build_prior_map
from priorlab.robot.explore import explore


def survey_of(plan, world):
    """The prior of a plan, and what a robot in the left part of a world sees."""
    prior_map = build_prior_map(Walls(plan.astype(np.uint8)))
    poses = [[3.5, y + 0.5, 0.0] for y in range(3, 17)]
    return prior_map, gather_evidence(explore(World(world, 0.05), poses, RangeSensor(max_range=16)), prior_map.grid)


def test_disagreement_finds_what_moved():
    plan, world = np.zeros((20, 30), dtype=bool), np.zeros((20, 30), dtype=bool)
    plan[:, 25:], world[:, 25:] = True, True
    plan[5:8, 10:12] = True  # a pillar that is gone
    world[12:15, 10:14] = True  # a cupboard that nobody drew, as thick as a wall
    found = find_disagreement(*survey_of(plan, world))
    assert (found.opened == (plan & ~world)).all()
    near_cupboard = np.zeros_like(world)
    near_cupboard[8:19, 10:18] = True  # at most a wall's thickness behind a hit
    assert (found.blocked <= near_cupboard).all()
    assert found.blocked[12:15, 10].all() and not found.blocked[5:8, 10:12].any()
    assert (found.anywhere == (found.opened | found.blocked)).all()


def test_disagreement_is_nowhere_when_the_plan_is_right():
    plan = np.zeros((20, 30), dtype=bool)
    plan[:, 14:] = True
    prior_map, evidence = survey_of(plan, plan)
    assert evidence.seen.any() and not find_disagreement(prior_map, evidence).anywhere.any()


def test_an_uninformed_map_is_never_contradicted(strip):
    prior_map = build_prior_map(Walls(np.ones((1, 2), np.uint8)), Prior.uninformed())
    assert not find_disagreement(prior_map, strip(0.9, [5, 0])).anywhere.any()


@pytest.mark.parametrize(("looks", "margin", "opened"), [(1, 2.0, True), (1, 2.3, False), (2, 2.3, True), (0, 0.0, False)])
def test_disagreement_needs_more_than_its_margin(strip, looks, margin, opened):
    prior_map = build_prior_map(Walls(np.ones((1, 1), np.uint8)))
    assert find_disagreement(prior_map, strip(0.9, [looks]), margin).opened.item() == opened


def test_find_disagreement_says_what_is_wrong(strip):
    prior_map = build_prior_map(Walls(np.ones((1, 2), np.uint8)))
    with pytest.raises(ValueError, match="one grid"):
        find_disagreement(prior_map, strip(0.9, [1]))
    with pytest.raises(ValueError, match="margin must be at least 0, got -1"):
        find_disagreement(prior_map, strip(0.9, [1, 1]), margin=-1)
