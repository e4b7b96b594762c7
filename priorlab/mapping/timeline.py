"""Evidence after any number of readings: looked through once, then a time slider needs no second pass."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import check_whole
from priorlab.core.grid import Grid
from priorlab.core.log_odds import log_odds
from priorlab.core.progress import Progress
from priorlab.core.readings import Evidence, Readings
from priorlab.core.sensor import RangeSensor
from priorlab.mapping.evidence import check_fit
from priorlab.robot.inverse_sensor_model import observe


@dataclass(frozen=True, eq=False)
class EvidenceOverTime:
    """Every look of every reading, in the order in which the readings were taken; made by `evidence_over_time`.

    Parameters
    ----------
    cell : (M,) flat index of the cell that was looked at
    added : (M,) logit(ISM), what the look adds to the cell's log odds
    starts : (N + 1,) where each reading's looks begin, and the end of the last
    grid : the cells
    sensor : the sensor whose model made it
    """

    cell: NDArray[np.int64] = field(repr=False)
    added: NDArray[np.float64] = field(repr=False)
    starts: NDArray[np.int64] = field(repr=False)
    grid: Grid
    sensor: RangeSensor

    def __len__(self) -> int:
        """How many readings were taken."""
        return len(self.starts) - 1

    def at(self, step: int) -> Evidence:
        """The evidence after the first `step` readings, from 0 (none) to all: what `gather_evidence(readings[:step])` gives.

        Raises
        ------
        ValueError
            When there are not so many readings.
        """
        step = check_whole("step", step, least=0)
        if step > len(self):
            raise ValueError(f"step must lie between 0 and the {len(self)} readings, got {step}")
        end, shape = int(self.starts[step]), self.grid.shape
        n_cells = shape[0] * shape[1]
        total = np.bincount(self.cell[:end], weights=self.added[:end], minlength=n_cells).astype(np.float64, copy=False)
        looks = np.bincount(self.cell[:end], minlength=n_cells)
        return Evidence(total.reshape(shape), looks.reshape(shape), self.grid, self.sensor)

    def __repr__(self) -> str:
        return f"EvidenceOverTime({len(self)} readings, {len(self.cell)} looks at cells of {self.grid.cell_size:g} px)"


def evidence_over_time(readings: Readings, grid: Grid, progress: Progress | None = None) -> EvidenceOverTime:
    """Keep what each reading says about every cell, so that the evidence after any number of them is one sum away.

    Parameters
    ----------
    readings : ranges from known poses, in the order in which they were taken
    grid : cells of any size over the same drawing
    progress : called with the readings done and the readings to do

    Raises
    ------
    ValueError
        As `gather_evidence`.

    >>> sensor = RangeSensor(max_range=3, half_angle=0.1)
    >>> twice = Readings([[0.5, 0.5, 0.0]] * 2, [[2.0]] * 2, [0.0], sensor, image_shape=(1, 6))
    >>> timeline = evidence_over_time(twice, Grid((1, 6)))
    >>> [timeline.at(step).looks.tolist() for step in range(3)]
    [[[0, 0, 0, 0, 0, 0]], [[1, 1, 1, 1, 0, 0]], [[2, 2, 2, 2, 0, 0]]]
    """
    check_fit(readings, grid)
    cells, added = [np.empty(0, dtype=np.int64)], [np.empty(0)]
    n_looks = np.zeros(len(readings) + 1, dtype=np.int64)
    for seen in observe(readings, grid, progress):
        cells.append(seen.cell)
        added.append(log_odds(seen.p_empty))
        n_looks[1:] += np.bincount(seen.reading, minlength=len(readings))
    return EvidenceOverTime(np.concatenate(cells), np.concatenate(added), np.cumsum(n_looks), grid, readings.sensor)
