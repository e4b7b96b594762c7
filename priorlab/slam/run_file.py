"""A run as a small npz file: the log, the prior map and the light steps. Maps are not kept; they are replayed.

Nothing is lost: what is read equals what was saved, to the last bit. Most of the file are the sampled particles (60 %) and the
ranges (25 %), whose last digits are noise that no packing makes smaller.
"""

from __future__ import annotations

import io
import json
import zipfile
import zlib
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from priorlab.core.files import check_free, write_file
from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.readings import RobotLog
from priorlab.core.sensor import Scanner
from priorlab.slam.parameters import Parameters
from priorlab.slam.recording import Run
from priorlab.slam.sample_packing import pack_sample, unpack_sample

_FORMAT = "priorlab run 2"
_STEPS = ("trajectory", "n_particles", "ess", "explained")
_LOG = ("odometry", "ranges", "bearings", "start", "truth", "stamps")


def save_run(run: Run, path: str | Path, force: bool = False) -> None:
    """Write a run in one step.

    Raises
    ------
    FileExistsError
        When something stands at `path` and `force` is not given.
    """
    check_free(path, force)
    prior = run.prior_map.prior
    words = {
        "format": _FORMAT,
        "parameters": asdict(run.parameters),
        "scanner": asdict(run.log.scanner),
        "grid": asdict(run.prior_map.grid),
        "prior": None if prior is None else asdict(prior),
    }
    arrays: dict[str, Any] = {name: getattr(run, name) for name in _STEPS}
    arrays |= {name: value for name in _LOG if (value := getattr(run.log, name)) is not None}
    arrays |= pack_sample(run.sample)
    stream = io.BytesIO()
    np.savez_compressed(stream, words=np.array(json.dumps(words)), prior_log_odds=run.prior_map.log_odds, **arrays)
    write_file(path, stream.getvalue())


def load_run(path: str | Path) -> Run:
    """Read a run that `save_run` wrote; its last map is replayed.

    Raises
    ------
    FileNotFoundError
        When there is no such file.
    ValueError
        When the file is no run, or a damaged one.
    """
    if not Path(path).exists():
        raise FileNotFoundError(f"a run must lie at {path}, found nothing there")
    content = Path(path).read_bytes()
    try:
        with np.load(io.BytesIO(content), allow_pickle=False) as stored:
            arrays = {name: stored[name] for name in stored.files}
        words = json.loads(str(arrays["words"]))
        if words["format"] != _FORMAT:
            raise ValueError(f"unknown format {words['format']!r}")
        words["grid"]["image_shape"] = tuple(words["grid"]["image_shape"])
        prior = None if words["prior"] is None else Prior(**words["prior"])
        prior_map = GridMap(arrays["prior_log_odds"], Grid(**words["grid"]), prior)
        log_arrays: dict[str, Any] = {name: arrays.get(name) for name in _LOG}
        log = RobotLog(scanner=Scanner(**words["scanner"]), **log_arrays)
        steps = {name: arrays[name] for name in _STEPS} | {"sample": unpack_sample(arrays)}
        parameters = Parameters(**words["parameters"])
    except (ValueError, KeyError, TypeError, EOFError, zipfile.BadZipFile, zlib.error) as fault:
        raise ValueError(f"{path} must be a run that priorlab saved, got a file that cannot be read: {fault}") from fault
    run = Run(prior_map, log, parameters, map=prior_map, **steps)
    return Run(prior_map, log, parameters, map=run.remap(prior_map), **steps)
