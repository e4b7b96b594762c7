"""read_drawing: every file is made here, and what it must show is known from how it was made."""

import os
import struct
import zlib
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from PIL import Image

from priorlab.core import files
from priorlab.interchange import images, pixels
from priorlab.interchange.images import read_drawing

GREY = np.array([[0, 40, 255, 255], [255, 128, 255, 0], [7, 255, 200, 255]], dtype=np.uint8)


def png_header(width: int, height: int) -> bytes:
    """The first bytes of a PNG that promises a size, and no pixels."""
    chunk = b"IHDR" + struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    end = b"IDAT"
    return (
        b"\x89PNG\r\n\x1a\n" + struct.pack(">I", 13) + chunk + struct.pack(">I", zlib.crc32(chunk))
        + struct.pack(">I", 0) + end + struct.pack(">I", zlib.crc32(end))
    )  # fmt: skip


@pytest.mark.parametrize("suffix", ["png", "bmp", "tif"])
def test_read_drawing_keeps_every_grey_value(tmp_path, suffix):
    path = tmp_path / f"flat.{suffix}"
    assert cv2.imwrite(str(path), GREY)
    drawing = read_drawing(path)
    np.testing.assert_array_equal(drawing.grey, GREY)
    assert (drawing.colour, drawing.metres_per_pixel, drawing.name, drawing.reduced_by) == (None, None, "flat", 1.0)


def test_read_drawing_jpeg_has_its_row_0_at_the_top(tmp_path):
    grey = np.full((64, 48), 255, np.uint8)
    grey[:16, :8] = 0
    Image.fromarray(grey).save(tmp_path / "a.jpg", quality=95)
    drawing = read_drawing(str(tmp_path / "a.jpg"), metres_per_pixel=0.05)
    assert drawing.shape == (64, 48) and drawing.metres_per_pixel == 0.05
    assert np.abs(drawing.grey.astype(int) - grey).max() < 16


def test_read_drawing_tells_content_not_suffix(tmp_path):
    (tmp_path / "really_a_png.jpg").write_bytes(cv2.imencode(".png", GREY)[1].tobytes())
    np.testing.assert_array_equal(read_drawing(tmp_path / "really_a_png.jpg").grey, GREY)


def test_read_drawing_composes_rgba_over_white(tmp_path):
    rgba = np.zeros((2, 3, 4), np.uint8)  # black ink ...
    rgba[..., 3] = [[255, 0, 128], [0, 51, 255]]  # ... of these opacities
    Image.fromarray(rgba).save(tmp_path / "a.png")
    assert read_drawing(tmp_path / "a.png").grey.tolist() == [[0, 255, 127], [255, 204, 0]]


def test_read_drawing_composes_grey_with_alpha_over_white(tmp_path):
    opacity = Image.fromarray(np.array([[255, 0], [0, 255]], np.uint8))
    Image.merge("LA", [Image.new("L", (2, 2), 0), opacity]).save(tmp_path / "a.png")
    assert read_drawing(tmp_path / "a.png").grey.tolist() == [[0, 255], [255, 0]]


@pytest.mark.parametrize("transparency", [1, b"\xff\x00"])
def test_read_drawing_composes_a_transparent_palette_over_white(tmp_path, transparency):
    image = Image.fromarray(np.array([[0, 1], [1, 0]], np.uint8)).convert("P")
    image.putpalette([0, 0, 0, 0, 0, 0])  # both colours black, the second one invisible
    image.save(tmp_path / "a.png", transparency=transparency)
    assert read_drawing(tmp_path / "a.png").grey.tolist() == [[0, 255], [255, 0]]


def test_read_drawing_composes_in_bands_what_it_composes_at_once(tmp_path, monkeypatch):
    rgba = np.random.default_rng(1).integers(0, 256, (23, 5, 4), dtype=np.uint8)
    Image.fromarray(rgba).save(tmp_path / "a.png")
    at_once = read_drawing(tmp_path / "a.png").colour
    monkeypatch.setattr(pixels, "_BAND", 4)
    np.testing.assert_array_equal(read_drawing(tmp_path / "a.png").colour, at_once)
    white = Image.new("RGBA", (5, 23), "white")
    white.alpha_composite(Image.fromarray(rgba))
    assert np.abs(np.asarray(white.convert("RGB")).astype(int) - at_once).max() <= 1


@pytest.mark.parametrize("suffix", ["png", "tif"])
def test_read_drawing_scales_16_bit_grey(tmp_path, suffix):
    deep = np.array([[0, 257, 32896], [65535, 40 * 257 + 100, 128]], np.uint16)
    assert cv2.imwrite(str(tmp_path / f"a.{suffix}"), deep)
    assert read_drawing(tmp_path / f"a.{suffix}").grey.tolist() == [[0, 1, 128], [255, 40, 0]]


def test_read_drawing_reads_16_bit_colour(tmp_path):
    deep = np.zeros((4, 4, 3), np.uint16)
    deep[..., 2] = 65535  # OpenCV's red
    deep[0] = 65535
    assert cv2.imwrite(str(tmp_path / "a.png"), deep)
    drawing = read_drawing(tmp_path / "a.png")
    assert drawing.colour[0, 0].tolist() == [255, 255, 255] and drawing.colour[1, 0].tolist() == [255, 0, 0]


def test_read_drawing_reads_1_bit(tmp_path):
    ink = np.array([[True, False, True], [False, False, True]])
    Image.fromarray(ink).save(tmp_path / "a.png")
    Image.fromarray(ink).save(tmp_path / "a.tif", compression="group4")
    assert read_drawing(tmp_path / "a.png").grey.tolist() == [[255, 0, 255], [0, 0, 255]]
    assert read_drawing(tmp_path / "a.tif").grey.tolist() == [[255, 0, 255], [0, 0, 255]]


def test_read_drawing_reads_cmyk(tmp_path):
    cmyk = Image.new("CMYK", (32, 32), (0, 0, 0, 0))
    cmyk.paste((0, 0, 0, 255), (0, 0, 32, 16))  # black on top, white paper below
    cmyk.save(tmp_path / "b.jpg", quality=95)
    cmyk.save(tmp_path / "b.tif")
    for name in ("b.tif", "b.jpg"):
        grey = read_drawing(tmp_path / name).grey
        assert grey[:15].max() < 8 and grey[17:].min() > 247, name


@pytest.mark.parametrize("suffix", ["jpg", "tif", "png"])
@pytest.mark.parametrize("orientation, turned", [(3, 2), (6, 3), (8, 1)])
def test_read_drawing_applies_the_cameras_rotation(tmp_path, suffix, orientation, turned):
    upright = np.full((32, 64), 255, np.uint8)
    upright[:16, :16] = 0
    as_stored = np.rot90(upright, -turned)  # the viewer has to turn it back
    exif = Image.Exif()
    exif[0x0112] = orientation
    Image.fromarray(np.ascontiguousarray(as_stored)).save(tmp_path / f"a.{suffix}", exif=exif)
    grey = read_drawing(tmp_path / f"a.{suffix}").grey
    np.testing.assert_array_equal(grey < 128, upright < 128)


def test_read_drawing_keeps_colours_only_when_there_are_some(tmp_path):
    rng = np.random.default_rng(0)
    grey = np.repeat(rng.integers(0, 256, (100, 100, 1), dtype=np.uint8), 3, axis=2)
    yellowed = (grey * np.array([1.0, 0.97, 0.9])).astype(np.uint8)
    green_line = grey.copy()
    green_line[50, 10:90] = (150, 230, 150)
    for name, image in (("grey", grey), ("yellowed", yellowed), ("line", green_line)):
        Image.fromarray(image).save(tmp_path / f"{name}.png")
    assert read_drawing(tmp_path / "grey.png").colour is None
    assert read_drawing(tmp_path / "yellowed.png").colour is None
    np.testing.assert_array_equal(read_drawing(tmp_path / "line.png").colour, green_line)
    np.testing.assert_array_equal(read_drawing(tmp_path / "grey.png").grey, grey[..., 0])


def test_read_drawing_reduces_large_images_by_averaging(tmp_path, monkeypatch):
    monkeypatch.setattr(images, "WORKING_PIXELS", 6)
    blocks = np.array([[0, 100, 200], [50, 150, 250]], np.uint8)
    fine = np.kron(blocks, np.ones((4, 4), np.uint8)).astype(np.int16)
    fine[::2] += 3
    fine[1::2] -= 3  # the mean of a block stays
    Image.fromarray(fine.clip(0, 255).astype(np.uint8)).save(tmp_path / "a.png")
    drawing = read_drawing(tmp_path / "a.png", metres_per_pixel=0.01)
    assert np.abs(drawing.grey.astype(int) - blocks).max() <= 2
    assert drawing.reduced_by == 4.0
    assert drawing.metres_per_pixel == pytest.approx(0.04)


def test_read_drawing_of_17_megapixels_is_reduced_below_16(tmp_path):
    grey = np.full((3400, 5000), 255, np.uint8)
    grey[1000:1100] = 0
    assert cv2.imwrite(str(tmp_path / "a.png"), grey, [cv2.IMWRITE_PNG_COMPRESSION, 1])
    drawing = read_drawing(tmp_path / "a.png")
    assert 15.9e6 < drawing.grey.size <= files.WORKING_PIXELS
    assert drawing.reduced_by == pytest.approx(5000 / drawing.shape[1]) and 1.03 < drawing.reduced_by < 1.04


def test_read_drawing_refuses_from_the_header_alone(tmp_path):
    (tmp_path / "a.png").write_bytes(png_header(20_000, 10_001))  # no pixels in it: only the header can have been read
    with pytest.raises(ValueError, match=r"at most 200 megapixels, got 20000 x 10001 = 200\.0 megapixels"):
        read_drawing(tmp_path / "a.png")


def test_read_drawing_leaves_pillows_limit_alone(tmp_path):
    before = Image.MAX_IMAGE_PIXELS
    (tmp_path / "a.png").write_bytes(png_header(14_000, 14_000))  # 196 megapixels: allowed here, a bomb to Pillow
    with pytest.raises(ValueError, match="whole image"):
        read_drawing(tmp_path / "a.png")
    assert Image.MAX_IMAGE_PIXELS == before is not None


@pytest.mark.parametrize("size", [(1, 1), (1, 50), (50, 1)])
def test_read_drawing_refuses_single_pixels(tmp_path, size):
    Image.new("L", size, 7).save(tmp_path / "a.png")
    with pytest.raises(ValueError, match=f"at least 2 x 2 pixels, got {size[0]} x {size[1]}"):
        read_drawing(tmp_path / "a.png")


@pytest.mark.parametrize("mode, value", [("L", 255), ("RGB", (10, 20, 200)), ("RGBA", (0, 0, 0, 0)), ("1", 0)])
def test_read_drawing_refuses_one_colour(tmp_path, mode, value):
    Image.new(mode, (30, 20), value).save(tmp_path / "a.png")
    with pytest.raises(ValueError, match="one colour"):
        read_drawing(tmp_path / "a.png")


def test_read_drawing_says_what_is_wrong_with_a_path(tmp_path):
    with pytest.raises(FileNotFoundError, match="found nothing at"):
        read_drawing(tmp_path / "missing.png")
    with pytest.raises(ValueError, match="got the folder"):
        read_drawing(tmp_path)
    (tmp_path / "empty.png").touch()
    with pytest.raises(ValueError, match="empty file"):
        read_drawing(tmp_path / "empty.png")
    (tmp_path / "text.png").write_text("a drawing, honestly\n" * 50)
    with pytest.raises(ValueError, match="something else"):
        read_drawing(tmp_path / "text.png")


def test_read_drawing_says_what_is_read_instead_of_vectors(tmp_path):
    (tmp_path / "a.pdf").write_bytes(b"%PDF-1.7\n...")
    (tmp_path / "b.png").write_bytes(b"%PDF-1.7\n...")
    (tmp_path / "c.dxf").write_text("0\nSECTION\n")
    for name, kind in (("a.pdf", "PDF"), ("b.png", "PDF"), ("c.dxf", "DXF")):
        with pytest.raises(ValueError, match=f"PNG, JPEG, BMP or TIFF.*got a {kind} file"):
            read_drawing(tmp_path / name)


def test_read_drawing_refuses_floating_point_pixels(tmp_path):
    assert cv2.imwrite(str(tmp_path / "a.tif"), GREY.astype(np.float32))
    with pytest.raises(ValueError, match="1, 8 or 16 bits"):
        read_drawing(tmp_path / "a.tif")


@pytest.mark.parametrize("scale", [0, -1, float("nan"), float("inf")])
def test_read_drawing_refuses_a_scale_that_is_none(tmp_path, scale):
    cv2.imwrite(str(tmp_path / "a.png"), GREY)
    with pytest.raises(ValueError, match="metres_per_pixel must be a finite number above 0"):
        read_drawing(tmp_path / "a.png", metres_per_pixel=scale)


@pytest.mark.parametrize("suffix", [".png", ".jpg", ".bmp", ".tif"])
def test_read_drawing_refuses_a_file_cut_in_half(tmp_path, suffix):
    noise = np.random.default_rng(0).integers(0, 256, (60, 60), dtype=np.uint8)
    whole = cv2.imencode(suffix, noise)[1].tobytes()
    (tmp_path / f"a{suffix}").write_bytes(whole[: len(whole) // 2])
    with pytest.raises(ValueError, match="must be a whole"):
        read_drawing(tmp_path / f"a{suffix}")


@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data(), suffix=st.sampled_from([".png", ".jpg", ".bmp", ".tif"]))
def test_read_drawing_of_a_damaged_file_is_a_drawing_or_a_sentence(tmp_path, data, suffix):
    noise = np.random.default_rng(0).integers(0, 256, (12, 12, 3), dtype=np.uint8)
    damaged = bytearray(cv2.imencode(suffix, noise)[1].tobytes())
    for _ in range(data.draw(st.integers(1, 4))):
        damaged[data.draw(st.integers(0, len(damaged) - 1))] = data.draw(st.integers(0, 255))
    path = tmp_path / f"a{suffix}"
    path.write_bytes(damaged[: data.draw(st.integers(0, len(damaged)))] if data.draw(st.booleans()) else damaged)
    try:
        drawing = read_drawing(path)
    except ValueError as sentence:
        assert "the drawing must" in str(sentence)
    else:
        assert drawing.grey.size >= 4


def test_read_drawing_reads_real_plans():
    folder = os.environ.get("PRIORLAB_REAL_DATA")
    if not folder:
        pytest.skip("PRIORLAB_REAL_DATA is not set")
    coloured = {"mlstruct_f302_crop0.png": True, "mlstruct_f302_fifth.png": True, "cvcfp_c13.png": False, "cvcfp_c3.png": False}
    for name, has_hues in coloured.items():
        drawing = read_drawing(Path(folder) / "plans_real" / name)
        assert (drawing.colour is not None) == has_hues, name
        assert np.ptp(drawing.grey) > 100  # the pale lines of one plan are no darker
