"""What is wrong with the depth images of a Kinect: noise that grows with the square of depth, holes, whole millimetres."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import check_not_negative, check_rng, check_share, check_whole

MOST_MM = 65_535
"""The largest depth that 16 bits hold."""


@dataclass(frozen=True)
class DepthNoise:
    """The faults of a depth image; the defaults are a Kinect's.

    Parameters
    ----------
    deviation_at_1m : standard deviation of a pixel's depth at 1 m, metres; at 2 m it is four times as much, as for every
        camera that triangulates (Khoshelham and Elberink, 2012, measured 1.4 mm for the Kinect)
    common_at_1m : the same for what all pixels of a column share (a wavy depth image); the strip's mean does not take it away
    hole_rate : share of the image that is lost
    hole_side : a hole's side, pixels: holes come in patches, since single lost pixels would vanish in the strip's mean
    """

    deviation_at_1m: float = 0.0014
    common_at_1m: float = 0.001
    hole_rate: float = 0.05
    hole_side: int = 32

    def __post_init__(self) -> None:
        for name in ("deviation_at_1m", "common_at_1m"):
            check_not_negative(name, getattr(self, name))
        check_share("hole_rate", self.hole_rate)
        object.__setattr__(self, "hole_side", check_whole("hole_side", self.hole_side))


class FaultDraws(NamedTuple):
    """The chance in one depth image, whatever the size of its faults: one fault can be changed and the others stay.

    spread : (rows, columns) standard normal, one for a pixel; half precision, since many images are kept
    wave : (columns,) smooth, one for a column
    patches : (P, Q) between 0 and 1; below the hole rate the patch is lost
    patch_row, patch_column : (rows,) and (columns,) the patch that a pixel lies in
    """

    spread: NDArray[np.float16]
    wave: NDArray[np.float64]
    patches: NDArray[np.float64]
    patch_row: NDArray[np.int64]
    patch_column: NDArray[np.int64]

    def rows(self, chosen: slice) -> FaultDraws:
        """Those of some rows."""
        return self._replace(spread=self.spread[chosen], patch_row=self.patch_row[chosen])

    def lost(self, hole_rate: float) -> NDArray[np.bool_]:
        """(rows, columns) True where a pixel is lost at this rate."""
        return (self.patches < hole_rate)[self.patch_row[:, None], self.patch_column]


def draw_faults(rng: np.random.Generator | None, shape: tuple[int, int], hole_side: int = 32) -> FaultDraws:
    """Draw the chance of one image of a camera."""
    rng = check_rng(rng)
    rows, columns = shape
    spread = rng.standard_normal(shape, dtype=np.float32).astype(np.float16)
    knots = rng.standard_normal(2 + columns // hole_side)
    wave = np.interp(np.arange(columns) / hole_side, np.arange(len(knots)), knots)
    patches = rng.random((2 + rows // hole_side, 2 + columns // hole_side))
    down, right = (int(offset) for offset in rng.integers(0, hole_side, 2))
    return FaultDraws(spread, wave, patches, (np.arange(rows) + down) // hole_side, (np.arange(columns) + right) // hole_side)


def disturb_depth(depth_m: NDArray[np.float64], noise: DepthNoise, draws: FaultDraws) -> NDArray[np.float64]:
    """Depths as a faulty camera sees them; inf = nothing measured stays so, and holes become inf.

    Parameters
    ----------
    depth_m : (rows, columns) true depths, metres
    noise : the faults
    draws : the chance in this image, of the same rows

    >>> flat = np.full((480, 640), 2.0)
    >>> draws = draw_faults(np.random.default_rng(0), flat.shape)
    >>> round(float(disturb_depth(flat, DepthNoise(common_at_1m=0, hole_rate=0), draws).std()), 4)     # 0.0014 m x 2^2
    0.0056
    """
    squared = np.where(np.isfinite(depth_m), depth_m, 0.0) ** 2
    spread = draws.spread.astype(np.float32)
    seen = depth_m + (noise.deviation_at_1m * spread + noise.common_at_1m * draws.wave) * squared
    return np.where(draws.lost(noise.hole_rate), np.inf, seen)


def in_millimetres(depth_m: NDArray[np.float64], min_depth_m: float, max_depth_m: float) -> NDArray[np.uint16]:
    """Depths as a camera delivers them: whole millimetres, 16 bits, 0 where nothing was measured.

    >>> in_millimetres(np.array([[0.39, 0.4, 1.2344, 3.0, 3.01, np.inf]]), 0.4, 3.0).tolist()
    [[0, 400, 1234, 3000, 0, 0]]
    """
    millimetres = np.rint(1000 * np.where(np.isfinite(depth_m), depth_m, 0.0))
    measured = (millimetres >= 1000 * min_depth_m) & (millimetres <= min(1000 * max_depth_m, MOST_MM))
    return np.where(measured, millimetres, 0).astype(np.uint16)
