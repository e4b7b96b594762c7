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

    return strongest(image, where) if method.tiles == 1 else in_tiles(image, where, method.tiles, strongest)


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
