"""The maps of all particles in a checkpoint: only their paths are kept, and the maps drawn again along them.

Particles were drawn from one another, so their paths are one up to some step back. That part is kept once.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from priorlab.slam.own_maps import OwnMaps


def shared_steps(paths: NDArray[np.float64]) -> int:
    """Steps from the start in which all (N, k, 3) paths are one.

    >>> shared_steps(np.array([[[0, 0, 0], [1, 0, 0]], [[0, 0, 0], [2, 0, 0]]]))
    1
    """
    apart = (paths != paths[:1]).any(axis=(0, 2))
    return int(np.argmax(apart)) if apart.any() else len(apart)


def own_maps_news(own: OwnMaps, shared: int) -> dict[str, Any]:
    """The paths from where they were not one when the record before was made; that one holds what lies before."""
    return {"own_paths": own.paths[:, shared:], "own_heaviest": np.array(own.heaviest)}


def own_paths_of(news: list[dict[str, NDArray]]) -> NDArray[np.float64]:
    """(N, k, 3) the paths when the last record was made."""
    paths = news[0]["own_paths"]
    for new in news[1:]:
        tails, shared = new["own_paths"], shared_steps(paths)
        paths = np.concatenate([np.broadcast_to(paths[:1, :shared], (len(tails), shared, 3)), tails], axis=1)
    return paths
