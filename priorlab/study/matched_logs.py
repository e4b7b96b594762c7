"""A real robot's log mapped from bad odometry and without any plan: how much of the wheels' error the scan matcher takes back.

The wheels are made worse on purpose (`wear_wheels`), as corrected logs seldom keep their own. Truth is the corrected path; an
estimate starts at its first pose and is aligned no further.

    from priorlab.interchange.carmen import read_carmen
    from priorlab.study.matched_logs import match_log, matching_table
    log = read_carmen("my-corrected.log.gz")
    print(matching_table("my", [match_log(log, seed) for seed in range(5)]))
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np

from priorlab.core.readings import RobotLog
from priorlab.interchange.relations import Relations
from priorlab.slam.matched_mapping import MatchedDrive, Slip, map_by_matching
from priorlab.slam.parameters import Parameters
from priorlab.slam.relations import RelationErrors, relation_errors
from priorlab.slam.scan_matching import MATCHING
from priorlab.slam.trajectory_error import absolute_trajectory_error_m, dead_reckoning, position_errors_m, true_poses
from priorlab.study.real_logs import WornWheels, wear_wheels


@dataclass(frozen=True, eq=False)
class MatchedLog:
    """A log mapped once.

    Parameters
    ----------
    seed : of the wheels' faults; the matcher draws nothing
    worn : the log with worn wheels
    drive : what the matcher made of it
    step_ms : time for a scan, milliseconds
    """

    seed: int
    worn: RobotLog
    drive: MatchedDrive
    step_ms: float

    @property
    def wheels_m(self) -> float:
        """ATE of the wheels alone."""
        return absolute_trajectory_error_m(dead_reckoning(self.worn), true_poses(self.worn))

    def relation_errors(self, relations: Relations, behind_s: float = 0.0) -> tuple[RelationErrors, RelationErrors]:
        """Matcher and wheels against hand-checked relations; see `priorlab.slam.relations`."""
        if self.worn.stamps is None:
            raise ValueError("the log must have stamps to be held against relations, got none")
        matched, wheels = (
            relation_errors(poses, self.worn.stamps, relations, behind_s)
            for poses in (self.drive.trajectory, dead_reckoning(self.worn))
        )
        return matched, wheels


def match_log(
    log: RobotLog,
    seed: int,
    parameters: Parameters = MATCHING,
    wheels: WornWheels | None = None,
    slip: Slip | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> MatchedLog:
    """Wear the wheels of a log and map it by matching.

    Parameters
    ----------
    log : with corrected poses as the truth
    seed : draws the wheels' faults
    parameters, slip : of the matcher
    wheels : how the odometry is made worse; `WornWheels()` by default
    progress : called with the scans done and the scans to do
    """
    worn = wear_wheels(log, np.random.default_rng(seed), wheels or WornWheels())
    began = time.perf_counter()
    drive = map_by_matching(worn, parameters, slip, progress=progress)
    return MatchedLog(seed, worn, drive, 1e3 * (time.perf_counter() - began) / len(log))


def matching_table(name: str, rows: Iterable[MatchedLog], relations: Relations | None = None, behind_s: float = 0.0) -> str:
    """One line a seed: errors without the matcher and with it; with relations those too."""
    head = "mapped without a plan  seed  scans  wheels m  matched m  worst m  heading  trusted  ms/scan"
    lines = [head + ("  relations m: wheels  matched  degrees" if relations else "")]
    for row in rows:
        drive = row.drive
        worst = position_errors_m(drive.trajectory, true_poses(drive.log)).max()
        line = (
            f"{name:<22} {row.seed:>4} {len(drive):>6} {row.wheels_m:>9.2f} {drive.ate_m():>10.3f} {worst:>8.2f} "
            f"{drive.heading_error_deg():>8.2f} {100 * drive.trusted.mean():>6.0f} % {row.step_ms:>8.1f}"
        )
        if relations:
            matched, wheels = row.relation_errors(relations, behind_s)
            line += (
                f" {wheels.translation_m.mean():>20.3f} {matched.translation_m.mean():>8.3f} "
                f"{np.degrees(matched.rotation).mean():>8.2f}"
            )
        lines.append(line)
    return "\n".join(lines)
