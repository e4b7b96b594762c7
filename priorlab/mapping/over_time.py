"""The score after every reading, for several priors at once (thesis fig. 5.9): only what a reading changes is counted."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from priorlab.core.building import Truth
from priorlab.core.checks import check_number, check_positive, check_record, check_whole
from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap
from priorlab.core.log_odds import DETECTED_WALL, detection_limit
from priorlab.core.measures import f_beta_of, share
from priorlab.core.progress import Progress
from priorlab.core.readings import Readings
from priorlab.mapping.overruled import warn_when_overruled
from priorlab.mapping.timeline import EvidenceOverTime, evidence_over_time

LOOKS_AT_ONCE = 500_000
"""Looks that are weighed in one go: enough for speed, little for memory."""


@dataclass(frozen=True, eq=False)
class OverTime:
    """Scores after so many readings, a curve for every prior.

    Parameters
    ----------
    steps : (K,) readings taken; the first is 0, where each map is its prior alone
    tp, fp : by the prior's name, (K,) true and false wall pixels detected
    positives, negatives : counted true-wall and empty pixels
    seen : (K,) share of the cells that were looked at
    beta : weight of recall in F-beta
    """

    steps: NDArray[np.int64]
    tp: dict[str, NDArray[np.int64]] = field(repr=False)
    fp: dict[str, NDArray[np.int64]] = field(repr=False)
    positives: int
    negatives: int
    seen: NDArray[np.float64] = field(repr=False)
    beta: float = 2.0

    @property
    def names(self) -> tuple[str, ...]:
        """Of the priors."""
        return tuple(self.tp)

    @cached_property
    def precision(self) -> dict[str, NDArray[np.float64]]:
        """(K,) by name; nan where nothing was detected."""
        return {name: share(self.tp[name], self.tp[name] + self.fp[name]) for name in self.tp}

    @cached_property
    def recall(self) -> dict[str, NDArray[np.float64]]:
        """(K,) by name; nan when there is no wall."""
        return {name: share(self.tp[name], self.positives) for name in self.tp}

    @cached_property
    def false_positive_rate(self) -> dict[str, NDArray[np.float64]]:
        """(K,) by name; nan when everything is wall."""
        return {name: share(self.fp[name], self.negatives) for name in self.tp}

    @cached_property
    def f_beta(self) -> dict[str, NDArray[np.float64]]:
        """(K,) by name, eq. 5.1; 0 where nothing was detected rightly."""
        return {name: f_beta_of(self.tp[name], self.fp[name], self.positives, self.beta) for name in self.tp}

    def __repr__(self) -> str:
        curves = ", ".join(f"{name} {curve[0]:.3f} to {curve[-1]:.3f}" for name, curve in self.f_beta.items())
        return f"OverTime({self.steps[-1]} readings, F{self.beta:g}: {curves})"


def score_over_time(
    readings: Readings | EvidenceOverTime,
    prior_maps: Mapping[str, GridMap],
    truth: Truth,
    lam: float = 1.0,
    threshold: float = DETECTED_WALL,
    beta: float = 2.0,
    every: int = 1,
    progress: Progress | None = None,
) -> OverTime:
    """Score the map of every prior after 0, 1, 2, ... readings: fig. 5.9 in one pass.

    A reading changes the cells that it sees and no other, so the counts of pixels are carried on from reading to reading.
    They are those of `score_map(update_map(prior_map, evidence), truth)`, to the last pixel.

    Parameters
    ----------
    readings : in the order in which they were taken; or what `evidence_over_time` made of them
    prior_maps : by name, where each map starts; all on one grid
    truth : walls and don't-care pixels
    lam, threshold, beta : as in `update_map` and `score_map`
    every : report after every so many readings, and after the last
    progress : called with the readings done and the readings to do; where they are looked through first, each counts twice

    Raises
    ------
    ValueError
        When there is no prior map, or maps, readings and truth do not belong together.

    Warns
    -----
    OverruledSensorWarning
        When a prior is so sure that a confirming reading carries no information (eq. 2.22).
    """
    check_record("readings", readings, Readings, EvidenceOverTime)
    check_record("prior_maps", prior_maps, Mapping)
    check_record("truth", truth, Truth)
    grid = _check_priors(prior_maps, truth)
    lam, every = check_number("lam", lam), check_whole("every", every)
    check_positive("beta", beta)
    looked_through, scored = _two_passes(progress) if isinstance(readings, Readings) else (None, progress)
    timeline = evidence_over_time(readings, grid, looked_through) if isinstance(readings, Readings) else readings
    if timeline.grid != grid:
        raise ValueError(f"map and evidence must lie on one grid, got {grid} and {timeline.grid}")
    for prior_map in prior_maps.values():
        warn_when_overruled(prior_map.prior, timeline.sensor.p_free, timeline.sensor.p_occupied, lam)

    counted = ~truth.ignore
    positive = grid.sum_in_cells(truth.walls & counted).ravel()
    pixels = np.stack([positive, grid.sum_in_cells(counted).ravel() - positive])  # (2, cells)
    starts = {name: prior_map.log_odds.ravel() for name, prior_map in prior_maps.items()}
    limit = detection_limit(threshold)
    changes = {name: np.zeros((2, len(timeline) + 1), dtype=np.int64) for name in starts}
    new_cells = np.zeros(len(timeline) + 1)
    for name, l_0 in starts.items():
        changes[name][:, 0] = pixels[:, l_0 <= limit].sum(axis=1)
    for looks in _looks_in_order(timeline, scored):
        new_cells += np.bincount(looks.step, weights=looks.n == 0, minlength=len(new_cells))
        for name, l_0 in starts.items():
            changes[name] += _changed_pixels(looks, l_0[looks.cell], lam, limit, pixels, len(new_cells))

    steps = np.unique(np.append(np.arange(0, len(timeline) + 1, every), len(timeline)))
    counts = {name: np.cumsum(change, axis=1)[:, steps] for name, change in changes.items()}
    return OverTime(
        steps=steps,
        tp={name: tp for name, (tp, _) in counts.items()},
        fp={name: fp for name, (_, fp) in counts.items()},
        positives=int(pixels[0].sum()),
        negatives=int(pixels[1].sum()),
        seen=np.cumsum(new_cells)[steps] / pixels.shape[1],
        beta=beta,
    )


def _two_passes(progress: Progress | None) -> tuple[Progress | None, Progress | None]:
    """Progress for the first and for the second time that all readings are gone through."""
    if progress is None:
        return None, None
    return lambda done, to_do: progress(done, 2 * to_do), lambda done, to_do: progress(to_do + done, 2 * to_do)


class _Looks(NamedTuple):
    """Looks at cells, in order: after `step` readings the cell, seen `n` times with the sum `total`, gets `added` more."""

    step: NDArray[np.int64]
    cell: NDArray[np.int64]
    n: NDArray[np.int64]
    total: NDArray[np.float64]
    added: NDArray[np.float64]


def _looks_in_order(timeline: EvidenceOverTime, progress: Progress | None) -> Iterator[_Looks]:
    """Every look with what its cell had seen before, some readings at a time."""
    n_cells = timeline.grid.shape[0] * timeline.grid.shape[1]
    total, n = np.zeros(n_cells), np.zeros(n_cells, dtype=np.int64)
    starts = timeline.starts.tolist()
    cell, added = timeline.cell, timeline.added
    first = 0
    while first < len(timeline):
        last = max(first + 1, int(np.searchsorted(timeline.starts, starts[first] + LOOKS_AT_ONCE, side="right")) - 1)
        n_before = np.empty(starts[last] - starts[first], dtype=np.int64)
        total_before = np.empty(len(n_before))
        for k in range(first, last):
            start, end = starts[k], starts[k + 1]
            here = slice(start - starts[first], end - starts[first])
            cells = cell[start:end]  # each once, so that they can be counted on at once
            n_before[here], total_before[here] = n[cells], total[cells]
            n[cells] += 1
            total[cells] = total_before[here] + added[start:end]
        some = slice(starts[first], starts[last])
        step = np.repeat(np.arange(first, last), np.diff(timeline.starts[first : last + 1])) + 1
        yield _Looks(step, cell[some], n_before, total_before, added[some])
        if progress:
            progress(last, len(timeline))
        first = last


def _changed_pixels(
    looks: _Looks, l_0: NDArray[np.float64], lam: float, limit: float, pixels: NDArray[np.int64], n_steps: int
) -> NDArray[np.int64]:
    """(2, n_steps) true and false pixels that each step detects more than the one before, for the prior `l_0` of each look."""
    before = l_0 + looks.total - lam * looks.n * l_0 <= limit
    after = l_0 + (looks.total + looks.added) - lam * (looks.n + 1) * l_0 <= limit
    changed = np.flatnonzero(before != after)
    step, cell, sign = looks.step[changed], looks.cell[changed], np.where(after[changed], 1, -1)
    # counts of pixels are exact in float64
    return np.stack([np.bincount(step, weights=sign * kind[cell], minlength=n_steps) for kind in pixels]).astype(np.int64)


def _check_priors(prior_maps: Mapping[str, GridMap], truth: Truth) -> Grid:
    """The grid of all maps, or a sentence."""
    if not prior_maps:
        raise ValueError("prior_maps must hold at least one prior map, got none")
    for name, prior_map in prior_maps.items():
        check_record(f"prior_maps[{name!r}]", prior_map, GridMap)
    grid = next(iter(prior_maps.values())).grid
    for name, prior_map in prior_maps.items():
        if prior_map.grid != grid:
            raise ValueError(f"prior_maps must lie on one grid, got {grid} and, for {name!r}, {prior_map.grid}")
    if grid.image_shape != truth.shape:
        raise ValueError(f"map and truth must have one shape, got {grid.image_shape} and {truth.shape}")
    return grid
