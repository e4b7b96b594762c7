"""What mapping costs: the office that is measured, the exponent, and the figure's verdict."""

import numpy as np
import pytest

from priorlab.core.grid import Grid
from priorlab.figures import scaling as figure
from priorlab.study.scaling import PER_POSE, Cost, cost_by_size, growth, measure_cost, measure_peak, office


@pytest.mark.parametrize(("side", "n_poses"), [(100, None), (250, None), (250, 7), (300, 2000)])
def test_office_has_rooms_with_doors_and_so_many_poses_in_free_space(side, n_poses):
    truth, survey = office(side, n_poses)
    assert len(survey) == (side**2 // 300 if n_poses is None else n_poses)
    row, col = Grid(truth.shape).xy_to_pixel(survey[:, :2]).T
    assert not truth.walls[row, col].any() and not truth.ignore.any()
    rooms = side // 100
    assert truth.walls.sum() == rooms**2 * (100 * 4 * 2 - 16 - 2 * 30 * 4)


def test_office_says_when_it_holds_no_room():
    with pytest.raises(ValueError, match="side must be at least 100 pixels, got 99"):
        office(99)


def test_measure_cost_times_every_step_and_peak_holds_the_drawing():
    cost = measure_cost(200, 50)
    assert (cost.side, cost.poses, cost.pixels) == (200, 50, 40_000)
    assert set(PER_POSE) < set(cost.seconds) and all(seconds > 0 for seconds in cost.seconds.values())
    assert cost.pose_seconds + cost.pixel_seconds == pytest.approx(sum(cost.seconds.values()))
    assert measure_peak(400, 50) > 400**2 * 2 / 1e6


def test_cost_by_size_says_how_far_it_is():
    told = []
    rows = cost_by_size((100, 200), repeats=1, progress=lambda done, to_do: told.append((done, to_do)))
    assert told == [(1, 2), (2, 2)] and [row.side for row in rows] == [100, 200]
    assert all(row.peak_mb > 0 for row in rows)


def test_growth_is_the_exponent_of_a_power_law():
    x = np.array([3.0, 10.0, 40.0, 90.0])
    for exponent in (0.5, 1.0, 1.7):
        assert growth(x, 0.02 * x**exponent) == pytest.approx(exponent)


@pytest.mark.parametrize(
    ("exponent", "peak", "verdict"),
    [(1.0, 500.0, "agrees"), (1.6, 500.0, "partly"), (1.0, 2500.0, "partly"), (2.0, 3e3, "differs")],
)
def test_figure_scaling_judges_by_the_fitted_exponents_and_the_memory(monkeypatch, exponent, peak, verdict):
    def costs(amounts, of):
        return [Cost(1000, 1000, {"ranges": a**exponent, "evidence": 0.0, "map": a**exponent}, peak) for a in amounts]

    def by_size():
        return [Cost(side, side**2 // 300, one.seconds, peak) for side, one in zip((500, 1000), costs((1, 4), peak), strict=True)]

    def by_poses():
        return [Cost(1000, poses, one.seconds) for poses, one in zip((100, 200), costs((1, 2), peak), strict=True)]

    monkeypatch.setattr(figure, "cost_by_size", by_size)
    monkeypatch.setattr(figure, "cost_by_poses", by_poses)
    outcome = figure.SCALING.make(np.random.default_rng(0))
    assert outcome.verdict == verdict
    assert outcome.numbers["growth"]["pose_work_by_poses"] == pytest.approx(exponent)
    assert f"{exponent:.2f}" in outcome.says and len(outcome.figure.axes) == 2
