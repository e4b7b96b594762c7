"""The depth camera's lab shows what the library's own lines give."""

import cv2
import numpy as np
import pytest

import priorlab as pl
from priorlab.plot.depth_camera import NOTHING, STRIP
from priorlab.robot.depth_noise import DepthNoise
from priorlab.robot.strip import readings_from_scans, strip_ranges
from priorlab.study.arena import build_arena
from priorlab.study.depth_survey import survey_arena
from priorlab.widgets import DepthLab


@pytest.fixture(scope="module")
def survey():
    return survey_arena(build_arena(), np.random.default_rng(1), repeats=2)


@pytest.fixture
def lab(survey):
    return DepthLab(survey, pose=3)


def test_depth_lab_equals_the_library_image_by_image(lab, survey):
    lab.set(pose=4, repeats=2, noise=3, holes=0.2, cell_size=3, p_wall=0.3, p_space=0.8)
    arena, noise = survey.arena, DepthNoise(0.0042, 0.003, 0.2)
    scans = [strip_ranges(survey.image(pose, repeat, noise), survey.camera) for pose in range(4) for repeat in range(2)]
    sensor = survey.camera.range_sensor(0.025, wall_thickness=2)
    readings = readings_from_scans(scans, arena.poses[:4].repeat(2, axis=0), survey.camera, arena.truth.shape, 0.025, sensor)
    prior_map = pl.build_prior_map(arena.walls, pl.Prior(0.3, 0.8), cell_size=3)
    posterior = pl.update_map(prior_map, pl.gather_evidence(readings, prior_map.grid))
    np.testing.assert_allclose(lab.map.log_odds, posterior.log_odds, atol=1e-9)
    assert lab.score == pl.score_map(posterior, arena.truth) and lab.prior_score == pl.score_map(prior_map, arena.truth)
    assert np.array_equal(lab.image, survey.image(3, 1, noise))


def test_depth_lab_strip_slider_moves_the_frame_and_the_scan(lab):
    usual = lab.readings.ranges.copy()
    lab.strip_row.value = 400
    assert (lab.readings.ranges[0] < usual[0] - 1).mean() > 0.3  # the floor is nearer than the wall
    shown = cv2.cvtColor(cv2.imdecode(np.frombuffer(lab.pictures[0].image, np.uint8), cv2.IMREAD_COLOR), cv2.COLOR_BGR2RGB)
    blue = np.abs(shown.astype(int) - STRIP).sum(axis=2) < 60
    rows = np.flatnonzero(blue.mean(axis=1) > 0.8)
    assert shown.shape[:2] == (240, 320)
    assert rows.min() == pytest.approx(200, abs=2) and rows.max() == pytest.approx(210, abs=2)


def test_depth_lab_shows_what_was_not_measured_in_its_colour(lab):
    lab.holes.value = 0.8
    shown = cv2.cvtColor(cv2.imdecode(np.frombuffer(lab.pictures[0].image, np.uint8), cv2.IMREAD_COLOR), cv2.COLOR_BGR2RGB)
    assert (np.abs(shown.astype(int) - NOTHING).sum(axis=2) < 20).mean() > 0.6


def test_depth_lab_presets_stay_inside_the_sliders_and_reset_leads_back(lab):
    before = repr(lab)
    for button in lab.buttons.values():
        button.click()
    assert repr(lab) == before
    lab.buttons["all poses"].click()
    assert len(lab.readings) == 12 and "poses 1 to 12" in repr(lab) and "poses 1 to 12" in lab.pictures[1].alt


def test_depth_lab_without_a_plan_is_the_readings_alone(lab):
    lab.buttons["no plan"].click()
    assert lab.prior_score.f_beta == 0
    assert lab.score.f_beta == pytest.approx(lab.uninformed_score.f_beta, abs=0.02)


def test_depth_lab_says_when_the_edge_has_no_reading(lab):
    lab.strip_row.value = 0  # over the boards: nothing
    assert "no reading" in lab.readout.value and ">100 %<" in lab.readout.value.replace("</td>", "<").replace("'>", ">")
    assert not lab.evidence.seen.any() and lab.score == lab.prior_score


def test_depth_lab_bundle_has_text_and_a_still_picture(lab):
    bundle = lab._repr_mimebundle_()
    assert bundle["text/plain"] == repr(lab) and "image/png" in bundle


def test_depth_lab_keeps_nothing_that_has_changed(lab, survey):
    """One slider after the other ends where a new lab begins."""
    steps = {"p_wall": 0.4, "cell_size": 3, "pose": 5, "repeats": 2, "holes": 0.3, "strip_row": 250, "noise": 4, "p_space": 0.7}
    for name, value in steps.items():
        lab.sliders[name].value = value
        fresh = DepthLab(survey, pose=3)
        fresh.set(**{done: slider.value for done, slider in lab.sliders.items()})
        assert repr(lab) == repr(fresh) and np.array_equal(lab.map.log_odds, fresh.map.log_odds)
        assert [p.image for p in lab.pictures] == [p.image for p in fresh.pictures]
