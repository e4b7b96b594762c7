"""The flip-value picture: each cell's critical prior, tried out on the map itself."""

from __future__ import annotations

import cv2
import numpy as np
import pytest

import priorlab as pl
from priorlab.core.survey import look_around
from priorlab.widgets import FlipLab
from priorlab.widgets.flip_lab import GAINED, LOST, NEVER_SEEN


@pytest.fixture(scope="module")
def experiment():
    labels = np.zeros((60, 90), dtype=np.uint8)
    labels[:3] = labels[-3:] = labels[:, :3] = labels[:, -3:] = 1
    labels[3:35, 44:47] = 1  # off the lattice of cells: mixed readings
    truth = pl.Truth(walls=labels.astype(bool), ignore=np.zeros(labels.shape, dtype=bool))
    readings = pl.explore(truth, look_around([((12, 14), (78, 14)), ((12, 40), (36, 40))], 4), pl.RangeSensor(max_range=30))
    return pl.Experiment(pl.Walls(labels, name="rooms"), pl.gather_evidence(readings, pl.Grid(labels.shape, 3)), truth)


@pytest.fixture
def lab(experiment):
    return FlipLab(experiment)


def colours_of(picture):
    return cv2.imdecode(np.frombuffer(picture.image, np.uint8), cv2.IMREAD_COLOR)[..., ::-1]


@pytest.mark.parametrize("lam", [1.0, 0.0, 0.6])
def test_flip_lab_critical_prior_is_where_the_cell_flips(lab, experiment, lam):
    lab.lam.value = lam
    inside = np.argwhere(np.isfinite(lab.critical) & (lab.critical > 0.03) & (lab.critical < 1.0))
    assert len(inside) > 20
    for row, col in inside[:: max(1, len(inside) // 15)]:
        looks, total = experiment.evidence.looks[row, col], experiment.evidence.total[row, col]
        below, above = (
            l_0 + total - lam * looks * l_0 <= np.log(0.2 / 0.8) + 1e-9
            for l_0 in (np.log(p / (1 - p)) for p in 0.9 * (lab.critical[row, col] + np.array([-1e-6, 1e-6])))
        )
        assert (below, above) == ((True, False) if lab.direction[row, col] < 0 else (False, True))


def test_flip_lab_counts_what_the_map_gains_and_loses(lab, experiment):
    before = experiment.map(pl.Prior(0.2, 0.9)).detected()
    lab.set(p_wall=0.9, p_space=0.6)
    now = experiment.map(pl.Prior(0.9, 0.6)).detected()
    assert lab.gained == (now & ~before).sum() > 0 and lab.lost == (before & ~now).sum() > 0
    shown = colours_of(lab.pictures[2])
    assert (shown == GAINED).all(axis=2).sum() == lab.gained and (shown == LOST).all(axis=2).sum() == lab.lost


def test_flip_lab_score_is_the_maps(lab, experiment):
    lab.set(p_wall=0.5, p_space=0.7)
    assert lab.score == experiment.score(pl.Prior(0.5, 0.7))


def test_flip_lab_unseen_cells_are_grey_and_seen_ones_are_not(lab, experiment):
    grey = (colours_of(lab.pictures[0]) == NEVER_SEEN).all(axis=2)
    assert (grey == ~experiment.evidence.seen).all()


def test_flip_lab_says_how_often_and_which_way(lab, experiment):
    for n, words in ((0, "wall at or below"), (1, "no prior matters"), (2, "wall at or above")):
        count = (experiment.evidence.looks == n).sum() if n < 2 else (experiment.evidence.looks >= 2).sum()
        assert f"{count:,}: {words}" in lab.readout.value


def test_flip_lab_presets_differ_and_reset_returns(lab):
    start, said = repr(lab), set()
    for button in lab.buttons.values():
        lab.reset()
        button.click()
        said.add(repr(lab))
    lab.reset()
    assert repr(lab) == start and len(said) == len(lab.buttons) - 1
