"""The thesis's way: a table of 10 x 10 priors, and straight lines between them (thesis 4.6, fig. 4.5).

The true functions are steps, with a cliff where p times the factor passes the threshold; the lines cross it on a slope. The
thesis expects little of a higher order (its chapter 7): cubic convolution (Keys, 1981), which is Matlab's "cubic", can be tried.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.optimize.sweep import Sweep
from priorlab.optimize.table import Table


@dataclass(frozen=True)
class InterpolationError:
    """How far the lines lie from the truth, in one measure, over a fine grid.

    Parameters
    ----------
    measure : its name
    mean, largest : absolute error
    p_wall, p_space : where it is largest
    left_out : share of the pairs at which the table or the truth has no value (nothing detected)
    """

    measure: str
    mean: float
    largest: float
    p_wall: float
    p_space: float
    left_out: float

    def __repr__(self) -> str:
        return (
            f"InterpolationError({self.measure}: mean {self.mean:.3f}, largest {self.largest:.3f} "
            f"at p_wall {self.p_wall:.3f}, p_space {self.p_space:.3f})"
        )


@dataclass(frozen=True, eq=False)
class Interpolation:
    """Precision, recall and F-beta for any pair, from a coarse table.

    Parameters
    ----------
    table : the priors that were tried
    order : 1 for straight lines, 3 for cubic convolution, which looks at 4 x 4 pairs and may overshoot
    """

    table: Table
    order: int = 1

    def __post_init__(self) -> None:
        if self.order not in (1, 3):
            raise ValueError(f"order must be 1 (straight lines) or 3 (cubic), got {self.order}")
        for name in ("p_wall", "p_space"):
            steps = np.diff(getattr(self.table, name))
            if self.order == 3 and (len(steps) < 2 or not np.allclose(steps, steps[0])):
                raise ValueError(f"{name} must be at least 3 values, evenly spread, for order 3, got {len(steps) + 1} values")

    def at(self, measure: str, p_wall: ArrayLike, p_space: ArrayLike) -> NDArray[np.float64]:
        """A measure of the table ("precision", "recall", "f_beta", "false_positive_rate") between its priors.

        Parameters
        ----------
        measure : the name of one of the table's arrays
        p_wall, p_space : pairs, broadcast; inside the table

        Returns
        -------
        The values; nan beside a pair of the table at which nothing was detected.
        """
        values = getattr(self.table, measure)
        row, down = _between(self.table.p_wall, "p_wall", p_wall)
        col, across = _between(self.table.p_space, "p_space", p_space)
        if self.order == 3:
            return _cubic(values, row, down, col, across)
        upper = _mix(values[row, col], values[row, col + 1], across)
        lower = _mix(values[row + 1, col], values[row + 1, col + 1], across)
        return _mix(upper, lower, down)

    def error(self, sweep: Sweep, measure: str = "precision", n: int = 181) -> InterpolationError:
        """Compare with the exact sweep on n x n pairs over the table's range."""
        walls = np.linspace(self.table.p_wall[0], self.table.p_wall[-1], n)
        spaces = np.linspace(self.table.p_space[0], self.table.p_space[-1], n)
        exact = getattr(sweep.grid(walls, spaces), measure)
        apart = np.abs(self.at(measure, walls[:, None], spaces) - exact)
        known = ~np.isnan(apart)
        if not known.any():
            return InterpolationError(measure, float("nan"), float("nan"), float("nan"), float("nan"), 1.0)
        row, col = np.unravel_index(np.nanargmax(apart), apart.shape)
        return InterpolationError(
            measure,
            mean=float(apart[known].mean()),
            largest=float(apart[row, col]),
            p_wall=float(walls[row]),
            p_space=float(spaces[col]),
            left_out=float(1 - known.mean()),
        )


def interpolate(sweep: Sweep, n: int = 10, order: int = 1) -> Interpolation:
    """The thesis's table of n x n priors over [0.1, 1], ready to be read between its points by lines or cubics."""
    return Interpolation(sweep.grid(n), order)


def _between(axis: NDArray[np.float64], name: str, p: ArrayLike) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """The interval of the axis that holds each value, and how far along it lies, 0 to 1."""
    p = np.asarray(p, dtype=np.float64)
    inside = (p >= axis[0]) & (p <= axis[-1])
    if not inside.all():
        raise ValueError(f"{name} must lie in the table's range [{axis[0]:g}, {axis[-1]:g}], got {p[~inside].flat[0]:g}")
    start = np.searchsorted(axis, p, side="right").clip(1, len(axis) - 1) - 1
    return start, (p - axis[start]) / (axis[start + 1] - axis[start])


def _mix(first: NDArray, second: NDArray, share: NDArray) -> NDArray[np.float64]:
    """A share of the way from the first to the second; on an end the other does not count, not even a nan."""
    mixed = first + share * (second - first)
    return np.where(share == 0, first, np.where(share == 1, second, mixed))


def _cubic(values: NDArray, row: NDArray, down: NDArray, col: NDArray, across: NDArray) -> NDArray[np.float64]:
    """Cubic convolution of the 4 x 4 values round each pair; what has no weight does not count, not even a nan."""
    padded = _beyond_the_ends(_beyond_the_ends(values).T).T
    row, down, col, across = np.broadcast_arrays(row, down, col, across)
    mixed = np.zeros(row.shape)
    for i, of_row in enumerate(_keys_weights(down)):
        for j, of_col in enumerate(_keys_weights(across)):
            weight = of_row * of_col
            mixed += np.where(weight == 0, 0.0, weight * padded[row + i, col + j])
    return mixed


def _keys_weights(share: NDArray[np.float64]) -> tuple[NDArray[np.float64], ...]:
    """Weights of the value before an interval, its two ends and the value after it, for a share of the way along it."""
    s, s2, s3 = share, share**2, share**3
    return (-s3 + 2 * s2 - s) / 2, (3 * s3 - 5 * s2 + 2) / 2, (-3 * s3 + 4 * s2 + s) / 2, (s3 - s2) / 2


def _beyond_the_ends(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """The table with a row before and a row after it, on the parabola through the three next to it (Keys's border)."""
    before = 3 * values[0] - 3 * values[1] + values[2]
    after = 3 * values[-1] - 3 * values[-2] + values[-3]
    return np.concatenate([before[None], values, after[None]])
