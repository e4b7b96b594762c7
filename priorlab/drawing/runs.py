"""Runs: the maximal straight pieces of ink along an axis. Axis 1 is horizontal, axis 0 vertical."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def label_runs(mask: NDArray[np.bool_], axis: int) -> NDArray[np.int32]:
    """Number every run along `axis` from 1; 0 outside.

    >>> label_runs(np.array([[1, 1, 0, 1]], dtype=bool), axis=1).tolist()
    [[1, 1, 0, 2]]
    """
    rows = mask if axis == 1 else np.ascontiguousarray(mask.T)
    starts = rows.copy()
    starts[:, 1:] &= ~rows[:, :-1]
    labels = np.cumsum(starts.ravel(), dtype=np.int32).reshape(rows.shape) * rows
    return labels if axis == 1 else labels.T


def run_lengths(mask: NDArray[np.bool_], axis: int) -> NDArray[np.int32]:
    """Length of the run that each pixel lies in; 0 outside.

    >>> run_lengths(np.array([[1, 1, 0, 1]], dtype=bool), axis=1).tolist()
    [[2, 2, 0, 1]]
    """
    rows = mask if axis == 1 else mask.T
    padded = np.zeros((rows.shape[0], rows.shape[1] + 1), dtype=bool)  # a white column, so that no run goes on in the next row
    padded[:, :-1] = rows
    flat = padded.ravel()
    turns = np.flatnonzero(flat[1:] != flat[:-1]) + 1
    turns = np.concatenate([[0], turns]) if flat.size and flat[0] else turns
    counts = (turns[1::2] - turns[::2]).astype(np.int32)
    lengths = np.zeros(flat.shape, dtype=np.int32)
    lengths[flat] = np.repeat(counts, counts)
    found = lengths.reshape(padded.shape)[:, :-1]
    return found if axis == 1 else found.T


def grow_along(seeds: NDArray[np.bool_], ink: NDArray[np.bool_], axis: int) -> NDArray[np.bool_]:
    """All maximal runs of ink along `axis` that meet a seed: one sweep of eq. 3.16-3.19 as we read them.

    >>> ink = np.array([[1, 1, 0, 1]], dtype=bool)
    >>> grow_along(np.array([[0, 1, 0, 0]], dtype=bool), ink, axis=1).astype(int).tolist()
    [[1, 1, 0, 0]]
    """
    labels = label_runs(ink, axis)
    met = np.zeros(int(labels.max()) + 1, dtype=bool)
    met[labels[seeds]] = True
    met[0] = False
    return met[labels]


def gaps_between(mask: NDArray[np.bool_], max_gap: float, axis: int) -> NDArray[np.bool_]:
    """Empty runs of at most `max_gap` pixels along `axis` with the mask at both ends.

    >>> gaps_between(np.array([[0, 1, 0, 0, 1, 0]], dtype=bool), 2, axis=1).astype(int).tolist()
    [[0, 0, 1, 1, 0, 0]]
    """
    return gap_ends(mask, max_gap, axis) > 0


def gap_ends(mask: NDArray[np.bool_], max_gap: float, axis: int) -> NDArray[np.int32]:
    """How far the mask goes on at the ends of such gaps: for every pixel the shorter of the two runs; 0 where there is no gap.

    >>> gap_ends(np.array([[1, 1, 1, 0, 0, 1, 0, 1]], dtype=bool), 2, axis=1).tolist()
    [[0, 0, 0, 1, 1, 0, 1, 0]]
    """
    rows = mask if axis == 1 else mask.T
    width = rows.shape[1] + 1
    padded = np.zeros((rows.shape[0], width), dtype=bool)  # a white column, so that no run goes on in the next row
    padded[:, :-1] = rows
    flat = padded.ravel()
    turns = np.flatnonzero(flat[1:] != flat[:-1]) + 1
    turns = np.concatenate([[0], turns]) if flat.size and flat[0] else turns
    starts, stops = turns[::2], turns[1::2]
    before, after = stops[:-1], starts[1:]  # a gap begins where a run stops and ends where the next one starts
    gap = (before // width == after // width) & (after - before <= max_gap)
    ends = np.minimum(stops[:-1] - starts[:-1], stops[1:] - starts[1:])[gap].astype(np.int32)
    steps = np.zeros(flat.size + 1, dtype=np.int32)
    steps[before[gap]] = ends
    steps[after[gap]] -= ends
    found = np.cumsum(steps[:-1], dtype=np.int32).reshape(padded.shape)[:, :-1]
    return found if axis == 1 else found.T
