"""`priorlab run` on drawings of one's own: whole, without walls, walls that do not close."""

import json
import re

import cv2
import numpy as np
import pytest

from priorlab.buildings.floor_plans import load_floor_plan
from priorlab.cli import main
from priorlab.drawing.extraction import extract_walls
from priorlab.slam.run_file import load_run


@pytest.fixture(scope="module")
def own(tmp_path_factory):
    """The small flat as if nobody knew it: only the picture, no scale."""
    folder = tmp_path_factory.mktemp("own")
    cv2.imwrite(str(folder / "mine.png"), load_floor_plan("small_flat").drawing.grey)
    code = main(["run", str(folder / "mine.png"), "--out", str(folder / "out"), "--seed", "3"])
    return folder / "out", code


def test_run_writes_the_whole_folder(own):
    out, code = own
    assert code == 0
    assert sorted(path.name for path in out.iterdir()) == [
        ".priorlab",
        "fastslam.npz",
        "numbers.json",
        "posterior.png",
        "prior_map.png",
        "report.html",
        "ros_map.pgm",
        "ros_map.yaml",
        "walls.png",
    ]
    assert [path.name for path in out.parent.iterdir() if path.name.startswith(".")] == []


def test_run_says_that_no_truth_is_known_and_gives_no_score(own):
    out, _ = own
    page = re.sub(r"base64,[A-Za-z0-9+/=]+", "", (out / "report.html").read_text())
    numbers = json.loads((out / "numbers.json").read_text())
    assert "No truth is known" in page and "AS EXTRACTED" in page
    assert "precision" not in page and "F2" not in page
    assert numbers["walls"]["score"] is None and numbers["search"] is None
    assert numbers["mapping"]["with_plan"] is None and numbers["fastslam"]["with_plan"] is None


def test_run_assumes_the_scale_from_the_doors_and_says_so(own):
    out, _ = own
    drawing = load_floor_plan("small_flat").drawing
    width = float(np.median([np.hypot(*np.subtract(door.hinge, door.strike)) for door in extract_walls(drawing).doors]))
    numbers = json.loads((out / "numbers.json").read_text())["drawing"]
    assert numbers["metres_per_pixel"] == pytest.approx(0.85 / width)
    assert "ASSUMED" in numbers["scale"] and "0.85 m" in numbers["scale"]
    assert numbers["scale"] in (out / "report.html").read_text()


def test_run_pictures_are_as_large_as_the_drawing(own):
    out, _ = own
    drawing = load_floor_plan("small_flat").drawing
    walls, prior_map, posterior = (
        cv2.imread(str(out / f"{name}.png"), cv2.IMREAD_UNCHANGED) for name in ("walls", "prior_map", "posterior")
    )
    assert walls.shape == prior_map.shape == posterior.shape == drawing.shape
    assert (walls == 0).sum() == json.loads((out / "numbers.json").read_text())["walls"]["wall_pixels"]
    assert sorted(np.unique(prior_map)) == [round(255 * 0.18), round(255 * 0.81)]  # 0.2 x 0.9 and 0.9 x 0.9
    assert len(np.unique(posterior)) > 2


def test_run_is_recorded(own):
    out, _ = own
    numbers = json.loads((out / "numbers.json").read_text())["fastslam"]
    assert load_run(out / "fastslam.npz").ate_m() == pytest.approx(numbers["ate_m"])


def text_only():
    """A page of text."""
    image = np.full((200, 300), 255, dtype=np.uint8)
    for row in range(20, 200, 24):
        cv2.putText(image, "no walls here", (10, row), cv2.FONT_HERSHEY_SIMPLEX, 0.5, 90, 1)
    return image


def noise_only():
    """A photograph of nothing."""
    return np.random.default_rng(0).integers(0, 256, (200, 300), dtype=np.uint8)


@pytest.mark.parametrize("draw", [text_only, noise_only])
def test_run_without_walls_has_its_own_code_the_funnel_and_the_stage(draw, tmp_path, capsys):
    cv2.imwrite(str(tmp_path / "none.png"), draw())
    code = main(["run", str(tmp_path / "none.png"), "--out", str(tmp_path / "out")])
    said, numbers = capsys.readouterr(), json.loads((tmp_path / "out" / "numbers.json").read_text())
    assert code == 3
    assert "no walls were found" in said.out and f"'{numbers['walls']['lost_at']}'" in said.out
    for test, count in numbers["walls"]["funnel"].items():
        assert f"after {test}" in said.out and f"{count} left" in said.out
    page = (tmp_path / "out" / "report.html").read_text()
    assert "The way ended early" in page and "no walls were found" in page
    assert numbers["mapping"] is None and not (tmp_path / "out" / "posterior.png").exists()


def test_run_stops_with_a_sentence_where_walls_do_not_close(tmp_path, capsys):
    image = np.full((300, 400), 255, dtype=np.uint8)
    cv2.line(image, (50, 50), (350, 50), 0, 12)  # three walls and no fourth
    cv2.line(image, (50, 50), (50, 250), 0, 12)
    cv2.line(image, (350, 50), (350, 250), 0, 12)
    cv2.imwrite(str(tmp_path / "open.png"), image)
    code = main(["run", str(tmp_path / "open.png"), "--out", str(tmp_path / "out"), "--metres-per-pixel", "0.02"])
    assert code == 4
    assert "leaks outdoors" in capsys.readouterr().out
    assert "leaks outdoors" in (tmp_path / "out" / "report.html").read_text()
    assert (tmp_path / "out" / "prior_map.png").exists() and not (tmp_path / "out" / "posterior.png").exists()


def test_run_asks_for_the_scale_when_no_door_tells_it(tmp_path, capsys):
    image = np.full((300, 400), 255, dtype=np.uint8)
    cv2.rectangle(image, (50, 50), (350, 250), 0, 12)
    cv2.imwrite(str(tmp_path / "shut.png"), image)
    code = main(["run", str(tmp_path / "shut.png"), "--out", str(tmp_path / "out")])
    assert code == 4
    assert "--metres-per-pixel" in capsys.readouterr().out
    assert (tmp_path / "out" / "report.html").exists()


def test_force_replaces_what_stands_there(tmp_path):
    image = np.full((300, 400), 255, dtype=np.uint8)
    cv2.rectangle(image, (50, 50), (350, 250), 0, 12)
    cv2.imwrite(str(tmp_path / "shut.png"), image)
    out = tmp_path / "out"
    out.mkdir()
    (out / "old.txt").write_text("old")
    (out / ".priorlab").write_text("made by priorlab")
    assert main(["run", str(tmp_path / "shut.png"), "--out", str(out), "--force"]) == 4
    assert not (out / "old.txt").exists() and (out / "report.html").exists()
