"""A long drive that survives a crash: every 50 steps what came new is added to a file, and `resume` goes on from there.

    run = run_with_checkpoints(FastSLAM(), prior_map, log, rng, "drive.part")     # Ctrl-C, kill -9, a power cut ...
    run = resume("drive.part")                                                    # ... and the very same run

The file begins with the prior map, the log and the parameters, written in one step. Then come records, one for every 50 steps,
each with a mark, its length and a checksum. A record is only ever added at the end, so its cost does not grow with the drive. A
crash while one is being added leaves a torn end: `resume` drops it and loses those 50 steps, no more. Maps are not kept: they
are drawn again from poses and scans, to the last bit.
"""

from __future__ import annotations

import contextlib
import json
import os
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from priorlab.core.checks import check_record, check_rng, check_whole
from priorlab.core.files import check_free, write_file
from priorlab.core.grid_map import GridMap
from priorlab.core.readings import RobotLog
from priorlab.slam.fastslam import FastSLAM
from priorlab.slam.own_maps_record import own_maps_news, own_paths_of, shared_steps
from priorlab.slam.parameters import Parameters
from priorlab.slam.particles import Particles
from priorlab.slam.record_file import append_record, pack_record, whole_records
from priorlab.slam.recording import Recorder, Run
from priorlab.slam.run_inputs import UNREADABLE, OlderFile, arrays_of, inputs_as_arrays, inputs_from_arrays
from priorlab.slam.scan import choose_beams
from priorlab.slam.state import State

EVERY = 50
"""Steps between two records: what a crash may cost at most."""

_FORMAT = "priorlab checkpoint 3"
_GENERATORS = ("PCG64", "PCG64DXSM", "MT19937", "Philox", "SFC64")

Progress = Callable[[int, int], None]


def run_with_checkpoints(
    fast_slam: FastSLAM,
    prior_map: GridMap,
    log: RobotLog,
    rng: np.random.Generator,
    path: str | Path,
    every: int = EVERY,
    progress: Progress | None = None,
    force: bool = False,
) -> Run:
    """`fast_slam.run(prior_map, log, rng)`, to the last bit, and on the way a file to go on from.

    Parameters
    ----------
    fast_slam, prior_map, log, rng, progress : as `FastSLAM.run` has them
    path : the file; it stays when the drive is done, and may go as soon as the run is saved
    every : steps between two records
    force : replace what stands there

    Raises
    ------
    FileExistsError
        When something stands at `path` and `force` is not given.
    ValueError
        As `FastSLAM.run`, and when `every` is below 1 or `rng` none of NumPy's own.
    """
    for name, value, kind in (("fast_slam", fast_slam, FastSLAM), ("prior_map", prior_map, GridMap), ("log", log, RobotLog)):
        check_record(name, value, kind)
    every = check_whole("every", every)
    generator = type(check_rng(rng).bit_generator).__name__
    if generator not in _GENERATORS:
        raise ValueError(f"rng must draw from one of {', '.join(_GENERATORS)} to be gone on with, got {generator}")
    check_free(path, force)
    words = {"every": every, "generator": generator, "rng": state_of(rng)}
    state = fast_slam.start(prior_map, log, rng)
    first = pack_record(inputs_as_arrays(_FORMAT, prior_map, log, fast_slam.parameters, **words))
    write_file(path, first + pack_record(_news(state, 0, 0)))
    return _drive_on(fast_slam, state, Path(path), every, progress)


def resume(path: str | Path, progress: Progress | None = None) -> Run:
    """Go on with a drive that was interrupted; of one that was not, its run.

    Parameters
    ----------
    path : the file that `run_with_checkpoints` wrote; further records are added to it
    progress : called with the steps done and the steps to do

    Raises
    ------
    FileNotFoundError
        When there is no file.
    ValueError
        When it is no checkpoint, or damaged elsewhere than at its end.
    """
    path = Path(path)
    content = _content(path)
    with _sentence(path):
        records, whole = whole_records(content)
        first, *news = [arrays_of(record) for record in records]
        prior_map, log, parameters, words = inputs_from_arrays(_FORMAT, first)
        fast_slam = FastSLAM(parameters)
        state = _restored(fast_slam, prior_map, log, words["generator"], news)
        every = int(words["every"])
    if whole < len(content):
        os.truncate(path, whole)
    return _drive_on(fast_slam, state, path, every, progress)


def inputs_of(path: str | Path) -> tuple[GridMap, RobotLog, Parameters, dict[str, Any]]:
    """What the drive in a checkpoint started from, `rng` as `state_of` tells it; errors as `resume` has them."""
    content = _content(Path(path))
    with _sentence(Path(path)):
        prior_map, log, parameters, words = inputs_from_arrays(_FORMAT, arrays_of(whole_records(content)[0][0]))
        return prior_map, log, parameters, words["rng"]


def state_of(rng: np.random.Generator) -> dict[str, Any]:
    """Where a generator stands, in words that JSON keeps: two that draw the same numbers have the same."""
    return dict(json.loads(_state_as_json(rng)))


def _state_as_json(rng: np.random.Generator) -> str:
    """The generator's state."""
    return json.dumps(rng.bit_generator.state, default=np.ndarray.tolist)


def _content(path: Path) -> bytes:
    """The file's bytes."""
    if not path.is_file():
        raise FileNotFoundError(f"a checkpoint must lie at {path}, found no file there")
    return path.read_bytes()


@contextlib.contextmanager
def _sentence(path: Path) -> Iterator[None]:
    """Whatever a damaged file raises, as one sentence."""
    try:
        yield
    except OlderFile as fault:
        raise OlderFile(f"{path} must be a checkpoint of this priorlab, got an older one's: {fault}") from fault
    except UNREADABLE as fault:
        raise ValueError(f"{path} must be a checkpoint that priorlab wrote, got a damaged file: {fault}") from fault


def _drive_on(fast_slam: FastSLAM, state: State, path: Path, every: int, progress: Progress | None) -> Run:
    """Make the steps that are left, and add a record now and then."""
    with path.open("ab") as file:
        kept, shared = state.step, _shared(state)
        while not state.done:
            fast_slam.step(state)
            if state.step - kept == every or state.done:
                append_record(file, pack_record(_news(state, kept, shared)))
                kept, shared = state.step, _shared(state)
            if progress:
                progress(state.step, len(state.log))
    return fast_slam.finish(state)


# --- what is kept ----------------------------------------------------------------------------------------------------


def _news(state: State, since: int, shared: int) -> dict[str, Any]:
    """The steps from `since` on, and where the drive stands: its particles, their own paths and its generator."""
    steps = state.recorder
    paths = own_maps_news(state.own, shared) if state.own else {}
    return paths | {
        "poses": np.array(steps.poses[since:]).reshape(-1, 3),
        "n_particles": np.array(steps.n_particles[since:], dtype=np.int64),
        "ess": np.array(steps.ess[since:], dtype=np.float64),
        "explained": np.array(steps.explained[since:], dtype=np.float64),
        "sample_sizes": np.array([len(sample) for sample in steps.samples[since:]], dtype=np.int64),
        "samples": np.concatenate([np.empty((0, 3), dtype=np.float32), *steps.samples[since:]]),
        "particles": state.particles.poses,
        "log_weights": state.particles.log_weights,
        "generator": np.array(_state_as_json(state.rng)),
    }


def _shared(state: State) -> int:
    """Steps that the paths of all particles share; 0 when they have no maps of their own."""
    return shared_steps(state.own.paths) if state.own else 0


def _restored(fast_slam: FastSLAM, prior_map: GridMap, log: RobotLog, generator: str, news: list[dict[str, NDArray]]) -> State:
    """The state after the last record."""
    if generator not in _GENERATORS:
        raise ValueError(f"unknown generator {generator!r}")
    recorder = Recorder()
    for new in news:
        recorder.poses += list(new["poses"])
        recorder.n_particles += new["n_particles"].tolist()
        recorder.ess += new["ess"].tolist()
        recorder.explained += new["explained"].tolist()
        recorder.samples += np.split(new["samples"], np.cumsum(new["sample_sizes"])[:-1]) if len(new["poses"]) else []
    rng = np.random.Generator(getattr(np.random, generator)(0))
    state = fast_slam.start(prior_map, log, rng)
    _redraw(state, recorder, fast_slam)
    if state.own:
        scans = [choose_beams(log, k, fast_slam.parameters) for k in range(state.step)]
        state.own.redraw(own_paths_of(news), int(news[-1]["own_heaviest"]), scans, state.way_m)
    state.particles = Particles(news[-1]["particles"], news[-1]["log_weights"])
    rng.bit_generator.state = json.loads(str(news[-1]["generator"]))
    return state


def _redraw(state: State, recorder: Recorder, fast_slam: FastSLAM) -> None:
    """Put the recorded steps into the maps of a state that stands at the start."""
    for k, pose in enumerate(recorder.poses):
        fast_slam.map_scan(state, k, pose)
    state.recorder, state.step = recorder, len(recorder.poses)
