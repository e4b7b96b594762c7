"""A map for every particle (FastSLAM as in 2.2.3): each has drawn its own, along its own path, and is weighed by it.

Maps of particles with a common past are alike but for the last scans: they share their tiles (`TiledMap`), and resampling
copies references. A likelihood field is worked out only where a particle's beams end, and forgotten.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap
from priorlab.slam.likelihood_field import LikelihoodField, distance_to_boundary, grown, log_likelihood_of
from priorlab.slam.map_update import change_of, see_cells
from priorlab.slam.measurement import log_weights
from priorlab.slam.parameters import Parameters
from priorlab.slam.particles import Particles
from priorlab.slam.scan import Scan
from priorlab.slam.tiled_map import TiledMap


class OwnMaps:
    """The maps of all particles, and the paths along which they were drawn.

    Parameters
    ----------
    prior_map : m_0, with which every particle starts
    n_particles : how many start
    parameters : of the measurement and the update

    Attributes
    ----------
    maps : a `TiledMap` per particle, without the scans of the last `lag_m` metres; the drawn copies of a particle share it
    paths : (N, k, 3) the poses of every particle and of those that it was drawn from; metres
    heaviest : number of the particle that weighed most when a scan last weighed
    """

    def __init__(self, prior_map: GridMap, n_particles: int, parameters: Parameters) -> None:
        self.maps = [TiledMap(prior_map.log_odds, {})] * n_particles
        self.paths = np.empty((n_particles, 0, 3))
        self.heaviest = 0
        self._grid, self._parameters = prior_map.grid, parameters
        self._waiting: deque[tuple[float, int, Scan]] = deque()  # way, step and scan of those that no map holds yet
        # one image for all fields: each writes only the window in which its beams end, and nothing else is read
        self._field = LikelihoodField(np.empty(self._grid.shape, dtype=np.float32), self._grid, parameters)

    def weigh(self, particles: Particles, scan: Scan) -> Particles:
        """w_k^[j] = MeasurementModel(z_k, x_k^[j], m_{k-1}^[j]): every particle by the field of its own map (algorithm 6.2)."""
        logs = [self._log_weight(pose, own, scan) for pose, own in zip(particles.poses, self.maps, strict=True)]
        return Particles(particles.poses, particles.log_weights + np.array(logs))

    def update(self, weighed: Particles, particles: Particles, scan: Scan, way_m: float) -> None:
        """Go on with the particles that were drawn, and put the scans of places left behind (`lag_m`) into their maps.

        Parameters
        ----------
        weighed : the particles before resampling, in the order of `maps`
        particles : those that go on; `ancestors` tells which each was drawn from
        scan : z_k
        way_m : metres of way up to here
        """
        ancestors = np.arange(len(weighed)) if particles.ancestors is None else particles.ancestors
        self.maps = [self.maps[ancestor] for ancestor in ancestors.tolist()]
        self.paths = np.concatenate([self.paths[ancestors], particles.poses[:, None]], axis=1)
        if np.ptp(weighed.log_weights) > 0:
            self.heaviest = int(np.argmax(weighed.log_weights[ancestors]))
        else:  # nobody weighs more than others: go on with a copy of the one before, or with any when it has none
            self.heaviest = int(np.argmax(ancestors == self.heaviest))
        self._draw_left(self.paths.shape[1] - 1, scan, way_m)

    def redraw(self, paths: NDArray[np.float64], heaviest: int, scans: Sequence[Scan], way_m: NDArray[np.float64]) -> None:
        """Maps that stand at the start as they were once these paths had been driven: paths are all there is to remember of them.

        Parameters
        ----------
        paths, heaviest : as they were
        scans, way_m : of the first k steps
        """
        self.maps, self.paths, self.heaviest = [self.maps[0]] * len(paths), paths, heaviest
        for step, scan in enumerate(scans):
            self._draw_left(step, scan, float(way_m[step]))

    def map_of_heaviest(self) -> NDArray[np.float64]:
        """(rows, cols) log odds of the heaviest particle's map, with the scans that still wait."""
        own = self.maps[self.heaviest : self.heaviest + 1]
        for _, step, scan in self._waiting:
            own = self._with_scan(own, self.paths[self.heaviest, step : step + 1], scan)
        return own[0].whole()

    @property
    def nbytes(self) -> int:
        """Memory of all tiles, each counted once."""
        return sum({id(tile): tile.nbytes for own in self.maps for tile in own.tiles.values()}.values())

    def _draw_left(self, step: int, scan: Scan, way_m: float) -> None:
        """Let the scan of a step wait, and draw those that are `lag_m` behind, each from the particle's own pose of that time."""
        self._waiting.append((way_m, step, scan))
        while self._waiting and self._waiting[0][0] <= way_m - self._parameters.lag_m:
            _, then, left = self._waiting.popleft()
            self.maps = self._with_scan(self.maps, self.paths[:, then], left)

    def _with_scan(self, maps: list[TiledMap], poses: NDArray[np.float64], scan: Scan) -> list[TiledMap]:
        """The maps with one more scan each, from the pose of each; particles that share map and pose share the new map."""
        new: dict[tuple[int, bytes], TiledMap] = {}
        keys = [(id(own), pose.tobytes()) for own, pose in zip(maps, poses, strict=True)]
        for key, own, pose in zip(keys, maps, poses, strict=True):
            if key not in new:
                seen = see_cells(self._grid, pose, scan, self._parameters)
                new[key] = own.changed((seen.rows, seen.cols), change_of(seen, own.prior, self._parameters))
        return [new[key] for key in keys]

    def _log_weight(self, pose: NDArray[np.float64], own: TiledMap, scan: Scan) -> float:
        """Log of one particle's weight."""
        if len(scan) == 0:
            return 0.0
        field, parameters, cell_m = self._field, self._parameters, self._grid.cell_size_m
        rows, cols = _window_of_ends(pose, scan, self._grid)
        needed = grown(rows, cols, math.ceil(parameters.max_distance_m / cell_m) + 1, self._grid.shape)
        distance = distance_to_boundary(field.occupied(own.read(needed)), parameters.max_distance_m / cell_m)
        ends = tuple(slice(e.start - n.start, e.stop - n.start) for e, n in zip((rows, cols), needed, strict=True))
        field.image[rows, cols] = log_likelihood_of(distance[ends] * cell_m, parameters)
        return float(log_weights(pose[None], scan, field)[0])


def _window_of_ends(pose: NDArray[np.float64], scan: Scan, grid: Grid) -> tuple[slice, slice]:
    """The cells in which the beams end, with one more all round for rounding, as far as they lie on the map."""
    x, y, theta = pose
    points = scan.points
    cos, sin = np.cos(theta), np.sin(theta)
    ends = np.column_stack([x + cos * points[:, 0] - sin * points[:, 1], y + sin * points[:, 0] + cos * points[:, 1]])
    cells = grid.xy_to_cell(grid.metres_to_xy(ends))
    low = np.clip(cells.min(axis=0) - 1, 0, grid.shape)
    high = np.clip(cells.max(axis=0) + 2, low, grid.shape)
    return slice(int(low[0]), int(high[0])), slice(int(low[1]), int(high[1]))
