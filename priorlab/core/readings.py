"""Records of what a robot saw: ranges with poses (chapters 4-5), the evidence they add up to, and a log (chapter 6)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import as_numbers, check_poses, check_record
from priorlab.core.grid import Grid
from priorlab.core.sensor import RangeSensor, Scanner


@dataclass(frozen=True, eq=False)
class Readings:
    """Ranges measured from known poses, in the drawing's pixels; they carry the sensor that took them.

    Parameters
    ----------
    poses : (N, 3) x, y, theta; pixels, y up
    ranges : (N, B) distance to the obstacle along every bearing, pixels; inf where nothing stood within range
    bearings : (B,) angles to theta, radians
    sensor : the sensor
    image_shape : (height, width) of the drawing that the poses lie on, pixels
    valid : (N, B) bool, False where the sensor gave no usable reading: nothing is known there, and the range may be nan;
        None when all are usable

    >>> sensor = RangeSensor(max_range=3, half_angle=0.1)
    >>> Readings([[0.5, 0.5, 0.0]], [[2.0, np.nan]], [-0.1, 0.1], sensor, image_shape=(1, 6), valid=[[True, False]])
    Readings(1 poses x 2 bearings, 50 % met an obstacle, 50 % without a reading)
    """

    poses: NDArray[np.float64]
    ranges: NDArray[np.float64]
    bearings: NDArray[np.float64]
    sensor: RangeSensor
    image_shape: tuple[int, int]
    valid: NDArray[np.bool_] | None = None

    def __post_init__(self) -> None:
        check_record("sensor", self.sensor, RangeSensor)
        poses = check_poses("poses", self.poses)
        ranges, bearings = as_numbers("ranges", self.ranges), as_numbers("bearings", self.bearings)
        if bearings.ndim != 1 or not bearings.size or not np.isfinite(bearings).all():
            raise ValueError(f"bearings must be one row of finite angles, got {bearings.tolist()}")
        if ranges.shape != (len(poses), len(bearings)):
            raise ValueError(f"ranges must have shape {(len(poses), len(bearings))}, got {ranges.shape}")
        valid = None if self.valid is None else np.asarray(self.valid, dtype=bool)
        if valid is not None and valid.shape != ranges.shape:
            raise ValueError(f"valid must have the shape of ranges {ranges.shape}, got {valid.shape}")
        wrong = np.isnan(ranges) | (ranges < 0) if valid is None else (np.isnan(ranges) | (ranges < 0)) & valid
        if wrong.any():
            pose, beam = np.argwhere(wrong)[0]
            raise ValueError(
                f"ranges must be 0 or more, or inf for no return, got {ranges[pose, beam]:g} at pose {pose}, beam {beam}: "
                "where the sensor gave no reading, valid must be False"
            )
        object.__setattr__(self, "poses", poses)
        object.__setattr__(self, "ranges", ranges)
        object.__setattr__(self, "bearings", bearings)
        object.__setattr__(self, "valid", valid)

    def __len__(self) -> int:
        return len(self.poses)

    def __getitem__(self, chosen: slice | NDArray) -> Readings:
        """Some of the readings: `readings[:100]` is the first hundred poses."""
        valid = None if self.valid is None else self.valid[chosen]
        return Readings(self.poses[chosen], self.ranges[chosen], self.bearings, self.sensor, self.image_shape, valid)

    @property
    def met(self) -> NDArray[np.bool_]:
        """(N, B) True where an obstacle was met."""
        met = np.isfinite(self.ranges)
        return met if self.valid is None else met & self.valid

    @property
    def share_missing(self) -> float:
        """Share of the bearings without a usable reading."""
        return 0.0 if self.valid is None or not self.valid.size else float(1.0 - self.valid.mean())

    def __repr__(self) -> str:
        hits = 100 * self.met.mean() if self.ranges.size else 0.0
        missing = f", {100 * self.share_missing:.0f} % without a reading" if self.share_missing else ""
        return f"Readings({len(self)} poses x {len(self.bearings)} bearings, {hits:.0f} % met an obstacle{missing})"


@dataclass(frozen=True, eq=False)
class Evidence:
    """All that readings say about every cell, whatever the prior: two numbers a cell. Evidence adds and subtracts.

    Parameters
    ----------
    total : (rows, cols) float64, S = sum of logit(inverse sensor model) over the cell's readings
    looks : (rows, cols) int64, n = number of readings
    grid : the cells
    sensor : the sensor whose model made the total
    """

    total: NDArray[np.float64]
    looks: NDArray[np.int64]
    grid: Grid
    sensor: RangeSensor

    def __post_init__(self) -> None:
        for name, dtype in (("total", np.float64), ("looks", np.int64)):
            values = np.asarray(getattr(self, name), dtype=dtype)
            if values.shape != self.grid.shape:
                raise ValueError(f"{name} must have the grid's shape {self.grid.shape}, got {values.shape}")
            object.__setattr__(self, name, values)
        if not np.isfinite(self.total).all():
            raise ValueError(f"total must be finite numbers, got {self.total[~np.isfinite(self.total)].flat[0]:g}")
        if (self.looks < 0).any():
            raise ValueError(f"looks must not be negative, got {self.looks.min()}: more was taken away than was there")

    @classmethod
    def none(cls, grid: Grid, sensor: RangeSensor | None = None) -> Evidence:
        """No readings yet."""
        return cls(np.zeros(grid.shape), np.zeros(grid.shape, dtype=np.int64), grid, sensor or RangeSensor())

    def __add__(self, other: Evidence) -> Evidence:
        self._check_same(other)
        return Evidence(self.total + other.total, self.looks + other.looks, self.grid, self.sensor)

    def __sub__(self, other: Evidence) -> Evidence:
        self._check_same(other)
        return Evidence(self.total - other.total, self.looks - other.looks, self.grid, self.sensor)

    def _check_same(self, other: Evidence) -> None:
        if self.grid != other.grid or self.sensor != other.sensor:
            raise ValueError("evidence adds up only for one grid and one sensor, got two different ones")

    @property
    def seen(self) -> NDArray[np.bool_]:
        """(rows, cols) True where a cell was looked at."""
        return self.looks > 0

    @property
    def mean_looks(self) -> float:
        """Mean number of readings of a cell that was seen; decides whether a prior pays."""
        return float(self.looks[self.seen].mean()) if self.seen.any() else 0.0

    def __repr__(self) -> str:
        return f"Evidence({100 * self.seen.mean():.1f} % of the cells seen, {self.mean_looks:.2f} looks each)"


@dataclass(frozen=True, eq=False)
class RobotLog:
    """What a robot recorded on a drive, in metres: odometry and scans, and in simulation the truth.

    Parameters
    ----------
    odometry : (T, 3) poses x, y, theta as the wheels report them
    ranges : (T, B) metres; inf = no return, nan = no reading
    bearings : (B,) radians to the heading
    scanner : the scanner
    start : (3,) pose at which the robot was put down, in the map's frame
    truth : (T, 3) true poses, or None
    stamps : (T,) seconds, or None
    """

    odometry: NDArray[np.float64]
    ranges: NDArray[np.float64]
    bearings: NDArray[np.float64]
    scanner: Scanner
    start: NDArray[np.float64]
    truth: NDArray[np.float64] | None = None
    stamps: NDArray[np.float64] | None = None

    def __post_init__(self) -> None:
        check_record("scanner", self.scanner, Scanner)
        odometry = check_poses("odometry", self.odometry)
        ranges, bearings = as_numbers("ranges", self.ranges), as_numbers("bearings", self.bearings)
        if bearings.ndim != 1:
            raise ValueError(f"bearings must be one row of finite angles, got shape {bearings.shape}")
        if ranges.shape != (len(odometry), len(bearings)):
            raise ValueError(f"ranges must have shape {(len(odometry), len(bearings))}, got {ranges.shape}")
        if (ranges < 0).any():
            raise ValueError(f"ranges must not be negative, got {np.nanmin(ranges):g} m")
        start = check_poses("start", [self.start])[0]
        truth = None if self.truth is None else check_poses("truth", self.truth)
        if truth is not None and len(truth) != len(odometry):
            raise ValueError(f"truth must hold {len(odometry)} poses, one per odometry pose, got {len(truth)}")
        if not np.isfinite(bearings).all():
            raise ValueError(f"bearings must be finite angles, got {bearings[~np.isfinite(bearings)][0]:g}")
        stamps = None if self.stamps is None else as_numbers("stamps", self.stamps)
        if stamps is not None and (stamps.shape != (len(odometry),) or not np.isfinite(stamps).all()):
            raise ValueError(f"stamps must be {len(odometry)} finite numbers, one per odometry pose, got shape {stamps.shape}")
        for name, value in (
            ("odometry", odometry),
            ("ranges", ranges),
            ("bearings", bearings),
            ("start", start),
            ("truth", truth),
            ("stamps", stamps),
        ):
            object.__setattr__(self, name, value)

    def __len__(self) -> int:
        return len(self.odometry)

    def __repr__(self) -> str:
        steps = np.diff(self.odometry[:, :2], axis=0)
        length = float(np.hypot(steps[:, 0], steps[:, 1]).sum())
        return f"RobotLog({len(self)} scans of {len(self.bearings)} beams over {length:.1f} m)"
