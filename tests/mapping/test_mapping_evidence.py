"""Evidence against sums that are made one reading at a time."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from priorlab.core.grid import Grid
from priorlab.core.readings import Readings
from priorlab.core.sensor import RangeSensor
from priorlab.mapping.evidence import gather_evidence
from priorlab.robot.inverse_sensor_model import observe

seeds = st.integers(0, 2**32 - 1)
cell_sizes = st.sampled_from([1, 2, 3, 2.5])


@given(seeds, cell_sizes)
def test_gather_evidence_sums_what_each_reading_says(small_survey, seed, cell_size):
    _, readings = small_survey(seed)
    grid = Grid(readings.image_shape, cell_size)
    total, looks = np.zeros(grid.shape), np.zeros(grid.shape, dtype=int)
    for k in range(len(readings)):
        for found in observe(readings[k : k + 1], grid):
            for cell, p in zip(found.cell, found.p_empty, strict=True):
                total.flat[cell] += math.log(p) - math.log1p(-p)
                looks.flat[cell] += 1
    evidence = gather_evidence(readings, grid)
    np.testing.assert_allclose(evidence.total, total, atol=1e-10)
    assert (evidence.looks == looks).all() and evidence.sensor == readings.sensor


@given(seeds, cell_sizes)
def test_the_order_of_readings_does_not_matter(small_survey, seed, cell_size):
    _, readings = small_survey(seed)
    grid = Grid(readings.image_shape, cell_size)
    shuffled = readings[np.random.default_rng(seed).permutation(len(readings))]
    one, two = gather_evidence(readings, grid), gather_evidence(shuffled, grid)
    np.testing.assert_allclose(one.total, two.total, atol=1e-10)
    assert (one.looks == two.looks).all()


@given(seeds, st.integers(0, 8))
def test_evidence_of_parts_adds_up_and_comes_off_again(small_survey, seed, cut):
    _, readings = small_survey(seed)
    grid = Grid(readings.image_shape, 2)
    whole, early, late = (gather_evidence(part, grid) for part in (readings, readings[:cut], readings[cut:]))
    np.testing.assert_allclose((early + late).total, whole.total, atol=1e-10)
    np.testing.assert_allclose((whole - late).total, early.total, atol=1e-10)
    assert ((early + late).looks == whole.looks).all() and ((whole - late).looks == early.looks).all()


def test_the_same_reading_twice_counts_twice(small_survey):
    _, readings = small_survey(1)
    grid = Grid(readings.image_shape)
    once, twice = gather_evidence(readings, grid), gather_evidence(readings[np.tile(np.arange(8), 2)], grid)
    np.testing.assert_allclose(twice.total, 2 * once.total)
    assert (twice.looks == 2 * once.looks).all()


def test_looks_do_not_grow_with_the_cell_size():
    """A cell counts when its centre is in the cone, so the mean number of looks is that of the pixels."""
    sensor = RangeSensor(max_range=40)
    y, x = np.mgrid[60:240:9, 60:240:11].reshape(2, -1)
    poses = np.column_stack([x + 0.5, y + 0.5, np.arange(len(x)) % 4 * np.pi / 2])
    bearings = np.linspace(-sensor.half_angle, sensor.half_angle, 43)
    readings = Readings(poses, np.full((len(poses), 43), np.inf), bearings, sensor, (300, 300))
    looks = [gather_evidence(readings, Grid((300, 300), size)).looks[:].sum() * size**2 for size in (1, 2, 3, 5, 10)]
    np.testing.assert_allclose(looks, looks[0], rtol=0.03)


def test_no_readings_are_no_evidence(small_survey):
    _, readings = small_survey(0)
    evidence = gather_evidence(readings[:0], Grid(readings.image_shape))
    assert not evidence.total.any() and not evidence.looks.any()


@pytest.mark.parametrize(
    ("pose", "image_shape", "sentence"),
    [
        ([1, 1, 0], (5, 8), r"readings and grid must have one image shape, got \(5, 8\) and \(5, 9\)"),
        ([9, 1, 0], (5, 9), "poses must lie on the map of 9 x 5 pixels, got x, y = 9, 1 in row 0"),
    ],
)
def test_gather_evidence_says_what_is_wrong(pose, image_shape, sentence):
    readings = Readings([pose], [[3.0]], [0.0], RangeSensor(), image_shape)
    with pytest.raises(ValueError, match=sentence):
        gather_evidence(readings, Grid((5, 9)))
