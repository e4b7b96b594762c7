"""Figures 5.12 to 5.21: their numbers against the recursion, pixel by pixel, and the rules behind their verdicts."""

import numpy as np
import pytest

from priorlab.core.log_odds import log_odds
from priorlab.figures.depth_camera import _errors_m
from priorlab.figures.depth_camera_zooms import N_PLACES, places, window_f2
from priorlab.figures.depth_case import INFORMATIVE, NONE, Interval, arena, final_f2, prior_alone, seeds_of, survey
from priorlab.figures.registry import FIGURES, figure_named
from priorlab.mapping.prior import build_prior_map
from priorlab.mapping.recursion import update_step_by_step

SEEDS = seeds_of(np.random.default_rng(0))


def f2_by_hand(p_empty_is_low, walls):
    tp, fp, fn = ((p_empty_is_low & walls).sum(), (p_empty_is_low & ~walls).sum(), (~p_empty_is_low & walls).sum())
    return 5 * tp / (5 * tp + 4 * fn + fp) if tp else 0.0


def slow_map(seed, prior, size, repeats):
    start = build_prior_map(arena().walls, prior, size)
    slow = update_step_by_step(start, survey(seed).readings(repeats))
    return start.grid.to_image(slow.log_odds <= log_odds(0.2) + 1e-9)


def test_all_figures_of_the_section_are_there_but_the_photograph():
    assert {f"fig-5-{n}" for n in range(12, 22)} <= set(FIGURES) and "fig-5-11" not in FIGURES
    with pytest.raises(ValueError, match="fig-5-11 cannot be computed: it shows photographs"):
        figure_named("fig-5-11")


@pytest.mark.parametrize(("prior", "size", "repeats"), [(INFORMATIVE, 2, 3), (NONE, 3, 1)])
def test_final_f2_equals_the_recursion(prior, size, repeats):
    slow = f2_by_hand(slow_map(SEEDS[0], prior, size, repeats), arena().truth.walls)
    assert final_f2(SEEDS[:1], prior, size, repeats).mean == pytest.approx(slow)


def test_prior_alone_is_the_plan_widened_to_cells():
    walls = arena().truth.walls
    cells = walls.reshape(70, 2, 90, 2).any(axis=(1, 3)).repeat(2, axis=0).repeat(2, axis=1)
    assert prior_alone(2) == pytest.approx(f2_by_hand(cells, walls))


def test_places_do_not_overlap_and_the_first_gains_most():
    covered = np.zeros(arena().truth.shape, dtype=int)
    walls = arena().truth.walls
    right = {prior: slow_map(SEEDS[0], prior, 2, 3) == walls for prior in (INFORMATIVE, NONE)}
    gain = right[INFORMATIVE].astype(int) - right[NONE].astype(int)
    windows = places(SEEDS[0])
    for window in windows:
        covered[window] += 1
    assert len(windows) == N_PLACES and covered.max() == 1 and covered.sum() == N_PLACES * 24**2
    best = max(gain[r : r + 24, c : c + 24].sum() for r in range(140 - 23) for c in range(180 - 23))
    assert gain[windows[0]].sum() == best


def test_window_f2_counts_inside_only():
    window = places(SEEDS[0])[0]
    slow = slow_map(SEEDS[1], INFORMATIVE, 3, 1)[window]
    assert window_f2(SEEDS[1], INFORMATIVE, 3, 1, window) == pytest.approx(f2_by_hand(slow, arena().truth.walls[window]))


def test_errors_of_ranges_shrink_by_the_root_of_the_rows():
    """Only what the 20 rows do not share: sqrt(0.0014^2 + 0.001^2) against sqrt(0.0014^2 / 20 + 0.001^2), at most 5 : 2."""
    from dataclasses import replace

    one = survey(SEEDS[0])
    wide, thin = (np.nanstd(_errors_m(one, camera)) for camera in (one.camera, replace(one.camera, strip_rows=1)))
    assert 1.3 < thin / wide < 2.5


def test_figure_5_21_starts_at_the_prior_and_ends_at_the_final_maps():
    outcome = figure_named("fig-5-21").make(np.random.default_rng(0))
    for repeats in (1, 3):
        told = outcome.numbers[f"{repeats}_a_pose"]
        assert told["with the plan"]["mean"][0] == pytest.approx(prior_alone(2)) and told["without"]["mean"][0] == 0
        assert told["final"]["without"]["mean"] == pytest.approx(final_f2(SEEDS, NONE, 2, repeats).mean)
        assert told["steps"][-1] == 12 * repeats
    assert outcome.verdict in ("partly", "agrees") and "plan alone" in outcome.says


def test_interval():
    assert str(Interval.of([0.2, 0.4, 0.3])) == "0.30 (0.20 to 0.40)"
