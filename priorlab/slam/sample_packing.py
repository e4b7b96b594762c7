"""The particles of a run's pictures, packed so that a zip finds what is alike: whole millimetres, near ones in a row.

Particles of one step lie within a few decimetres and are ordered by x. Counted from the smallest coordinate of the step, and x
from its neighbour, most numbers are below 256, and the bytes of one worth stand together.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from priorlab.slam.recording import SAMPLE_UNITS


def pack_sample(sample: NDArray[np.float32]) -> dict[str, NDArray]:
    """A run's sample (T, S, 3) as arrays that compress well and come back to the last bit; as it is when they would not.

    >>> packed = pack_sample(np.array([[[1.0, 5.0, 0.0], [1.002, 5.001, 0.003]]], dtype=np.float32))
    >>> packed["sample_lowest"].tolist(), packed["sample_bytes"][:, 0].tolist()
    ([[1000, 5000, 0]], [[[0, 2]], [[0, 1]], [[0, 3]]])
    """
    units = np.rint(sample.astype(np.float64) * SAMPLE_UNITS).astype(np.int64)
    lowest = units.min(axis=1)
    above = units - lowest[:, None]
    above[..., 0] = np.diff(above[..., 0], axis=1, prepend=0)
    by_axis = np.ascontiguousarray(np.moveaxis(above, 2, 0), dtype="<u4")  # (3, T, S)
    by_worth = np.moveaxis(by_axis.view(np.uint8).reshape(*by_axis.shape, 4), 3, 1)  # (3, 4, T, S)
    packed = {"sample_lowest": lowest, "sample_bytes": np.ascontiguousarray(by_worth)}
    return packed if np.array_equal(unpack_sample(packed), sample) else {"sample": sample}


def unpack_sample(arrays: dict[str, NDArray]) -> NDArray[np.float32]:
    """The sample (T, S, 3) that was packed."""
    if "sample" in arrays:
        return arrays["sample"]
    by_axis = np.ascontiguousarray(np.moveaxis(arrays["sample_bytes"], 1, 3)).view("<u4")[..., 0]
    above = np.moveaxis(by_axis, 0, 2).astype(np.int64)
    above[..., 0] = np.cumsum(above[..., 0], axis=1)
    return ((above + arrays["sample_lowest"][:, None]) / SAMPLE_UNITS).astype(np.float32)
