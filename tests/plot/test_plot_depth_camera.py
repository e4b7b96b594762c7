"""A depth image shows near as dark, far as light, nothing in its own colour; ranges lie where the arithmetic puts them."""

import matplotlib.pyplot as plt
import numpy as np
import pytest

import priorlab as pl
from priorlab.plot.depth_camera import NOTHING, depth_picture
from priorlab.robot.depth_camera import DepthCamera


@pytest.fixture(autouse=True)
def close():
    yield
    plt.close("all")


def test_depth_picture_near_is_dark_far_is_light_nothing_is_blue():
    picture = depth_picture(np.array([[400, 1700, 3000, 0]]), DepthCamera())
    near, middle, far = (int(picture[0, column, 0]) for column in range(3))
    assert (near, far) == (30, 245) and abs(middle - 137.5) <= 1 and (picture[0, :3] == picture[0, :3, :1]).all()
    assert tuple(picture[0, 3]) == NOTHING


def test_depth_image_frames_the_strip():
    camera = DepthCamera(strip_row=100)
    ax = pl.plot.depth_image(np.full((480, 640), 1000), camera)
    (frame,) = ax.patches
    assert (frame.get_y() + 0.5, frame.get_height(), frame.get_width()) == (100, 20, 640)
    assert "nothing measured" in ax.get_title()


def test_strip_ranges_draws_range_over_depth_and_leaves_gaps():
    camera = DepthCamera(rows=2, columns=3, strip_rows=2)
    ax = pl.plot.strip_ranges([1.5, np.inf, 2.0], camera, true_m=[1.4, 1.4, 2.0])
    true, ranges, depth = (line.get_ydata() for line in ax.lines)
    assert np.isnan(ranges[1]) and ranges[[0, 2]].tolist() == [1.5, 2.0] and true.tolist() == [1.4, 1.4, 2.0]
    assert depth[2] == pytest.approx(2.0 * np.cos(camera.bearings[2]))
    left, right = ax.get_xlim()
    assert left > right  # the left of the image is at the left
