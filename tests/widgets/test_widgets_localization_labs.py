"""The labs of notebook 08 wire, they do not compute: what they show is what the library's own lines give."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

import priorlab as pl
from priorlab.slam.likelihood_field import LikelihoodField
from priorlab.slam.measurement import log_weights
from priorlab.slam.motion import motion_deviations, motion_parts, sample_motion
from priorlab.slam.parameters import Parameters
from priorlab.slam.resampling import resample
from priorlab.slam.scan import choose_beams
from priorlab.widgets import FieldLab, MotionLab, ResampleLab, StepLab

FEW = Parameters(particle_limits=(30, 80), start_variances=(0.01, 0.01, 0.01))


@pytest.fixture(scope="module")
def rooms():
    """Two rooms that look alike, 3 m apart, and a drive through the left one."""
    labels = np.zeros((60, 123), dtype=np.uint8)
    labels[:3] = labels[-3:] = 1
    labels[:, :3] = labels[:, 60:63] = labels[:, 120:] = 1
    walls = pl.Walls(labels, metres_per_pixel=0.05)
    log = pl.drive(pl.World(walls.mask, 0.05), [[0.6, 0.6], [1.2, 1.2], [1.2, 2.2]], rng=np.random.default_rng(0))
    return pl.build_prior_map(walls, pl.Prior(0.3, 0.8), cell_size_m=0.05), log


@pytest.fixture
def field_lab(rooms):
    return FieldLab(*rooms, step=5, looks_like=3.0)


@pytest.fixture
def steps(rooms):
    return StepLab(*rooms, {"few": FEW, "printed": replace(FEW, temper=1.0)}, np.random.default_rng(3))


def test_motion_lab_gives_what_the_library_gives():
    lab = MotionLab(seed=4)
    lab.set(forward=300, left=-40, turned=20, steps=3, alpha_1=0.1, alpha_2=0.02, alpha_3=0.04, alpha_4=0.06, std=1, literal=1)
    parameters = Parameters(alphas=(0.1, 0.02, 0.04, 0.06), noise="std", rotation_noise="literal")
    step = [0.3, -0.04, np.radians(20)]
    assert lab.parts == motion_parts([0, 0, 0], step)
    assert (lab.deviations == motion_deviations(*lab.parts, parameters)).all()
    rng, poses = np.random.default_rng(4), np.zeros((400, 3))
    exactly = Parameters(alphas=(0, 0, 0, 0))
    for _ in range(3):
        sample_motion(np.zeros((1, 3)), [0, 0, 0], step, rng, exactly)  # the way of the wheels draws too
        poses = sample_motion(poses, [0, 0, 0], step, rng, parameters)
    assert (lab.poses == poses).all()


def test_motion_lab_spread_of_a_straight_step_is_alpha_3():
    lab = MotionLab()
    lab.set(forward=1000, left=0, turned=0, steps=1, alpha_1=0, alpha_2=0, alpha_3=0.04, alpha_4=0)
    assert lab.spread_m == pytest.approx(0.2, rel=0.1) and lab.spread_deg == 0
    lab.std.value = 1
    assert lab.spread_m == pytest.approx(0.04, rel=0.1)


def test_motion_lab_two_millimetres_are_a_half_turn_when_read_literally():
    lab = MotionLab()
    spread = [(lab.buttons[name].click(), lab.spread_deg)[1] for name in ("2 mm back, symmetric", "2 mm back, literal")]
    assert spread[0] < 1.5 and spread[1] > 10


def test_motion_lab_presets_differ_picture_has_words_and_reset_leads_back():
    lab = MotionLab()
    start = repr(lab)
    said = {name: (button.click(), repr(lab) + lab.readout.value)[1] for name, button in lab.buttons.items() if name != "reset"}
    assert len(set(said.values())) == len(said)
    lab.reset()
    assert repr(lab) == start and lab.pictures[0].mime == "image/svg+xml" and lab.summary() in lab.pictures[0].alt
    assert "\n" not in repr(lab)


def test_field_lab_gives_what_the_library_gives(field_lab, rooms):
    grid_map, log = rooms
    field_lab.set(dx=0.2, dy=-0.1, turn=10, sigma_hit=0.1, z_random=0.3, max_distance=0.5, temper=0.4)
    parameters = Parameters(sigma_hit_m=0.1, z_random=0.3, max_distance_m=0.5, temper=0.4)
    pose = log.truth[5] + [0.2, -0.1, np.radians(10)]
    scan = choose_beams(log, 5, parameters)
    weight = log_weights(pose[None], scan, LikelihoodField.of(grid_map, parameters)).item()
    printed = log_weights(pose[None], scan, LikelihoodField.of(grid_map, replace(parameters, temper=1.0))).item()
    assert field_lab.log_weight == pytest.approx(weight) and field_lab.log_likelihood == pytest.approx(printed)
    assert np.interp(0.2, np.linspace(-4, 4, 161), field_lab.across) == pytest.approx(weight, abs=1e-3)


def test_field_lab_true_pose_is_best_and_the_next_room_as_good(field_lab):
    assert field_lab.ratio == 1 and field_lab.explained == 1
    field_lab.dx.value = 0.2
    assert field_lab.ratio < 1
    field_lab.buttons["the room next door"].click()
    assert field_lab.ratio == pytest.approx(1) and field_lab.dx.value == 3


def test_field_lab_presets_reset_and_words(field_lab):
    start = repr(field_lab)
    field_lab.buttons["Table 6.1's numbers"].click()
    assert field_lab.parameters.sigma_hit_m == pl.TABLE_6_1.sigma_hit_m and field_lab.temper.value == 1
    assert "where it stood" in field_lab.buttons and "temper 1.00" in field_lab.pictures[0].alt
    field_lab.reset()
    assert repr(field_lab) == start and "\n" not in start


def test_field_lab_without_a_truth_is_told(rooms):
    with pytest.raises(ValueError, match="log must hold its truth"):
        FieldLab(rooms[0], replace(rooms[1], truth=None), step=0)


def test_resample_lab_gives_what_the_library_gives():
    logs = np.log([1.0, 2.0, 3.0, 4.0])
    lab = ResampleLab(logs, temper=1.0)
    assert lab.weights == pytest.approx([0.1, 0.2, 0.3, 0.4]) and lab.ess == pytest.approx(1 / 0.3)
    for number, name in enumerate(("systematic", "stratified", "multinomial"), start=1):
        lab.set(method=number, n_draws=9, spin=7)
        drawn = resample(lab.weights, 9, np.random.default_rng(7), name)
        assert (lab.copies == np.bincount(drawn, minlength=4)).all()
    assert lab.spins.mean(axis=0) == pytest.approx(lab.owed, abs=0.3)


def test_resample_lab_systematic_pays_the_floor_or_the_ceiling():
    lab = ResampleLab(np.log([1.0, 2.0, 3.0, 4.0]), temper=1.0)
    assert (lab.fewest >= np.floor(lab.owed)).all() and (lab.most <= np.ceil(lab.owed)).all()
    lab.method.value = 3
    assert (lab.most > np.ceil(lab.owed)).any()


def test_resample_lab_presets_reset_and_words():
    lab = ResampleLab([-50.0, -53.0, -46.0])
    start = repr(lab)
    said = {name: (button.click(), repr(lab))[1] for name, button in lab.buttons.items() if name != "reset"}
    assert lab.ess == pytest.approx(3) and "all weigh the same" in said  # the last preset
    lab.reset()
    assert repr(lab) == start and lab.summary() in lab.pictures[0].alt


def test_step_lab_ends_where_the_whole_run_ends(steps, rooms):
    run = pl.FastSLAM(FEW).run(*rooms, np.random.default_rng(3))
    for k in range(len(run)):
        steps.at.value = 4 * (k + 1)
        assert (steps.pose == run.trajectory[k]).all()
    assert len(steps.particles) <= 80 and steps.stage == "resample" and steps.step == len(run)


def test_step_lab_goes_stage_by_stage(steps):
    assert steps.stage == "start" and steps.pose is None and "none yet" in steps.readout.value
    seen = []
    for _ in range(5):
        steps.next()
        seen.append((steps.step, steps.stage))
    assert seen == [(1, "sample"), (1, "weigh"), (1, "estimate"), (1, "resample"), (2, "sample")]
    assert steps.pose is not None and steps.particles.effective_number == pytest.approx(len(steps.particles))
    steps.next(-3)
    assert steps.stage == "weigh" and steps.pose is None and steps.particles.effective_number < len(steps.particles)
    steps.next(-99)
    assert steps.stage == "start" and steps.at.value == 0


def test_step_lab_back_and_forth_is_where_it_was(steps):
    steps.at.value = 30
    said = repr(steps), steps.pictures[1].image
    steps.next(8), steps.next(-8)
    assert (repr(steps), steps.pictures[1].image) == said


def test_step_lab_buttons_play_and_filter(steps):
    start = repr(steps)
    steps.play.value = 6
    assert steps.at.value == 6 and steps.step == 2
    steps.filter.value = "printed"
    assert repr(steps).startswith("StepLab(printed, step 2, weigh: ")
    steps.buttons["the end"].click()
    assert f"{steps.step} of {steps.step}" in steps.readout.value and steps.play.value == steps.at.value
    steps.reset()
    assert repr(steps) == start and re.search("all particles", steps.pictures[0].alt)


def test_step_lab_error_is_that_of_the_estimates_own_step(steps, rooms):
    steps.at.value = 4 * 7
    right = np.hypot(*(steps.pose - rooms[1].truth[6])[:2])
    assert steps.error_m == pytest.approx(right)
    steps.next()  # the robot went on, the estimate did not
    assert steps.error_m == pytest.approx(right)
