"""From an image to ink: the distance of every pixel from the paper, and masks of it at two thresholds."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import check_record
from priorlab.core.drawing import Drawing
from priorlab.drawing.deskew import Turn, find_skew, then_cut, turn_by
from priorlab.drawing.method import Method
from priorlab.drawing.painted import without_paint
from priorlab.drawing.sheet import Sheet

LEAST_CONTRAST = 12
"""Nothing fainter than this, of 255, is ink."""

FRAME_SIZE = 0.93
"""A frame spans so much of the sheet's width and height."""

FRAME_RIM = 0.75
"""So much of a frame's ink lies at its rim; the rest is a title block."""

ROOM_SHARE = 0.03
"""An area this wide, as a share of the long side, is no line."""


def prepare(drawing: Drawing, method: Method) -> Sheet:
    """Find the paper, the ink and its colours.

    The paper is the median colour, so a white-on-black drawing needs no other treatment than a black-on-white one. Where dark
    surroundings outweigh light rooms, as in maps, the lightest grey is the paper.
    A sheet that was laid askew is turned straight first and loses wide margins (`Method.deskew`); a small one is doubled
    (`Method.upscale_below`).
    """
    check_record("drawing", drawing, Drawing)
    check_record("method", method, Method)
    image = drawing.grey if drawing.colour is None else drawing.colour
    turn = straightened(drawing.grey) if method.deskew else None
    if turn is not None:
        image = turn.image(image)
    inverted = is_light_on_dark(drawing.grey)
    if not inverted and np.median(drawing.grey) < 128:  # dark surroundings, light rooms: the paper is not the commonest
        paper: int | None = int(drawing.grey.max())
    else:
        paper = None
    scale = 2 if max(drawing.shape) < method.upscale_below else 1
    if scale > 1:
        image = np.asarray(cv2.resize(image, None, fx=scale, fy=scale, interpolation=cv2.INTER_CUBIC), dtype=np.uint8)
    if method.sources == "both" and image.ndim == 3 and not inverted and paper is None:
        image = without_paint(image)
    darkness = paper_distance(image, paper)
    wall_darkness = _wall_threshold(darkness, image) if method.wall_darkness is None else method.wall_darkness
    line_darkness = min(method.line_darkness, wall_darkness)
    lines, walls = darkness > line_darkness, darkness > wall_darkness
    if method.component_share > 0:
        frame = sheet_frame(lines)
        lines, walls = lines & ~frame, walls & ~frame
    return Sheet(
        darkness=darkness,
        lines=lines,
        walls=walls,
        hue=_hue(image),
        scale=scale,
        inverted=inverted,
        input_shape=drawing.shape,
        turn=turn,
    )


def straightened(grey: NDArray[np.uint8]) -> Turn | None:
    """How to turn a sheet straight and cut wide margins off; None when it lies straight and has none."""
    degrees = -find_skew(grey)
    turn = turn_by(degrees, grey.shape)
    box = _drawn_box(turn.image(grey) if degrees else grey)
    if box is None:
        return turn if degrees else None
    return then_cut(turn, *box)


def _drawn_box(grey: NDArray[np.uint8]) -> tuple[int, int, int, int] | None:
    """Left, top, width and height of what is drawn and a margin round it; None when the margins are not wide."""
    drawn = cv2.morphologyEx((paper_distance(grey) > MARGIN_INK).astype(np.uint8), cv2.MORPH_OPEN, np.ones((2, 2), np.uint8))
    left, top, width, height = cv2.boundingRect(drawn)
    if max(width, height) < LEAST_DRAWN or (width >= NARROW * grey.shape[1] and height >= NARROW * grey.shape[0]):
        return None
    rim = round(KEPT_MARGIN * max(width, height)) + 4
    right, bottom = min(left + width + rim, grey.shape[1]), min(top + height + rim, grey.shape[0])
    left, top = max(left - rim, 0), max(top - rim, 0)
    return left, top, right - left, bottom - top


MARGIN_INK = 80
"""Darker than this, of 255, is surely drawn and no stain of the paper."""

LEAST_DRAWN = 150
"""What is smaller is a mark on the sheet, no building, pixels."""

NARROW = 0.6
"""Margins are cut off when the drawing takes less than this share of the sheet's width or height."""

KEPT_MARGIN = 0.1
"""So wide a margin is kept, as a share of the long side of what is drawn."""


def is_light_on_dark(grey: NDArray[np.uint8]) -> bool:
    """True when a drawing has light lines on dark paper: mostly dark, and hardly any light area is wider than a line.

    >>> sheet = np.zeros((50, 50), dtype=np.uint8)
    >>> sheet[10] = sheet[:, 20] = 255
    >>> is_light_on_dark(sheet), is_light_on_dark(255 - sheet)
    (True, False)
    """
    if np.median(grey) >= 128:
        return False
    threshold, _ = cv2.threshold(grey, 0, 255, cv2.THRESH_BINARY + cv2.THRESH_OTSU)
    light = (grey > threshold).astype(np.uint8)
    side = max(3, round(ROOM_SHARE * max(grey.shape)))
    wide = cv2.morphologyEx(light, cv2.MORPH_OPEN, np.ones((side, side), np.uint8))
    return bool(2 * int(wide.sum()) < int(light.sum()))


def paper_distance(image: NDArray[np.uint8], paper_grey: int | None = None) -> NDArray[np.uint8]:
    """Largest channel distance of every pixel from the paper, the median colour unless a grey is given.

    Parameters
    ----------
    image : (height, width) grey or (height, width, 3) colour, uint8

    >>> paper_distance(np.array([[255, 255, 0]], dtype=np.uint8)).tolist()
    [[0, 0, 255]]
    """
    if paper_grey is None:
        paper = np.median(image.reshape(-1, *image.shape[2:]), axis=0).astype(np.uint8)
    else:
        paper = np.full(image.shape[2:], paper_grey, dtype=np.uint8)
    if image.ndim == 2:
        return np.asarray(cv2.absdiff(image, np.full_like(image, paper)), dtype=np.uint8)
    return np.asarray(cv2.absdiff(image, np.broadcast_to(paper, image.shape).copy()).max(axis=2), dtype=np.uint8)


def large_components(ink: NDArray[np.bool_], min_length: float) -> NDArray[np.bool_]:
    """Ink of 8-connected components whose longer side is at least `min_length` pixels: lines and walls, no text."""
    _, labels, stats, _ = cv2.connectedComponentsWithStats(ink.astype(np.uint8), connectivity=8)
    keep = np.maximum(stats[:, cv2.CC_STAT_WIDTH], stats[:, cv2.CC_STAT_HEIGHT]) >= min_length
    keep[0] = False
    return keep[labels]


def sheet_frame(ink: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Ink of the frame round a sheet: components as large as the sheet, nearly all of them at its rim, with a drawing inside."""
    n_components, labels, stats, _ = cv2.connectedComponentsWithStats(ink.astype(np.uint8), connectivity=8)
    height, width = ink.shape
    frame = np.zeros(n_components, dtype=bool)
    big = (stats[:, cv2.CC_STAT_WIDTH] >= FRAME_SIZE * width) & (stats[:, cv2.CC_STAT_HEIGHT] >= FRAME_SIZE * height)
    for label in np.flatnonzero(big[1:]) + 1:
        rows, cols = np.nonzero(labels == label)
        margin = 0.03 * max(ink.shape)
        from_rim = np.minimum.reduce([rows - rows.min(), rows.max() - rows, cols - cols.min(), cols.max() - cols])
        frame[label] = (from_rim <= margin).mean() >= FRAME_RIM and 2 * rows.size <= ink.sum()
    return frame[labels]


def _wall_threshold(darkness: NDArray[np.uint8], image: NDArray[np.uint8]) -> int:
    """Otsu's threshold, half of it when more than 30 % of the ink is coloured."""
    otsu, _ = cv2.threshold(darkness, 0, 255, cv2.THRESH_BINARY + cv2.THRESH_OTSU)
    ink = darkness > max(otsu, LEAST_CONTRAST)
    coloured = ink & (_hue(image) != NO_HUE)
    if ink.any() and coloured.sum() > 0.3 * ink.sum():
        otsu /= 2
    return int(max(otsu, LEAST_CONTRAST))


NO_HUE = 255
"""Mark of a pixel without colour."""


def _hue(image: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Hue in 0-179 of every pixel whose channels differ by more than 40; `NO_HUE` elsewhere."""
    if image.ndim == 2:
        return np.full(image.shape, NO_HUE, dtype=np.uint8)
    hue = cv2.cvtColor(image, cv2.COLOR_RGB2HSV)[..., 0]
    spread = np.ptp(image, axis=2)
    return np.where(spread > 40, hue, NO_HUE).astype(np.uint8)
