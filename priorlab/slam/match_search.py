"""The best of all poses of a window, without scoring them all: branch and bound on max-pooled log likelihoods.

The poses are those that lie whole cells and whole steps of the heading from the guess. A block of s x s of them (s = 2, 4, 8,
...) shares one bound: every beam takes the largest log likelihood that it meets anywhere in the block (Olson 2009), the guess
its nearest corner. The most promising blocks are opened first, and what promises no more than the best pose found is dropped.
A pose never scores more than its block, so the best of all poses is found.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from priorlab.slam.likelihood_field import LikelihoodField

WIDEST_LEVEL = 7
"""No block is wider than 2^7 = 128 cells."""

_AT_ONCE = 64  # blocks opened at a time: fewer open less in vain, more cost fewer calls


@dataclass(frozen=True)
class Best:
    """The best pose of a window.

    Parameters
    ----------
    step : (3,) x, y in metres and turn in radians from the guess
    score : log likelihood of scan and guess
    n_scored : blocks and poses that were scored to find it
    """

    step: NDArray[np.float64]
    score: float
    n_scored: int


def find_best(
    points: NDArray[np.float64],
    field: LikelihoodField,
    guess: NDArray[np.float64],
    turns: NDArray[np.float64],
    steps: int,
    spread: NDArray[np.float64],
) -> Best:
    """The pose with the largest score = temper * (sum of the beams' log likelihoods) - (step / spread)^2 / 2.

    Parameters
    ----------
    points : (B, 2) ends of the beams in the robot's frame, metres
    field : of the map
    guess : (3,) pose in the middle of the window
    turns : (K,) turns from the guess, radians
    steps : cells to every side
    spread : (3,) standard deviations of the guess: x, y, theta
    """
    cell_m = field.grid.cell_size_m
    turn_penalty, step_penalty = 0.5 * np.square(turns / spread[2]), 0.5 * np.square(cell_m / spread[:2])
    rows, cols = _cells(points, field, guess, turns)
    top_level = min(max((2 * steps + 1).bit_length() - 2, 1), WIDEST_LEVEL)  # three to five blocks to a side, mostly
    reach = steps + (1 << top_level)
    top, left = rows.min() - reach, cols.min() - reach
    image = _cut(field, top, rows.max() + reach + 1, left, cols.max() + reach + 1)
    levels = _pooled(image, top_level)
    height, width = image.shape
    ends = (rows - top) * width + cols - left  # (K, B) places in the flat image

    def score(level: NDArray, turn: NDArray, down: NDArray, right: NDArray) -> NDArray[np.float64]:
        """Bounds of blocks; of level 0, the scores themselves."""
        places = ends[turn] + (level * (height * width) + down * width + right)[:, None]
        fits = levels.take(places).sum(axis=1, dtype=np.float64)
        last = (1 << level) - 1
        up, across = (np.clip(0, first, first + last) for first in (down, right))  # of the block, what is nearest to the guess
        penalty = turn_penalty[turn] + step_penalty[0] * across**2 + step_penalty[1] * up**2
        return field.parameters.temper * fits - penalty

    side = np.arange(-steps, steps + 1, 1 << top_level)
    axes = np.meshgrid([top_level], np.arange(len(turns)), side, side, indexing="ij")
    blocks = np.stack([axis.ravel() for axis in axes])  # (4, M) level, turn, down, right
    bounds = score(*blocks)
    best, best_pose, n_scored = -np.inf, blocks[:, 0], len(bounds)
    while len(bounds):
        first = np.argsort(-bounds, kind="stable")[:_AT_ONCE]
        inner = _open(blocks[:, first], steps)
        promised = score(*inner)
        n_scored += len(promised)
        is_pose = inner[0] == 0
        if is_pose.any():
            winner = np.argmax(np.where(is_pose, promised, -np.inf))
            if promised[winner] > best:
                best, best_pose = float(promised[winner]), inner[:, winner]
        blocks = np.hstack([np.delete(blocks, first, axis=1), inner[:, ~is_pose]])
        bounds = np.concatenate([np.delete(bounds, first), promised[~is_pose]])
        keep = bounds > best
        blocks, bounds = blocks[:, keep], bounds[keep]
    _, turn, down, right = best_pose
    return Best(np.array([right * cell_m, -down * cell_m, turns[turn]]), best, n_scored)


def _cells(
    points: NDArray[np.float64], field: LikelihoodField, guess: NDArray[np.float64], turns: NDArray[np.float64]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """(K, B) row and column that every beam ends in, after every turn."""
    heading = (guess[2] + turns)[:, None]
    x = guess[0] + points[:, 0] * np.cos(heading) - points[:, 1] * np.sin(heading)
    y = guess[1] + points[:, 0] * np.sin(heading) + points[:, 1] * np.cos(heading)
    (_, _, col_1), (_, row_y, row_1) = field.grid.metres_to_cells
    rows, cols = np.floor(row_y * y + row_1 + 0.5), np.floor(-row_y * x + col_1 + 0.5)
    return rows.astype(np.int64), cols.astype(np.int64)


def _cut(field: LikelihoodField, top: int, bottom: int, left: int, right: int) -> NDArray[np.float32]:
    """A window of the field; off the map everything is far from every obstacle."""
    n_rows, n_cols = field.image.shape
    window = np.full((bottom - top, right - left), field.far, dtype=np.float32)
    rows = slice(min(max(top, 0), n_rows), max(min(bottom, n_rows), 0))
    cols = slice(min(max(left, 0), n_cols), max(min(right, n_cols), 0))
    inside = field.image[rows, cols]
    window[rows.start - top :, cols.start - left :][: inside.shape[0], : inside.shape[1]] = inside
    return window


def _pooled(image: NDArray[np.float32], top_level: int) -> NDArray[np.float32]:
    """(top_level + 1, rows, cols): at level h every cell holds the maximum of the 2^h x 2^h cells down and right of it."""
    levels = [image]
    for level in range(top_level):
        last, step = levels[-1], 1 << level
        across = last.copy()
        np.maximum(last[:, :-step], last[:, step:], out=across[:, :-step])
        square = across.copy()
        np.maximum(across[:-step], across[step:], out=square[:-step])
        levels.append(square)
    return np.stack(levels)


def _open(blocks: NDArray[np.int64], steps: int) -> NDArray[np.int64]:
    """The four quarters of every block, without those beyond the window."""
    level, turn, down, right = blocks
    half = 1 << (level - 1)
    quarters = [np.stack([level - 1, turn, down + i * half, right + j * half]) for i in (0, 1) for j in (0, 1)]
    inner = np.hstack(quarters)
    return inner[:, (inner[2] <= steps) & (inner[3] <= steps)]
