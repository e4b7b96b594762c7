"""A teacher's own building, names that nobody knows, and where the shipped data lies."""

import re
import shutil
from pathlib import Path

import numpy as np
import pytest

from priorlab.buildings.floor_plans import load_floor_plan
from priorlab.core.shipped import data_folder

PAGE = Path(__file__).parents[2] / "docs" / "adding_a_building.md"


def example_of_the_page():
    (text,) = re.findall(r"```toml\n(.*?)```", PAGE.read_text(encoding="utf-8"), flags=re.DOTALL)
    return text


def test_example_of_the_page_renders(tmp_path):
    own = tmp_path / "garden_house.toml"
    own.write_text(example_of_the_page(), encoding="utf-8")
    plan = load_floor_plan(own)
    assert plan.name == "garden_house" and len(plan.truth.doors) == 2
    assert plan.truth.walls.any() and plan.truth.windows.any() and len(plan.survey) > 20 and len(plan.tour) > 2
    hidden = plan.world.obstacles & ~plan.truth.obstacles & ~plan.truth.ignore & (plan.drawing.grey == 255)
    assert hidden.any()  # the box that the plan lacks
    assert load_floor_plan(str(own)) is plan


def test_own_building_is_read_again_when_it_changed(tmp_path):
    own = tmp_path / "shed.toml"
    own.write_text(example_of_the_page(), encoding="utf-8")
    before = load_floor_plan(own)
    own.write_text(example_of_the_page().replace("metres_per_pixel = 0.02", "metres_per_pixel = 0.04"), encoding="utf-8")
    assert load_floor_plan(own).drawing.shape[0] < before.drawing.shape[0]


def test_load_floor_plan_tells_the_nearest_name():
    with pytest.raises(ValueError, match="building must be one of .*, got 'smal_flat'; did you mean 'small_flat'?"):
        load_floor_plan("smal_flat")
    with pytest.raises(FileNotFoundError, match="does not exist"):
        load_floor_plan("no_such_file.toml")


def test_load_floor_plan_refuses_a_spacing_of_nothing():
    with pytest.raises(ValueError, match="survey_spacing must be a finite number above 0, got 0"):
        load_floor_plan("small_flat", survey_spacing=0)


def test_data_folder_of_a_checkout():
    assert data_folder() == Path(__file__).parents[2] / "data"


def test_data_folder_of_a_wheel(tmp_path):
    package = tmp_path / "site-packages" / "priorlab"
    shutil.copytree(data_folder(), package / "data")
    assert data_folder(package) == package / "data"
    plan = load_floor_plan(package / "data" / "small_flat.toml")
    assert np.array_equal(plan.drawing.grey, load_floor_plan("small_flat").drawing.grey)


def test_data_folder_says_when_nothing_is_there(tmp_path):
    with pytest.raises(FileNotFoundError, match="install priorlab again"):
        data_folder(tmp_path / "priorlab")
