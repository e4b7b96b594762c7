"""A drive that is under way: what changes from step to step, and what one step made of a scan."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from priorlab.core.grid_map import GridMap
from priorlab.core.readings import RobotLog
from priorlab.slam.impassable import Impassable
from priorlab.slam.lagging_field import LaggingField
from priorlab.slam.likelihood_field import LikelihoodField
from priorlab.slam.map_update import SeenCells
from priorlab.slam.own_maps import OwnMaps
from priorlab.slam.particles import Particles
from priorlab.slam.recording import Recorder
from priorlab.slam.scan import Scan


@dataclass(eq=False)
class State:
    """Where a drive stands before its next step. `FastSLAM.step` moves it on; nothing else of a run changes.

    Parameters
    ----------
    prior_map, log, plan : m_0, the drive and the field of m_0; these never change
    impassable : where m_0 lets no robot drive, or None when driving there costs nothing (`p_through_wall` 1, as printed)
    way_m : (T,) metres that the wheels have told up to a step
    weighs, resamples : (T,) steps whose scan weighs, and after which particles are drawn; the log says it beforehand
    step : number of the next step
    particles : the belief so far
    log_odds : (rows, cols) m_{k-1} as the estimates draw it; a step writes into it
    growing : the map that the robot localizes in, when it is the growing one; a step adds to it
    own : the maps of the particles, when each has its own; a step puts others in their place
    rng : for the motion and the draws; `rng.bit_generator.state` is all that there is to remember of it
    recorder : the steps that were made
    """

    prior_map: GridMap
    log: RobotLog
    plan: LikelihoodField
    impassable: Impassable | None
    way_m: NDArray[np.float64]
    weighs: NDArray[np.bool_]
    resamples: NDArray[np.bool_]
    step: int
    particles: Particles
    log_odds: NDArray[np.float64]
    growing: LaggingField | None
    own: OwnMaps | None
    rng: np.random.Generator
    recorder: Recorder

    @property
    def field(self) -> LikelihoodField:
        """The likelihood field that the next scan weighs in: of the plan, or of the map as it grows."""
        return self.growing.field if self.growing else self.plan

    @property
    def done(self) -> bool:
        """True when the log has no further step."""
        return self.step >= len(self.log)

    @property
    def map(self) -> GridMap:
        """m_{k-1}, of the heaviest particle when each has its own; a copy that the next step leaves alone."""
        log_odds_map = self.own.map_of_heaviest() if self.own else self.log_odds.copy()
        return GridMap(log_odds_map, self.prior_map.grid, self.prior_map.prior)

    def __repr__(self) -> str:
        return f"State(before step {self.step} of {len(self.log)}, {self.particles!r})"


@dataclass(frozen=True, eq=False)
class Step:
    """What one iteration of algorithm 6.1 did, part by part.

    Parameters
    ----------
    number : k
    scan : the beams that counted
    moved : the particles after the motion model; those that drove into a wall have lost weight
    weighed : the same with their weights; `moved` itself when the scan did not weigh
    pose : (3,) the estimate x, y, theta; metres
    particles : those that go on
    seen : the cells that the scan saw from the estimate
    """

    number: int
    scan: Scan
    moved: Particles
    weighed: Particles
    pose: NDArray[np.float64]
    particles: Particles
    seen: SeenCells

    def __repr__(self) -> str:
        x, y, theta = self.pose
        return (
            f"Step({self.number}: {len(self.scan)} beams, {len(self.weighed)} particles, "
            f"ESS {self.weighed.effective_number:.0f}, at x {x:.2f}, y {y:.2f} m, {np.degrees(theta):.0f} degrees)"
        )
