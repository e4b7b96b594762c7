"""A run as a small npz file: the log, the prior map and the light steps. Maps are not kept; they are replayed.

Nothing is lost: what is read equals what was saved, to the last bit. Most of the file are the sampled particles (60 %) and the
ranges (25 %), whose last digits are noise that no packing makes smaller.
"""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np

from priorlab.core.checks import check_record
from priorlab.core.files import check_free, write_file
from priorlab.slam.recording import Run
from priorlab.slam.run_inputs import UNREADABLE, arrays_of, inputs_as_arrays, inputs_from_arrays
from priorlab.slam.sample_packing import pack_sample, unpack_sample

_FORMAT = "priorlab run 3"
_STEPS = ("trajectory", "n_particles", "ess", "explained")


def save_run(run: Run, path: str | Path, force: bool = False) -> None:
    """Write a run in one step.

    Raises
    ------
    FileExistsError
        When something stands at `path` and `force` is not given.
    """
    check_record("run", run, Run)
    check_free(path, force)
    arrays = inputs_as_arrays(_FORMAT, run.prior_map, run.log, run.parameters)
    arrays |= {name: getattr(run, name) for name in _STEPS} | pack_sample(run.sample)
    arrays |= {} if run.path is None else {"path": run.path}
    stream = io.BytesIO()
    np.savez_compressed(stream, **arrays)
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
        arrays = arrays_of(content)
        prior_map, log, parameters, _ = inputs_from_arrays(_FORMAT, arrays)
        steps = {name: arrays[name] for name in _STEPS} | {"sample": unpack_sample(arrays)}
        path_of_map = arrays.get("path")
    except UNREADABLE as fault:
        raise ValueError(f"{path} must be a run that priorlab saved, got a file that cannot be read: {fault}") from fault
    run = Run(prior_map, log, parameters, map=prior_map, path=path_of_map, **steps)
    return Run(prior_map, log, parameters, map=run.remap(prior_map), path=path_of_map, **steps)
