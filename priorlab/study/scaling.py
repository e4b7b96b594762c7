"""What mapping costs as drawings and surveys grow: time and memory of every step, on offices made of rooms of one size."""

from __future__ import annotations

import time
import tracemalloc
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from priorlab.core.building import Truth
from priorlab.core.drawing import Walls
from priorlab.core.progress import Progress
from priorlab.core.score import score_map
from priorlab.core.sensor import RangeSensor
from priorlab.core.survey import look_around
from priorlab.mapping.evidence import gather_evidence
from priorlab.mapping.prior import build_prior_map
from priorlab.mapping.update import update_map
from priorlab.optimize.experiment import Experiment
from priorlab.robot.explore import explore

ROOM = 100
"""Side of a room, pixels."""

PIXELS_PER_POSE = 300
"""One pose for so many pixels: 1,600 poses on 600 x 800 pixels."""

PER_POSE = ("ranges", "evidence")
"""The steps whose cost grows with the poses; that of the others grows with the pixels."""

Result = TypeVar("Result")


@dataclass(frozen=True)
class Cost:
    """What one office cost.

    Parameters
    ----------
    side : of the square drawing, pixels
    poses : of the survey
    seconds : by step, of the processor; the least of some repeats
    peak_mb : most memory that was held at once, the drawing and all results included; 10^6 bytes; nan when not measured
    """

    side: int
    poses: int
    seconds: dict[str, float]
    peak_mb: float = float("nan")

    @property
    def pixels(self) -> int:
        """Of the drawing."""
        return self.side**2

    @property
    def pose_seconds(self) -> float:
        """Time of the steps that look from every pose."""
        return sum(self.seconds[step] for step in PER_POSE)

    @property
    def pixel_seconds(self) -> float:
        """Time of the steps that look at every pixel or cell."""
        return sum(self.seconds.values()) - self.pose_seconds


def office(side: int, n_poses: int | None = None) -> tuple[Truth, NDArray[np.float64]]:
    """A square office of rooms of 100 px with walls of 4 px and doors of 30 px, and a survey of it.

    Parameters
    ----------
    side : pixels, at least one room
    n_poses : spread evenly over the building; one for 300 pixels when not given

    >>> truth, survey = office(200)
    >>> truth.shape, survey.shape
    ((200, 200), (133, 3))
    """
    if side < ROOM:
        raise ValueError(f"side must be at least {ROOM} pixels, got {side}")
    room = np.zeros((ROOM, ROOM), dtype=bool)
    room[:4] = room[:, :4] = True
    room[:4, 35:65] = room[35:65, :4] = False
    rooms = side // ROOM
    walls = np.zeros((side, side), dtype=bool)
    walls[: rooms * ROOM, : rooms * ROOM] = np.tile(room, (rooms, rooms))
    n_poses = side**2 // PIXELS_PER_POSE if n_poses is None else n_poses
    lines = [  # three lines across each room, where the poses look up and down in turn
        ((left + 12.5, side - top - y), (left + 92.5, side - top - y))
        for top in range(0, rooms * ROOM, ROOM)
        for left in range(0, rooms * ROOM, ROOM)
        for y in (25.5, 55.5, 85.5)
    ]
    survey = look_around(lines, spacing=80 / max(1, n_poses / len(lines)))
    chosen = np.linspace(0, len(survey) - 1, n_poses).astype(int)
    return Truth(walls, np.zeros_like(walls)), survey[chosen]


def measure_cost(side: int, n_poses: int | None = None, cell_size: float = 3, repeats: int = 1) -> Cost:
    """Map an office once from end to end and time each step.

    Parameters
    ----------
    side, n_poses : as in `office`
    cell_size : pixels
    repeats : the least time of so many counts; a machine has other things to do
    """
    truth, survey = office(side, n_poses)
    walls = Walls(truth.walls.astype(np.uint8))
    seconds: dict[str, float] = {}

    def timed(step: str, work: Callable[[], Result]) -> Result:
        """Do a step, and remember its time."""
        for _ in range(repeats):
            start = time.process_time()  # a busy machine changes it less than the clock on the wall
            result = work()
            seconds[step] = min(seconds.get(step, np.inf), time.process_time() - start)
        return result

    readings = timed("ranges", lambda: explore(truth, survey, RangeSensor()))
    prior_map = timed("prior map", lambda: build_prior_map(walls, cell_size=cell_size))
    evidence = timed("evidence", lambda: gather_evidence(readings, prior_map.grid))
    posterior = timed("map", lambda: update_map(prior_map, evidence))
    timed("score", lambda: score_map(posterior, truth))
    timed("sweep", lambda: Experiment(walls, evidence, truth).sweep())
    return Cost(side, len(survey), seconds)


def measure_peak(side: int, n_poses: int | None = None, cell_size: float = 3) -> float:
    """Most memory held at once while an office is mapped, 10^6 bytes (by tracemalloc: what NumPy and Python ask for)."""
    tracemalloc.start()
    try:
        measure_cost(side, n_poses, cell_size)
        return tracemalloc.get_traced_memory()[1] / 1e6
    finally:
        tracemalloc.stop()


def cost_by_size(
    sides: Sequence[int] = (500, 1000, 2000, 4000), cell_size: float = 3, repeats: int = 2, progress: Progress | None = None
) -> list[Cost]:
    """The cost of larger and larger drawings, with as many poses per room: time and memory.

    `progress` is called with the sizes done and the sizes to do.
    """
    rows = []
    for done, side in enumerate(sides, 1):
        cost = measure_cost(side, None, cell_size, repeats)
        rows.append(Cost(side, cost.poses, cost.seconds, measure_peak(side, None, cell_size)))
        if progress:
            progress(done, len(sides))
    return rows


def cost_by_poses(
    n_poses: Sequence[int] = (1_000, 2_000, 4_000, 8_000), side: int = 1000, cell_size: float = 3, repeats: int = 2
) -> list[Cost]:
    """The cost of denser and denser surveys of one drawing."""
    return [measure_cost(side, poses, cell_size, repeats) for poses in n_poses]


def growth(amounts: Sequence[float], seconds: Sequence[float]) -> float:
    """The exponent b of cost = a amount^b, by least squares of the logarithms: 1 is linear, 2 quadratic.

    >>> round(growth([1, 2, 4], [3, 6, 12]), 12), round(growth([1, 2, 4], [3, 12, 48]), 12)
    (1.0, 2.0)
    """
    x, y = np.log(np.asarray(amounts, dtype=np.float64)), np.log(np.asarray(seconds, dtype=np.float64))
    x = x - x.mean()
    return float((x @ (y - y.mean())) / (x @ x))
