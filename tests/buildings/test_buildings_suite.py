"""The drawing suite: every row can be drawn, is what it says, and the two halves have nothing in common but their styles."""

from collections import Counter
from dataclasses import replace

import cv2
import numpy as np
import pytest

from priorlab.buildings.description import read_description
from priorlab.buildings.floor_plans import build_floor_plan, floor_plan_names
from priorlab.buildings.frame import frame_of
from priorlab.buildings.geometry import leaves_of
from priorlab.buildings.grow import draw_recipe, grow_building, wall_area
from priorlab.buildings.layout import Placed, lay_out
from priorlab.buildings.paper import Paper
from priorlab.buildings.parts import FURNITURE_SIZES, Furniture
from priorlab.buildings.pen import Pen
from priorlab.buildings.recipe import Recipe, WallLook, read_recipes
from priorlab.buildings.site import ROOM
from priorlab.buildings.surroundings import DRAWN
from priorlab.buildings.symbol_families import FAMILIES
from priorlab.core.shipped import data_folder

HALVES = {half: read_recipes(data_folder() / f"suite_{half}.toml") for half in ("tuned", "scored")}
ROWS = [recipe for half in HALVES.values() for recipe in half]
BUNDLED = ("busy_flat", "office_floor", "office_wing", "small_flat")
HANDS = ("symbols", "door_symbol", "window", "stairs", "dimension", "font", "words")


def small(recipe):
    """The same building, clean, on a sheet of at most 450 pixels, for speed."""
    share = min(1.0, 450 / recipe.long_side)
    outer, inner = (replace(look, px=max(1.5, share * look.px)) for look in (recipe.outer, recipe.inner))
    return replace(recipe, long_side=round(share * recipe.long_side), outer=outer, inner=inner, degradations=())


def weights(recipe):
    """Line weights of a drawing in quarters of a pixel, as they are drawn."""
    walls = [look.line for look in (recipe.outer, recipe.inner) if look.look in ("hollow", "hatched")]
    return {round(4 * weight) for weight in (recipe.line, *walls)}


def test_halves_have_twelve_drawings_each_of_the_same_styles():
    tuned, scored = (Counter(recipe.style for recipe in half) for half in HALVES.values())
    assert tuned == scored and sum(tuned.values()) >= 12
    assert {"filled", "single", "hollow", "hatched", "grey", "coloured", "outline", "mixed"} <= set(tuned)
    for half in HALVES.values():
        doors = {kind for recipe in half for kind in recipe.doors}
        assert doors == {"arc", "arc_panel", "double", "double_unequal", "leaf_90", "leaf_45", "folding"}
        assert {d.kind for recipe in half for d in recipe.degradations} == {"skew", "blur", "shading", "noise", "jpeg"}
        assert min(r.long_side for r in half) < 350 and max(r.long_side for r in half) > 1900
        assert min(r.inner.px for r in half) <= 2.5 and max(r.outer.px for r in half) >= 18
        assert {"flat", "corridor", "wing", "diagonal"} == {recipe.kind for recipe in half}
    assert len({recipe.name for recipe in ROWS}) == len({recipe.seed for recipe in ROWS}) == len(ROWS)


@pytest.mark.parametrize("hand", HANDS)
def test_halves_share_no_hand(hand):
    tuned, scored = ({getattr(recipe, hand) for recipe in half} for half in HALVES.values())
    assert not tuned & scored


def test_halves_share_no_line_weight_and_no_clutter():
    tuned, scored = (set().union(*map(weights, half)) for half in HALVES.values())
    assert not tuned & scored
    tuned, scored = ({kind for recipe in half for kind in recipe.clutter} for half in HALVES.values())
    assert tuned & scored == {"furniture", "dimensions"}  # drawn by other hands
    tuned, scored = ({look.px for r in half for look in (r.outer, r.inner)} for half in HALVES.values())
    assert tuned & scored <= {3.0}


def test_scored_half_shares_nothing_with_the_bundled_buildings():
    scored = HALVES["scored"]
    assert set(BUNDLED) <= set(floor_plan_names())
    for name in BUNDLED:
        description = read_description(data_folder() / f"{name}.toml")
        sheet = description.sheet
        hands = {sheet.symbols, sheet.door_symbol, sheet.window_symbol, sheet.stairs_symbol, sheet.dimension_mark, sheet.font}
        assert not hands & {getattr(recipe, hand) for recipe in scored for hand in HANDS}
        lines = {sheet.line, *(style.line for style in description.styles.values() if style.look in ("hollow", "hatched"))}
        assert not {round(4 * line) for line in lines} & set().union(*map(weights, scored))
        assert not description.marks


@pytest.mark.parametrize("kind", sorted(FURNITURE_SIZES))
def test_every_family_draws_a_kind_in_its_own_way(kind):
    frame = frame_of(grow_building(Recipe("any", rooms=4, size=(6, 6))))
    pictures = []
    for family in FAMILIES.values():
        paper = Paper(frame)
        width, depth = FURNITURE_SIZES[kind]
        family[kind](Pen(paper, Placed(Furniture(kind, at=(3, 3)), np.array([3.0, 3.0]), width, depth, 0.0)))
        pictures.append(paper.picture())
    for n, one in enumerate(pictures):
        assert (one < 128).any()
        if kind not in ("box", "table", "counter"):  # rectangles are rectangles
            assert all((one != other).any() for other in pictures[:n])
    unlike = [(one != other).any() for one in pictures[:2] for other in pictures[2:]]  # the halves' hands
    assert all(unlike)


@pytest.mark.parametrize("recipe", ROWS, ids=lambda recipe: recipe.name)
def test_every_row_can_be_drawn_and_all_its_rooms_can_be_reached(recipe):
    assert len(grow_building(recipe).rooms) == recipe.rooms
    recipe = small(recipe)
    description, (drawing, truth) = grow_building(recipe), draw_recipe(recipe)
    assert len(description.doors) >= recipe.rooms
    assert len(truth.doors) == sum(1 + (door.kind == "double") for door in description.doors)
    assert drawing.grey[truth.walls].mean() < 0.6 * drawing.grey.max() < 0.9 * np.median(drawing.grey)
    _, regions = cv2.connectedComponents((~truth.obstacles).astype(np.uint8), connectivity=4)
    places = frame_of(description).to_image([room.at for room in description.rooms]).astype(int)
    labels = {int(regions[y, x]) for x, y in places}
    assert len(labels) == 1 and 0 not in labels  # with its doors open, the building is one room


@pytest.mark.parametrize("recipe", [r for r in ROWS if r.long_side < 700], ids=lambda recipe: recipe.name)
def test_small_rows_are_the_same_every_time(recipe):
    (one, truth), (other, again) = draw_recipe(recipe), draw_recipe(recipe)
    assert np.array_equal(one.grey, other.grey) and np.array_equal(truth.walls, again.walls)
    assert np.array_equal(truth.ignore, again.ignore) and truth.doors == again.doors


def test_walls_lie_where_the_size_says():
    recipe = Recipe(
        "plain", seed=5, size=(10, 8), rooms=5, long_side=1140, outer=WallLook(px=12), inner=WallLook(px=6), clutter=()
    )
    drawing, truth = draw_recipe(recipe)
    assert drawing.shape == (940, 1140)  # 0.7 m round 10 x 8 m, a hundred pixels per metre
    outer = np.zeros(drawing.shape, bool)
    outer[70:870, 70:1070] = True
    assert not truth.walls[~outer].any()
    inside = outer.copy()
    inside[82:858, 82:1058] = False
    openings = np.zeros(drawing.shape, bool)
    layout = lay_out(grow_building(recipe))
    for opening in [door.opening for door in layout.doors] + [window.opening for window in layout.windows]:
        left, top = np.floor(layout.frame.to_image(opening.outline).min(axis=0)).astype(int)
        right, bottom = np.ceil(layout.frame.to_image(opening.outline).max(axis=0)).astype(int)
        openings[top:bottom, left:right] = True
    assert truth.walls[inside & ~openings].all()
    assert (drawing.grey[inside & ~openings] == 0).all()
    area = wall_area(recipe)
    assert np.array_equal(area[~openings], truth.walls[~openings])


def test_area_of_hollow_walls_holds_what_lies_between_their_lines():
    look = WallLook("hollow", px=12, line=2)
    recipe = Recipe("hollow", seed=5, size=(10, 8), rooms=5, long_side=570, outer=look, inner=look, clutter=())
    _, truth = draw_recipe(recipe)
    area = wall_area(recipe)
    # two lines of 2 pixels in a wall of 12: a third is ink
    assert truth.walls[area].mean() == pytest.approx(1 / 3, abs=0.08)
    assert truth.ignore[area & ~truth.walls].all()


def test_doors_swing_into_free_floor():
    recipe = HALVES["tuned"][1]
    layout, (_, truth) = lay_out(grow_building(recipe)), draw_recipe(recipe)
    for door in layout.doors:
        for leaf in leaves_of(door.part, door.opening):
            x, y = layout.frame.to_image(leaf.hinge + 0.5 * leaf.width * leaf.square + 0.2 * leaf.width * leaf.shut).astype(int)
            assert not truth.walls[y, x]


@pytest.mark.parametrize("kind", sorted(ROOM))
def test_clutter_lies_on_the_sheet(kind):
    assert set(DRAWN) | {"furniture"} == set(ROOM)
    bare, more = (grow_building(Recipe("bare", seed=3, clutter=clutter)) for clutter in ((), (kind,)))
    parts = ("furniture", "lines", "marks", "notes", "dimensions")
    added = sum(len(getattr(more, part)) - len(getattr(bare, part)) for part in parts)
    printed = (more.sheet.frame, more.sheet.block, more.sheet.north_arrow, more.sheet.scale_bar)
    assert added > 0 or any(printed)
    points = [point for line in more.lines for point in line.path] + [part.at for part in (*more.marks, *more.notes)]
    points += [piece.at for piece in more.furniture if piece.at is not None]
    frame = frame_of(more)
    for x, y in frame.to_image(np.array(points)) if points else ():
        assert -1 <= x <= frame.shape[1] + 1 and -1 <= y <= frame.shape[0] + 1


def test_read_recipes_says_what_is_wrong(tmp_path):
    path = tmp_path / "rows.toml"
    path.write_text('[[drawing]]\nname = "a"\nseeds = 3\n')
    with pytest.raises(ValueError, match=r"rows.toml: drawing 1: .*did you mean 'seed'"):
        read_recipes(path)
    path.write_text('[[drawing]]\nname = "a"\nsize = [3, 9]\n')
    with pytest.raises(ValueError, match="size must be at least 5 x 5 m, got 3 x 9"):
        read_recipes(path)
    path.write_text('[[drawing]]\nname = "a"\ndegradations = [{ kind = "fire", amount = 3 }]\n')
    with pytest.raises(ValueError, match="kind must be one of"):
        read_recipes(path)


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("kind", ["flat", "corridor", "wing", "diagonal"])
def test_any_seed_grows_a_building(kind, seed):
    description = grow_building(Recipe("any", seed=seed, kind=kind, rooms=6 + seed % 5, size=(11 + seed % 4, 9), long_side=700))
    layout = lay_out(description)  # every door and window stands on a wall
    assert len(layout.doors) >= len(description.rooms) == 6 + seed % 5
    assert {door.part.kind for door in layout.doors} == {"arc"}


@pytest.mark.parametrize("kind", ["flat", "corridor", "wing"])
def test_a_building_per_student_can_be_driven_through(kind):
    recipe = Recipe("mine", seed=4, kind=kind, rooms=7, long_side=420)
    plan = build_floor_plan(grow_building(recipe, passage=0.5))
    assert len(plan.tour) > 7 and len(plan.survey) > 7 and len(plan.truth.doors) >= 7
