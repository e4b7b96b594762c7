"""The five drawings of chapters 4 and 5: thin walls, a gain that turns round, and fronts of several points."""

import numpy as np
import pytest

from priorlab.buildings.floor_plans import floor_plan_names
from priorlab.core.grid import Grid
from priorlab.core.grid_map import Prior
from priorlab.mapping.evidence import gather_evidence
from priorlab.optimize.experiment import Experiment
from priorlab.robot.explore import explore
from priorlab.study.qualities import extracted
from priorlab.study.thesis_drawings import DENSE, QUICK, THESIS_DRAWINGS, THOROUGH, sensor_for, thesis_plan


def experiment(name, cell_size, spacing):
    """The extracted walls of a building after a survey."""
    plan = thesis_plan(name, spacing)
    readings = explore(plan.truth, plan.survey, sensor_for(plan))
    return Experiment(extracted(name).walls, gather_evidence(readings, Grid(plan.truth.shape, cell_size)), plan.truth)


def gain(one):
    """Of (0.2, 0.9) over 0.5, percent."""
    return 100 * (one.score(Prior()).f_beta / one.score(Prior.uninformed()).f_beta - 1)


def test_they_are_two_flats_and_three_sections_of_an_office():
    assert set(THESIS_DRAWINGS) <= set(floor_plan_names())
    assert [name.split("_")[0] for name in THESIS_DRAWINGS] == ["flat", "flat", "office", "office", "office"]


@pytest.mark.parametrize("name", THESIS_DRAWINGS)
def test_walls_are_thin_and_doors_as_wide_as_in_the_thesis(name):
    plan = thesis_plan(name)
    height, width = plan.drawing.shape
    assert height <= 800 and width <= 800
    assert 20 <= sensor_for(plan).max_range <= 40
    solid = plan.truth.obstacles
    depth = np.zeros(solid.shape, dtype=int)  # how many rims can be peeled off: 2 for walls up to 4 px
    layer = solid.copy()
    while layer.any():
        depth += layer
        padded = np.pad(layer, 1)
        layer = layer & padded[:-2, 1:-1] & padded[2:, 1:-1] & padded[1:-1, :-2] & padded[1:-1, 2:]
    assert np.mean(depth[solid] <= 2) > 0.95


@pytest.mark.parametrize("name", THESIS_DRAWINGS)
def test_a_denser_survey_takes_the_gain_away(name):
    quick, thorough, dense = (gain(experiment(name, 3, spacing)) for spacing in (QUICK, THOROUGH, DENSE))
    assert quick > 60 and quick > thorough > dense
    assert dense < quick / 4
    if name.startswith("office"):
        assert thorough < 0 and dense < 0


@pytest.mark.parametrize("name", THESIS_DRAWINGS)
def test_a_thorough_survey_has_a_front_of_several_points(name):
    assert len(experiment(name, 3, THOROUGH).sweep().front()) > 3
