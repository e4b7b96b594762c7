"""Fill the gaps between the beams of a scan, where neighbours met one surface.

Far down a corridor the beams of a laser meet the wall more than a metre apart. A map of single hits is a row of dots there, and
the dots of the next scan like to lie on those of the last one: the matcher takes the robot for slower than it is.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from priorlab.slam.scan import Scan

BRIDGED_M = 1.0
"""Ends of neighbouring beams nearer than this belong to one surface. Between them no beam has looked: where a grazing view
bridges an open door, later beams through the door free it."""

_NEIGHBOURS = 1.5  # times the usual step between two bearings; a beam without a return leaves a wider one


def connect_beams(scan: Scan, cell_m: float, bridged_m: float = BRIDGED_M) -> Scan:
    """The scan with more beams, so that the ends on one surface lie at most a cell apart.

    Parameters
    ----------
    scan : with all its beams, in the order of their bearings
    cell_m : metres between the ends afterwards
    bridged_m : the widest gap that is filled, metres

    >>> wall = Scan(np.array([2.0, 2.0, 3.9]), np.array([0.0, 0.1, 0.2]), np.empty(0))
    >>> connect_beams(wall, cell_m=0.11).ranges.round(2).tolist()            # the third beam met something else
    [2.0, 2.0, 3.9, 2.0]
    """
    if len(scan) < 2:
        return scan
    ends = scan.points
    between = np.diff(ends, axis=0)
    gaps, turns = np.hypot(between[:, 0], between[:, 1]), np.abs(np.diff(scan.bearings))
    bridged = (gaps > cell_m) & (gaps < bridged_m) & (turns < _NEIGHBOURS * np.median(turns))
    n_new = np.where(bridged, np.ceil(gaps / cell_m).astype(np.int64) - 1, 0)
    gap_of_new = np.repeat(np.arange(len(gaps)), n_new)
    place = np.arange(len(gap_of_new)) - np.repeat(np.cumsum(n_new) - n_new, n_new) + 1  # 1, 2, ... in every gap
    share = place / (n_new[gap_of_new] + 1)
    new = ends[gap_of_new] + share[:, None] * between[gap_of_new] - scan.offset
    return replace(
        scan,
        ranges=np.concatenate([scan.ranges, np.hypot(new[:, 0], new[:, 1])]),
        bearings=np.concatenate([scan.bearings, np.arctan2(new[:, 1], new[:, 0])]),
    )
