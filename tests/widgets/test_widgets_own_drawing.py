"""An own drawing, uploaded or named: walls and notes, or a sentence, and never a traceback."""

from __future__ import annotations

import datetime

import cv2
import numpy as np
import pytest

import priorlab as pl
from priorlab.study.own_drawing import extract_own
from priorlab.widgets import OwnDrawing


@pytest.fixture(scope="module")
def room():
    grey = np.full((120, 160), 255, dtype=np.uint8)
    cv2.rectangle(grey, (10, 10), (150, 110), 0, 6)
    return grey


@pytest.fixture
def own(room):
    return OwnDrawing(pl.Drawing(room, name="bundled"))


def sent(name, content):
    """What the browser's upload hands over."""
    now = datetime.datetime(2026, 1, 1, tzinfo=datetime.UTC)
    return ({"name": name, "type": "", "size": len(content), "content": memoryview(content), "last_modified": now},)


def test_own_drawing_begins_with_the_bundled_one(own):
    assert own.found.drawing.name == "bundled" and "bundled, 160 x 120 px, ROBUST" in repr(own)
    assert "nothing read" not in own.readout.value and own.pictures[1].image[:4] == b"\x89PNG"


def test_own_drawing_upload_and_path_give_the_same(own, room, tmp_path):
    path = tmp_path / "my plan.png"
    cv2.imwrite(str(path), np.rot90(room))
    own.upload.value = sent(path.name, path.read_bytes())
    uploaded = own.found
    assert own.found.drawing.name == "my plan" and own.found.drawing.shape == (160, 120)
    own.path.value = str(path)
    assert own.found is not uploaded and np.array_equal(own.found.walls.mask, uploaded.walls.mask)


def test_own_drawing_bad_upload_gives_its_sentence_and_recovers(own):
    own.upload.value = sent("letter.docx", b"PK\x03\x04 not a drawing")
    assert own.found is None and "nothing read" in repr(own)
    assert own.says[0].endswith("got something else or a broken start: letter.docx")
    assert own.says[0] in own.readout.value and "could not be read" in own.pictures[0].alt
    next(button for button in own.children[0].children if getattr(button, "description", "") == "the bundled drawing").click()
    assert own.found.drawing.name == "bundled"


def test_own_drawing_path_that_is_not_there_gives_its_sentence(own):
    own.path.value = "nowhere/plan.png"
    assert own.says == ("the drawing must be a file, found nothing at nowhere/plan.png",)


def test_own_drawing_method_is_asked_again(own):
    own.method.value = "THESIS"
    assert own.found.method == pl.THESIS and "THESIS" in repr(own)
    assert any("No door was found" in sentence for sentence in own.says)


def test_own_drawing_names_are_no_html(own):
    own.upload.value = sent("<b>.png", b"")
    assert "<b>.png" not in own.readout.value and "&lt;b&gt;.png" in own.readout.value


@pytest.mark.parametrize(
    ("content", "says"),
    [
        (b"", "got an empty file: plan.png"),
        (b"%PDF-1.4", "got a PDF file: export plan.png as a PNG first"),
        (b"\x89PNG\r\n\x1a\n broken", "broken start: plan.png"),
    ],
)
def test_extract_own_bytes_that_are_no_image(content, says):
    result = extract_own(content, "plan.png")
    assert result.found is None and result.says[0].endswith(says) and "OwnResult(" in repr(result)


@pytest.mark.parametrize("name", ["../../etc/plan.png", "C:\\plans\\plan.png", "", "/"])
def test_extract_own_odd_names_stay_in_their_folder(name, room):
    content = cv2.imencode(".png", room)[1].tobytes()
    assert extract_own(content, name, pl.THESIS).found.drawing.name in ("plan", "upload")


def test_extract_own_no_path_and_a_folder(tmp_path):
    assert extract_own(" ").says[0].startswith("No file was named")
    assert "got the folder" in extract_own(tmp_path).says[0]


def test_extract_own_reports_its_steps(room):
    steps = []
    extract_own(pl.Drawing(room), method=pl.THESIS, progress=lambda step, done: steps.append(step))
    assert steps[0] == "ink" and steps[-1] == "done"
