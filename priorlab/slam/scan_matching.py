"""Where a scan fits best on a map, near a guess: the answer to wheels that cannot be believed (correlative, after Olson 2009).

All poses of a window round the guess are scored as algorithm 6.4 scores a particle, and the guess has its say as a Gaussian.
The best pose is found cell by cell (`match_search`), then between the cells (`match_refinement`). Along a corridor all poses
score alike; there the guess decides, and the match says that it is not to be trusted.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from priorlab.core.checks import check_poses, check_positive, check_record
from priorlab.core.pose import wrap_angle
from priorlab.slam.likelihood_field import LikelihoodField
from priorlab.slam.match_refinement import climb, information
from priorlab.slam.match_search import find_best
from priorlab.slam.measurement import share_explained
from priorlab.slam.parameters import Parameters
from priorlab.slam.scan import Scan

MATCHING = Parameters(
    n_beams=90,
    sigma_hit_m=0.05,
    z_random=0.5,
    max_distance_m=0.6,
    max_range_m=20.0,
    temper=0.5,
    p_free=0.65,
    p_occupied=0.2,
    lam=0.0,
    thickening_m=0.0,
)
"""For a laser that sees 20 m and a map of its own: what it saw is sharp, and a wall once hit outlasts rays that graze it."""

FEWEST_EXPLAINED = 0.5
"""A match is not trusted when fewer of its beams are explained: most of what the scan saw is not on the map."""

NEAR = 3.0
"""Deviations sigma_hit from an obstacle within which a beam is explained by it; farther, the field tells no distances apart."""


@dataclass(frozen=True)
class Window:
    """How far off the guess may be: a Gaussian, and the window that is searched.

    Parameters
    ----------
    spread_m, spread_turn : standard deviations of the guess; metres along x and y, radians
    reach : the window's half width, in standard deviations
    turn_step : radians between two headings that are tried

    >>> Window(spread_m=0.2, reach=2.5).half_m
    0.5
    """

    spread_m: float = 0.1
    spread_turn: float = math.radians(3.0)
    reach: float = 3.0
    turn_step: float = math.radians(0.5)

    def __post_init__(self) -> None:
        for name in ("spread_m", "spread_turn", "reach", "turn_step"):
            check_positive(name, getattr(self, name))

    @property
    def half_m(self) -> float:
        """Metres to every side."""
        return self.reach * self.spread_m

    @property
    def turns(self) -> NDArray[np.float64]:
        """(K,) turns that are tried, half a circle either way at most."""
        n = math.ceil(min(self.reach * self.spread_turn, math.pi - self.turn_step) / self.turn_step)
        return self.turn_step * np.arange(-n, n + 1, dtype=np.float64)

    @property
    def spread(self) -> NDArray[np.float64]:
        """(3,) standard deviations of x, y, theta."""
        return np.array([self.spread_m, self.spread_m, self.spread_turn])


@dataclass(frozen=True, eq=False)
class Match:
    """The pose at which a scan fits best.

    Parameters
    ----------
    pose : (3,) x, y, theta; metres
    cell : (3,) the best of the poses that were searched, before it was refined
    score : log likelihood of scan and guess at `cell`
    covariance : (3, 3) of the pose, from the curvature of the score; never wider than the guess's
    explained : share of the beams that end within three sigma_hit of an obstacle; nan for fewer than ten beams
    distrusted_because : a sentence when the scan alone does not tell the pose, else None
    n_scored : blocks and poses scored on the way
    """

    pose: NDArray[np.float64]
    cell: NDArray[np.float64]
    score: float
    covariance: NDArray[np.float64]
    explained: float
    distrusted_because: str | None
    n_scored: int

    @property
    def trusted(self) -> bool:
        """Whether the scan alone tells the pose; where it does not, the guess has decided."""
        return self.distrusted_because is None

    def __repr__(self) -> str:
        x, y, theta = self.pose
        why = "" if self.trusted else f", not trusted: {self.distrusted_because}"
        return f"Match(x {x:.2f} m, y {y:.2f} m, {math.degrees(theta):.1f} degrees{why})"


def match_scan(scan: Scan, field: LikelihoodField, guess: ArrayLike, window: Window | None = None) -> Match:
    """Look for the pose near a guess at which a scan fits best on a map.

    score(pose) = temper * sum over the beams of log(z_hit prob(dist, sigma_hit) + z_random / z_max)  (algorithm 6.4)
                  - ((x - x_guess)^2 + (y - y_guess)^2) / (2 spread_m^2) - (theta - theta_guess)^2 / (2 spread_turn^2)

    is largest at `cell` of all poses whole cells and whole `turn_step`s from the guess in the window.

    Parameters
    ----------
    scan : the beams that returned; all of them count
    field : likelihood field of the map, with the numbers of algorithm 6.4
    guess : (3,) pose by the wheels; metres
    window : how far off it may be; `Window()` by default

    >>> from priorlab.core.grid import Grid
    >>> from priorlab.core.grid_map import GridMap
    >>> walls = np.zeros((80, 100), dtype=bool); walls[9] = walls[:, 80] = True    # beyond y = 3.5 m and x = 4 m
    >>> corner = LikelihoodField.of(GridMap(np.where(walls, -2.0, 2.0), Grid(walls.shape, 1, 0.05)), MATCHING)
    >>> fan = np.linspace(-0.4, 0.4, 9)
    >>> ahead, left = 2.025 / np.cos(fan), 1.525 / np.cos(fan)             # a robot at x = 2, y = 2 looks at both
    >>> scan = Scan(np.concatenate([ahead, left]), np.concatenate([fan, fan + np.pi / 2]), np.empty(0))
    >>> match_scan(scan, corner, guess=[1.8, 2.1, 0.0])
    Match(x 2.00 m, y 2.00 m, 0.0 degrees)
    """
    window = Window() if window is None else window
    for name, value, kind in (("scan", scan, Scan), ("field", field, LikelihoodField), ("window", window, Window)):
        check_record(name, value, kind)
    start = check_poses("guess", np.atleast_2d(guess))[0]
    points, cell_m = scan.points, field.grid.cell_size_m
    spacing = np.array([cell_m, cell_m, window.turn_step])
    if len(scan) == 0:
        return Match(start, start, 0.0, np.diag(np.square(window.spread)), math.nan, "the scan met nothing", 0)
    steps = math.ceil(window.half_m / cell_m - 1e-9)
    best = find_best(points, field, start, window.turns, steps, window.spread)
    cell = start + best.step
    pose = climb(cell, points, field, start, window.spread, spacing)
    told = information(pose, points, field, spacing)
    covariance = np.asarray(np.linalg.inv(told + np.diag(1.0 / np.square(window.spread))), dtype=np.float64)
    cell[2] = wrap_angle(cell[2])
    explained = share_explained(pose, scan, field, NEAR)
    why = _distrusted_because(explained, told, best.step, steps * cell_m, window)
    return Match(pose, cell, best.score, covariance, explained, why, best.n_scored)


def _distrusted_because(
    explained: float, told: NDArray[np.float64], step: NDArray[np.float64], half_m: float, window: Window
) -> str | None:
    """Why the scan alone does not tell the pose; None when it does."""
    if math.isnan(explained):
        return "the scan has fewer than ten beams"
    if explained < FEWEST_EXPLAINED:
        return f"only {100 * explained:.0f} % of the beams end near an obstacle of the map"
    values, vectors = np.linalg.eigh(told[:2, :2])
    if values[0] * window.spread_m**2 < 1.0:
        direction = math.degrees(math.atan2(vectors[1, 0], vectors[0, 0])) % 180
        return f"along {direction:.0f} degrees the scan tells less than the guess, as in a corridor"
    if np.abs(step[:2]).max() > half_m - 1e-9 or abs(step[2]) > window.turns[-1] - 1e-9:
        return "the best pose lies on the rim of the window"
    return None
