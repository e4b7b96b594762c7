"""Real plans, where PRIORLAB_REAL_DATA says they are: every image runs, and the walls reach what was measured."""

import os
from pathlib import Path

import cv2
import numpy as np
import pytest

from priorlab.core.building import Truth
from priorlab.core.drawing import Drawing
from priorlab.core.score import score_mask
from priorlab.drawing.extraction import extract_walls

LEAST_IOU = {"cvcfp_c14": 0.82, "cvcfp_c2": 0.79, "cvcfp_c13": 0.79, "cvcfp_c3": 0.82, "mlstruct_f302_crop0": 0.56}
CLUTTER = ["lab_intel", "lab_intel_furnitures", "lab_ipa", "lab_ipa_furnitures", "office_a", "office_a_furnitures"]


@pytest.fixture(scope="module")
def real_data() -> Path:
    folder = os.environ.get("PRIORLAB_REAL_DATA")
    if not folder:
        pytest.skip("PRIORLAB_REAL_DATA is not set")
    return Path(folder)


def _read(path: Path) -> Drawing:
    assert path.is_file(), f"{path} is missing"
    image = cv2.imread(str(path), cv2.IMREAD_COLOR)
    return Drawing(cv2.cvtColor(image, cv2.COLOR_BGR2GRAY), cv2.cvtColor(image, cv2.COLOR_BGR2RGB), name=path.stem)


@pytest.mark.parametrize("name", LEAST_IOU)
def test_extract_walls_of_a_real_plan(real_data, name):
    folder = real_data / "plans_real"
    drawing = _read(folder / f"{name}.png")
    walls = _read(folder / f"{name}_walls.png").grey < 128
    ignored = folder / f"{name}_ignore.png"
    ignore = _read(ignored).grey < 128 if ignored.is_file() else np.zeros_like(walls)
    score = score_mask(extract_walls(drawing).walls.mask, Truth(walls, ignore))
    assert score.iou >= LEAST_IOU[name]


@pytest.mark.parametrize("name", CLUTTER)
def test_extract_walls_of_a_map_is_no_exception(real_data, name):
    found = extract_walls(_read(real_data / "clutter_pairs" / f"{name}.png"))
    assert found.walls.mask.any()
