"""Renderings: a building of two rooms whose pixels can be counted; then other people's flats, where PRIORLAB_REAL_DATA says."""

import os
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest

from priorlab.buildings.parts import Description, DoorPart, Note, Wall, WallStyle, WindowPart
from priorlab.core.drawing import Walls
from priorlab.study.rendering_scores import main, rendering_of, renderings_table, score_renderings
from priorlab.study.renderings import RENDERING_LOOKS, SIDE, RenderingLook, draw_rendering

ROOMS = Description(
    name="two rooms",
    metres_per_pixel=0.02,
    walls=(
        Wall("outer", outline=((0.0, 0.0), (8.0, 0.0), (8.0, 6.0), (0.0, 6.0))),
        Wall("inner", path=((4.0, 0.2), (4.0, 5.8))),
    ),
    styles={"outer": WallStyle(0.25), "inner": WallStyle(0.12)},
    doors=(DoorPart((4.0, 2.0), 0.9, "south", "east"), DoorPart((6.0, 0.125), 2.0, kind="opening")),
    windows=(WindowPart((2.0, 5.875), 1.5),),
    notes=(Note("LIVING", (2.0, 3.0)), Note("a word across the wall", (4.0, 4.0))),
)


def look(name):
    return next(one for one in RENDERING_LOOKS if one.name == name)


def drawn(name, seed=0):
    return draw_rendering(ROOMS, look(name), np.random.default_rng(seed))


@pytest.mark.parametrize("one", RENDERING_LOOKS, ids=lambda one: one.name)
def test_draw_rendering_is_512_pixels_square_and_all_walls_are_ink(one):
    drawing, truth = draw_rendering(ROOMS, one, np.random.default_rng(1))
    assert drawing.shape == truth.shape == (SIDE, SIDE)
    inside = cv2.erode(truth.walls.astype(np.uint8), np.ones((3, 3), np.uint8)) > 0
    assert inside.any()
    assert drawing.grey[inside].max() < 130
    assert not truth.ignore.any()


def test_draw_rendering_is_the_same_with_the_same_dice():
    one, other, third = drawn("furnished"), drawn("furnished"), drawn("furnished", seed=1)
    np.testing.assert_array_equal(one[0].grey, other[0].grey)
    assert (one[0].grey != third[0].grey).any()


def test_draw_rendering_bare_has_nothing_but_walls():
    drawing, truth = drawn("bare")
    np.testing.assert_array_equal(drawing.grey < 255, truth.walls)
    assert drawing.colour is None


def test_draw_rendering_walls_have_the_area_that_the_plan_has():
    thin = replace(look("bare"), walls="thin")
    drawing, truth = draw_rendering(ROOMS, thin, np.random.default_rng(3))
    rows, cols = np.nonzero(truth.walls)
    per_metre = (np.ptp(cols) + 1) / 8.0
    assert (np.ptp(rows) + 1) / 6.0 == pytest.approx(per_metre, rel=0.01)
    length = 28 + 5.8 - 0.9 - 2.0 - 1.5  # metres, less the openings
    assert 0.09 < truth.walls.sum() / per_metre**2 / length < 0.13
    left, right = (truth.walls[: SIDE // 2, half].sum() for half in (np.s_[: SIDE // 2], np.s_[SIDE // 2 :]))
    assert left < right  # the window is in the left half's upper wall
    assert drawing.metres_per_pixel == pytest.approx(1 / per_metre, rel=0.01)


def test_draw_rendering_words_across_walls_are_left_out():
    plain, named = RenderingLook("a"), RenderingLook("b", names=True)
    grey = [draw_rendering(ROOMS, one, np.random.default_rng(5))[0].grey for one in (plain, named)]
    different = np.nonzero(grey[0] != grey[1])[1]
    assert different.size and different.max() < SIDE / 2  # LIVING stands in the left room


def test_draw_rendering_windows_and_fills():
    drawing, truth = drawn("coloured rooms, tinted openings")
    panes = drawing.colour[truth.windows]
    assert truth.windows.any() and len(np.unique(panes, axis=0)) == 1 and panes.min() < 245
    assert not (truth.windows & truth.walls).any()
    below = drawing.colour[SIDE // 2 - 60]  # through both rooms
    tones = {tuple(tone) for tone in below.tolist()}
    assert (255, 255, 255) in tones and len(tones) == 4  # outside, wall, two rooms
    assert (drawing.colour[0] == 255).all()


def test_draw_rendering_lines_of_windows_and_arcs():
    bare, drawn_in = (draw_rendering(ROOMS, one, np.random.default_rng(2)) for one in (RenderingLook("a"), look("arcs")))
    assert (drawn_in[0].grey < 200).sum() > (bare[0].grey < 200).sum() + 60
    np.testing.assert_array_equal(bare[1].walls, drawn_in[1].walls)
    assert len(drawn_in[1].doors) == 1  # the wide one has no leaf
    assert not bare[1].doors


def test_renderings_table_of_rows_that_are_right_and_empty(flats):
    perfect = {}

    def reader(drawing):
        name = drawing.name
        perfect[name] = len(perfect)
        return Walls(np.zeros(drawing.shape, np.uint8))

    rows = score_renderings(flats, "held_back", reader, every=24)
    assert len(rows) == len(perfect)
    assert all(row.number % 2 == 1 for row in rows)
    assert {row.look for row in rows} == {one.name for one in RENDERING_LOOKS}
    table = renderings_table(rows).splitlines()
    assert table[-1].split()[:3] == ["all", str(len(rows)), "0.0"]
    assert float(table[-1].split()[-1]) > 60  # the simple filter reads them


def test_real_flats_rendered_have_an_iou_above_95(flats):
    rows = score_renderings(flats, "held_back", every=24)
    print(renderings_table(rows))
    assert np.mean([row.score.iou for row in rows]) >= 0.95
    assert np.mean([row.score.iou for row in rows]) > np.mean([row.simple.iou for row in rows])


def test_rendering_of_a_flat_is_the_same_each_time(flats):
    one, other = (rendering_of(flats, 2, look("furnished")) for _ in range(2))
    np.testing.assert_array_equal(one[0].grey, other[0].grey)
    np.testing.assert_array_equal(one[1].walls, other[1].walls)


def test_main_asks_for_a_whole_number(capsys):
    with pytest.raises(SystemExit):
        main(["folder", "work", "--every", "0"])
    assert "--every must be at least 1, got 0" in capsys.readouterr().err


@pytest.fixture
def flats():
    root = os.environ.get("PRIORLAB_REAL_DATA")
    if root is None:
        pytest.skip("PRIORLAB_REAL_DATA is not set: no flats to render")
    folder = Path(root) / "plans_r2v"
    assert folder.is_dir(), f"PRIORLAB_REAL_DATA is set, but {folder} is missing"
    return folder
