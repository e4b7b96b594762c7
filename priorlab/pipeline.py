"""Drawing -> one result record, step by step: what the demo, `priorlab run`, the study and the report share.

A building of ours (a `FloorPlan`) brings its truth, its world, a survey and a tour. Of an own drawing only the image is known:
the robot then explores the building AS EXTRACTED, and there is no score.
"""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from priorlab.core.building import FloorPlan, Truth, World
from priorlab.core.checks import check_positive
from priorlab.core.drawing import Drawing, Walls
from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.readings import Evidence, Readings, RobotLog
from priorlab.core.score import Score, score_map, score_walls
from priorlab.core.sensor import KINECT, ODOMETRY, RangeSensor
from priorlab.drawing.extraction import Extraction, extract_walls
from priorlab.drawing.method import ROBUST, Method
from priorlab.mapping.disagreement import Disagreement, find_disagreement
from priorlab.mapping.evidence import gather_evidence
from priorlab.mapping.overruled import OverruledSensorWarning, overruled_readings
from priorlab.mapping.prior import build_prior_map
from priorlab.mapping.update import update_map
from priorlab.optimize.clusters import Clusters, cluster
from priorlab.optimize.experiment import Experiment
from priorlab.optimize.front import Front
from priorlab.optimize.pareto import pareto_front
from priorlab.optimize.sweep import Sweep
from priorlab.robot.drive import BlockedTourError, drive
from priorlab.robot.explore import explore
from priorlab.robot.free_space import LeakError, find_free_space
from priorlab.robot.planner import plan_survey, plan_tour
from priorlab.slam.fastslam import FastSLAM
from priorlab.slam.recording import Run

DOOR_M = 0.85
"""How wide a door is taken to be when a drawing has no scale, metres."""

MIN_DOOR_PX = 4
"""A scale at which a door is narrower than this is a slip of the pen."""

SLAM_PRIOR = Prior(p_wall=0.3, p_space=0.8)
"""Table 6.1: effective 0.27 and 0.72, less sure than the sensor of chapter 6 (0.8 and 0.2)."""

SLAM_CELL_M = 0.05
"""Side of a cell in chapter 6, metres."""

SLAM_THRESHOLD = 0.5
"""Chapter 6 scores at 0.5 (a cell at 0.5, of which nothing is known, is no wall)."""

Progress = Callable[[str], None]


@dataclass(frozen=True)
class Scale:
    """Metres per pixel, None when nobody knows, the sentence that says where they come from, and whether it was a guess."""

    metres_per_pixel: float | None
    sentence: str
    assumed: bool = False


@dataclass(frozen=True, eq=False)
class Mapping:
    """Chapters 4 and 5: maps from known poses. The scores are None without a truth.

    `informed` started from the plan, `uninformed` from 0.5 everywhere; both took the same evidence.
    """

    prior_map: GridMap
    readings: Readings
    evidence: Evidence
    informed: GridMap
    uninformed: GridMap
    disagreement: Disagreement
    score_prior: Score | None = None
    score_informed: Score | None = None
    score_uninformed: Score | None = None

    @property
    def gain_percent(self) -> float | None:
        """Gain in F2 of the plan over no plan, percent; None without a truth or when there is nothing to compare with."""
        return gain_percent(self.score_informed, self.score_uninformed)


@dataclass(frozen=True, eq=False)
class Search:
    """Chapter 4.3 to 4.6: every prior at once, the true front, the front as NSGA-II found it, its clusters."""

    experiment: Experiment
    sweep: Sweep
    exact: Front
    searched: Front
    clusters: Clusters


@dataclass(frozen=True, eq=False)
class Drive:
    """Chapter 6: FastSLAM with the plan as prior; the map without it is made of the same poses and scans."""

    log: RobotLog
    run: Run
    uninformed: GridMap
    score_prior: Score | None = None
    score_informed: Score | None = None
    score_uninformed: Score | None = None

    @property
    def gain_percent(self) -> float | None:
        """Gain in F2 of the plan over no plan, percent."""
        return gain_percent(self.score_informed, self.score_uninformed)


@dataclass(frozen=True, eq=False)
class PipelineResult:
    """Every step of the way. What could not be done is None, and `stopped` says why.

    Parameters
    ----------
    drawing, plan : what came in; the plan is None for the user's own drawing
    seed, prior, method, cell_size : how it was run
    scale : metres per pixel and where they come from
    extraction : chapter 3; `walls` are its walls, with the scale
    walls_score : against the truth, when it is known
    prior_map : what the walls make of the prior; None without walls
    mapping, search, drive : the records of chapters 4 to 6
    share_indoors : of an own drawing, the share of the space within the walls' outline that a robot can drive in
    stopped : the sentence that says why the way ended early
    notes : what else was decided or noticed, in sentences
    seconds : stage -> time taken
    """

    drawing: Drawing
    plan: FloorPlan | None
    seed: int
    prior: Prior
    method: Method
    cell_size: float
    scale: Scale
    extraction: Extraction
    walls: Walls
    walls_score: Score | None = None
    prior_map: GridMap | None = None
    mapping: Mapping | None = None
    search: Search | None = None
    drive: Drive | None = None
    share_indoors: float | None = None
    stopped: str | None = None
    notes: tuple[str, ...] = ()
    seconds: dict[str, float] = field(default_factory=dict)

    @property
    def has_walls(self) -> bool:
        """True when chapter 3 found walls."""
        return bool(self.walls.mask.any())

    def __repr__(self) -> str:
        done = [name for name in ("mapping", "search", "drive") if getattr(self, name) is not None]
        end = f"; {self.stopped}" if self.stopped else ""
        return f"PipelineResult({self.drawing.name}: {self.walls!r}, {', '.join(done) or 'no map'}{end})"


def gain_percent(score: Score | None, without: Score | None) -> float | None:
    """How much higher the F2 of one score is, percent; None when it cannot be said."""
    if score is None or without is None or without.f_beta == 0:
        return None
    return 100 * (score.f_beta / without.f_beta - 1)


def run_pipeline(
    drawing: Drawing,
    plan: FloorPlan | None = None,
    *,
    seed: int = 0,
    prior: Prior | None = None,
    method: Method = ROBUST,
    cell_size: float = 3,
    metres_per_pixel: float | None = None,
    sensor: RangeSensor | None = None,
    progress: Progress | None = None,
) -> PipelineResult:
    """Take a drawing all the way: walls, prior map, survey, posterior, sweep, FastSLAM.

    Parameters
    ----------
    drawing : any drawing
    plan : the building it shows, when it is one of ours
    seed : of everything random; search, world and filter get generators of their own
    prior : of chapters 4 and 5; `Prior()` by default. Chapter 6 takes `SLAM_PRIOR`
    method : of chapter 3
    cell_size : of chapters 4 and 5, pixels
    metres_per_pixel : scale of an own drawing; else it is assumed from its doors
    sensor : of chapters 4 and 5; range 40 px in our buildings, a door's width in an own drawing
    progress : called with a short sentence when a stage begins

    Returns
    -------
    PipelineResult; without walls, or when they do not close the building, it ends early and says so in `stopped`

    Raises
    ------
    ValueError
        For a cell size larger than the drawing, or a scale at which a door would be a speck or larger than the drawing.
    """
    if seed < 0:
        raise ValueError(f"seed must be a whole number of at least 0, got {seed}")
    Grid(drawing.shape, cell_size)  # say at once when the cells are too large
    told = metres_per_pixel if metres_per_pixel is not None else drawing.metres_per_pixel
    if told is not None:
        _check_scale(told, drawing)
    prior = prior or Prior()
    rng_search, rng_world, rng_filter = np.random.default_rng(seed).spawn(3)
    stage = _Stages(progress)

    with stage("walls", "corners, doors and walls of the drawing"):
        extraction = extract_walls(drawing, method, _steps_within(progress))
    scale = find_scale(drawing, plan, metres_per_pixel, extraction)
    walls = Walls(extraction.walls.labels, scale.metres_per_pixel, drawing.name)
    result = PipelineResult(
        drawing,
        plan,
        seed,
        prior,
        method,
        cell_size,
        scale,
        extraction,
        walls,
        walls_score=None if plan is None else score_walls(walls, plan.truth),
        notes=tuple(extraction.notes),
        seconds=stage.seconds,
    )
    if not result.has_walls:
        return replace(result, stopped=f"no walls were found, lost at '{extraction.lost_at}'. {' '.join(extraction.notes)}")
    result = replace(result, prior_map=build_prior_map(walls, prior, cell_size))
    if plan is not None:
        survey, tour, truth, world, building = plan.survey, plan.tour, plan.truth, plan.world, plan.truth
    elif scale.metres_per_pixel is None:
        return replace(result, stopped="no survey was planned: the scale is " + scale.sentence)
    else:  # the robot explores the building as extracted
        truth, world = None, World(walls.mask, scale.metres_per_pixel)
        building = Truth(walls.mask, np.zeros(walls.shape, dtype=bool))
        door_width = DOOR_M / scale.metres_per_pixel
        sensor = sensor or RangeSensor(max_range=door_width)
        try:
            with stage("plan", "a survey and a tour through the free space of the walls"):
                survey = plan_survey(walls, extraction.doors, door_width, sensor.max_range)
                tour = plan_tour(walls, extraction.doors, door_width)
                indoors = find_free_space(walls, extraction.doors, door_width).share_indoors
        except LeakError as leak:
            return replace(result, stopped=f"{leak}; draw a wall line across the gap and run it again")

        result = replace(result, share_indoors=indoors)

    with stage("map", "prior map, readings and posterior map"):
        mapping = map_with_prior(walls, building, survey, prior, cell_size, sensor or RangeSensor(), truth)
    overruled = overruled_readings(prior, mapping.evidence.sensor.p_free, mapping.evidence.sensor.p_occupied)
    result = replace(result, mapping=mapping, notes=(*result.notes, overruled) if overruled else result.notes)

    if truth is not None:
        with stage("search", "every prior at once, Pareto fronts and clusters"):
            result = replace(result, search=search_priors(walls, mapping.evidence, truth, rng_search))
    if not (tour != tour[0]).any():
        return replace(result, stopped="no drive: the extracted walls leave the robot only one place to go to")
    try:
        with stage("drive", "FastSLAM through the building"):
            drive_done = drive_with_prior(walls, world, tour, truth, rng_world, rng_filter, _fifths_of_drive(progress))
            return replace(result, drive=drive_done)
    except BlockedTourError as blocked:  # walls that a plan's coarse cells did not show
        return replace(result, stopped=f"no drive: {blocked}")


def _steps_within(progress: Progress | None) -> Callable[[str, float], None] | None:
    """Tells the steps of a stage, a little further in; its end is the next stage's beginning."""
    return progress and (lambda step, share: progress(f"  {step}") if share < 1 else None)


def _fifths_of_drive(progress: Progress | None) -> Callable[[int, int], None] | None:
    """Tells how far a drive is, four times on the way."""
    if progress is None:
        return None

    def tell(done: int, to_do: int) -> None:
        if 5 * done // to_do > 5 * (done - 1) // to_do and done < to_do:
            progress(f"  step {done} of {to_do}")

    return tell


def _check_scale(metres_per_pixel: float, drawing: Drawing) -> None:
    """Say when a scale makes no sense: at it a door is smaller than its symbol can be drawn, or larger than the drawing."""
    door = DOOR_M / check_positive("metres_per_pixel", metres_per_pixel)
    widest = min(drawing.shape)
    if not MIN_DOOR_PX <= door <= widest:
        raise ValueError(
            f"metres_per_pixel must make a door of {DOOR_M:g} m {MIN_DOOR_PX:g} to {widest} pixels wide, "
            f"got {metres_per_pixel:g}: {door:.3g} pixels"
        )


class _Stages:
    """Names the stages as they begin and takes their time."""

    def __init__(self, progress: Progress | None) -> None:
        self.seconds: dict[str, float] = {}
        self.progress = progress

    @contextmanager
    def __call__(self, name: str, sentence: str) -> Iterator[None]:
        if self.progress:
            self.progress(sentence)
        start = time.perf_counter()
        yield
        self.seconds[name] = time.perf_counter() - start


def map_with_prior(
    walls: Walls,
    building: Truth | World,
    survey: NDArray[np.float64],
    prior: Prior,
    cell_size: float,
    sensor: RangeSensor,
    truth: Truth | None = None,
) -> Mapping:
    """Chapters 4 and 5: the map of a survey from known poses, with the plan as prior and without."""
    prior_map = build_prior_map(walls, prior, cell_size)
    no_prior_map = build_prior_map(walls, Prior.uninformed(), cell_size)
    readings = explore(building, survey, sensor)
    evidence = gather_evidence(readings, prior_map.grid)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", OverruledSensorWarning)  # the result's notes say it
        informed, uninformed = update_map(prior_map, evidence), update_map(no_prior_map, evidence)
    scores = [None if truth is None else score_map(one, truth) for one in (prior_map, informed, uninformed)]
    return Mapping(prior_map, readings, evidence, informed, uninformed, find_disagreement(prior_map, evidence), *scores)


def search_priors(walls: Walls, evidence: Evidence, truth: Truth, rng: np.random.Generator) -> Search:
    """Chapter 4.3 to 4.6: the sweep, the exact front, NSGA-II's front and its clusters."""
    experiment = Experiment(walls, evidence, truth)
    sweep = experiment.sweep()
    searched = pareto_front(experiment, rng)
    return Search(experiment, sweep, sweep.front(), searched, cluster(searched, rng=rng))


def drive_with_prior(
    walls: Walls,
    world: World,
    tour: NDArray[np.float64],
    truth: Truth | None,
    rng_world: np.random.Generator,
    rng_filter: np.random.Generator,
    progress: Callable[[int, int], None] | None = None,
) -> Drive:
    """Chapter 6: FastSLAM along a tour; poses are estimated, the map without the plan takes the same poses and scans."""
    cell_m = max(SLAM_CELL_M, world.metres_per_pixel)  # a cell below a pixel of the plan knows nothing more
    prior_map = build_prior_map(walls, SLAM_PRIOR, cell_size_m=cell_m)
    log = drive(world, tour, KINECT, ODOMETRY, rng_world)
    run = FastSLAM().run(prior_map, log, rng_filter, progress)
    uninformed = run.remap(build_prior_map(walls, Prior.uninformed(), cell_size_m=cell_m))
    scores = [None if truth is None else score_map(one, truth, SLAM_THRESHOLD) for one in (prior_map, run.map, uninformed)]
    return Drive(log, run, uninformed, *scores)


def find_scale(drawing: Drawing, plan: FloorPlan | None, told: float | None, extraction: Extraction) -> Scale:
    """Metres per pixel: told, the plan's, the drawing's own, or assumed from its doors."""
    if told is not None:
        return Scale(told, f"{told:.4g} m per pixel, as given")
    if plan is not None:
        return Scale(plan.metres_per_pixel, f"{plan.metres_per_pixel:.4g} m per pixel, from the building's description")
    if drawing.metres_per_pixel is not None:
        return Scale(drawing.metres_per_pixel, f"{drawing.metres_per_pixel:.4g} m per pixel, as given")
    width, n_doors = extraction.door_width, len(extraction.doors)
    if not width or not n_doors:
        return Scale(None, "unknown: no --metres-per-pixel was given and no door was found to assume it from")
    scale = DOOR_M / width
    height_m, width_m = (side * scale for side in drawing.shape)
    return Scale(
        scale,
        f"{scale:.4g} m per pixel, ASSUMED from {n_doors} doors of about {width:.0f} px taken as {DOOR_M:g} m "
        f"(the sheet would be {width_m:.1f} x {height_m:.1f} m); it may be off by a fifth, so give --metres-per-pixel when you "
        "know it: a printed dimension in metres / its length in pixels",
        assumed=True,
    )
