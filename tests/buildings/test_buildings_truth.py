"""Truth and world of one-room buildings against masks set by hand, slice by slice."""

import numpy as np
import pytest

from priorlab.buildings.description import parse_description
from priorlab.buildings.floor_plans import build_floor_plan

# 6 x 4 m at 0.1 m per pixel with 1 m of paper all round: pixels 10..69 by 10..49; walls 5 pixels thick
ROOM = """
metres_per_pixel = 0.1
walls = [{ style = "outer", outline = [[0, 0], [6, 0], [6, 4], [0, 4]] }]
rooms = [{ name = "Room", at = [3, 2], text = 0.2 }]
[styles.outer]
thickness = 0.5
"""


def hand_made_walls():
    walls = np.zeros((60, 80), dtype=bool)
    walls[10:50, 10:70] = True
    walls[15:45, 15:65] = False
    return walls


def rim(mask):
    """One pixel round a mask, by shifting."""
    grown = mask.copy()
    for down in (-1, 0, 1):
        for right in (-1, 0, 1):
            grown |= np.roll(mask, (down, right), axis=(0, 1))
    return grown & ~mask


def build(extra="", styles=""):
    parts, style = ROOM.split("[styles.outer]\n")
    return build_floor_plan(parse_description(parts + extra + "\n[styles.outer]\n" + style + styles))


def test_truth_of_bare_room():
    plan = build()
    walls = hand_made_walls()
    assert np.array_equal(plan.truth.walls, walls)
    assert np.array_equal(plan.truth.ignore, rim(walls))
    assert not plan.truth.windows.any() and plan.truth.doors == ()
    assert np.array_equal(plan.world.obstacles, walls)
    assert (plan.drawing.grey[walls] == 0).all() and plan.drawing.colour is None


def test_truth_of_door():
    plan = build('doors = [{ at = [0.25, 2], width = 1, hinge = "south", opens = "east", kind = "arc" }]')
    gap = np.zeros((60, 80), dtype=bool)
    gap[25:35, 10:15] = True  # 1 m of the western wall, rows counted from the top
    assert np.array_equal(plan.truth.walls, hand_made_walls() & ~gap)
    assert plan.truth.ignore[gap].all()
    (door,) = plan.truth.doors
    assert np.allclose(door.points, [(15, 35), (15, 25), (25, 35)])  # x right, y DOWN
    assert door.kind == "arc" and door.width == pytest.approx(10)
    # the arc's middle is ink and don't-care, the room behind it is neither
    middle = (int(35 - 10 * np.sin(np.pi / 4)), int(15 + 10 * np.cos(np.pi / 4)))
    assert plan.truth.ignore[middle] and plan.drawing.grey[middle] < 255
    assert not plan.truth.ignore[20:40, 28:60].any()
    # in the world the leaf stands open: a line of obstacle from hinge to tip, the gap is free
    assert not plan.world.obstacles[gap & ~rim(hand_made_walls() & ~gap)].any()
    assert plan.world.obstacles[34:36, 17:24].any(axis=0).all()


def test_world_holds_doors_as_far_open_as_said():
    shut = build('doors = [{ at = [0.25, 2], width = 1, hinge = "south", opens = "east", open = 0 }]').world.obstacles
    half = build('doors = [{ at = [0.25, 2], width = 1, hinge = "south", opens = "east", open = 45 }]').world.obstacles
    assert shut[26:34, 14:16].any(axis=1).all()
    assert half[34 - 5, 15 + 5] or half[34 - 5, 15 + 6] or half[34 - 6, 15 + 5]
    assert not half[26:30, 12].any()


def test_truth_of_window():
    plan = build("windows = [{ at = [3, 3.75], width = 2 }]")
    window = np.zeros((60, 80), dtype=bool)
    window[10:15, 30:50] = True
    assert np.array_equal(plan.truth.windows, window)
    assert np.array_equal(plan.truth.walls & ~window, hand_made_walls() & ~window)
    ink = plan.truth.walls & window
    assert ink[[10, 14], 30:50].all()  # both faces
    assert np.array_equal(plan.truth.ignore & window, window & ~ink)
    assert (plan.drawing.grey[ink] < 128).all()
    assert np.array_equal(plan.world.obstacles, hand_made_walls())
    assert np.array_equal(plan.truth.obstacles, hand_made_walls())


def test_truth_of_walled_up_doorway():
    plan = build('doors = [{ at = [5.75, 2], width = 1, kind = "opening", plan_shows_wall = true }]')
    walls = hand_made_walls()
    gap = np.zeros((60, 80), dtype=bool)
    gap[25:35, 65:70] = True
    assert np.array_equal(plan.truth.walls, walls)
    assert (plan.drawing.grey[gap] == 0).all()
    assert np.array_equal(plan.truth.ignore, rim(walls) | gap)
    assert np.array_equal(plan.world.obstacles, walls & ~gap)
    assert plan.truth.doors == ()


@pytest.mark.parametrize("look", ["hollow", "hatched"])
def test_truth_between_the_lines_of_a_wall_is_ignored(look):
    plan = build(styles=f'look = "{look}"\nline = 1\nhatch = 0.6\n')
    body = hand_made_walls()
    lines = body.copy()
    inside = np.zeros_like(body)
    inside[11:49, 11:69] = True
    inside[14:46, 14:66] = False  # one pixel of line on either face
    lines &= ~inside
    assert np.array_equal(plan.truth.walls, lines)
    assert np.array_equal(plan.truth.ignore, rim(lines) | inside)
    assert np.array_equal(plan.world.obstacles, body)
    assert (plan.drawing.grey[lines] == 0).all()
    shade = plan.drawing.grey[inside]
    assert (shade == 255).all() if look == "hollow" else (shade < 128).any() and (shade == 255).any()


def test_truth_of_furniture():
    plan = build(
        'furniture = [{ kind = "bath", at = [2, 3], size = [1.6, 0.8] },'
        ' { kind = "table", at = [4.5, 1.5], size = [1, 1] },'
        ' { kind = "box", at = [2, 1.2], size = [0.6, 0.4], only_in_world = true }]'
    )
    bath, table, box = (np.zeros((60, 80), dtype=bool) for _ in range(3))
    bath[16:24, 22:38] = True
    table[30:40, 50:60] = True
    box[36:40, 27:33] = True
    walls = hand_made_walls()
    assert np.array_equal(plan.truth.ignore, rim(walls) | ((bath | rim(bath)) & ~walls))  # only what is built in
    assert np.array_equal(plan.world.obstacles, walls | bath | table | box)
    assert (plan.drawing.grey[box] == 255).all() and (plan.drawing.grey[rim(table)] < 255).any()


def test_truth_of_stairs_is_ignored_and_stands_in_the_way():
    plan = build('stairs = [{ at = [4.5, 2], size = [1, 2], treads = 8, up = "north" }]')
    flight = np.zeros((60, 80), dtype=bool)
    flight[20:40, 50:60] = True
    assert np.array_equal(plan.truth.ignore, rim(hand_made_walls()) | flight | rim(flight))
    assert np.array_equal(plan.world.obstacles, hand_made_walls() | flight)


def test_diagonal_wall_covers_its_area():
    room = ROOM.replace("rooms", "windows = []\nrooms").replace(
        "[0, 4]] }]", '[0, 4]] }, { style = "outer", path = [[1, 1], [4, 3]] }]'
    )
    plan = build_floor_plan(parse_description(room.replace("at = [3, 2]", "at = [5, 1]")))
    inner = plan.truth.walls[16:44, 16:64]
    assert inner.sum() == pytest.approx(np.hypot(30, 20) * 5, rel=0.05)


def test_room_area_is_written_from_the_walls(monkeypatch):
    from priorlab.buildings import floor_plans

    seen = {}
    monkeypatch.setattr(floor_plans, "render", lambda *given: seen.update(given[2]) or original(*given))
    original = __import__("priorlab.buildings.render", fromlist=["render"]).render
    build()
    assert seen == {"Room": pytest.approx(5.0 * 3.0)}


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (("at = [3, 2]", "at = [0.2, 0.2]"), "the point of room 'Room' must lie between its walls"),
        (("at = [3, 2]", "at = [-0.5, 2]"), "room 'Room' must be closed by walls"),
        (("outline = [[0, 0], [6, 0], [6, 4], [0, 4]]", "path = [[0, 0], [6, 0], [6, 4], [0, 4]]"), "leads outdoors"),
        (('rooms = [{ name = "Room", at = [3, 2], text = 0.2 }]', ""), "rooms must hold at least one room"),
    ],
)
def test_build_floor_plan_tells_what_is_open(change, sentence):
    with pytest.raises(ValueError, match=sentence):
        build_floor_plan(parse_description(ROOM.replace(*change)))


def test_tour_tells_a_room_that_nothing_leads_to():
    text = ROOM.replace("rooms = [", 'rooms = [{ name = "Cell", at = [1, 2] }, ').replace(
        "[0, 4]] }]", '[0, 4]] }, { style = "outer", path = [[2, 0.5], [2, 3.5]] }]'
    )
    with pytest.raises(ValueError, match="room 'Room' must be reachable with 0.22 m to every obstacle"):
        build_floor_plan(parse_description(text))
