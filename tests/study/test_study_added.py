"""What a robot added to its plan, by hand, and F2 over the steps of a run against one map a step."""

from dataclasses import replace

import numpy as np
import pytest

from priorlab.core.building import Truth, World
from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.score import score_map
from priorlab.core.sensor import Scanner
from priorlab.robot.drive import drive
from priorlab.slam.counting import CountedMap, counted_map
from priorlab.slam.fastslam import FastSLAM
from priorlab.study.added import changes_between, f2_over_time, what_was_added

FREE, WALL, UNKNOWN = 1.0, -1.0, 0.0


def strip(text: str) -> np.ndarray:
    """(rows, cols) True at every '#'."""
    return np.array([[letter == "#" for letter in row] for row in text.split()])


PLAN = strip(
    """
    ....................
    ....................
    ####################
    """
)
WORLD = strip(
    """
    ..##................
    ..##......#.........
    #####......#########
    """
)


@pytest.fixture(scope="module")
def changes():
    """A cupboard of two by two cells, a chair of one, and a doorway of six cells in the wall; cells of 0.1 m."""
    ignore = np.zeros(PLAN.shape, bool)
    ignore[1, 10] = True  # the chair lies on the ink of a symbol
    return changes_between(Truth(PLAN, ignore, metres_per_pixel=0.1), World(WORLD, 0.1), Grid(PLAN.shape, 1, 0.1))


def test_changes_between_finds_what_is_blocked_and_what_is_opened(changes):
    assert np.argwhere(changes.blocked).tolist() == [[0, 2], [0, 3], [1, 2], [1, 3]]
    assert np.argwhere(changes.opened).tolist() == [[2, col] for col in range(5, 11)]
    assert len(changes.doorways) == 1 and (changes.doorways[0] == changes.opened).all()


def test_changes_between_knows_a_walled_up_doorway_though_the_score_does_not_ask(changes):
    ignore = np.zeros(PLAN.shape, bool)
    ignore[2, 4:12] = True
    again = changes_between(Truth(PLAN, ignore, metres_per_pixel=0.1), World(WORLD, 0.1), Grid(PLAN.shape, 1, 0.1))
    assert (again.opened == changes.opened).all()


def test_changes_between_takes_a_short_gap_for_no_doorway():
    world = PLAN.copy()
    world[2, 3:8] = False  # half a metre
    found = changes_between(Truth(PLAN, np.zeros_like(PLAN)), World(world, 0.1), Grid(PLAN.shape, 1, 0.1))
    assert found.opened.sum() == 5 and not found.doorways


def test_changes_between_counts_larger_cells_only_when_they_are_clear():
    plan, world = np.zeros((2, 8), bool), np.zeros((2, 8), bool)
    plan[:, 2:5] = True  # cells 1 and half of 2 are wall in the plan; nothing stands in the world
    world[0, 7] = True  # in cell 3, one pixel of four
    found = changes_between(Truth(plan, np.zeros_like(plan)), World(world, 0.1), Grid(plan.shape, 2, 0.1))
    assert found.opened.tolist() == [[False, True, False, False]]
    assert found.blocked.tolist() == [[False, False, False, True]]


def test_what_was_added_counts_by_hand(changes):
    grid = changes.grid
    seen = np.zeros(grid.shape, bool)
    seen[0, 2], seen[1, 2], seen[1, 3] = True, True, True  # of the cupboard three cells were seen
    seen[2, 5:9] = True  # and four of the doorway
    plan_alone = np.where(PLAN, WALL, FREE)
    looked = plan_alone.copy()
    looked[0, 2], looked[1, 2] = WALL, WALL  # two of the three rightly
    looked[2, 5:8] = FREE  # three of the four rightly, three of six free at all: not more than half
    wide = looked.copy()
    wide[2, 9] = FREE  # a fourth, that was not seen
    blank = np.where(seen, looked, UNKNOWN)
    added = what_was_added(
        changes,
        seen,
        {
            "alone": GridMap(plan_alone, grid),
            "looked": GridMap(looked, grid),
            "wide": GridMap(wide, grid),
            "blank": GridMap(blank, grid),
        },
    )
    assert (added.blocked.cells, added.blocked.seen) == (4, 3)
    assert added.blocked.right == {"alone": 0, "looked": 2, "wide": 2, "blank": 2}
    assert (added.opened.cells, added.opened.seen) == (6, 4)
    assert added.opened.right == {"alone": 0, "looked": 3, "wide": 3, "blank": 3}
    assert added.doorways[0].right["looked"] == 3
    assert added.passable == {"alone": 0, "looked": 0, "wide": 1, "blank": 0}
    assert added.blocked.share["looked"] == pytest.approx(2 / 3)


def test_what_was_added_takes_even_odds_for_no_answer(changes):
    everything = np.ones(changes.grid.shape, bool)
    unknown = GridMap(np.zeros(changes.grid.shape), changes.grid, Prior.uninformed())
    never = CountedMap(np.ones(changes.grid.shape), np.ones(changes.grid.shape), changes.grid)
    added = what_was_added(changes, everything, {"unknown": unknown, "even": never})
    assert added.blocked.right == added.opened.right == {"unknown": 0, "even": 0}


def test_what_was_added_by_a_robot_that_saw_nothing_is_no_number(changes):
    alone = GridMap(np.where(PLAN, WALL, FREE), changes.grid)
    added = what_was_added(changes, np.zeros(changes.grid.shape, bool), {"alone": alone})
    assert added.blocked.seen == 0 and np.isnan(added.blocked.share["alone"])


def test_what_was_added_asks_for_one_grid(changes):
    with pytest.raises(ValueError, match="seen must have the shape of changes"):
        what_was_added(changes, np.zeros((2, 2), bool), {})
    with pytest.raises(ValueError, match="other must have the shape of changes"):
        what_was_added(changes, np.zeros(changes.grid.shape, bool), {"other": GridMap(np.zeros((1, 3)), Grid((1, 3)))})


@pytest.fixture(scope="module")
def drive_in_a_room():
    """A room of 4 x 3 m at 0.05 m a pixel with a box that the plan lacks, driven through once."""
    walls = np.zeros((60, 80), bool)
    walls[:3], walls[-3:], walls[:, :3], walls[:, -3:] = True, True, True, True
    world = walls.copy()
    world[10:18, 60:70] = True
    grid = Grid(walls.shape, 1, 0.05)
    prior_map = GridMap(np.where(walls, -0.99, 0.94), grid, Prior(0.3, 0.8))
    log = drive(World(world, 0.05), [[0.6, 0.6], [3.0, 0.6], [3.0, 1.6]], Scanner(n_beams=20), rng=np.random.default_rng(3))
    run = FastSLAM(particle_limits=(100, 100)).run(prior_map, log, np.random.default_rng(4))
    return run, Truth(walls, np.zeros_like(walls), metres_per_pixel=0.05), World(world, 0.05)


@pytest.mark.parametrize("lam", [0.0, 1.0])
def test_f2_over_time_is_the_score_of_every_map(drive_in_a_room, lam):
    run, truth, _ = drive_in_a_room
    run = FastSLAM(run.parameters, lam=lam).run(run.prior_map, run.log, np.random.default_rng(4))
    uninformed = GridMap(np.zeros(run.map.grid.shape), run.map.grid, Prior.uninformed())
    curves = f2_over_time(run, {"with": run.prior_map, "without": uninformed}, truth)
    assert curves.steps.tolist() == list(range(len(run) + 1))
    expected = [score_map(one, truth, 0.5).f_beta for one in (run.prior_map, *(run.at(k) for k in range(len(run))))]
    np.testing.assert_allclose(curves.f_beta["with"], expected, rtol=0, atol=1e-12)
    assert curves.f_beta["without"][-1] == pytest.approx(score_map(run.remap(uninformed), truth, 0.5).f_beta, abs=1e-12)
    assert curves.f_beta["without"][0] == 0.0
    assert curves.seen[-1] == pytest.approx(counted_map(run).seen.mean())


def test_f2_over_time_can_leave_steps_out(drive_in_a_room):
    run, truth, _ = drive_in_a_room
    every_step = f2_over_time(run, {"with": run.prior_map}, truth, threshold=0.3)
    some = f2_over_time(run, {"with": run.prior_map}, truth, threshold=0.3, every=7)
    assert some.steps.tolist() == [*range(0, len(run), 7), len(run)]
    np.testing.assert_array_equal(some.f_beta["with"], every_step.f_beta["with"][some.steps])


def test_the_box_that_the_plan_lacks_is_what_the_robot_adds(drive_in_a_room):
    run, truth, world = drive_in_a_room
    knowing = replace(run, trajectory=run.log.truth)  # what a filter of 100 particles makes of it is left to chance
    changes = changes_between(truth, world, run.map.grid)
    maps = {"map": knowing.remap(run.prior_map), "alone": run.prior_map}
    added = what_was_added(changes, counted_map(knowing).seen, maps)
    assert changes.blocked.sum() == 80 and not changes.opened.any()
    assert added.blocked.seen > 10
    assert added.blocked.share["map"] > 0.8 and added.blocked.right["alone"] == 0
