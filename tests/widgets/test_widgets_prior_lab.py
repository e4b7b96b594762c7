"""The lab of notebook 03: what it shows is what the library's own lines give, for every plan and cell size."""

from __future__ import annotations

from dataclasses import replace

import cv2
import numpy as np
import pytest

import priorlab as pl
from priorlab.core.picture import grey_of
from priorlab.core.survey import look_around
from priorlab.widgets import PriorLab


@pytest.fixture(scope="module")
def rooms():
    labels = np.zeros((40, 60), dtype=np.uint8)
    labels[:3] = labels[-3:] = labels[:, :3] = labels[:, -3:] = 1
    labels[3:24, 30:33] = 1
    walls = pl.Walls(labels, name="rooms")
    truth = pl.Truth(walls=walls.mask, ignore=np.zeros_like(walls.mask))
    return walls, truth, pl.explore(truth, look_around([((8, 9), (52, 9))], spacing=4), pl.RangeSensor(max_range=25))


@pytest.fixture
def lab(rooms):
    walls, truth, readings = rooms
    opened = walls.labels.copy()
    opened[3:24, 30:33] = 0
    return PriorLab({"right": walls, "open": replace(walls, labels=opened)}, readings, truth)


@pytest.mark.parametrize("cell_size", [1, 3, 7])
def test_prior_lab_gives_what_the_library_gives(lab, rooms, cell_size):
    walls, truth, readings = rooms
    lab.set(p_wall=0.3, p_space=0.7, cell_size=cell_size)
    prior_map = pl.build_prior_map(walls, pl.Prior(0.3, 0.7), cell_size=cell_size)
    posterior = pl.update_map(prior_map, pl.gather_evidence(readings, prior_map.grid))
    assert lab.prior_score == pl.score_map(prior_map, truth) and lab.score == pl.score_map(posterior, truth)
    assert lab.wall_share == pytest.approx(prior_map.grid.any_in_cells(walls.mask).mean())
    shown = cv2.imdecode(np.frombuffer(lab.pictures[0].image, np.uint8), cv2.IMREAD_GRAYSCALE)
    assert (shown == grey_of(prior_map.p_empty)).all()


def test_prior_lab_readout_shows_the_effective_values(lab):
    lab.set(p_wall=0.3, p_space=0.8)
    assert "0.30 x 0.9 = <b>0.270</b>" in lab.readout.value and "0.80 x 0.9 = <b>0.720</b>" in lab.readout.value
    assert f"{np.log(0.27 / 0.73):+.2f}" in lab.readout.value and f"{np.log(0.72 / 0.28):+.2f}" in lab.readout.value


def test_prior_lab_another_plan_and_reset(lab):
    start = repr(lab)
    assert start.startswith("PriorLab(right, p_wall 0.20, p_space 0.90, cells of 3 px, ")
    lab.plan.value = "open"
    assert repr(lab).startswith("PriorLab(open, ") and lab.prior_score.recall < 0.95
    lab.p_wall.value = 0.5
    lab.reset()
    assert repr(lab) == start


def test_prior_lab_says_when_eq_2_22_is_broken_and_does_not_warn(lab):
    assert "holds" in lab.readout.value
    lab.buttons["surer than the sensor"].click()
    assert "must lie below the p_free 0.9" in lab.readout.value and "must lie above the p_occupied 0.1" in lab.readout.value


def test_prior_lab_presets_differ_and_the_curve_has_words(lab):
    said = {name: (button.click(), repr(lab))[1] for name, button in lab.buttons.items() if name != "reset"}
    assert len(set(said.values())) == len(said)
    lab.reset()
    assert "Walls start at -1.52, space at 1.45" in lab.pictures[1].alt and lab.pictures[1].mime == "image/svg+xml"


def test_prior_lab_flipped_convention_shows_the_negative(lab):
    right = lab.prior_map.p_empty
    lab.set(p_wall=0.9, p_space=0.2)
    assert np.abs(lab.prior_map.p_empty - (0.99 - right)).max() < 1e-12  # 0.81 where it was 0.18 and the other way round
