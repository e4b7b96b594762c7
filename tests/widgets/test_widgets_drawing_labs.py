"""The labs of chapter 3 show what the library's own lines give."""

from __future__ import annotations

from dataclasses import replace

import cv2
import numpy as np
import pytest

import priorlab as pl
from priorlab.core.score import score_mask
from priorlab.drawing.candidates import DOOR
from priorlab.drawing.connectivity import walk
from priorlab.drawing.corners import detect_corners
from priorlab.drawing.explain import explain_candidate
from priorlab.drawing.preprocessing import prepare
from priorlab.drawing.walls import sweeps_from
from priorlab.study.detail import cut_detail
from priorlab.widgets import CandidateLab, DoorLab, GrowthLab, WalkLab


@pytest.fixture(scope="module")
def plan():
    return pl.load_floor_plan("flat_north")


@pytest.fixture(scope="module")
def detail(plan):
    return cut_detail(plan, 45, 120, 290, 290)


@pytest.fixture(scope="module")
def seen(detail):
    return pl.extract_walls(detail.drawing, pl.THESIS)


@pytest.fixture
def walk_lab():
    ink = np.zeros((20, 30), dtype=bool)
    ink[10, 2:25] = ink[3:11, 24] = True
    ink[10, 15] = False
    return WalkLab(ink, {"broken": ((2, 10), (24, 10)), "upright": ((24, 10), (24, 3))})


def rgb(picture):
    return cv2.cvtColor(cv2.imdecode(np.frombuffer(picture.image, np.uint8), cv2.IMREAD_COLOR), cv2.COLOR_BGR2RGB)


def test_walk_lab_stops_at_the_gap_and_says_so(walk_lab):
    walk_lab.step(100)
    assert not walk_lab.reached and walk_lab.now.at == (14, 10) and walk_lab.now.n_dark == 0
    assert "stuck, 10 px from the goal" in walk_lab.readout.value and "does not arrive" in repr(walk_lab)


def test_walk_lab_steps_one_pixel_and_shows_the_chosen_one(walk_lab):
    walk_lab.step()
    assert walk_lab.now.at == (3, 10) and walk_lab.now.chosen == (4, 10)
    assert walk_lab.readout.value.count("taken") == 1 and "d = 20.00" in walk_lab.readout.value
    walk_lab.step(-1)
    assert walk_lab.now.at == (2, 10)


def test_walk_lab_backwards_and_other_pair_equal_the_library(walk_lab):
    walk_lab.set(pair=2, back=1, at=0)
    assert walk_lab.walk == walk(walk_lab._ink, (24, 3), (24, 10)) and walk_lab.reached
    walk_lab.step(50)
    assert "arrived" in walk_lab.readout.value and "2 px from the goal" in walk_lab.readout.value


def test_walk_lab_buttons_name_the_pairs(walk_lab):
    walk_lab.step(3)
    walk_lab.buttons["upright"].click()
    assert walk_lab.name == "upright" and walk_lab.now.at == (24, 10)


def test_candidate_lab_tells_what_the_library_tells(seen):
    lab = CandidateLab(seen)
    for place in (1, len(lab.candidates)):
        for test in range(1, 6):
            lab.set(candidate=place, test=test)
            told = explain_candidate(seen, lab.candidates[place - 1])[test - 1]
            assert str(lab.result) == str(told) and told.question in lab.readout.value


def test_candidate_lab_offers_every_fate_and_all_doors(seen):
    lab = CandidateLab(seen)
    reasons = seen.door_search.reasons[list(lab.candidates)]
    assert (reasons == DOOR).sum() == len(seen.doors) and set(reasons) == set(seen.door_search.reasons)
    for name, button in lab.buttons.items():
        button.click()
        if name.startswith("lost at "):
            assert lab.verdict == name.removeprefix("lost at ")
            failed = next(result for result in lab.results if not result.passed)
            assert failed.test == lab.verdict and failed.asked
    assert lab.verdict == "a door"  # reset came last


def test_candidate_lab_steps_and_stops_at_both_ends(seen):
    lab = CandidateLab(seen)
    lab.step(-1)
    assert lab.test.value == 1
    for _ in range(9):
        lab.step()
    assert lab.test.value == 5 and lab.result.test == "outer walls"


def test_candidate_lab_rim_of_the_triangle_tells_passed_from_failed(seen):
    lab = CandidateLab(seen)
    lab.buttons["lost at geometry"].click()
    counts = []
    for test in (1, 2):
        lab.test.value = test
        shown = rgb(lab.pictures[0]).astype(int)
        counts.append([(np.abs(shown - colour).sum(axis=2) < 60).sum() for colour in ((0, 158, 115), (204, 0, 120))])
    assert counts[0][0] > 50 and counts[1][1] > counts[0][1]


def test_candidate_lab_without_candidates_is_told(seen):
    with pytest.raises(ValueError, match="candidates must hold at least one row, got none"):
        CandidateLab(seen, [])


def test_door_lab_as_printed_is_thesis(detail, seen):
    lab = DoorLab(detail.drawing, detail.truth)
    assert lab.funnel == dict(seen.funnel) and lab.doors == seen.doors
    assert replace(lab.method, name="THESIS") == pl.THESIS


def test_door_lab_every_slider_reaches_its_threshold(detail):
    lab = DoorLab(detail.drawing, detail.truth)
    lab.set(n_corners=40, ratio=0.8, min_angle=20, max_angle=110, max_tilt=10, max_dark=0.3, max_overlap=0.5, keep_best=1)
    lab.drop_outer.value = 0
    wanted = replace(
        pl.THESIS,
        name="sliders",
        n_corners=40,
        isosceles_ratio=0.8,
        min_angle=20,
        max_largest_angle=110,
        max_tilt=10,
        max_dark=0.3,
        max_overlap=0.5,
        keep_best=True,
        drop_on_outer_walls=False,
    )
    assert lab.method == wanted
    assert lab.doors == pl.detect_doors(detail.drawing, detect_corners(detail.drawing, 40, wanted), wanted)


def test_door_lab_no_overlap_test_leaves_more_and_reset_leads_back(detail):
    lab = DoorLab(detail.drawing, detail.truth)
    before = repr(lab)
    lab.buttons["all overlaps"].click()
    assert len(lab.doors) > 20 and "overlap" not in lab.funnel
    lab.buttons["reset"].click()
    assert repr(lab) == before


def test_door_lab_funnel_in_words_for_those_who_do_not_see_it(detail):
    lab = DoorLab(detail.drawing, detail.truth)
    assert f"wedges {lab.funnel['wedges']}" in lab.pictures[1].alt and lab.pictures[1].mime == "image/svg+xml"
    assert f"{lab.right} of 6" in lab.readout.value


def test_growth_lab_equals_the_library_at_every_stage(plan):
    lab = GrowthLab(plan.drawing, plan.truth, {"true": plan.truth.doors})
    ink = prepare(plan.drawing, pl.THESIS).walls
    stages = sweeps_from(ink, np.zeros_like(ink), plan.truth.doors[:3], pl.THESIS)
    for stage, mask in enumerate(stages):
        lab.set(stage=stage, n_doors=3)
        assert np.array_equal(lab.walls, mask) and lab.score == score_mask(mask, plan.truth)
    assert np.array_equal(lab.new, stages[4] & ~stages[3])


def test_growth_lab_dont_care_moves_precision_and_not_recall(plan):
    lab = GrowthLab(plan.drawing, plan.truth, {"true": plan.truth.doors})
    lab.set(stage=4)
    assert lab.literal_score.recall == lab.score.recall
    assert lab.literal_score.precision < lab.score.precision - 0.1
    grey = (rgb(lab.pictures[1]) == 226).all(axis=2).sum()
    lab.dont_care.value = 0
    assert grey > 1000 and (rgb(lab.pictures[1]) == 226).all(axis=2).sum() < 0.1 * grey


def test_growth_lab_no_doors_grow_nothing(plan):
    lab = GrowthLab(plan.drawing, plan.truth, {"true": plan.truth.doors})
    lab.set(stage=4, n_doors=0)
    assert not lab.walls.any() and "precision undefined" in repr(lab)
    lab.outer.value = 1
    assert lab.walls.any()


def test_growth_lab_without_doors_is_told(plan):
    with pytest.raises(ValueError, match="doors must name at least one group of at least one door, got none"):
        GrowthLab(plan.drawing, plan.truth, {"none": ()})


@pytest.mark.parametrize("kind", [DoorLab, CandidateLab, GrowthLab])
def test_drawing_labs_have_words_for_every_picture_and_a_still_one(kind, plan, detail, seen):
    lab = {
        DoorLab: lambda: DoorLab(detail.drawing, detail.truth),
        CandidateLab: lambda: CandidateLab(seen),
        GrowthLab: lambda: GrowthLab(plan.drawing, plan.truth, {"true": plan.truth.doors}),
    }[kind]()
    assert all(len(picture.alt) > 10 for picture in lab.pictures)
    bundle = lab._repr_mimebundle_()
    assert bundle["text/plain"] == repr(lab) and "image/png" in bundle
    for slider in lab.sliders.values():
        assert slider.hint
