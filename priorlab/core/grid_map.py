"""The prior's two numbers and the map of cells that they become."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import as_float, as_numbers, check_record
from priorlab.core.grid import Grid
from priorlab.core.log_odds import detected_as_wall, probability


@dataclass(frozen=True)
class Prior:
    """How much the plan is believed: P(empty) for cells where it shows a wall, and where it shows space.

    Parameters
    ----------
    p_wall, p_space : P(empty) as the thesis's sliders and tables give them, before the factor
    factor : 0.9 keeps the log odds finite (thesis 4.6); the EFFECTIVE values p * factor must lie in (0, 1)

    >>> round(Prior(p_wall=0.3, p_space=0.8).effective_p_wall, 3)      # Table 6.1
    0.27
    >>> Prior.uninformed()
    Prior(uninformed: 0.5 everywhere)
    """

    p_wall: float = 0.2
    p_space: float = 0.9
    factor: float = 0.9

    def __post_init__(self) -> None:
        for name in ("p_wall", "p_space"):
            p, factor = as_float(name, getattr(self, name)), as_float("factor", self.factor)
            if not 0.0 < p * factor < 1.0:
                raise ValueError(
                    f"the effective {name} must lie strictly between 0 and 1, got {p:g} x {factor:g} = {p * factor:g}"
                )

    @classmethod
    def uninformed(cls) -> Prior:
        """Exactly 0.5 in every cell, whatever the plan shows; no factor."""
        return cls(0.5, 0.5, factor=1.0)

    @property
    def is_uninformed(self) -> bool:
        """True when the plan is not believed at all."""
        return self.effective_p_wall == 0.5 and self.effective_p_space == 0.5

    @property
    def effective_p_wall(self) -> float:
        """P(empty) that a wall cell starts with."""
        return self.p_wall * self.factor

    @property
    def effective_p_space(self) -> float:
        """P(empty) that a space cell starts with."""
        return self.p_space * self.factor

    def __repr__(self) -> str:
        if self.is_uninformed:
            return "Prior(uninformed: 0.5 everywhere)"
        return (
            f"Prior(p_wall={self.p_wall:g}, p_space={self.p_space:g}, "
            f"effective {self.effective_p_wall:.3g} and {self.effective_p_space:.3g})"
        )


@dataclass(frozen=True, eq=False)
class GridMap:
    """A map: the log odds of P(empty) of every cell.

    Parameters
    ----------
    log_odds : (rows, cols) float64, row 0 at the top
    grid : where the cells lie
    prior : the prior that it started from, when there was one
    """

    log_odds: NDArray[np.float64]
    grid: Grid
    prior: Prior | None = None

    def __post_init__(self) -> None:
        check_record("grid", self.grid, Grid)
        if self.prior is not None:
            check_record("prior", self.prior, Prior)
        values = as_numbers("log_odds", self.log_odds)
        if values.shape != self.grid.shape:
            raise ValueError(f"log_odds must have the grid's shape {self.grid.shape}, got {values.shape}")
        if not np.isfinite(values).all():
            raise ValueError(f"log_odds must be finite numbers, got {values[~np.isfinite(values)].flat[0]:g}")
        object.__setattr__(self, "log_odds", values)

    @property
    def p_empty(self) -> NDArray[np.float64]:
        """(rows, cols) P(the cell is empty), eq. 4.21: 0 = wall, 1 = free."""
        return probability(self.log_odds)

    def detected(self, threshold: float = 0.2) -> NDArray[np.bool_]:
        """(rows, cols) True where P(empty) <= threshold: the walls of this map (eq. 4.18)."""
        return detected_as_wall(self.log_odds, threshold)

    def __repr__(self) -> str:
        rows, cols = self.grid.shape
        p = self.p_empty
        return (
            f"GridMap({cols} x {rows} cells of {self.grid.cell_size:g} px, "
            f"P(empty) {p.min():.3f} to {p.max():.3f}, {int(self.detected().sum())} cells at or below 0.2)"
        )

    def _repr_png_(self) -> bytes:
        from priorlab.core.picture import encode_png, grey_of

        return encode_png(self.grid.to_image(grey_of(self.p_empty)))
