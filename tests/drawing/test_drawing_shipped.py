"""The bundled buildings: walls and doors against their exact truth."""

import numpy as np
import pytest

from priorlab.buildings.floor_plans import floor_plan_names, load_floor_plan
from priorlab.core.score import score_walls
from priorlab.drawing.extraction import extract_walls


def _n_found(doors, truth) -> int:
    """How many true doors have a door whose jambs lie within 0.3 of their width; each counts once."""
    left = list(truth)
    for door in doors:
        jambs = door.points[:2]
        near = [
            t for t in left if min(np.abs(jambs - t.points[:2]).max(), np.abs(jambs[::-1] - t.points[:2]).max()) < 0.3 * t.width
        ]
        if near:
            left.remove(near[0])
    return len(truth) - len(left)


@pytest.mark.parametrize("name", floor_plan_names())
def test_extract_walls_of_a_bundled_building(name):
    plan = load_floor_plan(name)
    found = extract_walls(plan.drawing)
    score = score_walls(found.walls, plan.truth)
    assert score.precision >= 0.98
    assert score.recall >= 0.9
    n_found = _n_found(found.doors, plan.truth.doors)
    assert n_found / len(found.doors) >= 0.8
    assert n_found / len(plan.truth.doors) >= 0.85
