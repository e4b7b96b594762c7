"""Algorithm 6.5 against a slow reading: rays of cells with exact fractions, the log odds cell by cell."""

import math
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from priorlab.core.grid import Grid
from priorlab.slam.map_update import FREE, OCCUPIED, UNSEEN, see_cells, update_seen
from priorlab.slam.parameters import TUNED
from priorlab.slam.scan import Scan

GRID = Grid((40, 50), 1, 0.1)  # 5 x 4 m
THIN = replace(TUNED, thickening_m=0.0)


def scan_of(ranges, bearings, open_bearings=(), offset=(0.0, 0.0)):
    return Scan(np.asarray(ranges, float), np.asarray(bearings, float), np.asarray(open_bearings, float), offset)


def full_labels(grid, pose, scan, parameters):
    """The labels of the window, put back on the whole map."""
    seen = see_cells(grid, np.asarray(pose, float), scan, parameters)
    labels = np.zeros(grid.shape, dtype=int)
    labels[seen.rows, seen.cols] = seen.labels
    return labels


def slow_ray(start, end):
    """For every step along the longer axis the nearest cells of the other one; two where the line runs between them."""
    (r0, c0), (r1, c1) = start, end
    n = max(abs(r1 - r0), abs(c1 - c0))
    steps = []
    for i in range(n + 1):
        share = Fraction(i, n) if n else Fraction(0)
        row, col = r0 + share * (r1 - r0), c0 + share * (c1 - c0)
        rows = {math.floor(row + Fraction(1, 2)), math.ceil(row - Fraction(1, 2))}
        cols = {math.floor(col + Fraction(1, 2)), math.ceil(col - Fraction(1, 2))}
        steps.append({(r, c) for r in rows for c in cols})
    return steps


def slow_cell(grid, x, y):
    """Row and column of a point in metres; row 0 at the top."""
    return grid.shape[0] - 1 - math.floor(y / grid.cell_size_m), math.floor(x / grid.cell_size_m)


def slow_see(grid, pose, scan, parameters):
    """Cells that must be, and cells that may be (ties between two), free and occupied."""
    x, y, theta = pose
    eye = (
        x + scan.offset[0] * math.cos(theta) - scan.offset[1] * math.sin(theta),
        y + scan.offset[0] * math.sin(theta) + scan.offset[1] * math.cos(theta),
    )

    def at(bearing, distance):
        return slow_cell(grid, eye[0] + distance * math.cos(theta + bearing), eye[1] + distance * math.sin(theta + bearing))

    must, may = {FREE: set(), OCCUPIED: set()}, {FREE: set(), OCCUPIED: set()}
    rays = []
    for z, bearing in zip(scan.ranges, scan.bearings, strict=True):
        rays.append((FREE, slow_cell(grid, *eye), at(bearing, z)))
        rays.append((OCCUPIED, at(bearing, z), at(bearing, z + parameters.thickening_m)))
    if parameters.free_on_no_return:
        rays += [(FREE, slow_cell(grid, *eye), at(bearing, parameters.max_range_m)) for bearing in scan.open_bearings]
    for kind, start, end in rays:
        for cells in slow_ray(start, end):
            may[kind] |= cells
            if len(cells) == 1:
                must[kind] |= cells
    return must, may


@pytest.mark.parametrize(
    "parameters",
    [
        THIN,
        replace(TUNED, thickening_m=0.35),
        replace(TUNED, free_on_no_return=True),
        replace(TUNED, free_on_no_return=True, max_range_m=4.3),
    ],
    ids=["thin", "thick", "open", "open and far"],
)
def test_see_cells_agrees_with_slow_rays(parameters):
    rng = np.random.default_rng(0)
    for _ in range(40):
        pose = (rng.uniform(-0.5, 5.5), rng.uniform(-0.5, 4.5), rng.uniform(-np.pi, np.pi))  # also off the map
        scan = scan_of(rng.uniform(0.3, 2.5, 6), rng.uniform(-1.5, 1.5, 6), rng.uniform(-3, 3, 2), offset=(0.15, -0.05))
        labels = full_labels(GRID, pose, scan, parameters)
        must, may = slow_see(GRID, pose, scan, parameters)
        for cell, label in np.ndenumerate(labels):
            if cell in must[OCCUPIED]:
                assert label == OCCUPIED
            elif label == OCCUPIED:
                assert cell in may[OCCUPIED]
            elif label == FREE:
                assert cell in may[FREE]
            else:
                assert cell not in must[FREE]


def test_see_cells_by_eye():
    labels = full_labels(Grid((3, 8), 1, 1.0), (0.5, 1.5, 0.0), scan_of([4.2], [0.0]), replace(TUNED, thickening_m=1.0))
    assert labels.tolist() == [[0] * 8, [FREE, FREE, FREE, FREE, OCCUPIED, OCCUPIED, UNSEEN, UNSEEN], [0] * 8]


def test_see_cells_left_is_up():
    labels = full_labels(Grid((5, 3), 1, 1.0), (1.5, 0.5, 0.0), scan_of([3.0], [np.pi / 2]), THIN)
    assert labels[:, 1].tolist() == [UNSEEN, OCCUPIED, FREE, FREE, FREE]


def test_see_cells_occupied_wins_over_free_and_counts_once():
    scan = scan_of([1.05, 3.0, 1.05, 3.0], [0.0, 0.0, 0.0, 0.0])  # the far beams pass the near hit
    labels = full_labels(GRID, (1.05, 2.05, 0.0), scan, THIN)
    assert labels[19, 21] == OCCUPIED
    log_odds_map, prior = np.ones(GRID.shape), np.ones(GRID.shape)
    update_seen(log_odds_map, prior, see_cells(GRID, np.array([1.05, 2.05, 0.0]), scan, THIN), THIN)
    assert log_odds_map[19, 21] == pytest.approx(math.log(0.25))  # one update, though four beams crossed it


def test_see_cells_of_no_beam_and_off_the_map():
    labels = full_labels(GRID, (1, 1, 0), scan_of([], [], [0.0]), TUNED)
    assert not labels.any()  # a beam without a return carves nothing
    assert not full_labels(GRID, (100.0, -50.0, 0), scan_of([2.0], [0.0]), TUNED).any()


@pytest.mark.parametrize("lam", [1.0, 0.0, 0.3])
def test_update_seen_agrees_with_eq_6_2_cell_by_cell(lam):
    rng = np.random.default_rng(2)
    parameters = replace(TUNED, lam=lam, p_free=0.85, p_occupied=0.1)
    prior = rng.normal(size=GRID.shape)
    log_odds_map, expected = prior.copy(), prior.copy()
    for _ in range(5):
        pose = np.array([rng.uniform(0, 5), rng.uniform(0, 4), rng.uniform(-3, 3)])
        scan = scan_of(rng.uniform(0.3, 2.5, 8), rng.uniform(-1, 1, 8))
        labels = full_labels(GRID, pose, scan, parameters)
        for cell, label in np.ndenumerate(labels):
            if label == FREE:
                expected[cell] = math.log(0.85 / 0.15) + expected[cell] - lam * prior[cell]
            elif label == OCCUPIED:
                expected[cell] = math.log(0.1 / 0.9) + expected[cell] - lam * prior[cell]
        before = log_odds_map.copy()
        update_seen(log_odds_map, prior, see_cells(GRID, pose, scan, parameters), parameters)
        assert np.allclose(log_odds_map, expected, atol=1e-12)
        assert np.array_equal(log_odds_map[labels == UNSEEN], before[labels == UNSEEN])  # "p_previous": to the last bit


def test_update_seen_makes_free_free_and_hits_walls():
    log_odds_map = np.zeros(GRID.shape)
    update_seen(
        log_odds_map, np.zeros(GRID.shape), see_cells(GRID, np.array([1.05, 2.05, 0.0]), scan_of([2.0], [0.0]), TUNED), TUNED
    )
    assert log_odds_map[19, 15] > 0 and log_odds_map[19, 30] < 0 and log_odds_map[5, 5] == 0
