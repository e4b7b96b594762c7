"""Pictures with words, sliders with names, labs that move as a whole."""

from __future__ import annotations

import cv2
import numpy as np
import pytest

from priorlab.widgets.lab import Lab
from priorlab.widgets.picture import Picture
from priorlab.widgets.screen import Screen
from priorlab.widgets.sliders import Slider


class Doubling(Lab):
    """The smallest lab: one number, twice as large."""

    def __init__(self):
        self.refreshed = 0
        self.x = Slider("x", 1, 0, 10, 1)
        self.y = Slider("y", 1, 0, 10, 1)
        super().__init__({"x": self.x, "y": self.y}, {"high": {"x": 9, "y": 8}}, [Picture()])

    def refresh(self):
        self.refreshed += 1
        self.double = 2 * self.x.value
        self.readout.value = f"{self.double:g}"
        self.pictures[0].show(np.full((2, 2), 10 * int(self.x.value), dtype=np.uint8), f"twice {self.x.value:g}")

    def summary(self):
        return f"{self.double:g}"


def test_picture_show_holds_the_very_pixels_and_the_words():
    picture, pixels = Picture(), np.arange(12, dtype=np.uint8).reshape(3, 4)
    picture.show(pixels, "twelve greys")
    back = cv2.imdecode(np.frombuffer(picture.image, np.uint8), cv2.IMREAD_GRAYSCALE)
    assert (back == pixels).all() and picture.alt == "twelve greys" and picture.mime == "image/png"


def test_picture_wider_than_shown_is_reduced_and_keeps_thin_walls():
    picture, pixels = Picture(width=50), np.full((80, 200), 255, dtype=np.uint8)
    pixels[:, 101] = 0
    picture.show(pixels, "one thin wall")
    back = cv2.imdecode(np.frombuffer(picture.image, np.uint8), cv2.IMREAD_GRAYSCALE)
    assert back.shape == (20, 50) and (back[:, 25] < 200).all() and (np.delete(back, 25, axis=1) == 255).all()


def test_screen_names_its_pictures_for_screen_readers_and_keeps_pixels_sharp():
    assert 'setAttribute("aria-label", (place.alt = alt))' in Screen._esm and '"auto" : "pixelated"' in Screen._esm
    assert 'setAttribute("role", "img")' in Screen._esm and 'setAttribute("role", "status")' in Screen._esm


def names_in(message):
    """The traits that an update for the browser carries."""
    return set(message["state"]) | {path[0] for path in message["buffer_paths"]}


def test_screen_sends_one_message_with_what_changed_and_no_more(monkeypatch):
    first, second = Picture(), Picture(width=40)
    screen = Screen([first, second])
    assert screen.widths == [0, 40]
    sent = []
    monkeypatch.setattr(screen.comm, "send", lambda data, buffers: sent.append(names_in(data)))
    first.show(np.zeros((2, 2), np.uint8), "black")
    second.show(np.zeros((3, 3), np.uint8), "black too")
    screen.show([first, second], "two pictures")
    second.show(np.full((3, 3), 9, np.uint8), "nearly black")
    screen.show([first, second], "two pictures")
    screen.show([first, second], "two pictures")
    assert sent == [{"image_0", "image_1", "alt_0", "alt_1", "readout"}, {"image_1", "alt_1"}]


def test_slider_names_itself_for_screen_readers_and_keeps_its_keys():
    assert 'setAttribute("aria-label", model.get("label"))' in Slider._esm
    assert "aria-valuetext" in Slider._esm and "data-lm-suppress-shortcuts" in Slider._esm


def test_slider_outside_its_range_is_told_and_does_not_move():
    slider = Slider("p_wall", 0.2, 0.05, 1.0, 0.01)
    with pytest.raises(ValueError, match="p_wall must lie between 0.05 and 1, got -0.2"):
        slider.value = -0.2
    assert slider.value == 0.2


def test_lab_moving_a_slider_refreshes_at_once():
    lab = Doubling()
    lab.x.value = 4
    assert lab.double == 8 and lab.pictures[0].alt == "twice 4" and repr(lab) == "Doubling(8)"


def test_lab_set_refreshes_once_and_presets_and_reset_work():
    lab = Doubling()
    before = lab.refreshed
    lab.set(x=3, y=5)
    assert lab.refreshed == before + 1
    lab.buttons["high"].click()
    assert (lab.x.value, lab.y.value, lab.double) == (9, 8, 18)
    lab.buttons["reset"].click()
    assert (lab.x.value, lab.y.value, lab.double) == (1, 1, 2)


def test_lab_shows_on_its_screen_what_its_pictures_hold():
    lab = Doubling()
    lab.x.value = 7
    assert lab.screen.image_0 == lab.pictures[0].image and lab.screen.alt_0 == "twice 7"
    assert lab.screen.readout == lab.readout.value == "14"


def test_lab_set_unknown_slider_is_told():
    with pytest.raises(ValueError, match="a slider must be one of x, y, got 'z'"):
        Doubling().set(z=1)


def test_lab_set_bad_value_leaves_it_usable():
    lab = Doubling()
    with pytest.raises(ValueError, match="x must lie between 0 and 10"):
        lab.set(x=11)
    lab.x.value = 2
    assert lab.double == 4


def test_lab_without_a_kernel_shows_a_picture_and_a_line():
    bundle = Doubling()._repr_mimebundle_()
    assert bundle["text/plain"] == "Doubling(2)"
    assert bundle["image/png"].startswith("iVBOR")
