"""Eq. 4.22 against a loop over every pixel of every cell."""

import dataclasses
import math

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from priorlab.core.building import Truth
from priorlab.core.grid import Grid
from priorlab.core.readings import Readings
from priorlab.core.sensor import RangeSensor
from priorlab.robot.explore import explore
from priorlab.robot.inverse_sensor_model import inverse_sensor_model, observe


def looks_of(readings, grid):
    """{reading: {(row, col): P(empty)}}; every pair at most once."""
    found = {}
    for looks in observe(readings, grid):
        for reading, cell, p_empty in zip(*looks, strict=True):
            place = divmod(int(cell), grid.shape[1])
            assert place not in found.setdefault(int(reading), {})
            found[int(reading)][place] = float(p_empty)
    return found


@settings(max_examples=40)
@given(
    st.integers(0, 2**32 - 1),
    st.sampled_from([0.5, 1, 2, 3, 5, 2.5, 3.7]),
    st.sampled_from(["thickness", "hit_cell", "all"]),
    st.sampled_from([0.3, math.pi / 6, 1.2, 2.5, math.pi]),
)
def test_observe_equals_loops(speckled, cone_oracle, seed, cell_size, beyond, half_angle):
    obstacles, poses = speckled(seed, n_places=3)
    sensor = RangeSensor(max_range=7, half_angle=half_angle, beyond=beyond, wall_thickness=2)
    readings = explore(Truth(obstacles, obstacles & False), poses, sensor)
    found = looks_of(readings, Grid(obstacles.shape, cell_size))
    for k, pose in enumerate(poses):
        expected = cone_oracle(pose, readings.ranges[k], readings.bearings, sensor, obstacles.shape, cell_size)
        assert found.get(k, {}) == pytest.approx(expected, abs=1e-12)


@settings(max_examples=40)
@given(
    st.integers(0, 2**32 - 1),
    st.sampled_from([0.5, 1, 3, 2.5]),
    st.sampled_from(["thickness", "hit_cell", "all"]),
    st.floats(0.1, 0.9),
)
def test_observe_without_some_readings_equals_loops(speckled, cone_oracle, seed, cell_size, beyond, share):
    obstacles, poses = speckled(seed, n_places=3)
    sensor = RangeSensor(max_range=7, beyond=beyond, wall_thickness=2)
    taken = explore(Truth(obstacles, obstacles & False), poses, sensor)
    valid = np.random.default_rng(seed).random(taken.ranges.shape) < share
    ranges = np.where(valid, taken.ranges, np.nan)
    readings = Readings(poses, ranges, taken.bearings, sensor, obstacles.shape, valid)
    found = looks_of(readings, Grid(obstacles.shape, cell_size))
    for k, pose in enumerate(poses):
        known = [z if ok else None for z, ok in zip(taken.ranges[k], valid[k], strict=True)]
        expected = cone_oracle(pose, known, readings.bearings, sensor, obstacles.shape, cell_size)
        assert found.get(k, {}) == pytest.approx(expected, abs=1e-12)


def test_what_an_invalid_range_says_does_not_matter(speckled):
    """The range under valid = False may be anything: no cell gets evidence from it."""
    obstacles, poses = speckled(7)
    taken = explore(Truth(obstacles, obstacles & False), poses, RangeSensor(max_range=7))
    valid = np.arange(taken.ranges.size).reshape(taken.ranges.shape) % 3 > 0
    grid = Grid(obstacles.shape, 2)
    said = [
        looks_of(Readings(poses, np.where(valid, taken.ranges, lie), taken.bearings, taken.sensor, obstacles.shape, valid), grid)
        for lie in (np.nan, np.inf, 0.0, -1.0)
    ]
    assert said[0] and all(one == said[0] for one in said)


def test_a_pose_without_any_reading_sees_nothing():
    readings = Readings([[2.5, 2.5, 0.0]], [[np.nan]], [0.0], RangeSensor(), (9, 9), valid=[[False]])
    for beyond in ("thickness", "hit_cell", "all"):
        blind = dataclasses.replace(readings, sensor=RangeSensor(beyond=beyond))
        assert all(len(looks.cell) == 0 for looks in observe(blind, Grid((9, 9), 2)))


@pytest.mark.parametrize("heading", range(4))
def test_observe_from_pixel_centres_is_the_same_in_every_heading(heading):
    """The cone of a survey pose, turned by quarter turns: the same cells, edges and rim included."""
    size, reach = 41, 12
    sensor = RangeSensor(max_range=reach)
    bearings = np.linspace(-sensor.half_angle, sensor.half_angle, 25)

    def seen(theta):
        pose = [[size / 2, size / 2, theta]]
        readings = Readings(pose, np.full((1, 25), np.inf), bearings, sensor, (size, size))
        mask = np.zeros(size * size, dtype=bool)
        mask[next(observe(readings, Grid((size, size)))).cell] = True
        return mask.reshape(size, size)

    ahead = seen(0.0)
    assert ahead[size // 2, size // 2 + reach] and not ahead[size // 2, size // 2 + reach + 1]
    assert (seen(heading * math.pi / 2) == np.rot90(ahead, heading)).all()
    assert ahead.sum() == pytest.approx(sensor.half_angle * reach**2, rel=0.1)  # the area of the cone


def test_observe_takes_readings_in_batches_as_one(speckled, monkeypatch):
    obstacles, poses = speckled(3, n_places=9)
    readings = explore(Truth(obstacles, obstacles & False), poses, RangeSensor(max_range=7))
    grid = Grid(obstacles.shape, 2)
    at_once = looks_of(readings, grid)
    monkeypatch.setattr("priorlab.robot.inverse_sensor_model.CANDIDATES_AT_ONCE", 100)
    assert len(list(observe(readings, grid))) > 1
    assert looks_of(readings, grid) == at_once


def reachable(free, row, col):
    """The pixels that can be walked to over sides, in plain Python."""
    found, edge = {(row, col)}, [(row, col)]
    while edge:
        row, col = edge.pop()
        for place in ((row + 1, col), (row - 1, col), (row, col + 1), (row, col - 1)):
            inside = 0 <= place[0] < free.shape[0] and 0 <= place[1] < free.shape[1]
            if inside and free[place] and place not in found:
                found.add(place)
                edge.append(place)
    return found


@settings(max_examples=60)
@given(st.integers(0, 2**32 - 1))
def test_free_space_never_leaks_through_a_thin_wall(seed):
    """Lines one pixel thin that touch only at corners: nothing behind them is seen free, whatever the heading."""
    rng = np.random.default_rng(seed)
    canvas = np.zeros((40, 50), dtype=np.uint8)
    ends = rng.integers(0, [50, 40], (5, 2, 2))
    for start, end in ends.tolist():
        cv2.line(canvas, start, end, 1)
    walls = canvas.astype(bool)
    places = np.argwhere(~walls)[rng.integers(0, int((~walls).sum()), 4)]
    xy = np.column_stack([places[:, 1], 39 - places[:, 0]]) + rng.uniform(0.01, 0.99, (4, 2))
    poses = np.column_stack([xy, rng.uniform(-math.pi, math.pi, 4)])
    readings = explore(Truth(walls, walls & False), poses, RangeSensor(max_range=30, half_angle=1.5))
    for k, (row, col) in enumerate(places.tolist()):
        inside = reachable(~walls, row, col)
        for looks in observe(readings[k : k + 1], Grid(walls.shape)):
            free = {divmod(int(cell), 50) for cell in looks.cell[looks.p_empty == 0.9]}
            assert all(place in inside or walls[place] for place in free)


def ahead_of(wall_at, cell_size=1, width=12, **sensor):
    """What a robot at the left end of a strip of 1 x 12 cells says of them, with a wall `wall_at` pixels away; None = unseen."""
    sensor = RangeSensor(max_range=11, half_angle=0.6, **sensor)
    shape = (cell_size, width * cell_size)
    readings = Readings([[0.5 * cell_size, 0.5 * cell_size, 0.0]], [[wall_at]], [0.0], sensor, shape)
    seen = looks_of(readings, Grid(shape, cell_size)).get(0, {})
    return [seen.get((0, col)) for col in range(width)]


def test_beyond_thickness_marks_the_wall_and_leaves_its_shadow_alone():
    assert ahead_of(3.5, wall_thickness=2) == [0.9] * 4 + [0.1] * 2 + [None] * 6


def test_beyond_hit_cell_marks_one_cell():
    assert ahead_of(3.5, beyond="hit_cell") == [0.9] * 4 + [0.1] + [None] * 7


def test_beyond_all_marks_the_whole_shadow():
    assert ahead_of(3.5, beyond="all") == [0.9] * 4 + [0.1] * 8


def test_no_return_frees_the_cone_to_its_end():
    assert ahead_of(np.inf) == [0.9] * 12


def test_mixed_cell_takes_the_share_in_front():
    """Cells of 3 x 3 pixels; the wall stands behind the first column of pixels of the third cell."""
    sensor = {"p_free": 0.9, "p_occupied": 0.1, "wall_thickness": 1.0}
    assert ahead_of(5.5, cell_size=3, **sensor)[:4] == pytest.approx([0.9, 0.9, 1 / 3, None])


def test_the_hit_cell_is_seen_however_coarse():
    """The hit lies at the near edge of a cell of 10 pixels, its centre 5 pixels behind: farther than a thin wall."""
    assert ahead_of(5.0, cell_size=10, wall_thickness=1.0)[1:3] == [0.1, None]


@given(st.integers(0, 9), st.floats(0.5, 0.99), st.floats(0.01, 0.45))
def test_inverse_sensor_model_is_the_clamped_share(n_front, p_free, p_occupied):
    p = inverse_sensor_model(n_front, 9, RangeSensor(p_free=p_free, p_occupied=p_occupied)).item()
    assert p == sorted([p_occupied, n_front / 9, p_free])[1]
