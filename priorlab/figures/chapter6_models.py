"""Figures 6.1 and 6.2: what one step of the wheels and one beam of the scanner say."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from priorlab.core.grid import Grid
from priorlab.core.grid_map import GridMap
from priorlab.core.log_odds import log_odds, probability
from priorlab.core.pose import compose
from priorlab.figures.figure import Entry, Outcome, sheet, verdict_of
from priorlab.plot.style import BLACK, BLUE, GREEN, ORANGE, RED, finish
from priorlab.slam.map_update import FREE, OCCUPIED, UNSEEN, see_cells, update_seen
from priorlab.slam.motion import sample_motion
from priorlab.slam.parameters import TUNED, Parameters
from priorlab.slam.scan import Scan
from priorlab.study.confidence import Confidence
from priorlab.study.office_floor import FLOOR_PRIOR

ROT1, TRANS, ROT2 = math.radians(30), 1.0, math.radians(20)
"""The step of figure 6.1: turn, one metre straight, turn."""

SMALL, LARGE = 0.002, 0.05
CLOUDS = {
    "all alphas 0.002": (SMALL, SMALL, SMALL, SMALL),
    r"$\alpha_1$ = 0.05: turns from turning": (LARGE, SMALL, SMALL, SMALL),
    r"$\alpha_2$ = 0.05: turns from driving": (SMALL, LARGE, SMALL, SMALL),
    r"$\alpha_3$ = 0.05: way from driving": (SMALL, SMALL, LARGE, SMALL),
    r"$\alpha_4$ = 0.05: way from turning": (SMALL, SMALL, SMALL, LARGE),
}
"""Variances per squared metre or radian, and what each is for (section 6.1)."""

PARTICLES = 4500
CELL_M = 0.05


def _motion(rng: np.random.Generator) -> Outcome:
    """Figure 6.1: the step, and the clouds that the alphas make of it."""
    before, after = np.zeros(3), _end_of_step()
    figure, axes = sheet(2, 3, 4.0, 3.6)
    _draw_step(axes[0], before, after)
    seeds = rng.spawn(5)
    spread: dict[str, dict[str, list[float]]] = {}
    for ax, (name, alphas) in zip(axes[1:], CLOUDS.items(), strict=True):
        parameters = Parameters(alphas=alphas)
        clouds = [sample_motion(np.zeros((PARTICLES, 3)), before, after, child, parameters) for child in seeds]
        spread[name] = {key: [_spread_of(cloud)[key] for cloud in clouds] for key in ("way_m", "turn_deg")}
        _draw_cloud(ax, clouds[0], after, name)
    usual = spread["all alphas 0.002"]
    widened = {
        name: {key: Confidence.of(np.array(values[key]) / usual[key]) for key in values} for name, values in spread.items()
    }
    expected = {name: _expected(alphas) for name, alphas in CLOUDS.items()}
    off = [
        abs(float(np.mean(values[key])) / expected[name][key] - 1)
        for name, values in spread.items()
        for key in ("way_m", "turn_deg")
    ]
    names = list(CLOUDS)
    holds = {
        "alpha_1 and alpha_2 widen the turn": all(widened[name]["turn_deg"].low > 1.2 for name in names[1:3]),
        "alpha_3 and alpha_4 widen the way": all(widened[name]["way_m"].low > 1.2 for name in names[3:]),
        "neither widens the other": all(widened[name]["way_m"].high < 1.1 for name in names[1:3])
        and all(widened[name]["turn_deg"].high < 1.1 for name in names[3:]),
        "spread as the formula has it": max(off) < 0.05,
    }
    numbers = {
        "step": {"rot1": ROT1, "trans_m": TRANS, "rot2": ROT2},
        "spread": {
            name: {key: Confidence.of(values[key]).as_numbers() for key in values} | {"formula": expected[name]}
            for name, values in spread.items()
        },
        "holds": holds,
    }
    return Outcome(
        figure,
        numbers,
        verdict_of(list(holds.values())),
        f"five seeds of {PARTICLES} particles; against all alphas 0.002: "
        + ", ".join(
            f"alpha_{i} = {LARGE:g} makes the way {widened[name]['way_m'].mean:.1f} and the first turn "
            f"{widened[name]['turn_deg'].mean:.1f} times as uncertain"
            for i, name in enumerate(names[1:], start=1)
        )
        + f"; the spread is that of the formula to {100 * max(off):.0f} %",
        "A turn, a straight way and a second turn; five clouds of particles after it, each wider in what its alpha stands for.",
    )


def _end_of_step() -> NDArray[np.float64]:
    """Where the odometry ends."""
    return compose(compose([0, 0, ROT1], [TRANS, 0, 0]), [0, 0, ROT2])


def _spread_of(cloud: NDArray[np.float64]) -> dict[str, float]:
    """Deviation of the way and of the direction in which it was driven."""
    x, y, _ = cloud.T
    return {"way_m": float(np.hypot(x, y).std()), "turn_deg": float(np.degrees(np.arctan2(y, x).std()))}


def _expected(alphas: tuple[float, ...]) -> dict[str, float]:
    """The same by the formula of algorithm 6.3."""
    a1, a2, a3, a4 = alphas
    way, turn = a3 * TRANS**2 + a4 * (ROT1**2 + ROT2**2), a1 * ROT1**2 + a2 * TRANS**2
    return {"way_m": math.sqrt(way), "turn_deg": math.degrees(math.sqrt(turn))}


def _draw_step(ax: Axes, before: NDArray[np.float64], after: NDArray[np.float64]) -> None:
    """The two poses, the way between them and its three parts."""
    ax.plot([0, after[0]], [0, after[1]], "-", color=BLACK, lw=1.4)
    ax.plot([0, 0.6], [0, 0], ":", color=BLACK, lw=1)
    on = after[:2] * 1.45
    ax.plot([after[0], on[0]], [after[1], on[1]], ":", color=BLACK, lw=1)
    for pose, colour, label in ((before, BLUE, "before"), (after, RED, "after")):
        ax.plot(*pose[:2], "o", color=colour, ms=9, label=label)
        ax.annotate(
            "",
            (pose[0] + 0.3 * math.cos(pose[2]), pose[1] + 0.3 * math.sin(pose[2])),
            (pose[0], pose[1]),
            arrowprops={"arrowstyle": "->", "color": colour, "lw": 1.8},
        )
    for centre, start, turn in ((before[:2], 0.0, ROT1), (after[:2], ROT1, ROT2)):
        along = np.linspace(start, start + turn, 20)
        ax.plot(centre[0] + 0.22 * np.cos(along), centre[1] + 0.22 * np.sin(along), color=GREEN, lw=1.8)
    ax.text(0.28, 0.05, r"$\delta_{rot1}$", color=GREEN)
    ax.text(after[0] + 0.24, after[1] + 0.26, r"$\delta_{rot2}$", color=GREEN)
    ax.text(0.36, 0.33, r"$\delta_{trans}$", rotation=30)
    ax.set(xlim=(-0.15, 1.35), ylim=(-0.2, 1.05), aspect="equal")
    ax.legend(fontsize=8, loc="upper left")
    finish(ax, "turn, straight, turn", "x, m", "y, m")


def _draw_cloud(ax: Axes, cloud: NDArray[np.float64], after: NDArray[np.float64], title: str) -> None:
    """Where the particles end, and every hundredth heading."""
    ax.plot(cloud[:, 0], cloud[:, 1], ".", color=BLUE, ms=1.2, alpha=0.35)
    some = cloud[::150]
    ax.quiver(*some[:, :2].T, np.cos(some[:, 2]), np.sin(some[:, 2]), color=ORANGE, scale=14, width=0.006)
    ax.plot(0, 0, "o", color=BLACK, ms=6)
    ax.plot(*after[:2], "x", color=RED, ms=9, mew=2)
    ax.set(xlim=(-0.1, 1.7), ylim=(-0.2, 1.25), aspect="equal")
    finish(ax, title, "x, m", "y, m")


def _beam(rng: np.random.Generator) -> Outcome:
    """Figure 6.2: what a beam says about the cells along it, and what becomes of them."""
    grid = Grid((1, 30), 1, CELL_M)
    walls = np.zeros(30, dtype=bool)
    walls[22:26] = True  # the plan's wall; the beam ends at its face
    prior = np.where(walls, FLOOR_PRIOR.effective_p_wall, FLOOR_PRIOR.effective_p_space)[None]
    before = GridMap(log_odds(prior), grid, FLOOR_PRIOR)
    eye, z = 4.5 * CELL_M, 18.0 * CELL_M
    beam = Scan(np.array([z]), np.zeros(1), np.empty(0))
    figure, axes = sheet(2, 1, 9.0, 2.4)
    numbers, right = {}, []
    for ax, thickening in zip(axes, (0.0, TUNED.thickening_m), strict=True):
        parameters = Parameters(thickening_m=thickening)
        seen = see_cells(grid, np.array([eye, 0.5 * CELL_M, 0.0]), beam, parameters)
        labels = np.full(30, UNSEEN)
        labels[seen.cols] = seen.labels[0]
        after = before.log_odds.copy()
        update_seen(after, before.log_odds, seen, parameters)
        p_after = probability(after)[0]
        hit = 4 + 18
        behind = round(thickening / CELL_M)
        right += [
            (labels[4:hit] == FREE).all(),
            (labels[hit : hit + behind + 1] == OCCUPIED).all(),
            (labels[hit + behind + 1 :] == UNSEEN).all() and (labels[:4] == UNSEEN).all(),
            np.array_equal(p_after[labels == UNSEEN], prior[0][labels == UNSEEN]),
        ]
        _draw_beam(ax, labels, prior[0], p_after, hit, thickening)
        numbers[f"thickening {thickening:g} m"] = {
            "free_cells": int((labels == FREE).sum()),
            "occupied_cells": int((labels == OCCUPIED).sum()),
            "p_empty_after": p_after.round(6).tolist(),
        }
    return Outcome(
        figure,
        {"p_free": TUNED.p_free, "p_occupied": TUNED.p_occupied, "z_m": z, "cell_m": CELL_M, **numbers},
        verdict_of([bool(ok) for ok in right]),
        f"a beam of {z:.2f} m says {TUNED.p_free:g} of the {numbers['thickening 0 m']['free_cells']} cells before the hit, "
        f"{TUNED.p_occupied:g} of the cell that it ends in, and of {numbers['thickening 0.1 m']['occupied_cells']} with 0.10 m "
        "of wall behind the hit; all others keep what they had, to the last bit",
        "Cells along a beam as bars: free up to the hit, occupied in the hit's cell, unchanged behind; once without and once "
        "with a thickness of wall.",
    )


def _draw_beam(
    ax: Axes, labels: NDArray, prior: NDArray[np.float64], p_after: NDArray[np.float64], hit: int, thickening: float
) -> None:
    """What the model says as bars, what the cells had before and have after as steps."""
    x = (np.arange(30) + 0.5) * CELL_M
    for label, value, colour, hatch, name in (
        (FREE, TUNED.p_free, "#bfe0f5", "", "the model says p_free"),
        (OCCUPIED, TUNED.p_occupied, RED, "//", "the model says p_occupied"),
    ):
        chosen = labels == label
        ax.bar(x[chosen], value, CELL_M * 0.94, color=colour, ec="white", hatch=hatch, label=name)
    ax.step(x, prior, where="mid", color=BLACK, ls=":", lw=1.6, label="before: the plan")
    ax.plot(x, p_after, "o", color=BLUE, ms=4, label="after one scan (eq. 6.2)")
    ax.annotate("", (hit * CELL_M, 1.03), (4.5 * CELL_M, 1.03), arrowprops={"arrowstyle": "->", "lw": 1.4})
    ax.plot(4.5 * CELL_M, 1.03, "o", color=BLACK, ms=6)
    ax.set(xlim=(0, 30 * CELL_M), ylim=(0, 1.12))
    ax.legend(fontsize=8, ncols=1, loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    told = f"{thickening:.2f} m of wall behind the hit" if thickening else "only the cell that the beam ends in (eq. 6.1)"
    finish(ax, told, "along the beam, m", "P(empty)")


FIGURE_6_1 = Entry(
    "fig-6-1",
    "the odometry motion model",
    "Motion is a turn, a straight way and a turn; alpha_1 and alpha_2 are the errors of the turns, alpha_3 and alpha_4 of "
    "the way.",
    _motion,
)
FIGURE_6_2 = Entry(
    "fig-6-2",
    "the inverse sensor model",
    "Cells nearer than the obstacle get p_free, the cell in which it lies p_occupied, those beyond keep what they had.",
    _beam,
)
