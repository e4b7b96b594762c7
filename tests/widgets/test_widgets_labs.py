"""The labs wire, they do not compute: what they show is what the library's own lines give."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import priorlab as pl
from priorlab.core.picture import grey_of
from priorlab.core.survey import look_around
from priorlab.mapping.recursion import update_step_by_step
from priorlab.plot.extraction import FOUND, INVENTED, MISSED
from priorlab.widgets import MapLab, OneCellLab, UpdateSteps


@pytest.fixture(scope="module")
def rooms():
    labels = np.zeros((40, 60), dtype=np.uint8)
    labels[:3] = labels[-3:] = labels[:, :3] = labels[:, -3:] = 1
    labels[3:24, 30:33] = 1
    walls = pl.Walls(labels, name="rooms")
    truth = pl.Truth(walls=walls.mask, ignore=np.zeros_like(walls.mask))
    readings = pl.explore(truth, look_around([((8, 9), (52, 9))], spacing=4), pl.RangeSensor(max_range=25))
    return walls, truth, readings


@pytest.fixture
def lab(rooms):
    walls, truth, readings = rooms
    grid = pl.build_prior_map(walls, cell_size=3).grid
    return MapLab(walls, pl.gather_evidence(readings, grid), truth)


@settings(max_examples=40, deadline=None)
@given(n_free=st.integers(0, 10), n_wall=st.integers(0, 10), prior=st.integers(2, 98), lam=st.sampled_from([0.0, 0.5, 1.0]))
def test_one_cell_lab_equals_bayes_by_hand(n_free, n_wall, prior, lam):
    lab = OneCellLab(n_free, n_wall, prior / 100, lam)
    odds = prior / (100 - prior)
    by_hand = odds * 9.0**n_free / 9.0**n_wall / odds ** (lam * (n_free + n_wall))
    assert lab.p_empty == pytest.approx(by_hand / (1 + by_hand), abs=1e-12)
    assert lab.track[-1] == pytest.approx(lab.log_odds, abs=1e-9) and len(lab.track) == n_free + n_wall + 1
    assert lab.detected == (by_hand / (1 + by_hand) <= 0.2 + 1e-10)


def test_one_cell_lab_presets_stay_inside_the_sliders_and_say_what_they_do():
    lab = OneCellLab()
    for button in lab.buttons.values():
        button.click()
    lab.buttons["five free readings make a wall"].click()
    assert lab.detected and "detected as wall" in repr(lab) and "detected as wall" in lab.pictures[0].alt


def test_one_cell_lab_picture_is_a_line_drawing_with_every_reading():
    lab = OneCellLab(n_free=3, n_wall=2)
    svg = lab.pictures[0].image.decode()
    assert svg.count("<circle") == 3 and svg.count("width='10' height='10'") == 2


def test_map_lab_slider_gives_what_three_lines_give(lab, rooms):
    walls, truth, readings = rooms
    lab.p_wall.value, lab.p_space.value, lab.lam.value = 0.3, 0.7, 0.5
    prior_map = pl.build_prior_map(walls, pl.Prior(0.3, 0.7), cell_size=3)
    posterior = pl.update_map(prior_map, pl.gather_evidence(readings, prior_map.grid), lam=0.5)
    assert lab.score == pl.score_map(posterior, truth) and lab.prior_score == pl.score_map(prior_map, truth)
    assert lab.prior == pl.Prior(0.3, 0.7)
    shown = cv2.imdecode(np.frombuffer(lab.pictures[0].image, np.uint8), cv2.IMREAD_GRAYSCALE)
    assert (shown == grey_of(posterior.p_empty)).all()


def test_map_lab_one_line_repr_holds_the_numbers(lab):
    assert repr(lab).startswith("MapLab(p_wall 0.20, p_space 0.90, lam 1.00: precision ")
    assert f"F2 {lab.score.f_beta:.3f}" in repr(lab) and "\n" not in repr(lab)
    assert f"F2 {lab.score.f_beta:.3f}" in lab.readout.value and f"F2 {lab.score.f_beta:.3f}" in lab.pictures[0].alt


def test_map_lab_readings_alone_do_not_depend_on_the_sliders(lab):
    before = lab.uninformed_score
    lab.set(p_wall=0.6, lam=0)
    assert lab.uninformed_score == before


def test_map_lab_says_when_eq_2_22_is_broken_and_does_not_warn(lab):
    assert "holds" in lab.readout.value
    lab.p_space.value = 1.0
    assert "p_space 0.9 must lie below the p_free 0.9" in lab.readout.value


def test_map_lab_every_preset_and_reset(lab):
    start = repr(lab)
    said = {name: (button.click(), repr(lab))[1] for name, button in lab.buttons.items() if name != "reset"}
    assert len(set(said.values())) == len(said)
    lab.reset()
    assert repr(lab) == start


def test_map_lab_second_picture_shows_what_the_score_counts(lab):
    picture = cv2.imdecode(np.frombuffer(lab.pictures[1].image, np.uint8), cv2.IMREAD_COLOR)[..., ::-1].reshape(-1, 3)
    score = lab.score
    for colour, count in ((FOUND, score.tp), (INVENTED, score.fp), (MISSED, score.fn), ((255, 255, 255), score.tn)):
        assert (picture == colour).all(axis=1).sum() == count


def test_update_steps_end_where_the_recursion_ends(rooms):
    walls, _, readings = rooms
    prior_map = pl.build_prior_map(walls, cell_size=3)
    steps = UpdateSteps(prior_map, readings, cell=(8, 9), lam=1.0)
    for _ in range(len(readings) + 3):
        steps.step()
    assert steps.k.value == len(readings)
    slow = update_step_by_step(prior_map, readings)
    assert np.abs(steps.map.log_odds - slow.log_odds).max() < 1e-9
    assert steps.log_odds == pytest.approx(slow.log_odds[8, 9], abs=1e-9) and len(steps.track) > 1


def test_update_steps_back_and_forth_is_where_it_was(rooms):
    walls, _, readings = rooms
    steps = UpdateSteps(pl.build_prior_map(walls, cell_size=3), readings, cell=(8, 9))
    steps.k.value = 4
    said = repr(steps)
    steps.step(), steps.step(-1)
    assert repr(steps) == said
    steps.step(-99)
    assert steps.k.value == 0 and steps.log_odds == pytest.approx(np.log(0.81 / 0.19))


def test_update_steps_watched_cell_moves(rooms):
    walls, _, readings = rooms
    steps = UpdateSteps(pl.build_prior_map(walls, cell_size=3), readings)
    steps.set(row=8, col=9, k=len(readings))
    assert "cell (8, 9)" in repr(steps) and "cell (8, 9)" in steps.pictures[1].alt
