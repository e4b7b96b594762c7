"""Do precision and false positive rate always agree? (thesis 4.3.2: "a higher precision was found to result in a lower fpr")"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike


@dataclass(frozen=True)
class Discord:
    """Pairs of priors of which one has the higher precision AND the higher false positive rate.

    Parameters
    ----------
    pairs : pairs that differ in both measures
    discordant : of these, how many disagree
    worst : indices of the pair that disagrees most in precision, the better first; None when all agree
    """

    pairs: int
    discordant: int
    worst: tuple[int, int] | None

    @property
    def share(self) -> float:
        """Of the pairs; 0 when there is none."""
        return self.discordant / self.pairs if self.pairs else 0.0


def discord_of(precision: ArrayLike, false_positive_rate: ArrayLike) -> Discord:
    """Compare every pair of maps in the two measures; those that detect nothing (precision nan) are left out.

    >>> discord_of([0.9, 0.8, 0.7], [0.10, 0.05, 0.20])              # the first is more precise and has more false positives
    Discord(pairs=3, discordant=1, worst=(0, 1))
    """
    precision, rate = np.asarray(precision, dtype=np.float64).ravel(), np.asarray(false_positive_rate, dtype=np.float64).ravel()
    known = np.flatnonzero(~np.isnan(precision) & ~np.isnan(rate))
    higher = precision[known, None] - precision[known]
    more = rate[known, None] - rate[known]
    differ, wrong = (higher > 0) & (more != 0), (higher > 0) & (more > 0)
    worst = None
    if wrong.any():
        i, j = np.unravel_index(np.argmax(np.where(wrong, higher, -1.0)), wrong.shape)
        worst = (int(known[i]), int(known[j]))
    return Discord(int(differ.sum()), int(wrong.sum()), worst)
