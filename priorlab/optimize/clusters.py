"""Groups of priors on the Pareto fronts, and the thesis's shortlist (thesis 4.6.1, 4.6.2, fig. 4.8)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import check_record, check_rng, check_whole
from priorlab.optimize.front import Front
from priorlab.optimize.plateaus import Plateau, Range

SHORTLIST = (
    Plateau(Range(0.2, 0.2), Range(0.6, 1.0)),
    Plateau(Range(0.4, 0.5), Range(0.7, 0.8)),
)
"""Eq. 4.28 as printed: p_wall = 0.2 with 0.6 <= p_space <= 1, and 0.4 <= p_wall <= 0.5 with 0.7 <= p_space <= 0.8.
The second line lies in none of the three clusters that the thesis prints beside it."""


@dataclass(frozen=True, eq=False)
class Clusters:
    """Priors in groups, ordered by their centres: the lowest p_wall first.

    Parameters
    ----------
    priors : (N, 2) pairs p_wall, p_space, before the factor
    labels : (N,) group of each pair
    centres : (M, 2) mean of each group
    fronts : (N,) number of the front that each pair came from
    note : a sentence when there were fewer different priors than groups asked for, else ""
    """

    priors: NDArray[np.float64]
    labels: NDArray[np.int64]
    centres: NDArray[np.float64]
    fronts: NDArray[np.int64]
    note: str = ""

    def __len__(self) -> int:
        return len(self.centres)

    @property
    def ranges(self) -> tuple[Plateau, ...]:
        """For each group the range of its p_wall and of its p_space."""
        boxes = []
        for group in range(len(self)):
            (low_wall, low_space), (high_wall, high_space) = (
                end(self.priors[self.labels == group], axis=0).tolist() for end in (np.min, np.max)
            )
            boxes.append(Plateau(Range(low_wall, high_wall), Range(low_space, high_space)))
        return tuple(boxes)

    @property
    def shortlist(self) -> tuple[tuple[Plateau, tuple[int, ...]], ...]:
        """The two lines of eq. 4.28 as the thesis prints them, each with the groups that hold all of it."""
        return tuple((line, tuple(i for i, box in enumerate(self.ranges) if _holds(box, line))) for line in SHORTLIST)

    def __repr__(self) -> str:
        groups = "; ".join(
            f"{np.count_nonzero(self.labels == i)} at ({wall:.2f}, {space:.2f})" for i, (wall, space) in enumerate(self.centres)
        )
        return f"Clusters({groups or 'none'}{'; ' + self.note if self.note else ''})"

    def _repr_html_(self) -> str:
        names = ("cluster", "priors", "centre p_wall", "centre p_space", "p_wall", "p_space")
        head = "".join(f"<th scope='col'>{name}</th>" for name in names)
        rows = "".join(
            f"<tr><th scope='row'>{i + 1}</th><td>{np.count_nonzero(self.labels == i)}</td>"
            f"<td>{wall:.2f}</td><td>{space:.2f}</td>"
            f"<td>{box.p_wall.low:.2f} to {box.p_wall.high:.2f}</td><td>{box.p_space.low:.2f} to {box.p_space.high:.2f}</td></tr>"
            for i, ((wall, space), box) in enumerate(zip(self.centres, self.ranges, strict=True))
        )
        printed = "; ".join(
            f"{line!r}: {'in cluster ' + ', '.join(str(i + 1) for i in groups) if groups else 'in none of them'}"
            for line, groups in self.shortlist
        )
        caption = f"Shortlist as printed (eq. 4.28): {printed}. {self.note}"
        return f"<table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table><p>{caption}</p>"


def cluster(front: Front | Sequence[Front], n_clusters: int = 3, *, rng: np.random.Generator) -> Clusters:
    """Group the priors of one front, or of several drawings' fronts as one data set, with k-means (eq. 4.23-4.27).

    scikit-learn's k-means++ with 10 starts. Every prior of a front counts once.

    Parameters
    ----------
    front : one or several
    n_clusters : M; the thesis settled for 3 and tried 2 and 4
    rng : draws the starts

    Returns
    -------
    Clusters; with fewer different priors than `n_clusters`, each is a group of its own and the note says so.

    >>> p_wall, p_space = np.array([0.18, 0.2, 0.9, 1.0]), np.array([0.9, 0.8, 0.6, 0.7])
    >>> front = Front(p_wall, p_space, precision=np.array([0.9, 0.8, 0.7, 0.6]), recall=np.array([0.5, 0.6, 0.7, 0.8]))
    >>> cluster(front, n_clusters=2, rng=np.random.default_rng(0))
    Clusters(2 at (0.19, 0.85); 2 at (0.95, 0.65))
    """
    n_clusters = check_whole("n_clusters", n_clusters)
    rng = check_rng(rng)
    fronts = list(front) if isinstance(front, Iterable) and not isinstance(front, Front) else [front]
    for one in fronts:
        check_record("front", one, Front)
    priors = np.concatenate([np.empty((0, 2)), *(one.priors for one in fronts)])
    source = np.repeat(np.arange(len(fronts)), [len(one) for one in fronts])
    different = len(np.unique(priors, axis=0))
    note = ""
    if different < n_clusters:
        note = f"n_clusters must not exceed the number of different priors, got {n_clusters} for {different}: made {different}"
        n_clusters = different
    if not n_clusters:
        return Clusters(priors, np.empty(0, dtype=np.int64), np.empty((0, 2)), source, note)

    from sklearn.cluster import KMeans  # slow to import: only who clusters waits for it

    means = KMeans(n_clusters, n_init=10, random_state=int(rng.integers(2**31))).fit(priors)
    order = np.lexsort(means.cluster_centers_.T[::-1])
    labels = np.argsort(order)[means.labels_]
    return Clusters(priors, labels, means.cluster_centers_[order], source, note)


def _holds(box: Plateau, line: Plateau) -> bool:
    """True when all pairs of a line lie in a box of priors."""
    return all(
        outer.low <= inner.low and inner.high <= outer.high
        for outer, inner in ((box.p_wall, line.p_wall), (box.p_space, line.p_space))
    )
