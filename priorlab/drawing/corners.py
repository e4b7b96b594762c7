"""Harris corners: the vertices that doors are searched among (thesis eq. 3.1, 3.2)."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from priorlab.core.drawing import Drawing
from priorlab.drawing.method import ROBUST, Method
from priorlab.drawing.narrow_cells import with_narrow_cells
from priorlab.drawing.preprocessing import large_components, prepare
from priorlab.drawing.sheet import Sheet
from priorlab.drawing.tiles import in_tiles

BLOCK = 3
"""Side of the window over which the squared gradient is smoothed, pixels."""

HARRIS_K = 0.04
"""Weight of the squared trace in the response."""

EQUALS = 2
"""Pixels to either side of a corner that may be as strong as it is."""

TIE = 1e-3
"""Responses are equal within this share."""


def harris_response(grey: NDArray[np.uint8]) -> NDArray[np.float32]:
    """det A - k trace(A)^2 of the smoothed A = grad I grad I^T: large where intensity changes in every direction n.

    Eq. 3.1 is n^T A n before smoothing, eq. 3.2 after it; both eigenvalues of A are large where the response is.

    Parameters
    ----------
    grey : (height, width) uint8

    Returns
    -------
    (height, width) float32; positive at corners, negative along edges
    """
    return np.asarray(cv2.cornerHarris(grey, BLOCK, 3, HARRIS_K), dtype=np.float32)


def detect_corners(drawing: Drawing, n_corners: int | None = None, method: Method = ROBUST) -> NDArray[np.float64]:
    """The strongest Harris corners of a drawing, none nearer to another than `method.corner_spacing`.

    Parameters
    ----------
    drawing : the drawing
    n_corners : how many to keep, in every tile; `method.n_corners` by default
    method : `ROBUST` looks only at long pieces of ink, so that the budget is not spent on text, nor on hatching

    Returns
    -------
    (N, 2) x, y in pixels of the drawing, y down, strongest first

    >>> grey = np.full((40, 40), 255, dtype=np.uint8)
    >>> grey[10:30, 12:28] = 0
    >>> sorted(map(tuple, detect_corners(Drawing(grey)).round(-1).tolist()))
    [(10.0, 10.0), (10.0, 30.0), (30.0, 10.0), (30.0, 30.0)]
    """
    sheet = prepare(drawing, method)
    n_corners = method.n_corners if n_corners is None else n_corners
    if n_corners < 1:
        raise ValueError(f"n_corners must be at least 1, got {n_corners}")
    return sheet.points_to_input(corners_of(sheet, n_corners, method))


def corners_of(sheet: Sheet, n_corners: int, method: Method) -> NDArray[np.float64]:
    """(N, 2) corners in working pixels."""
    where: NDArray[np.uint8] | None = None
    image = 255 - sheet.darkness
    if method.component_share > 0:
        lines = with_narrow_cells(sheet.lines, method.cell_share * sheet.long_side) if method.cell_share > 0 else sheet.lines
        lines = large_components(lines, method.component_share * sheet.long_side)
        image = np.where(lines, 0, 255).astype(np.uint8)  # grey leaves count as much as black walls
        where = np.asarray(cv2.dilate(lines.astype(np.uint8), np.ones((5, 5), np.uint8)), dtype=np.uint8)
    spacing = max(method.corner_spacing, method.corner_spacing_share * sheet.long_side)

    def strongest(part: NDArray[np.uint8], look_at: NDArray[np.uint8] | None) -> NDArray[np.float64]:
        return _strongest(part, look_at, n_corners, method.corner_quality, spacing)

    found = strongest(image, where) if method.tiles == 1 else in_tiles(image, where, method.tiles, strongest)
    return amid_equals(harris_response(image), found) if method.component_share > 0 and len(found) else found


def amid_equals(response: NDArray[np.float32], corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """Corners in the middle of the pixels next to them that respond as strongly: a line two pixels wide ends between the two.

    Which of equals comes first depends on how a sheet lies; their middle does not.

    Parameters
    ----------
    response : (height, width) Harris response
    corners : (N, 2) x, y of pixels

    >>> response = np.zeros((5, 9), dtype=np.float32); response[2, [3, 4, 6]] = 1.0
    >>> amid_equals(response, np.array([[3.0, 2.0], [6.0, 2.0]])).tolist()
    [[3.5, 2.0], [6.0, 2.0]]
    """
    x, y = (corners[:, k].astype(np.int64) + EQUALS for k in (0, 1))
    padded = np.pad(response, EQUALS, constant_values=-np.inf)
    around = np.arange(-EQUALS, EQUALS + 1)
    equal = padded[y[:, None, None] + around[:, None], x[:, None, None] + around] >= (1 - TIE) * padded[y, x][:, None, None]
    joined = np.zeros_like(equal)
    joined[:, EQUALS, EQUALS] = True
    for _ in range(EQUALS):
        wide = np.pad(joined, ((0, 0), (1, 1), (1, 1)))
        joined = equal & np.logical_or.reduce(
            [wide[:, j : j + len(around), i : i + len(around)] for j in range(3) for i in range(3)]
        )
    n_equal = joined.sum(axis=(1, 2))
    aside = (joined.sum(axis=1) @ around) / n_equal, (joined.sum(axis=2) @ around) / n_equal
    return corners + np.column_stack(aside)


def _strongest(
    image: NDArray[np.uint8], where: NDArray[np.uint8] | None, n_corners: int, quality: float, spacing: float
) -> NDArray[np.float64]:
    """(N, 2) strongest corners of an image."""
    if np.ptp(image) == 0 or min(image.shape) < 3:
        return np.empty((0, 2))
    found = cv2.goodFeaturesToTrack(
        image, n_corners, quality, spacing, mask=where, blockSize=BLOCK, useHarrisDetector=True, k=HARRIS_K
    )
    return np.empty((0, 2)) if found is None else found.reshape(-1, 2).astype(np.float64)
