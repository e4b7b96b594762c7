"""ROS maps: what is written is loaded by a slow reader that follows nav2's rules and shares nothing with ours."""

import re

import cv2
import numpy as np
import pytest
import yaml
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from priorlab.core.drawing import Walls
from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.log_odds import log_odds
from priorlab.interchange.ros_map import read_ros_map, write_ros_map


def load_like_nav2(path) -> list[list[int]]:
    """Rows of occupancy, BOTTOM row first, from the yaml and a binary pgm, pixel by pixel."""
    about = yaml.safe_load(path.read_text())
    raw = (path.parent / about["image"]).read_bytes()
    header = re.match(rb"P5\s+(?:#[^\n]*\n)?(\d+)\s+(\d+)\s+255\s", raw)
    width, height = int(header[1]), int(header[2])
    body = raw[header.end() :]
    rows = []
    for y in range(height):
        row = []
        for x in range(width):
            grey = body[width * (height - 1 - y) + x]
            occ = grey / 255 if about["negate"] else 1 - grey / 255
            if about["mode"] == "raw":
                row.append(grey if grey <= 100 else -1)
            elif occ > about["occupied_thresh"]:
                row.append(100)
            elif occ < about["free_thresh"]:
                row.append(0)
            elif about["mode"] == "trinary":
                row.append(-1)
            else:
                row.append(round(100 * (occ - about["free_thresh"]) / (about["occupied_thresh"] - about["free_thresh"])))
        rows.append(row)
    return rows


def some_map(p_empty, cell_size=2, metres_per_pixel=0.025) -> GridMap:
    p_empty = np.asarray(p_empty, dtype=float)
    rows, cols = p_empty.shape
    return GridMap(log_odds(p_empty), Grid((rows * cell_size, cols * cell_size), cell_size, metres_per_pixel))


P_EMPTY = [[0.9, 0.9, 0.1], [0.5, 0.85, 0.3]]


def test_write_ros_map_trinary_writes_0_205_254_and_the_yaml_of_the_field(tmp_path):
    turned = write_ros_map(tmp_path / "turned.yaml", some_map(P_EMPTY), origin=(1, -2, 0.5))
    assert read_ros_map(turned).origin == (1, -2, 0.5)
    path = write_ros_map(tmp_path / "flat.yaml", some_map(P_EMPTY), origin=(1, -2, 0))
    assert yaml.safe_load(path.read_text()) == {
        "image": "flat.pgm", "mode": "trinary", "resolution": 0.05, "origin": [1.0, -2.0, 0.0],
        "negate": 0, "occupied_thresh": 0.65, "free_thresh": 0.196,
    }  # fmt: skip
    image = cv2.imread(str(tmp_path / "flat.pgm"), cv2.IMREAD_UNCHANGED)
    assert image.tolist() == [[254, 254, 0], [205, 254, 0]]
    assert load_like_nav2(path) == [[-1, 0, 100], [0, 0, 100]]  # the bottom row first


@pytest.mark.parametrize("mode", ["trinary", "scale", "raw"])
@pytest.mark.parametrize("image_format", ["pgm", "png", "bmp"])
def test_read_ros_map_loads_what_was_written(tmp_path, mode, image_format):
    path = write_ros_map(tmp_path / "flat.yaml", some_map(P_EMPTY), mode, image_format=image_format)
    ros = read_ros_map(path)
    expected = {
        "trinary": [[0, 0, 100], [-1, 0, 100]],
        "scale": [[10, 10, 90], [50, 15, 70]],
        "raw": [[10, 10, 90], [50, 15, 70]],
    }[mode]
    assert ros.occupancy.tolist() == expected
    assert ros.data.tolist() == [*expected[1], *expected[0]]
    assert (ros.grid.scale, ros.mode, ros.origin) == (0.05, mode, (0, 0, 0))
    assert "3 x 2 cells of 0.05 m" in repr(ros)


@settings(max_examples=40, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    percents=st.lists(st.lists(st.integers(1, 99), min_size=3, max_size=3), min_size=2, max_size=5),
    mode=st.sampled_from(["scale", "raw"]),
)
def test_ros_map_round_trip_keeps_every_percent(tmp_path, percents, mode):
    p_empty = np.array(percents) / 100
    path = write_ros_map(tmp_path / "a.yaml", some_map(p_empty), mode, force=True)
    again = read_ros_map(path)
    np.testing.assert_allclose(again.p_empty, p_empty, atol=1e-12)
    np.testing.assert_allclose(again.to_map().p_empty, p_empty, atol=1e-12)
    assert again.data.reshape(p_empty.shape).tolist() == load_like_nav2(path)


@pytest.mark.parametrize("suffix", ["pgm", "png", "bmp"])
@pytest.mark.parametrize("negate", [0, 1])
def test_read_ros_map_reads_the_usual_images(tmp_path, suffix, negate):
    grey = np.array([[0, 254], [205, 255]], np.uint8)
    cv2.imwrite(str(tmp_path / f"m.{suffix}"), 255 - grey if negate else grey)
    (tmp_path / "m.yaml").write_text(
        f"image: m.{suffix}\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: {negate}\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
    )
    assert read_ros_map(tmp_path / "m.yaml").occupancy.tolist() == [[100, 0], [-1, 0]]


def test_read_ros_map_calls_transparent_cells_unknown_in_scale_mode(tmp_path):
    bgra = np.zeros((1, 3, 4), np.uint8)
    bgra[0, :, 3] = [255, 0, 254]
    cv2.imwrite(str(tmp_path / "m.png"), bgra)
    (tmp_path / "m.yaml").write_text(
        "image: m.png\nmode: scale\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
    )
    assert read_ros_map(tmp_path / "m.yaml").occupancy.tolist() == [[100, -1, -1]]


def test_read_ros_map_averages_alpha_in_trinary_mode_as_nav2_does(tmp_path):
    bgra = np.full((1, 2, 4), 255, np.uint8)
    bgra[0, 0, :3] = 0  # opaque black: (0 + 0 + 0 + 255) / 4, occupied 0.75
    bgra[0, 1, :3] = 200  # (600 + 255) / 4 = 213.75, occupied 0.162: free, and unknown without alpha
    cv2.imwrite(str(tmp_path / "m.png"), bgra)
    (tmp_path / "m.yaml").write_text(
        "image: m.png\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
    )
    assert read_ros_map(tmp_path / "m.yaml").occupancy.tolist() == [[100, 0]]


def test_to_prior_map_asks_for_a_prior(tmp_path):
    path = write_ros_map(tmp_path / "flat.yaml", some_map(P_EMPTY))
    with pytest.raises(ValueError, match="prior must be a Prior, got float"):
        read_ros_map(path).to_prior_map(0.3)


def test_read_ros_map_finds_the_image_relative_to_the_yaml(tmp_path, monkeypatch):
    (tmp_path / "maps" / "images").mkdir(parents=True)
    cv2.imwrite(str(tmp_path / "maps" / "images" / "m.pgm"), np.array([[0, 254]], np.uint8))
    (tmp_path / "maps" / "m.yaml").write_text(
        "image: images/m.pgm\nresolution: 0.1\norigin: [0, 0, 0]\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
    )
    monkeypatch.chdir(tmp_path)
    assert read_ros_map("maps/m.yaml").occupancy.tolist() == [[100, 0]]


@pytest.mark.parametrize("image", ["../m.pgm", "images/../../m.pgm", "/m.pgm"])
def test_read_ros_map_opens_no_image_outside_the_yamls_folder(tmp_path, image):
    (tmp_path / "maps").mkdir()
    cv2.imwrite(str(tmp_path / "m.pgm"), np.array([[0, 254]], np.uint8))
    (tmp_path / "maps" / "m.yaml").write_text(yaml.safe_dump(GOOD | dict(image=image)))
    with pytest.raises(ValueError, match=f"image must lie in the folder of its yaml, or below, got '{image}'"):
        read_ros_map(tmp_path / "maps" / "m.yaml")


def place_map(folder):
    """A yaml and its image in a new folder."""
    folder.mkdir(parents=True)
    cv2.imwrite(str(folder / "m.pgm"), np.array([[0, 254]], np.uint8))
    (folder / "m.yaml").write_text(yaml.safe_dump(GOOD | dict(image="m.pgm")))


@pytest.mark.parametrize("linked", ["m.pgm", "images"])
def test_read_ros_map_follows_no_link_out_of_the_yamls_folder(tmp_path, linked):
    place_map(tmp_path / "elsewhere" / "images")
    (tmp_path / "maps").mkdir()
    targets = {"m.pgm": "images/m.pgm", "images": "images"}
    (tmp_path / "maps" / linked).symlink_to(tmp_path / "elsewhere" / targets[linked])
    (tmp_path / "maps" / "m.yaml").write_text(
        yaml.safe_dump(GOOD | dict(image={"m.pgm": "m.pgm", "images": "images/m.pgm"}[linked]))
    )
    with pytest.raises(ValueError, match="image must lie in the folder of its yaml, or below"):
        read_ros_map(tmp_path / "maps" / "m.yaml")


@pytest.mark.parametrize("links", [["m.yaml"], ["m.yaml", "m.pgm"], ["folder"]])
def test_read_ros_map_takes_a_yaml_that_is_reached_by_a_link(tmp_path, links):
    """An installed workspace: the yaml, or it and its image, or the whole folder are links to the sources."""
    place_map(tmp_path / "sources")
    if links == ["folder"]:
        (tmp_path / "installed").symlink_to(tmp_path / "sources")
    else:
        (tmp_path / "installed").mkdir()
        for name in links:
            (tmp_path / "installed" / name).symlink_to(tmp_path / "sources" / name)
    assert read_ros_map(tmp_path / "installed" / "m.yaml").occupancy.tolist() == [[100, 0]]


def test_read_ros_map_prefers_the_image_beside_the_link(tmp_path):
    place_map(tmp_path / "sources")
    (tmp_path / "installed").mkdir()
    (tmp_path / "installed" / "m.yaml").symlink_to(tmp_path / "sources" / "m.yaml")
    cv2.imwrite(str(tmp_path / "installed" / "m.pgm"), np.array([[254, 0]], np.uint8))
    assert read_ros_map(tmp_path / "installed" / "m.yaml").occupancy.tolist() == [[0, 100]]


def test_read_ros_map_tells_a_link_that_leads_to_itself(tmp_path):
    place_map(tmp_path / "maps")
    (tmp_path / "maps" / "m.pgm").unlink()
    (tmp_path / "maps" / "m.pgm").symlink_to(tmp_path / "maps" / "m.pgm")
    with pytest.raises(FileNotFoundError, match="the map's image must be a file, found nothing"):
        read_ros_map(tmp_path / "maps" / "m.yaml")


def test_read_ros_map_takes_the_whole_path_of_an_image_beside_the_yaml(tmp_path):
    cv2.imwrite(str(tmp_path / "m.pgm"), np.array([[0, 254]], np.uint8))
    (tmp_path / "m.yaml").write_text(yaml.safe_dump(GOOD | dict(image=str(tmp_path / "m.pgm"))))
    assert read_ros_map(tmp_path / "m.yaml").occupancy.tolist() == [[100, 0]]


def test_read_ros_map_says_when_a_picture_is_called_raw(tmp_path):
    cv2.imwrite(str(tmp_path / "m.pgm"), np.array([[0, 254], [205, 254]], np.uint8))
    (tmp_path / "m.yaml").write_text(yaml.safe_dump(GOOD | dict(mode="raw")))
    with pytest.raises(ValueError, match="raw must hold percents of 0 to 100, or 255 for unknown, got 254 and the like in 75 %"):
        read_ros_map(tmp_path / "m.yaml")
    cv2.imwrite(str(tmp_path / "m.pgm"), np.array([[0, 100], [50, 255]], np.uint8))
    assert read_ros_map(tmp_path / "m.yaml").occupancy.tolist() == [[0, 100], [50, -1]]


def test_read_ros_map_warns_when_unknown_becomes_free(tmp_path):
    cv2.imwrite(str(tmp_path / "m.pgm"), np.array([[0, 254], [205, 205]], np.uint8))
    (tmp_path / "m.yaml").write_text(yaml.safe_dump(GOOD | dict(free_thresh=0.25)))
    with pytest.warns(UserWarning, match="free_thresh 0.25 makes 2 cells of grey 205 free"):
        assert read_ros_map(tmp_path / "m.yaml").occupancy.tolist() == [[100, 0], [0, 0]]  # as nav2 does


def test_to_prior_map_believes_no_cell_more_than_the_prior(tmp_path):
    path = write_ros_map(tmp_path / "a.yaml", some_map(P_EMPTY))
    prior_map = read_ros_map(path).to_prior_map(Prior(0.3, 0.8))
    assert prior_map.p_empty.round(6).tolist() == [[0.72, 0.72, 0.27], [0.5, 0.72, 0.27]]
    assert prior_map.prior == Prior(0.3, 0.8)


def test_write_ros_map_warns_when_all_space_becomes_unknown(tmp_path):
    prior = Prior(0.3, 0.8)  # Table 6.1: effective 0.72
    table_6_1 = some_map([[prior.effective_p_wall, prior.effective_p_space], [prior.effective_p_space] * 2])
    with pytest.warns(UserWarning, match=r"P\(empty\) = 0\.804: 100 % of the space becomes unknown"):
        path = write_ros_map(tmp_path / "a.yaml", table_6_1)
    assert read_ros_map(path).occupancy.tolist() == [[100, -1], [-1, -1]]
    scaled = write_ros_map(tmp_path / "b.yaml", table_6_1, mode="scale")  # and no warning, or it were an error
    assert read_ros_map(scaled).occupancy.tolist() == [[73, 28], [28, 28]]


def test_write_ros_map_of_extracted_walls_is_certain(tmp_path):
    walls = Walls(np.array([[1, 0, 0], [1, 1, 0]], np.uint8), metres_per_pixel=0.02)
    ros = read_ros_map(write_ros_map(tmp_path / "walls.yaml", walls))
    assert ros.occupancy.tolist() == [[100, 0, 0], [100, 100, 0]] and ros.grid.scale == 0.02
    assert ros.to_map(least=0.1).p_empty.round(6).tolist() == [[0.1, 0.9, 0.9], [0.1, 0.1, 0.9]]


def test_write_ros_map_overwrites_nothing_without_force(tmp_path):
    write_ros_map(tmp_path / "a.yaml", some_map(P_EMPTY))
    (tmp_path / "a.yaml").unlink()
    with pytest.raises(FileExistsError, match=r"a\.pgm exists already"):
        write_ros_map(tmp_path / "a.yaml", some_map(P_EMPTY))
    assert not (tmp_path / "a.yaml").exists()
    assert write_ros_map(tmp_path / "a.yaml", some_map(P_EMPTY), force=True).exists()


def test_write_ros_map_says_what_is_wrong(tmp_path):
    for wrong, sentence in (
        (dict(mode="binary"), "mode must be 'trinary'"),
        (dict(image_format="jpg"), "image_format must be"),
        (dict(origin=(0, 0)), "origin must be three"),
        (dict(origin=(0, 0, np.nan)), "origin must be three"),
    ):
        with pytest.raises(ValueError, match=sentence):
            write_ros_map(tmp_path / "a.yaml", some_map(P_EMPTY), **wrong)
    with pytest.raises(ValueError, match="must end in .yaml"):
        write_ros_map(tmp_path / "a.txt", some_map(P_EMPTY))
    with pytest.raises(ValueError, match="metres_per_pixel must be known"):
        write_ros_map(tmp_path / "a.yaml", some_map(P_EMPTY, metres_per_pixel=None))
    assert list(tmp_path.iterdir()) == []


GOOD = dict(image="m.pgm", resolution=0.05, origin=[0, 0, 0], negate=0, occupied_thresh=0.65, free_thresh=0.196)


@pytest.mark.parametrize(
    "change, sentence",
    [
        (dict(resolution=0), "resolution must be a finite number above 0"),
        (dict(resolution="fine"), "resolution must be a number"),
        (dict(resolution=10**400), "resolution must be a number, got one of 401 digits"),
        (dict(origin=[0, 0]), "origin must be three"),
        (dict(origin=0), "origin must be three"),
        (dict(occupied_thresh=1.2), "occupied_thresh must lie between 0 and 1, got 1.2"),
        (dict(free_thresh=-0.1), "free_thresh must lie between 0 and 1, got -0.1"),
        (dict(free_thresh=0.7), "free_thresh must be below occupied_thresh"),
        (dict(mode="binary"), "mode must be"),
        (dict(negate=2), "negate must be 0 or 1"),
        (dict(image=""), "image must be the name of a file"),
        (dict(image="../m.pgm\0"), "image must be the name of a file"),
        (dict(image=7), "image must be the name of a file"),
    ],
)
def test_read_ros_map_says_which_value_is_wrong(tmp_path, change, sentence):
    (tmp_path / "m.yaml").write_text(yaml.safe_dump(GOOD | change))
    with pytest.raises(ValueError, match=sentence):
        read_ros_map(tmp_path / "m.yaml")


def test_read_ros_map_tells_missing_and_broken_files_apart(tmp_path):
    path = tmp_path / "m.yaml"
    with pytest.raises(FileNotFoundError, match="the map's yaml must be a file"):
        read_ros_map(path)
    path.write_text("image: [unclosed\n")
    with pytest.raises(ValueError, match="must be readable"):
        read_ros_map(path)
    path.write_bytes(b"\xff\xfe\x00\x81")
    with pytest.raises(ValueError, match="must be readable"):
        read_ros_map(path)
    path.write_text("resolution: 2001-99-99\n")  # yaml takes it for a date
    with pytest.raises(ValueError, match="the map's yaml must be readable"):
        read_ros_map(path)
    path.write_text("just words\n")
    with pytest.raises(ValueError, match="must hold names and values, got str"):
        read_ros_map(path)
    path.write_text("image: m.pgm\norigin: [0, 0, 0]\n")
    with pytest.raises(ValueError, match="got no resolution, occupied_thresh, free_thresh"):
        read_ros_map(path)
    path.write_text(yaml.safe_dump(GOOD))
    with pytest.raises(FileNotFoundError, match="the map's image must be a file"):
        read_ros_map(path)
    (tmp_path / "m.pgm").write_text("P5 is how it ought to start")
    with pytest.raises(ValueError, match="the map's image must be a whole"):
        read_ros_map(path)
    (tmp_path / "m.pgm").write_bytes(b"P5\n40 40\n255\n" + bytes(100))
    with pytest.raises(ValueError, match="the map's image must be a whole"):
        read_ros_map(path)
