"""The drawing itself: styles, kinds of doors, colour, text; deterministic."""

import numpy as np
import pytest

from priorlab.buildings.description import parse_description
from priorlab.buildings.floor_plans import draw_plan
from priorlab.buildings.lettering import text_polygons
from priorlab.buildings.parts import BUILT_IN, FURNITURE_SIZES
from priorlab.buildings.symbol_families import FAMILIES

WALL = """
metres_per_pixel = 0.02
walls = [{{ style = "w", path = [[0, 0], [4, 0]] }}]
{extra}
[styles.w]
thickness = 0.2
{style}
"""


def draw(extra="", style=""):
    return draw_plan(parse_description(WALL.format(extra=extra, style=style)))


@pytest.mark.parametrize("kind", ["arc", "arc_panel", "double", "leaf", "folding", "sliding", "opening"])
def test_every_kind_of_door_is_drawn_and_ignored(kind):
    bare, _ = draw()
    drawing, truth = draw(f'doors = [{{ at = [2, 0], width = 0.8, hinge = "west", opens = "north", kind = "{kind}" }}]')
    changed = drawing.grey != bare.grey
    assert changed.any()
    assert truth.ignore[changed].all()  # whatever a door changes in the drawing is don't-care
    leaves = {"double": 2, "sliding": 0, "opening": 0}.get(kind, 1)
    assert len(truth.doors) == leaves and all(door.kind == kind for door in truth.doors)


def test_leaf_alone_has_no_arc():
    leaf, _ = draw('doors = [{ at = [2, 0], hinge = "west", opens = "north", kind = "leaf", drawn_open = 90 }]')
    arc, _ = draw('doors = [{ at = [2, 0], hinge = "west", opens = "north", kind = "arc", drawn_open = 90 }]')
    assert (arc.grey < 255).sum() > (leaf.grey < 255).sum()
    assert (arc.grey <= leaf.grey).all()


@pytest.mark.parametrize(("look", "share"), [("filled", 1.0), ("hollow", 2 * 1.6 / 10), ("hatched", 0.32 + 0.68 * 1.2 / 6)])
def test_looks_differ_in_ink(look, share):
    drawing, _ = draw(style=f'look = "{look}"')
    body = drawing.grey[45:55, 50:250]  # 4 x 0.2 m round the middle of the sheet
    assert (255 - body).mean() / 255 == pytest.approx(share, abs=0.03)


def test_single_line_is_as_heavy_as_said():
    drawing, truth = draw(style='look = "single"\nline = 2')
    assert (255 - drawing.grey[:, 150].astype(float)).sum() / 255 == pytest.approx(2, abs=0.1)
    assert truth.walls[:, 150].sum() == 2


def test_coloured_walls_make_a_coloured_drawing():
    grey, _ = draw(style='ink = "#808080"')
    assert grey.colour is None and grey.grey[50, 150] == 128
    red, truth = draw(style='ink = "#c02020"')
    assert red.colour is not None and red.colour[50, 150].tolist() == [0xC0, 0x20, 0x20]
    assert abs(int(red.grey[50, 150]) - 80) <= 1  # 0.299 x 192 + 0.701 x 32
    assert truth.walls[50, 150]


def test_colour_must_be_written_in_full():
    with pytest.raises(ValueError, match="a colour must be written #rrggbb, got 'red'"):
        draw(style='ink = "red"')


def test_every_kind_of_furniture_has_a_size_and_a_symbol():
    assert all(set(family) == set(FURNITURE_SIZES) for family in FAMILIES.values())
    assert set(BUILT_IN) <= set(FURNITURE_SIZES)


@pytest.mark.parametrize("kind", sorted(FURNITURE_SIZES))
def test_furniture_stays_within_its_footprint(kind):
    bare, _ = draw()
    drawing, _ = draw(
        f'furniture = [{{ kind = "{kind}", at = [2, 0.6], size = [1.0, 0.9] }}]\nnotes = []'.replace("0.6]", "-0.5]")
    )
    assert bare.shape == drawing.shape
    rows, cols = np.nonzero(drawing.grey != bare.grey)
    # 1.0 x 0.9 m is 50 x 45 pixels; a line may stick out by its weight
    assert 0 < cols.max() - cols.min() <= 53 and 0 < rows.max() - rows.min() <= 48


def test_text_polygons_have_capitals_of_height_one_and_grow_with_the_text():
    heights = [polygon[:, 1].max() for polygon in text_polygons("HH")]
    assert heights == pytest.approx([1.0, 1.0])
    width = [max(polygon[:, 0].max() for polygon in text_polygons(text)) for text in ("H", "HH")]
    assert width[1] > 1.8 * width[0]
    assert text_polygons("  ") == []
    assert len(text_polygons("o")) == 2  # a ring and its hole


def test_dimension_chain_writes_what_it_measures():
    short, _ = draw('dimensions = [{ side = "south", points = [0, 1] }]')
    same, _ = draw('dimensions = [{ side = "south", points = [0, 1] }]')
    comma, _ = draw('dimensions = [{ side = "south", points = [0, 1] }]\nsheet = { decimal = "," }')
    assert np.array_equal(short.grey, same.grey)
    assert (short.grey != comma.grey).any() and (short.grey != comma.grey).sum() < 20  # only the sign between the digits
    below = short.grey[61:, :]
    assert (below < 128).any()


def test_sheet_draws_what_it_is_asked_for():
    plain, truth = draw("sheet = { margins = [1, 3, 3, 1] }")
    full, truth_full = draw(
        'sheet = { margins = [1, 3, 3, 1], title = "T", subtitle = "S", north_arrow = true, scale_bar = true, frame = true,'
        ' block = ["One", "Two"] }'
    )
    assert plain.shape == full.shape
    assert np.array_equal(truth.walls, truth_full.walls) and np.array_equal(truth.ignore, truth_full.ignore)
    assert (full.grey < 128).sum() > (plain.grey < 128).sum() + 1000
