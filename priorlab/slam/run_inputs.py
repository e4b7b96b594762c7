"""What a drive starts from, as arrays for a file: the prior map, the log and the method's numbers."""

from __future__ import annotations

import io
import json
import zipfile
import zlib
from dataclasses import asdict
from typing import Any

import numpy as np
from numpy.typing import NDArray

from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap, Prior
from priorlab.core.readings import RobotLog
from priorlab.core.sensor import Scanner
from priorlab.slam.parameters import Parameters

_LOG = ("odometry", "ranges", "bearings", "start", "truth", "stamps")

UNREADABLE = (ValueError, KeyError, TypeError, EOFError, zipfile.BadZipFile, zlib.error)
"""What reading arrays or records raises when a file is damaged or is something else."""


class OlderFile(ValueError):
    """A whole file, in a format that priorlab wrote once and no longer reads."""


def inputs_as_arrays(
    file_format: str, prior_map: GridMap, log: RobotLog, parameters: Parameters, **more_words: Any
) -> dict[str, Any]:
    """Names and arrays; numbers and names stand as JSON in `words`."""
    prior = prior_map.prior
    words = {
        "format": file_format,
        "parameters": asdict(parameters),
        "scanner": asdict(log.scanner),
        "grid": asdict(prior_map.grid),
        "prior": None if prior is None else asdict(prior),
        **more_words,
    }
    arrays = {name: value for name in _LOG if (value := getattr(log, name)) is not None}
    return {"words": np.array(json.dumps(words)), "prior_log_odds": prior_map.log_odds, **arrays}


def inputs_from_arrays(file_format: str, arrays: dict[str, NDArray]) -> tuple[GridMap, RobotLog, Parameters, dict[str, Any]]:
    """The records again, and all words; one of `UNREADABLE` when they are not there."""
    words = json.loads(str(arrays["words"]))
    if words["format"] != file_format:
        kind, _, number = str(words["format"]).rpartition(" ")
        ours, _, today = file_format.rpartition(" ")
        if kind == ours and number.isdecimal() and int(number) < int(today):
            raise OlderFile(f"it was written by an older priorlab, as {words['format']!r}")
        raise ValueError(f"unknown format {words['format']!r}")
    words["grid"]["image_shape"] = tuple(words["grid"]["image_shape"])
    prior = None if words["prior"] is None else Prior(**words["prior"])
    prior_map = GridMap(arrays["prior_log_odds"], Grid(**words["grid"]), prior)
    log_arrays: dict[str, Any] = {name: arrays.get(name) for name in _LOG}
    log = RobotLog(scanner=Scanner(**words["scanner"]), **log_arrays)
    return prior_map, log, Parameters(**words["parameters"]), words


def arrays_of(content: bytes) -> dict[str, NDArray]:
    """All arrays of an npz file's content; nothing in it is ever executed."""
    with np.load(io.BytesIO(content), allow_pickle=False) as stored:
        return {name: stored[name] for name in stored.files}
