"""Figure 2.9: the log-odds curve."""

from __future__ import annotations

import numpy as np

from priorlab import plot
from priorlab.core.log_odds import log_odds
from priorlab.figures.figure import Entry, Outcome, sheet, verdict_of


def _log_odds_curve(rng: np.random.Generator) -> Outcome:
    """How straight is l(p) between 0.2 and 0.8, and outside?"""
    figure, (ax,) = sheet(1, 1, 6.0, 4.2)
    plot.log_odds_curve(ax, marks=(0.1, 0.2, 0.5, 0.8, 0.9))
    p = np.linspace(0.2, 0.8, 601)
    slope, offset = np.polyfit(p, log_odds(p), 1)
    deviation = float(np.abs(slope * p + offset - log_odds(p)).max())
    steepness = {at: 1 / (at * (1 - at)) for at in (0.5, 0.2, 0.1, 0.05)}  # dl/dp
    straight = deviation / float(np.ptp(log_odds(p)))
    numbers = {"deviation_from_line": deviation, "deviation_share": straight, "slope_at": steepness}
    return Outcome(
        figure,
        numbers,
        verdict_of([straight < 0.05, steepness[0.05] > 2 * steepness[0.2]]),
        f"between 0.2 and 0.8 the curve leaves its best line by at most {deviation:.2f} ({100 * straight:.0f} % of its "
        f"rise); its slope is "
        f"{steepness[0.5]:.1f} at 0.5, {steepness[0.2]:.2f} at 0.2 and {steepness[0.05]:.0f} at 0.05, so 'linear' is a "
        f"fair word and no border",
        "The curve of log odds over probability: nearly straight from 0.2 to 0.8, steep towards 0 and 1.",
    )


FIGURE_2_9 = Entry(
    "fig-2-9",
    "log odds over probability",
    "The log odds are linear between 0.2 and 0.8 and grow quickly outside.",
    _log_odds_curve,
)
