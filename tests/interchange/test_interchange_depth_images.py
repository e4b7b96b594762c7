"""Depth images as files: what goes out comes back, and each mistake has its sentence."""

import cv2
import numpy as np
import pytest
from PIL import Image

from priorlab.interchange.depth_images import read_depth_image, write_depth_image

RAMP = np.arange(480 * 640, dtype=np.uint32).reshape(480, 640) % 3001


def saved(folder, pixels, name="depth.png"):
    """Written by Pillow or OpenCV, not by what is tested."""
    path = folder / name
    if name.endswith(".tif"):
        Image.fromarray(pixels).save(path)
    else:
        assert cv2.imwrite(str(path), pixels)
    return path


@pytest.mark.parametrize("name", ["depth.png", "depth.tif"])
def test_read_depth_image_keeps_every_millimetre(tmp_path, name):
    image = read_depth_image(saved(tmp_path, RAMP.astype(np.uint16), name))
    assert image.dtype == np.uint16 and np.array_equal(image, RAMP)


def test_written_depth_image_is_read_by_others(tmp_path):
    write_depth_image(tmp_path / "depth.png", RAMP)
    raw = cv2.imread(str(tmp_path / "depth.png"), cv2.IMREAD_UNCHANGED)
    assert raw.dtype == np.uint16 and np.array_equal(raw, RAMP)


def test_read_depth_image_of_another_camera(tmp_path):
    path = saved(tmp_path, np.full((240, 320), 1234, np.uint16))
    assert read_depth_image(path, shape=(240, 320)).max() == 1234
    with pytest.raises(ValueError, match="must have 480 rows of 640 pixels, got 240 of 320"):
        read_depth_image(path)


@pytest.mark.parametrize(
    ("pixels", "sentence"),
    [
        (np.full((480, 640), 200, np.uint8), "must hold 16-bit grey values, whole millimetres, got 8 bits"),
        (np.full((480, 640, 3), 200, np.uint8), r"got colours \(RGB\)"),
        (np.zeros((480, 640), np.uint16), "must hold at least one depth, got only zeros"),
        (np.full((480, 640), 2, np.uint16), "must hold millimetres, got at most 2, which look like metres"),
        (np.full((640, 480), 2000, np.uint16), "must have 480 rows of 640 pixels, got 640 of 480"),
    ],
)
def test_read_depth_image_says_what_is_wrong(tmp_path, pixels, sentence):
    with pytest.raises(ValueError, match=sentence):
        read_depth_image(saved(tmp_path, pixels))


def test_read_depth_image_refuses_metres_with_fractions(tmp_path):
    with pytest.raises(ValueError, match="got 32-bit fractions"):
        read_depth_image(saved(tmp_path, np.full((480, 640), 2.5, np.float32), "metres.tif"))


def test_read_depth_image_refuses_what_is_no_file_and_no_image(tmp_path):
    with pytest.raises(FileNotFoundError, match="the depth image must be a file, found nothing at"):
        read_depth_image(tmp_path / "none.png")
    (tmp_path / "words.png").write_text("two metres")
    with pytest.raises(ValueError, match="the depth image must be a whole PNG or TIFF image"):
        read_depth_image(tmp_path / "words.png")


@pytest.mark.parametrize(
    ("pixels", "sentence"),
    [
        (np.full((4, 5), 2.0), "a 2-D array of whole millimetres, got float64"),
        (np.full((4, 5), 70_000), "millimetres from 0 to 65535, got 70000 to 70000"),
        (np.full(5, 2000), r"got int64 of shape \(5,\)"),
        (np.full((4, 5), 3), "which look like metres: an array"),
    ],
)
def test_write_depth_image_says_what_is_wrong(tmp_path, pixels, sentence):
    with pytest.raises(ValueError, match=sentence):
        write_depth_image(tmp_path / "depth.png", pixels)
    assert not list(tmp_path.iterdir())


def test_an_image_from_a_file_becomes_a_reading(tmp_path):
    """A wall 1.5 m ahead, saved and read: a hit at 60 pixels of 2.5 cm in the middle, farther at the edges."""
    from priorlab.robot.depth_camera import DepthCamera
    from priorlab.robot.strip import readings_from_scans, strip_ranges

    image = read_depth_image(saved(tmp_path, np.full((480, 640), 1500, np.uint16)))
    readings = readings_from_scans([strip_ranges(image)], [[5.0, 50.0, 0.0]], DepthCamera(), (100, 100), 0.025)
    assert readings.ranges[0, 320] == pytest.approx(60.0, abs=1e-3)
    assert readings.ranges[0, [0, 639]] == pytest.approx([60 / 0.875, 60 / 0.875], rel=1e-3)  # cos(29 degrees) = 0.875
