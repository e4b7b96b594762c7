"""What the scans of a run said about every cell, whatever the prior: then maps of any prior, at any step, are one sum away."""

from __future__ import annotations

import numpy as np

from priorlab.core.checks import check_record
from priorlab.core.log_odds import log_odds
from priorlab.core.sensor import RangeSensor
from priorlab.mapping.timeline import EvidenceOverTime
from priorlab.slam.map_update import FREE, OCCUPIED, UNSEEN, see_cells
from priorlab.slam.parameters import Parameters
from priorlab.slam.recording import Run
from priorlab.slam.scan import choose_beams


def evidence_of_run(run: Run, parameters: Parameters | None = None) -> EvidenceOverTime:
    """Look through the scans of a run once more, from the poses that drew its map (algorithm 6.5 without the sum).

    Parameters
    ----------
    run : poses and scans
    parameters : of the map (`p_free`, `p_occupied`, `thickening_m`, `free_on_no_return`, the beams); the run's own when left out

    Returns
    -------
    EvidenceOverTime, a reading per step: `.at(k)` is what the first k scans say, and `score_over_time` takes it as it is
    """
    check_record("run", run, Run)
    parameters = parameters or run.parameters
    check_record("parameters", parameters, Parameters)
    grid = run.prior_map.grid
    said = np.zeros(3)
    said[FREE], said[OCCUPIED] = log_odds([parameters.p_free, parameters.p_occupied])
    cells, added = [np.empty(0, dtype=np.int64)], [np.empty(0)]
    for k, pose in enumerate(run.trajectory if run.path is None else run.path):
        seen = see_cells(grid, pose, choose_beams(run.log, k, parameters), parameters)
        rows, cols = np.nonzero(seen.labels != UNSEEN)
        cells.append((rows + seen.rows.start) * grid.shape[1] + cols + seen.cols.start)
        added.append(said[seen.labels[rows, cols]])
    starts = np.cumsum([len(part) for part in cells])
    return EvidenceOverTime(np.concatenate(cells), np.concatenate(added), starts, grid, _sensor_of(run, parameters))


def _sensor_of(run: Run, parameters: Parameters) -> RangeSensor:
    """The scanner in the words of chapter 5: pixels, half the opening, the inverse sensor model."""
    scale, scanner = run.prior_map.grid.scale, run.log.scanner
    behind = parameters.thickening_m / scale
    return RangeSensor(
        max_range=min(parameters.max_range_m, scanner.max_range_m) / scale,
        half_angle=min(scanner.field_of_view / 2, np.pi),
        p_free=parameters.p_free,
        p_occupied=parameters.p_occupied,
        beyond="thickness" if behind else "hit_cell",
        wall_thickness=behind or 1.0,
    )
