"""Every public function says in one sentence which record belongs where another one was handed over.

The types are read from the annotations, so a new public function is asked too.
"""

import inspect
import types
import typing
from dataclasses import is_dataclass

import numpy as np
import pytest

import priorlab as pl
from priorlab.core.building import World
from priorlab.robot.relief import Relief
from priorlab.slam.likelihood_field import LikelihoodField
from priorlab.slam.scan import Scan

BARE = np.zeros((12, 16), dtype=bool)
GRID = pl.Grid(BARE.shape)
WALLS = np.zeros((12, 16), dtype=np.uint8)
WALLS[0] = 1
LASER = pl.Scanner(n_beams=2)
TRUTH = pl.Truth(WALLS > 0, BARE)
PRIOR_MAP = pl.build_prior_map(pl.Walls(WALLS, 0.1), pl.Prior(0.3, 0.8))
READINGS = pl.Readings([[5.5, 5.5, 0.0]], [[2.0]], [0.0], pl.RangeSensor(), BARE.shape)
EVIDENCE = pl.Evidence.none(GRID)
LOG = pl.RobotLog([[0, 0, 0]], [[0.5, 0.6]], LASER.bearings, LASER, [0.5, 0.5, 0.0])

RECORDS = {
    pl.Drawing: pl.Drawing(np.full(BARE.shape, 255, dtype=np.uint8)),
    pl.Walls: pl.Walls(WALLS),
    pl.Truth: TRUTH,
    World: World(BARE, 0.1),
    pl.Grid: GRID,
    pl.GridMap: PRIOR_MAP,
    pl.Readings: READINGS,
    pl.Evidence: EVIDENCE,
    pl.RobotLog: LOG,
    pl.Experiment: pl.Experiment(pl.Walls(WALLS), EVIDENCE, TRUTH),
    pl.Front: pl.Front(*np.full((4, 1), 0.5)),
    pl.FastSLAM: pl.FastSLAM(),
    Relief: Relief(BARE * 2.4, 0.1),
    Scan: Scan([0.5], [0.0], []),
    LikelihoodField: LikelihoodField.of(PRIOR_MAP),
}
VALUES = {
    "corners": np.empty((0, 2)), "doors": (), "pose": [5, 5, 0], "tour": [(0.5, 0.5), (1, 0.5)], "survey": [[5, 5, 0]],
    "prior_maps": {"plan": PRIOR_MAP}, "p_empty": 0.5, "image": [[0]], "guess": [0.5, 0.5, 0],
}  # fmt: skip


def kinds_of(annotation):
    """The records that an annotation allows; none when it is of another kind."""
    parts = typing.get_args(annotation) if isinstance(annotation, types.UnionType) else (annotation,)
    return [part for part in parts if isinstance(part, type) and (is_dataclass(part) or part is pl.FastSLAM)]


def asked():
    """(name of the function, name of the argument, the records it may be)."""
    for name in pl.__all__:
        function = getattr(pl, name)
        if inspect.isfunction(function):
            for argument, annotation in typing.get_type_hints(function).items():
                if argument != "return" and (kinds := kinds_of(annotation)):
                    yield pytest.param(function, argument, kinds, id=f"{name}-{argument}")


@pytest.mark.parametrize(("function", "argument", "kinds"), list(asked()))
@pytest.mark.parametrize("wrong", [np.zeros((3, 3)), "a name", pl.Door((0, 0), (1, 0), (0, 1))], ids=["array", "text", "record"])
def test_public_functions_name_the_record_that_belongs_there(tmp_path, function, argument, kinds, wrong):
    given = {}
    hints = typing.get_type_hints(function)
    for name, parameter in inspect.signature(function).parameters.items():
        if name == argument:
            given[name] = wrong
        elif name == "rng":
            given[name] = np.random.default_rng(0)
        elif name == "path":
            given[name] = tmp_path / "new.yaml"
        elif parameter.default is parameter.empty:
            kind = next(iter(kinds_of(hints[name])), None)
            given[name] = VALUES[name] if name in VALUES else RECORDS[kind]
    with pytest.raises(ValueError, match=rf"^{argument} must be an? .*got {type(wrong).__name__}$") as told:
        function(**given)
    assert any(kind.__name__ in str(told.value) for kind in kinds)
    assert list(tmp_path.iterdir()) == []


def test_all_public_functions_that_take_records_are_asked():
    """Reading types from annotations must not come to nothing."""
    named = {case.id for case in asked()}
    for known in ("score_map-truth", "detect_doors-drawing", "update_map-evidence", "drive-world", "explore-building"):
        assert known in named
    assert len(named) > 35
