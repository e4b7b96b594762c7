"""What chapter 4 says in passing, put to the test: the false positive rate, the interpolation, the threshold."""

from __future__ import annotations

from typing import Any

import numpy as np

from priorlab import plot
from priorlab.figures.case import cases
from priorlab.figures.figure import Entry, Outcome, sheet, verdict_of
from priorlab.optimize.experiment import Experiment
from priorlab.optimize.interpolation import interpolate
from priorlab.plot.comparison import SERIES
from priorlab.study.discord import discord_of
from priorlab.study.thesis_drawings import QUICK

THRESHOLDS = (0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5)
MEASURES = ("precision", "recall", "f_beta")


def _rates(rng: np.random.Generator) -> Outcome:
    """Precision against false positive rate of 100 priors a drawing: does the order ever turn?"""
    ours = cases()
    figure, axes = sheet(2, len(ours), 3.2, 2.9)
    numbers: dict[str, Any] = {}
    for ax, near, one in zip(axes, axes[len(ours) :], ours, strict=False):
        table = one.experiment.sweep().grid()
        found = discord_of(table.precision, table.false_positive_rate)
        rate = 100 * table.false_positive_rate
        for panel in (ax, near):
            points = panel.scatter(rate, table.precision, c=table.recall, cmap="cividis", s=16, vmin=0, vmax=1)
            panel.set(xlabel="false positive rate, %", ylabel="precision")
        ax.set(title=one.plan.name)
        if found.worst is not None:
            at = list(found.worst)
            x, y = rate.ravel()[at], table.precision.ravel()[at]
            ax.plot(x, y, "o", color=SERIES[5][0], mfc="none", ms=9)
            near.plot(x, y, "o--", color=SERIES[5][0], mfc="none", ms=9, lw=1.2)
            near.set(xlim=(min(x) - 2, max(x) + 2), ylim=(min(y) - 0.02, max(y) + 0.04))
            near.set_title("the upper is more precise\nAND has more false positives", fontsize=8)
        numbers[one.plan.name] = {"pairs": found.pairs, "discordant": found.discordant, "share": found.share}
    figure.colorbar(points, ax=axes, shrink=0.8, label="recall")
    agree = [row["discordant"] == 0 for row in numbers.values()]
    return Outcome(
        figure,
        numbers,
        verdict_of(agree),
        f"of all pairs of the 10 x 10 priors {100 * min(row['share'] for row in numbers.values()):.0f} to "
        f"{100 * max(row['share'] for row in numbers.values()):.0f} % disagree: the more precise map has the higher false "
        f"positive rate, because it also detects more true walls; with a fixed recall the two would always agree",
        "Precision over false positive rate for 100 priors, and enlarged round the pair that disagrees most, joined by a line.",
    )


def _interpolation(rng: np.random.Generator) -> Outcome:
    """How far straight lines and cubics between 10 x 10 priors lie from the exact sweep."""
    ours = cases()
    figure, axes = sheet(1, 2, 5.6, 4.0)
    numbers: dict[str, Any] = {}
    for one in ours:
        sweep = one.experiment.sweep()
        numbers[one.plan.name] = {
            measure: {
                name: {"mean": error.mean, "largest": error.largest, "at": [error.p_wall, error.p_space]}
                for name, error in (
                    ("lines", interpolate(sweep, order=1).error(sweep, measure)),
                    ("cubics", interpolate(sweep, order=3).error(sweep, measure)),
                )
            }
            for measure in MEASURES
        }
    for ax, what in zip(axes, ("mean", "largest"), strict=True):
        bars = {name: [[row["precision"][name][what]] * 3 for row in numbers.values()] for name in ("lines", "cubics")}
        plot.interval_bars(list(numbers), bars, ax, f"{what} error in precision", "|interpolated - exact|, 181 x 181 priors")
    errors = [row[measure] for row in numbers.values() for measure in MEASURES]
    largest = {name: max(error[name]["largest"] for error in errors) for name in ("lines", "cubics")}
    at_cliff = [_beside_cliff(error[name]["at"]) for error in errors for name in largest]
    better = max(error["lines"]["mean"] - error["cubics"]["mean"] for error in errors)
    mean = {name: float(np.mean([error[name]["mean"] for error in errors])) for name in largest}
    return Outcome(
        figure,
        numbers,
        verdict_of([largest["lines"] < 0.05, better < 0.01]),
        f"straight lines err by up to {largest['lines']:.2f} ({mean['lines']:.3f} on average), cubics by up to "
        f"{largest['cubics']:.2f} ({mean['cubics']:.3f}), beside the cliff p x 0.9 = 0.2 in {sum(at_cliff)} of {len(at_cliff)} "
        f"cases; cubics lower a mean error by {better:.3f} at best, so the order "
        f"{'hardly matters' if better < 0.01 else 'matters'}: {'neither' if min(largest.values()) > 0.05 else 'one'} follows a "
        f"cliff",
        "Mean and largest error in precision of linear and cubic interpolation of the 10 x 10 priors, for each drawing.",
    )


def _beside_cliff(prior: list[float]) -> bool:
    """Is one of the two numbers less than a step of the 10 x 10 table from 0.2 / 0.9?"""
    return any(abs(p - 0.2 / 0.9) < 0.1 for p in prior)


def _threshold(rng: np.random.Generator) -> Outcome:
    """The best prior at every threshold: does it follow threshold / 0.9, or stay at 0.2?"""
    ours = cases(spacing=QUICK)
    figure, axes = sheet(1, 2, 5.6, 4.2)
    numbers: dict[str, Any] = {}
    for i, one in enumerate(ours):
        rows = [_best_at(threshold, one.experiment) for threshold in THRESHOLDS]
        colour, marker, _ = SERIES[i]
        at = np.array(THRESHOLDS) + 0.004 * (i - 2)  # side by side
        low, high = np.array([row["f2_best_p_wall"] for row in rows]).T
        axes[0].vlines(at, low, high, color=colour, lw=2.2, label=one.plan.name)
        axes[0].plot(at, high, marker, color=colour, ms=4)
        axes[1].plot(at, [row["precision_best_p_space"][0] for row in rows], marker, color=colour, ms=5, label=one.plan.name)
        numbers[one.plan.name] = rows
    labels = ("p_wall with the highest F2, all of its range", "lowest p_space with the highest precision")
    for ax, y in zip(axes, labels, strict=True):
        ax.plot(THRESHOLDS, np.array(THRESHOLDS) / 0.9, "k:", lw=1.2, label="threshold / 0.9")
        ax.axhline(0.2, color="0.6", lw=0.8)
        ax.set(xlabel="threshold on P(empty)", ylabel=y, ylim=(0.05, 0.75))
        ax.legend(fontsize=8)
    told = [row for rows in numbers.values() for row in rows]
    wall, space = (sum(row[key] for row in told) for key in ("p_wall_reaches_the_edge", "p_space_starts_above_the_edge"))
    elsewhere = [row for row in told if row["threshold"] != 0.2]
    stays = [0.2 <= row["f2_best_p_wall"][1] < 0.25 for row in elsewhere]
    return Outcome(
        figure,
        numbers,
        verdict_of(stays),
        f"the F2-best p_wall reaches up to threshold / 0.9 in {wall} of {len(told)} cases (5 drawings, {len(THRESHOLDS)} "
        f"thresholds), and the first p_space above that is among the precision maxima in {space}; it stays at 0.2 "
        f"in {sum(stays)} of {len(stays)} cases with another threshold: the optimum sits where a cell that nobody looked at just "
        f"counts as wall, and the log odds have no part in it",
        "Best p_wall and p_space over the detection threshold: both follow the line threshold / 0.9.",
    )


def _best_at(threshold: float, base: Experiment) -> dict[str, Any]:
    """Where F2 and precision are highest at one threshold."""
    sweep = Experiment(base.walls, base.evidence, base.truth, threshold=threshold).sweep()
    ranges = [where.p_wall for where in sweep.best("f_beta").plateaus]
    edge = threshold / sweep.factor
    spaces = np.unique(sweep.grid().best("precision")[:, 1].round(1))
    first_above = next(p / 10 for p in range(1, 11) if p / 10 > edge + 1e-9)
    return {
        "threshold": threshold,
        "f2_best_p_wall": [min(one.low for one in ranges), max(one.high for one in ranges)],
        "p_wall_reaches_the_edge": any(one.low - 1e-9 <= edge <= one.high + 1e-9 for one in ranges),
        "precision_best_p_space": spaces.tolist(),
        "p_space_starts_above_the_edge": bool(np.isclose(spaces, first_above).any()),
    }


CLAIM_RATES = Entry(
    "claim-rates",
    "precision against false positive rate",
    "A higher precision always comes with a lower false positive rate, so one of the two measures is enough (4.3.2).",
    _rates,
)
CLAIM_INTERPOLATION = Entry(
    "claim-linear",
    "linear and cubic interpolation of the 10 x 10 priors against the exact sweep",
    "Steps of 0.1 are small enough for linear interpolation; a higher order would hardly matter (4.6).",
    _interpolation,
)
CLAIM_THRESHOLD = Entry(
    "claim-threshold",
    "the best prior moves with the threshold",
    "0.2 is the best p_wall because it is the lowest value in the linear part of the log odds (4.6).",
    _threshold,
)
