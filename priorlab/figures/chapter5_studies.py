"""Chapter 5 in numbers: cell sizes, explored parts, qualities of the prior, sensors and updates; each over five seeds."""

from __future__ import annotations

from typing import Any

import numpy as np

from priorlab import plot
from priorlab.core.grid_map import Prior
from priorlab.figures.figure import Entry, Outcome, sheet, verdict_of
from priorlab.figures.row_summary import curve_of, gain_told, interval_of, summary_of, survey_title, three_curves
from priorlab.robot.range_noise import RangeNoise
from priorlab.study.conditions import SEEDS, Condition, Row, run_all, vary
from priorlab.study.qualities import QUALITIES
from priorlab.study.thesis_drawings import DENSE, QUICK, THESIS_DRAWINGS, THOROUGH

SURVEYS = {"quick": QUICK, "thorough": THOROUGH, "dense": DENSE}
CELL_SIZES = (1.0, 2.0, 3.0, 5.0, 10.0)
SHARES = (0.1, 0.25, 0.5, 0.75, 1.0)
WALLS = ("true walls", "extracted", "30 % missing", "70 % missing", "poor")
NOISY = RangeNoise(deviation=1.5, outlier_rate=0.02, dropout_rate=0.05)
WEAK_PRIOR = Prior(0.4, 0.75)
"""What thesis 5.3 takes for a weaker sensor: effective 0.36 and 0.675, within eq. 2.22 for 0.8 / 0.2."""

SENSORS = {
    "0.9 / 0.1, exact ranges": Condition(""),
    "0.9 / 0.1, noisy ranges": Condition("", noise=NOISY),
    "0.8 / 0.2, noisy, prior (0.2, 0.9)": Condition("", p_free=0.8, p_occupied=0.2, noise=NOISY),
    "0.8 / 0.2, noisy, prior (0.4, 0.75)": Condition("", p_free=0.8, p_occupied=0.2, noise=NOISY, prior=WEAK_PRIOR),
}


def _cells(rng: np.random.Generator) -> Outcome:
    """F2 by cell size, with the plan, without, and the plan alone."""
    rows = run_all(list(vary(Condition(""), building=THESIS_DRAWINGS, spacing=(QUICK, THOROUGH), cell_size=CELL_SIZES)))
    figure, axes = sheet(1, 2, 5.8, 4.2)
    for ax, name in zip(axes, ("quick", "thorough"), strict=True):
        own = [row for row in rows if row.condition.spacing == SURVEYS[name]]
        groups = [[row for row in own if row.condition.cell_size == size] for size in CELL_SIZES]
        plot.interval_lines(CELL_SIZES, three_curves(groups), ax, survey_title(name, own), "cell size, px")
        ax.set(xticks=CELL_SIZES, ylim=(0, 1.02))
    gains = {
        f"{name}, {size:g} px": summary_of(
            row for row in rows if row.condition.spacing == SURVEYS[name] and row.condition.cell_size == size
        )
        for name in ("quick", "thorough")
        for size in CELL_SIZES
    }
    coarse = [one["better"] == one["of"] for key, one in gains.items() if key.endswith((", 5 px", ", 10 px"))]
    return Outcome(
        figure,
        {"summary": gains, "rows": [row.as_numbers() for row in rows], "seeds": list(SEEDS)},
        verdict_of(coarse),
        "gain in F2: " + "; ".join(f"{key} {gain_told(one)}" for key, one in gains.items()),
        "F2 over cell size for a quick and a thorough survey: with the plan, without it, the plan alone, intervals shaded.",
    )


def _exploration(rng: np.random.Generator) -> Outcome:
    """F2 by explored share; seen and unseen parts apart."""
    rows = run_all(list(vary(Condition("", THOROUGH), building=THESIS_DRAWINGS, explored=SHARES)))
    figure, axes = sheet(1, 2, 5.8, 4.2)
    groups = [[row for row in rows if row.condition.explored == share] for share in SHARES]
    shares = 100 * np.array(SHARES)
    plot.interval_lines(shares, three_curves(groups), axes[0], "the whole building", "share of a thorough survey, %")
    apart = {
        "with the plan, where seen": curve_of(groups, lambda row: row.worth.seen_informed.f_beta),
        "without, where seen": curve_of(groups, lambda row: row.worth.seen_uninformed.f_beta),
        "with the plan, where not": curve_of(groups, lambda row: row.worth.unseen.f_beta),
    }
    plot.interval_lines(shares, apart, axes[1], "seen and unseen apart (without a plan: 0 where unseen)", axes[0].get_xlabel())
    for ax in axes:
        ax.set(ylim=(0, 1.02))
    summary = {
        f"{100 * share:g} %": {
            **summary_of(group),
            "coverage": interval_of(row.worth.coverage for row in group),
            **{name: curve[i] for name, curve in apart.items()},
        }
        for i, (share, group) in enumerate(zip(SHARES, groups, strict=True))
    }
    better = [one["better"] == one["of"] for key, one in summary.items() if key != "100 %"]
    half = summary["50 %"]
    return Outcome(
        figure,
        {"summary": summary, "rows": [row.as_numbers() for row in rows], "seeds": list(SEEDS)},
        verdict_of(better),
        "gain in F2 by explored share: "
        + "; ".join(f"{key} {gain_told(one)}" for key, one in summary.items())
        + f"; half explored, the plan has {half['with the plan, where not'][0]:.2f} where nobody looked, but where somebody did "
        f"{half['with the plan, where seen'][0]:.2f} against {half['without, where seen'][0]:.2f} without it",
        "F2 over the explored share of a survey: whole building on the left, seen and unseen parts apart on the right.",
    )


def _priors(rng: np.random.Generator) -> Outcome:
    """F2 by quality of the prior for a quick and a dense survey."""
    rows = run_all(list(vary(Condition(""), building=THESIS_DRAWINGS, spacing=(QUICK, DENSE), quality=QUALITIES)))
    figure, axes = sheet(1, 2, 6.4, 7.2)
    summary: dict[str, Any] = {}
    for ax, name in zip(axes, ("quick", "dense"), strict=True):
        own = [row for row in rows if row.condition.spacing == SURVEYS[name]]
        groups = [[row for row in own if row.condition.quality == quality] for quality in QUALITIES]
        plot.interval_bars(QUALITIES, three_curves(groups), ax, survey_title(name, own))
        summary |= {f"{name}, {quality}": summary_of(group) for quality, group in zip(QUALITIES, groups, strict=True)}
    plans = [quality for quality in QUALITIES if "everywhere" not in quality]
    always = {key: one["better"] == one["of"] for key, one in summary.items()}
    better = {name: [always[f"{name}, {quality}"] for quality in plans] for name in ("quick", "dense")}
    return Outcome(
        figure,
        {"summary": summary, "seeds": list(SEEDS)},
        verdict_of([*better["quick"], *better["dense"]]),
        f"quick: {sum(better['quick'])} of {len(plans)} kinds of plan are better than none on every drawing and seed, dense: "
        f"{sum(better['dense'])}; gain quick: "
        + "; ".join(f"{quality} {gain_told(summary[f'quick, {quality}'])}" for quality in QUALITIES),
        "Bars of F2 with priors of ten qualities, without a prior, and of each prior alone, for a quick and a dense survey.",
    )


def _sensors(rng: np.random.Generator) -> Outcome:
    """F2 with a good sensor, with noisy ranges, and with a weaker sensor model, for which (0.2, 0.9) is too sure."""
    rows: list[Row] = []
    groups: dict[str, list[Row]] = {}
    for name, base in SENSORS.items():
        own = run_all(list(vary(base, building=THESIS_DRAWINGS, spacing=list(SURVEYS.values()))))
        rows += own
        groups |= {f"{name}, {how}": [row for row in own if row.condition.spacing == SURVEYS[how]] for how in SURVEYS}
    figure, axes = sheet(1, len(SURVEYS), 5.6, 4.2)
    for ax, how in zip(axes, SURVEYS, strict=True):
        here = {name: groups[f"{name}, {how}"] for name in SENSORS}
        names = [name.replace(", prior", ",\nprior") for name in SENSORS]
        plot.interval_bars(names, three_curves(list(here.values())), ax, survey_title(how, here[names[0]]))
    summary = {key: summary_of(own) | {"breaks_eq_2_22": own[0].worth.overruled} for key, own in groups.items()}
    quick = [one["gain_percent"][1] >= 20 for key, one in summary.items() if key.endswith("quick")]
    sure, fitting = list(SENSORS)[-2:]
    pays = [summary[f"{fitting}, {how}"]["f2_with_prior"][0] > summary[f"{sure}, {how}"]["f2_with_prior"][0] for how in SURVEYS]
    broken = [key for key, one in summary.items() if one["breaks_eq_2_22"]]
    return Outcome(
        figure,
        {"summary": summary, "rows": [row.as_numbers() for row in rows], "seeds": list(SEEDS)},
        verdict_of([*quick, *pays]),
        "gain in F2: "
        + "; ".join(f"{key} {gain_told(one)}" for key, one in summary.items())
        + f"; {len(broken)} of {len(summary)} rows break eq. 2.22 (0.9 x 0.9 = 0.81 against p_free 0.8: every further free look "
        f"makes space less free), and with the weaker sensor the prior (0.4, 0.75) has the higher F2 in {sum(pays)} of "
        f"{len(pays)} surveys",
        "Bars of F2 with the plan, without it and of the plan alone for exact and noisy ranges, a weaker sensor model with two "
        "priors, and three surveys.",
    )


def _updates(rng: np.random.Generator) -> Outcome:
    """The thesis's update against the textbook's, for walls that are true, extracted and damaged."""
    base = list(vary(Condition(""), building=THESIS_DRAWINGS, spacing=list(SURVEYS.values()), quality=WALLS, lam=(1.0, 0.0)))
    rows = run_all(base)
    figure, axes = sheet(1, 3, 5.2, 5.2)
    summary: dict[str, Any] = {}
    for ax, (name, spacing) in zip(axes, SURVEYS.items(), strict=True):
        own = [row for row in rows if row.condition.spacing == spacing]
        bars = {}
        for lam, label in ((1.0, "lam = 1, the thesis's update"), (0.0, "lam = 0, Bayes")):
            groups = [[row for row in own if row.condition.lam == lam and row.condition.quality == q] for q in WALLS]
            bars[label] = curve_of(groups, lambda row: row.worth.informed.f_beta)
            summary |= {f"{name}, {q}, lam {lam:g}": summary_of(group) for q, group in zip(WALLS, groups, strict=True)}
        bars["without (0.5)"] = curve_of(groups, lambda row: row.worth.uninformed.f_beta)
        bars["the plan alone"] = curve_of(groups, lambda row: row.worth.alone.f_beta)
        plot.interval_bars(WALLS, bars, ax, survey_title(name, own))
    good = [summary[f"{name}, {q}, lam 0"] for name in SURVEYS for q in ("true walls", "extracted")]
    never_lost = [one["better"] == one["of"] for one in good]
    bad = [(summary[f"{name}, {q}, lam 1"], summary[f"{name}, {q}, lam 0"]) for name in SURVEYS for q in WALLS[2:]]
    thesis_wins = [one["f2_with_prior"][0] > zero["f2_with_prior"][0] for one, zero in bad]
    return Outcome(
        figure,
        {"summary": summary, "seeds": list(SEEDS)},
        verdict_of([*never_lost, *thesis_wins]),
        f"lam = 0 with true or extracted walls beats no prior on every drawing and seed in {sum(never_lost)} of "
        f"{len(never_lost)} cases; with damaged walls the thesis's update has the higher mean F2 in {sum(thesis_wins)} of "
        f"{len(bad)}; extracted walls, gain: "
        + "; ".join(
            f"{name} lam {lam:g} {gain_told(summary[f'{name}, extracted, lam {lam:g}'])}" for name in SURVEYS for lam in (1, 0)
        ),
        "Bars of F2 for two updates, no prior and the plan alone, five qualities of walls, three surveys.",
    )


STUDY_CELLS = Entry(
    "study-cells",
    "F2 by cell size",
    "With the plan, coarser and so cheaper grids can be used (5.2.1).",
    _cells,
)
STUDY_EXPLORATION = Entry(
    "study-explored",
    "F2 by explored share, seen and unseen parts apart",
    "A prior improves the map of an incomplete exploration (5.2.1).",
    _exploration,
)
STUDY_PRIORS = Entry(
    "study-priors",
    "F2 by quality of the prior",
    "Even a poor prior is better than none (5.2.3).",
    _priors,
)
STUDY_SENSORS = Entry(
    "study-sensors",
    "F2 with noisy ranges and a weaker sensor",
    "A prior helps with a weaker sensor too, and must then be less sure: p_space below p_free, p_wall above p_occupied (2.22).",
    _sensors,
)
STUDY_UPDATES = Entry(
    "study-updates",
    "the thesis's update against Bayes' rule, by quality of the walls",
    "Method page: lam = 0 with a good extraction never loses to 0.5; with a poor one the thesis's update is the better.",
    _updates,
)
