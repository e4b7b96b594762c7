"""A reader is told when most of the ink that is as heavy as the walls was left out."""

import cv2
import numpy as np
import pytest

from priorlab.core.drawing import Drawing
from priorlab.drawing import remarks
from priorlab.drawing.extraction import extract_walls
from priorlab.drawing.left_out import share_kept


def bars(count, thick=8):
    """Bars of 100 pixels each; (200, 120) bool."""
    ink = np.zeros((200, 120), dtype=bool)
    for k in range(count):
        ink[10 + 20 * k : 10 + 20 * k + thick, 10:110] = True
    return ink


@pytest.mark.parametrize("kept", [1, 2, 5])
def test_share_kept_counts_bars(kept):
    assert share_kept(bars(kept), bars(5)) == pytest.approx(kept / 5)


def test_share_kept_asks_for_no_lines():
    ink = bars(2)
    ink[150:200:4] = True
    assert share_kept(bars(2), ink) == 1.0


def test_share_kept_of_hollow_walls_is_all():
    body = bars(3, thick=9)
    faces = body & ~cv2.erode(body.astype(np.uint8), np.ones((3, 3), np.uint8)).astype(bool)
    assert share_kept(body, faces) == 1.0


def test_notes_tell_what_was_left_out(monkeypatch):
    grey = np.full((300, 400), 255, np.uint8)
    cv2.rectangle(grey, (40, 40), (360, 260), 0, 8)
    plain = extract_walls(Drawing(grey, name="plain"))
    assert not any("as heavy as" in note for note in plain.notes)
    monkeypatch.setattr(remarks, "share_kept", lambda walls, ink: 0.2)
    told = extract_walls(Drawing(grey, name="plain"))
    assert any(note.startswith("Only 20 % of the ink as heavy as these walls") for note in told.notes)
