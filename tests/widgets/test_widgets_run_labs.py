"""The labs of notebook 09: what they show is what the library says of that step, whichever way it was reached."""

from __future__ import annotations

import re
from dataclasses import replace

import cv2
import numpy as np
import pytest

import priorlab as pl
from priorlab.core.building import World
from priorlab.plot.extraction import scored_image
from priorlab.slam.trajectory_error import dead_reckoning
from priorlab.widgets import PairLab, RunLab

SCALE = 0.05


@pytest.fixture(scope="module")
def rooms():
    """Two rooms of 4 x 5 m in all; the world has a box that the plan lacks, and a doorway that it walls up."""
    labels = np.zeros((80, 120), dtype=np.uint8)
    labels[10:13, 10:110] = labels[67:70, 10:110] = labels[10:70, 10:13] = labels[10:70, 107:110] = 1
    labels[13:30, 58:62] = labels[48:67, 58:62] = 1
    solid = labels.astype(bool)
    world = solid.copy()
    world[26:33, 72:80] = True
    world[52:64, 58:62] = False
    truth = pl.Truth(solid, np.zeros_like(solid), metres_per_pixel=SCALE)
    return pl.Walls(labels, SCALE, "rooms"), truth, World(world, SCALE)


@pytest.fixture(scope="module")
def run(rooms):
    walls, _, world = rooms
    prior_map = pl.build_prior_map(walls, pl.Prior(0.3, 0.8), cell_size_m=SCALE)
    log = pl.drive(world, [[1.5, 2.0], [4.6, 2.0], [4.6, 1.2], [4.0, 1.1]], rng=np.random.default_rng(3))
    return pl.FastSLAM(particle_limits=(50, 150)).run(prior_map, log, np.random.default_rng(4))


@pytest.fixture
def lab(run, rooms):
    short = replace(run.log, odometry=run.log.odometry[:9], ranges=run.log.ranges[:9], truth=run.log.truth[:9])
    other = pl.FastSLAM(particle_limits=(50, 150)).run(run.prior_map, short, np.random.default_rng(5))
    return RunLab({"whole": run, "short": other}, rooms[1])


def pixels(picture):
    """The image that a picture shows, RGB."""
    return cv2.cvtColor(cv2.imdecode(np.frombuffer(picture.image, np.uint8), cv2.IMREAD_COLOR), cv2.COLOR_BGR2RGB)


@pytest.mark.parametrize("step", [1, 7, 20])
def test_run_lab_numbers_are_those_of_the_run_at_that_step(lab, run, rooms, step):
    truth = rooms[1]
    lab.step.value = step
    with_plan = run.at(step - 1)
    nothing = pl.build_prior_map(rooms[0], pl.Prior.uninformed(), cell_size_m=SCALE)
    without = replace(run, prior_map=nothing).at(step - 1)
    np.testing.assert_allclose(lab.maps["with the plan"].log_odds, with_plan.log_odds, atol=1e-9)
    np.testing.assert_allclose(lab.maps["without"].log_odds, without.log_odds, atol=1e-9)
    assert lab.f2["with the plan"] == pl.score_map(with_plan, truth, 0.5).f_beta
    assert lab.f2["without"] == pl.score_map(without, truth, 0.5).f_beta
    assert lab.alone == pl.score_map(run.prior_map, truth, 0.5).f_beta
    off = (run.trajectory - run.log.truth)[:step, :2]
    assert lab.ate_m == pytest.approx(np.sqrt((off**2).sum(axis=1).mean()))
    assert f"{step} of {len(run)}" in lab.readout.value and f"{run.n_particles[step - 1]}, ESS" in lab.readout.value


def test_run_lab_scrubs_back_to_what_it_was(lab):
    lab.step.value = 5
    before = repr(lab), [picture.image for picture in lab.pictures], lab.readout.value
    lab.step.value = 17
    assert lab.pictures[0].image != before[1][0]
    lab.step.value = 5
    assert (repr(lab), [picture.image for picture in lab.pictures], lab.readout.value) == before


def test_run_lab_play_and_buttons_move_the_slider_and_stay_inside(lab, run):
    lab.play.value = 12
    assert lab.step.value == 12 and "step 12 of" in repr(lab)
    lab.on.click()
    assert lab.step.value == 13 and lab.play.value == 13
    lab.back.click()
    lab.back.click()
    assert lab.step.value == 11
    lab.step.value = 1
    lab.back.click()
    assert lab.step.value == 1
    lab.step.value = len(run)
    lab.on.click()
    assert lab.step.value == len(run) == lab.play.max


def test_run_lab_another_run_has_its_own_steps_and_reset_leads_back(lab, run):
    start = repr(lab)
    lab.which.value = "short"
    assert (lab.step.max, lab.play.max, lab.step.value) == (9, 9, 9) and repr(lab).startswith("RunLab(short, step 9 of 9")
    lab.buttons["the start"].click()
    assert lab.step.value == 1
    lab.shown.value, lab.truth.value = "without", False
    lab.reset()
    assert repr(lab) == start and lab.step.max == len(run) and lab.truth.value and lab.shown.value == "with the plan"


def test_run_lab_buttons_fit_the_shorter_run(lab):
    lab.which.value = "short"
    for name in ("half", "a tenth", "the start"):
        lab.buttons[name].click()
        assert 1 <= lab.step.value <= 9


def test_run_lab_shows_the_true_way_only_when_asked(lab):
    lab.step.value = 20
    green = np.array([0, 158, 115])
    shown = [(np.abs(pixels(lab.pictures[i]).astype(int) - green).sum(axis=2) < 30).sum() for i in (0, 1)]
    lab.truth.value = False
    hidden = [(np.abs(pixels(lab.pictures[i]).astype(int) - green).sum(axis=2) < 30).sum() for i in (0, 1)]
    assert min(shown) > 20 and max(hidden) == 0


def test_run_lab_map_without_the_plan_is_grey_where_nobody_looked(lab):
    lab.step.value = 1
    lab.shown.value = "without"
    picture = pixels(lab.pictures[0])
    assert (picture[2, 2] == 128).all() and "The map without" in lab.pictures[0].alt
    lab.shown.value = "with the plan"
    assert (pixels(lab.pictures[0])[2, 2] > 150).all()


def test_run_lab_says_that_a_robot_is_lost_and_no_gain(run, rooms):
    far = replace(run, trajectory=run.trajectory + [2.0, 0.0, 0.0])
    lab = RunLab({"lost": far}, rooms[1])
    assert "LOST, F2 >= " in repr(lab) and "LOST: means nothing" in lab.readout.value
    assert not re.search(r"[+-]\d+ %", lab.readout.value)


def test_run_lab_line_is_cut_so_that_chance_does_not_show(lab):
    said = [float(number) for number in re.findall(r"\d\.\d+", repr(lab))]
    exact = [lab.ate_m, lab.f2["with the plan"], lab.f2["without"], lab.alone]
    assert 0 <= said[0] - exact[0] < 0.25 and all(0 <= one - cut < 0.1 for cut, one in zip(said[1:], exact[1:], strict=True))


def test_run_lab_without_runs_is_told(rooms):
    with pytest.raises(ValueError, match="runs must hold at least one run"):
        RunLab({}, rooms[1])


def test_run_lab_names_its_controls_and_pictures(lab):
    bundle = lab._repr_mimebundle_()
    assert bundle["text/plain"] == repr(lab) and "image/png" in bundle
    assert all("step" in picture.alt for picture in lab.pictures)
    assert lab.truth.description and lab.shown.description and lab.which.description and lab.back.tooltip


@pytest.fixture(scope="module")
def pair(run, rooms):
    return PairLab(run, *rooms)


@pytest.mark.parametrize(
    "changes", [{}, {"lam": 0.0}, {"thickening_m": 0.2, "p_wall": 0.25}, {"threshold": 0.2, "p_space": 0.6}, {"lam": 0.4}]
)
def test_pair_lab_maps_are_those_of_the_run_replayed(pair, run, rooms, changes):
    walls, truth, _ = rooms
    pair.reset()
    pair.set(**changes)
    prior = pl.Prior(changes.get("p_wall", 0.3), changes.get("p_space", 0.8))
    parameters = replace(run.parameters, thickening_m=changes.get("thickening_m", 0.1), lam=changes.get("lam", 1.0))
    replayed = replace(run, parameters=parameters)
    start, nothing = (pl.build_prior_map(walls, one, cell_size_m=SCALE) for one in (prior, pl.Prior.uninformed()))
    threshold = changes.get("threshold", 0.5)
    for shown, score, one in ((pair.map, pair.worth.informed, start), (pair.without, pair.worth.uninformed, nothing)):
        np.testing.assert_allclose(shown.log_odds, replayed.remap(one).log_odds, atol=1e-9)
        assert score == pl.score_map(replayed.remap(one), truth, threshold)
    assert pair.worth.alone == pl.score_map(start, truth, threshold)
    picture = scored_image(start.grid.to_image(pair.map.detected(threshold)), truth)
    assert np.array_equal(pixels(pair.pictures[0]), picture[: pixels(pair.pictures[0]).shape[0]])


def test_pair_lab_tells_what_was_added_and_never_a_gain_alone(pair):
    pair.reset()
    assert pair.added.blocked.share["alone"] == 0 and pair.added.blocked.share["with"] > 0.3
    for words in ("gain of the plan", "ATE of the poses", "coverage", "F2, the plan alone", "P(empty) &lt; 0.5"):
        assert words in pair.readout.value


def test_pair_lab_of_a_lost_robot_gives_no_gain(run, rooms):
    lost = PairLab(replace(run, trajectory=dead_reckoning(run.log) + [1.5, 0, 0]), *rooms)
    assert "LOST: means nothing" in lost.readout.value and "gain of the plan" in lost.readout.value


def test_pair_lab_presets_stay_inside_the_sliders_and_reset_leads_back(pair):
    pair.reset()
    before = repr(pair)
    for button in pair.buttons.values():
        button.click()
    assert repr(pair) == before
    pair.buttons["the prior of chapter 4"].click()
    assert "0.81 must lie below the p_free 0.8" in pair.readout.value
    pair.reset()
