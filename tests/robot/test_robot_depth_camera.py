"""The camera's geometry against numbers worked out by hand, and what its record refuses."""

import math

import numpy as np
import pytest

from priorlab.robot.depth_camera import DepthCamera


def test_the_kinect_of_the_thesis():
    camera = DepthCamera()
    assert camera.shape == (480, 640) and camera.strip == slice(230, 250)
    assert (camera.min_depth_m, camera.max_depth_m) == (0.4, 3.0)
    assert camera.focal_length == pytest.approx(320 / 0.5543090515)  # tan of 29 degrees


def test_bearings_lie_inside_the_field_of_view_and_grow_to_the_left():
    degrees = np.degrees(DepthCamera().bearings)
    assert (np.diff(degrees) < 0).all()
    assert degrees[0] == pytest.approx(-degrees[-1]) and 28.9 < degrees[0] < 29.0


def test_bearings_are_not_evenly_spread():
    """A pinhole: columns in the middle of the image span more than those at its edge."""
    step = np.abs(np.diff(DepthCamera().bearings))
    assert step[319] == pytest.approx(1 / DepthCamera().focal_length, rel=1e-5)  # d atan(u) = du at u = 0
    assert step[0] == pytest.approx(step[319] * math.cos(math.radians(29)) ** 2, rel=0.01)


def test_columns_and_rows_share_the_focal_length():
    camera = DepthCamera(rows=4, columns=6, field_of_view=math.pi / 2, strip_rows=2)
    assert camera.focal_length == pytest.approx(3.0)
    assert (camera.right_of_axis * 3).tolist() == pytest.approx([-2.5, -1.5, -0.5, 0.5, 1.5, 2.5])
    assert (camera.below_axis * 3).tolist() == pytest.approx([-1.5, -0.5, 0.5, 1.5])
    assert camera.strip == slice(1, 3)


def test_range_sensor_is_the_same_cone_in_pixels():
    sensor = DepthCamera().range_sensor(0.025, wall_thickness=2, p_free=0.8, p_occupied=0.2)
    assert (sensor.max_range, sensor.wall_thickness, sensor.p_free, sensor.p_occupied) == (120, 2, 0.8, 0.2)
    assert sensor.half_angle == pytest.approx(math.radians(29))  # HALF of 58


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"rows": 0}, "rows must be a whole number of at least 1, got 0"),
        ({"columns": 2.5}, "columns must be a whole number of at least 1, got 2.5"),
        ({"field_of_view": math.pi}, "field_of_view must lie strictly between 0 and pi"),
        ({"min_depth_m": 3.0}, r"min_depth_m must lie in \[0, max_depth_m\), got 3"),
        ({"height_m": 0}, "height_m must be a finite number above 0, got 0"),
        ({"strip_row": 461}, "rows 0 to 479, got rows 461 to 480"),
        ({"strip_row": -1}, "got rows -1 to 18"),
        ({"strip_rows": 481}, "got rows 0 to 480"),
    ],
)
def test_depth_camera_says_what_is_wrong(given, sentence):
    with pytest.raises(ValueError, match=sentence):
        DepthCamera(**given)
