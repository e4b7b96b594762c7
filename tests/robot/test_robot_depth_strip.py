"""From image to ranges: the mean by hand, zeros left out, and the way into the map."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from priorlab.core.grid import Grid
from priorlab.mapping.evidence import gather_evidence
from priorlab.robot.depth_camera import DepthCamera
from priorlab.robot.depth_noise import DepthNoise, disturb_depth, draw_faults, in_millimetres
from priorlab.robot.strip import readings_from_scans, strip_ranges

TINY = DepthCamera(rows=4, columns=2, field_of_view=math.pi / 2, strip_rows=2)  # bearings +- atan(1/2), cos = 2 / sqrt(5)


def test_strip_ranges_by_hand():
    image = np.array([[9999, 9999], [1000, 3000], [2000, 0], [9999, 9999]])
    ranges, valid = strip_ranges(image, TINY)
    assert ranges.tolist() == pytest.approx([1.5 * math.sqrt(5) / 2, 3.0 * math.sqrt(5) / 2])
    assert valid.all()


def test_strip_ranges_column_of_zeros_is_no_reading():
    ranges, valid = strip_ranges(np.array([[500, 500], [0, 700], [0, 700], [500, 500]]), TINY)
    assert valid.tolist() == [False, True] and ranges[0] == math.inf


def test_strip_ranges_looks_only_at_the_strip():
    image = np.full((480, 640), 1500)
    for row in (0, 5, 460):
        other = image.copy()
        other[row : row + 20] = 700
        camera = DepthCamera(strip_row=row)
        assert strip_ranges(other, camera).ranges_m == pytest.approx(0.7 / np.cos(camera.bearings))
        assert strip_ranges(other, DepthCamera()).ranges_m == pytest.approx(1.5 / np.cos(camera.bearings))


@given(st.integers(0, 10_000))
def test_strip_ranges_equals_a_loop(seed):
    rng = np.random.default_rng(seed)
    camera = DepthCamera(rows=6, columns=5, strip_rows=3, strip_row=2)
    image = rng.integers(400, 3000, (6, 5)) * (rng.random((6, 5)) < 0.5)
    image[0, 0] = 2000
    ranges, valid = strip_ranges(image, camera)
    for column in range(5):
        depths = [int(image[row, column]) for row in (2, 3, 4) if image[row, column] > 0]
        assert bool(valid[column]) == bool(depths)
        if depths:
            across = (column - 2) / 2.5 * math.tan(math.radians(29))  # sideways at a depth of 1: Pythagoras, no cosine
            assert ranges[column] == pytest.approx(sum(depths) / len(depths) / 1000 * math.hypot(1, across))


@pytest.mark.parametrize(
    ("image", "sentence"),
    [
        (np.zeros((640, 480), int), r"must have 480 x 640 pixels, got shape \(640, 480\)"),
        (np.zeros((480, 640)), "must hold whole millimetres, got float64: multiply metres by 1000 and round"),
        (np.full((480, 640), -1), "millimetres of at least 0, got -1"),
        (np.full((480, 640), 3), "got at most 3, which look like metres"),
    ],
)
def test_strip_ranges_says_what_is_wrong(image, sentence):
    with pytest.raises(ValueError, match=sentence):
        strip_ranges(image)


def test_columns_without_a_reading_give_no_evidence():
    """The left half of the image is lost: nothing is learned left of the axis, neither free nor wall."""
    camera = DepthCamera()
    image = np.full((480, 640), 1000, np.uint16)
    image[:, :320] = 0
    readings = readings_from_scans([strip_ranges(image, camera)], [[5.5, 30.0, 0.0]], camera, (60, 60), 0.05)
    looks = gather_evidence(readings, Grid((60, 60))).looks
    assert looks[31:].sum() > 50 and looks[:30].sum() == 0


def test_readings_from_scans_are_in_pixels():
    scan = strip_ranges(np.full((480, 640), 1500, np.uint16))
    readings = readings_from_scans([scan, scan], [[5.0, 5.0, 0.0], [6.0, 5.0, 1.0]], DepthCamera(), (10, 10), 0.025)
    assert readings.ranges[:, 320] == pytest.approx([60.0, 60.0], rel=1e-5) and readings.sensor.max_range == 120
    with pytest.raises(ValueError, match="scans and poses must be as many, got 1 and 2"):
        readings_from_scans([scan], [[5.0, 5.0, 0.0], [6.0, 5.0, 1.0]], DepthCamera(), (10, 10), 0.025)


def noisy(depth_m, seed=0, **faults):
    none = {"deviation_at_1m": 0.0, "common_at_1m": 0.0, "hole_rate": 0.0}
    flat = np.full((480, 640), float(depth_m))
    return disturb_depth(flat, DepthNoise(**(none | faults)), draw_faults(np.random.default_rng(seed), flat.shape))


@pytest.mark.parametrize("depth", [1.0, 2.0, 3.0])
def test_noise_grows_with_the_square_of_depth(depth):
    assert noisy(depth, deviation_at_1m=0.0014).std() == pytest.approx(0.0014 * depth**2, rel=0.02)


def test_common_noise_stays_in_the_mean_of_the_strip():
    pixels, common = noisy(2.0, deviation_at_1m=0.01), noisy(2.0, common_at_1m=0.01)
    assert pixels[230:250].mean(axis=0).std() == pytest.approx(0.04 / math.sqrt(20), rel=0.1)
    assert common[230:250].mean(axis=0).std() == pytest.approx(0.04, rel=0.5)
    assert np.ptp(common, axis=0).max() == 0


def test_holes_take_their_share_in_patches():
    shares = [np.isinf(noisy(2.0, seed, hole_rate=0.2)).mean() for seed in range(20)]
    assert np.mean(shares) == pytest.approx(0.2, abs=0.02)
    lost = np.isinf(noisy(2.0, hole_rate=0.2))
    borders = (lost[:, 1:] != lost[:, :-1]).mean()
    assert 0 < borders < 0.4 / 32 * 1.5  # two borders in 32 columns at most


def test_holes_grow_when_the_rate_grows():
    few, many = (np.isinf(noisy(2.0, hole_rate=rate)) for rate in (0.1, 0.3))
    assert (many >= few).all() and many.sum() > few.sum() > 0


def test_nothing_measured_stays_nothing():
    assert np.isinf(noisy(math.inf, deviation_at_1m=0.01, common_at_1m=0.01)).all()


def test_in_millimetres_never_overflows():
    assert in_millimetres(np.array([[70.0, 65.0]]), 0.4, 100.0).tolist() == [[0, 65_000]]


@pytest.mark.parametrize(
    ("faults", "sentence"),
    [
        ({"deviation_at_1m": -1}, "deviation_at_1m must be a finite number of at least 0, got -1"),
        ({"common_at_1m": math.nan}, "common_at_1m must be a finite number of at least 0, got nan"),
        ({"hole_rate": 1.5}, "hole_rate must lie between 0 and 1, got 1.5"),
        ({"hole_side": 0}, "hole_side must be a whole number of at least 1, got 0"),
    ],
)
def test_depth_noise_says_what_is_wrong(faults, sentence):
    with pytest.raises(ValueError, match=sentence):
        DepthNoise(**faults)
