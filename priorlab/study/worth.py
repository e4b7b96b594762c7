"""What a prior map was worth on one survey: the map with it, without it, and the prior alone (ch. 5)."""

from __future__ import annotations

import warnings
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from priorlab.core.building import Truth
from priorlab.core.grid_map import GridMap
from priorlab.core.log_odds import DETECTED_WALL
from priorlab.core.readings import Evidence
from priorlab.core.score import Score, score_map
from priorlab.mapping.overruled import OverruledSensorWarning, overruled_readings
from priorlab.mapping.update import update_map


@dataclass(frozen=True)
class Worth:
    """Scores of one survey.

    Parameters
    ----------
    informed, uninformed : of the map that started from the prior, and of the one that started from 0.5
    alone : of the prior without a reading
    seen_informed, seen_uninformed : the same two maps, only where a cell was looked at
    unseen : of the prior where nobody looked; without a prior nothing is detected there
    coverage : share of the true wall pixels that lie in a cell that was looked at
    mean_looks : looks at a seen cell
    overruled : the prior breaks eq. 2.22 for this sensor
    """

    informed: Score
    uninformed: Score
    alone: Score
    seen_informed: Score
    seen_uninformed: Score
    unseen: Score
    coverage: float
    mean_looks: float
    overruled: bool = False

    @property
    def gain_percent(self) -> float:
        """How much higher F-beta is with the prior than without, percent; nan when nothing was found without it."""
        return gain_percent(self.informed.f_beta, self.uninformed.f_beta)


def worth_of(prior_map: GridMap, evidence: Evidence, truth: Truth, lam: float = 1.0, threshold: float = DETECTED_WALL) -> Worth:
    """Score the map of a prior against the map without one, on the same readings.

    Parameters
    ----------
    prior_map : any prior on the evidence's grid
    evidence : what a survey has seen
    truth : walls and don't-care pixels
    lam, threshold : as in `update_map` and `score_map`
    """
    grid = prior_map.grid
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", OverruledSensorWarning)  # told in `overruled`
        informed = update_map(prior_map, evidence, lam)
    uninformed = update_map(GridMap(np.zeros(grid.shape), grid), evidence, lam)
    seen = grid.to_image(evidence.seen)
    only_seen, only_unseen = _only(truth, seen), _only(truth, ~seen)
    walls = truth.walls & ~truth.ignore
    sensor, prior = evidence.sensor, prior_map.prior
    return Worth(
        informed=score_map(informed, truth, threshold),
        uninformed=score_map(uninformed, truth, threshold),
        alone=score_map(prior_map, truth, threshold),
        seen_informed=score_map(informed, only_seen, threshold),
        seen_uninformed=score_map(uninformed, only_seen, threshold),
        unseen=score_map(informed, only_unseen, threshold),
        coverage=float(seen[walls].mean()) if walls.any() else float("nan"),
        mean_looks=evidence.mean_looks,
        overruled=prior is not None and bool(overruled_readings(prior, sensor.p_free, sensor.p_occupied, lam)),
    )


def gain_percent(informed: float, uninformed: float) -> float:
    """How much higher one F-beta is than another, percent; nan when the other is 0.

    >>> round(gain_percent(0.6, 0.5), 6), gain_percent(0.6, 0.0)
    (20.0, nan)
    """
    return 100 * (informed / uninformed - 1) if uninformed else float("nan")


def _only(truth: Truth, where: NDArray[np.bool_]) -> Truth:
    """The truth of a part of the drawing; the rest is don't-care."""
    return Truth(truth.walls, truth.ignore | ~where)
