"""Flats of centre lines: a flat of our own, whose lengths can be counted on squared paper; then the real ones.

The flat is 12 x 6 units of 20 px: two rooms, a balcony below the right one, a slanted corner at the left room's top.
The real ones lie where PRIORLAB_REAL_DATA says.
"""

import os
from pathlib import Path

import numpy as np
import pytest

from priorlab.core.building import Truth
from priorlab.core.score import score_mask
from priorlab.drawing.method import ROBUST, THESIS
from priorlab.interchange.r2v import LineFlat, read_r2v
from priorlab.study.flats.drawing import LOOKS, describe_flat, draw_flat
from priorlab.study.flats.lines import Gap, WallLine, gap_of, joined, with_closed_corners
from priorlab.study.flats.plan import plan_of, usual_width
from priorlab.study.flats.rooms import picture_rooms
from priorlab.study.flats.scores import FlatRow, flat_files, flat_rng, flats_table, score_flats

THICKNESS = {"outer": 0.24, "inner": 0.12, "rail": 0.1}
TEXT = """\
40\t0\t120\t0\twall\t1\t1
120\t0\t240\t0\twall\t1\t1
240\t0\t240\t120\twall\t1\t1
0\t120\t240\t120\twall\t1\t1
0\t40\t0\t120\twall\t1\t1
0\t40\t40\t0\twall\t1\t1
120\t0\t120\t120\twall\t1\t1
120\t120\t120\t160\twall\t2\t1
120\t160\t240\t160\twall\t2\t1
240\t120\t240\t160\twall\t2\t1
120\t50\t120\t70\tdoor\t1\t1
20\t120\t40\t120\tdoor\t1\t1
150\t120\t170\t120\tdoor\t3\t1
180\t0\t210\t0\tdoor\t3\t1
10\t100\t50\t118\tentrance\t1\t1
40\t60\t80\t75\tliving_room\t1\t1
160\t60\t200\t75\tbedroom\t1\t1
205\t3\t237\t18\tbathtub\t1\t1
"""


@pytest.fixture
def flat(tmp_path):
    (tmp_path / "ours.txt").write_text(TEXT)
    return read_r2v(tmp_path / "ours.txt")


def line(x1, y1, x2, y2, style="inner", thickness=0.12):
    return WallLine(np.array([x1, y1], float), np.array([x2, y2], float), style, thickness)


def test_joined_makes_one_wall_of_its_pieces():
    whole = joined([line(0, 0, 2, 0), line(0, 1, 3, 1), line(5, 0, 2, 0), line(2, 0, 2, 3), line(1, 0, 2.5, 0)])
    assert [(wall.start.tolist(), wall.end.tolist()) for wall in whole] == [
        ([0, 0], [5, 0]),
        ([0, 1], [3, 1]),
        ([2, 0], [2, 3]),
    ]


def test_joined_keeps_styles_and_gaps_apart():
    assert len(joined([line(0, 0, 2, 0), line(2, 0, 4, 0, "rail"), line(2.2, 0, 3, 0)])) == 3


@pytest.mark.parametrize(
    ("other", "longer"),
    [
        ((4, 0, 4, 3), 0.06),  # a right angle: half the other's thickness
        ((4, 0, 8, 4), 0.06 * np.tan(np.pi / 8)),  # half a right angle
        ((4, -2, 4, 2), 0.0),  # it ends on a wall that goes on
        ((4.5, 0, 4.5, 3), 0.0),  # they do not meet
    ],
)
def test_with_closed_corners_reaches_the_outer_corner(other, longer):
    wall, _ = with_closed_corners([line(0, 0, 4, 0), line(*other)])
    assert wall.length == pytest.approx(4 + longer)


def test_gap_of_stays_clear_of_walls_that_meet_it():
    walls = [line(0, 0, 4, 0), line(2, 0, 2, 3)]
    gap = gap_of(np.array([1.0, 0.02]), np.array([2.0, 0.02]), walls)
    assert gap.wall is walls[0]
    assert (gap.low, gap.high) == pytest.approx((1.0, 2 - 0.06 - 0.05))


def test_gap_of_nothing_beside_or_across_a_wall():
    walls = [line(0, 0, 4, 0)]
    assert gap_of(np.array([1.0, 0.5]), np.array([2.0, 0.5]), walls) is None
    assert gap_of(np.array([1.0, -0.4]), np.array([1.0, 0.4]), walls) is None
    assert gap_of(np.array([1.0, 0.0]), np.array([1.2, 0.0]), walls) is None


def test_picture_rooms_counts_closed_rooms():
    rooms = picture_rooms([line(0, 0, 4, 0), line(4, 0, 4, 3), line(4, 3, 0, 3), line(0, 3, 0, 0), line(2, 0, 2, 3)])
    assert sorted(np.unique(rooms.labels)) == [0, 1, 2, 3]
    assert 1 in rooms.beside(line(0, 0, 4, 0), 1.0)
    assert 1 not in rooms.beside(line(2, 0, 2, 3), 1.0)


def test_usual_width_leaves_sliding_fronts_out():
    wall = line(0, 0, 9, 0)
    assert usual_width([Gap(wall, 0, width) for width in (0.8, 0.9, 1.0, 3.0, 4.0, 5.0)]) == pytest.approx(0.9)
    assert usual_width([]) is None


def test_plan_of_scales_doors_to_0_9_m(flat):
    plan = plan_of(flat, THICKNESS)
    assert [gap.width for gap in plan.doors] == pytest.approx([0.9, 0.9, 0.9])  # 20 px each
    ends = np.array([end for wall in plan.walls for end in (wall.start, wall.end)])
    np.testing.assert_allclose(np.ptp(ends, axis=0), [240 * 0.045, 160 * 0.045])


def test_plan_of_tells_doors_from_windows(flat):
    plan = plan_of(flat, THICKNESS)
    # between the rooms, beside the entrance, to the balcony; the one at the top leads outside
    doors = sorted((round(x / 0.045), round(-y / 0.045)) for x, y in (gap.middle for gap in plan.doors))
    assert doors == [(30, 120), (120, 60), (160, 120)]
    ((x, y),) = [gap.middle for gap in plan.windows]
    assert (round(x / 0.045), round(y / 0.045)) == (195, 0)


def test_plan_of_without_entrance_has_a_window_there(flat):
    bare = LineFlat(flat.name, flat.walls, flat.rails, flat.openings)
    assert len(plan_of(bare, THICKNESS).windows) == 2


def test_plan_of_makes_outer_walls_thick(flat):
    styles = [wall.style for wall in plan_of(flat, THICKNESS).walls]
    assert sorted(styles) == ["inner"] + ["outer"] * 5 + ["rail"] * 3


@pytest.mark.parametrize("look", LOOKS)
def test_draw_flat_shows_what_its_truth_says(flat, look):
    drawing, truth = draw_flat(flat, look, np.random.default_rng(0))
    centre_lines, margins = 240 * 0.045 / 0.02, 2 * 1.3 / 0.02
    assert 10 <= max(drawing.shape) - centre_lines - margins <= 16  # outer walls are 0.2 to 0.3 m thick
    assert len(truth.doors) == 3
    assert np.median([door.width for door in truth.doors]) == pytest.approx(45, abs=0.5)
    assert (drawing.grey[truth.walls] < 160).mean() > 0.97
    free = (drawing.grey < 128) & ~truth.walls & ~truth.ignore  # bed, names, dimension lines
    assert 0 < free.sum() < truth.walls.sum()


def test_draw_flat_fills_hollow_and_hatches(flat):
    def share_of_ink(look):
        drawing, truth = draw_flat(flat, look, np.random.default_rng(3))
        return (drawing.grey < 128).mean()

    filled, hollow, hatched = (share_of_ink(look) for look in LOOKS)
    assert filled > hatched > hollow


def test_describe_flat_closes_the_slanted_corner(flat):
    slanted = [
        wall for wall in describe_flat(flat, "filled", np.random.default_rng(0)).walls if len({p[0] for p in wall.path}) == 2
    ]
    slanted = [wall for wall in slanted if len({p[1] for p in wall.path}) == 2]
    assert len(slanted) == 1
    (x1, y1), (x2, y2) = slanted[0].path
    assert abs(x1 - x2) == pytest.approx(abs(y1 - y2))
    assert abs(x1 - x2) > 40 * 0.045


def test_draw_flat_same_seed_same_drawing(flat):
    one, other, third = (draw_flat(flat, "filled", np.random.default_rng(seed))[0].grey for seed in (1, 1, 2))
    np.testing.assert_array_equal(one, other)
    assert one.shape != third.shape or (one != third).any()


def test_score_flats_a_perfect_and_a_blind_method(flat, tmp_path):
    truths = {look: draw_flat(flat, look, flat_rng(0, 0, look)) for look in LOOKS}

    def perfect(drawing):
        return next(truth.walls for shown, truth in truths.values() if shown.name == drawing.name)

    rows = score_flats(tmp_path, {"perfect": perfect, "blind": lambda drawing: drawing.grey < 0}, LOOKS)
    assert [row.meets_bar for row in rows] == [True, False] * 3
    table = flats_table(rows)
    assert "3 of 3" in table and "0 of 3" in table


def test_score_flats_takes_looks_by_turns(tmp_path):
    for name in "abcd":
        (tmp_path / f"{name}.txt").write_text(TEXT)
    rows = score_flats(tmp_path, {"ink": lambda drawing: drawing.grey < 128})
    assert [(row.flat, row.look) for row in rows] == [("a", "filled"), ("b", "hollow"), ("c", "hatched"), ("d", "filled")]
    assert [row.flat for row in score_flats(tmp_path, {"ink": lambda drawing: drawing.grey < 128}, every=3)] == ["a", "d"]


@pytest.mark.parametrize(
    ("counts", "meets"),
    [
        ((980, 12, 20, 9988), True),
        ((980, 13, 20, 9987), False),  # one false positive in 1,000 too many
        ((590, 2, 410, 9998), False),  # recall
        ((580, 12, 340, 99988), False),  # precision
    ],
)
def test_flat_row_meets_the_bar_of_table_3_1(counts, meets):
    size = sum(counts)
    truth = np.zeros(size, bool)
    truth[: counts[0] + counts[2]] = True
    found = np.zeros(size, bool)
    found[: counts[0]] = True
    found[counts[0] + counts[2] : counts[0] + counts[2] + counts[1]] = True
    score = score_mask(found[None], Truth(truth[None], truth[None] & False))
    assert FlatRow("f", 0, "filled", "m", score, 0, 3, 0, 0.0).meets_bar == meets


def test_flat_files_without_a_folder(tmp_path):
    with pytest.raises(FileNotFoundError, match="does not exist"):
        flat_files(tmp_path / "nowhere")


@pytest.fixture(scope="module")
def real_flats() -> Path:
    folder = os.environ.get("PRIORLAB_REAL_DATA")
    if not folder:
        pytest.skip("PRIORLAB_REAL_DATA is not set")
    return Path(folder) / "plans_r2v"


def test_real_flats_are_all_drawn(real_flats):
    files = flat_files(real_flats)
    assert len(files) == 96
    lost = 0
    for path in files:
        flat = read_r2v(path)
        plan = plan_of(flat, THICKNESS)
        assert len(plan.doors) >= 2
        lost += len(flat.openings) - len(plan.doors) - len(plan.windows)
    assert lost <= 0.03 * sum(len(read_r2v(path).openings) for path in files)


def test_real_flats_table(real_flats):
    rows = score_flats(real_flats, {"ROBUST": ROBUST, "THESIS": THESIS}, every=13)
    print("\n\nR2V flats, every 13th, in filled, hollow and hatched walls by turns\n")
    print(flats_table(rows))
    assert len(rows) == 2 * 8
