"""A map that only counts, as gmapping and DP-SLAM have it (thesis 6.4): how often was a cell hit, how often seen through?

No prior plays a part, and a cell that nobody saw is not known. It is the third line beside the map with the plan and the one
that started from 0.5, made from the same poses and scans.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from priorlab.core.building import Truth
from priorlab.core.checks import check_probability, check_record
from priorlab.core.grid import Grid
from priorlab.core.measures import share
from priorlab.core.readings import Evidence
from priorlab.core.score import Score, score_mask
from priorlab.slam.recording import Run
from priorlab.slam.run_evidence import evidence_of_run

GMAPPING_THRESHOLD = 0.75
"""gmapping draws a cell as occupied when more than a quarter of its looks were hits (its `occ_thresh` 0.25)."""


@dataclass(frozen=True, eq=False)
class CountedMap:
    """Counts of looks, a cell counts at most once a scan.

    Parameters
    ----------
    hits : (rows, cols) int64, scans that met an obstacle in the cell
    misses : (rows, cols) int64, scans that saw through the cell
    grid : the cells

    >>> counted = CountedMap(np.array([[3, 1, 0, 0]]), np.array([[1, 1, 5, 0]]), Grid((1, 4)))
    >>> counted.p_empty.tolist()
    [[0.25, 0.5, 1.0, 0.5]]
    >>> counted.detected().tolist()                        # even odds are no wall, and what nobody saw is none either
    [[True, False, False, False]]
    """

    hits: NDArray[np.int64]
    misses: NDArray[np.int64]
    grid: Grid

    def __post_init__(self) -> None:
        for name in ("hits", "misses"):
            counts = np.asarray(getattr(self, name))
            if counts.shape != self.grid.shape:
                raise ValueError(f"{name} must have the grid's shape {self.grid.shape}, got {counts.shape}")
            if (counts < 0).any():
                raise ValueError(f"{name} must not be negative, got {counts.min()}")
            object.__setattr__(self, name, counts.astype(np.int64))

    @classmethod
    def of(cls, evidence: Evidence) -> CountedMap:
        """The counts behind some evidence whose every look says one of two things: S = misses l_free + hits l_occupied."""
        l_free, l_occupied = np.log([p / (1 - p) for p in (evidence.sensor.p_free, evidence.sensor.p_occupied)])
        hits = np.rint((evidence.looks * l_free - evidence.total) / (l_free - l_occupied)).astype(np.int64)
        return cls(hits, evidence.looks - hits, evidence.grid)

    @property
    def looks(self) -> NDArray[np.int64]:
        """(rows, cols) scans that said anything about the cell."""
        return self.hits + self.misses

    @property
    def seen(self) -> NDArray[np.bool_]:
        """(rows, cols) True where a cell was looked at."""
        return self.looks > 0

    @property
    def p_empty(self) -> NDArray[np.float64]:
        """(rows, cols) misses / (hits + misses); 0.5 where nobody looked."""
        return np.where(self.seen, share(self.misses, self.looks), 0.5)

    def detected(self, threshold: float = 0.5) -> NDArray[np.bool_]:
        """(rows, cols) True where a cell was seen and the share of looks that went through it is below the threshold.

        At 0.5 this is more hits than misses. The map that starts from 0.5 says the very same there when p_free and p_occupied
        lie as far from 0.5; `GMAPPING_THRESHOLD` is the one that gmapping draws with.
        """
        check_probability("threshold", threshold)
        return self.seen & (self.misses < threshold * self.looks - 1e-9)

    def score(self, truth: Truth, threshold: float = 0.5, beta: float = 2.0) -> Score:
        """How well the counts show the walls, as `score_map` has it for a map of log odds."""
        check_record("truth", truth, Truth)
        if self.grid.image_shape != truth.shape:
            raise ValueError(f"map and truth must have one shape, got {self.grid.image_shape} and {truth.shape}")
        return score_mask(self.grid.to_image(self.detected(threshold)), truth, beta, threshold)

    def __repr__(self) -> str:
        return f"CountedMap({100 * self.seen.mean():.1f} % of the cells seen, {int(self.hits.sum())} hits)"

    def _repr_png_(self) -> bytes:
        from priorlab.core.picture import encode_png, grey_of

        return encode_png(self.grid.to_image(grey_of(self.p_empty)))


def counted_map(run: Run) -> CountedMap:
    """Hits and misses of every cell from the poses and scans of a run.

    A scan hits the cells from the hit to `thickening_m` behind it and misses those before it, exactly as `see_cells` has it
    for the other two maps: what differs between the three is only how they are added up.
    """
    return CountedMap.of(evidence_of_run(run).at(len(run)))
